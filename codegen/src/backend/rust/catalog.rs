//! All devices and modules of a file in one Rust module.

use std::collections::{HashMap, HashSet};

use super::code::Code;
use super::definitions::Definitions;
use super::device_names::module_name;
use super::ethercat::ModulePaths;
use super::model::Model;
use super::options::RustOptions;
use super::{docs, header, print};
use crate::ir::{Catalog, Device, FileInfo, Module, ModuleId};
use crate::names::{self, Case, Wish};

/// Names that a device's module can't have: within it are modules of the others.
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

pub(super) fn emit(catalog: &Catalog, file: &FileInfo, options: &RustOptions) -> Option<String> {
    let modules = reachable(catalog);
    let names = module_names(&modules);
    let mut code = Code::new(header(file), &options.runtime);
    match catalog.devices.as_slice() {
        [] if modules.is_empty() => return None,
        [] => {}
        [device] => {
            let paths = paths(&modules, &names, "modules");
            print::model(&mut code, &Model::new(device, file, options, &paths));
        }
        devices => {
            let paths = paths(&modules, &names, "super::modules");
            let mut definitions = Definitions::new(&options.runtime);
            for (device, name) in devices.iter().zip(device_names(devices, file)) {
                let mut model = Model::new(device, file, options, &paths);
                definitions.share(&mut model, &name);
                code.module(&heading(&device.name, &name), &name, |code| print::model(code, &model));
            }
        }
    }
    if !modules.is_empty() {
        let about = "Modules that can be plugged in. Indices that depend on the slot are those of slot 0.";
        code.module(about, "modules", |code| {
            let mut definitions = Definitions::new(&options.runtime);
            for ((_, module), name) in modules.iter().zip(&names) {
                let mut model = Model::of_module(module, options);
                definitions.share(&mut model, name);
                code.module(&heading(&module.name, name), name, |code| print::model(code, &model));
            }
        });
    }
    Some(code.finish())
}

/// The modules that a device takes, or all where there is no device.
fn reachable(catalog: &Catalog) -> Vec<(ModuleId, &Module)> {
    let all = catalog.modules.iter().zip(0..).map(|(module, position)| (ModuleId(position), module));
    if catalog.devices.is_empty() {
        return all.collect();
    }
    let taken: HashSet<ModuleId> = catalog
        .devices
        .iter()
        .filter(|device| device.ethercat.is_some())
        .flat_map(|device| device.modules.iter().map(|own| own.module))
        .collect();
    all.filter(|(id, _)| taken.contains(id)).collect()
}

fn module_names(modules: &[(ModuleId, &Module)]) -> Vec<String> {
    let mut same: HashMap<u32, usize> = HashMap::new();
    for (_, module) in modules {
        *same.entry(module.number).or_default() += 1;
    }
    let wishes: Vec<Wish<'_>> = modules
        .iter()
        .map(|(id, module)| {
            let name = if module.id.is_empty() { &module.name } else { &module.id };
            let place = if same[&module.number] > 1 { format!("_{}", id.0) } else { String::new() };
            Wish::new(name, "module", format!("{:08X}{place}", module.number))
        })
        .collect();
    escaped(names::unique(&wishes, &RESERVED, Case::Snake))
}

/// Devices go by their order code, which is shorter than their name; revisions are told apart by their number.
fn device_names(devices: &[Device], file: &FileInfo) -> Vec<String> {
    let names: Vec<String> = devices.iter().map(|device| module_name(device, file)).collect();
    let mut seen = HashSet::new();
    let mut same: HashMap<(&str, Option<u32>), usize> = HashMap::new();
    for (device, name) in devices.iter().zip(&names) {
        *same.entry((name, device.identity.revision_number)).or_default() += 1;
    }
    let wishes: Vec<Wish<'_>> = devices
        .iter()
        .zip(&names)
        .enumerate()
        .map(|(position, (device, name))| {
            let identity = &device.identity;
            let twice = !seen.insert((identity.product_code, identity.revision_number));
            let place = if twice { format!("_{position}") } else { String::new() };
            let revision = identity.revision_number.unwrap_or(0);
            let is_one_of_several = same[&(name.as_str(), identity.revision_number)] > 1;
            let product =
                if is_one_of_several { format!("{:08X}_", identity.product_code.unwrap_or(0)) } else { String::new() };
            Wish::new(name, "device", format!("{product}{revision:08X}{place}"))
        })
        .collect();
    escaped(names::unique(&wishes, &RESERVED, Case::Snake))
}

fn escaped(names: Vec<String>) -> Vec<String> {
    names.iter().map(|name| names::escaped(name)).collect()
}

fn paths(modules: &[(ModuleId, &Module)], names: &[String], outer: &str) -> ModulePaths {
    modules.iter().zip(names).map(|((id, _), name)| (*id, format!("{outer}::{name}::MODULE"))).collect()
}

/// What a device or module is called in the source, else its name in Rust.
fn heading(original: &str, name: &str) -> String {
    let title = docs::escape(original);
    docs::sentence(if title.is_empty() { name } else { &title })
}
