//! The folder `latest` of each product, whose page redirects to the newest revision.

use std::collections::{BTreeMap, HashMap};

use super::listed::Listed;
use super::pages::{Pages, FIRST, ROOT};
use super::Page;

/// Returns a page for the folder `latest` of each product folder. The page redirects to the first page of the newest
/// revision. If the revisions have different names, the product has several folders, and there is a page for each of
/// them. Returns no pages if the format has no redirections.
pub(super) fn pages(devices: &[Listed], format: &dyn Pages) -> Vec<Page> {
    let (mut folders, mut products) = (BTreeMap::new(), HashMap::new());
    for device in devices {
        let Some(folder) = device.path.rsplitn(3, '/').nth(2) else { continue };
        folders.insert(folder, &device.product);
        let newest = products.entry(&device.product).or_insert(device);
        if newest.age() > device.age() {
            *newest = device;
        }
    }
    let page = |(folder, product): (&str, &String)| {
        let newest = products.get(product)?;
        let target = match newest.path.strip_prefix(folder).filter(|rest| rest.starts_with('/')) {
            Some(rest) => format!("..{rest}"),
            None => format!("{ROOT}/{}", newest.path),
        };
        let text = format.redirection(&newest.title, &target)?;
        Some(Page { path: format!("{folder}/latest/{FIRST}{}", format.ending()), text })
    };
    folders.into_iter().filter_map(page).collect()
}
