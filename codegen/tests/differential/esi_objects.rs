//! Objects of ESI files as facts.

use lexibus_codegen::ir::{Category, Group, GroupKind, Item, Mappable, Shape, Type, TypeDef, TypeId, Value};

use super::esi::hex;
use super::facts::{put, put_flag, put_some, real, Elements, Facts};

pub fn objects(elements: &mut Elements, owner: &str, groups: &[Group], types: &[TypeDef]) {
    for group in groups {
        let GroupKind::Object { index, category, .. } = group.kind else { continue };
        let mut facts = Facts::new();
        put(&mut facts, "name", group.name.as_str());
        put_flag(&mut facts, "by slot", group.depends_on_slot);
        let category = category.and_then(|category| match category {
            Category::Mandatory => Some("m"),
            Category::Optional => Some("o"),
            Category::Conditional => Some("c"),
            Category::Manufacturer => None,
        });
        put_some(&mut facts, "category", category);
        let key = format!("{owner} object {index:04X}");
        for own in &group.items {
            let Some((_, sub)) = own.object() else { continue };
            elements.insert(format!("{key}:{sub:02X}"), item(own, types));
        }
        elements.insert(key, facts);
    }
}

fn item(own: &Item, types: &[TypeDef]) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "name", own.name.as_str());
    put(&mut facts, "type", type_name(own.ty, types));
    // What nobody says is read-only in the IR.
    put(&mut facts, "access", if own.at.access.is_empty() { "" } else { own.access.name() });
    put(
        &mut facts,
        "mapping",
        match own.mappable {
            Mappable { rpdo: true, tpdo: true } => "RT",
            Mappable { rpdo: true, tpdo: false } => "R",
            Mappable { rpdo: false, tpdo: true } => "T",
            Mappable { rpdo: false, tpdo: false } => "",
        },
    );
    put_some(&mut facts, "default", own.default.as_ref().map(value));
    put_some(&mut facts, "low", own.limits.low.as_ref().map(value));
    put_some(&mut facts, "high", own.limits.high.as_ref().map(value));
    facts
}

/// A value as the script writes it.
fn value(value: &Value) -> String {
    match value {
        Value::Bool(value) => u8::from(*value).to_string(),
        Value::Int(value) => value.to_string(),
        Value::Real(value) => real(*value),
        Value::Text(text) => format!("'{text}'"),
        Value::Bytes(bytes) => format!("x'{}'", hex(bytes)),
        other => format!("{other:?}"),
    }
}

/// A type as the script writes it: what values look like, whatever the type is called.
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
        Type::Opaque(_) | Type::Time(_) => String::new(),
    }
}
