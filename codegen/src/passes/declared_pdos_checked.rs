//! After this pass the PDOs that a register table declares by themselves, and the values by which its objects map others where
//! no CANopen settings have them checked, were held against the items that they map.

use std::cell::OnceCell;
use std::collections::HashSet;

use super::mentioned_objects_exist;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Device, Direction, Entries, Group, Item, Mappable, PdoEntryKind, Value};
use crate::source::Span;

/// Bits of a CAN frame.
pub(super) const CAN_BITS: u32 = 64;

/// Runs before the PDOs that follow from mapping objects are added: those have checks of their own, as EtherCAT has.
pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let described = Described::new(device);
    for pdo in &device.process_data.pdos {
        let has_object = |kind| !matches!(kind, PdoEntryKind::Padding | PdoEntryKind::Unnumbered);
        for entry in pdo.entries.iter().filter(|entry| has_object(entry.kind)) {
            let (object, span) = ((entry.index, entry.sub_index), entry.origin.span);
            let mapped = Mapped { object, bits: entry.bits, direction: pdo.direction, span };
            mapped.check(&described, device.ethercat.is_some(), diagnostics);
        }
        let bits = pdo.bits();
        if let Some(max) = pdo.max_bytes.filter(|&max| bits > u32::from(max) * 8) {
            let message = format!("the PDO 0x{:04X} has {bits} bits, and at most {max} bytes", pdo.mapping_index);
            diagnostics.push(Diagnostic::new(&codes::PDO_TOO_LONG, pdo.origin.span, message));
        }
        if device.canopen.is_some() && device.ethercat.is_none() && bits > CAN_BITS {
            let message = format!("the PDO 0x{:04X} has {bits} bits, and a CAN frame has 64", pdo.mapping_index);
            diagnostics.push(Diagnostic::new(&codes::PDO_TOO_LONG, pdo.origin.span, message));
        }
    }
    if device.canopen.is_none() {
        device.groups.iter().for_each(|group| defaults(&described, group, diagnostics));
    }
}

/// What a mapping object maps by its defaults.
fn defaults(described: &Described<'_>, group: &Group, diagnostics: &mut Diagnostics) {
    let Some(direction) = group.index().and_then(direction_of) else { return };
    let number = |item: &Item| item.default.as_ref().and_then(Value::as_int);
    let count = group.sub(0).and_then(number).unwrap_or(i128::MAX);
    for item in &group.items {
        let Some((_, sub @ 1..)) = item.object() else { continue };
        let span = item.at.default.or(item.origin.span);
        let mapped =
            number(item).filter(|_| i128::from(sub) <= count).and_then(|word| Mapped::word(word, direction, span));
        if let Some(mapped) = mapped {
            mapped.check(described, false, diagnostics);
        }
    }
}

/// The direction of the PDOs that an object maps.
pub(super) fn direction_of(mapping: u16) -> Option<Direction> {
    match mapping {
        0x1600..=0x17FF => Some(Direction::Receive),
        0x1A00..=0x1BFF => Some(Direction::Transmit),
        _ => None,
    }
}

/// What a device says of its objects.
pub(super) struct Described<'a> {
    pub device: &'a Device,
    pub entries: Entries<'a>,
    /// The indices of its objects, those of further axes among them: made when they are first asked for.
    indices: OnceCell<HashSet<u16>>,
}

impl<'a> Described<'a> {
    pub fn new(device: &'a Device) -> Self {
        Described { device, entries: Entries::new(&device.groups), indices: OnceCell::new() }
    }

    fn indices(&self) -> &HashSet<u16> {
        self.indices.get_or_init(|| mentioned_objects_exist::known(self.device))
    }
}

/// An object that something maps.
pub(super) struct Mapped {
    pub object: (u16, u8),
    pub bits: u32,
    pub direction: Direction,
    pub span: Span,
}

impl Mapped {
    /// What a mapping value says: index, sub-index and length. Dummy entries, and 0 for none, map nothing.
    pub fn word(word: i128, direction: Direction, span: Span) -> Option<Self> {
        let word = u32::try_from(word).ok()?;
        let (index, sub_index) = ((word >> 16) as u16, (word >> 8) as u8);
        (index >= 0x20).then_some(Mapped { object: (index, sub_index), bits: word & 0xFF, direction, span })
    }

    /// Holds it against its item. Where other checks look for missing objects and at lengths, this one doesn't.
    pub fn check(&self, described: &Described<'_>, is_resolved: bool, diagnostics: &mut Diagnostics) {
        let item = described.entries.get(self.object.0, self.object.1);
        let found = match item {
            Some(item) => self.against(described.device, item, is_resolved),
            None => [(!is_resolved).then(|| self.missing(described)).flatten(), None, None],
        };
        for (code, problem) in found.into_iter().flatten() {
            let message = format!("0x{:04X} sub-index {:#x} {problem}", self.object.0, self.object.1);
            let found = Diagnostic::new(code, self.span, message);
            diagnostics.push(match item {
                Some(item) => found.note_at(item.origin.span, "the mapped object"),
                None => found,
            });
        }
    }

    /// The objects of further axes are those of the first at other indices.
    fn missing(&self, described: &Described<'_>) -> Option<(&'static Code, String)> {
        let device = described.device;
        let of_another_axis = || described.indices().contains(&self.object.0);
        let is_missing = !device.groups.is_empty() && (device.object(self.object.0).is_some() || !of_another_axis());
        is_missing.then(|| (&codes::MAPPED_OBJECT_MISSING, "is mapped, but not described".to_owned()))
    }

    fn against(&self, device: &Device, item: &Item, is_resolved: bool) -> [Option<(&'static Code, String)>; 3] {
        let owner = Owner::of_types(&device.types);
        let bits = owner.definition(item.ty).map_or(item.ty.bits(), |definition| definition.bits);
        let length = bits.filter(|&bits| !is_resolved && bits != self.bits);
        let length =
            length.map(|bits| (&codes::MAPPED_LENGTH, format!("is mapped with {} bits, but has {bits}", self.bits)));
        // What nothing was said of may be mapped where the manual maps it.
        let unmappable = !item.mappable.any() && !item.at.mappable.is_empty();
        let unmappable = unmappable.then(|| (&codes::NOT_MAPPABLE, "is mapped, but not mappable".to_owned()));
        let direction = (!goes(item, self.direction)).then(|| {
            let (name, access) = (direction_name(self.direction), item.access.name());
            (&codes::WRONG_DIRECTION, format!("is {access} and can't be mapped into {name}"))
        });
        [length, unmappable, direction]
    }
}

/// Whether an item's access, and its direction where it has only one, go with that of a PDO.
pub(super) fn goes(item: &Item, direction: Direction) -> bool {
    let (access, own) = (Mappable::by_access(item.access), item.mappable);
    match direction {
        Direction::Receive => access.rpdo && (own.rpdo || !own.tpdo),
        Direction::Transmit => access.tpdo && (own.tpdo || !own.rpdo),
    }
}

fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "an RPDO",
        Direction::Transmit => "a TPDO",
    }
}
