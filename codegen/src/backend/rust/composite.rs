//! Numbers that are split over several items: a constant for each, which joins and splits them.

use super::bus_facts::FactModel;
use super::code::{seq, Data, Doc};
use super::context::Context;
use super::docs;
use super::links::Here;
use crate::ir::{Composite, Device};

pub(super) fn models(context: &Context<'_>, device: &Device) -> Vec<FactModel> {
    device.composites.iter().zip(&context.names.composites).map(|(own, name)| model(context, own, name)).collect()
}

fn model(context: &Context<'_>, own: &Composite, name: &str) -> FactModel {
    let link = |name: &str| context.link(name, Here::TOP).unwrap_or_else(|| docs::escape(name));
    let parts: Vec<String> = own.parts.iter().map(|part| link(part)).collect();
    let mut sentences =
        vec![docs::sentence(&format!("{} in {} to the base {}", docs::escape(&own.name), parts.join(", "), own.base))];
    if let Some((item, value)) = &own.sign {
        sentences.push(format!("{} is {value} below zero.", link(item)));
    }
    if !own.unit.is_empty() {
        sentences.push(format!("In {}.", docs::escape(&own.unit)));
    }
    let text = own.documentation.as_ref().map_or("", |own| own.text.as_str());
    if !text.is_empty() {
        sentences.push(docs::sentence(&docs::escape(text)));
    }
    let base = Doc::from(own.base.to_string());
    let value = match &own.sign {
        None => Data::call("rt::Composite::new", vec![base]),
        Some((_, negative)) => Data::call("rt::Composite::signed", vec![base, Doc::from(negative.to_string())]),
    };
    let code = seq!["pub const ", name, ": rt::Composite<", own.parts.len(), "> = ", value, ";"];
    FactModel { docs: sentences.join(" "), code }
}
