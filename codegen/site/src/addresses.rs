//! The folders of devices. The folder of a device depends on its identity and, if several devices have the same identity, on the
//! description. The folder never depends on the order in which a site writes the devices. Therefore, links to a device stay valid.

use std::collections::{BTreeMap, HashMap};

use super::anchor::slug;
use lexibus_codegen::facts;
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_codegen::number::hex32;

/// Maximum number of characters of a folder name, without the checksum that distinguishes longer names.
const LONGEST: usize = 60;

/// A device of a site: the name of its description, and its position in this description.
pub(super) type DeviceKey = (String, usize);

/// The devices of a product, each with its revision number.
type Revisions = Vec<(u32, DeviceKey)>;

/// The folders of a site's devices, and the revisions of each product.
#[derive(Debug, Default)]
pub(super) struct Addresses {
    /// Devices, keyed by the folder of the product and the name of the revision's folder.
    devices: BTreeMap<(String, String), Vec<DeviceKey>>,
    /// Revisions of each product, keyed by the text that [`product`] returns.
    products: HashMap<String, Revisions>,
    /// Folder of the pages that the devices of a description share.
    shared: HashMap<String, String>,
}

impl Addresses {
    /// Adds the devices of a description.
    pub fn add(&mut self, name: &str, catalog: &Catalog) {
        for (at, device) in catalog.devices.iter().enumerate() {
            let (identity, key) = (&device.identity, (name.to_owned(), at));
            if let Some(number) = identity.revision_number {
                self.products.entry(product(device)).or_default().push((number, key.clone()));
            }
            self.devices.entry((folder_of_product(device), revision(device))).or_default().push(key);
        }
        let vendor = catalog.devices.first().map_or_else(|| "unknown-vendor".to_owned(), vendor);
        self.shared.insert(name.to_owned(), format!("{vendor}/_files/{}", folder_name(name)));
    }

    /// Returns whether the devices of this description have been added.
    pub fn has(&self, name: &str) -> bool {
        self.shared.contains_key(name)
    }

    /// Returns the folder of a device, relative to the folder of the site.
    pub fn device(&self, device: &Device, key: &DeviceKey) -> String {
        let of = (folder_of_product(device), revision(device));
        let keys = self.devices.get(&of).map_or(&[][..], Vec::as_slice);
        let folder = format!("{}/{}", of.0, of.1);
        if keys.len() < 2 {
            return folder;
        }
        // Further devices of the same description do not change the folder of the first one.
        if keys[0] == *key && keys.iter().all(|other| other.0 == key.0) {
            return folder;
        }
        let name = folder_name(&key.0);
        let is_ambiguous = keys.iter().any(|other| other.0 != key.0 && folder_name(&other.0) == name);
        let name = distinct(name, &key.0, is_ambiguous);
        match keys.iter().filter(|other| other.0 == key.0).position(|other| other == key) {
            None | Some(0) => format!("{folder}-{name}"),
            // No folder name contains a dot, so this name cannot be that of a device in another description.
            Some(number) => format!("{folder}-{name}.{}", number + 1),
        }
    }

    /// Returns the folder of the pages that the devices of a description share.
    pub fn shared(&self, name: &str) -> String {
        let folder = self.shared.get(name).cloned().unwrap_or_default();
        let is_ambiguous = self.shared.iter().any(|(other, path)| other != name && *path == folder);
        distinct(folder, name, is_ambiguous)
    }

    /// Returns the previous revision of a device. If several descriptions contain this revision, the first of these
    /// descriptions by name is used.
    pub fn previous(&self, device: &Device) -> Option<&(u32, DeviceKey)> {
        let number = device.identity.revision_number?;
        let older = self.revisions(device)?.iter().filter(|(other, _)| *other < number);
        older.max_by(|one, other| (one.0, &other.1).cmp(&(other.0, &one.1)))
    }

    /// Returns the names of the descriptions that contain revisions of the devices in `catalog`.
    pub fn partners<'a>(&'a self, catalog: &'a Catalog) -> impl Iterator<Item = &'a str> {
        let revisions = catalog.devices.iter().filter_map(|device| self.revisions(device)).flatten();
        revisions.map(|(_, (name, _))| name.as_str())
    }

    fn revisions(&self, device: &Device) -> Option<&Revisions> {
        self.products.get(&product(device))
    }
}

/// Returns the folder of a device's vendor.
fn vendor(device: &Device) -> String {
    let identity = &device.identity;
    match (identity.vendor_name.trim(), identity.vendor_id) {
        ("", None) => "unknown-vendor".to_owned(),
        ("", Some(id)) => format!("vendor-{}", folder_of_number(id)),
        (name, _) => folder_name(name),
    }
}

