//! PDOs from the mapping objects of a CANopen dictionary, with exact bit positions (CiA 301 7.5.2.36, 7.5.2.38).

use super::pdo_entries::entry_name;
use crate::collections::{HashMap, HashSet};
use crate::ir::{
    Device, Direction, Entries, Group, Item, Module, ObjectBuses, Pdo, PdoCommunication, PdoEntry, PdoEntryKind, Value,
};
use crate::source::Span;

/// Maximum number of PDOs in each direction.
const PDOS: u16 = 512;

/// Adds the PDOs of all mapping objects of a CANopen device.
pub(super) fn run(device: &mut Device, modules: &[Module]) {
    if device.canopen.is_none() {
        return;
    }
    let items = MappableItems::new(device, modules);
    let directions = [Direction::Receive, Direction::Transmit].into_iter();
    let objects = directions.flat_map(|direction| PdoObjects::of_direction(device, direction));
    let pdos: Vec<Pdo> = objects.filter_map(|objects| pdo(device, &items, &objects)).collect();
    device.process_data.pdos.extend(pdos);
}

/// The communication object and mapping object of a PDO.
pub(crate) struct PdoObjects<'a> {
    /// Direction of the PDO.
    pub direction: Direction,
    /// Index of the communication object.
    pub index: u16,
    /// Number of the PDO, counted from 1.
    pub number: u16,
    /// Communication object, if the dictionary describes it.
    pub communication: Option<&'a Group>,
    /// Mapping object, if the dictionary describes it.
    pub mapping: Option<&'a Group>,
}

impl<'a> PdoObjects<'a> {
    /// Returns the objects of all PDOs with this direction, sorted by number.
    pub(crate) fn of_direction(device: &'a Device, direction: Direction) -> impl Iterator<Item = Self> {
        Self::numbers(device, direction).into_iter().map(move |number| Self::new(device, direction, number))
    }

    fn new(device: &'a Device, direction: Direction, number: u16) -> Self {
        let index = first_index(direction) + number;
        let (communication, mapping) = (device.object(index), device.object(index + PDOS));
        PdoObjects { direction, index, number: number + 1, communication, mapping }
    }

    /// Returns the numbers of the PDOs with this direction, counted from 0. The dictionary describes the communication
    /// object or the mapping object of each of these PDOs.
    pub(crate) fn numbers(device: &Device, direction: Direction) -> Vec<u16> {
        let first = first_index(direction);
        let indices = device.groups.iter().filter_map(Group::index);
        let offsets = indices.filter_map(|index| index.checked_sub(first).filter(|&offset| offset < 2 * PDOS));
        let mut numbers: Vec<u16> = offsets.map(|offset| offset % PDOS).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// Returns the index of the mapping object.
    pub(crate) fn mapping_index(&self) -> u16 {
        self.index + PDOS
    }
}

/// Returns the index of the first communication object of a direction.
fn first_index(direction: Direction) -> u16 {
    match direction {
        Direction::Receive => 0x1400,
        Direction::Transmit => 0x1800,
    }
}

/// Lookup table of the items that PDOs can map: items of the device, and items that modules add.
pub(crate) struct MappableItems<'a> {
    entries: Entries<'a>,
    /// Items of the fixed objects of modules.
    of_modules: HashMap<(u16, u8), &'a Item>,
    /// Indices of objects whose number of sub-indices depends on the connected modules.
    extended: HashSet<u16>,
}

impl<'a> MappableItems<'a> {
    /// Collects the items of a device and its modules.
    pub(crate) fn new(device: &'a Device, modules: &'a [Module]) -> Self {
        let fixed = device.accepted_modules(modules).flat_map(|module| &module.fixed_objects);
        let items = fixed.flat_map(|group| &group.items).filter_map(|item| Some((item.object()?, item)));
        let extensions = device.accepted_modules(modules).flat_map(|module| &module.sub_extensions);
        MappableItems {
            entries: Entries::new(&device.groups),
            of_modules: items.collect(),
            extended: extensions.map(|extension| extension.index).collect(),
        }
    }

    /// Returns the item of the device at an index and sub-index.
    pub(crate) fn of_device(&self, index: u16, sub_index: u8) -> Option<&'a Item> {
        self.entries.get(index, sub_index)
    }

    /// Returns the item of the device or of a module.
    pub(crate) fn get(&self, index: u16, sub_index: u8) -> Option<&'a Item> {
        self.of_device(index, sub_index).or_else(|| self.of_modules.get(&(index, sub_index)).copied())
    }

    /// Returns whether modules add sub-indices to an object.
    pub(crate) fn is_extended(&self, index: u16) -> bool {
        self.extended.contains(&index)
    }
}

/// A value of a mapping object at a sub-index above 0.
pub(crate) struct MappingValue<'a> {
    /// Item that contains the value: a sub-index of the mapping object.
    pub item: &'a Item,
    /// Location of the value in the source.
    pub span: Span,
    /// Meaning of the value.
    pub word: MappingWord<'a>,
}

