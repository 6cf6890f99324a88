//! Types with names for bits and values, and tables of codes.

use std::collections::{BTreeMap, HashMap};

use super::{by_name, renamed, Changes, Judgement};
use lexibus_codegen::facts::code;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{BitMeaning, CodeRow, CodeTable, EnumValue, Shape, Type, TypeDef};

/// The type that generated code has: of what has names, whose names they are.
pub(super) fn written(types: &[TypeDef], ty: Type) -> String {
    let owner = Owner::of_types(types);
    let basic = owner.basic(ty);
    let named = owner.definition(ty).and_then(|own| match own.shape {
        Shape::BitField { .. } => Some(format!("bits {} of {}", own.name, plain(basic))),
        Shape::Enumeration { .. } => Some(format!("values {} of {}", own.name, plain(basic))),
        Shape::Array { .. } | Shape::Record(_) => Some(own.name.to_string()),
        Shape::Alias(_) | Shape::Scaled { .. } => None,
    });
    named.unwrap_or_else(|| plain(basic))
}

/// A type without a name of its own, with the length of a text.
fn plain(ty: Type) -> String {
    match ty {
        Type::Named(_) => Type::Opaque(None).to_string(),
        other => other.with_length(),
    }
}

/// Names of bits and values of a type that an element has.
pub(super) fn compare(
    (old_types, old): (&[TypeDef], Type),
    (new_types, new): (&[TypeDef], Type),
    element: &str,
    changes: &mut Changes,
) {
    let (Some(old), Some(new)) =
        (Owner::of_types(old_types).definition(old), Owner::of_types(new_types).definition(new))
    else {
        return;
    };
    match (&old.shape, &new.shape) {
        (Shape::Enumeration { values: old, .. }, Shape::Enumeration { values: new, .. }) => {
            values(old, new, element, changes);
        }
        (Shape::BitField { fields: old, .. }, Shape::BitField { fields: new, .. }) => {
            let key = |own: &lexibus_codegen::ir::BitFieldEntry| {
                let is_reserved = matches!(own.meaning, BitMeaning::Reserved { .. });
                (!is_reserved).then(|| (bits(own), own.name.to_string()))
            };
            named(old.iter().filter_map(key), new.iter().filter_map(key), element, Judgement::Compatible, changes);
            for (one, other) in old
                .iter()
                .filter_map(|one| Some((one, new.iter().find(|own| own.offset == one.offset && own.name == one.name)?)))
            {
                let what = format!("{element}, {}", bits(other));
                let meanings = (meaning(one, old_types), meaning(other, new_types));
                changes.fact(&what, "meaning", meanings, Judgement::Breaking);
                if let (BitMeaning::Enumeration(one), BitMeaning::Enumeration(other)) = (&one.meaning, &other.meaning) {
                    compare((old_types, Type::Named(*one)), (new_types, Type::Named(*other)), element, changes);
                }
            }
        }
        _ => {}
    }
}

/// What the getter of the bits gives.
fn meaning(own: &lexibus_codegen::ir::BitFieldEntry, types: &[TypeDef]) -> String {
    match own.meaning {
        BitMeaning::Flag { inverted: false } => "a flag".to_owned(),
        BitMeaning::Flag { inverted: true } => "a flag that is set by 0".to_owned(),
        BitMeaning::Number => "a number".to_owned(),
        BitMeaning::Enumeration(id) => {
            let definition = Owner::of_types(types).definition(Type::Named(id));
            definition.map_or_else(|| "a number".to_owned(), |own| format!("values {}", own.name))
        }
        BitMeaning::Reserved { .. } => "reserved".to_owned(),
    }
}

/// `bit 4`, `bits 7 to 4 while Mode is 1`.
fn bits(own: &lexibus_codegen::ir::BitFieldEntry) -> String {
    let last = u32::from(own.offset) + u32::from(own.bits).max(1) - 1;
    let bits = if own.bits > 1 { format!("bits {last} to {}", own.offset) } else { format!("bit {last}") };
    let when = own.when.as_ref().map(|own| format!(" while {}", PLAIN.holds(own)));
    bits + &when.unwrap_or_default()
}

fn values(old: &[EnumValue], new: &[EnumValue], element: &str, changes: &mut Changes) {
    let key = |own: &EnumValue| (format!("value {}", own.value), own.name.to_string());
    // A further variant: whoever matched all of them has one to add.
    named(old.iter().map(key), new.iter().map(key), element, Judgement::Breaking, changes);
}

/// Names by what they stand for.
pub(super) fn named(
    old: impl Iterator<Item = (String, String)>,
    new: impl Iterator<Item = (String, String)>,
    element: &str,
    of_new: Judgement,
    changes: &mut Changes,
) {
    let (old, new): (BTreeMap<_, _>, BTreeMap<_, _>) = (old.collect(), new.collect());
    for (key, was) in &old {
        let what = format!("{element}, {key}");
        match new.get(key) {
            Some(is) => changes.fact(&what, "name", (was.clone(), is.clone()), renamed(was, is)),
            None => changes.push(&what, "removed", (was.clone(), String::new()), Judgement::Breaking),
        }
    }
    for (key, is) in new.iter().filter(|(key, _)| !old.contains_key(*key)) {
        changes.push(&format!("{element}, {key}"), "added", (String::new(), is.clone()), of_new);
    }
}

/// Tables of codes, which are enumerations in Rust.
pub(super) fn codes(old: &[CodeTable], new: &[CodeTable], changes: &mut Changes) {
    by_name(
        "codes",
        (old, new),
        |own| &own.name,
        changes,
        |(was, is), element, changes| {
            // The number identifies a code; its notation is the one of the new table.
            let rows = was.rows.iter().chain(is.rows.iter());
            let texts: HashMap<i128, String> = rows.map(|row| (row.code, code::text(row))).collect();
            let key = |row: &CodeRow| {
                let last = row.last.map(|last| format!(" (to {last:#X})")).unwrap_or_default();
                (format!("code {}", texts[&row.code]), format!("{}{last}", row.name))
            };
            named(was.rows.iter().map(key), is.rows.iter().map(key), element, Judgement::Breaking, changes);
        },
    );
}
