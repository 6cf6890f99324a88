//! Links of documentation: the paths of what is generated, by the elements of the description that it is made of.
//!
//! Paths are relative, so that they hold wherever the generated module stands.

use std::collections::HashMap;

use super::located::Located;
use super::naming::composites::NamedComposite;
use super::naming::handles::{is_cased, HandleNames, NamedItem};
use super::naming::pdos::{NamedField, NamedPdo};
use super::naming::Names;
use super::options::RustOptions;
use super::scope::Scope;
use crate::ir::{Device, ElementId, ItemId, MessageId, PdoEntryKind, Type};

/// Where a doc comment stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Here<'h> {
    /// The way to the device's place: `super::`.
    outer: &'h str,
    /// The module, as seen from there: `objects::`.
    module: &'h str,
}

impl<'h> Here<'h> {
    /// At the device's place.
    pub const TOP: Here<'static> = Here::new("", "");
    pub const OBJECTS: Here<'static> = Here::new("super::", "objects::");
    pub const TYPES: Here<'static> = Here::new("super::", "types::");
    /// The views of PDOs stand in a module of their own, from which the way is the same.
    pub const PDO: Here<'static> = Here::new("super::", "pdo::");
    #[cfg(feature = "messages")]
    pub const MESSAGES: Here<'static> = Here::new("super::", "messages::");
    /// Any other module at the device's place, which nothing is linked in.
    pub const BESIDE: Here<'static> = Here::new("super::", "::");

    pub const fn new(outer: &'h str, module: &'h str) -> Self {
        Here { outer, module }
    }

    /// Whether this is the device's place.
    pub fn is_top(self) -> bool {
        self.outer.is_empty()
    }

    /// Whether a path leads to something of this module.
    fn is_of(self, path: &str) -> bool {
        !self.is_top() && path.starts_with(self.module)
    }

    /// The path from here of what has this one from the device's place. What precedes `@` tells elements of one name apart.
    fn path(self, path: &str) -> String {
        let (kind, path) = path.split_once('@').map_or(("", path), |(kind, path)| (kind, path));
        let at = if kind.is_empty() { "" } else { "@" };
        match path.strip_prefix(self.module) {
            Some(own) if kind.is_empty() && is_derive(own) => format!("type@{own}"),
            Some(own) => format!("{kind}{at}{own}"),
            None => format!("{kind}{at}{}{path}", self.outer),
        }
    }

    /// A link that shows the last name of a path as code.
    pub fn code(self, path: &str) -> String {
        self.code_as(last(path), path)
    }

    /// A link that shows `name` as code.
    pub fn code_as(self, name: &str, path: &str) -> String {
        let path = self.path(path);
        if path == name {
            format!("[`{name}`]")
        } else {
            format!("[`{name}`]({path})")
        }
    }

    /// A link that shows the whole way from here.
    pub fn whole(self, path: &str) -> String {
        let path = self.path(path);
        match path.split_once('@') {
            Some((_, shown)) => format!("[`{shown}`]({path})"),
            None => format!("[`{path}`]"),
        }
    }

    /// A link that shows `text`, in which every markup is escaped.
    pub fn text(self, text: &str, path: &str) -> String {
        let own = self.path(path);
        // Rustdoc minds the path of a link whose text leads there by itself.
        if text.is_empty() || own == text.replace('\\', "") {
            return self.code(path);
        }
        format!("[{text}]({own})")
    }
}

/// A link to a type that stands in the same module.
pub(super) fn beside(name: &str) -> String {
    match is_derive(name) {
        true => format!("[`{name}`](type@{name})"),
        false => format!("[`{name}`]"),
    }
}

/// Whether a type of this name is called like a macro of the prelude, so that rustdoc has to be told which is meant.
pub(super) fn is_derive(name: &str) -> bool {
    const DERIVES: [&str; 9] = ["Clone", "Copy", "Debug", "Default", "Eq", "Hash", "Ord", "PartialEq", "PartialOrd"];
    DERIVES.contains(&name)
}

/// The last name of a path.
fn last(path: &str) -> &str {
    path.rsplit(['@', ':']).next().unwrap_or(path)
}

/// The paths of an item's handle, from the device's place.
#[derive(Clone, Debug)]
struct Handle {
    constant: String,
    /// The method that reads and writes it.
    method: Option<String>,
}

/// How many elements a sentence lists.
const LISTED: usize = 8;

