//! Writes lists of named values, and ranges of numbers.

use std::collections::HashSet;
use std::fmt::Display;

use super::Context;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{EnumValue, Numbers, Shape, TypeDef};

/// Writes the ValueList element. The element contains one list per name, even if several enumerations have the same
/// name.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>) {
    let types = context.types;
    let enumeration = |def: &'_ TypeDef| matches!(def.shape, Shape::Enumeration { .. });
    if !types.iter().any(enumeration) {
        return;
    }
    let mut seen = HashSet::new();
    xml.open("ValueList");
    for def in types {
        let Shape::Enumeration { values, .. } = &def.shape else { continue };
        if !seen.insert(&def.name) {
            continue;
        }
        xml.open("ValueItem");
        xml.attribute("ID", &def.name);
        context.texts.documentation(xml, "Help", def.documentation.as_deref());
        if !values.is_empty() {
            assignments(xml, context, values);
        }
        xml.close();
    }
    xml.close();
}

/// Writes the values of a list. No two values of a list share a text.
fn assignments(xml: &mut Xml, context: &mut Context<'_>, values: &[EnumValue]) {
    let mut used = HashSet::new();
    xml.open("Assignments");
    for value in values {
        let mut text = context.texts.id(&value.name, &value.names);
        if !used.insert(text.clone()) {
            text = context.texts.add(&value.name, &value.names);
        }
        xml.open("Assign");
        xml.attribute("TextId", text);
        match value.last {
            Some(last) => xml.attribute("Content", format_args!("{}..{last}", value.value)),
            None => xml.attribute("Content", value.value),
        }
        xml.close();
        let is_more = value.documentation.is_some();
        xml.notes.add_many(NoteKind::Documentation, is_more, Subject::Named(&value.name));
    }
    xml.close();
}

/// Formats ranges of numbers in the notation of GSDML.
pub(super) fn ranges(numbers: &Numbers) -> String {
    numbers.0.iter().map(|(first, last)| range(first, last)).collect::<Vec<_>>().join(" ")
}

/// Formats a range of values in the notation of GSDML.
pub(super) fn range<T: PartialEq + Display>(first: T, last: T) -> String {
    if first == last {
        first.to_string()
    } else {
        format!("{first}..{last}")
    }
}
