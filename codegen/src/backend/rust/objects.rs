//! Objects and registers, ready to be printed. An object becomes a handle, or a type whose constants are the handles of
//! the entries. A register becomes a handle.

use super::code::Doc;
use super::context::Context;
use super::docs;
use super::item::{self, ItemModel, Title};
use super::links::DocModule;
use super::locations::Locations;
use super::method_names::method_allow;
use super::naming::handles::{self, HandleNames, NamedItem, NamedObject, NamedRegister};
use crate::facts::{area, register};
use crate::ir::{Binding, Item, ObjectCode};
use crate::names;
use crate::number::hex16;

/// An object or register, ready to be printed. An object becomes a type with a constant for each entry if it has
/// sub-indices above 0 or several values. Other objects and registers become handles.
pub(super) struct ObjectModel {
    pub name: String,
    /// Title of the area: a chapter, a range of objects, or "Process images".
    pub area: String,
    /// Addresses under which the search of rustdoc finds the accessor.
    pub aliases: Vec<String>,
    /// Name of the type that has the accessors of the entries. `None` if the object has no entries, and for a register.
    pub accessors: Option<String>,
    pub docs: Vec<String>,
    pub heading: String,
    /// Link to the type with the object's constants. Empty for a register.
    pub constants: String,
    pub items: Vec<ItemModel>,
    /// True if the device re-exports the definition from an earlier device of the file.
    pub is_reexported: bool,
    pub method_allow: Option<String>,
}

impl ObjectModel {
    /// Returns whether the object becomes a type with a constant for each entry.
    pub(super) fn has_entries(&self) -> bool {
        self.accessors.is_some()
    }

    /// Returns the path of an item's constant.
    pub(super) fn path(&self, item: &ItemModel) -> String {
        handles::constant_path(self.has_entries().then_some(&self.name), &item.constant)
    }

    /// Returns whether `lexibus::pdo!` must know the names of the items. The macro knows all mappable items. It also
    /// knows other items with an index of 0x2000 or above, so that it can report that they are not mappable.
    pub(super) fn is_in_mappable(&self) -> bool {
        self.items.iter().any(|item| item.mappable.is_some() || item.object.is_some_and(|(index, _)| index >= 0x2000))
    }

    /// Drops the documentation of the device's accessor method for the object, unless the object has entries.
    pub(super) fn drop_method_docs(&mut self) {
        if !self.has_entries() {
            self.items.iter_mut().for_each(|item| item.method_docs = Vec::new());
        }
    }

    /// Drops the code and documentation of the handles. The names remain, because other parts of the output use them.
    pub(super) fn drop_handles(&mut self) {
        (self.docs, self.heading) = Default::default();
        for item in &mut self.items {
            (item.docs, item.method_docs, item.heading) = Default::default();
            (item.arguments, item.arguments_at_top) = Default::default();
            item.constructor = Doc::default();
        }
    }
}

/// Returns the models of the registers and process image fields, followed by those of the objects.
pub(super) fn models(context: &Context<'_>, locations: &Locations) -> Vec<ObjectModel> {
    let HandleNames { registers, objects } = &context.names.handles;
    let registers = registers.iter().map(|named| register(context, locations, named));
    registers.chain(objects.iter().map(|named| object(context, locations, named))).collect()
}

fn register(context: &Context<'_>, locations: &Locations, named: &NamedRegister<'_>) -> ObjectModel {
    let title = Title { original: &named.entry.item.name, chapter: Some(named.chapter) };
    let model = item::model(context, locations, &named.entry, title, DocModule::TOP);
    ObjectModel {
        area: if named.chapter.is_empty() { "Process images".to_owned() } else { named.chapter.to_owned() },
        aliases: aliases(named.entry.item),
        accessors: None,
        docs: Vec::new(),
        constants: String::new(),
        heading: model.heading.clone(),
        method_allow: None,
        name: names::escaped(&named.entry.name),
        items: vec![model],
        is_reexported: false,
    }
}

