//! Items: entries and registers, ready to be printed as handles.

use super::code::{call, seq, Doc};
use super::constructor::Arguments;
use super::context::Context;
use super::docs;
use super::item_addresses::ItemAddresses;
use super::item_type::ItemType;
use super::links::DocModule;
use super::locations::Locations;
use super::naming::handles::{constant, NamedItem};
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
    /// Type arguments of the handle, as written in the module of all handles. They are the type of the value and, unless
    /// it is the default, the type of the location.
    pub arguments: Vec<Doc>,
    /// Type arguments of the handle, as written in the device's module.
    pub arguments_at_top: Vec<Doc>,
    /// Name of the enumeration or bit field that is the type of the value.
    pub type_name: Option<String>,
    /// Private alias of the handle's type. The alias has no type parameters, so `rustc` has nothing to infer.
    pub alias: String,
    /// Constructor call of the handle, without the type.
    pub constructor: Doc,
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

    /// Returns the expression that combines the handle with a client. `module` is the path to the module or type that
    /// contains the constant. For long paths, the expression is a function call, because a method chain would be broken
    /// into several lines.
    pub(super) fn at(&self, module: &str, client: &str) -> Doc {
        const LONG: usize = 57;
        let path = format!("{module}::{}", self.constant);
        match path.len() > LONG {
            true => call!("rt::Item::at", path, client),
            false => seq![path, ".at(", client, ")"],
        }
    }
}

/// The name of an item in the description, and the title of its chapter.
#[derive(Clone, Copy)]
pub(super) struct Title<'n> {
    pub original: &'n str,
    pub chapter: Option<&'n str>,
}

/// Path from the module of the handles to the device's module.
const OUTER: &str = "super::";

/// Returns the model of an item. `method_module` is the module that contains the item's accessor.
pub(super) fn model(
    context: &Context<'_>,
    locations: &Locations,
    entry: &NamedItem<'_>,
    title: Title<'_>,
    method_module: DocModule<'_>,
) -> ItemModel {
    let NamedItem { id, item, name } = entry;
    let Title { original, chapter } = title;
    let addresses = ItemAddresses::of(context, item);
    let heading = heading(original, &addresses.heading());
    let ty = ItemType::of(context, item);
    let location = |handles: &str| locations.argument(addresses.buses(), handles);
    let on = location("").map(|_| addresses.buses().word()).unwrap_or_default();
    let types =
        |outer: &str, handles: &str| std::iter::once(ty.path(outer)).chain(location(handles).map(Doc::from)).collect();
    let constructor =
        Arguments::of(item, original, &ty, OUTER).constructor(&addresses, || locations.code(context, &addresses));
    ItemModel {
        id: *id,
        constant: constant(name),
        method: names::escaped(name),
        docs: docs::item(entry, original, chapter, context, DocModule::OBJECTS),
        method_docs: if context.links.has_methods {
            docs::method(entry, original, context, method_module)
        } else {
            Vec::new()
        },
        heading,
        access: alias(item.access),
        arguments: types(OUTER, ""),
        arguments_at_top: types("", "objects::"),
        type_name: ty.named.map(str::to_owned),
        alias: format!("{}{}{on}", alias(item.access), ty.word()),
        constructor,
        real: ty.basic.is_real() && (item.default.is_some() || !item.limits.is_empty()),
        object: addresses.object_on(context.bus),
        mappable: None,
    }
}

/// Returns the heading of an item: its name and its address.
pub(super) fn heading(name: &str, address: &str) -> String {
    match name.trim() {
        "" => format!("{address}."),
        name => format!("{}: {address}.", docs::escape(name).trim_end_matches('.')),
    }
}

/// Returns the short name of handles with these access rights.
pub(super) fn alias(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "ReadOnly",
        Access::WriteOnly => "WriteOnly",
        Access::Constant => "Constant",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "ReadWrite",
    }
}
