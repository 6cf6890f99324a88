//! What differs of an item between models, or between buses.

use super::{Access, Buses, CompactString, Documentation, Limits, Scale, Type, Value};
use crate::source::Span;

/// Facts of an item that hold on some models or buses only; those that aren't given are the item's.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ItemVariant {
    /// The models, in which `*` stands for any letters; empty = all.
    pub models: Vec<CompactString>,
    /// The buses; empty = all.
    pub buses: Buses,
    /// The type that the value has there: another width, on some buses.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ty: Option<Type>,
    /// What may be done with it there: less than elsewhere, on some buses.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub access: Option<Access>,
    /// The value before anybody wrote it.
    pub default: Option<Value>,
    /// The least and the greatest value.
    pub limits: Limits,
    /// Number of raw steps in which the device rounds.
    pub step: Option<Value>,
    /// How the raw number relates to the physical one.
    pub scale: Option<Scale>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub at: Span,
}
