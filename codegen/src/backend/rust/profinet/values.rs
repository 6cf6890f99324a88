//! Enumerations, which contain the named values of fields (`ValueItem`).

use std::collections::BTreeMap;

use super::docs;
use super::types::resolve;
use crate::backend::rust::doc_table;
use crate::backend::rust::value_type::native;
use crate::backend::rust::RustOptions;
use crate::collections::HashSet;
use crate::ir::{EnumValue, Shape, Type, TypeDef};
use crate::names::{self, Case, NameRequest};

/// Names that variants must not have: the keyword `Self`, and `Unknown`, the variant for unlisted values.
const RESERVED_VARIANTS: [&str; 2] = ["Self", "Unknown"];

/// Names that enumerations must not have. `Self` is a keyword, and the generated code uses names of the prelude, such
/// as `Option`. On an enumeration named `FromRaw`, clippy would report the function `from_raw`, because a constructor
/// must not have the name of its type.
const RESERVED_TYPES: [&str; 8] = ["Self", "Option", "Result", "Some", "None", "Ok", "Err", "FromRaw"];

/// The enumerations of a catalog that generated code uses.
pub(super) struct Values<'a> {
    pub types: &'a [TypeDef],
    enumerations: BTreeMap<u32, Enumeration>,
}

/// An enumeration, ready to be printed.
pub(in crate::backend::rust) struct Enumeration {
    pub name: String,
    /// Path of the enumeration, relative to a submodule's module.
    pub path: String,
    /// Primitive integer that holds the values.
    pub native: &'static str,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub variants: Vec<Variant>,
}

/// A named value of an enumeration.
pub(in crate::backend::rust) struct Variant {
    pub name: String,
    pub docs: String,
    pub value: i128,
}

impl Enumeration {
    /// Returns the minimum and maximum of the primitive integer that holds a value.
    pub(super) fn range(&self) -> Option<(i128, i128)> {
        let bits = self.native.get(1..)?.parse().ok()?;
        let ty = if self.native.starts_with('i') { Type::Integer(bits) } else { Type::Unsigned(bits) };
        ty.integer_range()
    }
}

impl<'a> Values<'a> {
    /// Creates the enumerations that occur among the types `used`.
    pub(super) fn new(types: &'a [TypeDef], used: impl Iterator<Item = Type>, options: &RustOptions) -> Self {
        let mut positions: Vec<u32> = used.filter_map(|ty| resolve(types, ty).1).collect();
        positions.sort_unstable();
        positions.dedup();
        let found: Vec<(u32, &TypeDef, Type, Vec<&EnumValue>)> = positions
            .into_iter()
            .filter_map(|at| {
                let definition = types.get(at as usize)?;
                let (base, values) = listed(types, definition)?;
                Some((at, definition, base, values))
            })
            .collect();
        // If a list of values is used with several base types, each base type gets its own enumeration.
        let name_requests = found.iter().map(|(at, definition, base, _)| NameRequest {
            name: &definition.name,
            fallback: format!("values {at}"),
            suffix: format!("{}{}", if base.is_signed() { "I" } else { "U" }, base.bits().unwrap_or(0)),
        });
        let names = names::unique(name_requests, &RESERVED_TYPES, Case::Pascal);
        let all = found.iter().zip(names);
        let enumerations =
            all.map(|((at, definition, base, values), name)| (*at, model(definition, *base, values, name, options)));
        Values { types, enumerations: enumerations.collect() }
    }

    /// Returns the enumerations.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Enumeration> {
        self.enumerations.values()
    }

    /// Returns the basic type of `ty`, and its enumeration if it has one.
    pub(super) fn resolve(&self, ty: Type) -> (Type, Option<&Enumeration>) {
        let (base, position) = resolve(self.types, ty);
        (base, position.and_then(|position| self.enumerations.get(&position)))
    }
}

/// Returns the base type of an enumeration and the values that fit in it, without repetitions. A range of values does
/// not become a variant. Returns `None` if no value remains, or if the base type is not an integer.
fn listed<'a>(types: &[TypeDef], definition: &'a TypeDef) -> Option<(Type, Vec<&'a EnumValue>)> {
    let Shape::Enumeration { base, values, .. } = &definition.shape else { return None };
    let base = match resolve(types, *base).0 {
        Type::Boolean => Type::Unsigned(1),
        other => other,
    };
    let (low, high) = base.integer_range()?;
    let mut seen = HashSet::default();
    let fits =
        |value: &&EnumValue| value.last.is_none() && (low..=high).contains(&value.value) && seen.insert(value.value);
    let values: Vec<&EnumValue> = values.iter().filter(fits).collect();
    (!values.is_empty()).then_some((base, values))
}

fn model(definition: &TypeDef, base: Type, values: &[&EnumValue], name: String, options: &RustOptions) -> Enumeration {
    let native = native(base.is_signed(), base.bits().unwrap_or(64));
    // Use at most 255 values as variants. If all 8-bit numbers had a variant, `Unknown` would be unreachable.
    let values = &values[..values.len().min(usize::from(u8::MAX))];
    let name_requests = values.iter().map(|value| {
        let number = value.value.to_string().replace('-', "minus ");
        NameRequest { name: &value.name, suffix: number.replace(' ', ""), fallback: format!("value {number}") }
    });
    let names = names::unique(name_requests, &RESERVED_VARIANTS, Case::Pascal);
    let variant = |(value, name): (&&EnumValue, String)| {
        let title = docs::escape(&value.name);
        let separator = if title.is_empty() { "" } else { ": " };
        Variant { name, docs: docs::sentence(&format!("{}{separator}{title}", value.value)), value: value.value }
    };
    let title = docs::escape(&definition.name);
    let title = format!("{}, {} bits.", if title.is_empty() { "Values" } else { &title }, base.bits().unwrap_or(0));
    let mut lines = docs::documented(title, &definition.name, definition.documentation.as_deref());
    let row = |(value, name): (&&EnumValue, &String)| {
        let meaning = doc_table::meaning(&value.name, name, value.documentation.as_deref());
        [value.value.to_string(), format!("[`{name}`](Self::{name})"), meaning]
    };
    let rows: Vec<[String; 3]> = values.iter().zip(&names).map(row).collect();
    lines.extend(doc_table::table(["Value", "Name", "Meaning"], &rows));
    Enumeration {
        path: format!("values::{name}"),
        name,
        native,
        docs: lines,
        derives: options.derives(true),
        variants: values.iter().zip(names).map(variant).collect(),
    }
}
