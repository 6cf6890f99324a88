//! Pages that list items, such as the registers of a chapter or the objects of an index range.

use std::collections::HashMap;

use super::anchor::Names;
use super::diagnostics::ShownDiagnostic;
use super::entry::{self, Doubt, Known, Row, Rows};
use super::requests;
use super::shared::{self, SharedDoubt};
use super::split::{self, Fill};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::{address, area, item};
use lexibus_codegen::ir::{Group, GroupKind, Item, ItemId, TypeDef};
use lexibus_codegen::number::{self, hex16};

/// Maximum number of items on a page.
const PAGE: usize = 500;

/// A page that lists items.
#[derive(Debug)]
pub(super) struct Area {
    /// File name of the page, without extension.
    pub file: String,
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub sections: Vec<Section>,
}

impl Area {
    /// Returns the number of items on the page.
    pub fn count(&self) -> usize {
        self.sections.iter().map(|section| section.rows.len()).sum()
    }

    /// Returns whether any row has requests that contain a node-ID or a Modbus unit identifier.
    pub fn has_requests(&self) -> bool {
        self.sections.iter().any(Section::has_requests)
    }
}

/// The items under one heading: an object with its entries, or registers.
#[derive(Debug, Default)]
pub(super) struct Section {
    /// Anchor of an object with sub-indices. `None` for other objects and for registers, because each row has its own
    /// anchor.
    pub anchor: Option<String>,
    pub number: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    /// Ambiguities that several entries of the object have in common.
    pub shared: Vec<SharedDoubt>,
    pub diagnostics: Vec<ShownDiagnostic>,
    /// Default bytes of a PROFINET record, such as `5A 01`; empty if unknown or too long.
    pub default_bytes: String,
    pub rows: Vec<Row>,
}

impl Section {
    /// Returns whether any row has requests that contain a node-ID or a Modbus unit identifier.
    pub fn has_requests(&self) -> bool {
        self.rows.iter().flat_map(|row| &row.fixed_requests).any(|request| !requests::is_of_record(request))
    }
}

/// A part of a device: a chapter, a process image or a range of objects. The groups of a part share pages.
struct Part<'g> {
    title: String,
    /// The groups of the part, with their positions in the device.
    groups: Vec<(u32, &'g Group)>,
}

/// Function that returns the size of a section in bytes.
pub(super) type Size = fn(&Section) -> usize;

/// Returns the pages for these groups. `size` returns the size of a section, which limits the number of sections per
/// page.
pub(super) fn areas(groups: &[Group], types: &[TypeDef], known: Known<'_>, size: Size, files: &mut Names) -> Vec<Area> {
    parts(groups).iter().flat_map(|part| pages(part, Filler::new(types, known, size), files)).collect()
}

/// Returns the parts of a device: one for each chapter and process image, and one for each range of objects (CiA 301
/// 7.4.1).
fn parts(groups: &[Group]) -> Vec<Part<'_>> {
    let mut parts: Vec<Part<'_>> = Vec::new();
    let mut ranges: HashMap<String, usize> = HashMap::new();
    for (position, group) in (0..).zip(groups).filter(|(_, group)| !group.items.is_empty() || group.index().is_some()) {
        let title = area::title(group);
        if group.index().is_some() {
            let at = *ranges.entry(title.clone()).or_insert(parts.len());
            if let Some(part) = parts.get_mut(at) {
                part.groups.push((position, group));
                continue;
            }
        }
        parts.push(Part { title, groups: vec![(position, group)] });
    }
    parts
}

/// Distributes the sections of a part over pages.
struct Filler<'p> {
    /// The rows of the last page, with their anchors and the types whose bits or values the page already shows.
    rows: Rows<'p>,
    fill: Fill,
    size: Size,
    pages: Vec<Vec<Section>>,
}

impl<'p> Filler<'p> {
    fn new(types: &'p [TypeDef], known: Known<'p>, size: Size) -> Self {
        let rows = Rows::new(types, known, Names::default());
        Filler { rows, fill: Fill::new(PAGE), size, pages: vec![Vec::new()] }
    }

