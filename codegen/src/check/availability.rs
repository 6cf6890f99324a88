//! Firmware versions of items, bits, values, messages and replacements: notation and order.

use std::cmp::Ordering;

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::firmware::{compare, version};
use crate::ir::{stated, Availability, Device, Item, ItemId, Shape};
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Context { device, owner, .. } = context;
    for (_, id, item) in owner.identified() {
        let Some(availability) = item.availability.as_deref() else { continue };
        window(&format!("`{}`", brief(&item.name)), availability, item.origin.span, diagnostics);
        replacement(device, id, item, availability, diagnostics);
    }
    for (_, definition) in stated::types(&device.types) {
        let windows: Vec<_> = match &definition.shape {
            Shape::BitField { fields, .. } => fields.iter().map(|field| (&field.name, &field.availability)).collect(),
            Shape::Enumeration { values, .. } => {
                values.iter().map(|value| (&value.name, &value.availability)).collect()
            }
            _ => continue,
        };
        for (name, availability) in windows.into_iter().filter_map(|(name, window)| Some((name, window.as_deref()?))) {
            let what = format!("`{}` of `{}`", brief(name), brief(&definition.name));
            window(&what, availability, definition.origin.span, diagnostics);
        }
    }
    for message in &device.messages {
        let Some(availability) = message.availability.as_deref() else { continue };
        window(&format!("`{}`", brief(&message.name)), availability, message.origin.span, diagnostics);
    }
}

/// Returns the version in the notation of Lexibus for a text such as `6,15`, `v6.15` or `6-15`.
fn corrected(text: &str) -> Option<String> {
    let text = text.trim().trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == '.' || c == ' ');
    let text = text.replace([',', '-', '_'], ".");
    // Without a separator, the version is ambiguous: `Fw710` is 7.10 or 710.
    (text.contains('.') && version(&text).is_some()).then_some(text)
}

fn window(what: &str, availability: &Availability, span: Span, diagnostics: &mut Diagnostics) {
    for text in [&availability.since, &availability.until].into_iter().flatten() {
        if version(text).is_none() {
            let message =
                format!("{what} names the firmware version `{}`, which does not have the form `6.15`", brief(text));
            let found = codes::VERSION_FORM.at(span, message).label("not compared with other versions");
            diagnostics.push(found.help(match corrected(text) {
                Some(version) => format!("write `{version}`"),
                None => "write the version as numbers separated by dots, such as `6.15`".to_owned(),
            }));
        }
    }
    let (since, until) = (availability.since.as_deref(), availability.until.as_deref());
    if compare(since, until).is_some_and(|order| order != Ordering::Less) {
        let (since, until) = (since.unwrap_or_default(), until.unwrap_or_default());
        let message =
            format!("{what} is added in firmware {since} and removed in firmware {until}, so no version has it");
        diagnostics.push(codes::FIRMWARE_WINDOW.at(span, message));
    }
}

fn replacement(device: &Device, id: ItemId, item: &Item, availability: &Availability, diagnostics: &mut Diagnostics) {
    let replaced_by = availability.replaced_by.as_ref();
    let Some(other_id) = replaced_by.and_then(|other| other.id?.item()) else { return };
    let Some(other) = device.item(other_id) else { return };
    let span = item.origin.span;
    let name = brief(&item.name);
    if other_id == id {
        diagnostics.push(codes::FIRMWARE_WINDOW.at(span, format!("`{name}` replaces itself")));
        return;
    }
    let (since, until) = match &other.availability {
        Some(other) => (other.since.as_deref(), other.until.as_deref()),
        None => (None, None),
    };
    let ends = availability.until.as_deref();
    let message = match (compare(since, ends), compare(until, ends)) {
        (_, Some(Ordering::Less | Ordering::Equal)) => "its replacement no longer exists in this version".to_owned(),
        (Some(Ordering::Less), _) => format!("its replacement is added earlier, in {}", since.unwrap_or_default()),
        (Some(Ordering::Greater), _) => format!("its replacement is added later, in {}", since.unwrap_or_default()),
        _ => return,
    };
    let message = format!("`{name}` is removed in firmware {}, but {message}", ends.unwrap_or_default());
    diagnostics.push(codes::FIRMWARE_WINDOW.at(span, message).note_at(other.origin.span, "the replacement"));
}
