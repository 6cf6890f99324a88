//! Firmware versions of items, bits, values and messages: their form, their order, and those of replacements.

use std::cmp::Ordering;

use super::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::firmware::{compare, version};
use crate::ir::{Availability, Device, Item, Shape};
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Context { device, owner, .. } = context;
    for item in owner.items() {
        let Some(own) = item.availability.as_deref() else { continue };
        window(&format!("`{}`", brief(&item.name)), own, item.origin.span, diagnostics);
        replacement(device, item, own, diagnostics);
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

/// The version that a text in another form stands for: `6,15`, `v6.15`, `6-15`.
fn meant(text: &str) -> Option<String> {
    let text = text.trim().trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == '.' || c == ' ');
    let text = text.replace([',', '-', '_'], ".");
    // `Fw710` is 7.10 or 710.
    (text.contains('.') && version(&text).is_some()).then_some(text)
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

fn replacement(device: &Device, item: &Item, own: &Availability, diagnostics: &mut Diagnostics) {
    let Some(other) = own.replaced_by.as_ref().and_then(|other| device.referred(other)) else { return };
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
