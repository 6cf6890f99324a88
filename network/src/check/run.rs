//! Runs all checks.

use lexibus_codegen::diagnostics::Diagnostics;

use super::{bus_load, cob_ids, heartbeat, partners, sync};
use crate::model::Network;

/// Checks a network, and reports faults that would occur on the bus.
pub fn check(network: &Network, diagnostics: &mut Diagnostics) {
    cob_ids::check(network, diagnostics);
    partners::check(network, diagnostics);
    heartbeat::check(network, diagnostics);
    sync::check(network, diagnostics);
    bus_load::check(network, diagnostics);
}
