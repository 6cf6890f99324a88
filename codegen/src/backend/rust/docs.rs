//! Doc comments: what the source says, so that Markdown shows it as it is.

use std::fmt::Write;

use super::literal;
use super::manual::{self, Manual};
use super::place::Place;
use super::quantity;
use super::scope::Scope;
use super::value_type;
use crate::backend::markdown;
pub(super) use crate::backend::words::sentence;
use crate::backend::words::Words;
use crate::ir::{Binding, Condition, Documentation, Item, Limits, Type, Value};

/// Sentences for doc comments.
pub(super) const WORDS: Words = Words { escape };

/// Text as one line of Markdown without any markup.
pub(super) fn escape(text: &str) -> String {
    markdown::escape(text, literal::is_harmless)
}

/// The lines about an item: its name, then its address, type, access and values, then what else is known.
pub(super) fn item(item: &Item, name: &str, chapter: Option<&str>, scope: &Scope<'_>) -> Vec<String> {
    let mut lines = Vec::with_capacity(4);
    if !name.trim().is_empty() {
        lines.push(sentence(&escape(name)));
        lines.push(String::new());
    }
    lines.push(facts(item, scope));
    documentation(item, &mut lines);
    let mut paragraphs = Vec::new();
    if let Some(quantity) = &item.quantity {
        paragraphs.extend(quantity::notes(quantity));
    }
    if let Some(behaviour) = &item.behaviour {
        paragraphs.push(WORDS.behaviour(behaviour).join(" "));
    }
    paragraphs.extend(item.bindings.iter().filter_map(elsewhere));
    let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
    paragraphs.extend(item.variants.iter().map(|own| WORDS.variant(own, unit)));
    if let Some(availability) = &item.availability {
        paragraphs.push(manual::availability(availability));
    }
    let place = scope.manual.place(item.documentation.as_deref(), &item.names);
    let chapter = chapter.filter(|chapter| !chapter.trim().is_empty());
    let chapter = chapter.map(|chapter| format!("Chapter {}", sentence(&escape(chapter))));
    paragraphs.push(chapter.into_iter().chain(place).collect::<Vec<_>>().join(" "));
    paragraphs.extend(item.doubts.iter().map(manual::doubt));
    for paragraph in paragraphs.into_iter().filter(|paragraph| !paragraph.is_empty()) {
        lines.extend([String::new(), paragraph]);
    }
    lines
}

/// An address that no client of the runtime has.
fn elsewhere(binding: &Binding) -> Option<String> {
    match binding {
        Binding::Ascii(name) => Some(format!("Called {} in the device's ASCII protocol.", escape(name))),
        Binding::EscMemory { address, length } => {
            Some(format!("Memory of the slave controller: {length} bytes from 0x{address:04X} on."))
        }
        _ => None,
    }
}

/// `Mode is 1 or 2`, `Status & 0x4 is 0`.
pub(super) fn holds(condition: &Condition) -> String {
    WORDS.holds(condition)
}

/// The words of a description, as sentences.
pub(super) fn words(documentation: Option<&Documentation>, sentences: &mut Vec<String>) {
    sentences.extend(WORDS.description(documentation));
}

/// What a source says of an element and where it says so, in paragraphs of their own.
pub(super) fn described(documentation: Option<&Documentation>, manual: &Manual, lines: &mut Vec<String>) {
    let mut sentences = Vec::new();
    words(documentation, &mut sentences);
    sentences.extend(manual.place(documentation, &[]));
    for sentence in sentences {
        lines.extend([String::new(), sentence]);
    }
}

fn facts(item: &Item, scope: &Scope<'_>) -> String {
    let base = scope.base(item.ty);
    let mut line = String::with_capacity(64);
    let place = Place::of(scope, item).facts();
    if !place.is_empty() {
        let _ = write!(line, "{}, ", capital(&place));
    }
    let _ = write!(line, "{base}, {}", item.access.name());
    match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => line.push_str(", mappable into any PDO"),
        (true, false) => line.push_str(", mappable into RPDOs"),
        (false, true) => line.push_str(", mappable into TPDOs"),
        (false, false) => {}
    }
    if let Some(default) = &item.default {
        let _ = write!(line, ", default {}", typed(default, base));
    }
    if let Some(range) = limits(&item.limits) {
        let _ = write!(line, ", {range}");
        if let Some(physical) = quantity::limits(item) {
            let _ = write!(line, " ({physical})");
        }
    }
    if let Some(quantity) = &item.quantity {
        line.push_str(&quantity::facts(quantity));
    }
    if let Some(configured) = item.configured.as_ref().and_then(|configured| configured.value.as_ref()) {
        let _ = write!(line, ", configured to {}", typed(configured, base));
    }
    line.push('.');
    line
}

fn typed(shown: &Value, ty: Type) -> String {
    match shown {
        Value::Int(number) => value_type::number(*number, matches!(ty, Type::Unsigned(_))),
        other => value(other),
    }
}

pub(super) fn value(value: &Value) -> String {
    WORDS.value(value)
}

pub(super) fn limits(limits: &Limits) -> Option<String> {
    WORDS.limits(limits)
}

fn documentation(item: &Item, lines: &mut Vec<String>) {
    let denotation = item.configured.as_ref().and_then(|configured| configured.denotation.as_ref());
    if let Some(denotation) = denotation {
        lines.push(String::new());
        lines.push(format!("Denotation: {}", sentence(&escape(denotation))));
    }
    let Some(documentation) = &item.documentation else { return };
    for paragraph in documentation.text.lines().filter(|line| !line.trim().is_empty()) {
        lines.push(String::new());
        lines.push(escape(paragraph));
    }
}

/// `text` as the start of a sentence.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_is_shown_not_obeyed() {
        assert_eq!(escape("a[b] <i> `x` *y*"), r"a\[b\] \<i\> \`x\` \*y\*");
        assert_eq!(escape("- 1"), r"\- 1");
        assert_eq!(escape("1. x"), r"1\. x");
        assert_eq!(escape("see https://x"), r"see https\://x");
        assert_eq!(escape("a\u{202e}b\nc"), "a b c");
    }
}
