//! Indices that depend on the slot of a module or on the channel of a PDO template.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::syntax::xml::Tag;

/// Index, and whether it depends on the slot, the slot group or the channel.
#[derive(Default)]
pub(super) struct SlotIndex<'a> {
    pub given: Given<'a>,
    /// True if the index depends on the slot.
    pub slot: bool,
    /// True if the index depends on the slot group.
    pub group: bool,
    /// Increment of the index per channel of a template.
    pub factor: Given<'a>,
}

impl<'a> SlotIndex<'a> {
    /// Reads an element that contains an index.
    pub fn read(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Self> {
        let [slot, group, factor] = reader.attributes(tag, ["DependOnSlot", "DependOnSlotGroup", "ChnFac"])?;
        let (slot, group) = (reader.flag(&slot), reader.flag(&group));
        Ok(SlotIndex { given: reader.content()?, slot, group, factor })
    }

    /// Returns the index for a channel of a template: `index + factor * channel`. Returns `None` if the index is missing,
    /// invalid or out of range.
    pub fn of_channel<T>(&self, reader: &mut Reader<'_, '_>, channel: u16, what: &str) -> Option<T>
    where
        T: TryFrom<i128> + Into<i128>,
    {
        let base: T = reader.int(&self.given, what)?;
        let factor = reader.int::<i32>(&self.factor, "channel factor").unwrap_or(0);
        let number = base.into() + i128::from(factor) * i128::from(channel);
        let value = T::try_from(number).ok();
        if value.is_none() {
            let message = format!("the {what} of channel {channel} is out of range: {number}");
            reader.report(&codes::ESI_VALUE, self.given.span, message, "left out");
        }
        value
    }
}
