//! Modules and submodules that can be plugged in, and the slots for them.

use super::anchor::Names;
use super::area::Section;
use super::entry::{Calls, Known, Rows};
use super::findings::Findings;
use super::process::{self, About, Frame};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::number::{hex16, hex32};
use lexibus_codegen::facts::{self, address};
use lexibus_codegen::ir::{Catalog, Device, Group, GroupKind, IoData, Manual, Module, ObjectBuses, Submodule, TypeDef};

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
    /// The description in other languages.
    pub translations: Vec<(String, String)>,
    pub frames: Vec<Frame>,
    pub sections: Vec<(String, Section)>,
    /// Submodules that belong to it: name and link.
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
pub(super) fn modules(catalog: &Catalog, findings: &Findings) -> Vec<ModuleModel> {
    let mut names = Names::default();
    let anchors: Vec<String> = catalog
        .submodules
        .iter()
        .map(|submodule| names.anchor(&format!("submodule-{:08X}", submodule.ident)))
        .collect();
    let mut all: Vec<ModuleModel> = Vec::new();
    for own in &catalog.modules {
        let parts = own.submodules.iter().filter_map(|used| {
            let at = used.submodule.0 as usize;
            Some((catalog.submodules.get(at)?.name.to_string(), anchors.get(at)?.clone()))
        });
        let anchor = names.anchor(&format!("module-{:08X}", own.number));
        all.push(module(own, anchor, parts.collect(), findings));
    }
    all.extend(catalog.submodules.iter().zip(anchors).map(|(own, anchor)| submodule(catalog, own, anchor, findings)));
    all
}

/// The items of a module; their addresses begin with that of the module.
fn sections<'g>(
    groups: impl Iterator<Item = &'g Group>,
    types: &[TypeDef],
    anchor: &str,
    findings: &Findings,
) -> Vec<(String, Section)> {
    let (manual, calls, mut names) = (Manual::default(), Calls::default(), Names::within(anchor));
    let known = Known { manual: &manual, doubts: &[], modbus: &[], calls: &calls, findings };
    let mut rows = Rows { types, known, names: &mut names, shown: Vec::new() };
    groups.map(|group| section(group, &mut rows)).collect()
}

fn module(own: &Module, anchor: String, parts: Vec<(String, String)>, findings: &Findings) -> ModuleModel {
    let mut facts = PLAIN.description(own.documentation.as_deref());
    let order = &own.identity.order_code;
    facts.extend((!order.is_empty()).then(|| format!("Order code {order}.")));
    ModuleModel {
        number: hex32(own.number),
        name: own.name.to_string(),
        names: words::names(&own.names),
        facts,
        translations: words::translations(own.documentation.as_deref()),
        frames: process::frames(
            &own.process_data,
            &own.types,
            About { buses: ObjectBuses::COE, manual: &Manual::default(), doubts: &[] },
        ),
        sections: sections(own.fixed_objects.iter().chain(&own.groups), &own.types, &anchor, findings),
        parts,
        anchor,
    }
}

fn submodule(catalog: &Catalog, own: &Submodule, anchor: String, findings: &Findings) -> ModuleModel {
    let mut facts = PLAIN.description(own.documentation.as_deref());
    facts.extend((own.api != 0).then(|| format!("API {}.", hex16(own.api))));
    facts.extend(own.f_parameters.is_some().then(|| "With parameters of functional safety (PROFIsafe).".to_owned()));
    let image = |data: &IoData, title: &str| process::image(&data.image, &catalog.types, "", title);
    let inputs = own.input.as_deref().map(|data| image(data, "Inputs of the controller"));
    let outputs = own.output.as_deref().map(|data| image(data, "Outputs of the controller"));
    ModuleModel {
        number: hex32(own.ident),
        name: own.name.to_string(),
        names: words::names(&own.names),
        facts,
        translations: words::translations(own.documentation.as_deref()),
        frames: inputs.into_iter().chain(outputs).collect(),
        sections: sections(own.records.iter(), &catalog.types, &anchor, findings),
        parts: Vec::new(),
        anchor,
    }
}

fn section(group: &Group, rows: &mut Rows<'_>) -> (String, Section) {
    let place = match &group.kind {
        GroupKind::Record(record) => format!("Record {}", hex16(record.index)),
        GroupKind::Object { index, .. } => format!("Object {}", hex16(*index)),
        _ => String::new(),
    };
    let parts = [place.as_str(), group.name.as_str()].into_iter().filter(|part| !part.is_empty());
    let title = parts.collect::<Vec<_>>().join(": ");
    let number = |item: &lexibus_codegen::ir::Item| {
        address::addresses(item, &[]).first().map_or_else(String::new, |own| own.number.clone())
    };
    let items = group.items_at(0).map(|(id, item)| rows.row(id, item, number(item), false)).collect();
    (title, Section::plain(items))
}

pub(super) fn slots(device: &Device) -> Vec<Slot> {
    let row = |slot: &lexibus_codegen::ir::Slot| {
        let fits: Vec<String> = slot.fits.iter().map(facts::device::fit).collect();
        Slot {
            number: slot.number.to_string(),
            name: slot.name.to_string(),
            fits: if fits.is_empty() { "any module".to_owned() } else { fits.join(", ") },
        }
    };
    device.slots.iter().map(row).collect()
}
