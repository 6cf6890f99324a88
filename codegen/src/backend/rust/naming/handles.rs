//! Names of the handles of objects, object entries and registers.

use std::borrow::Cow;

use crate::backend::rust::item_addresses::ItemAddresses;
use crate::backend::rust::located::{Located, Register};
use crate::backend::rust::method_names::{reserved, RESERVED_WITH_MESSAGES};
use crate::backend::rust::reachable::addressable;
use crate::ir::{Group, Item, ItemId, ObjectCode};
use crate::names::{self, Case, NameRequest};

/// Names that are reserved for the entries of an object. Clippy would mistake a method `new` for a constructor. Methods
/// that all types have would hide `into` and `try_into`. Constants have upper-case names and cannot conflict with the
/// reserved names.
const RESERVED_IN_OBJECT: [&str; 7] = ["self", "super", "crate", "rt", "new", "into", "try_into"];

/// An item with the name of its handle. The name is not escaped.
pub(in crate::backend::rust) struct NamedItem<'a> {
    pub id: ItemId,
    pub item: &'a Item,
    pub name: String,
}

/// Returns the name of an item's constant. `name` is the name of the item's handle.
pub(in crate::backend::rust) fn constant(name: &str) -> String {
    name.to_ascii_uppercase()
}

/// Returns the path of the constant `constant`, such as `objects::identity::VENDOR_ID`. `object` is the name of the object if it has
/// several entries.
pub(in crate::backend::rust) fn constant_path(object: Option<&str>, constant: &str) -> String {
    match object {
        Some(object) => format!("objects::{object}::{constant}"),
        None => format!("objects::{constant}"),
    }
}

/// An item of a register chapter or process image, and the title of the chapter.
pub(in crate::backend::rust) struct NamedRegister<'a> {
    pub chapter: &'a str,
    pub entry: NamedItem<'a>,
}

/// An object that has values, with its name and its items.
pub(in crate::backend::rust) struct NamedObject<'a> {
    pub group: &'a Group,
    position: u32,
    pub name: String,
    /// Name of the type that has the accessors of the entries. `None` if the object has no entries.
    pub accessors: Option<String>,
    /// The entries. If the object has none, this is its only value, which has the name of the object.
    pub entries: Vec<NamedItem<'a>>,
}

impl NamedObject<'_> {
    /// Returns whether the object becomes a type with a constant for each entry.
    pub fn has_entries(&self) -> bool {
        self.accessors.is_some()
    }
}

/// The Rust names of all handles.
#[derive(Default)]
pub(in crate::backend::rust) struct HandleNames<'a> {
    /// Registers with their names, sorted by ID.
    pub registers: Vec<NamedRegister<'a>>,
    /// Objects with their names, sorted by the position of their group.
    pub objects: Vec<NamedObject<'a>>,
}

impl<'a> HandleNames<'a> {
    /// Returns the names of the registers and of the objects.
    pub(super) fn of(located: &Located<'a>) -> Self {
        let mut names = unique(located).into_iter();
        let registers = located.registers.iter().zip(names.by_ref());
        let registers = registers.map(|(&Register { chapter, id, item }, name)| NamedRegister {
            chapter,
            entry: NamedItem { id, item, name },
        });
        let registers = registers.collect();
        let objects: Vec<((u32, &Group), String)> = addressable(located).zip(names).collect();
        let mut accessors = accessors(&objects).into_iter();
        let objects = objects.into_iter().map(|((position, group), name)| {
            let accessors = if group.has_entries() { accessors.next() } else { None };
            let entries = if group.has_entries() { entry_names(group) } else { vec![name.clone()] };
            let entries = group.items_at(position).zip(entries).map(|((id, item), name)| NamedItem { id, item, name });
            NamedObject { group, position, entries: entries.collect(), accessors, name }
        });
        HandleNames { registers, objects: objects.collect() }
    }

    /// Returns whether the device or module has no handles.
    pub(in crate::backend::rust) fn is_empty(&self) -> bool {
        self.registers.is_empty() && self.objects.is_empty()
    }

