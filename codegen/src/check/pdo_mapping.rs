//! PDO mapping objects in a CANopen dictionary: rules of CiA 301 7.5.2.36 and 7.5.2.38, and comparison with the mapped items.

use super::context::{Context, PdoOwner};
use super::mapped_object::{pdo_name, wrong_direction, CAN_BITS};
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::{Access, CanOpenSettings, Direction, Group, Item, Type, Value};
use crate::number::{hex16, sub_entry};
use crate::resolve::{
    announced_count, is_dummy, is_multiplexed, mapping_values, MappableItems, MappingValue, MappingWord, PdoObjects,
};
use crate::source::Span;
use crate::text::count_of;

/// Reports invalid PDO mappings and wrong numbers of PDOs of a CANopen device.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Some(canopen) = &context.device.canopen else { return };
    let items = MappableItems::new(context.device, context.modules);
    for direction in [Direction::Receive, Direction::Transmit] {
        let mut mapping = Mapping { context, items: &items, canopen, diagnostics, direction };
        for objects in PdoObjects::of_direction(context.device, direction) {
            mapping.pdo(&objects);
        }
        mapping.counts();
    }
}

/// Reports entries that are too long for a field of a generated struct. Such entries cannot occur on CANopen, where an entry has
/// at most 255 bits. Padding is not checked, because padding has no field.
pub(super) fn lengths(owner: &PdoOwner<'_>, diagnostics: &mut Diagnostics) {
    for pdo in &owner.data.pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.index != 0 && entry.bits > crate::limits::MAX_FIELD_BITS) {
            let (index, bits, max) = (hex16(pdo.mapping_index), entry.bits, crate::limits::MAX_FIELD_BITS);
            let message = format!("an entry of the PDO {index} has {bits} bits, but at most {max} are possible");
            diagnostics
                .push(codes::ENTRY_TOO_LONG.at(entry.origin.span, message).label("no struct is generated for the PDO"));
        }
    }
}

struct Mapping<'a, 'd> {
    context: &'a Context<'d>,
    items: &'a MappableItems<'d>,
    canopen: &'a CanOpenSettings,
    diagnostics: &'a mut Diagnostics,
    direction: Direction,
}

impl Mapping<'_, '_> {
    fn pdo(&mut self, objects: &PdoObjects<'_>) {
        self.both_halves(objects);
        let Some(mapping) = objects.mapping else { return };
        let count = announced_count(mapping);
        if is_multiplexed(count) {
            return self.multiplexed(mapping);
        }
        let bits = self.values(mapping, objects.mapping_index());
        if bits > CAN_BITS {
            let index = hex16(objects.mapping_index());
            let message = format!("the mapping {index} has {bits} bits, but a CAN frame carries at most 64 data bits");
            self.report(&codes::PDO_TOO_LONG, mapping.origin.span, message);
        }
    }

    fn report(&mut self, code: &'static Code, span: Span, message: String) {
        self.diagnostics.push(code.at(span, message));
    }

    fn both_halves(&mut self, objects: &PdoObjects<'_>) {
        let (present, missing, what) = match (objects.communication, objects.mapping) {
            (Some(present), None) => (present, objects.mapping_index(), "mapping"),
            (None, Some(present)) => (present, objects.index, "communication parameters"),
            _ => return,
        };
        let message = format!("the PDO has no {what}: {} is not described", hex16(missing));
        self.report(&codes::HALF_A_PDO, present.origin.span, message);
    }

    /// Checks the entries of a mapping object, and returns their total length in bits.
    fn values(&mut self, mapping: &Group, index: u16) -> u32 {
        let (mut gap, mut bits, mut found) = (None, 0u32, 0);
        for value in mapping_values(mapping) {
            match value.word {
                MappingWord::Object(.., length) => {
                    if let Some(gap) = gap.take() {
                        let message =
                            format!("an entry of the mapping {} is empty, but later entries are not", hex16(index));
                        self.report(&codes::MAPPING_GAP, gap, message);
                    }
                    self.object(&value);
                    bits = bits.saturating_add(length);
                    found += 1;
                }
                MappingWord::Empty => gap = gap.or(Some(value.span)),
                MappingWord::Unreadable(other) => {
                    let message = format!("the mapping entry {other} does not consist of index, sub-index and length");
                    self.report(&codes::MAPPING_UNREADABLE, value.span, message);
                }
            }
        }
        self.count(mapping, found);
        bits
    }

    fn multiplexed(&mut self, mapping: &Group) {
        if !self.canopen.group_messaging {
            let span = mapping.sub(0).map_or(mapping.origin.span, |item| item.at.default);
            let message = "the PDO mapping is multiplexed, but GroupMessaging is 0".to_owned();
            self.report(&codes::MULTIPLEXED_PDO, span.or(mapping.origin.span), message);
        }
    }

    fn count(&mut self, mapping: &Group, found: usize) {
        let Some(announced) = announced_count(mapping).filter(|&announced| announced > found as i128) else { return };
        // A mapping object whose entries have no values is configured at run time.
        if found == 0 {
            return;
        }
        let span = mapping.sub(0).map_or(mapping.origin.span, |item| item.at.others.configured.or(item.at.default));
        let message = format!(
            "sub-index 0 declares {}, but the number of entries with a value is only {found}",
            count_of(announced, "mapped object")
        );
        self.report(&codes::MAPPING_COUNT, span.or(mapping.origin.span), message);
    }

