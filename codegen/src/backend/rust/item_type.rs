//! The type of an item's value.

use super::code::{seq, Doc};
use super::context::Context;
use super::quantity::{self, QuantityType};
use super::value_type::ValueType;
use crate::ir::Item;
use crate::names;

/// The type of an item's value: an enumeration or bit field, a quantity, or a basic type.
pub(super) struct ItemType<'s> {
    pub basic: ValueType,
    /// Name of the enumeration or bit field.
    pub named: Option<&'s str>,
    quantity: Option<QuantityType>,
}

impl<'s> ItemType<'s> {
    pub fn of(context: &'s Context<'_>, item: &Item) -> Self {
        let named = context.enumeration(item.ty);
        ItemType {
            // The raw value of an enumeration may be a Boolean. The generated code represents this Boolean as an
            // integer of one bit.
            basic: named.map_or_else(|| context.value_type(item.ty), |named| ValueType::of(named.ty)),
            named: named.map(|named| named.name.as_str()),
            quantity: if named.is_none() { quantity::of(context, item) } else { None },
        }
    }

    /// Returns the path of the type. `outer` is the path to the device's module.
    pub fn path(&self, outer: &str) -> Doc {
        match (self.named, &self.quantity) {
            (Some(name), _) => seq![outer, "types::", name],
            (None, Some(quantity)) => quantity.path.clone(),
            (None, None) => Doc::from(self.basic.path()),
        }
    }

    /// Returns the name of the type for use in other names.
    pub fn word(&self) -> String {
        match (self.named, &self.quantity) {
            // A camel-case name must not contain an underscore. A name that starts with a digit has a leading `_`,
            // which must be removed.
            (Some(name), _) => names::prefixed("Named", name),
            (None, Some(quantity)) => quantity.word.clone(),
            (None, None) => self.basic.word(),
        }
    }
}