    /// Adds a section with these items. All items of a section are on the same page.
    fn add(&mut self, group: &Group, items: &[(ItemId, &Item)]) {
        let (mut section, mut size) = self.section(group, items);
        if !self.fill.fits(items.len(), size) {
            let pages = std::mem::take(&mut self.pages);
            *self = Filler { pages, ..Filler::new(self.rows.types, self.rows.known, self.size) };
            self.pages.push(Vec::new());
            // Create the section again for the new page, because the first row with a type on each page shows the bits
            // or values of this type.
            (section, size) = self.section(group, items);
        }
        self.fill.add(items.len(), size);
        if let Some(page) = self.pages.last_mut() {
            page.push(section);
        }
    }

    /// Returns the section for items, and its size in bytes of HTML.
    fn section(&mut self, group: &Group, items: &[(ItemId, &Item)]) -> (Section, usize) {
        let section = section(group, items, &mut self.rows);
        let size = (self.size)(&section);
        (section, size)
    }
}

fn pages(part: &Part<'_>, mut filler: Filler<'_>, files: &mut Names) -> Vec<Area> {
    let manual = filler.rows.known.manual;
    for &(position, group) in &part.groups {
        let items: Vec<(ItemId, &Item)> = group.items_at(position).collect();
        match group.kind {
            GroupKind::Object { .. } => filler.add(group, &items),
            // Add each register as a separate section, because a long chapter can occupy several pages.
            _ => items.chunks(1).for_each(|item| filler.add(group, item)),
        }
    }
    let areas = filler.pages;
    let several = areas.len();
    let about = part.groups.first().map(|(_, group)| group).filter(|group| group.index().is_none());
    let page = |(at, sections): (usize, Vec<Section>)| {
        let title = split::title(&part.title, at, several);
        let (file, mut facts, mut doubts) = (files.file(&part.title), Vec::new(), Vec::new());
        if let Some(group) = about {
            facts = PLAIN.description(group.documentation.as_deref());
            facts.extend(PLAIN.manual_entry(manual, "", group.documentation.as_deref(), &group.names));
            doubts = entry::doubts(&group.doubts, "", manual);
        }
        Area { file, title, facts, doubts, sections }
    };
    areas.into_iter().enumerate().map(page).collect()
}

fn section(group: &Group, items: &[(ItemId, &Item)], rows: &mut Rows<'_>) -> Section {
    let GroupKind::Object { index, code, .. } = group.kind else {
        let modbus = rows.known.modbus;
        let number = |item: &Item| {
            address::addresses(item, modbus).first().map_or_else(String::new, |address| address.number.clone())
        };
        let rows = items.iter().map(|&(id, item)| rows.row(id, item, number(item), true)).collect();
        return Section::plain(rows);
    };
    let number = hex16(index);
    if let ([(id, item)], false) = (items, code.has_subs()) {
        let row = rows.row(*id, item, number, false);
        return Section::plain(vec![Row { name: item::entry_name(item, group), ..row }]);
    }
    let mut facts = PLAIN.description(group.documentation.as_deref());
    facts.extend(PLAIN.origins(&group.origins));
    facts.extend(PLAIN.manual_entry(rows.known.manual, "", group.documentation.as_deref(), &group.names));
    let anchor = rows.names.anchor(&number);
    let sub = |item: &Item| item.object().map_or_else(String::new, |(index, sub)| number::object(index, sub));
    let mut diagnostics = rows.known.diagnostics.of_group(group);
    let doubts = entry::doubts(&group.doubts, "", rows.known.manual);
    let mut row = |id: ItemId, item: &Item| {
        let row = rows.row(id, item, sub(item), false);
        Row { name: item::entry_name(item, group), ..row }
    };
    let mut rows: Vec<Row> = items.iter().map(|&(id, item)| row(id, item)).collect();
    shared::diagnostics(&mut rows, &mut diagnostics);
    Section {
        anchor: Some(anchor),
        number,
        name: format!("{} ({})", group.name, code.name()),
        names: words::names(&group.name, &group.names),
        facts,
        doubts,
        shared: shared::doubts(&mut rows),
        diagnostics,
        default_bytes: String::new(),
        rows,
    }
}

impl Section {
    /// Creates a section with rows, but without a heading.
    pub fn plain(rows: Vec<Row>) -> Self {
        Section { rows, ..Section::default() }
    }
}
