//! Enumerations: named values of an integer.

use crate::collections::HashSet;
use crate::number::hex;

use super::context::Context;
use super::doc_table;
use super::docs::{self, WORDS};
use super::links::DocModule;
use super::literal;
use super::naming::types::NamedType;
use super::options::RustOptions;
use super::value_type;
use crate::ir::{EnumValue, Shape, Zone};
use crate::names::{self, Case, NameRequest};

/// An enumeration, ready to be printed.
pub(super) struct EnumerationModel {
    pub name: String,
    /// True if a profile states the enumeration.
    pub is_of_profile: bool,
    /// Sentence about the items that use the enumeration. The sentence is also part of the documentation.
    pub users: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// Rust path of the base type, such as `u8` or `rt::Uint<3>`.
    pub base: String,
    /// Primitive integer that holds the raw value, such as `u8`.
    pub native: &'static str,
    /// Mask of the value's bits if the enumeration has no variant `Unknown`. `None` otherwise.
    pub complete: Option<String>,
    pub variants: Vec<VariantModel>,
    /// The `cfg` attribute of the code with the names of the values, if the options request `Debug`.
    pub texts: Option<Vec<String>>,
    /// The `cfg` attribute of `PartialEq`, `Eq` and `Hash`, if the options request these.
    pub equality: Option<Vec<String>>,
}

/// A named value of an enumeration.
pub(super) struct VariantModel {
    pub name: String,
    pub docs: String,
    pub value: String,
    /// Literal of the name in the description.
    pub title: String,
}

/// Maximum number of bits of an enumeration without the variant `Unknown`.
const COMPLETE: u32 = 6;

/// Names that variants must not have, because the generated code uses them.
const RESERVED: [&str; 2] = ["Self", "Unknown"];

/// Returns the model of the enumeration at `position` in the list of types.
///
/// The enumeration has no variant `Unknown` if it is the type of a field in a bit field and names all numbers of its
/// width. The width must be at most [`COMPLETE`] bits.
pub(super) fn model(
    context: &Context<'_>,
    position: u32,
    named: &NamedType,
    options: &RustOptions,
) -> EnumerationModel {
    let all = match context.types.get(position as usize).map(|definition| &definition.shape) {
        Some(Shape::Enumeration { values, .. }) => values.as_slice(),
        _ => &[],
    };
    let (low, high) = named.ty.integer_range().unwrap_or_default();
    let mut seen = HashSet::default();
    let values: Vec<&EnumValue> = all
        .iter()
        .filter(|value| value.last.is_none() && (low..=high).contains(&value.value) && seen.insert(value.value))
        .collect();
    let in_field = context.names.types.in_fields.contains(&position);
    let complete = in_field && named.bits <= COMPLETE && values.len() == 1 << named.bits;
    let variants = variants(&values, context);
    let users = context.links.users(position, DocModule::TYPES);
    let mut docs = docs::of_type(context, position, &users);
    docs.extend(table(if complete { &[] } else { all }, &values, &variants));
    EnumerationModel {
        docs,
        // `PartialEq` compares the numbers, so that `Unknown(1)` equals the variant for 1.
        derives: options.derives_without_equality(),
        texts: RustOptions::gate(&options.debug),
        equality: RustOptions::gate(&options.partial_eq),
        base: named.base.clone(),
        native: named.native,
        complete: complete.then(|| hex((1_u32 << named.bits) - 1)),
        variants,
        name: named.name.clone(),
        is_of_profile: context.is_of_profile(position),
        users,
    }
}

/// Returns the documentation table: the ranges of numbers and, unless there are too many, the variants. The table shows
/// the variant `Unknown` for each range.
fn table(all: &[EnumValue], values: &[&EnumValue], variants: &[VariantModel]) -> Vec<String> {
    let mut rows: Vec<(i128, [String; 3])> = Vec::new();
    if variants.len() <= doc_table::MAX_ROWS {
        rows.extend(values.iter().zip(variants).map(|(value, variant)| {
            let meaning = doc_table::meaning(&value.name, &variant.name, value.documentation.as_deref());
            (value.value, [variant.value.clone(), format!("[`{0}`](Self::{0})", variant.name), meaning])
        }));
    }
    let ranges = all.iter().filter(|value| value.last.is_some());
    rows.extend(ranges.map(|range| {
        let mut meaning = vec![doc_table::meaning(&range.name, "", range.documentation.as_deref())];
        meaning.extend(zone(range).map(str::to_owned));
        meaning.retain(|part| !part.is_empty());
        (range.value, [range.numbers(), "[`Unknown`](Self::Unknown)".to_owned(), meaning.join(" ")])
    }));
    if rows.len() > variants.len() {
        rows.sort_by_key(|(value, _)| *value);
    }
    let rows: Vec<[String; 3]> = rows.into_iter().map(|(_, row)| row).collect();
    doc_table::whole(["Value", "Name", "Meaning"], &rows)
}

fn variants(values: &[&EnumValue], context: &Context<'_>) -> Vec<VariantModel> {
    let name_requests = values
        .iter()
        .map(|value| NameRequest::new(&value.name, "value", value.value.to_string().replace('-', "Minus")));
    let names = names::unique(name_requests, &RESERVED, Case::Pascal);
    let variant = |(value, name): (&&EnumValue, String)| {
        let number = value_type::number(value.value, value.value > 0);
        let title = docs::escape(&value.name);
        let mut docs =
            if title.is_empty() { format!("{number}.") } else { format!("{number}: {}", docs::sentence(&title)) };
        further_facts(value, context).iter().for_each(|more| docs.extend([" ", more]));
        VariantModel { name, docs, value: number, title: literal::string(&value.name) }
    };
    values.iter().zip(names).map(variant).collect()
}

/// Returns the sentences that follow the name of a value: reserved or vendor-specific, description, condition,
/// availability and citation.
fn further_facts(value: &EnumValue, context: &Context<'_>) -> Vec<String> {
    let mut sentences: Vec<String> = zone(value).map(str::to_owned).into_iter().collect();
    sentences.extend(WORDS.description(value.documentation.as_deref()));
    if let Some(condition) = &value.when {
        sentences
            .push(format!("This value is valid only while {}.", docs::holds(condition, context, DocModule::TYPES)));
    }
    if let Some(availability) = &value.availability {
        sentences.push(WORDS.availability(availability));
    }
    sentences.extend(WORDS.manual_entry(&context.manual, "", value.documentation.as_deref(), &value.names));
    sentences
}

fn zone(value: &EnumValue) -> Option<&'static str> {
    Some(match value.zone? {
        Zone::Reserved if value.name.eq_ignore_ascii_case("reserved") => "Do not use this value.",
        Zone::Reserved => "This value is reserved. Do not use it.",
        Zone::Vendor => "This value is vendor-specific.",
    })
}
