//! The interface of a documentation format. It writes the text of each kind of page.

use std::rc::Rc;

use super::area::Area;
use super::assumptions::Ranked;
use super::codes::Codes;
use super::diagnostics::ShownDiagnostic;
use super::links::Links;
use super::machines::Behaviour;
use super::modules::ModuleModel;
use super::overview::{Contents, Overview};
use super::process::{Frame, SyncManager};
use super::protocol::Protocol;
use super::Page;

/// The name of the first page of a folder, without extension.
pub(super) const FIRST: &str = "index";

/// The title, links and languages that the pages of a device or catalog have in common.
#[derive(Debug, Default)]
pub(super) struct Frameset {
    /// Title of the device or catalog.
    pub title: String,
    /// Pages of the device.
    pub device_pages: Rc<Links>,
    /// Pages that all devices share.
    pub shared: Rc<Links>,
    /// Languages of names.
    pub languages: Vec<String>,
}

impl Frameset {
    /// Returns the files and titles of all pages.
    pub fn all(&self) -> Vec<&(String, String)> {
        self.device_pages.all().chain(self.shared.all()).collect()
    }

    /// Returns the files and titles of the pages that a page has links to.
    pub fn near(&self, file: &str) -> Vec<&(String, String)> {
        self.device_pages.near(file).chain(self.shared.near(file)).collect()
    }
}

/// The pages of a catalog for lists of contents.
#[derive(Debug, Default)]
pub(super) struct ListedCatalog {
    pub title: String,
    /// Folder of the catalog, with a `/` at the end.
    pub folder: String,
    pub devices: Vec<Listed>,
    /// Pages that all devices share: files and titles.
    pub shared: Vec<(String, String)>,
}

/// A device in the list of all devices.
#[derive(Clone, Debug)]
pub(super) struct Listed {
    pub title: String,
    pub vendor: String,
    /// First page.
    pub path: String,
    /// Further pages: files and titles.
    pub pages: Vec<(String, String)>,
}

impl ListedCatalog {
    /// Returns the devices, with the paths of their first pages relative to the site.
    pub fn in_site(&self) -> impl Iterator<Item = Listed> + '_ {
        self.devices.iter().map(|device| Listed { path: format!("{}{}", self.folder, device.path), ..device.clone() })
    }
}

/// The content of a page.
#[derive(Clone, Copy)]
pub(super) enum Content<'p> {
    Overview(&'p Overview, &'p Contents),
    Area(&'p Area),
    Process(&'p [Frame], &'p [SyncManager]),
    Protocol(&'p Protocol),
    Codes(&'p [Codes]),
    Machines(&'p Behaviour),
    Modules(&'p [ModuleModel]),
    Assumptions(&'p [Ranked<'p>]),
    Diagnostics(&'p [ShownDiagnostic]),
    /// A list of devices.
    List {
        devices: &'p [Listed],
        /// Relative path to the folder of the site.
        root: &'p str,
        /// Folder of the index if it differs from that of the page.
        index: &'p str,
    },
}

/// Writes the pages of a format.
pub(super) trait Pages {
    /// Returns the file extension, with the dot.
    fn ending(&self) -> &'static str;
    /// Returns the name of the first page of a site, without extension.
    fn front(&self) -> &'static str;
    /// Returns the text of the page `file`, whose links and title are in `frame`.
    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String;

    /// Returns the files that the pages of one catalog share.
    fn of_catalog(&self, search: &dyn Fn() -> String) -> Vec<Page>;
    /// Returns the files that all pages share. `search` is the index of all catalogs if there are several.
    fn of_site(&self, catalogs: &[ListedCatalog], search: Option<&dyn Fn() -> String>) -> Vec<Page>;
}
