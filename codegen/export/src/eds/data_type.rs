//! Data types with their numbers in CiA 301.

use super::note::NoteKind;
use crate::types::{resolved, without_length};
use lexibus_codegen::ir::{Type, TypeDef};

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
/// An integer of a width that CiA 301 does not define becomes the next wider integer, and a type without a number in
/// CiA 301 becomes DOMAIN, each with a note.
///
/// An unknown type keeps its number if the source is a CiA 306 file (`is_verbatim`) or describes a CANopen device,
/// because other tools may know the number. An entry without a type stays without a type if the source is a CiA 306
/// file.
pub(super) fn data_type(ty: Type, types: &[TypeDef], is_canopen: bool, is_verbatim: bool) -> DataType {
    let (ty, note) = resolved(ty, types);
    let ty = ty.unwrap_or(Type::Domain);
    let widened = |bits: u8| bits.clamp(1, 64).div_ceil(8) * 8;
    let (ty, further_note) = match ty {
        Type::Integer(bits) if bits != widened(bits) => (Type::Integer(widened(bits)), Some(NoteKind::Widened)),
        Type::Unsigned(bits) if bits != widened(bits) => (Type::Unsigned(widened(bits)), Some(NoteKind::Widened)),
        Type::Opaque(code) if is_verbatim || is_canopen && code.is_some() => return DataType { code, ty, note },
        Type::Time(_) | Type::Opaque(_) | Type::Named(_) => (Type::Domain, Some(NoteKind::UnknownType)),
        Type::VisibleString(Some(_)) | Type::OctetString(Some(_)) | Type::UnicodeString(Some(_)) => {
            (ty, Some(NoteKind::Length))
        }
        _ => (ty, None),
    };
    DataType { code: code(ty), ty, note: note.or(further_note) }
}

/// Returns the number of a basic type in CiA 301.
fn code(ty: Type) -> Option<u32> {
    (0x01..=0x1B).find(|code| Type::from_cia301(*code) == Some(without_length(ty)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::{Shape, TypeId};

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
