//! Selects devices, modules and objects: removes the elements that the filters of a [`Selection`] do not match.

use std::collections::BTreeSet;

use super::removal;
use crate::collections::{HashMap, HashSet};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Catalog, Group, Module, ProcessData, Submodule};
use crate::selection::{device_names, module_names, submodule_names, Filter, ObjectFilter, Selection};
use crate::source::{FileId, Span};
use crate::text::edit_distance;

/// Keeps the latest revision of each product. Devices without a product code belong to the same product if they have the same
/// name.
fn keep_latest(catalog: &Catalog, found: &mut Vec<usize>) {
    let product = |at: usize| {
        let device = &catalog.devices[at];
        let name = if device.identity.product_code.is_some() { "" } else { device.name.as_str() };
        (device.identity.product_code, name)
    };
    let mut latest: HashMap<_, Option<u32>> = HashMap::default();
    for &at in &*found {
        let highest = latest.entry(product(at)).or_default();
        *highest = (*highest).max(catalog.devices[at].identity.revision_number);
    }
    found.retain(|&at| latest.get(&product(at)) == Some(&catalog.devices[at].identity.revision_number));
}

/// Removes modules that no device accepts, and submodules that neither a device nor a module accepts.
fn drop_unreached(catalog: &mut Catalog) {
    let Catalog { devices, modules, submodules, .. } = catalog;
    let reached = devices.iter().flat_map(|device| &device.modules).map(|used| used.module.0);
    let positions = keep_reached(modules, reached.collect());
    for used in devices.iter_mut().flat_map(|device| &mut device.modules) {
        used.module.0 = positions.get(used.module.0 as usize).copied().unwrap_or(u32::MAX);
    }
    let of_devices = devices.iter().flat_map(|device| &device.submodules);
    let reached = of_devices.chain(modules.iter().flat_map(|module| &module.submodules)).map(|used| used.submodule.0);
    let positions = keep_reached(submodules, reached.collect());
    let of_devices = devices.iter_mut().flat_map(|device| &mut device.submodules);
    for used in of_devices.chain(modules.iter_mut().flat_map(|module| &mut module.submodules)) {
        used.submodule.0 = positions.get(used.submodule.0 as usize).copied().unwrap_or(u32::MAX);
    }
}

/// Keeps the elements at the positions in `reached`. Returns the new position of each element; the positions of removed elements
/// have no meaning.
fn keep_reached<T>(list: &mut Vec<T>, reached: HashSet<u32>) -> Vec<u32> {
    let is_kept = |at: u32| reached.contains(&at);
    let mut kept = 0;
    let mut positions = Vec::with_capacity(list.len());
    for at in (0..).take(list.len()) {
        positions.push(kept);
        kept += u32::from(is_kept(at));
    }
    let mut at = 0..;
    list.retain(|_| at.next().is_some_and(is_kept));
    positions
}

/// Removes devices, modules and submodules that are not selected.
pub(super) fn devices_and_modules(selection: &Selection, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    if !selection.devices.is_empty() {
        keep_devices(selection, catalog, diagnostics);
    }
    if !selection.modules.is_empty() {
        keep_modules(selection, catalog, diagnostics);
    }
    let is_limited = !selection.devices.is_empty() || !selection.modules.is_empty();
    // In a file without devices, no device refers to modules, so unreferenced modules must be kept.
    if is_limited && !catalog.devices.is_empty() {
        drop_unreached(catalog);
    }
}

/// Removes objects that are not selected, and reports filters that match no object.
///
/// This step follows the checks. They judge the whole description: without the removed objects, PDOs, conditions and procedures would
/// refer to missing objects.
pub fn select_objects(selection: &Selection, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    if selection.objects.is_empty() {
        return;
    }
    let existing = indices(catalog);
    let is_missing = |filter: &&ObjectFilter| existing.range(filter.first..=filter.last).next().is_none();
    for filter in selection.objects.iter().filter(is_missing) {
        let message = format!("there is no object `{filter}` in the file");
        let found = codes::NOTHING_SELECTED.at(Span::new(FileId(0), 0, 0), message);
        diagnostics.push(found.help(nearest(&existing, *filter)));
    }
    let wanted = |index: u16| selection.has_object(index);
    let is_kept = |group: &Group| group.index().is_none_or(wanted);
    catalog.devices.iter_mut().for_each(|device| removal::of_device(device, is_kept));
    catalog.modules.iter_mut().for_each(|module| removal::of_module(module, is_kept));
    if selection.pdos {
        for device in &mut catalog.devices {
            device.process_data.pdos.retain(|pdo| wanted(pdo.mapping_index));
        }
    }
}

