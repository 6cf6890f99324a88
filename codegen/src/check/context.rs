//! The input of a lint: a device, or the PDOs of a device or module.

use crate::ir::owner::Owner;
use crate::ir::{Device, Format, Item, Module, PdoEntry, ProcessData};

/// A device, with the modules, file format, items and types that lints need.
pub(super) struct Context<'a> {
    pub device: &'a Device,
    /// All modules of the catalog.
    pub modules: &'a [Module],
    /// Format of the file that describes the devices.
    pub format: Format,
    /// Items and types of the device.
    pub owner: Owner<'a>,
}

/// The PDOs of a device or module, with the items that they map.
pub(super) struct PdoOwner<'a> {
    pub data: &'a ProcessData,
    pub owner: Owner<'a>,
}

impl<'a> PdoOwner<'a> {
    /// Returns the item of an entry if the description file describes the item. Items that the compiler derived from
    /// entries are not returned.
    pub fn described(&self, entry: &PdoEntry) -> Option<&'a Item> {
        self.owner.item(entry.item?).filter(|item| !item.origin.is_derived())
    }
}
