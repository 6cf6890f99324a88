//! Devices of a description that look identical in a list of devices. Identical descriptions are merged into one row,
//! and others are distinguished by a note.

use std::collections::HashMap;

use super::compare::compare_devices;
use lexibus_codegen::facts;
use lexibus_codegen::ir::{Catalog, Device};

/// Maximum number of devices with which a device is compared. Only devices with the same texts are compared.
const MOST_COMPARED: usize = 8;

/// A device in a list, which can represent several identical ones.
struct Twin {
    /// Position of the device in its catalog.
    at: usize,
    /// Number of identical descriptions.
    copies: usize,
}

/// Returns the note of each device in a catalog: a text that distinguishes the device from others, and the number of identical
/// descriptions. The note is empty if no other device looks the same, and `None` if the device is a copy of an earlier one.
pub(super) fn notes(catalog: &Catalog) -> Vec<Option<String>> {
    let mut groups: HashMap<_, Vec<Twin>> = HashMap::new();
    for (at, device) in catalog.devices.iter().enumerate() {
        let twins = groups.entry(shown_texts(catalog, device)).or_default();
        let is_same = |twin: &&mut Twin| {
            let other = &catalog.devices[twin.at];
            compare_devices(catalog, other, catalog, device).is_empty()
        };
        match twins.iter_mut().rev().take(MOST_COMPARED).find(is_same) {
            Some(twin) => twin.copies += 1,
            None => twins.push(Twin { at, copies: 1 }),
        }
    }
    let mut notes = vec![None; catalog.devices.len()];
    for twins in groups.values() {
        for (number, twin) in (1..).zip(twins) {
            let of_several = (twins.len() > 1).then(|| format!("description {number} of {}", twins.len()));
            let copies = (twin.copies > 1).then(|| format!("{} identical descriptions", twin.copies));
            let parts: Vec<String> = of_several.into_iter().chain(copies).collect();
            notes[twin.at] = Some(parts.join(", "));
        }
    }
    notes
}

/// Returns the texts and numbers that a list of devices shows for a device.
fn shown_texts<'d>(catalog: &'d Catalog, device: &'d Device) -> impl Eq + std::hash::Hash + 'd {
    let identity = &device.identity;
    let texts = [facts::device::title(device), &identity.order_code, &identity.vendor_name];
    let numbers = [identity.product_code, identity.revision_number];
    (texts, numbers, facts::device::family(catalog, device), facts::device::buses(device), &device.profiles)
}
