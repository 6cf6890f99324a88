//! Names of bits or values that are probably column titles of the manual.

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{stated, Shape, TypeDef};
use crate::text::brief;

/// Titles of table columns that are never names of bits or values.
const TITLES: [&str; 11] = [
    "definition",
    "definitions",
    "definizione",
    "description",
    "descrizione",
    "meaning",
    "significato",
    "beschreibung",
    "bedeutung",
    "codifica",
    "bit no",
];

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for (_, definition) in stated::types(context.owner.types) {
        match &definition.shape {
            Shape::BitField { fields, .. } => titles(definition, fields.iter().map(|field| &*field.name), diagnostics),
            Shape::Enumeration { values, .. } => {
                titles(definition, values.iter().map(|value| &*value.name), diagnostics)
            }
            _ => {}
        }
    }
}

fn titles<'n>(definition: &TypeDef, names: impl Iterator<Item = &'n str>, diagnostics: &mut Diagnostics) {
    let is_title = |name: &&str| TITLES.contains(&name.trim().trim_end_matches('.').to_lowercase().as_str());
    for name in names.filter(is_title) {
        let message = format!("the name `{}` in `{}` is a column title", brief(name), brief(&definition.name));
        let found = codes::BROKEN_NAME.at(definition.origin.span, message);
        diagnostics
            .push(found.help("compare the adjacent rows with the manual, because the cells have probably shifted"));
    }
}
