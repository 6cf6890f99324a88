//! The interface that each documentation format implements. A format writes the text of each kind of page.

use std::rc::Rc;

use askama::Template;

use super::area::Area;
use super::assumptions::Ranked;
use super::codes::Codes;
use super::diagnostics::DiagnosticGroup;
use super::links::Links;
use super::listed::{Listed, ListedCatalog, PageLink};
use super::machines::Behavior;
use super::modules::ModuleModel;
use super::network::Network;
use super::overview::{Contents, Overview};
use super::process::{ProcessPart, SyncManager};
use super::protocol::Protocol;
use super::revisions::Comparison;
use super::search::Index;
use super::segment::Segment;
use super::{written, Page};

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

/// Relative path from the pages of a device or description to the site's folder.
pub(super) const ROOT: &str = "../../..";

impl Frameset {
    /// Returns the file names and titles of the device's pages, followed by those of the shared pages.
    pub fn all(&self) -> Vec<&(String, String)> {
        self.device_pages.all().chain(self.shared.all()).collect()
    }

    /// Returns the frameset of a page that belongs to no device, such as the page of a network. It links only to this page.
    pub fn alone(title: &str, file: &str, page: &str) -> Frameset {
        let shared = Rc::new(Links::new(vec![(file.to_owned(), page.to_owned())], 0..1));
        Frameset { title: title.to_owned(), root: "..", shared, ..Frameset::default() }
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

/// Declares the content of each kind of page with its templates for HTML and Markdown. The templates use this content, the
/// frameset and the name of the file.
macro_rules! pages {
    ($($page:ident = $html:literal, $markdown:literal { $($field:ident: $ty:ty),+ })+) => {
        /// The content of a page.
        #[derive(Clone, Copy)]
        pub(super) enum Content<'p> { $($page { $($field: $ty),+ },)+ }

        impl Content<'_> {
            template!(html, $($page = $html { $($field: $ty),+ })+);
            template!(markdown, $($page = $markdown { $($field: $ty),+ })+);
        }
    };
}

/// Defines the method that writes a page in a format.
macro_rules! template {
    ($format:ident, $($page:ident = $path:literal { $($field:ident: $ty:ty),+ })+) => {
        pub fn $format(self, frame: &Frameset, file: &str) -> String {
            match self { $(
                Content::$page { $($field),+ } => {
                    #[derive(Template)]
                    #[template(path = $path)]
                    #[allow(dead_code)]
                    struct Page<'p> { frame: &'p Frameset, file: &'p str, $($field: $ty),+ }
                    written::$format(&Page { frame, file, $($field),+ })
                }
            )+ }
        }
    };
}

pages! {
    Overview = "overview.html", "markdown/overview.md" { overview: &'p Overview, contents: &'p Contents }
    Area = "area.html", "markdown/area.md" { area: &'p Area }
    Process = "process.html", "markdown/process.md" { part: &'p ProcessPart, sync_managers: &'p [SyncManager] }
    Protocol = "protocol.html", "markdown/protocol.md" { protocol: &'p Protocol }
    Codes = "codes.html", "markdown/codes.md" { tables: &'p [Codes] }
    Machines = "machines.html", "markdown/machines.md" { behavior: &'p Behavior }
    Modules = "modules.html", "markdown/modules.md" { modules: &'p [ModuleModel] }
    Assumptions = "assumptions.html", "markdown/assumptions.md" { ranked: &'p [Ranked<'p>] }
    Diagnostics = "diagnostics.html", "markdown/diagnostics.md" { groups: &'p [DiagnosticGroup<'p>] }
    Changes = "changes.html", "markdown/changes.md" { comparison: &'p Comparison }
    Network = "network.html", "markdown/network.md" { network: &'p Network, devices: &'p [Option<&'p Listed>] }
    Segment = "segment.html", "markdown/segment.md" { segment: &'p Segment, devices: &'p [Option<&'p Listed>] }
    // A list of devices, in a catalog or in the site. `is_part` is set if the list has several pages.
    List = "list.html", "markdown/list.md" { devices: &'p [Listed], is_part: bool }
}

/// An output format, which writes the text of each page.
pub(super) trait Pages {
    /// Returns the extension of the page files, including the dot.
    fn ending(&self) -> &'static str;
    /// Returns the text of the page `file`. `frame` contains its title and links.
    fn page(&self, frame: &Frameset, file: &str, content: Content<'_>) -> String;

    /// Returns the text of a page that redirects to `target`, the newest revision of a product. Returns `None` if the format has no
    /// such pages.
    fn redirection(&self, _title: &str, _target: &str) -> Option<String> {
        None
    }

    /// Returns the files that the pages of one catalog share.
    fn of_catalog(&self, _index: &Index) -> Vec<Page> {
        Vec::new()
    }
    /// Returns the files that all pages share. `further` are the paths and titles of comparisons and networks. `index` is the
    /// search index of all catalogs, if a page of the site needs this index.
    fn of_site(&self, catalogs: &[ListedCatalog], further: &[PageLink], index: Option<&Index>) -> Vec<Page>;
}
