//! After this pass the names of a register table's rows were held against each other, and against the breaks that a
//! printed column puts into them.

use std::collections::HashMap;

use super::bit_fields_checked::told_apart;
use super::firmware_comparable::apart;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{BitFieldEntry, Device, EnumValue, Group, GroupKind, Shape, TypeDef};
use crate::source::Span;
use crate::text::brief;

pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let mut objects = HashMap::new();
    for group in &device.groups {
        match group.kind {
            GroupKind::Object { index, .. } => {
                let at = group.name_at.or(group.origin.span);
                once(&mut objects, &group.name, at, "another object", diagnostics);
                unbroken(&group.name, at, diagnostics);
                if group.object_code().is_some_and(|code| code.has_subs()) {
                    subs(group, index, diagnostics);
                }
            }
            GroupKind::Chapter => registers(group, diagnostics),
            _ => {}
        }
    }
    device.types.iter().for_each(|definition| meanings(definition, diagnostics));
}

/// The bits of a bit field, or the values of an enumeration. Names that depend on something may return.
fn meanings(definition: &TypeDef, diagnostics: &mut Diagnostics) {
    let twice: Option<(&str, String, String)> = match &definition.shape {
        Shape::BitField { fields, .. } => {
            let place = |field: &BitFieldEntry| match field.bits {
                1 => format!("bit {}", field.offset),
                bits => format!("bits {}-{}", u32::from(field.offset) + u32::from(bits) - 1, field.offset),
            };
            let found = repeated(fields.iter(), |field| field.name.as_str(), told_apart);
            found.map(|(one, other)| (one.name.as_str(), place(one), place(other)))
        }
        Shape::Enumeration { values, .. } => {
            let apart =
                |one: &EnumValue, other: &EnumValue| apart(one.availability.as_deref(), other.availability.as_deref());
            let named = values.iter().filter(|value| value.zone.is_none());
            let found = repeated(named, |value| value.name.as_str(), apart);
            found.map(|(one, other)| (one.name.as_str(), one.value.to_string(), other.value.to_string()))
        }
        _ => None,
    };
    if let Some((name, one, other)) = twice {
        let message = format!("{one} and {other} of `{}` are both called `{}`", brief(&definition.name), brief(name));
        let found = Diagnostic::new(&codes::NAME_TWICE, definition.origin.span, message);
        diagnostics.push(found.help("give one of them the name that the manual means, or say what tells them apart"));
    }
}

/// The first two that have one name.
fn repeated<'v, V>(
    list: impl Iterator<Item = &'v V>,
    name: impl Fn(&'v V) -> &'v str,
    apart: impl Fn(&V, &V) -> bool,
) -> Option<(&'v V, &'v V)> {
    let mut seen: HashMap<&str, &V> = HashMap::new();
    for own in list.filter(|own| !name(own).is_empty()) {
        match seen.get(name(own)) {
            Some(first) if !apart(first, own) => return Some((*first, own)),
            _ => seen.insert(name(own), own),
        };
    }
    None
}

fn subs(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::new();
    let other = format!("another sub-index of 0x{index:04X}");
    // Of a reserved sub-index there is nothing to say.
    for item in group.items.iter().filter(|item| !item.extensions.iter().any(|own| own.key == "reserved")) {
        let at = item.at.name.or(item.origin.span);
        once(&mut names, &item.name, at, &other, diagnostics);
        unbroken(&item.name, at, diagnostics);
    }
}

fn registers(group: &Group, diagnostics: &mut Diagnostics) {
    for item in &group.items {
        let at = item.at.name.or(item.origin.span);
        if item.name.trim().is_empty() {
            diagnostics.push(Diagnostic::new(&codes::EMPTY_NAME, at, "the row has no name"));
        }
        unbroken(&item.name, at, diagnostics);
    }
}

fn once<'n>(seen: &mut HashMap<&'n str, Span>, name: &'n str, at: Span, whose: &str, diagnostics: &mut Diagnostics) {
    if name.is_empty() {
        return;
    }
    let first = *seen.entry(name).or_insert(at);
    if first != at {
        let message = format!("{whose} is called `{}` too", brief(name));
        diagnostics.push(Diagnostic::new(&codes::NAME_TWICE, at, message).note_at(first, "the first one"));
    }
}

/// A column of a manual breaks `Rtouchprobefunc` into `Rtouchpro- befunc`.
fn unbroken(name: &str, at: Span, diagnostics: &mut Diagnostics) {
    let is_broken = name.split_once("- ").is_some_and(|(head, tail)| {
        head.ends_with(char::is_alphanumeric) && tail.trim_start().starts_with(char::is_alphanumeric)
    });
    if is_broken {
        let whole: String = name.replace("- ", "");
        let message = format!("`{}` has the hyphen of a line break in it", brief(name));
        let found = Diagnostic::new(&codes::BROKEN_NAME, at, message);
        diagnostics.push(found.help(format!("write `{}`, if the manual's text does", brief(&whole))));
    }
}
