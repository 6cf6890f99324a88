//! Links in documentation, and the paths to the generated Rust elements to which they lead.
//!
//! Paths are relative, so they stay valid if the generated module is moved.

use super::located::Located;
use super::naming::composites::NamedComposite;
use super::naming::handles::{constant, constant_path, is_cased, HandleNames, NamedItem};
use super::naming::pdos::{NamedField, NamedPdo};
use super::naming::Names;
use super::options::RustOptions;
use super::scope::Scope;
use crate::collections::HashMap;
use crate::ir::{Device, ElementId, ItemId, MessageId, PdoEntryKind, Type};

/// The module that contains a doc comment. Links in the comment are relative to this module.
#[derive(Clone, Copy, Debug)]
pub(super) struct DocModule<'h> {
    /// Path from this module to the device's module: `super::`.
    outer: &'h str,
    /// Path from the device's module to this module: `objects::`.
    module: &'h str,
}

impl<'h> DocModule<'h> {
    /// The module of the device itself.
    pub const TOP: DocModule<'static> = DocModule::new("", "");
    pub const OBJECTS: DocModule<'static> = DocModule::new("super::", "objects::");
    pub const TYPES: DocModule<'static> = DocModule::new("super::", "types::");
    /// The module of PDO structs. The documentation of PDO views also uses this constant, because the module of views
    /// has the same path to the device's module.
    pub const PDO: DocModule<'static> = DocModule::new("super::", "pdo::");
    #[cfg(feature = "messages")]
    pub const MESSAGES: DocModule<'static> = DocModule::new("super::", "messages::");
    /// Any other module in the device's module. All links in its comments lead through `super::`.
    pub const OTHER: DocModule<'static> = DocModule::new("super::", "::");

    const fn new(outer: &'h str, module: &'h str) -> Self {
        DocModule { outer, module }
    }

    /// Returns whether this module is that of the device itself.
    pub fn is_top(self) -> bool {
        self.outer.is_empty()
    }

    /// Returns whether a path leads to an element in this module. Returns `false` for the module of the device itself.
    fn is_of(self, path: &str) -> bool {
        !self.is_top() && path.starts_with(self.module)
    }

    /// Converts a path relative to the device's module to a path relative to this module. A prefix before `@`
    /// distinguishes elements with the same name.
    fn path(self, path: &str) -> String {
        let (kind, path) = path.split_once('@').map_or(("", path), |(kind, path)| (kind, path));
        let at = if kind.is_empty() { "" } else { "@" };
        match path.strip_prefix(self.module) {
            Some(name) if kind.is_empty() && is_derive(name) => format!("type@{name}"),
            Some(name) if kind.is_empty() && is_in_primitive(name) => format!("self::{name}"),
            Some(name) => format!("{kind}{at}{name}"),
            None => format!("{kind}{at}{}{path}", self.outer),
        }
    }

    /// Returns a link whose text is the last name of the path, formatted as code.
    pub fn code(self, path: &str) -> String {
        self.code_as(last(path), path)
    }

    /// Returns a link whose text is `name`, formatted as code.
    pub fn code_as(self, name: &str, path: &str) -> String {
        let path = self.path(path);
        if path == name {
            format!("[`{name}`]")
        } else {
            format!("[`{name}`]({path})")
        }
    }

    /// Returns a link whose text is the whole relative path.
    pub fn whole(self, path: &str) -> String {
        let path = self.path(path);
        let shown = path.split_once('@').map_or(path.as_str(), |(_, shown)| shown);
        let shown = shown.strip_prefix("self::").unwrap_or(shown);
        match shown == path {
            true => format!("[`{path}`]"),
            false => format!("[`{shown}`]({path})"),
        }
    }

    /// Returns a link whose text is `text`. Markup in `text` must be escaped.
    pub fn text(self, text: &str, path: &str) -> String {
        let relative = self.path(path);
        // Rustdoc warns about an explicit path that is equal to the text of the link.
        if text.is_empty() || relative == text.replace('\\', "") {
            return self.code(path);
        }
        format!("[{text}]({relative})")
    }
}

/// Returns a link to a type in the same module.
pub(super) fn sibling(name: &str) -> String {
    match is_derive(name) {
        true => format!("[`{name}`](type@{name})"),
        false => format!("[`{name}`]"),
    }
}

/// Returns whether a type has the name of a derive macro in the prelude. Links to such a type must state that they mean
/// the type.
pub(super) fn is_derive(name: &str) -> bool {
    const DERIVES: [&str; 9] = ["Clone", "Copy", "Debug", "Default", "Eq", "Hash", "Ord", "PartialEq", "PartialOrd"];
    DERIVES.contains(&name)
}

