//! Writes the values that configure the PDOs of a node (CiA 301 7.5.2.35 to 7.5.2.38).

use lexibus_codegen::diagnostics::{codes, Diagnostic};
use lexibus_codegen::facts::pdo::mapped_bits;
use lexibus_codegen::ir::{CanOpenSettings, Direction, Type};
use lexibus_codegen::number::hex16;
use lexibus_codegen::source::Span;

use super::cob_ids::CobIds;
use super::mapping::unmappable;
use super::object::find;
use super::pdo_values::{direction, pdos};
use super::writer::Writer;
use crate::declared::{DeclaredNode, DeclaredPdo, ObjectName};
use crate::model::{MappedObject, NetworkPdo, DISABLED};
use crate::syntax::At;

/// Writes the PDOs that the file declares. Reports PDOs that the device does not have.
pub(super) fn write(node: &DeclaredNode, cob_ids: &CobIds, writer: &mut Writer<'_>) {
    let pdos = pdos(writer.initial());
    for declared in &node.pdos {
        let (direction, number) = (direction(declared), declared.number.value);
        match pdos.iter().find(|pdo| pdo.direction == direction && pdo.number == number) {
            Some(pdo) => configure(pdo, declared, cob_ids.of(&node.name.value, direction, number), writer),
            None => missing(declared, &pdos, writer),
        }
    }
}

fn missing(declared: &DeclaredPdo, pdos: &[NetworkPdo], writer: &mut Writer<'_>) {
    let name = if declared.is_tpdo { "TPDO" } else { "RPDO" };
    let numbers = pdos.iter().filter(|pdo| pdo.direction == direction(declared)).map(|pdo| pdo.number.to_string());
    let numbers: Vec<String> = numbers.take(16).collect();
    let message = format!("the device has no {name} {}", declared.number.value);
    let help = match numbers.is_empty() {
        true => format!("remove the PDO: the device has no {name}s"),
        false => format!("use one of the {name}s {}", numbers.join(", ")),
    };
    writer.diagnostics.push(Diagnostic::new(&codes::NO_SUCH_PDO, declared.number.span, message).help(help));
}

/// Configures a PDO as declared. Writes the disabled COB-ID and the changed parameters, then a declared mapping. Enables the
/// PDO last, unless the file disables it. If bit 31 of `cob_id` is set, only disables the PDO.
fn configure(pdo: &NetworkPdo, declared: &DeclaredPdo, cob_id: u32, writer: &mut Writer<'_>) {
    let index = pdo.index();
    let span = declared.cob_id.as_ref().map_or(declared.number.span, |cob_id| cob_id.span);
    if pdo.cob_id != cob_id | DISABLED {
        writer.write((index, 1), cob_id | DISABLED, span);
    }
    if cob_id & DISABLED != 0 {
        return;
    }
    parameters(pdo, declared, writer);
    if let Some(objects) = &declared.mapping {
        write_mapping(pdo, objects, writer);
    }
    if declared.enabled {
        writer.write((index, 1), cob_id, span);
    }
}

/// Writes the declared transmission type, timers and SYNC start value if they differ from the description or if the description
/// does not state them. The timers and the SYNC start value of an RPDO's sender, and the deadline of a TPDO's receiver, are not
/// written to the node.
fn parameters(pdo: &NetworkPdo, declared: &DeclaredPdo, writer: &mut Writer<'_>) {
    let index = pdo.index();
    writer.change((index, 2), declared.transmission.as_ref());
    match pdo.direction {
        Direction::Transmit => {
            writer.change((index, 3), declared.inhibit_time.as_ref());
            writer.change((index, 5), declared.event_timer.as_ref());
            writer.change((index, 6), declared.sync_start.as_ref());
        }
        Direction::Receive => writer.change((index, 5), declared.event_deadline.as_ref()),
    }
}

fn write_mapping(pdo: &NetworkPdo, objects: &At<Vec<At<ObjectName>>>, writer: &mut Writer<'_>) {
    let index = pdo.index() + 0x200;
    let entries: Vec<(MappedObject, Span)> =
        objects.value.iter().filter_map(|object| Some((mapped(pdo.direction, object, writer)?, object.span))).collect();
    let is_empty = writer.initial().get((index, 0)).is_none_or(|count| count == 0);
    if !is_empty || !entries.is_empty() {
        writer.write((index, 0), 0, objects.span);
    }
    for (entry, sub_index) in entries.iter().zip(1..=u8::MAX) {
        let (entry, span) = *entry;
        writer.write((index, sub_index), entry.word(), span);
    }
    if !entries.is_empty() {
        writer.write((index, 0), entries.len() as i128, objects.span);
    }
}

/// Returns the mapping entry for an object. Reports an object that is not found, and an object whose length is unknown
/// or too long for a mapping entry.
fn mapped(direction: Direction, object: &At<ObjectName>, writer: &mut Writer<'_>) -> Option<MappedObject> {
    if let ObjectName::Address(code @ 1..=0x1B, 0) = object.value {
        return dummy(direction, code, object.span, writer);
    }
    let (item, address) = find(writer.device, object, writer.diagnostics)?;
    let bits = mapped_bits(item, &writer.device.types);
    if bits.is_none() {
        let message = unmappable(item, address, direction);
        let found = Diagnostic::new(&codes::UNMAPPABLE_OBJECT, object.span, message);
        writer.diagnostics.push(found.label("its type has no fixed length from 1 to 255 bits"));
    }
    Some(MappedObject { index: address.0, sub_index: address.1, bits: u8::try_from(bits?).ok()? })
}

/// Returns the mapping entry for a data type, which reserves space in an RPDO (CiA 301 7.4.7). Reports a dummy entry in a
/// TPDO. Also reports a data type that has no fixed length or that the device does not support as a dummy entry.
fn dummy(direction: Direction, code: u16, span: Span, writer: &mut Writer<'_>) -> Option<MappedObject> {
    let Some(bits) = Type::from_cia301(code.into()).and_then(Type::bits) else {
        let message = format!("the data type {} has no fixed length, so it cannot be a dummy entry", hex16(code));
        let found = Diagnostic::new(&codes::NETWORK_VALUE, span, message);
        writer.diagnostics.push(found.help("write a data type with a fixed length, such as `0x0005` (UNSIGNED8)"));
        return None;
    };
    let settings = writer.device.canopen.as_deref().filter(|settings| settings.dummies_given);
    let refused = |settings: &&CanOpenSettings| !settings.dummies.iter().any(|allowed| u16::from(*allowed) == code);
    let message = format!("the dummy entry {} cannot be mapped", hex16(code));
    let found = Diagnostic::new(&codes::UNMAPPABLE_OBJECT, span, message);
    if direction == Direction::Transmit {
        let found = found.label("a TPDO cannot contain dummy entries");
        writer.diagnostics.push(found.help("map an object of the device instead"));
    } else if let Some(settings) = settings.filter(refused) {
        let allowed: Vec<String> = settings.dummies.iter().map(|code| format!("`{}`", hex16(*code))).collect();
        writer.diagnostics.push(match allowed.is_empty() {
            true => found.label("the device supports no dummy entries ([DummyUsage])").help("remove the entry"),
            false => found
                .label("the description does not allow this data type ([DummyUsage])")
                .help(format!("use one of the data types {}", allowed.join(", "))),
        });
    }
    Some(MappedObject { index: code, sub_index: 0, bits: bits as u8 })
}