/// The meaning of a mapping value.
#[derive(Clone, Copy)]
pub(crate) enum MappingWord<'a> {
    /// A mapped object: index, sub-index, length in bits.
    Object(u16, u8, u32),
    /// An empty entry, whose value is 0 or missing.
    Empty,
    /// A value that is not a 32-bit number.
    Unreadable(&'a Value),
}

/// Returns the number of mapped objects in sub-index 0 of a mapping object, or `None` if the number is unknown. The values 254
/// and 255 mean a multiplexed PDO.
pub(crate) fn announced_count(mapping: &Group) -> Option<i128> {
    mapping.sub(0).and_then(Item::initial).and_then(Value::as_int)
}

/// Returns whether the value of sub-index 0 means a multiplexed PDO.
pub(crate) fn is_multiplexed(count: Option<i128>) -> bool {
    matches!(count, Some(254 | 255))
}

/// Returns the values of a mapping object, up to the number in sub-index 0. Returns all values if this number is unknown.
pub(crate) fn mapping_values(mapping: &Group) -> impl Iterator<Item = MappingValue<'_>> {
    let count = announced_count(mapping);
    let subs = mapping.items.iter().filter_map(|item| Some((item.object()?.1, item))).filter(|(sub, _)| *sub > 0);
    let announced = subs.take_while(move |(sub, _)| count.is_none_or(|count| i128::from(*sub) <= count));
    announced.map(|(_, item)| {
        let span = item.at.others.configured.or(item.at.default).or(item.origin.span);
        let word = match item.initial() {
            Some(&Value::Int(word)) if word > 0 && word <= i128::from(u32::MAX) => {
                MappingWord::Object((word >> 16) as u16, (word >> 8) as u8, (word & 0xFF) as u32)
            }
            Some(Value::Int(0)) | None => MappingWord::Empty,
            Some(other) => MappingWord::Unreadable(other),
        };
        MappingValue { item, span, word }
    })
}

fn pdo(device: &Device, items: &MappableItems<'_>, objects: &PdoObjects<'_>) -> Option<Pdo> {
    let mapping = objects.mapping?;
    let mut pdo = Pdo {
        number: objects.number,
        name: mapping.name.clone(),
        communication: objects.communication.map(|group| communication(group, objects.index)),
        fixed: !mapping.items.iter().any(|item| item.access.writable()),
        implicit: mapping.origin.is_derived(),
        from_object: true,
        origin: mapping.origin,
        ..Pdo::new(objects.direction, objects.mapping_index())
    };
    // If the source separately declares the mapping of the PDO on EtherCAT, the mapping object applies to CANopen only.
    let declared = |other: &Pdo| other.mapping_index == pdo.mapping_index && other.buses == Some(ObjectBuses::COE);
    if device.process_data.pdos.iter().any(declared) {
        pdo.buses = Some(ObjectBuses::CANOPEN);
    }
    if !is_multiplexed(announced_count(mapping)) {
        for value in mapping_values(mapping) {
            let entry = entry(items, &value, pdo.bits());
            pdo.entries.extend(entry);
        }
    }
    Some(pdo)
}

/// Returns the PDO entry for a mapping value, or `None` if the value is empty or unreadable.
fn entry(items: &MappableItems<'_>, value: &MappingValue<'_>, bit_offset: u32) -> Option<PdoEntry> {
    let MappingWord::Object(index, sub_index, bits) = value.word else { return None };
    let mut entry = PdoEntry { bit_offset, origin: value.item.origin, ..PdoEntry::new(index, sub_index, bits) };
    if is_dummy(index) {
        entry.kind = PdoEntryKind::Padding;
    } else if let Some(item) = items.get(index, sub_index) {
        entry.kind = PdoEntryKind::Item;
        entry.ty = item.ty;
        entry.name = entry_name(item);
    }
    Some(entry)
}

/// Returns whether a mapped index is that of a data type. An entry with such an index is a dummy entry (CiA 301 7.4.7).
pub(crate) fn is_dummy(index: u16) -> bool {
    index < 0x20
}

fn communication(group: &Group, index: u16) -> PdoCommunication {
    let initial = |sub| group.sub(sub).and_then(Item::initial);
    let number = |sub| initial(sub).and_then(Value::as_int);
    let writable = group.items.iter().filter(|item| item.access.writable());
    PdoCommunication {
        index,
        cob_id: initial(1).cloned(),
        transmission_type: number(2).and_then(|value| u8::try_from(value).ok()),
        inhibit_time: number(3).and_then(|value| u16::try_from(value).ok()),
        event_timer: number(5).and_then(|value| u16::try_from(value).ok()),
        sync_start: number(6).and_then(|value| u8::try_from(value).ok()),
        writable: writable.filter_map(|item| Some(item.object()?.1)).collect(),
    }
}