fn keep_devices(selection: &Selection, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    let mut wanted = vec![false; catalog.devices.len()];
    for filter in &selection.devices {
        let mut found: Vec<usize> = Vec::new();
        found.extend((0..wanted.len()).filter(|&at| filter.matches(&catalog.devices[at])));
        if filter.is_latest() {
            keep_latest(catalog, &mut found);
        }
        if found.is_empty() {
            let names = catalog.devices.iter().flat_map(device_names);
            diagnostics.push(nothing("device", &filter.to_string(), filter.device(), names));
        }
        found.iter().for_each(|&at| wanted[at] = true);
    }
    let mut at = wanted.into_iter();
    catalog.devices.retain(|_| at.next().unwrap_or(false));
}

fn keep_modules(selection: &Selection, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    let matches = |number, names: &[&str]| selection.modules.iter().any(|filter| filter.matches(Some(number), names));
    let module = |module: &Module| matches(module.number, &module_names(module));
    let submodule = |submodule: &Submodule| matches(submodule.ident, &submodule_names(submodule));
    let wanted_modules: Vec<bool> = catalog.modules.iter().map(module).collect();
    let wanted_submodules: Vec<bool> = catalog.submodules.iter().map(submodule).collect();
    for filter in &selection.modules {
        let found = catalog.modules.iter().any(|one| filter.matches(Some(one.number), &module_names(one)))
            || catalog.submodules.iter().any(|one| filter.matches(Some(one.ident), &submodule_names(one)));
        if !found {
            let names = catalog.modules.iter().flat_map(module_names);
            let names = names.chain(catalog.submodules.iter().flat_map(submodule_names));
            diagnostics.push(nothing("module", &filter.to_string(), filter, names));
        }
    }
    let is = |list: &[bool], at: u32| list.get(at as usize).copied().unwrap_or(false);
    for device in &mut catalog.devices {
        device.modules.retain(|used| !used.places.fixed.is_empty() || is(&wanted_modules, used.module.0));
        device.submodules.retain(|used| !used.places.fixed.is_empty() || is(&wanted_submodules, used.submodule.0));
    }
    if catalog.devices.is_empty() {
        // In a file without devices, no references are removed, so the unselected modules themselves are removed.
        let mut at = wanted_modules.into_iter();
        catalog.modules.retain(|_| at.next().unwrap_or(false));
    }
}

/// Returns the indices of all objects, registers with an object address, and mapping objects of PDOs, without fixed objects of
/// modules.
fn indices(catalog: &Catalog) -> BTreeSet<u16> {
    let Catalog { devices, modules, .. } = catalog;
    let parts = devices.iter().map(|device| (&device.groups, &device.process_data));
    let parts = parts.chain(modules.iter().map(|module| (&module.groups, &module.process_data)));
    let of_part = |(groups, data): (&[Group], &ProcessData)| {
        let mappings = data.pdos.iter().map(|pdo| pdo.mapping_index);
        let items = groups.iter().flat_map(|group| &group.items).filter_map(|item| Some(item.object()?.0));
        groups.iter().filter_map(Group::index).chain(items).chain(mappings).collect::<BTreeSet<u16>>()
    };
    parts.flat_map(|(groups, data)| of_part((groups, data))).collect()
}

/// Returns the help text for a range that contains no objects. The text names the nearest existing objects.
fn nearest(existing: &BTreeSet<u16>, filter: ObjectFilter) -> String {
    let below = existing.range(..filter.first).next_back().map(|&last| {
        let first = (0..=last).rev().take_while(|index| existing.contains(index)).last().unwrap_or(last);
        ObjectFilter { first, last }
    });
    let above = existing.range(filter.last..).next().map(|&first| {
        let last = (first..=u16::MAX).take_while(|index| existing.contains(index)).last().unwrap_or(first);
        ObjectFilter { first, last }
    });
    match (below, above) {
        (Some(below), Some(above)) => format!("the nearest objects are {below} and {above}"),
        (Some(only), None) | (None, Some(only)) => format!("the nearest object or range of objects is {only}"),
        (None, None) => "the file has no objects".to_owned(),
    }
}

