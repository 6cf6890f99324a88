//! The elements of a file for which code is generated, with their names: device access points, and the modules and
//! submodules that fit into them.

use std::collections::{BTreeMap, BTreeSet};

use super::values::Values;
use crate::backend::rust::RustOptions;
use crate::ir::{Catalog, Device, GroupKind, Module, ProfinetSettings, Submodule, Type};
use crate::names::{self, Case, NameRequest};

/// Reserved names at the top level of the output.
const RESERVED: [&str; 10] =
    ["self", "super", "crate", "rt", "modules", "submodules", "values", "diagnosis", "core", "std"];

/// A device access point and its name.
pub(super) struct AccessPoint<'a> {
    pub device: &'a Device,
    pub settings: &'a ProfinetSettings,
    pub name: String,
}

/// All elements of a file for which code is generated.
pub(super) struct Scope<'a> {
    pub catalog: &'a Catalog,
    pub options: &'a RustOptions,
    pub access_points: Vec<AccessPoint<'a>>,
    /// Modules with their names, keyed by their position in the catalog.
    pub modules: BTreeMap<u32, (&'a Module, String)>,
    /// Submodules with their names, keyed by their position in the catalog.
    pub submodules: BTreeMap<u32, (&'a Submodule, String)>,
    pub values: Values<'a>,
}

impl<'a> Scope<'a> {
    /// Collects the device access points of `catalog`, and all modules and submodules that fit into them.
    pub(super) fn new(catalog: &'a Catalog, options: &'a RustOptions) -> Self {
        let access_points = access_points(catalog);
        let modules = modules(catalog, &access_points);
        let submodules = submodules(catalog, &access_points, &modules);
        let used = types(catalog, &submodules);
        let values = Values::new(&catalog.types, used.into_iter(), options);
        Scope { catalog, options, access_points, modules, submodules, values }
    }

    /// Returns whether the file has a single device access point. The code of a single device access point is at the
    /// top level of the output.
    pub(super) fn is_single(&self) -> bool {
        self.access_points.len() == 1
    }
}

fn access_points(catalog: &Catalog) -> Vec<AccessPoint<'_>> {
    let found: Vec<_> =
        catalog.devices.iter().filter_map(|device| Some((device, device.profinet.as_deref()?))).collect();
    let name_requests = found.iter().enumerate().map(|(at, (device, settings))| NameRequest {
        name: &device.name,
        fallback: format!("dap {:08x}", settings.ident),
        suffix: identifier(&device.id, settings.ident, at),
    });
    let names = names::unique(name_requests, &RESERVED, Case::Snake);
    let all = found.into_iter().zip(names);
    all.map(|((device, settings), name)| AccessPoint { device, settings, name: names::escaped(&name) }).collect()
}

fn modules<'a>(catalog: &'a Catalog, access_points: &[AccessPoint<'a>]) -> BTreeMap<u32, (&'a Module, String)> {
    let uses = access_points.iter().flat_map(|point| &point.device.modules);
    named(&catalog.modules, uses.map(|usage| usage.module.0), "module", |module| {
        (&module.name, &module.id, module.number)
    })
}

fn submodules<'a>(
    catalog: &'a Catalog,
    access_points: &[AccessPoint<'a>],
    modules: &BTreeMap<u32, (&'a Module, String)>,
) -> BTreeMap<u32, (&'a Submodule, String)> {
    let built_in = access_points.iter().flat_map(|point| &point.device.submodules);
    let uses = built_in.chain(modules.values().flat_map(|(module, _)| &module.submodules));
    named(&catalog.submodules, uses.map(|usage| usage.submodule.0), "submodule", |submodule| {
        (&submodule.name, &submodule.id, submodule.ident)
    })
}

/// Returns the elements at these positions with their Rust names, keyed by position. `identity` returns the name, ID and
/// ident number of an element.
fn named<'a, T>(
    all: &'a [T],
    positions: impl Iterator<Item = u32>,
    kind: &str,
    identity: impl Fn(&'a T) -> (&'a str, &'a str, u32),
) -> BTreeMap<u32, (&'a T, String)> {
    let positions: BTreeSet<u32> = positions.collect();
    let found = positions.iter().filter_map(|at| Some((*at, all.get(*at as usize)?)));
    let name_requests = found.clone().map(|(at, element)| {
        let (name, id, ident) = identity(element);
        NameRequest { name, fallback: format!("{kind} {ident:08x}"), suffix: identifier(id, ident, at as usize) }
    });
    let names = names::unique(name_requests, &["self", "super", "crate"], Case::Snake);
    found.zip(names).map(|((at, element), name)| (at, (element, names::escaped(&name)))).collect()
}

/// Returns the suffix that distinguishes elements with the same name. The suffix consists of the letters and digits of
/// the element's ID in the description. For an ID without letters and digits, the suffix is the ident number or, if
/// this number is 0, the position.
fn identifier(id: &str, ident: u32, position: usize) -> String {
    let words = id.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<&str> = words.collect();
    match (words.is_empty(), ident) {
        (false, _) => words.join("_"),
        (true, 0) => position.to_string(),
        (true, ident) => format!("{ident:08x}"),
    }
}

/// Returns the types of all fields in these submodules, and in the user-defined diagnosis structures.
fn types(catalog: &Catalog, submodules: &BTreeMap<u32, (&Submodule, String)>) -> Vec<Type> {
    let mut types = Vec::new();
    for (submodule, _) in submodules.values() {
        let images = [&submodule.input, &submodule.output].into_iter().flatten();
        types.extend(images.flat_map(|data| &data.image.fields).map(|field| field.ty));
        let records = submodule.records.iter().filter(|group| matches!(group.kind, GroupKind::Record(_)));
        types.extend(records.flat_map(|group| &group.items).map(|item| item.ty));
    }
    let fields = catalog.unit_diagnoses.iter().flat_map(|unit| &unit.fields);
    types.extend(fields.map(|field| field.values.map_or(field.ty, Type::Named)));
    types
}
