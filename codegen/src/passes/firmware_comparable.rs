//! After this pass the firmware windows of items, bits, values and messages were read as numbers, and held against each
//! other and against those of what replaces them.

use std::cmp::Ordering;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::{Index, Owner};
use crate::ir::{Availability, Device, Item, Shape};
use crate::selection::glob;
use crate::source::Span;
use crate::text::brief;

pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    let items = Index::new(owner);
    for item in owner.items() {
        let Some(own) = item.availability.as_deref() else { continue };
        window(&format!("`{}`", brief(&item.name)), own, item.origin.span, diagnostics);
        replacement(item, own, &items, diagnostics);
    }
    for definition in &device.types {
        let windows: Vec<_> = match &definition.shape {
            Shape::BitField { fields, .. } => fields.iter().map(|field| (&field.name, &field.availability)).collect(),
            Shape::Enumeration { values, .. } => {
                values.iter().map(|value| (&value.name, &value.availability)).collect()
            }
            _ => continue,
        };
        for (name, own) in windows {
            let what = format!("`{}` of `{}`", brief(name), brief(&definition.name));
            own.iter().for_each(|own| window(&what, own, definition.origin.span, diagnostics));
        }
    }
    for message in &device.messages {
        let what = format!("`{}`", brief(&message.name));
        message.availability.iter().for_each(|own| window(&what, own, message.origin.span, diagnostics));
    }
}

/// A version as numbers: `6.27` is later than `6.3`, and `6` is `6.0`. `None` where it has another form.
pub(super) fn version(text: &str) -> Option<Vec<u32>> {
    let mut numbers = text.split('.').map(|part| part.parse().ok()).collect::<Option<Vec<u32>>>()?;
    while numbers.len() > 1 && numbers.last() == Some(&0) {
        numbers.pop();
    }
    Some(numbers)
}

/// The version that a text in another form stands for: `6,15`, `v6.15`, `6-15`.
fn meant(text: &str) -> Option<String> {
    let text = text.trim().trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == '.' || c == ' ');
    let text = text.replace([',', '-', '_'], ".");
    // `Fw710` is 7.10 or 710.
    (text.contains('.') && version(&text).is_some()).then_some(text)
}

fn compare(one: Option<&str>, other: Option<&str>) -> Option<Ordering> {
    Some(version(one?)?.cmp(&version(other?)?))
}

/// Whether no model and no firmware has both.
pub(crate) fn apart(one: Option<&Availability>, other: Option<&Availability>) -> bool {
    let (Some(one), Some(other)) = (one, other) else { return false };
    let before = |first: &Availability, second: &Availability| {
        compare(first.until.as_deref(), second.since.as_deref()).is_some_and(|order| order != Ordering::Greater)
    };
    let shared = |own: &crate::ir::CompactString| other.models.iter().any(|model| glob(own, model) || glob(model, own));
    let models = !one.models.is_empty() && !other.models.is_empty() && !one.models.iter().any(shared);
    models || before(one, other) || before(other, one)
}

fn window(what: &str, own: &Availability, span: Span, diagnostics: &mut Diagnostics) {
    for text in [&own.since, &own.until].into_iter().flatten() {
        if version(text).is_none() {
            let message = format!("{what} has the firmware version `{}`, which isn't numbers and points", brief(text));
            let found = Diagnostic::new(&codes::VERSION_FORM, span, message).label("not compared");
            diagnostics.push(found.help(match meant(text) {
                Some(meant) => format!("write `{meant}`"),
                None => "write the numbers of the version with points between them, such as `6.15`".to_owned(),
            }));
        }
    }
    let order = compare(own.since.as_deref(), own.until.as_deref());
    if order.is_some_and(|order| order != Ordering::Less) {
        let (since, until) = (own.since.as_deref().unwrap_or_default(), own.until.as_deref().unwrap_or_default());
        let message = format!("{what} exists since {since} and until {until}, so that no firmware has it");
        diagnostics.push(Diagnostic::new(&codes::FIRMWARE_WINDOW, span, message));
    }
}

fn replacement(item: &Item, own: &Availability, items: &Index<'_>, diagnostics: &mut Diagnostics) {
    let Some(other) = own.replaced_by.as_ref().and_then(|name| items.find(name)) else { return };
    let span = item.origin.span;
    let name = brief(&item.name);
    if std::ptr::eq(other, item) {
        diagnostics.push(Diagnostic::new(&codes::FIRMWARE_WINDOW, span, format!("`{name}` replaces itself")));
        return;
    }
    let (since, until) = match &other.availability {
        Some(other) => (other.since.as_deref(), other.until.as_deref()),
        None => (None, None),
    };
    let ends = own.until.as_deref();
    let message = match (compare(since, ends), compare(until, ends)) {
        (_, Some(Ordering::Less | Ordering::Equal)) => "its replacement is gone by then".to_owned(),
        (Some(Ordering::Less), _) => format!("its replacement exists since {} already", since.unwrap_or_default()),
        (Some(Ordering::Greater), _) => format!("its replacement exists since {} only", since.unwrap_or_default()),
        _ => return,
    };
    let message = format!("`{name}` exists until {}, and {message}", ends.unwrap_or_default());
    let found = Diagnostic::new(&codes::FIRMWARE_WINDOW, span, message);
    diagnostics.push(found.note_at(other.origin.span, "the replacement"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_as_numbers() {
        assert!(version("6.27") > version("6.3") && version("10") > version("9.99") && version("6") == version("6.0"));
        for text in ["Fw710", "6,15", "", "6.", "v6"] {
            assert_eq!(version(text), None, "{text}");
        }
    }

    #[test]
    fn windows_and_models_keep_apart() {
        let window = |since: Option<&str>, until: Option<&str>, models: &[&str]| Availability {
            since: since.map(Into::into),
            until: until.map(Into::into),
            models: models.iter().map(|&model| model.into()).collect(),
            ..Availability::default()
        };
        let old = window(None, Some("6.15"), &[]);
        assert!(apart(Some(&old), Some(&window(Some("6.15"), None, &[]))));
        assert!(!apart(Some(&old), Some(&window(Some("6.3"), None, &[]))));
        assert!(!apart(Some(&old), None));
        assert!(apart(Some(&window(None, None, &["SMD22*"])), Some(&window(None, None, &["BMD*"]))));
        assert!(!apart(Some(&window(None, None, &["SMD*"])), Some(&window(None, None, &["SMD2204"]))));
    }
}
