//! Slots and subslots of a device on its overview: the modules that they accept or contain, and the records of an access point.

use std::collections::{BTreeMap, HashMap};

use super::link::{Link, Relation};
use super::modules::Modules;
use lexibus_codegen::facts::{self, profinet};
use lexibus_codegen::ir::{Catalog, Device, Fit, GroupKind, Numbers, Slot, SlotNumbers, Submodule, SubmoduleKind};
use lexibus_codegen::number::{hex16, ranges};

/// Maximum number of modules that one overview links to. The pages of the modules list all modules.
const MOST_LINKS: usize = 1000;

/// Number of modules above which a list is folded.
const FOLDED: usize = 12;

/// Maximum number of slot names in one row.
const MOST_NAMES: usize = 4;

/// Slots with the same modules.
#[derive(Debug)]
pub(super) struct SlotRow {
    pub numbers: String,
    pub name: String,
    /// Links to the modules. The title of the relation is the assignment, such as `fixed`.
    pub modules: Relation,
    /// Text in place of the links, if the description does not contain the modules.
    pub note: String,
}

impl SlotRow {
    /// Returns the number of modules.
    pub fn count(&self) -> usize {
        self.modules.links.len() + self.modules.others
    }

    /// Returns whether the list of modules is long, so that pages fold it.
    pub fn is_long(&self) -> bool {
        self.count() > FOLDED
    }
}

/// A record of an access point.
#[derive(Debug)]
pub(super) struct RecordRow {
    pub number: String,
    pub name: String,
    pub length: String,
    /// The submodule that has the record. `None` for a block of the connect request.
    pub submodule: Option<Link>,
}

/// The slots of a device, and of an access point also its subslots and records.
#[derive(Debug, Default)]
pub(super) struct Slots {
    pub slots: Vec<SlotRow>,
    pub subslots: Vec<SlotRow>,
    pub records: Vec<RecordRow>,
}

/// Links from a page of a device to the modules.
#[derive(Clone, Copy)]
pub(super) struct ModuleLinks<'m> {
    pub modules: &'m Modules,
    /// Relative path to the folder of the modules.
    pub path: &'m str,
}

impl ModuleLinks<'_> {
    fn link(&self, at: usize) -> Option<Link> {
        let (title, target) = self.modules.target(at)?;
        Some(Link { title: title.to_owned(), target: format!("{}{target}", self.path) })
    }
}

/// How modules are assigned to slots. Rows with the same slots have the order of the variants.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Assignment {
    Fixed,
    Preset,
    Possible,
}

impl Assignment {
    fn name(self) -> &'static str {
        match self {
            Assignment::Fixed => "fixed",
            Assignment::Preset => "preset",
            Assignment::Possible => "possible",
        }
    }
}

/// Groups of modules that have the same slots and the same assignment. The key contains the slots as ranges, as in
/// [`Numbers`]. The value contains the positions of the modules.
type Assigned = BTreeMap<(Vec<(u16, u16)>, Assignment), Vec<usize>>;

/// Adds the module at position `at` in the list of all modules. A module without stated slots can be in any slot.
fn assign(assigned: &mut Assigned, at: usize, places: &SlotNumbers) {
    let is_anywhere = places.allowed.is_empty() && places.fixed.is_empty() && places.used.is_empty();
    let all = [
        (&places.fixed, Assignment::Fixed),
        (&places.used, Assignment::Preset),
        (&places.allowed, Assignment::Possible),
    ];
    for (numbers, assignment) in all {
        if !numbers.is_empty() || (is_anywhere && assignment == Assignment::Possible) {
            assigned.entry((numbers.0.to_vec(), assignment)).or_default().push(at);
        }
    }
}

/// The names of slots or subslots, and the format of their numbers.
struct Named<'d> {
    names: BTreeMap<u16, &'d str>,
    number: fn(u16) -> String,
}

/// Returns one row for each group of modules.
fn rows(assigned: &Assigned, named: &Named<'_>, links: ModuleLinks<'_>, left: &mut usize) -> Vec<SlotRow> {
    let mut rows = Vec::new();
    for ((slots, assignment), modules) in assigned {
        let numbers = Numbers(slots.iter().copied().collect());
        let shown: Vec<Link> = modules.iter().take(*left).filter_map(|at| links.link(*at)).collect();
        *left -= shown.len();
        let others = modules.len() - shown.len();
        rows.push(SlotRow {
            numbers: if numbers.is_empty() { "any".to_owned() } else { ranges(&numbers.0, named.number) },
            name: names_of(&numbers, &named.names),
            modules: Relation { title: assignment.name(), links: shown, others },
            note: String::new(),
        });
    }
    rows
}

/// Returns the names of slots without repetitions. An ellipsis replaces the names after the first [`MOST_NAMES`].
fn names_of(numbers: &Numbers, names: &BTreeMap<u16, &str>) -> String {
    let mut shown: Vec<&str> = Vec::new();
    for &(first, last) in numbers.0.iter().filter(|(first, last)| first <= last) {
        for (_, name) in names.range(first..=last) {
            if shown.len() > MOST_NAMES {
                break;
            }
            if !shown.contains(name) {
                shown.push(name);
            }
        }
    }
    if shown.len() > MOST_NAMES {
        shown[MOST_NAMES] = "…";
    }
    shown.join(", ")
}

