//! Items: entries and registers, ready to be printed as handles.

use super::code::{call, seq, Doc};
use super::constructor::Arguments;
use super::context::Context;
use super::docs;
use super::item_addresses::ItemAddresses;
use super::item_type::ItemType;
use super::links::DocModule;
use super::locations::Locations;
use super::naming::handles::NamedItem;
use crate::ir::{Access, ItemId};
use crate::names;

/// An item, ready to be printed.
pub(super) struct ItemModel {
    pub id: ItemId,
    pub constant: String,
    pub method: String,
    pub docs: Vec<String>,
    /// Documentation of the accessor.
    pub method_docs: Vec<String>,
    pub heading: String,
    pub access: &'static str,
    /// Type arguments of the handle, as written in its own module. They are the type of the value and, unless it is the
    /// default, the type of the location.
    pub arguments: Vec<Doc>,
    /// Type arguments of the handle, as written in the device's module.
    pub arguments_at_top: Vec<Doc>,
    /// Type arguments of the handle, as written in the module of all handles.
    pub arguments_in_objects: Vec<Doc>,
    /// Enumeration or bit field of the value.
    pub type_name: Option<String>,
    /// Private alias of the handle's type. The alias has no type parameters, so `rustc` has nothing to infer.
    pub alias: String,
    /// Constructor call of the handle, without the type.
    pub constructor: Doc,
    /// True if the code of the handle contains a path into the runtime crate.
    pub names_runtime: bool,
    /// True if a literal in the handle's code may be close to a mathematical constant. Clippy reports such literals.
    pub real: bool,
    /// Address of the item's object, preferably on the bus on which the device's objects are addressed.
    pub object: Option<(u16, u8)>,
    /// Generic arguments of `rt::Mappable`, with which `lexibus::pdo!` maps the item into PDOs. `None` if the item
    /// cannot be mapped or no PDO has a changeable mapping.
    pub mappable: Option<[String; 3]>,
}

impl ItemModel {
    /// Returns the name with which `lexibus::pdo!` refers to the item. The name is that of the accessor, with a suffix
    /// if the name would hide a primitive type.
    pub(super) fn mappable_name(&self) -> String {
        const PRIMITIVES: [&str; 15] = [
            "bool", "char", "str", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "f32", "f64",
        ];
        let hides = PRIMITIVES.contains(&self.method.as_str());
        format!("{}{}", self.method, if hides { "_" } else { "" })
    }

    /// Returns the expression that combines the handle with the device's client. For long names, the expression is a
    /// function call, because a method chain would be broken into several lines.
    pub(super) fn at_client(&self) -> Doc {
        const LONG: usize = 57;
        let path = format!("objects::{}", self.constant);
        match path.len() > LONG {
            true => call!("rt::Item::at", path, "&mut self.client"),
            false => seq![path, ".at(&mut self.client)"],
        }
    }
}

/// The name of an item in the description, and the title of its chapter.
#[derive(Clone, Copy)]
pub(super) struct Title<'n> {
    pub original: &'n str,
    pub chapter: Option<&'n str>,
}

/// The module that contains the handle of an item.
#[derive(Clone, Copy)]
pub(super) struct ItemModule<'n> {
    /// Name of the object for which the module is generated. `None` for the module that contains all handles.
    pub name: Option<&'n str>,
    /// Path to the device's module.
    pub outer: &'n str,
}

/// Returns the name of an item's constant. `name` is the name of the item's handle.
pub(super) fn constant(name: &str) -> String {
    name.to_ascii_uppercase()
}

/// Returns the model of an item whose handle is in `module`.
pub(super) fn model(
    context: &Context<'_>,
    locations: &Locations,
    entry: &NamedItem<'_>,
    title: Title<'_>,
    module: ItemModule<'_>,
) -> ItemModel {
    let NamedItem { id, item, name } = entry;
    let (Title { original, chapter }, ItemModule { name: module, outer }) = (title, module);
    let path = module.map(|module| format!("objects::{module}::"));
    let (doc_module, method_module) = match &path {
        Some(path) => (DocModule::new(outer, path), DocModule::new(outer, path)),
        None => (DocModule::OBJECTS, DocModule::TOP),
    };
    let addresses = ItemAddresses::of(context, item);
    let heading = heading(original, &addresses.heading());
    let ty = ItemType::of(context, item);
    let location = |outer: &str| locations.argument(addresses.buses(), outer);
    let on = location("").map(|_| addresses.buses().word()).unwrap_or_default();
    let types = |outer: &str| exact(std::iter::once(ty.path(outer)).chain(location(outer).map(Doc::from)).collect());
    let is_location_of_runtime = location(outer).is_some() && addresses.buses().path().is_some();
    let (constructor, does_call_name_runtime) = Arguments::of(item, original, &ty, outer)
        .constructor(&addresses, || locations.code(context, &addresses, outer));
    ItemModel {
        id: *id,
        constant: constant(name),
        method: names::escaped(name),
        docs: exact(docs::item(entry, original, chapter, context, doc_module)),
        method_docs: if context.links.has_methods {
            exact(docs::method(entry, original, context, method_module))
        } else {
            Vec::new()
        },
        heading,
        access: alias(item.access),
        arguments: types(outer),
        arguments_at_top: types(""),
        arguments_in_objects: types("super::"),
        type_name: ty.named.map(str::to_owned),
        alias: format!("{}{}{on}", alias(item.access), ty.word()),
        names_runtime: ty.names_runtime() || is_location_of_runtime || does_call_name_runtime,
        constructor,
        real: ty.basic.is_real() && (item.default.is_some() || !item.limits.is_empty()),
        object: addresses.object_on(context.bus),
        mappable: None,
    }
}

/// Frees the unused capacity of a list. Each item of a device has several such lists, so their unused capacity adds up.
fn exact<T>(mut list: Vec<T>) -> Vec<T> {
    list.shrink_to_fit();
    list
}

/// Returns the heading of an item: its name and its address.
pub(super) fn heading(name: &str, address: &str) -> String {
    match name.trim() {
        "" => format!("{address}."),
        name => format!("{}: {address}.", docs::escape(name).trim_end_matches('.')),
    }
}

/// Returns the short name of handles with these access rights.
fn alias(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "ReadOnly",
        Access::WriteOnly => "WriteOnly",
        Access::Constant => "Constant",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "ReadWrite",
    }
}
