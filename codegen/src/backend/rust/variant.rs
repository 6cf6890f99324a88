//! The limits that hold on all models and buses on which an item differs.

use crate::ir::{Item, Limits, Value};

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
