//! Writes the pages of a catalog. Each device has a folder, and each description file has a folder for the pages that
//! its devices share.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::addresses::Addresses;
use super::anchor::Names;
use super::area;
use super::assumptions;
use super::builder;
use super::code_references;
use super::codes;
use super::diagnostics::{self, ShownDiagnostics};
use super::entry::Known;
use super::html;
use super::indexing;
use super::languages::{languages, languages_of_modules};
use super::links::Links;
use super::listed::{Listed, ListedCatalog, PROCESS_DATA};
use super::machines;
use super::modules::Modules;
use super::overview::{self, Overview};
use super::pages::{Content, Frameset, Pages, FIRST, ROOT};
use super::parts::Parts;
use super::process::{self, About, ProcessPart};
use super::protocol;
use super::references::Targets;
use super::requests::OfRecord;
use super::revisions::{Changes, Previous};
use super::search::{self, Entry, Index};
use super::slots::{self, ModuleLinks};
use super::split;
use super::twins;
use super::Page;
use lexibus_codegen::backend::rust;
use lexibus_codegen::facts::profinet::ANY_SUBMODULE;
use lexibus_codegen::facts::referrers::Referrers;
use lexibus_codegen::facts::{self, pdo, words};
use lexibus_codegen::ir::{Catalog, Device, Manual};

/// The writer of a catalog's pages.
pub(super) struct Folder<'a> {
    pub format: &'static dyn Pages,
    addresses: &'a Addresses,
    /// Name of the description.
    name: String,
    /// Folder of the pages that the devices share, relative to the site's folder.
    pub home: String,
    /// Folder of the pages that are being written, and the file names in this folder.
    open: String,
    files: Names,
    /// Pages with paths relative to the site's folder.
    pub pages: Vec<Page>,
    pub index: Index,
    pub listed: ListedCatalog,
    diagnostics: &'a ShownDiagnostics,
    /// Links to the pages of the device that was written last.
    last: Rc<Links>,
    /// Pages with the changes since the previous revision, which can be in another description.
    pub changes: Vec<Changes>,
}

/// Links that all pages of a folder have.
struct Common<'m> {
    /// The modules of all devices, and the relative path to the folder of the module pages.
    modules: &'m Modules,
    path: String,
    /// Relative path and title of the list of devices; `None` if the catalog has a single device.
    list: Option<(String, String)>,
    /// Links to the pages that the devices share.
    shared: Rc<Links>,
}

impl<'a> Folder<'a> {
    pub fn new(
        format: &'static dyn Pages,
        addresses: &'a Addresses,
        name: &str,
        diagnostics: &'a ShownDiagnostics,
    ) -> Self {
        Folder {
            format,
            addresses,
            name: name.to_owned(),
            home: String::new(),
            open: String::new(),
            files: Names::default(),
            pages: Vec::new(),
            index: Index::default(),
            listed: ListedCatalog { title: name.to_owned(), ..ListedCatalog::default() },
            diagnostics,
            last: Rc::default(),
            changes: Vec::new(),
        }
    }

    /// Starts a new folder for the next pages, with its own file names.
    fn open(&mut self, folder: String) {
        self.open = folder;
        self.files = Names::default();
        self.files.file(FIRST);
    }

    /// Writes all pages of the catalog. The addresses of the shared pages do not depend on the number of devices.
    pub fn catalog(&mut self, catalog: &Catalog) {
        self.home = self.addresses.shared(&self.name);
        self.open(self.home.clone());
        // The device pages link to the shared pages, so the file names of the shared pages are determined first.
        let modules = self.modules(catalog);
        let groups = diagnostics::pages(&self.diagnostics.list);
        let diagnostics = self.numbered("Diagnostics", groups.len());
        let first = format!("{FIRST}{}", self.format.ending());
        let mut shared = modules.files.clone();
        shared.extend(diagnostics.iter().cloned());
        // All pages link to the first module page. If there are many module pages, each page links only to a few of the
        // others.
        let many = modules.files.len().min(1)..modules.files.len();
        let is_single = catalog.devices.len() == 1;
        let list = (!is_single).then(|| (first.clone(), self.name.clone()));
        let shared = Rc::new(Links::new(shared, many));
        let common = Common { modules: &modules, path: String::new(), list, shared };
        let languages_of_modules = languages_of_modules(catalog);
        self.devices(catalog, &languages_of_modules, &common.from(&format!("{ROOT}/{}/", self.home)));
        let device_pages = if is_single { Rc::new(self.pages_of_last()) } else { Rc::default() };
        self.open(self.home.clone());
        self.listed.folder = self.home.clone();
        self.listed.shared =
            common.shared.all().map(|(file, title)| (format!("{}/{file}", self.home), title.clone())).collect();
        let title = catalog.devices.first().filter(|_| is_single).map_or_else(|| self.name.clone(), title);
        let frame = self.frame(title, device_pages, &common, languages(&catalog.devices, &languages_of_modules));
        self.module_pages(&modules, &frame);
        for ((file, _), groups) in diagnostics.iter().zip(&groups) {
            self.page(&frame, file, Content::Diagnostics { groups });
        }
        if !is_single {
            let devices = std::mem::take(&mut self.listed.devices);
            self.page(&frame, &first, Content::List { devices: &devices, is_part: false });
            self.listed.devices = devices;
        }
    }

