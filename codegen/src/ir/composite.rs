//! Numbers that are split over several items.

use super::{CompactString, Documentation, ItemRef, Texts};
use crate::source::Origin;

/// A number whose digits, and optionally its sign, are in several items.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Composite {
    /// Name.
    pub name: CompactString,
    /// Name in other languages.
    pub names: Texts,
    /// Items with the digits, most significant digit first.
    pub parts: Vec<ItemRef>,
    /// Base of the number system: each digit is below it.
    pub base: u16,
    /// Item with the sign, and its value for negative numbers. For other numbers it is 0.
    pub sign: Option<(ItemRef, u16)>,
    /// Unit of the number.
    pub unit: CompactString,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Location in the source.
    pub origin: Origin,
}
