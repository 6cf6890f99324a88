//! Numbers that are split over several items.

use std::sync::Arc;

use super::{CompactString, Documentation, Doubts, ItemRef, Texts};
use crate::source::Origin;

/// A number whose digits, and optionally its sign, are in several items.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Composite {
    /// Name of the number.
    pub name: CompactString,
    /// Name of the number in other languages.
    pub names: Texts,
    /// Items with the digits, most significant digit first.
    pub parts: Vec<ItemRef>,
    /// Base of the number system. Each digit is less than the base.
    pub base: u16,
    /// Item with the sign, and the value of this item for negative numbers. For positive numbers and 0, the value of
    /// the item is 0.
    pub sign: Option<(ItemRef, u16)>,
    /// Unit of the number.
    pub unit: CompactString,
    /// Description of the number from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the number, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Location of the number in the source.
    pub origin: Origin,
}
