//! Documentation as a static site: pages of HTML that open from disk, with a search, and no address of any other place.
//!
//! A [`Site`] takes one catalogue after the other and gives the pages of each; what all of them share comes at the end.
//!
//! ```
//! use lexibus_codegen::backend::docs::Site;
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//!
//! let eds = "[DeviceInfo]\nProductName=Pump\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\
//!            [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\n";
//! let compilation = check(Source::new("pump.eds", eds.into()), &Options::default());
//! let mut site = Site::default();
//! let pages = site.add("pump", &compilation.catalog.expect("a device"));
//! assert!(pages.iter().any(|page| page.text.contains("Device type")));
//! let shared = site.finish();
//! assert!(shared.iter().any(|page| page.path == "index.html"));
//! ```

mod anchor;
mod area;
mod bits;
mod cell;
mod codes;
mod entry;
mod machines;
mod modules;
mod overview;
mod process;
mod protocol;
mod search;
mod words;

use askama::Template;

use crate::backend::rust;
use crate::backend::words::Manual;
use crate::ir::{Catalog, Device};
use anchor::Names;
use area::Area;
use codes::Codes;
use machines::{Machine, Sequence};
use modules::{ModuleModel, Slot};
use overview::Overview;
use process::{Frame, SyncManager};
use protocol::Protocol;
use search::{Entry, Index};

/// What pages look like.
const STYLE: &str = include_str!("../../../templates/docs/site.css");

/// Search, theme, language and copying.
const SCRIPT: &str = include_str!("../../../templates/docs/site.js");

/// First bit and number of bits of the rows of drawings.
type Grids = std::collections::BTreeSet<(u32, u32)>;

/// A file of the site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Where it belongs, relative to the site, with `/` between folders.
    pub path: String,
    /// Its content.
    pub text: String,
}

/// A site of documentation.
#[derive(Debug, Default)]
pub struct Site {
    folders: Names,
    index: Index,
    /// Titles and first pages of the devices.
    devices: Vec<Listed>,
    /// The folders of the catalogues.
    catalogs: Vec<String>,
}

/// A device in the list of all.
#[derive(Debug)]
struct Listed {
    title: String,
    vendor: String,
    path: String,
}

/// What each page of a catalogue has around it.
#[derive(Debug)]
struct Frameset {
    /// The catalogue, or the device of it.
    title: String,
    /// Files and titles of the pages.
    links: Vec<(String, String)>,
    /// Languages of names.
    languages: Vec<String>,
}

#[derive(Template)]
#[template(path = "docs/overview.html")]
struct OverviewPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: Overview,
    areas: Vec<(String, String, usize)>,
    frames: Vec<(String, String)>,
    slots: Vec<Slot>,
}

#[derive(Template)]
#[template(path = "docs/area.html")]
struct AreaPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: &'p Area,
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "docs/process.html")]
struct ProcessPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    frames: &'p [Frame],
    sync_managers: Vec<SyncManager>,
}

#[derive(Template)]
#[template(path = "docs/protocol.html")]
struct ProtocolPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    own: &'p Protocol,
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "docs/codes.html")]
struct CodesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    tables: &'p [Codes],
}

#[derive(Template)]
#[template(path = "docs/machines.html")]
struct MachinesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    machines: Vec<Machine>,
    sequences: Vec<Sequence>,
}

#[derive(Template)]
#[template(path = "docs/modules.html")]
struct ModulesPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    modules: &'p [ModuleModel],
    grids: &'p Grids,
}

#[derive(Template)]
#[template(path = "docs/list.html")]
struct ListPage<'p> {
    around: &'p Frameset,
    file: &'p str,
    devices: &'p [Listed],
    /// The way to the folder of the site.
    root: &'p str,
    /// The folder of the index, where that isn't the page's.
    index: &'p str,
}

/// Templates don't fail on what they are given.
fn written(template: &impl Template) -> String {
    template.render().unwrap_or_default()
}

impl Site {
    /// The pages of a catalogue, in a folder that is named after `name`.
    pub fn add(&mut self, name: &str, catalog: &Catalog) -> Vec<Page> {
        let folder = self.folders.file(name);
        let mut files = Names::default();
        files.file("index");
        let mut own = Folder { files, pages: Vec::new(), index: Index::default(), devices: Vec::new() };
        let is_alone = catalog.devices.len() == 1;
        let has_modules = !catalog.modules.is_empty() || !catalog.submodules.is_empty();
        let modules = if has_modules { own.modules(catalog, name) } else { Vec::new() };
        for device in &catalog.devices {
            own.device(device, catalog, is_alone, &modules);
        }
        if !is_alone {
            own.list(name, &modules);
        }
        let listed = own.devices.drain(..).map(|own| Listed { path: format!("{folder}/{}", own.path), ..own });
        self.devices.extend(listed);
        self.index.add(&own.index, &folder);
        self.catalogs.push(format!("{folder}/"));
        own.pages.push(Page { path: "search.js".to_owned(), text: own.index.script() });
        own.pages.into_iter().map(|page| Page { path: format!("{folder}/{}", page.path), ..page }).collect()
    }

