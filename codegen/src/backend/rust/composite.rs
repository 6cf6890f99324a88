//! Generates a constant for each composite number. With this constant, a program combines the digits in several items
//! into one number, and splits a number into these digits.

use super::code::{seq, Data, Declaration, Doc};
use super::context::Context;
use super::docs;
use super::links::DocModule;
use crate::ir::{Composite, Documentation, ItemRef};

pub(super) fn models<'c>(context: &'c Context<'_>) -> impl Iterator<Item = Declaration> + 'c {
    context.names.composites.iter().map(|named| model(context, named.composite, &named.name))
}

fn model(context: &Context<'_>, composite: &Composite, name: &str) -> Declaration {
    let link = |item: &ItemRef| context.link(item, DocModule::TOP).unwrap_or_else(|| docs::escape(item));
    let parts: Vec<String> = composite.parts.iter().map(link).collect();
    let mut sentences = vec![docs::sentence(&format!(
        "{}: a number in base {}, with its digits in {}",
        docs::escape(&composite.name),
        composite.base,
        parts.join(", ")
    ))];
    if let Some((item, value)) = &composite.sign {
        sentences.push(format!("{} is {value} if the number is negative.", link(item)));
    }
    if !composite.unit.is_empty() {
        sentences.push(format!("Unit: {}.", docs::escape(&composite.unit)));
    }
    let text = Documentation::text_of(composite.documentation.as_deref());
    if !text.is_empty() {
        sentences.push(docs::sentence(&docs::escape(text)));
    }
    let base = Doc::from(composite.base.to_string());
    let value = match &composite.sign {
        None => Data::call("rt::Composite::new", vec![base]),
        Some((_, negative)) => Data::call("rt::Composite::signed", vec![base, Doc::from(negative.to_string())]),
    };
    let start = seq!["const ", name, ": rt::Composite<", composite.parts.len(), ">"];
    Declaration::new([sentences.join(" ")], start, value)
}
