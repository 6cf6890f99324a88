//! Objects that a PDO cannot map.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::facts::pdo::{mappable, mapped_bits, mapped_objects};
use lexibus_codegen::ir::{Bus, Direction, Item, Type};
use lexibus_codegen::number::written_object;
use lexibus_codegen::source::Span;

use super::value::basic_type;
use super::writer::title;
use crate::model::{MappedObject, NetworkNode, NetworkPdo};

/// Checks the last values of the mapping entries that the network file sets, up to the number of entries in sub-index 0.
pub(super) fn check(node: &NetworkNode, diagnostics: &mut Diagnostics) {
    let values = node.values();
    for pdo in &node.pdos {
        let index = pdo.index() + 0x200;
        for sub_index in 1..=values.number((index, 0)).unwrap_or(0u8).min(64) {
            let (word, span) = (values.number((index, sub_index)), values.set_at((index, sub_index)));
            if let Some(word) = word.filter(|word| *word != 0 && !span.is_empty()) {
                if let Some(fault) = fault(node, pdo, MappedObject::of_word(word), span) {
                    diagnostics.push(fault);
                }
            }
        }
    }
}

fn fault(node: &NetworkNode, pdo: &NetworkPdo, entry: MappedObject, span: Span) -> Option<Diagnostic> {
    // The index of a gap is the code of a data type.
    if entry.is_gap() {
        return None;
    }
    let object = (entry.index, entry.sub_index);
    let found =
        |message: String, label: String| Some(Diagnostic::new(&codes::UNMAPPABLE_OBJECT, span, message).label(label));
    let Some(item) = node.item(object) else {
        let message =
            format!("{} of `{}` maps object {}", pdo.title(), node.name.value, written_object(object.0, object.1));
        return found(message, "the description has no such object".to_owned());
    };
    let device = node.device();
    let able = mappable(item, &mapped_objects(&device.process_data.pdos));
    let is_able = match pdo.direction {
        Direction::Receive => able.rpdo,
        Direction::Transmit => able.tpdo,
    };
    if !is_able {
        let label =
            format!("the description does not allow this (PDO mapping, access rights `{}`)", item.access.name());
        return found(unmappable(item, object, pdo.direction), label);
    }
    let bits = mapped_bits(item, &device.types)?;
    // Some devices map a BOOLEAN as a byte.
    let is_byte = basic_type(device, item, Bus::CanOpen) == Type::Boolean && entry.bits == 8;
    if is_byte || bits == u32::from(entry.bits) {
        return None;
    }
    let message = format!("{} maps {} bits of {}", pdo.title(), entry.bits, title(item, object));
    found(message, format!("the object has {bits} bits"))
}

/// Returns the message for an object that no PDO of a direction can map.
pub(super) fn unmappable(item: &Item, object: (u16, u8), direction: Direction) -> String {
    let pdo = if direction == Direction::Receive { "an RPDO" } else { "a TPDO" };
    format!("{} cannot be mapped into {pdo}", title(item, object))
}