/// Returns a text that is equal for the revisions of a product: vendor ID, product code and order code. Variants of a
/// product can share the product code, for example EK1828 and EK1828-0010. Without an order code, the name
/// distinguishes them. If the vendor ID or the product code is missing or 0, as in many EDS files, the text is the
/// folder of the product instead.
pub(super) fn product(device: &Device) -> String {
    let identity = &device.identity;
    match (identity.vendor_id, identity.product_code) {
        (Some(vendor @ 1..), Some(code @ 1..)) => {
            let variant = match identity.order_code.trim() {
                "" => facts::device::title(device).trim(),
                order_code => order_code,
            };
            format!("{vendor} {code} {}", variant.to_lowercase())
        }
        _ => folder_of_product(device),
    }
}

/// Returns the path of the product's folder, which is in the folder of the vendor. The name of the folder contains the
/// product code, if known, because products can have equal names.
fn folder_of_product(device: &Device) -> String {
    let title = folder_name(facts::device::title(device));
    match device.identity.product_code {
        Some(code) => format!("{}/{title}-{}", vendor(device), folder_of_number(code)),
        None => format!("{}/{title}", vendor(device)),
    }
}

/// Returns the name of the revision's folder, which is in the folder of the product.
fn revision(device: &Device) -> String {
    device.identity.revision_number.map_or_else(|| "no-revision".to_owned(), folder_of_number)
}

fn folder_of_number(number: u32) -> String {
    hex32(number).to_lowercase()
}

/// Returns a folder name for a text: lowercase letters, digits and `-`. If the name does not contain all letters of the
/// text, it ends with a checksum, so that texts with different letters have different names.
pub(super) fn folder_name(text: &str) -> String {
    let mut name = slug(text);
    let is_complete =
        name.len() <= LONGEST && text.chars().all(|letter| letter.is_ascii() || !letter.is_alphanumeric());
    if is_complete && !name.is_empty() {
        return name;
    }
    name.truncate(LONGEST);
    format!("{}{}{:08x}", name.trim_end_matches('-'), if name.is_empty() { "" } else { "-" }, checksum(text))
}

