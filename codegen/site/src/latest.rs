//! The folder `latest` of each product, which leads to the newest revision.

use std::collections::BTreeMap;

use super::pages::{Listed, Pages, FIRST};
use super::Page;

/// Returns a page for each product that leads to the first page of its newest revision.
pub(super) fn pages(devices: &[Listed], format: &dyn Pages) -> Vec<Page> {
    let mut products: BTreeMap<&str, &Listed> = BTreeMap::new();
    for device in devices {
        let Some(product) = device.path.rsplitn(3, '/').nth(2) else { continue };
        let newest = products.entry(product).or_insert(device);
        if newest.age() > device.age() {
            *newest = device;
        }
    }
    let page = |(product, device): (&str, &Listed)| {
        let target = format!("..{}", &device.path[product.len()..]);
        let text = format.redirection(&device.title, &target)?;
        Some(Page { path: format!("{product}/latest/{FIRST}{}", format.ending()), text })
    };
    products.into_iter().filter_map(page).collect()
}
