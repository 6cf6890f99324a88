//! Passes over the IR, each named after the guarantee that it gives.
//!
//! [`check`] runs those that every output needs. A pass reports a broken element, leaves it as it is or sets it aside,
//! and goes on: after the first error come the others.

mod identity_agrees;
mod implicit_pdos_exist;
pub mod names_unique;
mod objects_checked;
mod pdo_layout_checked;
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
    }
    for module in modules {
        values_checked::run(module.fixed_objects.iter().chain(&module.groups), diagnostics);
    }
    for submodule in submodules {
        values_checked::run(submodule.records.iter(), diagnostics);
    }
}
