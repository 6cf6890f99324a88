//! Modules and submodules that can be plugged in, and the slots for them.

use super::anchor::Names;
use super::area::Section;
use super::entry::{Calls, Rows};
use super::process::{self, Frame};
use super::words::{self, PLAIN};
use crate::backend::words::Manual;
use crate::ir::{Catalog, Device, Fit, Group, GroupKind, IoData, Module, Submodule};

/// So many modules are on a page.
pub(super) const PAGE: usize = 100;

/// A module or submodule.
#[derive(Debug)]
pub(super) struct ModuleModel {
    pub anchor: String,
    pub number: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: Vec<String>,
    pub frames: Vec<Frame>,
    pub sections: Vec<(String, Section)>,
    /// Further modules that belong to it: name and address.
    pub parts: Vec<(String, String)>,
}

/// A slot of a device.
#[derive(Debug)]
pub(super) struct Slot {
    pub number: String,
    pub name: String,
    pub fits: String,
}

/// All modules of a catalogue, and then its submodules.
pub(super) fn modules(catalog: &Catalog, names: &mut Names) -> Vec<ModuleModel> {
    let submodule = |own: &Submodule| format!("submodule-{:08X}", own.ident);
    let mut all: Vec<ModuleModel> = Vec::new();
    for own in &catalog.modules {
        let parts = own.submodules.iter().filter_map(|used| {
            let own = catalog.submodules.get(used.submodule.0 as usize)?;
            Some((own.name.to_string(), submodule(own)))
        });
        let parts = parts.collect();
        all.push(module(own, parts, names));
    }
    let anchors: Vec<String> = catalog.submodules.iter().map(submodule).collect();
    all.extend(
        catalog.submodules.iter().zip(anchors).map(|(own, anchor)| self::submodule(catalog, own, &anchor, names)),
    );
    all
}

fn module(own: &Module, parts: Vec<(String, String)>, names: &mut Names) -> ModuleModel {
    let mut facts = PLAIN.description(own.documentation.as_deref());
    let order = &own.identity.order_code;
    facts.extend((!order.is_empty()).then(|| format!("Order code {order}.")));
    let mut sections = Vec::new();
    let (manual, calls) = (Manual::default(), Calls::default());
    for group in own.fixed_objects.iter().chain(&own.groups) {
        let mut anchors = Names::default();
        let mut rows =
            Rows { types: &own.types, manual: &manual, names: &mut anchors, calls: &calls, shown: Vec::new() };
        sections.push(section(group, &mut rows));
    }
    let number = format!("0x{:08X}", own.number);
    ModuleModel {
        anchor: names.anchor(&format!("module-{:08X}", own.number)),
        number,
        name: own.name.to_string(),
        names: words::names(&own.names),
        facts,
        frames: process::frames(&own.process_data, &own.types),
        sections: without_anchors(sections),
        parts,
    }
}

fn submodule(catalog: &Catalog, own: &Submodule, anchor: &str, names: &mut Names) -> ModuleModel {
    let mut facts = PLAIN.description(own.documentation.as_deref());
    facts.extend((own.api != 0).then(|| format!("API 0x{:04X}.", own.api)));
    facts.extend(own.f_parameters.is_some().then(|| "With parameters of functional safety (PROFIsafe).".to_owned()));
    let (manual, calls) = (Manual::default(), Calls::default());
    let mut anchors = Names::default();
    let mut rows =
        Rows { types: &catalog.types, manual: &manual, names: &mut anchors, calls: &calls, shown: Vec::new() };
    let sections = own.records.iter().map(|group| section(group, &mut rows)).collect();
    let image = |data: &IoData, title: &str| process::image(&data.image, &catalog.types, "", title);
    let inputs = own.input.as_deref().map(|data| image(data, "Inputs of the controller"));
    let outputs = own.output.as_deref().map(|data| image(data, "Outputs of the controller"));
    ModuleModel {
        anchor: names.anchor(anchor),
        number: format!("0x{:08X}", own.ident),
        name: own.name.to_string(),
        names: words::names(&own.names),
        facts,
        frames: inputs.into_iter().chain(outputs).collect(),
        sections: without_anchors(sections),
        parts: Vec::new(),
    }
}

fn section(group: &Group, rows: &mut Rows<'_>) -> (String, Section) {
    let title = match &group.kind {
        GroupKind::Record(record) => format!("Record 0x{:04X}: {}", record.index, group.name),
        GroupKind::Object { index, .. } => format!("Object 0x{index:04X}: {}", group.name),
        _ => group.name.to_string(),
    };
    let number =
        |item: &crate::ir::Item| words::addresses(item).first().map_or_else(String::new, |own| own.place.clone());
    let items = group.items.iter().map(|item| rows.row(item, number(item), false)).collect();
    (title, Section::plain(items))
}

/// Rows of modules are found by their module: on a page of many, addresses of their own would be given twice.
fn without_anchors(sections: Vec<(String, Section)>) -> Vec<(String, Section)> {
    let strip = |(title, mut section): (String, Section)| {
        for row in &mut section.rows {
            row.anchor.clear();
            row.same_as = None;
        }
        (title, section)
    };
    sections.into_iter().map(strip).collect()
}

pub(super) fn slots(device: &Device) -> Vec<Slot> {
    let fit = |own: &Fit| match own {
        Fit::Ident(ident) => format!("module 0x{ident:08X}"),
        Fit::Class(class) => format!("modules of the class {class}"),
        Fit::Name(name) => name.to_string(),
    };
    let slot = |own: &crate::ir::Slot| {
        let fits: Vec<String> = own.fits.iter().map(fit).collect();
        Slot {
            number: own.number.to_string(),
            name: own.name.to_string(),
            fits: if fits.is_empty() { "any module".to_owned() } else { fits.join(", ") },
        }
    };
    device.slots.iter().map(slot).collect()
}