/// Creates the diagnostic for a filter without a match, with the most similar name.
fn nothing<'n>(what: &str, wanted: &str, filter: &Filter, names: impl Iterator<Item = &'n str>) -> Diagnostic {
    let message = format!("there is no {what} `{wanted}` in the file");
    let diagnostic = codes::NOTHING_SELECTED.at(Span::new(FileId(0), 0, 0), message);
    let names = names.filter(|name| !name.is_empty());
    let similar = names.min_by_key(|name| edit_distance(filter.text(), &name.to_lowercase()));
    match similar {
        Some(name) => diagnostic.help(format!("write `{name}`, or use `lexibus info` to list all {what}s")),
        None => diagnostic.help(format!("use `lexibus info` to list all {what}s")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Device, ModuleId, ModuleUse, SlotNumbers, SubmoduleId, SubmoduleUse};

    fn device(name: &str, order_code: &str, product: u32, revision: u32) -> Device {
        let mut device = Device { name: name.into(), ..Device::default() };
        device.identity.order_code = order_code.into();
        device.identity.product_code = Some(product);
        device.identity.revision_number = Some(revision);
        device
    }

    fn selected(filters: &[&str]) -> (Vec<u32>, usize) {
        let devices = vec![
            device("Four inputs", "IN-4", 0x10, 1),
            device("Four inputs", "IN-4", 0x10, 3),
            device("Four inputs", "IN-4", 0x10, 2),
            device("Eight outputs", "OUT-8", 0x20, 1),
        ];
        let mut catalog = Catalog { devices, ..Catalog::default() };
        let devices = filters.iter().map(|text| text.parse().unwrap()).collect();
        let mut diagnostics = Diagnostics::default();
        let selection = Selection { devices, ..Selection::default() };
        devices_and_modules(&selection, &mut catalog, &mut diagnostics);
        let key = |device: &Device| {
            device.identity.product_code.unwrap() * 16 + device.identity.revision_number.unwrap_or_default()
        };
        (catalog.devices.iter().map(key).collect(), diagnostics.list().len())
    }

    #[test]
    fn modules_of_removed_devices_are_removed() {
        let used = |module| ModuleUse { module: ModuleId(module), places: SlotNumbers::default() };
        let part = |submodule| SubmoduleUse { submodule: SubmoduleId(submodule), places: SlotNumbers::default() };
        let module = |name: &str, parts: &[u32]| Module {
            name: name.into(),
            submodules: parts.iter().map(|&at| part(at)).collect(),
            ..Module::default()
        };
        let submodule = |name: &str| Submodule { name: name.into(), ..Submodule::default() };
        let mut one = device("One", "", 1, 1);
        (one.modules, one.submodules) = (vec![used(2), used(1)], vec![part(3)]);
        let mut other = device("Other", "", 2, 1);
        (other.modules, other.submodules) = (vec![used(0), used(1)], vec![part(0)]);
        let mut catalog = Catalog {
            devices: vec![other, one],
            modules: vec![module("a", &[1]), module("b", &[2, 3]), module("c", &[]), module("d", &[4])],
            submodules: ["p", "q", "r", "s", "t"].map(submodule).into(),
            ..Catalog::default()
        };
        let devices = vec!["One".parse().unwrap()];
        let mut diagnostics = Diagnostics::default();
        let selection = Selection { devices, ..Selection::default() };
        devices_and_modules(&selection, &mut catalog, &mut diagnostics);
        let names: Vec<&str> = catalog.modules.iter().map(|module| module.name.as_str()).collect();
        assert_eq!(names, ["b", "c"]);
        let names: Vec<&str> = catalog.submodules.iter().map(|submodule| submodule.name.as_str()).collect();
        assert_eq!(names, ["r", "s"]);
        let [device] = &catalog.devices[..] else { panic!("one device") };
        assert_eq!((&device.modules, &device.submodules), (&vec![used(1), used(0)], &vec![part(1)]));
        assert_eq!(catalog.modules[0].submodules, [part(0), part(1)]);
    }

    #[test]
    fn devices_by_name_code_and_revision() {
        assert_eq!(selected(&[]), (vec![0x101, 0x103, 0x102, 0x201], 0));
        assert_eq!(selected(&["in-4"]), (vec![0x101, 0x103, 0x102], 0));
        assert_eq!(selected(&["0x10@2"]), (vec![0x102], 0));
        assert_eq!(selected(&["16@latest"]), (vec![0x103], 0));
        assert_eq!(selected(&["*@latest"]), (vec![0x103, 0x201], 0), "the latest of each product");
        assert_eq!(selected(&["*out*", "IN-4@latest"]), (vec![0x103, 0x201], 0));
        assert_eq!(selected(&["eight outputs"]), (vec![0x201], 0));
        assert_eq!(selected(&["OUT-9", "OUT-8@7", "OUT-8"]), (vec![0x201], 2));
        assert!("@latest".parse::<crate::selection::DeviceFilter>().is_err());
    }
}
