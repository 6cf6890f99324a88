//! Duplicate names of objects, sub-indices, bits and values.

use super::bit_fields::are_distinct;
use super::context::Context;
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::firmware::apart;
use crate::ir::{stated, EnumValue, Group, GroupKind, Item, Shape, TypeDef};
use crate::number::hex16;
use crate::source::Span;
use crate::text::brief;

/// Reports objects, sub-indices, bits and values that share a name.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let mut names = HashMap::default();
    for group in &device.groups {
        if let GroupKind::Object { index, .. } = group.kind {
            once(&mut names, &group.name, group.name_at.or(group.origin.span), "another object", diagnostics);
            if group.object_code().is_some_and(|code| code.has_subs()) {
                subs(group, index, diagnostics);
            }
        }
    }
    stated::types(&device.types).for_each(|(_, definition)| meanings(definition, diagnostics));
}

/// Returns the location of the name of an item.
pub(super) fn name_span(item: &Item) -> Span {
    item.at.name.or(item.origin.span)
}

/// Returns whether an item has a meaning, that is, whether it is not a reserved sub-index.
pub(super) fn has_meaning(item: &&Item) -> bool {
    !item.is_reserved
}

/// Reports the first duplicate name in a bit field or enumeration. Bits or values that never exist together may share a
/// name.
fn meanings(definition: &TypeDef, diagnostics: &mut Diagnostics) {
    let duplicate: Option<(&str, String, String)> = match &definition.shape {
        Shape::BitField { fields, .. } => {
            let found = repeated(fields.iter(), |field| field.name.as_str(), are_distinct);
            found.map(|(one, other)| (one.name.as_str(), one.bit_range(), other.bit_range()))
        }
        Shape::Enumeration { values, .. } => {
            let apart =
                |one: &EnumValue, other: &EnumValue| apart(one.availability.as_deref(), other.availability.as_deref());
            let named = values.iter().filter(|value| value.is_named());
            let found = repeated(named, |value| value.name.as_str(), apart);
            found.map(|(one, other)| {
                (one.name.as_str(), format!("value {}", one.value), format!("value {}", other.value))
            })
        }
        _ => None,
    };
    if let Some((name, one, other)) = duplicate {
        let message = format!("{one} and {other} of `{}` are both called `{}`", brief(&definition.name), brief(name));
        let found = codes::NAME_TWICE.at(definition.origin.span, message);
        diagnostics
            .push(found.help("rename one of them as in the manual, or add the condition that distinguishes them"));
    }
}

/// Returns the first two elements of a list that share a name, unless `apart` returns true for them.
fn repeated<'v, V>(
    list: impl Iterator<Item = &'v V>,
    name: impl Fn(&'v V) -> &'v str,
    apart: impl Fn(&V, &V) -> bool,
) -> Option<(&'v V, &'v V)> {
    let mut seen: HashMap<&str, &V> = HashMap::default();
    for element in list.filter(|element| !name(element).is_empty()) {
        match seen.get(name(element)) {
            Some(first) if !apart(first, element) => return Some((*first, element)),
            _ => seen.insert(name(element), element),
        };
    }
    None
}

fn subs(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::default();
    let other = format!("another sub-index of {}", hex16(index));
    for item in group.items.iter().filter(has_meaning) {
        once(&mut names, &item.name, name_span(item), &other, diagnostics);
    }
}

fn once<'n>(seen: &mut HashMap<&'n str, Span>, name: &'n str, at: Span, owner: &str, diagnostics: &mut Diagnostics) {
    if name.is_empty() {
        return;
    }
    let first = *seen.entry(name).or_insert(at);
    if first != at {
        let message = format!("{owner} has the same name `{}`", brief(name));
        diagnostics.push(codes::NAME_TWICE.at(at, message).note_at(first, "first use of the name"));
    }
}
