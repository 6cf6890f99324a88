//! What a format of documentation has to write: a text for each kind of page.

use std::rc::Rc;

use super::area::Area;
use super::assumptions::Ranked;
use super::codes::Codes;
use super::findings::Finding;
use super::links::Links;
use super::machines::Behaviour;
use super::modules::ModuleModel;
use super::overview::{Contents, Overview};
use super::process::{Frame, SyncManager};
use super::protocol::Protocol;
use super::Page;

/// The name of the first page of a folder, without ending.
pub(super) const FIRST: &str = "index";

/// The title, links and languages that the pages of a device, or of a catalog, have in common.
#[derive(Debug, Default)]
pub(super) struct Frameset {
    /// The catalogue, or the device of it.
    pub title: String,
    /// The pages of the device.
    pub own: Rc<Links>,
    /// Those that all devices share.
    pub shared: Rc<Links>,
    /// Languages of names.
    pub languages: Vec<String>,
}

impl Frameset {
    /// The files and titles of all pages.
    pub fn all(&self) -> Vec<&(String, String)> {
        self.own.all().chain(self.shared.all()).collect()
    }

    /// The files and titles that a page has links to.
    pub fn near(&self, file: &str) -> Vec<&(String, String)> {
        self.own.near(file).chain(self.shared.near(file)).collect()
    }
}

/// The pages of a catalogue, as lists of contents have them.
#[derive(Debug, Default)]
pub(super) struct Catalogue {
    pub title: String,
    /// Its folder, with a `/` behind it.
    pub folder: String,
    pub devices: Vec<Listed>,
    /// Pages that all its devices share: files and titles.
    pub shared: Vec<(String, String)>,
}

/// A device in the list of all.
#[derive(Clone, Debug)]
pub(super) struct Listed {
    pub title: String,
    pub vendor: String,
    /// Its first page.
    pub path: String,
    /// Its further pages: files and titles.
    pub pages: Vec<(String, String)>,
}

impl Catalogue {
    /// The devices, their first pages as seen from the folder of the site.
    pub fn in_site(&self) -> impl Iterator<Item = Listed> + '_ {
        self.devices.iter().map(|device| Listed { path: format!("{}{}", self.folder, device.path), ..device.clone() })
    }
}

/// What a page shows.
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
    Findings(&'p [Finding]),
    /// A list of devices.
    List {
        devices: &'p [Listed],
        /// The way to the folder of the site.
        root: &'p str,
        /// The folder of the index, where that isn't the page's.
        index: &'p str,
    },
}

/// Writes pages.
pub(super) trait Pages {
    /// How names of files end, with the dot.
    fn ending(&self) -> &'static str;
    /// The name of the first page of all, without ending.
    fn front(&self) -> &'static str;
    /// The page `file`, whose links and title are those of `frame`.
    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String;

    /// Further pages that those of one catalogue share.
    fn of_catalog(&self, search: &dyn Fn() -> String) -> Vec<Page>;
    /// What all pages share. `search` is the index of all, where a catalogue's isn't enough.
    fn of_site(&self, catalogs: &[Catalogue], search: Option<&dyn Fn() -> String>) -> Vec<Page>;
}
