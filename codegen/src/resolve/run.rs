//! Runs the steps that complete a description.

use super::{
    conditions, identity, implicit_pdos, mapped_objects, message_fields, pdo_entries, pdo_mapping, profiles, references,
};
use crate::diagnostics::Diagnostics;
use crate::ir::{Catalog, Device, Module};

/// Whether profiles complete a description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profiles {
    /// Each device, module or submodule gets facts from the profiles that it follows.
    Applied,
    /// Profiles add no facts.
    Ignored,
}

/// Completes the descriptions in `catalog`, and reports EtherCAT PDO entries that map a missing object. Each step uses the results
/// of the steps before it.
pub fn resolve(catalog: &mut Catalog, profiles: Profiles, diagnostics: &mut Diagnostics) {
    for device in &mut catalog.devices {
        complete_device(device, &catalog.modules, diagnostics);
    }
    for module in &mut catalog.modules {
        pdo_entries::module(module, diagnostics);
        mapped_objects::module(module);
    }
    if profiles == Profiles::Applied {
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
