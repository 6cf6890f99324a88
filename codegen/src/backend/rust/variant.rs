//! Items that differ on models and buses: the limits that hold on all of them, and what an item is on one model.

use thin_vec::ThinVec;

use crate::ir::{Item, Limits, Value};
use crate::text::glob;

/// The item as it is on a model, where models differ in its values; `None` where they don't, or the model hasn't got it.
pub(super) fn on_model(item: &Item, model: &str) -> Option<Item> {
    let differs = |own: &&crate::ir::ItemVariant| {
        !own.models.is_empty() && own.buses.is_empty() && (own.default.is_some() || !own.limits.is_empty())
    };
    let mut variants = item.variants.iter().filter(differs).peekable();
    variants.peek()?;
    let has = item
        .availability
        .as_ref()
        .is_none_or(|own| own.models.is_empty() || own.models.iter().any(|name| glob(name, model)));
    if !has {
        return None;
    }
    let mut own = Item { variants: ThinVec::new(), ..item.clone() };
    for variant in variants.filter(|own| own.models.iter().any(|name| glob(name, model))) {
        own.default = variant.default.clone().or(own.default);
        if let (Some(quantity), Some(scale)) = (&mut own.quantity, &variant.scale) {
            quantity.scale = Some(scale.clone());
        }
        own.limits.low = variant.limits.low.clone().or(own.limits.low);
        own.limits.high = variant.limits.high.clone().or(own.limits.high);
        if !variant.limits.allowed.is_empty() {
            own.limits.allowed.clone_from(&variant.limits.allowed);
        }
    }
    Some(own)
}

/// The limits of what may be written, whatever the model and the bus: the widest of all.
pub(super) fn widest(item: &Item) -> Limits {
    let mut limits = item.limits.clone();
    let writable = item.behaviour.iter().flat_map(|own| &own.writable_values);
    limits.allowed.extend(writable.map(|value| (value.clone(), value.clone())));
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
