//! Documentation: a static site of HTML that opens from disk, with a search and no address of any other place, or pages
//! of Markdown.
//!
//! A [`Site`] takes one catalogue after the other and gives the pages of each; what all of them share comes at the end.
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

mod anchor;
mod area;
mod assumptions;
mod bits;
mod cell;
mod codes;
pub mod compare;
mod entry;
mod findings;
mod folder;
mod format;
mod html;
mod links;
mod machines;
mod markdown;
mod modules;
mod overview;
mod pages;
mod process;
mod protocol;
mod search;
mod words;

use anchor::Names;
use findings::Findings;
use folder::Folder;
pub use format::Format;
use lexibus_codegen::compile::Compilation;
use lexibus_codegen::ir::Catalog;
use pages::{Catalogue, Content, Frameset, Listed};
use search::Index;

/// A file of the site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Where it belongs, relative to the site, with `/` between folders.
    pub path: String,
    /// Its content.
    pub text: String,
}

/// What a page of HTML says of itself.
const GENERATOR: &str = "<meta name=\"generator\" content=\"lexibus docs\">";

/// How other files begin.
const BEGINNINGS: [&str; 4] =
    ["<!-- Written by lexibus docs", "/* Written by lexibus docs", "// Written by lexibus docs", "lexibusIndex("];

impl Page {
    /// Whether a file with this text may become this page: it is one of an earlier call.
    pub fn replaces(&self, text: &str) -> bool {
        match self.path.ends_with(".html") {
            true => text.contains(GENERATOR),
            false => BEGINNINGS.iter().any(|own| text.starts_with(own)),
        }
    }

    fn new(path: &str, text: String) -> Self {
        Page { path: path.to_owned(), text }
    }
}

/// A site of documentation.
#[derive(Debug, Default)]
pub struct Site {
    format: Format,
    folders: Names,
    index: Index,
    catalogs: Vec<Catalogue>,
}

impl Site {
    /// A site of pages in this format.
    pub fn new(format: Format) -> Self {
        Site { format, ..Site::default() }
    }

    /// The pages of a catalogue, in a folder that is named after `name`.
    pub fn add(&mut self, name: &str, catalog: &Catalog) -> Vec<Page> {
        self.folder(name, catalog, Findings::default())
    }

    /// The pages of what was compiled, with what was found in its source; none where it has errors.
    pub fn add_compilation(&mut self, name: &str, compilation: &Compilation) -> Vec<Page> {
        let catalog = compilation.catalog.as_ref().filter(|_| compilation.is_usable());
        catalog.map(|catalog| self.folder(name, catalog, Findings::of(compilation))).unwrap_or_default()
    }

    fn folder(&mut self, name: &str, catalog: &Catalog, findings: Findings) -> Vec<Page> {
        let folder = self.folders.file(name);
        let mut own = Folder::new(self.format.pages(), findings);
        own.catalog(name, catalog);
        self.index.add(&own.index, &folder);
        own.pages.extend(own.format.of_catalog(&|| own.index.script()));
        self.catalogs.push(Catalogue { title: name.to_owned(), folder: format!("{folder}/"), ..own.listed });
        own.pages.into_iter().map(|page| Page { path: format!("{folder}/{}", page.path), ..page }).collect()
    }

    /// What all pages share: the list of devices, and what their format wants.
    pub fn finish(self) -> Vec<Page> {
        let format = self.format.pages();
        let frame = Frameset { title: "Devices".to_owned(), ..Frameset::default() };
        let file = self.format.first_page();
        let devices: Vec<Listed> = self.catalogs.iter().flat_map(Catalogue::in_site).collect();
        // All that a single catalogue has is in its own index.
        let index = match self.catalogs.as_slice() {
            [only] => only.folder.as_str(),
            _ => "",
        };
        let list = format.page(&frame, &file, Content::List { devices: &devices, root: ".", index });
        let script = || self.index.script();
        let search: Option<&dyn Fn() -> String> = if index.is_empty() { Some(&script) } else { None };
        let mut pages = vec![Page { path: file, text: list }];
        pages.extend(format.of_site(&self.catalogs, search));
        pages
    }
}