/// The paths of what is generated for a device or a module, from its place.
#[derive(Debug, Default)]
pub(super) struct Links {
    handles: HashMap<ItemId, Handle>,
    /// The names of the structs that carry an object by default.
    carriers: HashMap<(u16, u8), Vec<String>>,
    /// The items of each type, by its position.
    users: HashMap<u32, Vec<ItemId>>,
    /// The paths of requests, or of what only the device sends.
    messages: HashMap<MessageId, String>,
    /// The constants of numbers that items are parts of.
    wholes: HashMap<ItemId, Vec<String>>,
    /// Whether the device has a type with methods.
    pub has_methods: bool,
}

impl Links {
    /// `device_name` is the name of the device's type.
    pub fn of(scope: &Located<'_>, names: &Names<'_>, options: &RustOptions, device_name: &str) -> Self {
        let mut links = Links::default();
        let has_objects = !names.handles.is_empty() && scope.device.is_some_and(has_object_access);
        #[cfg(feature = "messages")]
        let has_requests = links.add_messages(names);
        #[cfg(not(feature = "messages"))]
        let has_requests = false;
        links.has_methods = options.accessors && (has_objects || has_requests);
        links.add_handles(scope, &names.handles, Some(device_name).filter(|_| links.has_methods));
        if options.pdos {
            names.pdos.iter().for_each(|named| links.add_pdo(named));
        }
        for NamedComposite { composite, name } in &names.composites {
            let name = if name == device_name { format!("const@{name}") } else { name.clone() };
            let parts = composite.parts.iter().chain(composite.sign.as_ref().map(|(item, _)| item));
            for id in parts.filter_map(|part| part.id) {
                links.wholes.entry(id).or_default().push(name.clone());
            }
        }
        links
    }

    /// Returns whether there are requests.
    #[cfg(feature = "messages")]
    fn add_messages(&mut self, names: &Names<'_>) -> bool {
        self.messages = names.messages.paths().map(|message| (message.id, message.path)).collect();
        names.messages.paths().any(|message| message.is_request)
    }

    fn add_handles(&mut self, scope: &Scope<'_>, names: &HandleNames<'_>, device: Option<&str>) {
        for register in &names.registers {
            self.add_handle(scope, &register.entry, device);
        }
        for object in &names.objects {
            for entry in &object.entries {
                if !object.is_module {
                    self.add_handle(scope, entry, device);
                    continue;
                }
                let constant = format!("objects::{}::{}", object.name, entry.name.to_ascii_uppercase());
                let method = device.map(|_| format!("objects::{}::Accessors::{}", object.name, entry.name));
                self.add(scope, entry, Handle { constant, method });
            }
        }
    }

    fn add_handle(&mut self, scope: &Scope<'_>, entry: &NamedItem<'_>, device: Option<&str>) {
        let name = &entry.name;
        // A module may be called the same.
        let kind = if is_cased(name) { "" } else { "const@" };
        let constant = format!("{kind}objects::{}", name.to_ascii_uppercase());
        self.add(scope, entry, Handle { constant, method: device.map(|device| format!("{device}::{name}")) });
    }

    fn add(&mut self, scope: &Scope<'_>, entry: &NamedItem<'_>, handle: Handle) {
        let ty = entry.item.ty;
        if let (Type::Named(_), Some((position, _))) = (ty, scope.resolve(ty).1) {
            self.users.entry(position).or_default().push(entry.id);
        }
        self.handles.insert(entry.id, handle);
    }

    fn add_pdo(&mut self, named: &NamedPdo<'_>) {
        for NamedField { entry, .. } in named.fields.iter().filter(|field| field.entry.kind == PdoEntryKind::Item) {
            let carriers = self.carriers.entry((entry.index, entry.sub_index)).or_default();
            if carriers.last() != Some(&named.name) {
                carriers.push(named.name.clone());
            }
        }
    }

    /// The path of the constant of an item, or of the type of a message.
    pub fn path(&self, id: ElementId) -> Option<&str> {
        match id {
            ElementId::Item(id) => Some(&self.handles.get(&id)?.constant),
            ElementId::Message(id) => self.messages.get(&id).map(String::as_str),
        }
    }

    /// A sentence about the items whose values have the type at this position; empty where none has a handle.
    pub fn users(&self, position: u32, here: Here<'_>) -> String {
        let users = self.users.get(&position).map_or(&[][..], Vec::as_slice);
        let paths = users.iter().filter_map(|id| Some(self.handles.get(id)?.constant.as_str()));
        sentence("Values of", &paths.collect::<Vec<_>>(), here)
    }

    /// What belongs to an item, for the method that reads and writes it: its constant, its type, and the PDOs that carry it.
    pub fn beside_method(&self, entry: &NamedItem<'_>, ty: Option<&str>, here: Here<'_>) -> String {
        let constant = self.path(entry.id.into()).map(|path| format!("Constant: {}.", here.whole(path)));
        self.beside(entry, [constant, values(ty, here)], here)
    }

