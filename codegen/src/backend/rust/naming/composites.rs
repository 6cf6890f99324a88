//! The names of numbers that are split over several items.

use crate::backend::rust::bus_facts;
use crate::ir::Device;
use crate::names::{self, Case};

/// Names of constants in the same module.
const BESIDE: [&str; 6] = ["device", "axes", "module", "entries", "identity", "node_id"];

/// The names of the constants.
pub(super) fn names(device: &Device) -> Vec<String> {
    let wishes = names::numbered(device.composites.iter().map(|own| own.name.as_str()), "composite");
    let reserved: Vec<&str> = bus_facts::RESERVED.iter().chain(&BESIDE).copied().collect();
    let names = names::unique(&wishes, &reserved, Case::Snake);
    names.iter().map(|name| name.to_ascii_uppercase()).collect()
}
