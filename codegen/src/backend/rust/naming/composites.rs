//! Names of composite numbers, which consist of several items.

use crate::backend::rust::bus_facts;
use crate::ir::{Composite, Device};
use crate::names::{self, Case};

/// Names that constants of composite numbers must not have, because other elements of the same module have them.
const RESERVED: [&str; 6] = ["device", "axes", "module", "entries", "identity", "node_id"];

/// A composite number and the name of its constant.
pub(in crate::backend::rust) struct NamedComposite<'a> {
    pub composite: &'a Composite,
    pub name: String,
}

/// Returns the composite numbers with the names of their constants.
pub(super) fn names(device: &Device) -> Vec<NamedComposite<'_>> {
    let name_requests = names::numbered(device.composites.iter().map(|composite| composite.name.as_str()), "composite");
    let reserved: Vec<&str> = bus_facts::RESERVED.iter().chain(&RESERVED).copied().collect();
    let names = names::unique(name_requests, &reserved, Case::Snake);
    let named = device.composites.iter().zip(names);
    named.map(|(composite, name)| NamedComposite { composite, name: name.to_ascii_uppercase() }).collect()
}
