//! Runs the steps that change a description.

use super::{
    conditions, identity, implicit_pdos, mapped_objects, message_fields, pdo_entries, pdo_mapping, profiles,
    references, selection,
};
use crate::diagnostics::Diagnostics;
use crate::frontend::Overlay;
use crate::ir::{Catalog, Device, Module};
use crate::selection::Selection;

/// Whether profiles complete a description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profiles {
    /// Each device, module or submodule gets facts from the profiles that it follows.
    Applied,
    /// Profiles add no facts.
    Ignored,
}

/// Changes to a description that the options of a compilation ask for.
pub struct Changes<'c> {
    /// Devices and modules to keep.
    pub selection: &'c Selection,
    /// Overlays in the order in which they are applied.
    pub overlays: Vec<Overlay<'c>>,
    /// Whether profiles add facts.
    pub profiles: Profiles,
}

/// Selects devices and modules, applies overlays, completes the descriptions in `catalog`, and reports EtherCAT PDO entries that map
/// a missing object. Each step uses the results of the steps before it. The selection of objects is a later step
/// ([`select_objects`](super::select_objects)).
pub fn resolve(catalog: &mut Catalog, changes: &Changes<'_>, diagnostics: &mut Diagnostics) {
    selection::devices_and_modules(changes.selection, catalog, diagnostics);
    changes.overlays.iter().for_each(|apply| apply(catalog, diagnostics));
    for device in &mut catalog.devices {
        complete_device(device, &catalog.modules, diagnostics);
    }
    for module in &mut catalog.modules {
        pdo_entries::module(module, diagnostics);
        mapped_objects::module(module);
    }
    if changes.profiles == Profiles::Applied {
        profiles::apply(catalog);
    }
    for device in &mut catalog.devices {
        message_fields::run(device);
        if references::device(device) {
            conditions::run(device);
        }
    }
    catalog.modules.iter_mut().for_each(references::module);
    references::families(catalog);
}

fn complete_device(device: &mut Device, modules: &[Module], diagnostics: &mut Diagnostics) {
    identity::run(device);
    implicit_pdos::run(device);
    pdo_mapping::run(device, modules);
    if device.ethercat.is_some() {
        pdo_entries::device(device, diagnostics);
        mapped_objects::device(device);
    }
}
