//! Windows, ready to be written.

use super::code::{generic, Doc};
use super::context::Context;
use super::docs;
use super::links::Here;
use super::window::Window;
use crate::ir::ItemRef;

/// A window, ready to be written.
pub(super) struct WindowModel {
    pub docs: Vec<String>,
    pub name: String,
    pub ty: Doc,
    pub kind: &'static str,
    pub facts: Vec<String>,
}

/// The windows, ready to be written.
pub(super) fn models(context: &Context<'_>) -> Vec<WindowModel> {
    context.windows.iter().map(|own| model(context, own)).collect()
}

fn model(context: &Context<'_>, own: &Window) -> WindowModel {
    let (_, _, bus, is_write) = own.key;
    let [number, value] = &own.addresses;
    let mut facts = vec![
        format!("number: {number}"),
        format!("number_bits: {}", own.number_bits),
        format!("value: {value}"),
        format!("value_bits: {}", own.value.0),
    ];
    if is_write {
        facts.push(format!("is_number_first: {}", own.number_first));
    }
    facts.push(format!("handshake: {}", own.handshake));
    let link =
        |item: &ItemRef| context.link(item, Here::BESIDE).unwrap_or_else(|| format!("\"{}\"", docs::escape(item)));
    let [number, value] = [&own.side.number, &own.side.value].map(link);
    let verb = if is_write { "takes" } else { "gives" };
    let kind = if is_write { "rt::WriteWindow" } else { "rt::ReadWindow" };
    WindowModel {
        docs: vec![format!("On {}: {number} takes a number, and {value} {verb} its value.", bus.title())],
        name: own.name.clone(),
        ty: generic!(kind, bus.address_type()),
        kind,
        facts,
    }
}