fn object(context: &Context<'_>, locations: &Locations, named: &NamedObject<'_>) -> ObjectModel {
    let NamedObject { group, name, accessors, entries, .. } = named;
    let index = group.index().unwrap_or(0);
    let address = hex16(index);
    let title = if group.name.trim().is_empty() { address.clone() } else { docs::escape(&group.name) };
    let method_module = if named.has_entries() { DocModule::OBJECTS } else { DocModule::TOP };
    let model = |entry: &NamedItem<'_>| {
        let original = if named.has_entries() { &entry.item.name } else { &group.name };
        item::model(context, locations, entry, Title { original, chapter: None }, method_module)
    };
    let items: Vec<ItemModel> = entries.iter().map(model).collect();
    let code = group.object_code().map_or("", ObjectCode::name);
    let facts: Vec<String> =
        [format!("{code} {address}.")].into_iter().chain(docs::WORDS.object_type_origin(group)).collect();
    ObjectModel {
        area: area::objects(index).to_owned(),
        aliases: index_aliases(index).into(),
        accessors: accessors.clone(),
        docs: vec![docs::sentence(&title), String::new(), facts.join(" ")],
        heading: item::heading(&group.name, &address),
        // A constant may have the same name as the type if the name has no letters. The prefix `type@` then makes the
        // link lead to the type.
        constants: DocModule::TOP
            .whole(&format!("{}objects::{name}", if handles::is_cased(name) { "" } else { "type@" })),
        method_allow: method_allow(items.iter().map(|item| item.method.as_str())),
        name: names::escaped(name),
        items,
        is_reexported: false,
    }
}

fn index_aliases(index: u16) -> [String; 2] {
    [format!("{index:04X}"), hex16(index)]
}

/// Returns the texts under which the search of rustdoc finds an item: printed addresses of registers, numbers of
/// parameters, and indices of objects.
fn aliases(item: &Item) -> Vec<String> {
    let of = |binding: &Binding| match binding {
        Binding::Register(register) => {
            let printed = register::printed(register);
            vec![printed.split('–').next().unwrap_or_default().to_owned()]
        }
        Binding::Parameter(parameter) => vec![parameter.code.to_string(), hex16(parameter.code)],
        Binding::Object { index, .. } => index_aliases(*index).into(),
        _ => Vec::new(),
    };
    let mut all: Vec<String> = item.bindings.iter().flat_map(of).collect();
    // Keep only aliases that consist of letters and digits. Rustdoc rejects an alias that contains quotation marks, or
    // that starts or ends with a space.
    all.retain(|alias| !alias.is_empty() && alias.chars().all(|letter| letter.is_ascii_alphanumeric()));
    all.sort();
    all.dedup();
    all
}

/// Returns the items of all objects, each with the path of its constant, such as `objects::identity::VENDOR_ID`.
pub(super) fn constants<'c, 'a>(context: &'c Context<'a>) -> impl Iterator<Item = (&'c NamedItem<'a>, String)> {
    let entries = context.names.handles.objects.iter();
    let entries = entries.flat_map(|object| object.entries.iter().map(move |entry| (object, entry)));
    entries.map(|(object, entry)| {
        let name = object.has_entries().then(|| names::escaped(&object.name));
        (entry, handles::constant_path(name.as_deref(), &handles::constant(&entry.name)))
    })
}

/// Returns each item with the method calls that return its accessor, such as `identity().vendor_id()`.
pub(super) fn calls<'c, 'a>(context: &'c Context<'a>) -> impl Iterator<Item = (&'c NamedItem<'a>, String)> {
    let call = |name: &str| format!("{}()", names::escaped(name));
    let HandleNames { registers, objects } = &context.names.handles;
    let entries = objects.iter().flat_map(|object| object.entries.iter().map(move |entry| (object, entry)));
    let entries = entries.map(move |(object, entry)| match object.has_entries() {
        true => (entry, format!("{}.{}", call(&object.name), call(&entry.name))),
        false => (entry, call(&entry.name)),
    });
    registers.iter().map(move |register| (&register.entry, call(&register.entry.name))).chain(entries)
}