    /// Returns the name of an item's handle if this name describes the value. Returns `None` for array elements and
    /// unnamed entries.
    pub(super) fn of_entry(&self, id: ItemId) -> Option<&str> {
        let (object, entry) = self.find(id)?;
        let is_array = |object: &NamedObject<'_>| object.group.object_code() == Some(ObjectCode::Array);
        let is_descriptive = object.is_none_or(|object| !is_array(object) && !entry.item.name.trim().is_empty());
        is_descriptive.then_some(entry.name.as_str())
    }

    /// Returns the full name of an item: the name of its handle. In an object with several values, the full name begins
    /// with the object's name. The object's name is left out in two cases: the item has a name and the object has none,
    /// or the item's name already starts with the object's name.
    pub(super) fn whole(&self, id: ItemId) -> Option<Cow<'_, str>> {
        let (object, entry) = self.find(id)?;
        let (title, name) = (object.map_or("", |object| object.group.name.trim()), entry.item.name.trim());
        Some(match object {
            Some(object) if name.is_empty() || !title.is_empty() && !name.starts_with(title) => {
                names::joined(&object.name, &entry.name).into()
            }
            _ => entry.name.as_str().into(),
        })
    }

    /// Returns the item with this ID. If the item is in an object with several values, also returns the object.
    fn find(&self, id: ItemId) -> Option<(Option<&NamedObject<'a>>, &NamedItem<'a>)> {
        if let Ok(at) = self.registers.binary_search_by_key(&id, |register| register.entry.id) {
            return Some((None, &self.registers[at].entry));
        }
        let at = self.objects.binary_search_by_key(&id.group, |object| object.position).ok()?;
        let object = &self.objects[at];
        Some((Some(object).filter(|object| object.has_entries()), object.entries.get(id.item as usize)?))
    }
}

/// Returns unique names: first those of the registers, then those of the objects.
fn unique(located: &Located<'_>) -> Vec<String> {
    let suffixes: Vec<String> =
        located.registers.iter().map(|register| ItemAddresses::of(located, register.item).suffix()).collect();
    let registers = located.registers.iter().zip(suffixes);
    let registers = registers.map(|(register, suffix)| NameRequest::new(&register.item.name, "register", suffix));
    let objects = addressable(located).map(|(_, group)| of_object(group, &group.name));
    let name_requests = registers.chain(objects);
    let has_messages = located.device.is_some_and(|device| !device.messages.is_empty());
    let with_messages = RESERVED_WITH_MESSAGES.into_iter().filter(|_| has_messages);
    let reserved: Vec<&str> = reserved().chain(with_messages).collect();
    names::unique(name_requests, &reserved, Case::Snake)
}

/// Returns the request for a name of an object, which is made from `name`.
fn of_object<'n>(group: &Group, name: &'n str) -> NameRequest<'n> {
    NameRequest::new(name, "object", format!("{:04X}", group.index().unwrap_or(0)))
}

/// Returns the name of the type with the accessors for each object that has entries. `objects` contains the names of the
/// objects. These names are unique, but two of them can be equal in camel case.
fn accessors(objects: &[((u32, &Group), String)]) -> Vec<String> {
    let objects = objects.iter().filter(|((_, group), _)| group.has_entries());
    let name_requests = objects.map(|((_, group), name)| of_object(group, name));
    let names = names::unique(name_requests, &[], Case::Pascal);
    names.into_iter().map(|name| format!("{name}Accessors")).collect()
}

/// Returns whether a name has letters, so that a constant with this name differs from a type or method.
pub(in crate::backend::rust) fn is_cased(name: &str) -> bool {
    name.to_ascii_uppercase() != name
}

fn entry_names(group: &Group) -> Vec<String> {
    let name_requests =
        group.items.iter().map(|item| NameRequest::new(&item.name, "sub", item.object().map_or(0, |(_, sub)| sub)));
    names::unique(name_requests, &RESERVED_IN_OBJECT, Case::Snake)
}
