//! Formats types and values of XML formats in the notation of the scripts.

use lexibus_codegen::ir::{Documentation, Numbers, Shape, Texts, Type, TypeDef, TypeId, Value};

use super::facts::{put, real, Facts};

/// Formats octets in hexadecimal.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

pub fn value(value: &Value) -> String {
    match value {
        Value::Bool(value) => u8::from(*value).to_string(),
        Value::Int(value) => value.to_string(),
        Value::Real(value) => real(*value),
        Value::Text(text) => format!("'{text}'"),
        Value::Bytes(bytes) => format!("x'{}'", hex(bytes)),
        Value::Raw(text) => format!("?{text}"),
        other => format!("{other:?}"),
    }
}

/// Formats a list of numbers and ranges.
pub fn numbers(list: &Numbers) -> String {
    let range = |&(first, last): &(u16, u16)| match first == last {
        true => first.to_string(),
        false => format!("{first}..{last}"),
    };
    list.0.iter().map(range).collect::<Vec<_>>().join(" ")
}

/// Adds a name and its translations.
pub fn put_names(facts: &mut Facts, fact: &str, name: &str, others: &Texts) {
    put(facts, fact, name);
    for other in others.iter() {
        put(facts, &format!("{fact} {}", other.language), other.text.as_str());
    }
}

/// Adds a description and its translations.
pub fn put_documentation(facts: &mut Facts, fact: &str, documentation: Option<&Documentation>) {
    if let Some(documentation) = documentation {
        put_names(facts, fact, &documentation.text, &documentation.translations);
    }
}

/// Formats a type by the values that it can have, independent of its name.
pub fn type_name(ty: Type, types: &[TypeDef]) -> String {
    let sized = |name: &str, length: Option<u32>| length.map_or(name.to_owned(), |length| format!("{name}({length})"));
    match ty {
        Type::Boolean => "bool".into(),
        Type::Integer(bits) => format!("i{bits}"),
        Type::Unsigned(bits) => format!("u{bits}"),
        Type::Real32 => "f32".into(),
        Type::Real64 => "f64".into(),
        Type::VisibleString(length) => sized("str", length),
        Type::OctetString(length) => sized("octets", length),
        Type::UnicodeString(length) => sized("wide", length),
        Type::TimeOfDay => "time of day".into(),
        Type::TimeDifference => "time difference".into(),
        Type::Domain => "domain".into(),
        Type::Time(format) => format.name().into(),
        Type::Opaque(_) => String::new(),
        Type::Named(TypeId(at)) => match &types[at as usize].shape {
            Shape::Alias(ty) => type_name(*ty, types),
            Shape::Enumeration { base, .. } | Shape::BitField { base, .. } | Shape::Scaled { base, .. } => {
                type_name(*base, types)
            }
            Shape::Record(_) => "record".into(),
            Shape::Array { element, dimensions } => {
                let count = dimensions.iter().fold(1, |count, (_, elements)| count * elements);
                format!("{}[{count}]", type_name(*element, types))
            }
        },
    }
}
