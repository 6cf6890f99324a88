//! Resolves the PDOs of a node, and the values that configure them (CiA 301 7.5.2.35 to 7.5.2.38).

use lexibus_codegen::diagnostics::{codes, Diagnostic};
use lexibus_codegen::facts::number::hex16;
use lexibus_codegen::facts::pdo::{mappable, mapped_bits, mapped_objects};
use lexibus_codegen::ir::{CanOpenSettings, Direction, Type};
use lexibus_codegen::source::Span;

use super::cob_ids::CobIds;
use super::described::{described, direction, initial, multiplexed_name};
use super::object::find;
use super::writer::{title, Writer};
use crate::declared::{DeclaredNode, DeclaredPdo, ObjectName};
use crate::model::{MappedObject, NetworkPdo, DISABLED};
use crate::syntax::At;

/// Maximum length of a PDO on CAN in bits.
const MAX_BITS: u32 = 64;

/// Resolves all PDOs of a node, and writes those that the file declares.
pub(super) fn resolve(node: &DeclaredNode, cob_ids: &CobIds, writer: &mut Writer<'_>) -> Vec<NetworkPdo> {
    let mut pdos: Vec<NetworkPdo> = [Direction::Receive, Direction::Transmit]
        .into_iter()
        .flat_map(|direction| described(writer.device, direction, writer.id))
        .collect();
    for declared in &node.pdos {
        let (direction, number) = (direction(declared), declared.number.value);
        match pdos.iter_mut().find(|pdo| pdo.direction == direction && pdo.number == number) {
            Some(pdo) => configure(pdo, declared, cob_ids.of(&node.name.value, direction, number), writer),
            None => missing(declared, &pdos, writer),
        }
    }
    for pdo in &mut pdos {
        pdo.is_enabled = pdo.cob_id & DISABLED == 0 && !pdo.entries.is_empty();
        if pdo.cob_id & DISABLED == 0 && pdo.entries.is_empty() {
            multiplexed(pdo, node, writer);
        }
    }
    pdos
}

