//! Items that differ between models and buses: the limits that cover all variants, and the item of a single model.

use thin_vec::ThinVec;

use crate::ir::{Item, Limits, Value};
use crate::text::glob;

/// Returns the item with the default value, limits and scale of one model. Returns `None` if neither the default value
/// nor the limits differ between models, or if the model does not have the item.
pub(super) fn on_model(item: &Item, model: &str) -> Option<Item> {
    let differs = |variant: &&crate::ir::ItemVariant| {
        !variant.models.is_empty()
            && variant.buses.is_empty()
            && (variant.default.is_some() || !variant.limits.is_empty())
    };
    let mut variants = item.variants.iter().filter(differs).peekable();
    variants.peek()?;
    let has = item.availability.as_ref().is_none_or(|availability| {
        availability.models.is_empty() || availability.models.iter().any(|name| glob(name, model))
    });
    if !has {
        return None;
    }
    let mut adapted = Item { variants: ThinVec::new(), ..item.clone() };
    for variant in variants.filter(|variant| variant.models.iter().any(|name| glob(name, model))) {
        adapted.default = variant.default.clone().or(adapted.default);
        if let (Some(quantity), Some(scale)) = (&mut adapted.quantity, &variant.scale) {
            quantity.scale = Some(scale.clone());
        }
        adapted.limits.low = variant.limits.low.clone().or(adapted.limits.low.take());
        adapted.limits.high = variant.limits.high.clone().or(adapted.limits.high.take());
        if !variant.limits.allowed.is_empty() {
            adapted.limits.allowed.clone_from(&variant.limits.allowed);
        }
    }
    Some(adapted)
}

/// Returns the limits for writing: the widest range of all models and buses, and the writable values.
pub(super) fn widest(item: &Item) -> Limits {
    let mut limits = Limits::clone(&item.limits);
    let writable = item.behavior.iter().flat_map(|behavior| &behavior.writable_values);
    limits.allowed.extend(writable.map(|value| (value.clone(), value.clone())));
    let is_beyond = |one: &Value, other: &Value, sign: f64| match (one.as_real(), other.as_real()) {
        (Some(one), Some(other)) => one * sign > other * sign,
        _ => false,
    };
    for variant in &item.variants {
        for (limit, other, sign) in
            [(&mut limits.low, &variant.limits.low, -1.0), (&mut limits.high, &variant.limits.high, 1.0)]
        {
            match (&limit, other) {
                (Some(one), Some(other)) if is_beyond(other, one, sign) => *limit = Some(other.clone()),
                _ => {}
            }
        }
    }
    limits
}
