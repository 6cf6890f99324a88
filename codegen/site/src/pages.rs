//! The interface that each documentation format implements. A format writes the text of each kind of page.

use std::cmp::Reverse;
use std::rc::Rc;

use super::addresses;
use super::area::Area;
use super::assumptions::Ranked;
use super::codes::Codes;
use super::diagnostics::DiagnosticGroup;
use super::links::Links;
use super::machines::Behavior;
use super::modules::ModuleModel;
use super::network;
use super::overview::{Contents, Overview};
use super::process::{ProcessPart, SyncManager};
use super::protocol::Protocol;
use super::revisions::Comparison;
use super::search::Index;
use super::segment;
use super::Page;
use lexibus_codegen::facts;
use lexibus_codegen::facts::number::hex32;
use lexibus_codegen::ir::{Catalog, Device};

/// File name and title of a page.
type PageLink = (String, String);

/// The file name of a folder's first page, without extension.
pub(super) const FIRST: &str = "index";

/// The title, links, languages and paths that all pages of a device or catalog share.
#[derive(Debug, Default)]
pub(super) struct Frameset {
    /// Title of the device or catalog.
    pub title: String,
    /// File name and title of the list of devices; `None` if the catalog has a single device.
    pub list: Option<(String, String)>,
    /// Links to the pages of the device.
    pub device_pages: Rc<Links>,
    /// Links to the pages that all devices share.
    pub shared: Rc<Links>,
    /// Languages in which the pages show names.
    pub languages: Vec<String>,
    /// Relative path from the page to the site's folder.
    pub root: &'static str,
    /// Folder of the search index relative to the site's folder, with a trailing `/`. It is empty for the index of the site.
    pub index: String,
}

/// Title of the page with the process data of a device.
pub(super) const PROCESS_DATA: &str = "Process data";

/// Relative path from the pages of a device or description to the site's folder.
pub(super) const ROOT: &str = "../../..";

impl Frameset {
    /// Returns the file names and titles of the device's pages, followed by those of the shared pages.
    pub fn all(&self) -> Vec<&(String, String)> {
        self.device_pages.all().chain(self.shared.all()).collect()
    }

    /// Returns the breadcrumb trail of `file`: the list of devices, the first page of the device or catalog, and `file` itself if
    /// it is another page.
    pub fn path(&self, file: &str) -> Vec<(&String, &String)> {
        let list = self.list.iter().map(|(file, title)| (file, title));
        let first = self.device_pages.get(0).map(|(file, _)| (file, &self.title));
        let open = self.position(file).filter(|at| *at > 0 || first.is_none()).and_then(|at| self.get(at));
        list.chain(first).chain(open.map(|(file, title)| (file, title))).collect()
    }

    /// Returns the pages before and after `file`.
    pub fn neighbors(&self, file: &str) -> (Option<&PageLink>, Option<&PageLink>) {
        let Some(at) = self.position(file) else { return (None, None) };
        (at.checked_sub(1).and_then(|at| self.get(at)), self.get(at + 1))
    }

    fn position(&self, file: &str) -> Option<usize> {
        let shared = || Some(self.device_pages.count() + self.shared.position(file)?);
        self.device_pages.position(file).or_else(shared)
    }

    fn get(&self, at: usize) -> Option<&PageLink> {
        self.device_pages.get(at).or_else(|| self.shared.get(at.checked_sub(self.device_pages.count())?))
    }

    /// Returns the file names and titles of the pages to which `file` links.
    pub fn near(&self, file: &str) -> Vec<&(String, String)> {
        self.device_pages.near(file).chain(self.shared.near(file)).collect()
    }
}

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

/// The content of a page.
#[derive(Clone, Copy)]
pub(super) enum Content<'p> {
    Overview(&'p Overview, &'p Contents),
    Area(&'p Area),
    Process(&'p ProcessPart, &'p [SyncManager]),
    Protocol(&'p Protocol),
    Codes(&'p [Codes]),
    Machines(&'p Behavior),
    Modules(&'p [ModuleModel]),
    Assumptions(&'p [Ranked<'p>]),
    Diagnostics(&'p [DiagnosticGroup<'p>]),
    Changes(&'p Comparison),
    Network(&'p network::Shown),
    /// The page of an EtherCAT segment.
    Segment(&'p segment::Shown),
    /// A list of devices, in a catalog or in the site. `is_part` is set if the list has several pages.
    List {
        devices: &'p [Listed],
        is_part: bool,
    },
}

/// An output format, which writes the text of each page.
pub(super) trait Pages {
    /// Returns the extension of the page files, including the dot.
    fn ending(&self) -> &'static str;
    /// Returns the file name of a site's first page, without extension.
    fn front(&self) -> &'static str;
    /// Returns the text of the page `file`. `frame` contains its title and links.
    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String;

    /// Returns the text of a page that redirects to `target`, the newest revision of a product. Returns `None` if the format has no
    /// such pages.
    fn redirection(&self, title: &str, target: &str) -> Option<String>;

    /// Returns the files that the pages of one catalog share.
    fn of_catalog(&self, index: &Index) -> Vec<Page>;
    /// Returns the files that all pages share. `further` are the paths and titles of comparisons and networks. `index` is the
    /// search index of all catalogs, if a page of the site needs this index.
    fn of_site(&self, catalogs: &[ListedCatalog], further: &[PageLink], index: Option<&Index>) -> Vec<Page>;
}
