//! What lints look at.

use crate::ir::owner::Owner;
use crate::ir::{Device, Format, Group, Module, ProcessData, TypeDef};

/// A device.
pub(super) struct Context<'a> {
    pub device: &'a Device,
    /// All modules of the catalogue.
    pub modules: &'a [Module],
    /// The format of the file that describes the devices.
    pub format: Option<Format>,
    /// The items and types of the device.
    pub owner: Owner<'a>,
}

/// The PDOs of a device or a module, with the items and types that they map.
pub(super) struct PdoOwner<'a> {
    pub data: &'a ProcessData,
    pub groups: &'a [Group],
    pub types: &'a [TypeDef],
}

impl<'a> PdoOwner<'a> {
    /// Those of a device.
    pub fn device(device: &'a Device) -> Self {
        PdoOwner { data: &device.process_data, groups: &device.groups, types: &device.types }
    }

    /// Those of a module.
    pub fn module(module: &'a Module) -> Self {
        PdoOwner { data: &module.process_data, groups: &module.groups, types: &module.types }
    }
}
