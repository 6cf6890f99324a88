//! Lists of devices: columns, groups, and the pages of a long list.

use std::ops::Range;

use super::listed::Listed;
use super::split;

/// Maximum size of the rows on a page in bytes of HTML. The limit is higher than the limit of other pages, because rows are short
/// and readers filter them.
const SIZE: usize = 280_000;

/// Number of bytes of the tags around the heading of a family.
const HEADING: usize = 80;

/// The title of a column in a list of devices, and the function that returns its text.
pub(super) type Column = (&'static str, fn(&Listed) -> &str);

/// The columns of a list of devices, after the name.
const COLUMNS: [Column; 7] = [
    ("Order code", |device| &device.order_code),
    // The heading of a family contains the vendor.
    ("Vendor", |device| if device.family.is_empty() { &device.vendor } else { "" }),
    ("Product code", |device| &device.product_code),
    ("Revision", |device| &device.revision),
    ("Buses", |device| &device.buses),
    ("Profiles", |device| &device.profiles),
    ("File", |device| &device.file),
];

/// Returns the columns that contain a text for at least one device.
pub(super) fn columns(devices: &[Listed]) -> Vec<Column> {
    let is_used = |(_, text): &Column| devices.iter().any(|device| !text(device).is_empty());
    COLUMNS.into_iter().filter(is_used).collect()
}

/// Returns whether at least one device has a family.
pub(super) fn has_families(devices: &[Listed]) -> bool {
    devices.iter().any(|device| !device.family.is_empty())
}

/// Returns whether the device at a position is the first of its vendor and family.
pub(super) fn begins_group(devices: &[Listed], at: usize) -> bool {
    let group = |at: usize| devices.get(at).map(Listed::group);
    at.checked_sub(1).is_none_or(|before| group(before) != group(at))
}

/// A page of the list of all devices: file name, title, and range of the devices.
pub(super) struct ListPage {
    pub file: String,
    pub title: String,
    pub devices: Range<usize>,
}

/// Returns the pages of the list of all devices. `size` returns the size of a row in bytes. The first page is `first`, the others
/// have the extension `ending`.
pub(super) fn pages(devices: &[Listed], size: impl Fn(&Listed) -> usize, first: &str, ending: &str) -> Vec<ListPage> {
    let heading =
        |at: usize, device: &Listed| if begins_group(devices, at) { HEADING + device.group().len() } else { 0 };
    let sizes = devices.iter().enumerate().map(|(at, device)| size(device) + heading(at, device));
    let mut ranges = split::ranges(sizes, devices.len().max(1), SIZE);
    if ranges.is_empty() {
        ranges.push(0..0);
    }
    let count = ranges.len();
    let page = |(at, devices): (usize, Range<usize>)| ListPage {
        file: if at == 0 { first.to_owned() } else { format!("devices-{}{ending}", at + 1) },
        title: split::title("Devices", at, count),
        devices,
    };
    ranges.into_iter().enumerate().map(page).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_list_has_several_pages() {
        let devices = vec![Listed::default(); 5];
        let pages = |size: usize| {
            let pages = pages(&devices, |_| size, "index.html", ".html");
            pages.into_iter().map(|page| (page.file, page.title, page.devices)).collect::<Vec<_>>()
        };
        assert_eq!(pages(1), [("index.html".to_owned(), "Devices".to_owned(), 0..5)]);
        assert_eq!(
            pages(SIZE / 3 - HEADING),
            [
                ("index.html".to_owned(), "Devices (1 of 2)".to_owned(), 0..3),
                ("devices-2.html".to_owned(), "Devices (2 of 2)".to_owned(), 3..5)
            ]
        );
    }
}
