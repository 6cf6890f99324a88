//! Generates the Rust code for the devices and modules of a file.

use super::code::Code;
use super::definitions::Definitions;
use super::device_names::module_name;
use super::ethercat::ModulePaths;
use super::model::Model;
use super::options::RustOptions;
use super::{docs, print, profiles};
use crate::collections::{HashMap, HashSet};
use crate::ir::{Catalog, Device, FileInfo, Module, ModuleId};
use crate::names::{self, Case, NameRequest};

/// Names that the Rust module of a device or module must not have: keywords, and names that the generated code uses.
const RESERVED: [&str; 18] = [
    "self",
    "super",
    "crate",
    "modules",
    "rt",
    "types",
    "codes",
    "procedures",
    "windows",
    "objects",
    "remappable",
    "mappable",
    "pdo",
    "messages",
    "machine",
    "models",
    "view",
    "image",
];

/// Adds the devices and modules of `catalog` to `code`. Returns false if there are none.
pub(super) fn emit(catalog: &Catalog, file: &FileInfo, options: &RustOptions, mut code: Code<'_>) -> bool {
    let (modules, names) = named_modules(catalog);
    match catalog.devices.as_slice() {
        [] if modules.is_empty() => return false,
        [] => {}
        [device] => {
            let paths = paths(&modules, &names, "modules");
            print::model(&mut code, profiles::shared(Model::new(device, file, options, &paths)));
        }
        devices => {
            let paths = paths(&modules, &names, "super::modules");
            let mut definitions = Definitions::new(&options.runtime);
            for (device, name) in devices.iter().zip(device_names(devices, file)) {
                let mut model = profiles::shared(Model::new(device, file, options, &paths));
                definitions.share(&mut model, &name);
                code.module(&title(&device.name, &name), &name, |code| print::model(code, model));
            }
        }
    }
    if !modules.is_empty() {
        let heading = "Modules that can be plugged in. Slot-dependent indices are given for slot 0.";
        code.module(heading, "modules", |code| {
            let mut definitions = Definitions::new(&options.runtime);
            for ((_, module), name) in modules.iter().zip(&names) {
                let mut model = profiles::shared(Model::of_module(module, options));
                definitions.share(&mut model, name);
                code.module(&title(&module.name, name), name, |code| print::model(code, model));
            }
        });
    }
    code.finish();
    true
}

/// Returns the modules for which code is generated, and the names of their Rust modules.
pub(super) fn named_modules(catalog: &Catalog) -> (Vec<(ModuleId, &Module)>, Vec<String>) {
    let modules = reachable(catalog);
    let names = module_names(&modules);
    (modules, names)
}

/// Returns the modules that can be plugged into an EtherCAT device, or all modules if the file has no device.
fn reachable(catalog: &Catalog) -> Vec<(ModuleId, &Module)> {
    let all = catalog.modules.iter().zip(0..).map(|(module, position)| (ModuleId(position), module));
    if catalog.devices.is_empty() {
        return all.collect();
    }
    let pluggable: HashSet<ModuleId> = catalog
        .devices
        .iter()
        .filter(|device| device.ethercat.is_some())
        .flat_map(|device| device.modules.iter().map(|usage| usage.module))
        .collect();
    all.filter(|(id, _)| pluggable.contains(id)).collect()
}

fn module_names(modules: &[(ModuleId, &Module)]) -> Vec<String> {
    let mut same_number: HashMap<u32, usize> = HashMap::default();
    for (_, module) in modules {
        *same_number.entry(module.number).or_default() += 1;
    }
    let name_requests = modules.iter().map(|(id, module)| {
        let name = if module.id.is_empty() { &module.name } else { &module.id };
        let position = if same_number[&module.number] > 1 { format!("_{}", id.0) } else { String::new() };
        NameRequest::new(name, "module", format!("{:08X}{position}", module.number))
    });
    escaped(names::unique(name_requests, &RESERVED, Case::Snake))
}

/// Returns unique names of the devices. The names are based on order codes if possible, because order codes are shorter
/// than names. An ambiguous name gets the revision number as a suffix. If several devices have the same name and
/// revision number, the suffix begins with the product code. If an earlier device has the same product code and
/// revision number, the suffix ends with the position of the device.
fn device_names(devices: &[Device], file: &FileInfo) -> Vec<String> {
    let names: Vec<String> = devices.iter().map(|device| module_name(device, file)).collect();
    let mut seen = HashSet::default();
    let mut same_revision: HashMap<(&str, Option<u32>), usize> = HashMap::default();
    for (device, name) in devices.iter().zip(&names) {
        *same_revision.entry((name, device.identity.revision_number)).or_default() += 1;
    }
    let name_requests = devices.iter().zip(&names).enumerate().map(|(position, (device, name))| {
        let identity = &device.identity;
        let twice = !seen.insert((identity.product_code, identity.revision_number));
        let position_suffix = if twice { format!("_{position}") } else { String::new() };
        let revision = identity.revision_number.unwrap_or(0);
        let is_one_of_several = same_revision[&(name.as_str(), identity.revision_number)] > 1;
        let product =
            if is_one_of_several { format!("{:08X}_", identity.product_code.unwrap_or(0)) } else { String::new() };
        NameRequest::new(name, "device", format!("{product}{revision:08X}{position_suffix}"))
    });
    escaped(names::unique(name_requests, &RESERVED, Case::Snake))
}

fn escaped(names: Vec<String>) -> Vec<String> {
    names.iter().map(|name| names::escaped(name)).collect()
}

fn paths(modules: &[(ModuleId, &Module)], names: &[String], outer: &str) -> ModulePaths {
    modules.iter().zip(names).map(|((id, _), name)| (*id, format!("{outer}::{name}::MODULE"))).collect()
}

/// Returns the title of a device or module as a sentence. The title is the name in the description, or the Rust name
/// `name` if the description contains no name.
fn title(original: &str, name: &str) -> String {
    let title = docs::escape(original);
    docs::sentence(if title.is_empty() { name } else { &title })
}
