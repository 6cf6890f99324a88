//! Facts of an item that differ between models or buses.

use std::sync::Arc;

use super::{Access, Buses, CompactString, Documentation, Limits, Scale, Type, Value};
use crate::source::Span;

/// Facts of an item that differ on some models or buses. If a fact is missing here, it does not differ on these models
/// and buses.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ItemVariant {
    /// Patterns for the names of the models to which the facts apply. In a pattern, `*` matches any characters. An
    /// empty list means all models.
    pub models: Vec<CompactString>,
    /// Buses on which the facts apply; empty = all.
    pub buses: Buses,
    /// Type on these models and buses, if its width differs from that of the item's type.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ty: Option<Type>,
    /// Access rights on these models and buses, if they are more restrictive than those of the item.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub access: Option<Access>,
    /// Default value of the item on these models and buses.
    pub default: Option<Value>,
    /// Minimum and maximum on these models and buses.
    pub limits: Limits,
    /// Step in raw units. On these models and buses, the device rounds written values to multiples of the step.
    pub step: Option<Value>,
    /// Conversion between raw value and physical value.
    pub scale: Option<Scale>,
    /// Description of the variant from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the variant in the source.
    pub at: Span,
}
