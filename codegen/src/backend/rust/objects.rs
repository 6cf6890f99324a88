//! The objects and registers, ready to be written: a handle each, or a module of handles.

use super::docs;
use super::item::{self, ItemModel, Title};
use super::links::Here;
use super::locations::Locations;
use super::method_names::{method_allow, BESIDE_MESSAGES, RESERVED};
use super::place::Place;
use super::reachable::{addressable, is_module};
use super::scope::Scope;
use crate::ir::{Group, Item, ObjectCode};
use crate::names::{self, Case, Wish};

/// Constants of an object have nothing to clash with; its methods would be taken for a constructor, or couldn't be called because
/// every type has one of that name.
const RESERVED_IN_OBJECT: [&str; 7] = ["self", "super", "crate", "rt", "new", "into", "try_into"];

/// An object: one value, or a module of several.
pub(super) struct ObjectModel {
    pub name: String,
    pub docs: Vec<String>,
    pub heading: String,
    /// Of an object of several values, where its constants stand.
    pub constants: String,
    pub items: Vec<ItemModel>,
    pub is_module: bool,
    pub method_allow: Option<String>,
}

impl ObjectModel {
    /// Whether one of its items can be mapped into PDOs.
    pub(super) fn has_mappable(&self) -> bool {
        self.items.iter().any(|item| item.mappable.is_some())
    }

    /// Whether its items need the runtime's name.
    pub(super) fn names_runtime(&self) -> bool {
        self.items
            .iter()
            .any(|item| item.arguments.iter().chain([&item.constructor]).any(|own| own.text().contains("rt::")))
    }
}

/// The names of handles in Rust, as yet without an escape.
#[derive(Default)]
pub(super) struct Names {
    /// Those of `Scope::registers`.
    pub registers: Vec<String>,
    /// Those of the objects that have values, and those of the values of each that is a module.
    pub objects: Vec<(String, Vec<String>)>,
}

impl Names {
    /// Whether there is no handle.
    pub(super) fn is_empty(&self) -> bool {
        self.registers.is_empty() && self.objects.is_empty()
    }
}

/// The names of the registers and of the objects.
pub(super) fn names(scope: &Scope<'_>) -> Names {
    let groups: Vec<&Group> = addressable(scope).collect();
    let register = |(_, item): &(&'_ str, &Item)| Place::of(scope, item).suffix();
    let suffixes: Vec<String> = scope.registers.iter().map(register).collect();
    let registers = scope.registers.iter().zip(suffixes);
    let registers = registers.map(|((_, item), suffix)| Wish::new(&item.name, "register", suffix));
    let objects = groups.iter().copied();
    let objects = objects.map(|own| Wish::new(&own.name, "object", format!("{:04X}", own.index().unwrap_or(0))));
    let wishes: Vec<Wish<'_>> = registers.chain(objects).collect();
    let has_messages = scope.device.is_some_and(|device| !device.messages.is_empty());
    let beside = BESIDE_MESSAGES.into_iter().filter(|_| has_messages);
    let reserved: Vec<&str> = RESERVED.into_iter().chain(beside).collect();
    let mut names = names::unique(&wishes, &reserved, Case::Snake).into_iter();
    let registers = names.by_ref().take(scope.registers.len()).collect();
    let subs = |group: &Group| if is_module(group) { sub_names(group) } else { Vec::new() };
    Names { registers, objects: names.zip(groups).map(|(name, group)| (name, subs(group))).collect() }
}

/// The registers of the chapters, and then the objects.
pub(super) fn models(scope: &Scope<'_>, locations: &Locations) -> Vec<ObjectModel> {
    let registers = scope.registers.iter().zip(&scope.names.registers);
    let objects = addressable(scope).zip(&scope.names.objects);
    let registers = registers.map(|((chapter, own), name)| register(scope, locations, chapter, own, name));
    registers.chain(objects.map(|(group, (name, subs))| object(scope, locations, group, name, subs))).collect()
}

fn register(scope: &Scope<'_>, locations: &Locations, chapter: &str, own: &Item, name: &str) -> ObjectModel {
    let title = Title { name, original: &own.name, chapter: Some(chapter) };
    let model = item::model(scope, locations, own, title, (None, "super::"));
    ObjectModel {
        docs: Vec::new(),
        constants: String::new(),
        heading: model.heading.clone(),
        method_allow: None,
        name: names::escaped(name),
        items: vec![model],
        is_module: false,
    }
}

fn object(scope: &Scope<'_>, locations: &Locations, group: &Group, name: &str, subs: &[String]) -> ObjectModel {
    let index = group.index().unwrap_or(0);
    let address = format!("0x{index:04X}");
    let title = if group.name.trim().is_empty() { address.clone() } else { docs::escape(&group.name) };
    let is_module = is_module(group);
    let items: Vec<ItemModel> = if is_module {
        let subs = group.items.iter().zip(subs);
        let model = |(item, sub): (&Item, &String)| {
            let title = Title { name: sub, original: &item.name, chapter: None };
            item::model(scope, locations, item, title, (Some(name), "super::super::"))
        };
        subs.map(model).collect()
    } else {
        let title = Title { name, original: &group.name, chapter: None };
        let only = group.items.iter().map(|only| item::model(scope, locations, only, title, (None, "super::")));
        only.collect()
    };
    let code = group.object_code().map_or("", ObjectCode::name);
    ObjectModel {
        docs: vec![docs::sentence(&title), String::new(), format!("{code} {address}.")],
        heading: item::heading(&group.name, &address),
        // A constant may be called the same.
        constants: Here::TOP.whole(&format!("{}objects::{name}", if is_cased(name) { "" } else { "mod@" })),
        method_allow: method_allow(items.iter().map(|item| item.method.as_str())),
        name: names::escaped(name),
        items,
        is_module,
    }
}

/// Whether a constant is called otherwise than a module or a method.
pub(super) fn is_cased(name: &str) -> bool {
    name.to_ascii_uppercase() != name
}

/// How a program reaches each item: by the methods of the device's type, as in `identity().vendor_id()`.
pub(super) fn calls<'a>(scope: &Scope<'a>) -> Vec<(&'a Item, String)> {
    let call = |name: &str| format!("{}()", names::escaped(name));
    let registers = scope.registers.iter().zip(&scope.names.registers);
    let mut calls: Vec<(&'a Item, String)> = registers.map(|((_, item), name)| (*item, call(name))).collect();
    for (group, (name, subs)) in addressable(scope).zip(&scope.names.objects) {
        if is_module(group) {
            let subs = group.items.iter().zip(subs);
            calls.extend(subs.map(|(item, sub)| (item, format!("{}.{}", call(name), call(sub)))));
        } else {
            calls.extend(group.items.first().map(|item| (item, call(name))));
        }
    }
    calls
}

fn sub_names(group: &Group) -> Vec<String> {
    let wishes: Vec<Wish<'_>> =
        group.items.iter().map(|item| Wish::new(&item.name, "sub", item.object().map_or(0, |(_, sub)| sub))).collect();
    names::unique(&wishes, &RESERVED_IN_OBJECT, Case::Snake)
}
