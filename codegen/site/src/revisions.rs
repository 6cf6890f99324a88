//! Changes between adjacent revisions of a device.

use std::collections::HashMap;

use super::compare::{compare_devices, Change, Summary};
use lexibus_codegen::facts::number::hex32;
use lexibus_codegen::ir::{Catalog, Device};

/// The changes from one revision of a device to the next, as a page shows them.
#[derive(Debug)]
pub(super) struct Revision {
    /// Revision numbers, as hexadecimal numbers.
    pub old: String,
    pub new: String,
    pub changes: Vec<Change>,
    pub summary: Summary,
}

impl Revision {
    pub fn title(&self) -> String {
        format!("Changes since revision {}", self.old)
    }
}

/// Vendor and product code of a device.
type Product = (Option<u32>, u32);

/// Returns the previous revision of each device, by position. Devices with the same vendor, product code and revision have none.
pub(super) fn previous(catalog: &Catalog) -> HashMap<usize, &Device> {
    let mut products: HashMap<Product, Vec<(u32, usize)>> = HashMap::new();
    for (at, device) in catalog.devices.iter().enumerate() {
        let identity = &device.identity;
        if let (Some(product), Some(revision)) = (identity.product_code, identity.revision_number) {
            products.entry((identity.vendor_id, product)).or_default().push((revision, at));
        }
    }
    let mut previous = HashMap::new();
    for revisions in products.values_mut() {
        revisions.sort_unstable();
        let pairs = revisions.windows(2).filter(|pair| pair[0].0 != pair[1].0);
        previous.extend(pairs.filter_map(|pair| Some((pair[1].1, catalog.devices.get(pair[0].1)?))));
    }
    previous
}

/// Compares a device with its previous revision.
pub(super) fn revision(catalog: &Catalog, old: &Device, new: &Device) -> Revision {
    let number = |device: &Device| device.identity.revision_number.map(hex32).unwrap_or_default();
    let changes = compare_devices(catalog, old, new);
    Revision { old: number(old), new: number(new), summary: Summary::of(&changes), changes }
}