/// Returns the checksum FNV-1a of a text.
fn checksum(text: &str) -> u32 {
    text.bytes().fold(0x811C_9DC5, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// Returns `folder`. If `is_ambiguous` is set, appends a checksum of the description's name, because names that differ
/// only in punctuation give the same folder.
fn distinct(folder: String, name: &str, is_ambiguous: bool) -> String {
    if is_ambiguous {
        format!("{folder}-{:08x}", checksum(name))
    } else {
        folder
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn catalog(devices: &[(&str, Option<u32>, Option<u32>)]) -> Catalog {
        let device = |(name, code, revision): &(&str, Option<u32>, Option<u32>)| {
            let mut device = Device { name: (*name).into(), ..Device::default() };
            device.identity.vendor_name = "Maker & Sons".into();
            (device.identity.product_code, device.identity.revision_number) = (*code, *revision);
            device
        };
        Catalog { devices: devices.iter().map(device).collect(), ..Catalog::default() }
    }

    fn folders(addresses: &Addresses, name: &str, catalog: &Catalog) -> Vec<String> {
        let folder = |(at, device)| addresses.device(device, &(name.to_owned(), at));
        catalog.devices.iter().enumerate().map(folder).collect()
    }

    #[test]
    fn folders_do_not_depend_on_the_order_of_descriptions() {
        let first = catalog(&[("Drive 1", Some(7), Some(1)), ("Table", None, None), ("Drive 1", Some(7), Some(2))]);
        let second = catalog(&[("Drive 1", Some(7), Some(1)), ("Drive 1", Some(7), Some(1)), ("Pump", None, None)]);
        let (mut one, mut other) = (Addresses::default(), Addresses::default());
        one.add("x", &first);
        assert_eq!(
            folders(&one, "x", &first),
            [
                "maker-sons/drive-1-0x00000007/0x00000001",
                "maker-sons/table/no-revision",
                "maker-sons/drive-1-0x00000007/0x00000002"
            ]
        );
        one.add("Y y", &second);
        other.add("Y y", &second);
        other.add("x", &first);
        for (name, catalog) in [("x", &first), ("Y y", &second)] {
            assert_eq!(folders(&one, name, catalog), folders(&other, name, catalog));
        }
        assert_eq!(
            folders(&one, "Y y", &second),
            [
                "maker-sons/drive-1-0x00000007/0x00000001-y-y",
                "maker-sons/drive-1-0x00000007/0x00000001-y-y.2",
                "maker-sons/pump/no-revision"
            ]
        );
        let previous = one.previous(&first.devices[2]);
        assert_eq!(previous, Some(&(1, ("Y y".to_owned(), 0))));
        assert_eq!(previous, other.previous(&first.devices[2]));
        assert_eq!(one.previous(&first.devices[0]), None);
    }

    #[test]
    fn a_product_can_change_its_name_and_many_files_lack_numbers() {
        let mut renamed = catalog(&[("Drive", Some(7), Some(1)), ("Drive plus", Some(7), Some(2))]);
        for device in &mut renamed.devices {
            (device.identity.vendor_id, device.identity.order_code) = (Some(3), "D-1".into());
        }
        let templates = catalog(&[("Pump", Some(0), Some(1)), ("Fan", Some(0), Some(2))]);
        let mut addresses = Addresses::default();
        addresses.add("renamed", &renamed);
        addresses.add("templates", &templates);
        assert_eq!(addresses.previous(&renamed.devices[1]), Some(&(1, ("renamed".to_owned(), 0))));
        assert_eq!(addresses.previous(&templates.devices[1]), None);
    }

    #[test]
    fn variants_with_the_same_product_code_are_different_products() {
        let revisions = [0x0010_0000, 0x0010_000A, 0x0011_0000, 0x0011_000A];
        let mut stated = catalog(&revisions.map(|revision| ("Coupler", Some(7), Some(revision))));
        let mut named = stated.clone();
        for (at, device) in stated.devices.iter_mut().enumerate() {
            device.identity.order_code = ["EK1828", "EK1828-0010"][at % 2].into();
        }
        for (at, device) in named.devices.iter_mut().enumerate() {
            device.name = ["EK1828", "EK1828-0010"][at % 2].into();
        }
        for catalog in [&mut stated, &mut named] {
            catalog.devices.iter_mut().for_each(|device| device.identity.vendor_id = Some(2));
            let mut addresses = Addresses::default();
            addresses.add("couplers", catalog);
            let previous = |at: usize| addresses.previous(&catalog.devices[at]).map(|(number, key)| (*number, key.1));
            assert_eq!(
                [0, 1, 2, 3].map(previous),
                [None, None, Some((0x0010_0000, 0)), Some((0x0010_000A, 1))],
                "each revision follows one of the same product"
            );
        }
    }

    #[test]
    fn a_second_device_does_not_move_the_first() {
        let twice = catalog(&[("Drive", Some(7), Some(1)), ("Drive", Some(7), Some(1))]);
        let mut addresses = Addresses::default();
        addresses.add("t", &twice);
        let product = "maker-sons/drive-0x00000007";
        let expected = [format!("{product}/0x00000001"), format!("{product}/0x00000001-t.2")];
        assert_eq!(folders(&addresses, "t", &twice), expected);
    }

    #[test]
    fn a_number_is_not_a_part_of_another_name() {
        let twice = catalog(&[("Drive", Some(7), Some(1)), ("Drive", Some(7), Some(1))]);
        let once = catalog(&[("Drive", Some(7), Some(1))]);
        let mut addresses = Addresses::default();
        addresses.add("t", &twice);
        addresses.add("t-2", &once);
        let mut all = folders(&addresses, "t", &twice);
        all.extend(folders(&addresses, "t-2", &once));
        all.sort();
        all.dedup();
        assert_eq!(all.len(), 3, "{all:?}");
    }

    #[test]
    fn names_that_differ_in_punctuation() {
        let one = catalog(&[("Drive", Some(7), Some(1))]);
        let mut addresses = Addresses::default();
        addresses.add("drive_v1", &one);
        addresses.add("drive-v1", &one);
        assert_ne!(folders(&addresses, "drive_v1", &one), folders(&addresses, "drive-v1", &one));
        assert_ne!(addresses.shared("drive_v1"), addresses.shared("drive-v1"));
    }

    #[test]
    fn folder_names_of_different_texts_differ() {
        assert_eq!(folder_name("Kollmorgen AKD™ / 2"), "kollmorgen-akd-2");
        assert_eq!(folder_name("../../etc/passwd"), "etc-passwd");
        assert_ne!(folder_name("伺服"), folder_name("电机"));
        assert_ne!(folder_name(&"x".repeat(99)), folder_name(&"x".repeat(98)));
        assert!(folder_name(&"x".repeat(99)).len() < 70 && !folder_name("?").is_empty());
    }
}
