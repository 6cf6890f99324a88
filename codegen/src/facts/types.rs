//! Types of values: basic types, and names of types in tables.

use crate::ir::owner::Owner;
use crate::ir::{Type, TypeDef, TypeId};
use crate::number::{hex, range};

/// Returns the basic type of a type. The basic type of an array or record is an opaque type.
pub fn basic(types: &[TypeDef], ty: Type) -> Type {
    match Owner::of_types(types).basic(ty) {
        Type::Named(_) => Type::Opaque(None),
        basic => basic,
    }
}

/// Returns the name of the basic type, with its length if it is a string.
pub fn name(types: &[TypeDef], ty: Type) -> String {
    basic(types, ty).with_length()
}

/// Returns the definition of a named type, or `None` for any other type.
pub fn definition(types: &[TypeDef], ty: Type) -> Option<&TypeDef> {
    match ty {
        Type::Named(TypeId(id)) => types.get(id as usize),
        _ => None,
    }
}

/// Formats a value or a range of an enumeration: `3`, `4 to 7`.
pub fn numbers(first: i128, last: Option<i128>) -> String {
    range(first, last.unwrap_or(first), number)
}

/// Formats a number. A large number has both decimal and hexadecimal notation, because large numbers are often bit
/// patterns.
fn number(number: i128) -> String {
    match number {
        0..=255 => number.to_string(),
        256.. => format!("{number} ({})", hex(number)),
        _ => number.to_string(),
    }
}
