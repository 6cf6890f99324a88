//! Reads the process data of a table.

use super::at::At;
use super::buses;
use super::format::PdoTable;
use super::notation;
use super::tree::Reader;
use super::types;
use crate::diagnostics::codes;
use crate::ir::{Device, Direction, Entries, Item, ItemNames, ObjectBuses, Pdo, PdoEntry, PdoEntryKind, Type};
use crate::number::hex16;
use crate::text::brief;

/// Maximum number of PDOs of a device in one direction (CiA 301 7.5.2.35).
const MAX_EXCLUDED: usize = 512;

/// Reads a PDO direction, as seen from the device.
pub(super) fn direction(reader: &mut Reader<'_, '_>, given: Option<&At<String>>) -> Option<Direction> {
    reader.word(given?, "PDO direction", &[("rx", Direction::Receive), ("tx", Direction::Transmit)])
}

/// Objects and items to which PDO entries may refer.
pub(super) struct Targets<'d> {
    device: &'d Device,
    entries: Entries<'d>,
    names: ItemNames<'d>,
}

impl<'d> Targets<'d> {
    pub fn new(device: &'d Device) -> Self {
        Targets { device, entries: Entries::new(&device.groups), names: ItemNames::new(&device.groups) }
    }

    /// Returns the first item called `name`, or the item at the path `name` (`Chapter/Item`).
    fn by_name(&self, name: &str) -> Option<&'d Item> {
        self.names.by_name(name).or_else(|| self.names.by_path(name))
    }
}

/// Reads an element of `[[pdos]]`. Reports an element without an index or a direction, and returns `None`.
pub(super) fn pdo(reader: &mut Reader<'_, '_>, table: &At<PdoTable>, targets: &Targets<'_>) -> Option<Pdo> {
    let given = &table.value;
    let direction = direction(reader, given.direction.as_ref());
    let (Some(index), Some(direction)) = (&given.index, direction) else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "a PDO needs an `index` and a `direction`");
        return None;
    };
    let mut pdo = Pdo::new(direction, index.value);
    pdo.origin = reader.origin(table);
    pdo.name = given.name.as_deref().unwrap_or_default().into();
    (pdo.fixed, pdo.mandatory) = (given.fixed, given.mandatory);
    if let Some(sm) = given.sm.as_ref().filter(|_| !given.default) {
        let found = codes::TABLE_VALUE.at(reader.span(sm), "`sm` applies only to a PDO that is assigned by default");
        reader.diagnostics.push(found.help("add `default = true`, or delete `sm`"));
    }
    pdo.sync_manager = given.sm.as_ref().map(|sm| sm.value).filter(|_| given.default);
    for excluded in &given.excludes {
        match notation::objects(&excluded.to_string()).map(|objects| objects.indices) {
            Some((first, last)) if usize::from(last.saturating_sub(first)) + pdo.excludes.len() > MAX_EXCLUDED => {
                let message = format!("`excludes` has more than {MAX_EXCLUDED} PDOs, the maximum of a device");
                reader.report(&codes::TABLE_VALUE, reader.span(table), message);
            }
            Some((first, last)) => pdo.excludes.extend((first..=last).filter(|&other| other != index.value)),
            None => reader.report(&codes::TABLE_PLACE, reader.span(table), "`excludes` must contain indices of PDOs"),
        }
    }
    if let Some(list) = &given.buses {
        let buses = buses::read(reader, list);
        pdo.buses = Some(buses.with_objects());
        if buses.with_objects() == ObjectBuses::NONE {
            let message = "the PDO is on neither CANopen nor EtherCAT";
            reader.report(&codes::TABLE_VALUE, reader.span(table), message);
        }
    }
    pdo.documentation = reader.documentation_of(given);
    pdo.max_bytes = given.max;
    pdo.doubts = reader.doubts_of(given, pdo.origin);
    let mut bit_offset = 0u32;
    for text in &given.entries {
        if let Some(entry) = entry(reader, text, targets) {
            let end = bit_offset.saturating_add(entry.bits);
            pdo.entries.push(PdoEntry { bit_offset, ..entry });
            bit_offset = end;
        }
    }
    printed_lengths(reader, given, &pdo);
    Some(pdo)
}