    /// What all pages share: the list of devices, the index of all, style and script.
    pub fn finish(self) -> Vec<Page> {
        let around = Frameset { title: "Devices".to_owned(), links: Vec::new(), languages: Vec::new() };
        // All that a single catalogue has is in its own index.
        let (index, own) = match self.catalogs.as_slice() {
            [only] => (only.as_str(), None),
            _ => ("", Some(self.index.script())),
        };
        let list = ListPage { around: &around, file: "index.html", devices: &self.devices, root: ".", index };
        let page = |path: &str, text: String| Page { path: path.to_owned(), text };
        let mut pages = vec![
            page("index.html", written(&list)),
            page("site.css", STYLE.to_owned()),
            page("site.js", SCRIPT.to_owned()),
        ];
        pages.extend(own.map(|script| page("search.js", script)));
        pages
    }
}

/// The folder of a catalogue.
struct Folder {
    files: Names,
    pages: Vec<Page>,
    index: Index,
    devices: Vec<Listed>,
}

impl Folder {
    fn page(&mut self, file: &str, text: String) {
        self.pages.push(Page { path: file.to_owned(), text });
    }

    fn device(&mut self, device: &Device, catalog: &Catalog, is_alone: bool, modules: &[(String, String)]) {
        let title = title(device);
        let own = if is_alone { "index".to_owned() } else { self.files.file(&title) };
        let first = format!("{own}.html");
        let prefix = if is_alone { String::new() } else { format!("{own}-") };
        let manual = Manual::of(device);
        let calls = rust::calls(device).into_iter().map(|(item, call)| (std::ptr::from_ref(item), call)).collect();
        let areas = area::areas(&device.groups, &device.types, (&manual, &calls), &mut self.files, &prefix);
        let frames = process::frames(&device.process_data, &device.types);
        let protocol = protocol::protocol(device, &manual);
        let tables = codes::tables(&device.code_tables, &manual);
        let mut links = vec![(first.clone(), "Overview".to_owned())];
        links.extend(areas.iter().map(|own| (format!("{}.html", own.file), own.title.clone())));
        let mut further = |has: bool, title: &str| {
            let file = has.then(|| format!("{}.html", self.files.file(&format!("{prefix}{title}"))));
            links.extend(file.clone().map(|file| (file, title.to_owned())));
            file
        };
        let process_file = further(!frames.is_empty() || !device.process_data.sync_managers.is_empty(), "Process data");
        let protocol_file = further(protocol.is_some(), "Messages");
        let machines_file =
            further(!device.machines.is_empty() || !device.procedures.is_empty(), "States and procedures");
        let codes_file = further(!tables.is_empty(), "Codes");
        links.extend(modules.iter().cloned());
        let around = Frameset { title: title.clone(), links, languages: languages(device) };

        let overview = OverviewPage {
            around: &around,
            file: &first,
            own: overview::overview(device, catalog.files.first(), &manual),
            areas: areas.iter().map(|own| (format!("{}.html", own.file), own.title.clone(), own.count())).collect(),
            frames: process_file
                .iter()
                .flat_map(|file| frames.iter().map(move |own| (format!("{file}#{}", own.anchor), own.title.clone())))
                .collect(),
            slots: modules::slots(device),
        };
        let text = written(&overview);
        self.page(&first, text);
        self.index.page(&first, &title);
        for own in &areas {
            let file = format!("{}.html", own.file);
            let drawings = own.sections.iter().flat_map(|section| &section.rows).filter_map(|row| row.bits.as_ref());
            let grids = &bits::grids(drawings);
            self.page(&file, written(&AreaPage { around: &around, file: &file, own, grids }));
            self.index.page(&file, &title);
            index_area(&mut self.index, own);
        }
        if let Some(file) = process_file {
            let sync_managers = process::sync_managers(&device.process_data);
            self.page(&file, written(&ProcessPage { around: &around, file: &file, frames: &frames, sync_managers }));
            self.index.page(&file, &title);
            for own in &frames {
                self.index.entry(&found(&own.anchor, &own.anchor, &own.title));
            }
        }
        if let Some((file, own)) = protocol_file.zip(protocol) {
            let parts = own.messages.iter().flat_map(|own| own.request.iter().chain(&own.reply));
            let grids = &bits::grids(parts.filter_map(|part| part.bits.as_ref()));
            self.page(&file, written(&ProtocolPage { around: &around, file: &file, own: &own, grids }));
            self.index.page(&file, &title);
            for own in &own.messages {
                let words = own.facts.first().map_or("", String::as_str);
                self.index.entry(&Entry { names: &own.names, words, ..found(&own.anchor, "message", &own.name) });
            }
        }
        if let Some(file) = machines_file {
            let machines = device.machines.iter().map(|own| machines::machine(own, &manual)).collect();
            let sequences = device.procedures.iter().map(|own| machines::sequence(own, &manual)).collect();
            self.page(&file, written(&MachinesPage { around: &around, file: &file, machines, sequences }));
        }
        if let Some(file) = codes_file {
            self.page(&file, written(&CodesPage { around: &around, file: &file, tables: &tables }));
            self.index.page(&file, &title);
            for own in tables.iter().flat_map(|table| &table.rows) {
                self.index.entry(&Entry {
                    names: &own.names,
                    words: &own.facts,
                    ..found(&own.anchor, &own.number, &own.name)
                });
            }
        }
        self.devices.push(Listed { title, vendor: device.identity.vendor_name.to_string(), path: first });
    }

