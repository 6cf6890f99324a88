//! Basic types of data types that a device defines, and the digits of their values.

use std::fmt::Write as _;

use super::note::NoteKind;
use lexibus_codegen::ir::{Shape, Type, TypeDef};

/// Maximum number of named types in the chain from a type to its basic type.
const MAX_DEPTH: usize = 8;

/// Returns the basic type that a defined type is derived from, or `None` for an array or record. Also returns a note if names of
/// bits, named values, a scaling or a structure are lost.
pub(super) fn resolved(mut ty: Type, types: &[TypeDef]) -> (Option<Type>, Option<NoteKind>) {
    let mut note = None;
    for _ in 0..MAX_DEPTH {
        let Type::Named(id) = ty else { break };
        let Some(found) = types.get(id.0 as usize) else { break };
        let (below, of_shape) = match &found.shape {
            Shape::Alias(base) => (*base, None),
            Shape::Enumeration { base, .. } => (*base, Some(NoteKind::Enumeration)),
            Shape::BitField { base, .. } => (*base, Some(NoteKind::BitField)),
            Shape::Scaled { base, .. } => (*base, Some(NoteKind::Quantity)),
            Shape::Array { .. } | Shape::Record(_) => return (None, Some(NoteKind::Structure)),
        };
        (ty, note) = (below, note.or(of_shape));
    }
    (Some(ty), note)
}

/// Returns the type of strings of any length, and any other type unchanged.
pub(super) fn without_length(ty: Type) -> Type {
    match ty {
        Type::VisibleString(_) => Type::VisibleString(None),
        Type::OctetString(_) => Type::OctetString(None),
        Type::UnicodeString(_) => Type::UnicodeString(None),
        other => other,
    }
}

/// Formats bytes as pairs of hexadecimal digits.
pub(super) fn hex_digits(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02X}");
        text
    })
}