/// Compares the lengths that the manual prints for a PDO with the length of all its entries.
fn printed_lengths(reader: &mut Reader<'_, '_>, table: &PdoTable, pdo: &Pdo) {
    let Some(printed) = &table.length else { return };
    let (index, bits) = (pdo.mapping_index, pdo.bits());
    for bytes in printed.value.0.iter().filter(|bytes| bytes.saturating_mul(8) != bits) {
        let message =
            format!("the manual states {bytes} bytes for the PDO {}, but its entries have {bits} bits", hex16(index));
        reader.report(&codes::LENGTH_MISMATCH, reader.span(printed), message);
    }
}

/// Reads a PDO entry: `0x6040:0/16`, `item`, `item/16`, `pad/8`, `? name/16`, `? name/i16`.
fn entry(reader: &mut Reader<'_, '_>, text: &At<String>, targets: &Targets<'_>) -> Option<PdoEntry> {
    let (what, length) = match text.value.rsplit_once('/') {
        Some((what, length)) => (what.trim(), Some(length)),
        None => (text.value.trim(), None),
    };
    let bits = length.and_then(notation::integer).and_then(|bits| u32::try_from(bits).ok());
    let origin = reader.origin(text);
    if what == "pad" {
        let bits = bits.filter(|&bits| bits > 0);
        if bits.is_none() {
            let (message, help) = ("padding needs a length", "write the number of bits, as in `pad/8`");
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(text), message, help);
        }
        return Some(PdoEntry { origin, kind: PdoEntryKind::Padding, ..PdoEntry::new(0, 0, bits?) });
    }
    if let Some(name) = what.strip_prefix('?').map(str::trim) {
        let ty = length.and_then(types::single).unwrap_or(Type::Opaque(None));
        let bits = bits.or(ty.bits()).filter(|&bits| bits > 0 && !name.is_empty());
        if bits.is_none() {
            let message = "a PDO entry without an object needs a name, and a length or type";
            let help = "write the length as in `? torque limit/16`, or the type as in `? torque limit/i16`";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(text), message, help);
        }
        let entry = PdoEntry { ty, ..PdoEntry::new(0, 0, bits?) };
        return Some(PdoEntry { origin, kind: PdoEntryKind::Unnumbered, name: name.into(), ..entry });
    }
    let by_name = || targets.by_name(what);
    let by_address = || {
        let found = notation::objects(what).filter(|objects| objects.indices.0 == objects.indices.1)?;
        Some((found.indices.0, found.subs.map_or(0, |(first, _)| first)))
    };
    let Some((index, sub_index)) = by_address().or_else(|| by_name().and_then(Item::object)) else {
        if by_name().is_some() {
            let message = format!("`{}` has no object address, but PDOs map only objects", brief(what));
            let found = codes::UNRESOLVED_NAME.at(reader.span(text), message);
            reader.diagnostics.push(found.help("add `obj` to the row, or a rule for CANopen or EtherCAT to its space"));
            return None;
        }
        let names = targets.device.groups.iter().flat_map(|group| &group.items).map(|item| item.name.as_str());
        reader.unresolved("object", what, reader.span(text), names);
        return None;
    };
    let item = targets.entries.get(index, sub_index);
    let known = item.and_then(|item| match item.object_type() {
        Type::Named(id) => targets.device.types.get(id.0 as usize).and_then(|def| def.bits),
        ty => ty.bits(),
    });
    let Some(bits) = bits.or(known).filter(|&bits| bits > 0) else {
        let message = format!("the length of `{}` is unknown", brief(what));
        let help = format!("write the number of bits, as in `{}/16`", brief(what));
        reader.report_with_help(&codes::TABLE_PLACE, reader.span(text), message, help);
        return None;
    };
    let mut entry = PdoEntry { origin, ..PdoEntry::new(index, sub_index, bits) };
    if let Some(item) = item {
        entry.name = item.name.clone();
        entry.ty = item.ty;
        entry.kind = PdoEntryKind::Item;
    }
    Some(entry)
}