    /// The pages of modules, which all devices of a catalogue share: files and titles.
    fn modules(&mut self, catalog: &Catalog, title: &str) -> Vec<(String, String)> {
        let all = modules::modules(catalog, &mut Names::default());
        let chunks: Vec<&[ModuleModel]> = all.chunks(modules::PAGE).collect();
        let name = |at: usize| match chunks.len() {
            1 => "Modules".to_owned(),
            count => format!("Modules ({} of {count})", at + 1),
        };
        let links: Vec<(String, String)> =
            (0..chunks.len()).map(|at| (format!("{}.html", self.files.file("modules")), name(at))).collect();
        let around = Frameset { title: title.to_owned(), links: links.clone(), languages: Vec::new() };
        for ((file, _), modules) in links.iter().zip(chunks) {
            let rows = modules.iter().flat_map(|own| &own.sections).flat_map(|(_, section)| &section.rows);
            let grids = &bits::grids(rows.filter_map(|row| row.bits.as_ref()));
            self.page(file, written(&ModulesPage { around: &around, file, modules, grids }));
            self.index.page(file, title);
            for own in modules {
                let words = own.facts.first().map_or("", String::as_str);
                self.index.entry(&Entry { names: &own.names, words, ..found(&own.anchor, &own.number, &own.name) });
            }
        }
        links
    }

    /// The first page of a catalogue of several devices.
    fn list(&mut self, title: &str, modules: &[(String, String)]) {
        let around = Frameset { title: title.to_owned(), links: modules.to_vec(), languages: Vec::new() };
        let text =
            written(&ListPage { around: &around, file: "index.html", devices: &self.devices, root: "..", index: "" });
        self.page("index.html", text);
    }
}

fn found<'e>(anchor: &'e str, number: &'e str, name: &'e str) -> Entry<'e> {
    Entry { anchor, number, name, names: &[], unit: "", words: "" }
}

fn index_area(index: &mut Index, own: &Area) {
    for section in &own.sections {
        if let Some(anchor) = &section.anchor {
            index.entry(&Entry { names: &section.names, ..found(anchor, &section.number, &section.name) });
        }
        for row in &section.rows {
            let words = row.facts.first().map_or("", String::as_str);
            let entry = found(&row.anchor, &row.number, &row.name);
            index.entry(&Entry { names: &row.names, unit: &row.unit, words, ..entry });
        }
    }
}

fn title(device: &Device) -> String {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.trim().is_empty()).map_or_else(|| "Device".to_owned(), ToString::to_string)
}

/// The languages of the names of items.
fn languages(device: &Device) -> Vec<String> {
    let groups = device
        .groups
        .iter()
        .flat_map(|group| group.names.iter().chain(group.items.iter().flat_map(|item| item.names.iter())));
    let messages = device.messages.iter().flat_map(|message| message.names.iter());
    let mut languages: Vec<String> = groups.chain(messages).map(|own| own.language.to_string()).collect();
    languages.sort();
    languages.dedup();
    languages
}
