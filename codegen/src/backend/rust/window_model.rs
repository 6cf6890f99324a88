//! Windows, ready to be printed.

use super::code::{generic, seq, Data, Declaration, Doc, Stop};
use super::context::Context;
use super::docs;
use super::links::DocModule;
use super::window::Window;
use crate::ir::ItemRef;

/// Returns a constant for each window of the context.
pub(super) fn models(context: &Context<'_>) -> Vec<Declaration> {
    context.windows.iter().map(|window| model(context, window)).collect()
}

fn model(context: &Context<'_>, window: &Window) -> Declaration {
    let (_, _, bus, is_write) = window.key;
    let [number, value] = &window.addresses;
    let order = is_write.then(|| ("is_number_first", Doc::from(window.number_first.to_string())));
    let facts = [
        ("number", Doc::from(number.as_str())),
        ("number_bits", seq![window.number_bits]),
        ("value", Doc::from(value.as_str())),
        ("value_bits", seq![window.value.0]),
    ];
    let facts = facts.into_iter().chain(order).chain([("handshake", Doc::from(window.handshake.as_str()))]);
    let link =
        |item: &ItemRef| context.link(item, DocModule::OTHER).unwrap_or_else(|| format!("\"{}\"", docs::escape(item)));
    let [number, value] = [&window.side.number, &window.side.value].map(link);
    let verb = if is_write { "receives" } else { "returns" };
    let kind = if is_write { "rt::WriteWindow" } else { "rt::ReadWindow" };
    let docs = format!(
        "Window on {}: {number} receives the number of an item, and {value} {verb} the value of this item.",
        bus.title()
    );
    let start = seq!["const ", window.name, ": ", generic!(kind, bus.address_type())];
    Declaration::new([docs], start, seq![Stop, Data::fields(kind, facts)])
}
