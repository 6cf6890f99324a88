//! Pluggable modules and submodules.

use std::ops::Range;

use super::anchor::Names;
use super::area::Section;
use super::diagnostics::ShownDiagnostics;
use super::entry::{Known, Row, Rows};
use super::process::{self, About, Frame};
use super::requests::OfRecord;
use super::split;
use super::words;
use lexibus_codegen::backend::rust::{self, Calls};
use lexibus_codegen::collections::HashMap;
use lexibus_codegen::facts::{address, item, profinet};
use lexibus_codegen::ir::{
    Catalog, CompactString, Documentation, Group, GroupKind, Identity, IoData, Manual, Module, ModuleId, ObjectBuses,
    Submodule, SubmoduleId, Texts, TypeDef,
};
use lexibus_codegen::number::{hex16, hex32};

/// Maximum number of modules per page.
const PAGE: usize = 100;

/// A module or submodule, as a page shows it.
#[derive(Debug)]
pub(super) struct ModuleModel {
    pub anchor: String,
    pub number: String,
    pub order_code: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: Vec<String>,
    /// Description of the module in other languages.
    pub translations: Vec<(String, String)>,
    pub frames: Vec<Frame>,
    pub sections: Vec<(String, Section)>,
    /// Names of the submodules that belong to the module, with links to them.
    pub parts: Vec<(String, String)>,
}

impl ModuleModel {
    /// Returns the ident number and the order code, by which the search finds the module. Leaves out empty texts.
    pub fn lookups(&self) -> impl Iterator<Item = &str> {
        [self.number.as_str(), self.order_code.as_str()].into_iter().filter(|number| !number.is_empty())
    }
}

/// Returns whether any of the modules has an item whose requests contain a node-ID or a Modbus unit identifier.
pub(super) fn have_requests(modules: &[ModuleModel]) -> bool {
    modules.iter().flat_map(|module| &module.sections).any(|(_, section)| section.has_requests())
}

/// The modules and submodules of a catalog, and their pages.
#[derive(Debug, Default)]
pub(super) struct Modules {
    /// All modules, followed by all submodules.
    all: Vec<ModuleModel>,
    /// File name and title of each page.
    pub files: Vec<(String, String)>,
    /// Range of the modules on each page.
    ranges: Vec<Range<usize>>,
}

impl Modules {
    /// Creates the modules of a catalog. `file` returns the file name of the next page. `size` returns the size of a module in
    /// bytes, which limits the number of modules on a page.
    pub fn new(
        catalog: &Catalog,
        diagnostics: &ShownDiagnostics,
        size: fn(&ModuleModel) -> usize,
        mut file: impl FnMut() -> String,
    ) -> Self {
        let all = models(catalog, diagnostics);
        let ranges = split::ranges(all.iter().map(size), PAGE, split::SIZE);
        let files = (0..ranges.len()).map(|at| (file(), split::title("Modules", at, ranges.len()))).collect();
        let mut modules = Modules { all, files, ranges };
        modules.link_parts();
        modules
    }

    /// Returns the file name and title of each page, and the modules on it.
    pub fn pages(&self) -> impl Iterator<Item = (&(String, String), &[ModuleModel])> {
        self.files.iter().zip(self.ranges.iter().map(|range| &self.all[range.clone()]))
    }

    /// Returns the name of a module or submodule, or its number if it has no name. Also returns its file and anchor. `at` is its
    /// position in the list of all modules, in which submodules come last.
    pub fn target(&self, at: usize) -> Option<(&str, String)> {
        let module = self.all.get(at)?;
        let (file, _) = self.files.get(self.page_of(at))?;
        let title = if module.name.trim().is_empty() { &module.number } else { &module.name };
        Some((title, format!("{file}#{}", module.anchor)))
    }

    /// Returns the position of the page that contains a module.
    fn page_of(&self, at: usize) -> usize {
        self.ranges.partition_point(|range| range.end <= at)
    }

    /// Completes the links to submodules with file names, because a submodule can be on another page.
    fn link_parts(&mut self) {
        let pages: HashMap<String, usize> =
            self.all.iter().enumerate().map(|(at, module)| (module.anchor.clone(), self.page_of(at))).collect();
        for (page, range) in self.ranges.iter().enumerate() {
            for (_, anchor) in self.all[range.clone()].iter_mut().flat_map(|module| &mut module.parts) {
                let other = pages.get(anchor).filter(|other| **other != page).and_then(|other| self.files.get(*other));
                let file = other.map_or("", |(file, _)| file.as_str());
                *anchor = format!("{file}#{anchor}");
            }
        }
    }
}

/// Returns all modules of a catalog, followed by all submodules.
fn models(catalog: &Catalog, diagnostics: &ShownDiagnostics) -> Vec<ModuleModel> {
    let mut names = Names::default();
    let anchor = |submodule: &Submodule| names.anchor(&format!("submodule-{:08X}", submodule.ident));
    let anchors: Vec<String> = catalog.submodules.iter().map(anchor).collect();
    let mut all: Vec<ModuleModel> = Vec::new();
    let (calls, records) = (rust::usage_of_modules(catalog), rust::usage_of_records(catalog));
    for (id, each) in (0..).map(ModuleId).zip(&catalog.modules) {
        let parts = each.submodules.iter().filter_map(|used| {
            let at = used.submodule.0 as usize;
            let submodule = catalog.submodules.get(at)?;
            let name = if submodule.name.is_empty() { hex32(submodule.ident) } else { submodule.name.to_string() };
            Some((name, anchors.get(at)?.clone()))
        });
        let anchor = names.anchor(&format!("module-{:08X}", each.number));
        let items =
            Items { types: &each.types, calls: calls.get(&id), submodule: "", default_bytes: None, diagnostics };
        all.push(module(each, anchor, parts.collect(), items));
    }
    let submodules = (0..).map(SubmoduleId).zip(&catalog.submodules).zip(anchors);
    all.extend(submodules.map(|((id, each), anchor)| {
        let address = if each.records.is_empty() { String::new() } else { profinet::address_of_records(catalog, id) };
        let usage = records.get(&id);
        let (calls, default_bytes) = (usage.map(|usage| &usage.calls), usage.map(|usage| &usage.default_bytes));
        let items = Items { types: &catalog.types, calls, submodule: &address, default_bytes, diagnostics };
        submodule(each, anchor, items)
    }));
    all
}

