//! Passes over the IR, each named after the guarantee that it gives.
//!
//! [`check`] runs those that every output needs. A pass reports a broken element, leaves it as it is or sets it aside,
//! and goes on: after the first error come the others.

mod identity_agrees;
mod implicit_pdos_exist;
mod mapped_objects_exist;
mod modules_fit;
pub mod names_unique;
mod objects_checked;
mod pdo_entries_resolved;
mod pdo_layout_checked;
mod process_image_checked;
mod records_checked;
mod subslots_distinct;
mod values_checked;

use crate::diagnostics::Diagnostics;
use crate::ir::Catalog;

/// Completes and checks every device of `catalog`.
pub fn check(catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    let Catalog { devices, modules, submodules, .. } = catalog;
    for device in devices {
        identity_agrees::run(device, diagnostics);
        objects_checked::run(device, modules, diagnostics);
        values_checked::run(device.groups.iter(), diagnostics);
        implicit_pdos_exist::run(device);
        pdo_layout_checked::run(device, modules, diagnostics);
        if device.ethercat.is_some() {
            pdo_entries_resolved::device(device, diagnostics);
            mapped_objects_exist::device(device);
            process_image_checked::run(device, diagnostics);
        }
    }
    for module in modules {
        pdo_entries_resolved::module(module, diagnostics);
        mapped_objects_exist::module(module);
        process_image_checked::module(module, diagnostics);
        values_checked::run(module.fixed_objects.iter().chain(&module.groups), diagnostics);
    }
    for submodule in submodules {
        values_checked::run(submodule.records.iter(), diagnostics);
        records_checked::run(submodule.records.iter(), diagnostics);
    }
    let settings = catalog.devices.iter().filter_map(|device| device.profinet.as_ref());
    let blocks = || settings.clone().flat_map(|settings| &settings.vendor_blocks).map(|block| &block.record);
    values_checked::run(blocks(), diagnostics);
    records_checked::run(blocks(), diagnostics);
    modules_fit::run(catalog, diagnostics);
    subslots_distinct::run(catalog, diagnostics);
}
