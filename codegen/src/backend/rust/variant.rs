//! What documentation says of the models and buses on which an item differs, and the limits that hold on all of them.

use super::docs;
use super::quantity;
use crate::ir::{CompactString, Item, ItemVariant, Limits, Value};

/// One sentence for each variant.
pub(super) fn sentences(item: &Item) -> impl Iterator<Item = String> + use<'_> {
    let unit = item.quantity.as_ref().map(|quantity| docs::escape(&quantity.unit)).unwrap_or_default();
    let behind = if unit.is_empty() { unit } else { format!(" {unit}") };
    item.variants.iter().map(move |variant| sentence(variant, &behind))
}

fn sentence(variant: &ItemVariant, behind: &str) -> String {
    let list = |names: &[CompactString]| names.iter().map(|name| docs::escape(name)).collect::<Vec<_>>().join(", ");
    let who = match (variant.models.is_empty(), variant.buses.is_empty()) {
        (false, true) => format!("Of {}", list(&variant.models)),
        (false, false) => format!("Of {} on {}", list(&variant.models), list(&variant.buses)),
        (true, _) => format!("On {}", list(&variant.buses)),
    };
    let mut facts = Vec::new();
    facts.extend(variant.ty.map(|ty| ty.to_string()));
    facts.extend(variant.access.map(|access| access.name().to_owned()));
    facts.extend(variant.default.as_ref().map(|value| format!("default {}", docs::value(value))));
    facts.extend(docs::limits(&variant.limits));
    facts.extend(variant.step.as_ref().map(|step| format!("rounded to steps of {}", docs::value(step))));
    facts.extend(
        variant.scale.as_ref().map(|scale| quantity::scaled(scale, behind).trim_start_matches(", ").to_owned()),
    );
    let mut sentences = vec![format!("{who}: {}.", facts.join(", "))];
    docs::words(variant.documentation.as_deref(), &mut sentences);
    sentences.join(" ")
}

/// The limits that hold whatever the model and the bus: the widest of all.
pub(super) fn widest(item: &Item) -> Limits {
    let mut limits = item.limits.clone();
    let is_beyond = |one: &Value, other: &Value, sign: f64| match (one.as_real(), other.as_real()) {
        (Some(one), Some(other)) => one * sign > other * sign,
        _ => false,
    };
    for variant in &item.variants {
        for (own, other, sign) in
            [(&mut limits.low, &variant.limits.low, -1.0), (&mut limits.high, &variant.limits.high, 1.0)]
        {
            match (&own, other) {
                (Some(one), Some(other)) if is_beyond(other, one, sign) => *own = Some(other.clone()),
                _ => {}
            }
        }
    }
    limits
}
