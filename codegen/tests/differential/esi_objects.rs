//! Objects of ESI files as facts.

use lexibus_codegen::ir::{
    Category, Field, Group, GroupKind, Item, Mappable, ObjectCode, Shape, Type, TypeDef, TypeId,
};

use super::facts::{put, put_flag, put_some, Elements, Facts};
use super::values::{put_documentation, put_names, type_name, value};

/// The types as the file defines them; those that only a name stands for are on no line.
pub fn data_types(elements: &mut Elements, owner: &str, types: &[TypeDef]) {
    for (at, own) in types.iter().filter(|own| own.origin.line > 0).enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "name", own.name.as_str());
        put_documentation(&mut facts, "comment", own.documentation.as_deref());
        put_some(&mut facts, "bits", own.bits);
        let key = format!("{owner} type {at}");
        match &own.shape {
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
            Shape::Array { .. } if !types[..at].iter().any(|other| other.name == own.name) => {
                put(&mut facts, "array", type_name(Type::Named(TypeId(at as u32)), types));
            }
            _ => {}
        }
        elements.insert(key, facts);
    }
}

fn field(own: &Field) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "name", own.name.as_str());
    put_some(&mut facts, "sub-index", own.sub_index);
    put(&mut facts, "bits", own.bits.to_string());
    put(&mut facts, "offset", own.bit_offset.to_string());
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
        for own in &group.items {
            let Some((_, sub)) = own.object() else { continue };
            let mut facts = item(own, types);
            if matches!(code, ObjectCode::Var | ObjectCode::DefType) {
                put_some(&mut facts, "bits", bits(own.ty, types));
            }
            elements.insert(format!("{key}:{sub:02X}"), facts);
        }
        elements.insert(key, facts);
    }
}

/// Length of a type in bits, where that is fixed.
fn bits(ty: Type, types: &[TypeDef]) -> Option<u32> {
    match ty {
        Type::Named(TypeId(at)) => types[at as usize].bits,
        Type::VisibleString(length) | Type::OctetString(length) => Some(length? * 8),
        Type::UnicodeString(length) => Some(length? * 16),
        basic => basic.bits(),
    }
}

fn item(own: &Item, types: &[TypeDef]) -> Facts {
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &own.name, &own.names);
    put_documentation(&mut facts, "comment", own.documentation.as_deref());
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
    let Some(behaviour) = &own.behaviour else { return facts };
    put_flag(&mut facts, "backup", behaviour.backup);
    put_flag(&mut facts, "setting", behaviour.setting);
    put_some(&mut facts, "safety", behaviour.safety.as_deref());
    put(&mut facts, "readable in", behaviour.read_states.join(" "));
    put(&mut facts, "writable in", behaviour.write_states.join(" "));
    facts
}
