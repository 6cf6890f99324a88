//! The names of numbers that are split over several items.

use crate::backend::rust::bus_facts;
use crate::ir::{Composite, Device};
use crate::names::{self, Case};

/// Names of constants in the same module.
const BESIDE: [&str; 6] = ["device", "axes", "module", "entries", "identity", "node_id"];

/// A number and the name of its constant.
pub(in crate::backend::rust) struct NamedComposite<'a> {
    pub composite: &'a Composite,
    pub name: String,
}

/// The names of the constants.
pub(super) fn names(device: &Device) -> Vec<NamedComposite<'_>> {
    let wishes = names::numbered(device.composites.iter().map(|composite| composite.name.as_str()), "composite");
    let reserved: Vec<&str> = bus_facts::RESERVED.iter().chain(&BESIDE).copied().collect();
    let names = names::unique(&wishes, &reserved, Case::Snake);
    let named = device.composites.iter().zip(names);
    named.map(|(composite, name)| NamedComposite { composite, name: name.to_ascii_uppercase() }).collect()
}
