//! Numbers that a device keeps in several items.

use super::{CompactString, Documentation, ItemRef, Texts};
use crate::source::Origin;

/// One number in several items: digits to a base, and perhaps a sign.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Composite {
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// The items of the digits, the most significant one first.
    pub parts: Vec<ItemRef>,
    /// What one digit is worth of the next: digits are below it.
    pub base: u16,
    /// The item that has the sign, and its value below zero; otherwise it is 0.
    pub sign: Option<(ItemRef, u16)>,
    /// The unit of the number.
    pub unit: CompactString,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}
