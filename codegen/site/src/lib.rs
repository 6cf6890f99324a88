//! Creates documentation: a static HTML site or Markdown pages. The HTML site opens from disk, has a search, and has no
//! external links.
//!
//! Add each catalog to a [`Site`], which returns the pages of this catalog. Then call [`Site::finish`] for the pages
//! that all catalogs share.
//!
//! ```
//! use lexibus_site::Site;
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//!
//! let eds = "[DeviceInfo]\nProductName=Pump\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\
//!            [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\n";
//! let compilation = check(Source::new("pump.eds", eds.into()), &Options::default());
//! let mut site = Site::default();
//! let pages = site.add_compilation("pump", &compilation);
//! assert!(pages.iter().any(|page| page.text.contains("Device type")));
//! let shared = site.finish();
//! assert!(shared.iter().any(|page| page.path == "index.html"));
//! ```

#![forbid(unsafe_code)]

mod addresses;
mod anchor;
mod area;
mod assumptions;
mod bits;
mod builder;
mod cell;
mod code_references;
mod codes;
pub mod compare;
mod diagnostics;
mod diagram;
mod entry;
mod folder;
mod format;
mod further;
mod grid;
mod html;
mod indexing;
mod languages;
mod latest;
mod link;
mod links;
mod list;
mod listed;
mod machines;
mod markdown;
mod modules;
pub mod network;
mod overview;
mod pages;
mod part_anchors;
mod parts;
mod process;
mod protocol;
mod references;
mod requests;
mod revisions;
mod search;
pub mod segment;
mod shared;
mod slots;
mod split;
mod tools;
mod twins;
mod words;
mod written;

use std::rc::Rc;

use addresses::Addresses;
use diagnostics::ShownDiagnostics;
use folder::Folder;
pub use format::Format;
pub use further::page_name;
use lexibus_codegen::compile::Compilation;
use lexibus_codegen::ir::Catalog;
use links::Links;
use list::ListPage;
use listed::{Listed, ListedCatalog};
use pages::{Content, Frameset};
use revisions::{Comparison, Revisions};
use search::Index;

/// A file of the documentation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Path relative to the folder of the site, with `/` as the separator.
    pub path: String,
    /// Content of the file.
    pub text: String,
}

/// The tag that marks an HTML page as generated.
const GENERATOR: &str = "<meta name=\"generator\" content=\"lexibus docs\">";

/// The first characters of generated files other than HTML pages.
const BEGINNINGS: [&str; 5] = [
    "<!-- Written by lexibus docs",
    "/* Written by lexibus docs",
    "// Written by lexibus docs",
    "lexibusIndex(",
    "lexibusIndexFirst(",
];

impl Page {
    /// Returns whether this page may replace a file that contains `text`. The page may replace the file if Lexibus generated the
    /// file.
    pub fn replaces(&self, text: &str) -> bool {
        match self.path.ends_with(".html") {
            true => text.contains(GENERATOR),
            false => BEGINNINGS.iter().any(|beginning| text.starts_with(beginning)),
        }
    }

    fn new(path: &str, text: String) -> Self {
        Page { path: path.to_owned(), text }
    }
}

/// A documentation site.
#[derive(Debug, Default)]
pub struct Site {
    format: Format,
    addresses: Addresses,
    revisions: Revisions,
    index: Index,
    catalogs: Vec<ListedCatalog>,
    /// Paths and titles of the pages of comparisons, networks and segments.
    further: Vec<(String, String)>,
}

impl Site {
    /// Creates a site in this format.
    pub fn new(format: Format) -> Self {
        Site { format, ..Site::default() }
    }

    /// Announces a catalog that will be added. If all catalogs are announced first, the site knows all revisions of a
    /// product and all descriptions of a revision before it writes the first page. Then neither links nor folders
    /// depend on the order of the catalogs.
    ///
    /// Use a different name for each catalog, and add every catalog that is announced.
    pub fn announce(&mut self, name: &str, catalog: &Catalog) {
        if !self.addresses.has(name) {
            self.addresses.add(name, catalog);
        }
    }