    /// The same for its constant, with its method.
    pub fn beside_constant(&self, entry: &NamedItem<'_>, ty: Option<&str>, here: Here<'_>) -> String {
        let method = self.handles.get(&entry.id).and_then(|handle| handle.method.as_ref());
        let link = |path: &String| if here.is_of(path) { here.whole(path) } else { here.code(path) };
        let method = method.map(|path| format!("Accessor: {}.", link(path)));
        self.beside(entry, [method, values(ty, here)], here)
    }

    fn beside(&self, entry: &NamedItem<'_>, first: [Option<String>; 2], here: Here<'_>) -> String {
        let carriers = entry.item.object().and_then(|object| self.carriers.get(&object));
        let carriers: Vec<String> = carriers.into_iter().flatten().map(|name| format!("pdo::{name}")).collect();
        let carriers: Vec<&str> = carriers.iter().map(String::as_str).collect();
        let wholes = self.wholes.get(&entry.id).into_iter().flatten();
        let wholes = sentence("Part of", &wholes.map(String::as_str).collect::<Vec<_>>(), here);
        let behind = [wholes, sentence("Carried by", &carriers, here)];
        first.into_iter().flatten().chain(behind).filter(|one| !one.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

/// The sentence about the type of an item's values.
fn values(ty: Option<&str>, here: Here<'_>) -> Option<String> {
    Some(format!("Values: {}.", here.code(&format!("types::{}", ty?))))
}

/// Whether a client can reach the objects: those that PDOs prove of a slave without CoE are nowhere but in its PDOs.
fn has_object_access(device: &Device) -> bool {
    let Some(ethercat) = &device.ethercat else { return true };
    let coe = ethercat.mailbox.as_ref().is_some_and(|mailbox| mailbox.coe.is_some());
    coe || device.groups.iter().any(|group| group.origin.line > 0)
}

/// `Carried by …, … and 3 more.`; empty where there is nothing to list.
fn sentence(start: &str, paths: &[&str], here: Here<'_>) -> String {
    if paths.is_empty() {
        return String::new();
    }
    // Constants of objects share their names; modules at the device's place tell nothing.
    let name = |path: &str| {
        let path = path.split_once('@').map_or(path, |(_, path)| path);
        path.split_once("::").map_or(path, |(_, name)| name).to_owned()
    };
    let shown: Vec<String> = paths.iter().take(LISTED).map(|path| here.code_as(&name(path), path)).collect();
    let more = match paths.len() {
        all if all > LISTED => format!(" and {} more", all - LISTED),
        _ => String::new(),
    };
    format!("{start} {}{more}.", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative() {
        let object = Here::new("super::super::", "objects::identity::");
        assert_eq!(object.code("objects::identity::VENDOR_ID"), "[`VENDOR_ID`]");
        assert_eq!(object.code("Drive::speed"), "[`speed`](super::super::Drive::speed)");
        assert_eq!(Here::TOP.whole("objects::SPEED"), "[`objects::SPEED`]");
        assert_eq!(Here::TYPES.code("types::Mode"), "[`Mode`]");
        assert_eq!(Here::BESIDE.code("types::Mode"), "[`Mode`](super::types::Mode)");
        assert_eq!(Here::OBJECTS.code("const@objects::_1"), "[`_1`](const@_1)");
        assert_eq!(Here::TOP.whole("const@objects::_1"), "[`objects::_1`](const@objects::_1)");
    }

    #[test]
    fn a_text_that_is_the_path_is_a_link_by_itself() {
        assert_eq!(Here::OBJECTS.text("speed", "objects::SPEED"), "[speed](SPEED)");
        assert_eq!(Here::OBJECTS.text("P\\_1", "objects::P_1"), "[`P_1`]");
        assert_eq!(Here::OBJECTS.text("", "objects::P_1"), "[`P_1`]");
        assert_eq!(Here::TYPES.text("P\\_1", "objects::P_1"), "[P\\_1](super::objects::P_1)");
    }

    #[test]
    fn long_lists_are_cut() {
        let names: Vec<String> = (0..10).map(|number| format!("pdo::P{number}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let listed = sentence("Carried by", &names, Here::PDO);
        assert!(listed.starts_with("Carried by [`P0`], [`P1`]") && listed.ends_with("[`P7`] and 2 more."), "{listed}");
        assert_eq!(sentence("Of", &[], Here::PDO), "");
        let of_object = sentence("Of", &["objects::store::SAVE"], Here::TYPES);
        assert_eq!(of_object, "Of [`store::SAVE`](super::objects::store::SAVE).");
    }
}
