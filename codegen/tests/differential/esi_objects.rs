//! Objects of ESI files as facts.

use lexibus_codegen::ir::{Category, Group, GroupKind, Item, Mappable, TypeDef};

use super::facts::{put, put_flag, put_some, Elements, Facts};
use super::values::{type_name, value};

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
