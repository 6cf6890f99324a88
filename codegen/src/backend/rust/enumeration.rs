//! Enumerations: named values of an integer.

use std::collections::HashSet;

use super::docs;
use super::options::RustOptions;
use super::scope::Scope;
use super::value_type::{self, ValueType};
use crate::ir::{EnumValue, Shape, Type};
use crate::passes::names_unique::{self, Case, Wish};

/// An enumeration, ready to be written.
pub(super) struct EnumerationModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// The type of the value below, in terms of the runtime: `u8`, `rt::Uint<3>`.
    pub base: &'static str,
    /// The type of its numbers: `u8`.
    pub native: &'static str,
    /// The integer below.
    pub ty: Type,
    /// Length in bits.
    pub bits: u32,
    pub variants: Vec<VariantModel>,
}

/// A value.
pub(super) struct VariantModel {
    pub name: String,
    pub docs: String,
    pub value: String,
}

/// Variants of every enumeration, and what its code names.
const RESERVED: [&str; 2] = ["Self", "Unknown"];

/// Types of the prelude that generated code names, and traits that it derives.
const RESERVED_TYPES: [&str; 4] = ["Self", "Option", "Result", "Unknown"];

/// The enumerations that items and PDO entries of `scope` have, with the positions of their types.
pub(super) fn models(scope: &Scope<'_>, options: &RustOptions) -> Vec<(u32, EnumerationModel)> {
    let items = scope.groups.iter().flat_map(|group| &group.items).map(|item| item.ty);
    let entries = scope.pdos.iter().flat_map(|pdo| &pdo.entries).map(|entry| entry.ty);
    let mut seen = HashSet::new();
    let mut used: Vec<u32> = Vec::new();
    for ty in items.chain(entries) {
        let Some((position, definition)) = scope.resolve(ty).1 else { continue };
        if matches!(definition.shape, Shape::Enumeration { .. }) && seen.insert(position) {
            used.push(position);
        }
    }
    used.sort_unstable();
    let mut models: Vec<(u32, EnumerationModel)> =
        used.into_iter().filter_map(|position| Some((position, model(scope, position, options)?))).collect();
    let wishes: Vec<Wish<'_>> = models
        .iter()
        .map(|(position, _)| Wish {
            name: &scope.types[*position as usize].name,
            fallback: format!("enumeration {position}"),
            suffix: position.to_string(),
        })
        .collect();
    let names = names_unique::unique(&wishes, &RESERVED_TYPES, Case::Pascal);
    for ((_, model), name) in models.iter_mut().zip(names) {
        model.name = name;
    }
    models
}

/// The enumeration at this position, as yet without a name; `None` where it has no value that its integer has.
fn model(scope: &Scope<'_>, position: u32, options: &RustOptions) -> Option<EnumerationModel> {
    let definition = scope.types.get(position as usize)?;
    let Shape::Enumeration { base, values, .. } = &definition.shape else { return None };
    // A truth value with names for its values is a number of one bit.
    let base = match scope.base(*base) {
        Type::Boolean => Type::Unsigned(1),
        other => other,
    };
    let (low, high) = base.integer_range()?;
    let (path, native) = ValueType::of(base).number()?;
    let mut seen = HashSet::new();
    let values: Vec<&EnumValue> = values
        .iter()
        .filter(|value| value.last.is_none() && (low..=high).contains(&value.value) && seen.insert(value.value))
        .collect();
    if values.is_empty() {
        return None;
    }
    Some(EnumerationModel {
        docs: vec![docs::sentence(&docs::escape(&definition.name))],
        derives: options.derives(true),
        base: path,
        native,
        ty: base,
        bits: base.bits()?,
        variants: variants(&values),
        name: String::new(),
    })
}

fn variants(values: &[&EnumValue]) -> Vec<VariantModel> {
    let wishes: Vec<Wish<'_>> = values
        .iter()
        .map(|value| {
            let number = value.value.to_string().replace('-', "minus_");
            Wish { name: &value.name, fallback: format!("value {number}"), suffix: number }
        })
        .collect();
    let names = names_unique::unique(&wishes, &RESERVED, Case::Pascal);
    let variant = |(value, name): (&&EnumValue, String)| {
        let number = value_type::number(value.value, value.value > 0);
        let title = docs::escape(&value.name);
        let docs =
            if title.is_empty() { format!("{number}.") } else { format!("{number}: {}", docs::sentence(&title)) };
        VariantModel { name, docs, value: number }
    };
    values.iter().zip(names).map(variant).collect()
}

impl EnumerationModel {
    /// Whether its numbers have a sign.
    pub(super) fn is_signed(&self) -> bool {
        self.native.starts_with('i')
    }
}
