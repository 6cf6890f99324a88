//! Returns the objects of ESI files as facts.

use lexibus_codegen::ir::{
    Category, Field, Group, GroupKind, Item, Mappable, ObjectCode, Shape, Type, TypeDef, TypeId,
};

use super::facts::{put, put_flag, put_some, Elements, Facts};
use super::values::{put_documentation, put_names, type_name, value};

/// Adds the types that the file defines. Types that are derived from a name have no line and are skipped.
pub fn data_types(elements: &mut Elements, owner: &str, types: &[TypeDef]) {
    for (at, definition) in types.iter().filter(|definition| definition.origin.line > 0).enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "name", definition.name.as_str());
        put_documentation(&mut facts, "comment", definition.documentation.as_deref());
        put_some(&mut facts, "bits", definition.bits);
        let key = format!("{owner} type {at}");
        match &definition.shape {
            Shape::Enumeration { values, .. } => {
                for value in values {
                    put_names(&mut facts, &format!("value {}", value.value), &value.name, &value.names);
                }
            }
            Shape::Record(fields) => {
                for (place, field) in fields.iter().enumerate() {
                    elements.insert(format!("{key} field {place}"), self::field(field));
                }
            }
            Shape::Array { .. } if !types[..at].iter().any(|other| other.name == definition.name) => {
                put(&mut facts, "array", type_name(Type::Named(TypeId(at as u32)), types));
            }
            _ => {}
        }
        elements.insert(key, facts);
    }
}

fn field(field: &Field) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "name", field.name.as_str());
    put_some(&mut facts, "sub-index", field.sub_index);
    put(&mut facts, "bits", field.bits.to_string());
    put(&mut facts, "offset", field.bit_offset.to_string());
    facts
}

pub fn objects(elements: &mut Elements, owner: &str, groups: &[Group], types: &[TypeDef]) {
    for group in groups {
        let GroupKind::Object { index, code, category } = group.kind else { continue };
        let mut facts = Facts::new();
        put_names(&mut facts, "name", &group.name, &group.names);
        put_documentation(&mut facts, "comment", group.documentation.as_deref());
        put_flag(&mut facts, "by slot", group.depends_on_slot);
        let category = category.and_then(|category| match category {
            Category::Mandatory => Some("m"),
            Category::Optional => Some("o"),
            Category::Conditional => Some("c"),
            Category::Manufacturer => None,
        });
        put_some(&mut facts, "category", category);
        let key = format!("{owner} object {index:04X}");
        for entry in &group.items {
            let Some((_, sub)) = entry.object() else { continue };
            let mut facts = item(entry, types);
            if matches!(code, ObjectCode::Var | ObjectCode::DefType) {
                put_some(&mut facts, "bits", bits(entry.ty, types));
            }
            elements.insert(format!("{key}:{sub:02X}"), facts);
        }
        elements.insert(key, facts);
    }
}

/// Returns the length of a type in bits if the length is fixed.
fn bits(ty: Type, types: &[TypeDef]) -> Option<u32> {
    match ty {
        Type::Named(TypeId(at)) => types[at as usize].bits,
        Type::VisibleString(length) | Type::OctetString(length) => Some(length? * 8),
        Type::UnicodeString(length) => Some(length? * 16),
        basic => basic.bits(),
    }
}

fn item(item: &Item, types: &[TypeDef]) -> Facts {
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &item.name, &item.names);
    put_documentation(&mut facts, "comment", item.documentation.as_deref());
    put(&mut facts, "type", type_name(item.ty, types));
    // In the IR, an entry without declared access rights is read-only. The script reports no access rights for such an entry.
    put(&mut facts, "access", if item.at.access.is_empty() { "" } else { item.access.name() });
    put(
        &mut facts,
        "mapping",
        match item.mappable {
            Mappable { rpdo: true, tpdo: true } => "RT",
            Mappable { rpdo: true, tpdo: false } => "R",
            Mappable { rpdo: false, tpdo: true } => "T",
            Mappable { rpdo: false, tpdo: false } => "",
        },
    );
    put_some(&mut facts, "default", item.default.as_ref().map(value));
    put_some(&mut facts, "low", item.limits.low.as_ref().map(value));
    put_some(&mut facts, "high", item.limits.high.as_ref().map(value));
    let Some(behavior) = &item.behavior else { return facts };
    put_flag(&mut facts, "backup", behavior.backup);
    put_flag(&mut facts, "setting", behavior.setting);
    put_some(&mut facts, "safety", behavior.safety.as_deref());
    put(&mut facts, "readable in", behavior.read_states.join(" "));
    put(&mut facts, "writable in", behavior.write_states.join(" "));
    facts
}
