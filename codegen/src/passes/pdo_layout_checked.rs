//! After this pass the device's PDOs are in [`ProcessData`](crate::ir::ProcessData) with exact bit positions, and what
//! CiA 301 says of PDO mapping (7.5.2.36, 7.5.2.38) was checked.

use std::collections::{HashMap, HashSet};

use super::declared_pdos_checked;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{
    Access, CanOpenSettings, Device, Direction, Entries, Group, Item, Module, ObjectBuses, Pdo, PdoCommunication,
    PdoEntry, PdoEntryKind, ProcessData, Type, Value,
};
use crate::source::Span;

/// Bits of a CAN frame.
const CAN_BITS: u32 = 64;

/// PDOs of each direction in the dictionary.
const PDOS: u16 = 512;

pub(super) fn run(device: &mut Device, modules: &[Module], diagnostics: &mut Diagnostics) {
    lengths(&device.process_data, diagnostics);
    let Some(canopen) = device.canopen.take() else { return };
    let modules = OfModules::new(device, modules);
    let items = Entries::new(&device.groups);
    let mut pdos = Vec::new();
    for direction in [Direction::Receive, Direction::Transmit] {
        let first = base(direction);
        let mut present: Vec<u16> = device
            .groups
            .iter()
            .filter_map(Group::index)
            .filter_map(|index| index.checked_sub(first).filter(|&offset| offset < 2 * PDOS))
            .map(|offset| offset % PDOS)
            .collect();
        present.sort_unstable();
        present.dedup();
        let mut layout = Layout { device, items: &items, modules: &modules, canopen: &canopen, diagnostics, direction };
        pdos.extend(present.iter().filter_map(|&number| layout.pdo(number)));
        layout.counts(&present);
    }
    device.process_data.pdos.extend(pdos);
    device.canopen = Some(canopen);
}

/// Of a module: nothing but the lengths of its entries.
pub(super) fn module(module: &Module, diagnostics: &mut Diagnostics) {
    lengths(&module.process_data, diagnostics);
}

/// Those of CANopen are at most 255 bits long, and padding gets no field.
fn lengths(data: &ProcessData, diagnostics: &mut Diagnostics) {
    for pdo in &data.pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.index != 0 && entry.bits > crate::limits::MAX_FIELD_BITS) {
            let message = format!("an entry of the PDO 0x{:04X} has {} bits", pdo.mapping_index, entry.bits);
            let found = Diagnostic::new(&codes::ENTRY_TOO_LONG, entry.origin.span, message);
            diagnostics.push(found.label("the PDO gets no struct"));
        }
    }
}

/// Index of the first communication object.
fn base(direction: Direction) -> u16 {
    match direction {
        Direction::Receive => 0x1400,
        Direction::Transmit => 0x1800,
    }
}

/// What modules add to the dictionary.
struct OfModules<'a> {
    /// The items of objects that a module always brings along.
    items: HashMap<(u16, u8), &'a Item>,
    /// Objects whose number of sub-indices depends on the modules that are plugged in.
    extended: HashSet<u16>,
}

impl<'a> OfModules<'a> {
    fn new(device: &Device, modules: &'a [Module]) -> Self {
        let fixed = device.own_modules(modules).flat_map(|module| &module.fixed_objects);
        let items = fixed.flat_map(|group| &group.items).filter_map(|item| Some((item.object()?, item)));
        let extensions = device.own_modules(modules).flat_map(|module| &module.sub_extensions);
        OfModules { items: items.collect(), extended: extensions.map(|extension| extension.index).collect() }
    }
}

struct Layout<'a, 'd> {
    device: &'a Device,
    items: &'a Entries<'d>,
    modules: &'a OfModules<'a>,
    canopen: &'a CanOpenSettings,
    diagnostics: &'a mut Diagnostics,
    direction: Direction,
}

