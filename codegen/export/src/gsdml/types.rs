//! Names of GSDML data types.

use std::borrow::Cow;

use super::Context;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Shape, Type, TypeDef};

/// Maximum number of named types in the chain from a type to its basic type.
const MAX_DEPTH: usize = 8;

/// The GSDML name of a data type.
pub(super) struct Name<'t> {
    pub(super) name: Cow<'t, str>,
    pub(super) needs_length: bool,
    pub(super) note: Option<NoteKind>,
}

fn plain<'t>(name: impl Into<Cow<'t, str>>) -> Name<'t> {
    Name { name: name.into(), needs_length: false, note: None }
}

/// Returns the GSDML name of a type with the given length in bits.
pub(super) fn name(ty: Type, bits: u32, types: &[TypeDef]) -> Name<'_> {
    let octets = |note| Name { needs_length: true, note, ..plain("OctetString") };
    let (ty, note) = match defined_name(ty, types) {
        Ok(name) => return name,
        Err(below) => below,
    };
    let mut found = match ty {
        Type::Boolean if bits == 8 => plain("Boolean"),
        Type::Unsigned(bits @ (8 | 16 | 32 | 64)) => plain(format!("Unsigned{bits}")),
        Type::Integer(bits @ (8 | 16 | 32 | 64)) => plain(format!("Integer{bits}")),
        Type::Real32 => plain("Float32"),
        Type::Real64 => plain("Float64"),
        Type::VisibleString(_) => Name { needs_length: true, ..plain("VisibleString") },
        Type::OctetString(_) => octets(None),
        Type::TimeOfDay => plain("TimeOfDay with date indication"),
        Type::TimeDifference => plain("TimeDifference with date indication"),
        Type::Time(format) => plain(format.name()),
        _ => octets(Some(NoteKind::UnknownType)),
    };
    found.note = found.note.or(note);
    found
}

/// Writes the attributes for the type and offset of a value in a record.
pub(super) fn position(xml: &mut Xml, context: &mut Context<'_>, ty: Type, offset: u32, bits: u32, subject: &str) {
    let is_byte = offset.is_multiple_of(8);
    let is_bits = match ty {
        Type::Boolean | Type::Unsigned(1) => bits == 1,
        Type::Unsigned(width) => !matches!(width, 8 | 16 | 32 | 64) || !is_byte,
        _ => false,
    };
    let Name { name, needs_length, note } = match ty {
        Type::Boolean | Type::Unsigned(1) if is_bits => plain("Bit"),
        _ if is_bits => plain("BitArea"),
        _ => name(ty, bits, context.types),
    };
    xml.notes.add_all(note, Subject::Named(subject));
    xml.attribute("DataType", &name);
    xml.attribute("ByteOffset", offset / 8);
    xml.optional("BitOffset", (is_bits && !is_byte).then_some(offset % 8));
    xml.optional("BitLength", (name == "BitArea").then_some(bits));
    xml.optional("Length", needs_length.then_some(bits / 8));
}

/// Follows the chain of definitions from a type to the first type that GSDML defines, and returns its name. If GSDML
/// defines none of the types, returns the basic type as an error, with a note if facts are lost.
fn defined_name(mut ty: Type, types: &[TypeDef]) -> Result<Name<'_>, (Type, Option<NoteKind>)> {
    let mut note = None;
    for _ in 0..MAX_DEPTH {
        let Type::Named(id) = ty else { break };
        let Some(def) = types.get(id.0 as usize) else { break };
        ty = match &def.shape {
            Shape::Alias(Type::OctetString(_)) if is_string(&def.name) => {
                return Ok(Name { needs_length: true, ..plain(def.name.as_str()) });
            }
            Shape::Alias(_) | Shape::Scaled { .. } | Shape::Record(_) if is_number(&def.name) => {
                return Ok(plain(def.name.as_str()));
            }
            Shape::Alias(base) => *base,
            Shape::Enumeration { base, .. } => *base,
            Shape::BitField { base, .. } => {
                note = note.or(Some(NoteKind::BitField));
                *base
            }
            Shape::Scaled { base, .. } => {
                note = note.or(Some(NoteKind::Quantity));
                *base
            }
            Shape::Array { .. } | Shape::Record(_) => return Err((Type::Opaque(None), Some(NoteKind::Structure))),
        };
    }
    Err((ty, note))
}

/// Returns the definition of an enumeration and its integer type, or `None` if `ty` is not an enumeration.
pub(super) fn enumeration(ty: Type, types: &[TypeDef]) -> Option<(&TypeDef, Type)> {
    let Type::Named(id) = ty else { return None };
    let def = types.get(id.0 as usize)?;
    match def.shape {
        Shape::Enumeration { base, .. } => Some((def, base)),
        _ => None,
    }
}

fn is_string(name: &str) -> bool {
    matches!(name, "UnicodeString8" | "61131_STRING" | "61131_WSTRING")
}

/// Returns whether `name` is a PROFIdrive or process control type, or a type that pairs a value with its status.
fn is_number(name: &str) -> bool {
    const NAMES: [&str; 18] = [
        "N2",
        "N4",
        "E2",
        "C4",
        "X2",
        "X4",
        "T2",
        "T4",
        "D2",
        "R2",
        "Unipolar2.16",
        "Float32+Unsigned8",
        "Float32+Status8",
        "Unsigned8+Unsigned8",
        "OctetString2+Unsigned8",
        "Unsigned16_S",
        "Integer16_S",
        "Unsigned8_S",
    ];
    NAMES.contains(&name)
}
