//! Data types with their numbers in CiA 301.

use super::note::NoteKind;
use lexibus_codegen::ir::{Shape, Type, TypeDef};

/// Maximum number of named types in the chain from a type to its basic type.
const MAX_DEPTH: usize = 8;

/// Data type of an EDS entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DataType {
    /// Number of the type; `None` if the source gives no type.
    pub(super) code: Option<u32>,
    /// Type that determines the notation of the values.
    pub(super) ty: Type,
    /// Note to add if the type was changed or omitted.
    pub(super) note: Option<NoteKind>,
}

/// Returns the EDS data type for `ty`.
///
/// An unknown type keeps its number if the source is a CiA 306 file (`is_verbatim`) or describes a CANopen device,
/// because other tools may know the number. An entry without a type stays without a type if the source is a CiA 306
/// file.
pub(super) fn data_type(ty: Type, types: &[TypeDef], is_canopen: bool, is_verbatim: bool) -> DataType {
    let (ty, mut note) = resolved(ty, types);
    let widened = |bits: u8| bits.clamp(1, 64).div_ceil(8) * 8;
    let ty = match ty {
        Type::Integer(bits) if bits != widened(bits) => {
            note = note.or(Some(NoteKind::Widened));
            Type::Integer(widened(bits))
        }
        Type::Unsigned(bits) if bits != widened(bits) => {
            note = note.or(Some(NoteKind::Widened));
            Type::Unsigned(widened(bits))
        }
        Type::Opaque(code) if is_verbatim || is_canopen && code.is_some() => return DataType { code, ty, note },
        Type::Time(_) | Type::Opaque(_) | Type::Named(_) => {
            note = note.or(Some(NoteKind::UnknownType));
            Type::Domain
        }
        Type::VisibleString(Some(_)) | Type::OctetString(Some(_)) | Type::UnicodeString(Some(_)) => {
            note = note.or(Some(NoteKind::Length));
            ty
        }
        _ => ty,
    };
    DataType { code: code(ty), ty, note }
}

/// Replaces a defined type with the basic type that it is derived from, and an array or record with DOMAIN. Also
/// returns a note if facts are lost.
fn resolved(mut ty: Type, types: &[TypeDef]) -> (Type, Option<NoteKind>) {
    let mut note = None;
    for _ in 0..MAX_DEPTH {
        let Type::Named(id) = ty else { break };
        let Some(found) = types.get(id.0 as usize) else { break };
        ty = match &found.shape {
            Shape::Alias(target) => *target,
            Shape::BitField { base, .. } => {
                note = note.or(Some(NoteKind::BitField));
                *base
            }
            Shape::Enumeration { base, .. } => {
                note = note.or(Some(NoteKind::Enumeration));
                *base
            }
            Shape::Scaled { base, .. } => {
                note = note.or(Some(NoteKind::Quantity));
                *base
            }
            Shape::Array { .. } | Shape::Record(_) => {
                note = Some(NoteKind::Structure);
                Type::Domain
            }
        };
    }
    (ty, note)
}

/// Returns the CiA 301 number of a basic type, or `None` for other types.
fn code(ty: Type) -> Option<u32> {
    Some(match ty {
        Type::Boolean => 0x01,
        Type::Integer(8) => 0x02,
        Type::Integer(16) => 0x03,
        Type::Integer(32) => 0x04,
        Type::Unsigned(8) => 0x05,
        Type::Unsigned(16) => 0x06,
        Type::Unsigned(32) => 0x07,
        Type::Real32 => 0x08,
        Type::VisibleString(_) => 0x09,
        Type::OctetString(_) => 0x0A,
        Type::UnicodeString(_) => 0x0B,
        Type::TimeOfDay => 0x0C,
        Type::TimeDifference => 0x0D,
        Type::Domain => 0x0F,
        Type::Integer(24) => 0x10,
        Type::Real64 => 0x11,
        Type::Integer(40) => 0x12,
        Type::Integer(48) => 0x13,
        Type::Integer(56) => 0x14,
        Type::Integer(64) => 0x15,
        Type::Unsigned(24) => 0x16,
        Type::Unsigned(40) => 0x18,
        Type::Unsigned(48) => 0x19,
        Type::Unsigned(56) => 0x1A,
        Type::Unsigned(64) => 0x1B,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::TypeId;

    #[test]
    fn basic_types_keep_their_numbers() {
        for number in 0..0x40 {
            let Some(ty) = Type::from_cia301(number) else { continue };
            assert_eq!(data_type(ty, &[], true, true), DataType { code: Some(number), ty, note: None }, "{ty}");
        }
    }

    #[test]
    fn types_that_canopen_does_not_have() {
        let shape = |shape| TypeDef::new("T", shape, None);
        let types = [
            shape(Shape::Enumeration { base: Type::Unsigned(3), values: Vec::new(), closed: false }),
            shape(Shape::Record(Vec::new())),
            shape(Shape::Alias(Type::Named(TypeId(2)))),
        ];
        let of = |ty| data_type(ty, &types, false, false);
        let written = |code, ty, note| DataType { code: Some(code), ty, note: Some(note) };
        assert_eq!(of(Type::Named(TypeId(0))), written(5, Type::Unsigned(8), NoteKind::Enumeration));
        assert_eq!(of(Type::Named(TypeId(1))), written(15, Type::Domain, NoteKind::Structure));
        assert_eq!(of(Type::Named(TypeId(2))), written(15, Type::Domain, NoteKind::UnknownType), "a type of itself");
        assert_eq!(of(Type::Named(TypeId(9))), written(15, Type::Domain, NoteKind::UnknownType));
        assert_eq!(of(Type::Integer(12)), written(3, Type::Integer(16), NoteKind::Widened));
        assert_eq!(of(Type::Opaque(Some(0x1D))), written(15, Type::Domain, NoteKind::UnknownType));
        let unknown = |code, is_verbatim| data_type(Type::Opaque(code), &[], true, is_verbatim);
        assert_eq!((unknown(Some(0x40), false).code, unknown(Some(0x40), false).note), (Some(0x40), None));
        assert_eq!((unknown(None, true).code, unknown(None, false).code), (None, Some(15)));
    }
}
