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
    for device in &mut catalog.devices {
        identity_agrees::run(device, diagnostics);
        objects_checked::run(device, diagnostics);
        values_checked::run(device, diagnostics);
        implicit_pdos_exist::run(device);
        pdo_layout_checked::run(device, diagnostics);
    }
}