impl<'a> Layout<'a, '_> {
    /// The PDO with this number, counted from 0.
    fn pdo(&mut self, number: u16) -> Option<Pdo> {
        let index = base(self.direction) + number;
        let communication = self.device.object(index);
        let mapping = self.device.object(index + PDOS);
        self.both_halves(communication, mapping, index);
        let mapping = mapping?;
        let mut pdo = Pdo {
            number: number + 1,
            name: mapping.name.clone(),
            communication: communication.map(|group| communication_of(group, index)),
            fixed: !mapping.items.iter().any(|item| item.access.writable()),
            implicit: mapping.origin.line == 0,
            origin: mapping.origin,
            ..Pdo::new(self.direction, index + PDOS)
        };
        // Where the source says what it carries on EtherCAT, the objects' own mapping is that of CANopen.
        let declared = |own: &&Pdo| own.mapping_index == pdo.mapping_index && own.buses == Some(ObjectBuses::COE);
        if self.device.process_data.pdos.iter().any(|own| declared(&own)) {
            pdo.buses = Some(ObjectBuses::CANOPEN);
        }
        self.entries(mapping, &mut pdo);
        let bits = pdo.bits();
        if bits > CAN_BITS {
            let message = format!("the mapping 0x{:04X} has {bits} bits, and a CAN frame has 64", pdo.mapping_index);
            self.report(&codes::PDO_TOO_LONG, mapping.origin.span, message);
        }
        Some(pdo)
    }

    fn report(&mut self, code: &'static Code, span: Span, message: String) {
        self.diagnostics.push(Diagnostic::new(code, span, message));
    }

    fn both_halves(&mut self, communication: Option<&Group>, mapping: Option<&Group>, index: u16) {
        let (present, missing, what) = match (communication, mapping) {
            (Some(present), None) => (present, index + PDOS, "mapping"),
            (None, Some(present)) => (present, index, "communication parameters"),
            _ => return,
        };
        let message = format!("the PDO has no {what}: 0x{missing:04X} isn't described");
        self.report(&codes::HALF_A_PDO, present.origin.span, message);
    }

    fn entries(&mut self, mapping: &'a Group, pdo: &mut Pdo) {
        let count = mapping.sub(0).and_then(Item::initial).and_then(Value::as_int);
        if matches!(count, Some(254 | 255)) {
            return self.multiplexed(mapping);
        }
        let mut gap = None;
        for item in &mapping.items {
            let Some((_, sub @ 1..)) = item.object() else { continue };
            if count.is_some_and(|count| i128::from(sub) > count) {
                break;
            }
            let span = item.at.configured.or(item.at.default).or(item.origin.span);
            match item.initial() {
                Some(&Value::Int(word)) if word > 0 && word <= i128::from(u32::MAX) => {
                    if let Some(gap) = gap.take() {
                        let message = format!("an entry of the mapping 0x{:04X} is empty", pdo.mapping_index);
                        self.report(&codes::MAPPING_GAP, gap, message);
                    }
                    let entry = self.entry(word as u32, item, span, pdo.bits());
                    pdo.entries.push(entry);
                }
                Some(Value::Int(0)) | None => gap = gap.or(Some(span)),
                Some(other) => {
                    let message = format!("the mapping entry is {other}, which is no index, sub-index and length");
                    self.report(&codes::MAPPING_UNREADABLE, span, message);
                }
            }
        }
        self.count(mapping, count, pdo.entries.len());
    }

    fn multiplexed(&mut self, mapping: &Group) {
        if !self.canopen.group_messaging {
            let span = mapping.sub(0).map_or(mapping.origin.span, |item| item.at.default);
            let message = "the mapping is that of a multiplexed PDO, but GroupMessaging is 0".to_owned();
            self.report(&codes::MULTIPLEXED_PDO, span.or(mapping.origin.span), message);
        }
    }

    fn count(&mut self, mapping: &Group, announced: Option<i128>, found: usize) {
        let Some(announced) = announced.filter(|&announced| announced > found as i128) else { return };
        // An entry list without any value leaves the mapping to whoever configures the device.
        if found == 0 {
            return;
        }
        let span = mapping.sub(0).map_or(mapping.origin.span, |item| item.at.configured.or(item.at.default));
        let message = format!("sub-index 0 announces {announced} mapped objects, but {found} are filled in");
        self.report(&codes::MAPPING_COUNT, span.or(mapping.origin.span), message);
    }

    /// The object that a mapping word names, at the bit position `offset`.
    fn entry(&mut self, word: u32, mapping: &Item, span: Span, offset: u32) -> PdoEntry {
        let (index, sub_index, bits) = ((word >> 16) as u16, (word >> 8) as u8, word & 0xFF);
        let mut entry =
            PdoEntry { bit_offset: offset, origin: mapping.origin, ..PdoEntry::new(index, sub_index, bits) };
        self.granularity(bits, span);
        if index < 0x20 {
            self.dummy(index, span);
            entry.kind = PdoEntryKind::Padding;
            return entry;
        }
        let item = self.items.get(index, sub_index).or_else(|| self.modules.items.get(&(index, sub_index)).copied());
        match item {
            Some(item) => {
                self.mapped(item, &entry, span);
                entry.kind = PdoEntryKind::Item;
                entry.ty = item.ty;
                entry.name = super::short(&item.name);
            }
            None if self.modules.extended.contains(&index) => {}
            None => {
                let message = format!("0x{index:04X} sub-index {sub_index:#x} is mapped, but not described");
                self.report(&codes::MAPPED_OBJECT_MISSING, span, message);
            }
        }
        entry
    }

    fn granularity(&mut self, bits: u32, span: Span) {
        let granularity = u32::from(self.canopen.granularity.unwrap_or(1).clamp(1, 64));
        // 1 is also how tools say "yes, mapping can be changed".
        if granularity > 1 && !bits.is_multiple_of(granularity) {
            let message = format!("{bits} bits are mapped, but the granularity is {granularity} bits");
            self.report(&codes::GRANULARITY, span, message);
        }
    }

    fn dummy(&mut self, index: u16, span: Span) {
        if self.direction == Direction::Transmit {
            self.report(&codes::DUMMY_IN_TPDO, span, format!("a TPDO maps the dummy entry 0x{index:04X}"));
        } else if self.canopen.dummies_given && !self.canopen.dummies.contains(&(index as u8)) {
            let message = format!("the dummy entry 0x{index:04X} is mapped, but [DummyUsage] doesn't allow it");
            self.report(&codes::DUMMY_NOT_SUPPORTED, span, message);
        }
    }

    fn mapped(&mut self, item: &Item, entry: &PdoEntry, span: Span) {
        let object = format!("0x{:04X} sub-index {:#x}", entry.index, entry.sub_index);
        if !item.mappable.any() {
            self.mapped_report(item, &codes::NOT_MAPPABLE, span, format!("{object} is mapped, but not mappable"));
        }
        let fits = declared_pdos_checked::goes(item, self.direction);
        if item.access == Access::ReadWrite && item.mappable.rpdo == item.mappable.tpdo {
            let message = format!("{object} is rw, which doesn't say that it goes into {}", self.pdo_name());
            self.mapped_report(item, &codes::UNCLEAR_DIRECTION, span, message);
        }
        if !fits {
            let (pdo, access) = (self.pdo_name(), item.access.name());
            let message = format!("{object} is {access} and can't be mapped into {pdo}");
            self.mapped_report(item, &codes::WRONG_DIRECTION, span, message);
        }
        // Bit fields and enumerations are as long as their integer.
        let owner = Owner::of_types(&self.device.types);
        let is_own = self.items.get(entry.index, entry.sub_index).is_some();
        let ty = if is_own { owner.basic(item.object_type()) } else { item.ty };
        match ty.bits() {
            Some(bits) if bits != entry.bits => {
                let message = format!("{object} is mapped with {} bits, but {ty} has {bits}", entry.bits);
                self.mapped_report(item, &codes::MAPPED_LENGTH, span, message);
            }
            None if !matches!(item.ty, Type::Opaque(_) | Type::Named(_)) => {
                let message = format!("{object} is a {} and has no fixed length", item.ty);
                self.mapped_report(item, &codes::UNMAPPABLE_TYPE, span, message);
            }
            _ => {}
        }
    }

    fn mapped_report(&mut self, item: &Item, code: &'static Code, span: Span, message: String) {
        let mut diagnostic = Diagnostic::new(code, span, message);
        if !item.origin.span.is_empty() {
            diagnostic = diagnostic.note_at(item.origin.span, "the mapped object");
        }
        self.diagnostics.push(diagnostic);
    }

    fn pdo_name(&self) -> &'static str {
        match self.direction {
            Direction::Receive => "an RPDO",
            Direction::Transmit => "a TPDO",
        }
    }

    /// Holds the number of PDOs against the header and object 0x1004.
    fn counts(&mut self, present: &[u16]) {
        let (announced, key, span) = match self.direction {
            Direction::Receive => (self.canopen.rx_pdos, "NrOfRXPDO", self.canopen.at.rx_pdos),
            Direction::Transmit => (self.canopen.tx_pdos, "NrOfTXPDO", self.canopen.at.tx_pdos),
        };
        let Some(announced) = announced else { return };
        if usize::from(announced) != present.len() && !self.device.groups.is_empty() {
            let message = format!("{key} is {announced}, but {} PDOs are described", present.len());
            self.report(&codes::PDO_COUNT, span.or(self.device.origin.span), message);
        }
        let Some(item) = self.device.entry(0x1004, 0) else { return };
        let Some(value) = item.initial().and_then(Value::as_int) else { return };
        let counted = match self.direction {
            Direction::Receive => value >> 16 & 0xFFFF,
            Direction::Transmit => value & 0xFFFF,
        };
        if counted != i128::from(announced) {
            let span = item.at.configured.or(item.at.default).or(item.origin.span);
            self.report(&codes::PDO_COUNT_1004, span, format!("0x1004 says {counted}, {key} says {announced}"));
        }
    }
}

fn communication_of(group: &Group, index: u16) -> PdoCommunication {
    let initial = |sub| group.sub(sub).and_then(Item::initial);
    let number = |sub| initial(sub).and_then(Value::as_int);
    PdoCommunication {
        index,
        cob_id: initial(1).cloned(),
        transmission_type: number(2).and_then(|value| u8::try_from(value).ok()),
        inhibit_time: number(3).and_then(|value| u16::try_from(value).ok()),
        event_timer: number(5).and_then(|value| u16::try_from(value).ok()),
        sync_start: number(6).and_then(|value| u8::try_from(value).ok()),
        writable: group
            .items
            .iter()
            .filter(|item| item.access.writable())
            .filter_map(|item| Some(item.object()?.1))
            .collect(),
    }
}
