//! Types of values: the basic type below, and the type as a table shows it.

use crate::ir::owner::Owner;
use crate::ir::{Type, TypeDef, TypeId};

/// The basic type below; of arrays and records, nothing is known.
pub fn basic(types: &[TypeDef], ty: Type) -> Type {
    match Owner::of_types(types).basic(ty) {
        Type::Named(_) => Type::Opaque(None),
        basic => basic,
    }
}

/// A type as a table shows it: the basic type, with its length if it is a text.
pub fn name(types: &[TypeDef], ty: Type) -> String {
    basic(types, ty).with_length()
}

/// The definition of a named type.
pub fn definition(types: &[TypeDef], ty: Type) -> Option<&TypeDef> {
    match ty {
        Type::Named(TypeId(id)) => types.get(id as usize),
        _ => None,
    }
}

/// `3`, `4 to 7`: a value of an enumeration, or a range of them.
pub fn numbers(first: i128, last: Option<i128>) -> String {
    match last.filter(|last| *last != first) {
        Some(last) => format!("{} to {}", number(first), number(last)),
        None => number(first),
    }
}

/// A number; of large ones that are bit patterns more often than amounts, both forms.
fn number(number: i128) -> String {
    match number {
        0..=255 => number.to_string(),
        256.. => format!("{number} (0x{number:X})"),
        _ => number.to_string(),
    }
}
