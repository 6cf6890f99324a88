//! The objects and registers, ready to be written: a handle each, or a module of handles.

use super::context::Context;
use super::docs;
use super::item::{self, ItemModel, Title};
use super::links::Here;
use super::locations::Locations;
use super::method_names::method_allow;
use super::naming::handles;
use super::reachable::{addressable, is_module};
use crate::ir::{Group, Item, ObjectCode};
use crate::names::{self};

/// An object: one value, or a module of several.
pub(super) struct ObjectModel {
    pub name: String,
    pub docs: Vec<String>,
    pub heading: String,
    /// Of an object of several values, where its constants stand.
    pub constants: String,
    pub items: Vec<ItemModel>,
    pub is_module: bool,
    /// Whether an earlier device of the file has the definition.
    pub is_reexported: bool,
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

/// The registers of the chapters, and then the objects.
pub(super) fn models(context: &Context<'_>, locations: &Locations) -> Vec<ObjectModel> {
    let registers = context.registers.iter().zip(&context.names.handles.registers);
    let objects = addressable(context).zip(&context.names.handles.objects);
    let registers = registers.map(|((chapter, own), name)| register(context, locations, chapter, own, name));
    registers.chain(objects.map(|(group, (name, subs))| object(context, locations, group, name, subs))).collect()
}

fn register(context: &Context<'_>, locations: &Locations, chapter: &str, own: &Item, name: &str) -> ObjectModel {
    let title = Title { name, original: &own.name, chapter: Some(chapter) };
    let model = item::model(context, locations, own, title, (None, "super::"));
    ObjectModel {
        docs: Vec::new(),
        constants: String::new(),
        heading: model.heading.clone(),
        method_allow: None,
        name: names::escaped(name),
        items: vec![model],
        is_module: false,
        is_reexported: false,
    }
}

fn object(context: &Context<'_>, locations: &Locations, group: &Group, name: &str, subs: &[String]) -> ObjectModel {
    let index = group.index().unwrap_or(0);
    let address = format!("0x{index:04X}");
    let title = if group.name.trim().is_empty() { address.clone() } else { docs::escape(&group.name) };
    let is_module = is_module(group);
    let items: Vec<ItemModel> = if is_module {
        let subs = group.items.iter().zip(subs);
        let model = |(item, sub): (&Item, &String)| {
            let title = Title { name: sub, original: &item.name, chapter: None };
            item::model(context, locations, item, title, (Some(name), "super::super::"))
        };
        subs.map(model).collect()
    } else {
        let title = Title { name, original: &group.name, chapter: None };
        let only = group.items.iter().map(|only| item::model(context, locations, only, title, (None, "super::")));
        only.collect()
    };
    let code = group.object_code().map_or("", ObjectCode::name);
    ObjectModel {
        docs: vec![docs::sentence(&title), String::new(), format!("{code} {address}.")],
        heading: item::heading(&group.name, &address),
        // A constant may be called the same.
        constants: Here::TOP.whole(&format!("{}objects::{name}", if handles::is_cased(name) { "" } else { "mod@" })),
        method_allow: method_allow(items.iter().map(|item| item.method.as_str())),
        name: names::escaped(name),
        items,
        is_module,
        is_reexported: false,
    }
}

/// How a program reaches each item: by the methods of the device's type, as in `identity().vendor_id()`.
pub(super) fn calls<'a>(context: &Context<'a>) -> Vec<(&'a Item, String)> {
    let call = |name: &str| format!("{}()", names::escaped(name));
    let registers = context.registers.iter().zip(&context.names.handles.registers);
    let mut calls: Vec<(&'a Item, String)> = registers.map(|((_, item), name)| (*item, call(name))).collect();
    for (group, (name, subs)) in addressable(context).zip(&context.names.handles.objects) {
        if is_module(group) {
            let subs = group.items.iter().zip(subs);
            calls.extend(subs.map(|(item, sub)| (item, format!("{}.{}", call(name), call(sub)))));
        } else {
            calls.extend(group.items.first().map(|item| (item, call(name))));
        }
    }
    calls
}
