//! What an object of the data type area defines.

use crate::ir::{Group, ObjectCode, Type, Value};

/// What the DEFTYPE or DEFSTRUCT `group` is another name of, and its length in bits.
pub fn defined_type(group: &Group, index: u16, code: ObjectCode) -> (Type, Option<u32>) {
    let nobody_tells = Type::Opaque(Some(u32::from(index)));
    let number = |sub| group.sub(sub).and_then(|item| item.default.as_ref()).and_then(Value::as_int);
    match (code, group.items.as_slice()) {
        // Reading a DEFTYPE gives the length of the type in bits (CiA 301 7.4.7). Where that is the length of its data
        // type, too, nothing else can be meant than another name of it.
        (ObjectCode::DefType, [own]) => match (own.ty.bits(), number(0)) {
            (Some(bits), None) => (own.ty, Some(bits)),
            (Some(bits), Some(length)) if length == i128::from(bits) => (own.ty, Some(bits)),
            (None, None) if !matches!(own.ty, Type::Opaque(_)) => (own.ty, None),
            (_, length) => (nobody_tells, length.and_then(|bits| u32::try_from(bits).ok()).filter(|&bits| bits > 0)),
        },
        // Some tools name the basic type in sub-index 1, and limits in those behind it.
        (ObjectCode::DefType, [_, first, ..]) if first.name.eq_ignore_ascii_case("Type") => {
            let basic = number(1).and_then(|code| Type::from_cia301(u32::try_from(code).ok()?));
            basic.map_or((nobody_tells, None), |basic| (basic, basic.bits()))
        }
        _ => (nobody_tells, None),
    }
}
