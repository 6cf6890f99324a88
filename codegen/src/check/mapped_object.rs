//! Comparison of the entries of PDO mappings with the mapped items.

use std::cell::OnceCell;

use crate::collections::HashSet;
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{stated, AxisStep, Device, Direction, Entries, Item, Mappable};
use crate::number::sub_entry;
use crate::source::Span;
use crate::text::count_of;

/// Maximum number of data bits in a CAN frame.
pub(super) const CAN_BITS: u32 = 64;

/// Returns the direction of the PDO that a mapping object defines, or `None` if the index is not that of a mapping object.
pub(super) fn direction_of(mapping: u16) -> Option<Direction> {
    match mapping {
        0x1600..=0x17FF => Some(Direction::Receive),
        0x1A00..=0x1BFF => Some(Direction::Transmit),
        _ => None,
    }
}

/// Lookup table for the objects of a device.
pub(super) struct Described<'a> {
    pub device: &'a Device,
    pub entries: Entries<'a>,
    /// Indices of the device's objects, including mapping objects of PDOs and objects of further axes. The set is built
    /// at the first lookup.
    indices: OnceCell<HashSet<u16>>,
}

impl<'a> Described<'a> {
    pub fn new(device: &'a Device) -> Self {
        Described { device, entries: Entries::new(&device.groups), indices: OnceCell::new() }
    }

    fn indices(&self) -> &HashSet<u16> {
        self.indices.get_or_init(|| indices(self.device))
    }
}

/// An object that a PDO maps.
pub(super) struct Mapped {
    pub object: (u16, u8),
    pub bits: u32,
    pub direction: Direction,
    pub span: Span,
}

impl Mapped {
    /// Parses a mapping value: index, sub-index and length. Returns `None` for dummy entries, for empty entries, and
    /// for numbers that do not fit in 32 bits.
    pub fn word(word: i128, direction: Direction, span: Span) -> Option<Self> {
        let word = u32::try_from(word).ok()?;
        let (index, sub_index) = ((word >> 16) as u16, (word >> 8) as u8);
        (index >= 0x20).then_some(Mapped { object: (index, sub_index), bits: word & 0xFF, direction, span })
    }

    /// Compares the mapped object with the item that describes it. If `is_resolved` is true, missing objects and wrong lengths are
    /// skipped, because they are already reported elsewhere.
    pub fn check(&self, described: &Described<'_>, is_resolved: bool, diagnostics: &mut Diagnostics) {
        let item = described.entries.get(self.object.0, self.object.1);
        let found = match item {
            Some(item) => self.against(described.device, item, is_resolved),
            None => [(!is_resolved).then(|| self.missing(described)).flatten(), None, None],
        };
        for (code, problem) in found.into_iter().flatten() {
            let message = format!("{} {problem}", sub_entry(self.object.0, self.object.1));
            let found = code.at(self.span, message);
            diagnostics.push(match item {
                Some(item) => found.note_at(item.origin.span, "the mapped object"),
                None => found,
            });
        }
    }

    /// Returns the code and message for a mapped object that is neither described nor an object of a further axis.
    fn missing(&self, described: &Described<'_>) -> Option<(&'static Code, String)> {
        let device = described.device;
        let of_another_axis = || described.indices().contains(&self.object.0);
        let is_missing = !device.groups.is_empty() && (device.object(self.object.0).is_some() || !of_another_axis());
        is_missing.then(|| (&codes::MAPPED_OBJECT_MISSING, "is mapped, but not described".to_owned()))
    }

    fn against(&self, device: &Device, item: &Item, is_resolved: bool) -> [Option<(&'static Code, String)>; 3] {
        let owner = Owner::of_types(&device.types);
        let bits = stated::definition(owner, item)
            .map_or_else(|| stated::ty(owner, item).bits(), |definition| definition.bits);
        let length = bits.filter(|&bits| !is_resolved && bits != self.bits);
        let length = length.map(|bits| {
            (&codes::MAPPED_LENGTH, format!("is mapped with {}, but its type has {bits}", count_of(self.bits, "bit")))
        });
        // An item is reported as not mappable only if the source states that PDOs cannot map it.
        let unmappable = !item.mappable.any() && !item.at.mappable.is_empty();
        let unmappable = unmappable.then(|| (&codes::NOT_MAPPABLE, "is mapped, but not mappable".to_owned()));
        let direction = wrong_direction(item, self.direction).map(|problem| (&codes::WRONG_DIRECTION, problem));
        [length, unmappable, direction]
    }
}

/// Returns the reason why an item cannot be mapped into PDOs with this direction. Either the access rights of the item
/// prevent the mapping, or the item can be mapped only in the other direction. Returns `None` if there is no such reason.
pub(super) fn wrong_direction(item: &Item, direction: Direction) -> Option<String> {
    let (access, mappable, name) = (Mappable::by_access(item.access), item.mappable, pdo_name(direction));
    let (is_accessible, other) = match direction {
        Direction::Receive => (access.rpdo, (mappable.tpdo && !mappable.rpdo).then_some(Direction::Transmit)),
        Direction::Transmit => (access.tpdo, (mappable.rpdo && !mappable.tpdo).then_some(Direction::Receive)),
    };
    match other {
        _ if !is_accessible => Some(format!("is {} and cannot be mapped into {name}", item.access.name())),
        Some(other) => Some(format!("is mapped into {name}, but can only be mapped into {}", pdo_name(other))),
        None => None,
    }
}

/// Returns the name of a PDO with this direction, with an article.
pub(super) fn pdo_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "an RPDO",
        Direction::Transmit => "a TPDO",
    }
}

/// Returns the indices of a device's objects, including mapping objects of PDOs and objects of further axes. The set is
/// empty if no item has an object address.
pub(super) fn indices(device: &Device) -> HashSet<u16> {
    let mut known: HashSet<u16> = device.items().filter_map(|item| Some(item.object()?.0)).collect();
    if known.is_empty() {
        return known;
    }
    known.extend(device.groups.iter().filter_map(|group| group.index()));
    known.extend(device.process_data.pdos.iter().map(|pdo| pdo.mapping_index));
    of_axes(device, &mut known);
    known
}

/// Adds the indices of the objects of further axes.
fn of_axes(device: &Device, known: &mut HashSet<u16>) {
    let Some(axes) = &device.axes else { return };
    for index in known.clone() {
        let rule = axes.rules.iter().find(|rule| (rule.indices.0..=rule.indices.1).contains(&index));
        if let Some(AxisStep::Index(step)) = rule.map(|rule| rule.step) {
            known.extend((1..u16::from(axes.axes)).filter_map(|axis| index.checked_add(axis.checked_mul(step)?)));
        }
    }
}