    /// Writes the pages of all devices. Identical devices have the same pages.
    fn devices(&mut self, catalog: &Catalog, languages_of_modules: &BTreeSet<&str>, common: &Common<'_>) {
        let notes = twins::notes(catalog).into_iter().enumerate();
        for (at, note) in notes.filter_map(|(at, note)| Some((at, note?))) {
            let device = &catalog.devices[at];
            self.open(self.addresses.device(device, &(self.name.clone(), at)));
            self.device(at, note, device, catalog, languages_of_modules, common);
        }
    }

    /// Returns the links from the shared pages to the pages of the device that was written last.
    fn pages_of_last(&self) -> Links {
        self.last.moved(|(file, title)| (format!("{ROOT}/{}/{file}", self.open), title.clone()))
    }

    /// Returns the links and languages that the pages of a device or description have in common.
    fn frame(&self, title: String, device_pages: Rc<Links>, common: &Common<'_>, languages: Vec<String>) -> Frameset {
        let (list, shared) = (common.list.clone(), common.shared.clone());
        Frameset { title, list, device_pages, shared, languages, root: ROOT, index: format!("{}/", self.home) }
    }

    /// Adds a page to the index, with an entry for the page itself.
    fn index_page(&mut self, file: &str, kind: &'static str, title: &str, words: &str) {
        self.index.page(file, kind);
        self.index.entry(&Entry { words, ..indexing::entry("", "", title) });
    }

    fn page(&mut self, frame: &Frameset, file: &str, content: Content<'_>) {
        let text = self.format.page(frame, file, content);
        self.pages.push(Page { path: format!("{}/{file}", self.open), text });
    }

    /// Returns an unused file name for `title`.
    fn file(&mut self, title: &str) -> String {
        self.files.file(title) + self.format.ending()
    }

    /// Returns unused file names and the titles for `count` pages.
    fn numbered(&mut self, title: &str, count: usize) -> Vec<(String, String)> {
        (0..count).map(|at| (self.file(title), split::title(title, at, count))).collect()
    }

    /// Writes the pages of a device. `at` is its position in the catalog, and `note` is the note that lists of devices show.
    fn device(
        &mut self,
        at: usize,
        note: String,
        device: &Device,
        catalog: &Catalog,
        languages_of_modules: &BTreeSet<&str>,
        common: &Common<'_>,
    ) {
        let title = title(device);
        let first = format!("{FIRST}{}", self.format.ending());
        let manual = words::manual(device);
        let overview = overview::overview(catalog, device, &manual);
        let (parts, mut pages) = self.parts(device, overview, &manual);
        let ranked = split::pages(assumptions::ranked(&parts, &first));
        let assumptions = self.numbered("Assumptions", ranked.len());
        pages.extend(assumptions.iter().cloned());
        let previous = Previous::of(self.addresses, device);
        let changes = previous.as_ref().map(|previous| (self.file("Changes"), previous.title()));
        pages.extend(changes.clone());
        let mut links = vec![(first.clone(), "Overview".to_owned())];
        links.extend(pages.iter().cloned());
        self.last = Rc::new(Links::new(links, 1..1 + parts.areas.len()));
        let languages = languages(std::slice::from_ref(device), languages_of_modules);
        let frame = Rc::new(self.frame(title.clone(), self.last.clone(), common, languages));
        for ((file, _), ranked) in assumptions.iter().zip(&ranked) {
            self.page(&frame, file, Content::Assumptions { ranked });
        }
        if let (Some((file, _)), Some(previous)) = (&changes, previous) {
            let key = (self.name.clone(), at);
            let (frame, folder, file) = (frame.clone(), self.open.clone(), file.clone());
            self.changes.push(Changes { previous, key, frame, folder, file });
        }
        let links = ModuleLinks { modules: common.modules, path: &common.path };
        let contents = parts.contents(slots::slots(catalog, device, links));
        self.page(&frame, &first, Content::Overview { overview: &parts.overview, contents: &contents });
        let path = |file: &str| format!("{}/{file}", self.open);
        let pages = pages.into_iter().map(|(file, title)| (path(&file), title)).collect();
        let mut listed = Listed::new(catalog, device, &self.name, title, path(&first), pages);
        listed.note = note;
        self.index.device(&listed.title, &listed.words(), &listed.distinction(), &self.open);
        self.index_page(&first, search::DEVICE, &listed.title, &listed.words());
        for area in &parts.areas {
            self.page(&frame, &area.file, Content::Area { area });
            self.index_page(&area.file, "", &area.title, "");
            indexing::area(&mut self.index, area);
        }
        self.further(device, &parts, &frame);
        for (file, title) in assumptions.into_iter().chain(changes) {
            self.index_page(&file, "", &title, "");
        }
        self.listed.devices.push(listed);
    }