/// Returns the slots of a device with their modules, its subslots with their submodules, and its records.
pub(super) fn slots(catalog: &Catalog, device: &Device, links: ModuleLinks<'_>) -> Slots {
    let mut left = MOST_LINKS;
    let mut assigned = Assigned::new();
    device.modules.iter().for_each(|used| assign(&mut assigned, used.module.0 as usize, &used.places));
    preset(catalog, device, &mut assigned);
    let names = device.slots.iter().map(|slot| (slot.number, slot.name.as_str())).collect();
    let mut slots = rows(&assigned, &Named { names, number: profinet::slot }, links, &mut left);
    slots.extend(empty(device, &assigned));
    let mut assigned = Assigned::new();
    for used in &device.submodules {
        assign(&mut assigned, catalog.modules.len() + used.submodule.0 as usize, &used.places);
    }
    let of_subslots = device.profinet.iter().flat_map(|settings| &settings.subslot_names);
    let names = of_subslots.map(|subslot| (subslot.number, subslot.name.as_str())).collect();
    let subslots = rows(&assigned, &Named { names, number: profinet::subslot }, links, &mut left);
    Slots { slots, subslots, records: records(catalog, device, links) }
}

/// Returns the number of the last slot that `slot` describes.
fn last(slot: &Slot) -> u16 {
    slot.number.saturating_add(slot.instances.1.max(1) - 1)
}

/// Adds the modules that slots contain by default.
fn preset(catalog: &Catalog, device: &Device, assigned: &mut Assigned) {
    let mut positions: HashMap<u32, usize> = HashMap::new();
    for used in &device.modules {
        let at = used.module.0 as usize;
        positions.extend(catalog.modules.get(at).map(|module| (module.number, at)));
    }
    for slot in &device.slots {
        let Some(Fit::Ident(ident)) = &slot.default else { continue };
        if let Some(at) = positions.get(ident) {
            let used = Numbers([(slot.number, last(slot))].into_iter().collect());
            assign(assigned, *at, &SlotNumbers { used, ..SlotNumbers::default() });
        }
    }
}

/// Returns one row for each slot to which no known module is assigned.
fn empty(device: &Device, assigned: &Assigned) -> Vec<SlotRow> {
    let mut is_assigned = vec![assigned.keys().any(|(slots, _)| slots.is_empty()); usize::from(u16::MAX) + 1];
    for &(first, last) in assigned.keys().flat_map(|(slots, _)| slots).filter(|(first, last)| first <= last) {
        is_assigned[usize::from(first)..=usize::from(last)].fill(true);
    }
    let row = |slot: &Slot| SlotRow {
        numbers: ranges(&[(slot.number, last(slot))], profinet::slot),
        name: slot.name.to_string(),
        modules: Relation { title: "", links: Vec::new(), others: 0 },
        note: match (device.profinet.is_some(), slot.fits.is_empty()) {
            (true, _) => String::new(),
            (false, true) => "any module".to_owned(),
            (false, false) => slot.fits.iter().map(facts::device::fit).collect::<Vec<_>>().join(", "),
        },
    };
    device.slots.iter().filter(|slot| !is_assigned[usize::from(slot.number)]).map(row).collect()
}

/// Returns the records of the submodules that an access point contains, and the vendor's blocks of its connect request.
fn records(catalog: &Catalog, device: &Device, links: ModuleLinks<'_>) -> Vec<RecordRow> {
    let bytes = |length: u32| format!("{length} bytes");
    let mut rows = Vec::new();
    for used in &device.submodules {
        let at = used.submodule.0 as usize;
        let Some(submodule) = catalog.submodules.get(at) else { continue };
        if submodule.kind == SubmoduleKind::Pluggable {
            continue;
        }
        let link = links.link(catalog.modules.len() + at);
        rows.extend(records_of(submodule).map(|(index, name, length)| RecordRow {
            number: hex16(index),
            name: name.to_owned(),
            length: length.map(bytes).unwrap_or_default(),
            submodule: link.clone(),
        }));
    }
    for block in device.profinet.iter().flat_map(|settings| &settings.vendor_blocks) {
        let length = match &block.record.kind {
            GroupKind::Record(record) => bytes(record.length),
            _ => String::new(),
        };
        let name = format!("Block of the connect request, API {}", hex16(block.api));
        rows.push(RecordRow { number: hex16(block.identifier), name, length, submodule: None });
    }
    rows
}

/// Returns index, name and length of each record of a submodule.
fn records_of(submodule: &Submodule) -> impl Iterator<Item = (u16, &str, Option<u32>)> {
    let records = submodule.records.iter().filter_map(|group| match &group.kind {
        GroupKind::Record(record) => Some((record.index, group.name.as_str(), Some(record.length))),
        _ => None,
    });
    let safety = submodule.f_parameters.as_deref().map(|parameters| (parameters.index, "F-parameters", None));
    records.chain(safety)
}