    /// Adds a catalog with a name, such as the name of its file, and returns its pages. The folder of a device has the
    /// form `vendor/product/revision`, with a suffix if other devices have the same folder.
    pub fn add(&mut self, name: &str, catalog: &Catalog) -> Vec<Page> {
        self.folder(name, catalog, ShownDiagnostics::default())
    }

    /// Adds the catalog of a compilation and returns its pages, including its diagnostics. Returns no pages if the
    /// compilation has errors.
    pub fn add_compilation(&mut self, name: &str, compilation: &Compilation) -> Vec<Page> {
        let pages = compilation.usable().map(|catalog| self.folder(name, catalog, ShownDiagnostics::of(compilation)));
        pages.unwrap_or_default()
    }

    fn folder(&mut self, name: &str, catalog: &Catalog, diagnostics: ShownDiagnostics) -> Vec<Page> {
        self.announce(name, catalog);
        let format = self.format.pages();
        let mut folder = Folder::new(format, &self.addresses, name, &diagnostics);
        folder.catalog(catalog);
        let Folder { home, mut pages, index, listed, changes, .. } = folder;
        let shared = format.of_catalog(&index).into_iter();
        pages.extend(shared.map(|page| Page { path: format!("{home}/{}", page.path), ..page }));
        pages.extend(self.revisions.add(name, catalog, changes, &self.addresses, format));
        self.index.add(&index);
        self.catalogs.push(listed);
        pages
    }

    /// Returns a page with the changes between two descriptions. `old` and `new` each consist of the name and the catalog of a
    /// description. The list of devices links to this page.
    pub fn compare(&mut self, old: (&str, &Catalog), new: (&str, &Catalog)) -> Page {
        let format = self.format.pages();
        let comparison = Comparison::of_catalogs(old, new);
        let name = format!("{} to {}", old.0, new.0);
        let file = format!("{}{}", addresses::folder_name(&name), format.ending());
        let path = format!("_compare/{file}");
        self.further.push((path.clone(), comparison.title.clone()));
        let frame = Frameset::alone("Devices", &file, &comparison.title);
        Page { text: format.page(&frame, &file, Content::Changes { comparison: &comparison }), path }
    }

    /// Returns the pages that all catalogs share: the list of devices, the redirections to the newest revision of each product,
    /// and the support files of the format.
    pub fn finish(self) -> Vec<Page> {
        let format = self.format.pages();
        let file = self.format.first_page();
        let mut devices: Vec<Listed> =
            self.catalogs.iter().flat_map(|catalog| catalog.devices.iter().cloned()).collect();
        listed::sort(&mut devices);
        // If there is only one catalog, its index already contains all entries.
        let index = match self.catalogs.as_slice() {
            [only] => format!("{}/", only.folder),
            _ => String::new(),
        };
        let columns = list::columns(&devices);
        let lists = list::pages(&devices, |device| html::size_of_device(device, &columns), &file, format.ending());
        let is_part = lists.len() > 1;
        let parts = lists.iter().filter(|_| is_part).map(|list| (list.file.clone(), list.title.clone()));
        let shared = Rc::new(Links::new(parts.chain(self.further.iter().cloned()).collect(), 0..0));
        // The pages of comparisons, networks and segments always use the index of the site.
        let index_of_site = (index.is_empty() || !self.further.is_empty()).then_some(&self.index);
        let page = |list: &ListPage| {
            let (title, index, shared) = (list.title.clone(), index.clone(), shared.clone());
            let frame = Frameset { title, root: ".", index, shared, ..Frameset::default() };
            let content = Content::List { devices: &devices[list.devices.clone()], is_part };
            Page { path: list.file.clone(), text: format.page(&frame, &list.file, content) }
        };
        let mut pages: Vec<Page> = lists.iter().map(page).collect();
        pages.extend(format.of_site(&self.catalogs, &self.further, index_of_site));
        pages.extend(latest::pages(&devices, format));
        pages
    }
}
