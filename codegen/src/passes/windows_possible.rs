//! After this pass every window takes the numbers of the items that are behind it, and the values of those that are nowhere else.

use std::collections::{HashMap, HashSet};

use super::owner::Owner;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Binding, Device, Item, Type};
use crate::text::brief;

pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    let is_behind = |item: &&Item| item.bindings.iter().any(|binding| matches!(binding, Binding::Indirect(_)));
    let behind: Vec<&Item> = owner.items().filter(is_behind).collect();
    if behind.is_empty() {
        return;
    }
    let mut items: HashMap<&str, &Item> = HashMap::new();
    for item in owner.items() {
        items.entry(item.name.as_str()).or_insert(item);
    }
    let mut told = HashSet::new();
    for item in behind {
        for binding in &item.bindings {
            let Binding::Indirect(own) = binding else { continue };
            for side in [&own.read, &own.write].into_iter().flatten() {
                let parts = [(&side.number, "the number"), (&side.value, "the value")];
                for (found, what) in parts.iter().filter_map(|(name, what)| Some((*items.get(name.as_str())?, *what))) {
                    if integer(owner, found).is_none() && told.insert(found.name.as_str()) {
                        let message = format!(
                            "`{}` has {what} of a window, which is an integer of up to 64 bits",
                            brief(&found.name)
                        );
                        diagnostics.push(Diagnostic::new(&codes::TABLE_VALUE, found.at.ty.or(found.at.name), message));
                    }
                }
                number(owner, item, own.number, items.get(side.number.as_str()).copied(), diagnostics);
            }
        }
        value(owner, item, diagnostics);
    }
}

/// Bits of an integer.
fn integer(owner: Owner<'_>, item: &Item) -> Option<u32> {
    match owner.basic(item.ty) {
        Type::Boolean => Some(1),
        Type::Integer(bits @ 1..=64) | Type::Unsigned(bits @ 1..=64) => Some(bits.into()),
        _ => None,
    }
}

/// Whether the number of an item fits what takes it.
fn number(owner: Owner<'_>, item: &Item, number: u32, taker: Option<&Item>, diagnostics: &mut Diagnostics) {
    let Some((taker, bits)) = taker.and_then(|taker| Some((taker, integer(owner, taker)?))) else { return };
    if u64::from(number).checked_shr(bits).unwrap_or(0) == 0 {
        return;
    }
    let (name, taker) = (brief(&item.name), brief(&taker.name));
    let message = format!("the number {number} of `{name}` doesn't fit `{taker}`, which has {bits} bits");
    let found = Diagnostic::new(&codes::TABLE_PLACE, item.at.name.or(item.origin.span), message);
    diagnostics.push(found.help("`numbers` of the window says which it takes"));
}

/// Whether a value that is nowhere else can come through a window.
fn value(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let is_only = item.bindings.iter().all(|binding| matches!(binding, Binding::Indirect(_)));
    let is_number = integer(owner, item).is_some() || matches!(owner.basic(item.ty), Type::Real32 | Type::Real64);
    if is_only && !is_number {
        let name = brief(&item.name);
        let message = format!("`{name}` is only found behind a window, which has integers, and is none");
        diagnostics.push(Diagnostic::new(&codes::TABLE_VALUE, item.at.ty.or(item.at.name), message));
    }
}
