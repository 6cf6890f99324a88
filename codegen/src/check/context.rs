//! What lints look at.

use crate::ir::owner::Owner;
use crate::ir::{Device, Format, Item, Module, PdoEntry, ProcessData};

/// A device.
pub(super) struct Context<'a> {
    pub device: &'a Device,
    /// All modules of the catalogue.
    pub modules: &'a [Module],
    /// The format of the file that describes the devices.
    pub format: Format,
    /// The items and types of the device.
    pub owner: Owner<'a>,
}

/// The PDOs of a device or a module, with what has the items that they map.
pub(super) struct PdoOwner<'a> {
    pub data: &'a ProcessData,
    pub owner: Owner<'a>,
}

impl<'a> PdoOwner<'a> {
    /// The item that the description has for an entry. Objects that follow from an entry say nothing more than the entry.
    pub fn described(&self, entry: &PdoEntry) -> Option<&'a Item> {
        self.owner.item(entry.item?).filter(|item| !item.origin.is_derived())
    }
}
