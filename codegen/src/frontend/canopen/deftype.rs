//! Determines the type that an object in the data type area defines.

use crate::ir::{Group, ObjectCode, Type, Value};

/// Returns the type for which the DEFTYPE or DEFSTRUCT object `group` is an alias, and the length of this type in bits.
/// If the object does not define a known type, returns raw bytes and the length that a DEFTYPE object states.
pub fn defined_type(group: &Group, index: u16, code: ObjectCode) -> (Type, Option<u32>) {
    let unknown = Type::Opaque(Some(u32::from(index)));
    let number = |sub| group.sub(sub).and_then(|item| item.default.as_ref()).and_then(Value::as_int);
    match (code, group.items.as_slice()) {
        // The value of a DEFTYPE object is the length of the type in bits (CiA 301 7.4.7). The object is an alias of
        // its data type if this data type has the same length.
        (ObjectCode::DefType, [item]) => match (item.ty.bits(), number(0)) {
            (Some(bits), None) => (item.ty, Some(bits)),
            (Some(bits), Some(length)) if length == i128::from(bits) => (item.ty, Some(bits)),
            (None, None) if !matches!(item.ty, Type::Opaque(_)) => (item.ty, None),
            (_, length) => (unknown, length.and_then(|bits| u32::try_from(bits).ok()).filter(|&bits| bits > 0)),
        },
        // Some tools describe the basic type of a DEFTYPE object in sub-index 1, and limits in the following
        // sub-indices.
        (ObjectCode::DefType, [_, first, ..]) if first.name.eq_ignore_ascii_case("Type") => {
            let basic = number(1).and_then(|code| Type::from_cia301(u32::try_from(code).ok()?));
            basic.map_or((unknown, None), |basic| (basic, basic.bits()))
        }
        _ => (unknown, None),
    }
}
