//! The devices in a list of devices, and the catalogs in a table of contents.

use std::cmp::Reverse;

use super::addresses;
use lexibus_codegen::facts;
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_codegen::number::hex32;

/// File name and title of a page.
pub(super) type PageLink = (String, String);

/// Title of the page with the process data of a device.
pub(super) const PROCESS_DATA: &str = "Process data";

/// The pages of a catalog, as a table of contents lists them.
#[derive(Debug, Default)]
pub(super) struct ListedCatalog {
    pub title: String,
    /// Folder of the pages that all devices share, relative to the site's folder. If there are several devices, its
    /// first page lists them.
    pub folder: String,
    pub devices: Vec<Listed>,
    /// Paths and titles of the pages that all devices share.
    pub shared: Vec<(String, String)>,
}

/// A device in the list of all devices.
#[derive(Clone, Debug, Default)]
pub(super) struct Listed {
    pub title: String,
    pub vendor: String,
    pub family: String,
    pub order_code: String,
    /// Product code and revision number, as hexadecimal numbers.
    pub product_code: String,
    pub revision: String,
    /// Text that distinguishes the device from others with the same texts, and the number of identical descriptions.
    /// Empty if no other device has the same texts.
    pub note: String,
    revision_number: u32,
    /// Key of the product, which is equal for all its revisions.
    pub product: String,
    pub buses: String,
    /// Numbers of the device profiles.
    pub profiles: String,
    /// Name of the description file without extension.
    pub file: String,
    /// Path of the device's first page, relative to the site's folder.
    pub path: String,
    /// Paths and titles of the device's other pages.
    pub pages: Vec<PageLink>,
}

impl Listed {
    pub fn new(
        catalog: &Catalog,
        device: &Device,
        file: &str,
        title: String,
        path: String,
        pages: Vec<PageLink>,
    ) -> Self {
        let identity = &device.identity;
        let hex = |number: Option<u32>| number.map(hex32).unwrap_or_default();
        let order_code = identity.order_code.as_str();
        Listed {
            vendor: identity.vendor_name.to_string(),
            family: facts::device::family(catalog, device).to_owned(),
            order_code: if order_code == title { String::new() } else { order_code.to_owned() },
            product_code: hex(identity.product_code),
            revision: hex(identity.revision_number),
            note: String::new(),
            revision_number: identity.revision_number.unwrap_or_default(),
            product: addresses::product(device),
            buses: facts::device::buses(device),
            profiles: device.profiles.iter().map(u32::to_string).collect::<Vec<_>>().join(", "),
            file: file.to_owned(),
            title,
            path,
            pages,
        }
    }

    /// Returns the vendor and the family.
    pub fn group(&self) -> String {
        let texts = [self.vendor.as_str(), self.family.as_str()];
        texts.into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" – ")
    }

    /// Returns a key that sorts newer revisions first, and descriptions of the same revision by file name.
    pub fn age(&self) -> (Reverse<u32>, &str) {
        (Reverse(self.revision_number), &self.file)
    }

    /// Returns the text that distinguishes the device from others with the same title. The text consists of the revision, or the
    /// file if there is no revision, and the note.
    pub fn distinction(&self) -> String {
        let name = if self.revision.is_empty() { &self.file } else { &self.revision };
        let texts = [name.as_str(), &self.note].into_iter().filter(|text| !text.is_empty());
        texts.collect::<Vec<_>>().join(", ")
    }

    /// Returns the words by which the search finds the device, in addition to its title.
    pub fn words(&self) -> String {
        let identity = [&self.order_code, &self.vendor, &self.family, &self.product_code, &self.revision];
        let others = [&self.buses, &self.profiles, &self.file];
        identity.into_iter().chain(others).map(String::as_str).collect::<Vec<_>>().join(" ")
    }

    /// Returns the path of the page with the device's process data, if there is such a page.
    pub fn process_data(&self) -> Option<&str> {
        self.pages.iter().find(|(_, title)| title == PROCESS_DATA).map(|(path, _)| path.as_str())
    }

    /// Returns the path to the device's first page. `root` is the path from the linking page to the site's folder.
    pub fn path_from(&self, root: &str) -> String {
        match root {
            "." => self.path.clone(),
            root => format!("{root}/{}", self.path),
        }
    }
}

/// Sorts devices by vendor, family, title, order code, revision (newest first) and file.
pub(super) fn sort(devices: &mut [Listed]) {
    devices.sort_by_cached_key(|device| {
        let texts = [&device.vendor, &device.family, &device.title, &device.order_code].map(|text| text.to_lowercase());
        (texts, Reverse(device.revision_number), device.file.clone())
    });
}
