//! Runs the steps that derive facts.

use super::{conditions, identity, implicit_pdos, mapped_objects, pdo_entries, pdo_mapping, references};
use crate::diagnostics::Diagnostics;
use crate::ir::{Catalog, Device, Module};

/// Derives facts from the descriptions in `catalog`, and reports PDO entries whose object is missing.
pub fn resolve(catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    for device in &mut catalog.devices {
        resolve_device(device, &catalog.modules, diagnostics);
    }
    for module in &mut catalog.modules {
        resolve_module(module, diagnostics);
    }
}

fn resolve_device(device: &mut Device, modules: &[Module], diagnostics: &mut Diagnostics) {
    identity::run(device);
    implicit_pdos::run(device);
    pdo_mapping::run(device, modules);
    if device.ethercat.is_some() {
        pdo_entries::device(device, diagnostics);
        mapped_objects::device(device);
    }
    if references::device(device) {
        conditions::run(device);
    }
}

fn resolve_module(module: &mut Module, diagnostics: &mut Diagnostics) {
    pdo_entries::module(module, diagnostics);
    mapped_objects::module(module);
    references::module(module);
}

/// Resolves all references again, after elements were added or removed.
pub(crate) fn resolve_references(catalog: &mut Catalog) {
    for device in &mut catalog.devices {
        references::device(device);
    }
    catalog.modules.iter_mut().for_each(references::module);
}
