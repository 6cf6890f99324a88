//! An entry or a register, ready to be written as a handle.

use super::code::{call, seq, Doc};
use super::constructor::Arguments;
use super::context::Context;
use super::docs;
use super::item_addresses::ItemAddresses;
use super::item_type::ItemType;
use super::links::Here;
use super::locations::Locations;
use super::naming::handles::NamedItem;
use crate::ir::{Access, ItemId};
use crate::names;

/// An entry.
pub(super) struct ItemModel {
    pub id: ItemId,
    pub constant: String,
    pub method: String,
    pub docs: Vec<String>,
    /// What is said of the method.
    pub method_docs: Vec<String>,
    pub heading: String,
    pub access: &'static str,
    /// The type of the value and, where there are others, that of the location, as the handle's place names them, as the device's
    /// does, and as the types of handles do.
    pub arguments: Vec<Doc>,
    pub arguments_at_top: Vec<Doc>,
    pub arguments_beside: Vec<Doc>,
    /// The enumeration or the bit field that the value is.
    pub type_name: Option<String>,
    /// The private name of the handle's type: one without parameters, so that `rustc` has nothing to infer.
    pub alias: String,
    /// The call that makes the handle, without its type.
    pub constructor: Doc,
    /// Whether the handle needs the runtime's name.
    pub names_runtime: bool,
    /// Whether a literal may resemble a mathematical constant.
    pub real: bool,
    /// The object on the bus of the PDOs.
    pub object: Option<(u16, u8)>,
    /// The arguments of the type that says how it is mapped into PDOs.
    pub mappable: Option<[String; 3]>,
}

impl ItemModel {
    /// The name under which `lexibus::pdo!` finds it: that of the method, unless that would hide a type.
    pub(super) fn mappable_name(&self) -> String {
        const PRIMITIVES: [&str; 15] = [
            "bool", "char", "str", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "f32", "f64",
        ];
        let hides = PRIMITIVES.contains(&self.method.as_str());
        format!("{}{}", self.method, if hides { "_" } else { "" })
    }

    /// The expression that joins a handle to the device's client. A long name would break the chain of calls.
    pub(super) fn at_client(&self) -> Doc {
        const LONG: usize = 48;
        match self.constant.len() > LONG {
            true => call!("rt::Item::at", seq!["objects::", self.constant], "&mut self.client"),
            false => seq!["objects::", self.constant, ".at(&mut self.client)"],
        }
    }
}

/// What the source calls an item, and the title of its chapter.
#[derive(Clone, Copy)]
pub(super) struct Title<'n> {
    pub original: &'n str,
    pub chapter: Option<&'n str>,
}

/// The handle of an item that stands in this module of objects, or beside these; `outer` leads from there to the device's place.
pub(super) fn model(
    context: &Context<'_>,
    locations: &Locations,
    entry: &NamedItem<'_>,
    Title { original, chapter }: Title<'_>,
    (module, outer): (Option<&str>, &str),
) -> ItemModel {
    let NamedItem { id, item, name } = entry;
    let path = module.map(|module| format!("objects::{module}::"));
    let (here, of_method) = match &path {
        Some(path) => (Here::new(outer, path), Here::new(outer, path)),
        None => (Here::OBJECTS, Here::TOP),
    };
    let addresses = ItemAddresses::of(context, item);
    let heading = heading(original, &addresses.heading());
    let ty = ItemType::of(context, item);
    let location = |outer: &str| locations.argument(addresses.buses(), outer);
    let on = location("").map(|_| addresses.buses().word()).unwrap_or_default();
    let types = |outer: &str| std::iter::once(ty.path(outer)).chain(location(outer).map(Doc::from)).collect();
    let is_location_of_runtime = location(outer).is_some() && addresses.buses().path().is_some();
    let (constructor, does_call_name_runtime) = Arguments::of(item, original, &ty, outer)
        .constructor(&addresses, || locations.code(context, &addresses, outer));
    ItemModel {
        id: *id,
        constant: name.to_ascii_uppercase(),
        method: names::escaped(name),
        docs: docs::item(entry, original, chapter, context, here),
        method_docs: if context.links.has_methods {
            docs::method(entry, &heading, context, of_method)
        } else {
            Vec::new()
        },
        heading,
        access: alias(item.access),
        arguments: types(outer),
        arguments_at_top: types(""),
        arguments_beside: types("super::"),
        type_name: ty.named.map(str::to_owned),
        alias: format!("{}{}{on}", alias(item.access), ty.word()),
        names_runtime: ty.names_runtime() || is_location_of_runtime || does_call_name_runtime,
        constructor,
        real: ty.basic.is_real() && (item.default.is_some() || !item.limits.is_empty()),
        object: addresses.object_on(context.bus),
        mappable: None,
    }
}

/// What the entry is called, and where it is.
pub(super) fn heading(name: &str, address: &str) -> String {
    match name.trim() {
        "" => format!("{address}."),
        name => format!("{}: {address}.", docs::escape(name).trim_end_matches('.')),
    }
}

/// The short name of the handles with an access.
fn alias(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "ReadOnly",
        Access::WriteOnly => "WriteOnly",
        Access::Constant => "Constant",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "ReadWrite",
    }
}