    /// Checks the object to which a mapping value refers.
    fn object(&mut self, value: &MappingValue<'_>) {
        let MappingWord::Object(index, sub_index, bits) = value.word else { return };
        let span = value.span;
        self.granularity(bits, span);
        if is_dummy(index) {
            return self.dummy(index, span);
        }
        match self.items.get(index, sub_index) {
            Some(item) => self.mapped(item, (index, sub_index, bits), span),
            None if self.items.is_extended(index) => {}
            None => {
                let message = format!("{} is mapped, but not described", sub_entry(index, sub_index));
                self.report(&codes::MAPPED_OBJECT_MISSING, span, message);
            }
        }
    }

    fn granularity(&mut self, bits: u32, span: Span) {
        let granularity = u32::from(self.canopen.granularity.unwrap_or(1).clamp(1, 64));
        // Every length is a multiple of granularity 1, so only greater values are checked.
        if granularity > 1 && !bits.is_multiple_of(granularity) {
            let message = format!(
                "the mapping entry has {}, but the granularity of the device is {granularity} bits",
                count_of(bits, "bit")
            );
            self.report(&codes::GRANULARITY, span, message);
        }
    }

    fn dummy(&mut self, index: u16, span: Span) {
        if self.direction == Direction::Transmit {
            self.report(&codes::DUMMY_IN_TPDO, span, format!("a TPDO maps the dummy entry {}", hex16(index)));
        } else if self.canopen.dummies_given && !self.canopen.dummies.contains(&(index as u8)) {
            let message = format!("the dummy entry {} is mapped, but [DummyUsage] does not allow it", hex16(index));
            self.report(&codes::DUMMY_NOT_SUPPORTED, span, message);
        }
    }

    fn mapped(&mut self, item: &Item, mapped: (u16, u8, u32), span: Span) {
        let (index, sub_index, bits) = mapped;
        let object = sub_entry(index, sub_index);
        if !item.mappable.any() {
            self.mapped_report(item, &codes::NOT_MAPPABLE, span, format!("{object} is mapped, but not mappable"));
        }
        if item.access == Access::ReadWrite && item.mappable.rpdo && item.mappable.tpdo {
            let message = format!(
                "{object} has the access type rw, which does not state whether the object can be mapped into {}",
                pdo_name(self.direction)
            );
            self.mapped_report(item, &codes::UNCLEAR_DIRECTION, span, message);
        }
        if let Some(problem) = wrong_direction(item, self.direction) {
            self.mapped_report(item, &codes::WRONG_DIRECTION, span, format!("{object} {problem}"));
        }
        // The length of a bit field or an enumeration is that of its integer type.
        let is_of_device = self.items.of_device(index, sub_index).is_some();
        let ty = if is_of_device { self.context.owner.basic(item.object_type()) } else { item.ty };
        match ty.bits() {
            Some(length) if length != bits => {
                let message = format!("{object} is mapped with {}, but {ty} has {length}", count_of(bits, "bit"));
                self.mapped_report(item, &codes::MAPPED_LENGTH, span, message);
            }
            None if !matches!(item.ty, Type::Opaque(_) | Type::Named(_)) => {
                let message = format!("{object} has the type {}, which has no fixed length", item.ty);
                self.mapped_report(item, &codes::UNMAPPABLE_TYPE, span, message);
            }
            _ => {}
        }
    }

    fn mapped_report(&mut self, item: &Item, code: &'static Code, span: Span, message: String) {
        let mut diagnostic = code.at(span, message);
        if !item.origin.span.is_empty() {
            diagnostic = diagnostic.note_at(item.origin.span, "the mapped object");
        }
        self.diagnostics.push(diagnostic);
    }

    /// Compares the number of PDOs in the file header with the number of described PDOs, and with object 0x1004.
    fn counts(&mut self) {
        let device = self.context.device;
        let described = PdoObjects::numbers(device, self.direction).len();
        let (announced, key, span) = match self.direction {
            Direction::Receive => (self.canopen.rx_pdos, "NrOfRXPDO", self.canopen.at.rx_pdos),
            Direction::Transmit => (self.canopen.tx_pdos, "NrOfTXPDO", self.canopen.at.tx_pdos),
        };
        let Some(announced) = announced else { return };
        if usize::from(announced) != described && !device.groups.is_empty() {
            let message = format!("{key} is {announced}, but the number of described PDOs is {described}");
            self.report(&codes::PDO_COUNT, span.or(device.origin.span), message);
        }
        let Some(item) = device.entry(0x1004, 0) else { return };
        let Some(value) = item.initial().and_then(Value::as_int) else { return };
        let (counted, noun) = match self.direction {
            Direction::Receive => (value >> 16 & 0xFFFF, "RPDO"),
            Direction::Transmit => (value & 0xFFFF, "TPDO"),
        };
        if counted != i128::from(announced) {
            let span = item.at.others.configured.or(item.at.default).or(item.origin.span);
            let message = format!("0x1004 declares {}, but {key} is {announced}", count_of(counted, noun));
            self.report(&codes::PDO_COUNT_1004, span, message);
        }
    }
}
