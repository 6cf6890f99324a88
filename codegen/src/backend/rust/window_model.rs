//! Windows, ready to be printed.

use super::code::{generic, Doc};
use super::context::Context;
use super::docs;
use super::links::DocModule;
use super::window::Window;
use crate::ir::ItemRef;

/// A window, ready to be printed.
pub(super) struct WindowModel {
    pub docs: Vec<String>,
    pub name: String,
    pub ty: Doc,
    pub kind: &'static str,
    pub facts: Vec<String>,
}

/// Returns a [`WindowModel`] for each window of the context.
pub(super) fn models(context: &Context<'_>) -> Vec<WindowModel> {
    context.windows.iter().map(|window| model(context, window)).collect()
}

fn model(context: &Context<'_>, window: &Window) -> WindowModel {
    let (_, _, bus, is_write) = window.key;
    let [number, value] = &window.addresses;
    let mut facts = vec![
        format!("number: {number}"),
        format!("number_bits: {}", window.number_bits),
        format!("value: {value}"),
        format!("value_bits: {}", window.value.0),
    ];
    if is_write {
        facts.push(format!("is_number_first: {}", window.number_first));
    }
    facts.push(format!("handshake: {}", window.handshake));
    let link =
        |item: &ItemRef| context.link(item, DocModule::OTHER).unwrap_or_else(|| format!("\"{}\"", docs::escape(item)));
    let [number, value] = [&window.side.number, &window.side.value].map(link);
    let verb = if is_write { "receives" } else { "returns" };
    let kind = if is_write { "rt::WriteWindow" } else { "rt::ReadWindow" };
    WindowModel {
        docs: vec![format!(
            "Window on {}: {number} receives the number of an item, and {value} {verb} the value of this item.",
            bus.title()
        )],
        name: window.name.clone(),
        ty: generic!(kind, bus.address_type()),
        kind,
        facts,
    }
}