/// Returns whether rustdoc would look for the element at this path in a primitive type, such as the element of an object
/// with the name `unit`. The path then needs the prefix `self::`.
fn is_in_primitive(path: &str) -> bool {
    const PRIMITIVES: [&str; 10] =
        ["array", "f128", "f16", "fn", "never", "pointer", "reference", "slice", "tuple", "unit"];
    path.split_once("::").is_some_and(|(object, _)| PRIMITIVES.contains(&object))
}

/// Returns the last component of a path.
fn last(path: &str) -> &str {
    path.rsplit(['@', ':']).next().unwrap_or(path)
}

/// Paths of an item's constant and accessor, relative to the device's module.
#[derive(Clone, Debug)]
struct Handle {
    constant: String,
    /// Path of the item's accessor.
    method: Option<String>,
}

/// Maximum number of elements that a sentence lists.
const LISTED: usize = 8;

/// The paths of items and messages in the generated code of a device or module, and the relations between items, types,
/// PDOs and composite numbers. The paths are relative to the device's module.
#[derive(Debug, Default)]
pub(super) struct Links {
    handles: HashMap<ItemId, Handle>,
    /// For each object, the names of the PDO structs that contain it by default.
    carriers: HashMap<(u16, u8), Vec<String>>,
    /// The items that use each type, keyed by the position of the type in the list of types.
    users: HashMap<u32, Vec<ItemId>>,
    /// Paths of message types. Each path leads to the type of the request, or to the type of the reply if only the
    /// device sends the message.
    messages: HashMap<MessageId, String>,
    /// For each item, the names of the constants for the composite numbers of which the item is a part.
    wholes: HashMap<ItemId, Vec<String>>,
    /// True if the device's type has methods.
    pub has_methods: bool,
}

impl Links {
    /// Collects the paths of items and messages, and the relations. `device_name` is the name of the device's type.
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

    /// Adds the paths of messages. Returns whether any message has a request.
    #[cfg(feature = "messages")]
    fn add_messages(&mut self, names: &Names<'_>) -> bool {
        self.messages = names.messages.paths().collect();
        names.messages.shapes.iter().any(|shape| !shape.message.request.is_empty())
    }

    fn add_handles(&mut self, scope: &Scope<'_>, names: &HandleNames<'_>, device: Option<&str>) {
        for register in &names.registers {
            self.add_handle(scope, &register.entry, device);
        }
        for object in &names.objects {
            for entry in &object.entries {
                let Some(accessors) = &object.accessors else {
                    self.add_handle(scope, entry, device);
                    continue;
                };
                let constant = constant_path(Some(&object.name), &constant(&entry.name));
                let method = device.map(|_| format!("objects::{accessors}::{}", entry.name));
                self.add(scope, entry, Handle { constant, method });
            }
        }
    }

