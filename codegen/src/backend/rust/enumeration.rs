//! Enumerations: named values of an integer.

use std::collections::HashSet;

use super::doc_table;
use super::docs;
use super::docs::WORDS;
use super::links::Here;
use super::options::RustOptions;
use super::scope::Scope;
use super::value_type::{self, ValueType};
use crate::ir::{EnumValue, Shape, Type, Zone};
use crate::names::{self, Case, Wish};

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
    /// The bits of its numbers, where each number of so many bits has a name.
    pub complete: Option<String>,
    pub variants: Vec<VariantModel>,
}

/// A value.
pub(super) struct VariantModel {
    pub name: String,
    pub docs: String,
    pub value: String,
}

/// The most bits of an enumeration that may name every number.
const COMPLETE: u32 = 6;

/// Variants of every enumeration, and what its code names.
const RESERVED: [&str; 2] = ["Self", "Unknown"];

/// The enumeration at this position, as yet without a name; `None` where it has no value that its integer has.
///
/// One `in_field` that names every number of so many bits has no variant for others.
pub(super) fn model(
    scope: &Scope<'_>,
    position: u32,
    in_field: bool,
    options: &RustOptions,
) -> Option<EnumerationModel> {
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
    let bits = base.bits()?;
    let complete = in_field && bits <= COMPLETE && values.len() == 1 << bits;
    let variants = variants(&values, scope);
    let mut docs = docs::of_type(scope, position);
    let row = |(value, own): (&&EnumValue, &VariantModel)| {
        let meaning = doc_table::meaning(&value.name, &own.name, value.documentation.as_deref());
        [own.value.clone(), format!("[`{0}`](Self::{0})", own.name), meaning]
    };
    let rows: Vec<[String; 3]> = values.iter().zip(&variants).take(doc_table::MAX_ROWS + 1).map(row).collect();
    docs.extend(doc_table::table(["Value", "Name", "Meaning"], &rows));
    Some(EnumerationModel {
        docs,
        derives: options.derives(true),
        base: path,
        native,
        ty: base,
        bits,
        complete: complete.then(|| format!("{:#X}", (1_u32 << bits) - 1).replacen("0X", "0x", 1)),
        variants,
        name: String::new(),
    })
}

fn variants(values: &[&EnumValue], scope: &Scope<'_>) -> Vec<VariantModel> {
    let wishes: Vec<Wish<'_>> = values
        .iter()
        .map(|value| Wish::new(&value.name, "value", value.value.to_string().replace('-', "Minus")))
        .collect();
    let names = names::unique(&wishes, &RESERVED, Case::Pascal);
    let variant = |(value, name): (&&EnumValue, String)| {
        let number = value_type::number(value.value, value.value > 0);
        let title = docs::escape(&value.name);
        let mut docs =
            if title.is_empty() { format!("{number}.") } else { format!("{number}: {}", docs::sentence(&title)) };
        for more in about(value, scope) {
            docs.push(' ');
            docs.push_str(&more);
        }
        VariantModel { name, docs, value: number }
    };
    values.iter().zip(names).map(variant).collect()
}

/// What else is known of a value.
fn about(value: &EnumValue, scope: &Scope<'_>) -> Vec<String> {
    let mut sentences = Vec::new();
    match value.zone {
        Some(Zone::Reserved) => sentences.push("Must not be used.".to_owned()),
        Some(Zone::Vendor) => sentences.push("Left to the vendor.".to_owned()),
        None => {}
    }
    docs::words(value.documentation.as_deref(), &mut sentences);
    if let Some(condition) = &value.when {
        sentences.push(format!("Only while {}.", docs::holds(condition, scope, Here::TYPES)));
    }
    if let Some(availability) = &value.availability {
        sentences.push(WORDS.availability(availability));
    }
    sentences.extend(WORDS.place(&scope.manual, "", value.documentation.as_deref(), &value.names));
    sentences
}
