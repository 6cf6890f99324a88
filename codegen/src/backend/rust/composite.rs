//! Numbers that are split over several items: a constant for each, which joins and splits them.

use super::bus_facts::{self, FactModel};
use super::docs;
use crate::ir::Composite;
use crate::passes::names_unique::{self, Case, Wish};

/// Names of constants that stand beside them.
const BESIDE: [&str; 6] = ["device", "axes", "module", "entries", "identity", "node_id"];

pub(super) fn models(composites: &[Composite]) -> Vec<FactModel> {
    let wishes: Vec<Wish<'_>> = composites.iter().enumerate().map(wish).collect();
    let reserved: Vec<&str> = bus_facts::RESERVED.iter().chain(&BESIDE).copied().collect();
    let names = names_unique::unique(&wishes, &reserved, Case::Snake);
    composites.iter().zip(names).map(|(own, name)| model(own, &name.to_ascii_uppercase())).collect()
}

fn wish((number, own): (usize, &Composite)) -> Wish<'_> {
    Wish { name: &own.name, fallback: format!("composite {number}"), suffix: number.to_string() }
}

fn model(own: &Composite, name: &str) -> FactModel {
    let parts: Vec<String> = own.parts.iter().map(|part| docs::escape(part)).collect();
    let mut sentences =
        vec![docs::sentence(&format!("{} in {} to the base {}", docs::escape(&own.name), parts.join(", "), own.base))];
    if let Some((item, value)) = &own.sign {
        sentences.push(format!("{} is {value} below zero.", docs::escape(item)));
    }
    if !own.unit.is_empty() {
        sentences.push(format!("In {}.", docs::escape(&own.unit)));
    }
    let text = own.documentation.as_ref().map_or("", |own| own.text.as_str());
    if !text.is_empty() {
        sentences.push(docs::sentence(&docs::escape(text)));
    }
    let sign = own.sign.as_ref().map_or_else(String::new, |(_, value)| format!(".signed({value})"));
    FactModel {
        docs: sentences.join(" "),
        code: format!("pub const {name}: rt::Composite<{}> = rt::Composite::new({}){sign};", own.parts.len(), own.base),
    }
}