    fn add_handle(&mut self, scope: &Scope<'_>, entry: &NamedItem<'_>, device: Option<&str>) {
        let name = &entry.name;
        // If the name has no letters, the type of an object may have the same name, so the link must state that it means
        // the constant.
        let kind = if is_cased(name) { "" } else { "const@" };
        let constant = format!("{kind}{}", constant_path(None, &constant(name)));
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

    /// Returns the path of an item's constant or a message's type.
    pub fn path(&self, id: ElementId) -> Option<&str> {
        match id {
            ElementId::Item(id) => Some(&self.handles.get(&id)?.constant),
            ElementId::Message(id) => self.messages.get(&id).map(String::as_str),
        }
    }

    /// Returns a sentence about the items that use the type at `position` in the list of types. The sentence is empty
    /// if none of these items has a handle.
    pub fn users(&self, position: u32, doc_module: DocModule<'_>) -> String {
        let users = self.users.get(&position).map_or(&[][..], Vec::as_slice);
        let paths = users.iter().filter_map(|id| Some(self.handles.get(id)?.constant.as_str()));
        sentence("Value type of", &paths.collect::<Vec<_>>(), doc_module)
    }

    /// Returns the sentences that link the documentation of an item's accessor to the item's constant and type, and to
    /// the composite numbers and PDOs that contain the item.
    pub fn related_to_method(&self, entry: &NamedItem<'_>, ty: Option<&str>, doc_module: DocModule<'_>) -> String {
        let constant = self.path(entry.id.into()).map(|path| format!("Constant: {}.", doc_module.whole(path)));
        self.related(entry, [constant, values(ty, doc_module)], doc_module)
    }

    /// Returns the sentences that link the documentation of an item's constant to the item's accessor and type, and to
    /// the composite numbers and PDOs that contain the item.
    pub fn related_to_constant(&self, entry: &NamedItem<'_>, ty: Option<&str>, doc_module: DocModule<'_>) -> String {
        let method = self.handles.get(&entry.id).and_then(|handle| handle.method.as_ref());
        let link = |path: &String| if doc_module.is_of(path) { doc_module.whole(path) } else { doc_module.code(path) };
        let method = method.map(|path| format!("Accessor: {}.", link(path)));
        self.related(entry, [method, values(ty, doc_module)], doc_module)
    }

    fn related(&self, entry: &NamedItem<'_>, first: [Option<String>; 2], doc_module: DocModule<'_>) -> String {
        let carriers = entry.item.object().and_then(|object| self.carriers.get(&object));
        let carriers: Vec<String> = carriers.into_iter().flatten().map(|name| format!("pdo::{name}")).collect();
        let carriers: Vec<&str> = carriers.iter().map(String::as_str).collect();
        let wholes = self.wholes.get(&entry.id).into_iter().flatten();
        let wholes: Vec<&str> = wholes.map(String::as_str).collect();
        let wholes = sentence("Part of the composite number", &wholes, doc_module);
        let last = [wholes, sentence("Mapped in", &carriers, doc_module)];
        first.into_iter().flatten().chain(last).filter(|sentence| !sentence.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

/// Returns a sentence with a link to the enumeration or bit field `ty`. Returns `None` if `ty` is `None`.
fn values(ty: Option<&str>, doc_module: DocModule<'_>) -> Option<String> {
    Some(format!("Value type: {}.", doc_module.code(&format!("types::{}", ty?))))
}

/// Returns whether a client can access the objects. Objects that were derived from the PDOs of a slave without CoE are
/// accessible only as process data.
fn has_object_access(device: &Device) -> bool {
    let Some(ethercat) = &device.ethercat else { return true };
    let coe = ethercat.mailbox.as_ref().is_some_and(|mailbox| mailbox.coe.is_some());
    coe || device.groups.iter().any(|group| group.origin.line > 0)
}

/// Returns a sentence such as `Mapped in …, … and 3 more.`. The sentence is empty if there is nothing to list.
fn sentence(start: &str, paths: &[&str], doc_module: DocModule<'_>) -> String {
    if paths.is_empty() {
        return String::new();
    }
    // Constants of different objects may have the same name, so the name of the object is kept. The names of top-level
    // modules are omitted.
    let name = |path: &str| {
        let path = path.split_once('@').map_or(path, |(_, path)| path);
        path.split_once("::").map_or(path, |(_, name)| name).to_owned()
    };
    let shown: Vec<String> = paths.iter().take(LISTED).map(|path| doc_module.code_as(&name(path), path)).collect();
    let list = match (paths.len(), shown.as_slice()) {
        (all, _) if all > LISTED => format!("{} and {} more", shown.join(", "), all - LISTED),
        (_, [first @ .., last]) if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => shown.concat(),
    };
    format!("{start} {list}.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative() {
        let objects = DocModule::OBJECTS;
        assert_eq!(objects.code("objects::identity::VENDOR_ID"), "[`VENDOR_ID`](identity::VENDOR_ID)");
        assert_eq!(objects.whole("objects::identity::VENDOR_ID"), "[`identity::VENDOR_ID`]");
        assert_eq!(objects.whole("objects::unit::SPEED"), "[`unit::SPEED`](self::unit::SPEED)");
        assert_eq!(objects.code("Drive::speed"), "[`speed`](super::Drive::speed)");
        assert_eq!(DocModule::TOP.whole("objects::SPEED"), "[`objects::SPEED`]");
        assert_eq!(DocModule::TYPES.code("types::Mode"), "[`Mode`]");
        assert_eq!(DocModule::OTHER.code("types::Mode"), "[`Mode`](super::types::Mode)");
        assert_eq!(DocModule::OBJECTS.code("const@objects::_1"), "[`_1`](const@_1)");
        assert_eq!(DocModule::TOP.whole("const@objects::_1"), "[`objects::_1`](const@objects::_1)");
    }

    #[test]
    fn a_text_that_equals_the_path_needs_no_explicit_path() {
        assert_eq!(DocModule::OBJECTS.text("speed", "objects::SPEED"), "[speed](SPEED)");
        assert_eq!(DocModule::OBJECTS.text("P\\_1", "objects::P_1"), "[`P_1`]");
        assert_eq!(DocModule::OBJECTS.text("", "objects::P_1"), "[`P_1`]");
        assert_eq!(DocModule::TYPES.text("P\\_1", "objects::P_1"), "[P\\_1](super::objects::P_1)");
    }

    #[test]
    fn long_lists_are_cut() {
        let names: Vec<String> = (0..10).map(|number| format!("pdo::P{number}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let listed = sentence("Mapped in", &names, DocModule::PDO);
        assert!(listed.starts_with("Mapped in [`P0`], [`P1`]") && listed.ends_with("[`P7`] and 2 more."), "{listed}");
        assert_eq!(sentence("Of", &[], DocModule::PDO), "");
        let of_object = sentence("Of", &["objects::store::SAVE"], DocModule::TYPES);
        assert_eq!(of_object, "Of [`store::SAVE`](super::objects::store::SAVE).");
    }
}
