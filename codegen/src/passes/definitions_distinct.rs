//! After this pass the names within every bit field and enumeration of a register table were held against each other, and
//! against the titles of columns that slide into them.

use std::collections::HashMap;

use super::firmware_comparable::apart;
use super::owner::Owner;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{BitFieldEntry, BitMeaning, Shape, TypeDef};
use crate::text::brief;

/// Titles of the column in which manuals say what values mean, and which nothing else is called.
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

pub(super) fn run(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    for definition in owner.types {
        match &definition.shape {
            Shape::BitField { fields, .. } => {
                titles(definition, fields.iter().map(|field| field.name.as_str()), diagnostics);
                twice(definition, fields, diagnostics);
            }
            Shape::Enumeration { values, .. } => {
                titles(definition, values.iter().map(|value| value.name.as_str()), diagnostics);
            }
            _ => {}
        }
    }
}

fn titles<'n>(definition: &TypeDef, names: impl Iterator<Item = &'n str>, diagnostics: &mut Diagnostics) {
    let is_title = |name: &&str| TITLES.contains(&name.trim().trim_end_matches('.').to_lowercase().as_str());
    for name in names.filter(is_title) {
        let message = format!("`{}` of `{}` is the title of a column", brief(name), brief(&definition.name));
        let found = Diagnostic::new(&codes::BROKEN_NAME, definition.origin.span, message);
        diagnostics.push(found.help("a line of the printed table slid down or up: look at the values beside it"));
    }
}

/// Bits that are called the same, and that neither a mode nor the firmware tells apart.
fn twice(definition: &TypeDef, fields: &[BitFieldEntry], diagnostics: &mut Diagnostics) {
    let mut first: HashMap<&str, &BitFieldEntry> = HashMap::new();
    let is_named = |field: &&BitFieldEntry| {
        !field.name.is_empty() && field.when.is_none() && !matches!(field.meaning, BitMeaning::Reserved { .. })
    };
    for field in fields.iter().filter(is_named) {
        let other = *first.entry(field.name.as_str()).or_insert(field);
        let is_same = other.offset == field.offset && other.bits == field.bits;
        if !is_same && !apart(other.availability.as_deref(), field.availability.as_deref()) {
            let (own, name) = (brief(&field.name), brief(&definition.name));
            let message = format!("bits {} and {} of `{name}` are both called `{own}`", other.offset, field.offset);
            diagnostics.push(Diagnostic::new(&codes::NAME_TWICE, definition.origin.span, message));
        }
    }
}
