//! The objects and registers, ready to be written: a handle each, or a module of handles.

use super::docs;
use super::item::{self, ItemModel};
use super::locations::Locations;
use super::method_names::{method_allow, BESIDE_MESSAGES, RESERVED};
use super::place::Place;
use super::reachable::{addressable, is_module, registers};
use super::scope::Scope;
use crate::ir::{Group, Item, ObjectCode};
use crate::passes::names_unique::{self, Case, Wish};

/// Constants of an object have nothing to clash with.
const RESERVED_IN_OBJECT: [&str; 4] = ["self", "super", "crate", "rt"];

/// An object: one value, or a module of several.
pub(super) struct ObjectModel {
    pub name: String,
    pub docs: Vec<String>,
    pub heading: String,
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
        self.items.iter().any(|item| item.arguments.contains("rt::") || item.constructor.contains("rt::"))
    }
}

/// The registers of the chapters, and then the objects.
pub(super) fn models(scope: &Scope<'_>, locations: &Locations) -> Vec<ObjectModel> {
    let registers = registers(scope);
    let groups: Vec<&Group> = addressable(scope).collect();
    let mut names = names(scope, &registers, &groups).into_iter();
    let mut models = Vec::with_capacity(names.len());
    for ((chapter, own), name) in registers.iter().zip(&mut names) {
        models.push(register(scope, locations, chapter, own, &name));
    }
    models.extend(groups.iter().zip(names).map(|(group, name)| object(scope, locations, group, &name)));
    models
}

/// The names of the registers, and then those of the objects.
fn names<'i>(scope: &Scope<'_>, registers: &[(&'i str, &'i Item)], groups: &[&'i Group]) -> Vec<String> {
    let register = |(_, item): &(&'i str, &'i Item)| Wish::new(&item.name, "register", Place::of(scope, item).suffix());
    let object = |group: &&'i Group| Wish::new(&group.name, "object", format!("{:04X}", group.index().unwrap_or(0)));
    let wishes: Vec<Wish<'_>> = registers.iter().map(register).chain(groups.iter().map(object)).collect();
    let has_messages = scope.device.is_some_and(|device| !device.messages.is_empty());
    let beside = BESIDE_MESSAGES.into_iter().filter(|_| has_messages);
    let reserved: Vec<&str> = RESERVED.into_iter().chain(beside).collect();
    names_unique::unique(&wishes, &reserved, Case::Snake)
}

fn register(scope: &Scope<'_>, locations: &Locations, chapter: &str, own: &Item, name: &str) -> ObjectModel {
    let mut model = item::model(scope, locations, own, name, &own.name, "super::");
    model.docs = docs::item(own, &own.name, Some(chapter), scope);
    ObjectModel {
        docs: Vec::new(),
        heading: model.heading.clone(),
        method_allow: None,
        name: names_unique::escaped(name),
        items: vec![model],
        is_module: false,
    }
}

fn object(scope: &Scope<'_>, locations: &Locations, group: &Group, name: &str) -> ObjectModel {
    let index = group.index().unwrap_or(0);
    let address = format!("0x{index:04X}");
    let title = if group.name.trim().is_empty() { address.clone() } else { docs::escape(&group.name) };
    let is_module = is_module(group);
    let items = if is_module {
        sub_items(scope, locations, group)
    } else {
        let only = group.items.iter().map(|only| item::model(scope, locations, only, name, &group.name, "super::"));
        only.collect()
    };
    let code = group.object_code().map_or("", ObjectCode::name);
    ObjectModel {
        docs: vec![docs::sentence(&title), String::new(), format!("{code} {address}.")],
        heading: item::heading(&group.name, &address),
        method_allow: method_allow(items.iter().map(|item| item.method.as_str())),
        name: names_unique::escaped(name),
        items,
        is_module,
    }
}

/// How a program reaches each item: by the methods of the device's type, as in `identity().vendor_id()`.
pub(super) fn calls<'a>(scope: &Scope<'a>) -> Vec<(&'a Item, String)> {
    let registers = registers(scope);
    let groups: Vec<&'a Group> = addressable(scope).collect();
    let mut names = names(scope, &registers, &groups).into_iter();
    let call = |name: &str| format!("{}()", names_unique::escaped(name));
    let mut calls: Vec<(&'a Item, String)> =
        registers.iter().zip(&mut names).map(|((_, item), name)| (*item, call(&name))).collect();
    for (group, name) in groups.iter().zip(names) {
        if is_module(group) {
            let subs = group.items.iter().zip(sub_names(group));
            calls.extend(subs.map(|(item, sub)| (item, format!("{}.{}", call(&name), call(&sub)))));
        } else {
            calls.extend(group.items.first().map(|item| (item, call(&name))));
        }
    }
    calls
}

fn sub_items(scope: &Scope<'_>, locations: &Locations, group: &Group) -> Vec<ItemModel> {
    let items = group.items.iter().zip(sub_names(group));
    items.map(|(sub, name)| item::model(scope, locations, sub, &name, &sub.name, "super::super::")).collect()
}

fn sub_names(group: &Group) -> Vec<String> {
    let wishes: Vec<Wish<'_>> =
        group.items.iter().map(|item| Wish::new(&item.name, "sub", item.object().map_or(0, |(_, sub)| sub))).collect();
    names_unique::unique(&wishes, &RESERVED_IN_OBJECT, Case::Snake)
}