    /// Collects the parts of a device and determines their pages.
    fn parts(&mut self, device: &Device, overview: Overview, manual: &Manual) -> (Parts, Vec<(String, String)>) {
        let usage = rust::usage(device);
        let known = Known {
            manual,
            modbus: &device.modbus,
            calls: &usage.calls,
            diagnostics: self.diagnostics,
            record: OfRecord { submodule: ANY_SUBMODULE, length: 0, default_bytes: &[] },
        };
        let mut areas = area::areas(&device.groups, &device.types, known, html::size_of_section, &mut self.files);
        for area in &mut areas {
            area.file += self.format.ending();
        }
        let mut pages: Vec<_> = areas.iter().map(|area| (area.file.clone(), area.title.clone())).collect();
        let mut further = |has: bool, title: &str| {
            let file = has.then(|| self.file(title));
            pages.extend(file.clone().map(|file| (file, title.to_owned())));
            file
        };
        let frames = process::frames(&device.process_data, &device.types, About { buses: pdo::buses(device), manual });
        let protocol = protocol::protocol(device, manual);
        let behavior = machines::behavior(device, manual);
        let tables = split::pages(codes::tables(device, manual));
        let mut parts = Parts {
            overview,
            process: further(!frames.is_empty() || !device.process_data.sync_managers.is_empty(), PROCESS_DATA),
            protocol: further(protocol.is_some(), "Messages").zip(protocol),
            behavior: further(behavior.is_some(), "States and procedures").zip(behavior),
            codes: Vec::new(),
            areas,
            data: ProcessPart { frames, builder: builder::data(device, &usage) },
        };
        let codes = self.numbered("Codes", tables.len());
        pages.extend(codes.iter().cloned());
        parts.codes = codes.into_iter().zip(tables).map(|((file, title), tables)| (file, title, tables)).collect();
        link(&mut parts, device);
        (parts, pages)
    }

    /// Writes the remaining pages of a device, which follow the pages of its items.
    fn further(&mut self, device: &Device, parts: &Parts, frame: &Frameset) {
        if let Some(file) = &parts.process {
            let sync_managers = process::sync_managers(&device.process_data);
            self.page(frame, file, Content::Process { part: &parts.data, sync_managers: &sync_managers });
            self.index_page(file, "PDO", PROCESS_DATA, "");
            indexing::frames(&mut self.index, &parts.data.frames);
        }
        if let Some((file, protocol)) = &parts.protocol {
            self.page(frame, file, Content::Protocol { protocol });
            self.index_page(file, "", "Messages", "");
            indexing::messages(&mut self.index, protocol);
        }
        if let Some((file, behavior)) = &parts.behavior {
            self.page(frame, file, Content::Machines { behavior });
            self.index_page(file, "", "States and procedures", "");
            indexing::behavior(&mut self.index, behavior);
        }
        for (file, title, tables) in &parts.codes {
            self.page(frame, file, Content::Codes { tables });
            self.index_page(file, "code", title, "");
            indexing::codes(&mut self.index, tables);
        }
    }

    fn modules(&mut self, catalog: &Catalog) -> Modules {
        let (files, ending) = (&mut self.files, self.format.ending());
        Modules::new(catalog, self.diagnostics, html::size_of_module, || files.file("modules") + ending)
    }

    fn module_pages(&mut self, modules: &Modules, frame: &Frameset) {
        if !modules.files.is_empty() {
            self.index.device(&frame.title, "", "", &self.home);
        }
        for ((file, title), modules) in modules.pages() {
            self.page(frame, file, Content::Modules { modules });
            self.index_page(file, "module", title, "");
            modules.iter().for_each(|module| indexing::module(&mut self.index, module));
        }
    }
}

impl Common<'_> {
    /// Returns a copy whose links begin with `path`, for pages in another folder.
    fn from(&self, path: &str) -> Self {
        let moved = |(file, title): &(String, String)| (format!("{path}{file}"), title.clone());
        let (list, shared) = (self.list.as_ref().map(moved), Rc::new(self.shared.moved(moved)));
        Common { modules: self.modules, path: path.to_owned(), list, shared }
    }
}

/// Adds the links between the elements of a device.
fn link(parts: &mut Parts, device: &Device) {
    let (targets, referrers) = (Targets::new(device, parts), Referrers::new(device));
    let codes = code_references::link(&targets, &mut parts.codes);
    for row in parts.areas.iter_mut().flat_map(|area| &mut area.sections).flat_map(|section| &mut section.rows) {
        row.relations = targets.relations(row.id, &referrers);
        row.relations.extend(codes.of(row.id));
    }
    for entry in parts.data.frames.iter_mut().flat_map(|frame| &mut frame.entries) {
        entry.target = targets.item(entry.item).map(|link| link.target.clone()).unwrap_or_default();
    }
    if let Some((_, behavior)) = &mut parts.behavior {
        targets.link(behavior);
    }
}

fn title(device: &Device) -> String {
    match facts::device::title(device) {
        "" => "Device".to_owned(),
        title => title.to_owned(),
    }
}