/// Reports a multiplexed PDO, which the output files do not contain.
fn multiplexed(pdo: &NetworkPdo, node: &DeclaredNode, writer: &mut Writer<'_>) {
    let count = initial(writer.device, (pdo.index() + 0x200, 0), writer.id);
    let Some(name) = count.and_then(multiplexed_name) else { return };
    let message =
        format!("{} of `{}` is multiplexed ({name}), so the network leaves it out", pdo.title(), node.name.value);
    let found = Diagnostic::new(&codes::MULTIPLEXED_NETWORK_PDO, pdo.span.or(node.name.span), message);
    let kind = if pdo.direction == Direction::Transmit { "tpdo" } else { "rpdo" };
    let help = format!("declare `map` in `{kind}.{}`, or disable the PDO with `enabled = false`", pdo.number);
    writer.diagnostics.push(found.help(help));
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

/// Applies the declaration of a PDO, and writes the changed values: disable the PDO, set the parameters, clear the mapping, write the
/// mapping, enable the PDO.
fn configure(pdo: &mut NetworkPdo, declared: &DeclaredPdo, cob_id: u32, writer: &mut Writer<'_>) {
    let index = pdo.index();
    let span = declared.cob_id.as_ref().map_or(declared.number.span, |cob_id| cob_id.span);
    (pdo.span, pdo.cob_id_at) = (declared.number.span, span);
    if pdo.cob_id != cob_id | DISABLED {
        writer.write((index, 1), cob_id | DISABLED, span);
    }
    pdo.cob_id = cob_id;
    if cob_id & DISABLED != 0 {
        return;
    }
    parameters(pdo, declared, writer);
    if let Some(objects) = &declared.mapping {
        write_mapping(pdo, objects, writer);
    }
    if declared.enabled {
        writer.write((index, 1), cob_id, span);
    } else {
        pdo.cob_id |= DISABLED;
    }
}

/// Writes transmission type and timers that differ from the description. Timers of the other side of an RPDO or TPDO belong to the
/// master, and are not written to the node.
fn parameters(pdo: &mut NetworkPdo, declared: &DeclaredPdo, writer: &mut Writer<'_>) {
    fn change<T: Copy + Into<i128>>(
        current: &mut T,
        given: &Option<At<T>>,
        object: Option<(u16, u8)>,
        writer: &mut Writer<'_>,
    ) {
        let Some(given) = given else { return };
        *current = given.value;
        if let Some(object) = object {
            writer.change(object, Some(given));
        }
    }
    let (index, pdo_direction) = (pdo.index(), pdo.direction);
    let of = |direction, sub_index| (pdo_direction == direction).then_some((index, sub_index));
    change(&mut pdo.transmission, &declared.transmission, Some((index, 2)), writer);
    change(&mut pdo.inhibit_time, &declared.inhibit_time, of(Direction::Transmit, 3), writer);
    change(&mut pdo.event_timer, &declared.event_timer, of(Direction::Transmit, 5), writer);
    change(&mut pdo.event_deadline, &declared.event_deadline, of(Direction::Receive, 5), writer);
    change(&mut pdo.sync_start, &declared.sync_start, of(Direction::Transmit, 6), writer);
}

fn write_mapping(pdo: &mut NetworkPdo, objects: &At<Vec<At<ObjectName>>>, writer: &mut Writer<'_>) {
    let index = pdo.index() + 0x200;
    let entries: Vec<(MappedObject, Span)> =
        objects.value.iter().filter_map(|object| Some((mapped(pdo.direction, object, writer)?, object.span))).collect();
    let is_empty = initial(writer.device, (index, 0), writer.id).is_none_or(|count| count == 0);
    if !is_empty || !entries.is_empty() {
        writer.write((index, 0), 0, objects.span);
    }
    for (entry, sub_index) in entries.iter().zip(1..=u8::MAX) {
        let (MappedObject { index: object, sub_index: sub, bits }, span) = *entry;
        let word = u32::from(object) << 16 | u32::from(sub) << 8 | u32::from(bits);
        writer.write((index, sub_index), word, span);
    }
    if !entries.is_empty() {
        writer.write((index, 0), entries.len() as i128, objects.span);
    }
    pdo.entries = entries.into_iter().map(|(entry, _)| entry).collect();
    if pdo.bits() > MAX_BITS {
        let message = format!("{} maps {} bits, but a PDO has at most {MAX_BITS}", pdo.title(), pdo.bits());
        let found = Diagnostic::new(&codes::PDO_LENGTH, objects.span, message);
        writer.diagnostics.push(found.help("move objects to another PDO"));
    }
}

/// Returns the entry for an object. Reports an object that a PDO of this direction cannot map.
fn mapped(direction: Direction, object: &At<ObjectName>, writer: &mut Writer<'_>) -> Option<MappedObject> {
    if let ObjectName::Address(code @ 1..=0x1B, 0) = object.value {
        return dummy(direction, code, object.span, writer);
    }
    let (item, address) = find(writer.device, object, writer.diagnostics)?;
    let able = mappable(item, &mapped_objects(&writer.device.process_data.pdos));
    let (is_able, name) = match direction {
        Direction::Receive => (able.rpdo, "an RPDO"),
        Direction::Transmit => (able.tpdo, "a TPDO"),
    };
    let bits = mapped_bits(item, &writer.device.types);
    if !is_able || bits.is_none() {
        let message = format!("{} cannot be mapped in {name}", title(item, address));
        let found = Diagnostic::new(&codes::UNMAPPABLE_OBJECT, object.span, message);
        let reason = match bits {
            None => "its type has no fixed length".to_owned(),
            Some(_) => format!("the description states PDO mapping and access rights `{}`", item.access.name()),
        };
        writer.diagnostics.push(found.label(reason));
    }
    Some(MappedObject { index: address.0, sub_index: address.1, bits: u8::try_from(bits?).ok()? })
}

/// Returns the entry for a data type, which reserves space in an RPDO (CiA 301 7.4.7). Reports a data type that a PDO of this
/// direction or this device cannot map.
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