/// Data that all items of a module or submodule have in common.
#[derive(Clone, Copy)]
struct Items<'m> {
    types: &'m [TypeDef],
    /// Rust code that reads and writes each item.
    calls: Option<&'m Calls>,
    /// API, slot and subslot of a submodule with records; otherwise empty.
    submodule: &'m str,
    /// Default bytes of the records of a submodule, by the position of the record.
    default_bytes: Option<&'m HashMap<u32, Vec<u8>>>,
    diagnostics: &'m ShownDiagnostics,
}

/// Returns the items of a module in sections. The anchors of the items begin with the module's anchor.
fn sections<'g>(groups: impl Iterator<Item = &'g Group>, items: Items<'_>, anchor: &str) -> Vec<(String, Section)> {
    let (manual, none) = (Manual::default(), Calls::default());
    let Items { types, calls, submodule, default_bytes, diagnostics } = items;
    let calls = calls.unwrap_or(&none);
    let record = OfRecord { submodule, length: 0, default_bytes: &[] };
    let known = Known { manual: &manual, modbus: &[], calls, diagnostics, record };
    let mut rows = Rows::new(types, known, Names::within(anchor));
    let section = |(position, group): (u32, &Group)| {
        rows.known.record = OfRecord {
            submodule,
            length: if let GroupKind::Record(record) = &group.kind { record.length } else { 0 },
            default_bytes: default_bytes.and_then(|all| all.get(&position)).map_or(&[], Vec::as_slice),
        };
        section(position, group, &mut rows)
    };
    (0..).zip(groups).map(section).collect()
}

/// Returns a module or submodule with its names, description and order code.
fn model(
    number: u32,
    anchor: String,
    name: &CompactString,
    names: &Texts,
    documentation: Option<&Documentation>,
    identity: &Identity,
) -> ModuleModel {
    let order = &identity.order_code;
    let mut facts = words::description(name, documentation);
    facts.extend((!order.is_empty()).then(|| format!("Order code {order}.")));
    let names = words::names(name, names);
    ModuleModel {
        anchor,
        number: hex32(number),
        order_code: words::one_line(order),
        name: name.to_string(),
        facts,
        translations: words::translations(name, &names, documentation),
        names,
        frames: Vec::new(),
        sections: Vec::new(),
        parts: Vec::new(),
    }
}

fn module(module: &Module, anchor: String, parts: Vec<(String, String)>, items: Items<'_>) -> ModuleModel {
    let about = About { buses: ObjectBuses::COE, manual: &Manual::default() };
    let Module { name, names, documentation, identity, .. } = module;
    ModuleModel {
        frames: process::frames(&module.process_data, &module.types, about),
        sections: sections(module.fixed_objects.iter().chain(&module.groups), items, &anchor),
        parts,
        ..model(module.number, anchor, name, names, documentation.as_deref(), identity)
    }
}

fn submodule(submodule: &Submodule, anchor: String, items: Items<'_>) -> ModuleModel {
    let Submodule { name, names, documentation, identity, .. } = submodule;
    let sections = sections(submodule.records.iter(), items, &anchor);
    let mut model = model(submodule.ident, anchor, name, names, documentation.as_deref(), identity);
    model.facts.extend((submodule.api != 0).then(|| format!("API {}.", hex16(submodule.api))));
    let safety = "With parameters of functional safety (PROFIsafe).";
    model.facts.extend(submodule.f_parameters.is_some().then(|| safety.to_owned()));
    let image = |data: &IoData, title: &str| process::image(&data.image, items.types, "", title);
    let inputs = submodule.input.as_deref().map(|data| image(data, "Inputs of the controller"));
    let outputs = submodule.output.as_deref().map(|data| image(data, "Outputs of the controller"));
    ModuleModel { frames: inputs.into_iter().chain(outputs).collect(), sections, ..model }
}

fn section(position: u32, group: &Group, rows: &mut Rows<'_>) -> (String, Section) {
    let address = match &group.kind {
        GroupKind::Record(record) => format!("Record {}", hex16(record.index)),
        GroupKind::Object { index, .. } => format!("Object {}", hex16(*index)),
        _ => String::new(),
    };
    let parts = [address.as_str(), group.name.as_str()].into_iter().filter(|part| !part.is_empty());
    let title = parts.collect::<Vec<_>>().join(": ");
    let number = |item: &lexibus_codegen::ir::Item| {
        address::addresses(item, &[]).first().map_or_else(String::new, |address| address.number.clone())
    };
    let row = |(id, item)| Row { name: item::entry_name(item, group), ..rows.row(id, item, number(item), false) };
    let plain = Section::plain(group.items_at(position).map(row).collect());
    (title, Section { default_bytes: rows.known.record.shown_bytes(), ..plain })
}
