//! The plain data that the template writes down.

use std::collections::{BTreeMap, BTreeSet};

use super::axes::{self, AxesModel};
use super::bus_facts::{self, FactModel};
use super::code_table::{self, CodeTableModel};
use super::composite;
use super::docs;
use super::ethercat::{self, EtherCatModel, ModulePaths};
use super::given::{self, ConstantsModel, GivenModel};
use super::literal;
use super::manual::Manual;
use super::messages::ProtocolModel;
use super::named::Types;
use super::options::{Presence, RustOptions};
use super::pdo::{self, PdoModel};
use super::place::{Buses, Place as Address};
use super::procedure::{self, ProcedureModel};
use super::quantity;
use super::remap::{self, RemappableModel};
use super::scope::{ObjectBus, Scope};
use super::table::{self, EntryModel};
use super::value_type::ValueType;
use super::variant;
use super::window::{self, WindowModel};
use super::INTERFACE_VERSION;
use crate::ir::{Access, Device, FileInfo, Group, GroupKind, Item, Module, ObjectCode, Value};
use crate::passes::names_unique::{self, Case, Wish};

/// Where a device's code stands.
#[derive(Default)]
pub(super) struct Place {
    /// How far its lines are moved to the right.
    pub nest: usize,
    /// The paths of modules, as seen from the device.
    pub modules: ModulePaths,
}

/// A device, ready to be written.
pub(super) struct Model<'a> {
    pub options: &'a RustOptions,
    pub interface_version: u32,
    /// How far the lines are moved to the right.
    pub nest: usize,
    pub device_name: String,
    pub title: String,
    /// Who made the device; a module of a modular device has none.
    pub identity: Option<IdentityModel>,
    /// Whether there is a type of the device with accessor methods.
    pub has_accessors: bool,
    /// The type of the handles' location; of several, the one with all buses.
    pub location: String,
    /// Whether handles have several types of locations.
    pub has_locations: bool,
    /// Locations that the runtime has no name for: name, documentation and type.
    pub locations: Vec<(String, String, String)>,
    /// Functions that make locations which several items have: name, parameters, type and body.
    pub makers: Vec<(String, String, String, String)>,
    /// The windows through which items are found.
    pub windows: Vec<WindowModel>,
    /// What the handles are of, and what one of them is of at the start of a sentence and within it.
    pub handles: [&'static str; 3],
    pub types: Types,
    pub code_tables: Vec<CodeTableModel>,
    /// Procedures that are nothing but writes of objects.
    pub procedures: Vec<ProcedureModel>,
    pub axes: Option<AxesModel>,
    /// Constants of the device's models.
    pub models: Vec<ConstantsModel>,
    /// What only whoever builds the machine knows.
    pub given: Option<GivenModel>,
    /// Requests and replies.
    pub protocol: Option<ProtocolModel>,
    pub node_id: Option<u8>,
    /// What is known of Modbus and of numbers of nodes.
    pub bus_facts: Vec<FactModel>,
    pub accessor_derives: Vec<String>,
    /// Lints that a name of the dictionary would trip over.
    pub method_allow: Option<String>,
    pub objects: Vec<ObjectModel>,
    pub aliases: Vec<Alias>,
    /// Private names of the types of handles: name, access and arguments.
    pub handle_types: Vec<(String, &'static str, String)>,
    pub pdos: Vec<PdoModel>,
    /// PDOs that can be mapped anew.
    pub remappable: Vec<RemappableModel>,
    /// Whether there are views of PDOs within a process image.
    pub has_views: bool,
    pub ethercat: Option<EtherCatModel>,
    /// `MODULE` of a module.
    pub module: Option<String>,
    pub table: Option<Vec<EntryModel>>,
    pub table_feature: Option<String>,
}

pub(super) struct IdentityModel {
    pub vendor_id: String,
    pub product_code: String,
    pub revision_number: String,
    pub vendor_name: String,
    pub product_name: String,
    pub order_code: String,
}

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

/// An entry.
pub(super) struct ItemModel {
    pub constant: String,
    pub method: String,
    pub docs: Vec<String>,
    pub heading: String,
    pub access: &'static str,
    /// The type of the value and, where there are others, that of the location, as the handle's place names them, and as
    /// the device's does.
    pub arguments: String,
    pub arguments_at_top: String,
    /// The private name of the handle's type: one without parameters, so that `rustc` has nothing to infer.
    pub alias: String,
    /// The call that makes the handle, without its type.
    pub constructor: String,
    /// Whether a literal may resemble a mathematical constant.
    pub real: bool,
    /// The object on the bus of the PDOs.
    pub object: Option<(u16, u8)>,
    /// The arguments of the type that says how it is mapped into PDOs.
    pub mappable: Option<String>,
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
    pub(super) fn at_client(&self) -> String {
        const LONG: usize = 48;
        match self.constant.len() > LONG {
            true => format!("rt::Item::at(«objects::{}¦ &mut self.client»)", self.constant),
            false => format!("objects::{}.at(&mut self.client)", self.constant),
        }
    }
}

/// A short name of the handles with one access.
pub(super) struct Alias {
    pub name: &'static str,
    pub marker: &'static str,
    pub text: &'static str,
}

/// Names that modules and methods of objects must not have: the device's own, and those that would hide a primitive
/// type or the runtime.
const RESERVED: [&str; 28] = [
    "types",
    "new",
    "axis",
    "client",
    "into_client",
    "objects",
    "pdo",
    "rt",
    "bool",
    "char",
    "str",
    "u8",
    "u16",
    "u32",
    "u64",
    "u128",
    "usize",
    "i8",
    "i16",
    "i32",
    "i64",
    "i128",
    "isize",
    "f32",
    "f64",
    "self",
    "super",
    "crate",
];

/// Names that a device with messages uses itself, too.
const BESIDE_MESSAGES: [&str; 3] = ["messages", "on", "after_power_on"];

/// The generated module uses these names itself.
const RESERVED_FOR_DEVICE: [&str; 6] = ["Self", "C", "S", "X", "Option", "Result"];

/// Constants of an object have nothing to clash with.
const RESERVED_IN_OBJECT: [&str; 4] = ["self", "super", "crate", "rt"];

impl<'a> Model<'a> {
    /// A device.
    pub(super) fn new(device: &'a Device, file: &'a FileInfo, options: &'a RustOptions, place: &Place) -> Self {
        let (scope, types) = Scope::of_device(device, options);
        let procedures = procedure::models(&scope, device);
        let given = given::model(&scope, device, options);
        let models = given::constants(&scope, device);
        let (mut model, protocol) = Model::of_scope(scope, types, options);
        model.procedures = procedures;
        model.models = models;
        model.given = given;
        let title = title(device);
        model.nest = place.nest;
        model.device_name = device_name(device, file, options.device_name.as_deref());
        model.title = docs::escape(&title);
        model.identity = (!device.dictionary_only).then(|| IdentityModel::new(device));
        let has_calls = protocol.as_ref().is_some_and(|own| !own.calls.is_empty());
        model.has_accessors =
            options.accessors && (!model.objects.is_empty() && has_object_access(device) || has_calls);
        model.ethercat = EtherCatModel::new(device, &model.pdos, &place.modules, place.nest);
        model.code_tables = code_table::models(&device.code_tables, &Manual::of(device), options);
        model.axes = axes::model(device, place.nest);
        model.protocol = protocol;
        model.bus_facts = bus_facts::models(device, place.nest);
        model.bus_facts.extend(composite::models(&device.composites, place.nest));
        model.node_id = device.commissioning.as_ref().and_then(|own| own.node_id);
        model
    }

    /// A module of a modular device.
    pub(super) fn of_module(module: &'a Module, options: &'a RustOptions, nest: usize) -> Self {
        let (scope, types) = Scope::of_module(module, options);
        let (mut model, _) = Model::of_scope(scope, types, options);
        model.title = docs::escape(&module.name);
        model.module = Some(ethercat::module(module, &model.pdos, nest));
        model
    }

    /// What a scope has, and the protocol of one that is a device.
    fn of_scope(scope: Scope<'a>, types: Types, options: &'a RustOptions) -> (Self, Option<ProtocolModel>) {
        let locations = Locations::of(&scope);
        let mut objects = objects(&scope, &locations);
        let aliases = ALIASES.iter().filter(|alias| uses(&objects, alias.name)).copied().collect();
        let handle_types = handle_types(&objects);
        let pdos = if options.pdos { pdo::models(&scope, options) } else { Vec::new() };
        let remappable = if options.pdos { remap::models(&scope, &mut objects) } else { Vec::new() };
        let taken = objects.iter().map(|object| object.name.trim_start_matches("r#"));
        let taken: Vec<&str> = taken.chain(RESERVED).chain(BESIDE_MESSAGES).collect();
        let protocol = ProtocolModel::new(&scope, options, &types, &taken);
        let model = Model {
            handle_types,
            options,
            interface_version: INTERFACE_VERSION,
            nest: 0,
            device_name: String::new(),
            title: String::new(),
            identity: None,
            has_accessors: false,
            location: locations.name(locations.all, ""),
            has_locations: locations.several,
            locations: locations.own(),
            makers: locations.makers(),
            windows: window::models(&scope.windows),
            handles: handles(&scope),
            types,
            code_tables: Vec::new(),
            procedures: Vec::new(),
            models: Vec::new(),
            given: None,
            axes: None,
            protocol: None,
            node_id: None,
            bus_facts: Vec::new(),
            accessor_derives: options.derives(false),
            method_allow: method_allow(objects.iter().map(|object| object.name.as_str())),
            ethercat: None,
            module: None,
            has_views: scope.bus == ObjectBus::CoE && !pdos.is_empty(),
            pdos,
            remappable,
            table: (options.table != Presence::Never).then(|| table::models(&scope)),
            table_feature: match &options.table {
                Presence::Feature(feature) => Some(literal::string(feature)),
                _ => None,
            },
            objects,
            aliases,
        };
        (model, protocol)
    }

    /// Whether the type of the device knows which request was sent last.
    pub(super) fn selects(&self) -> bool {
        self.protocol.as_ref().is_some_and(ProtocolModel::selects)
    }

    pub(super) fn size_hint(&self) -> usize {
        let items: usize = self.objects.iter().map(|object| object.items.len()).sum();
        4096 + items * 900 + self.pdos.len() * 4096 + self.table.as_ref().map_or(0, |table| table.len() * 400)
    }
}

/// Whether a client can reach the objects: those that PDOs prove of a slave without CoE are nowhere but in its PDOs.
fn has_object_access(device: &Device) -> bool {
    let Some(ethercat) = &device.ethercat else { return true };
    let coe = ethercat.mailbox.as_ref().is_some_and(|mailbox| mailbox.coe.is_some());
    coe || device.groups.iter().any(|group| group.origin.line > 0)
}

/// The file's own name, without the folders that lead to it on this machine.
pub(super) fn file_name(file: &FileInfo) -> String {
    let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
    name.chars().map(|letter| if literal::is_harmless(letter) { letter } else { ' ' }).collect()
}

fn title(device: &Device) -> String {
    let identity = &device.identity;
    match (identity.vendor_name.is_empty(), device.name.is_empty()) {
        (false, false) => format!("{} {}", identity.vendor_name, device.name),
        (true, false) => device.name.to_string(),
        (false, true) => format!("a device of {}", identity.vendor_name),
        (true, true) => "the device".to_owned(),
    }
}

/// The name of the device's type: the caller's, the product's, or the file's.
pub(super) fn device_name(device: &Device, file: &FileInfo, chosen: Option<&str>) -> String {
    name_of(device, file, chosen, Case::Pascal)
}

/// The name of the device's module.
pub(super) fn module_name(device: &Device, file: &FileInfo) -> String {
    name_of(device, file, None, Case::Snake)
}

fn name_of(device: &Device, file: &FileInfo, chosen: Option<&str>, case: Case) -> String {
    let stem = file_name(file);
    let stem = stem.rsplit_once('.').map_or(stem.as_str(), |(stem, _)| stem);
    // The order code of a slave is what people call it; its name is a sentence.
    let short = if device.ethercat.is_some() { device.identity.order_code.as_str() } else { "" };
    let names = [chosen.unwrap_or(""), short, &device.name, stem, "device"];
    let wish = |name| Wish { name, fallback: String::new(), suffix: "Device".into() };
    let candidates =
        names.iter().map(|name| names_unique::unique(&[wish(*name)], &RESERVED_FOR_DEVICE, case).remove(0));
    let name = candidates.into_iter().find(|name| !name.is_empty() && name != "_device").unwrap_or_default();
    names_unique::escaped(&name)
}

/// A file's stem as the name of a module.
pub(super) fn stem_name(stem: &str) -> Option<String> {
    let wish = Wish { name: stem, fallback: String::new(), suffix: "device".into() };
    let name = names_unique::unique(&[wish], &RESERVED_IN_OBJECT, Case::Snake).remove(0);
    (!name.is_empty()).then_some(name)
}

impl IdentityModel {
    fn new(device: &Device) -> Self {
        let identity = &device.identity;
        let number = |value: Option<u32>| match value {
            Some(value) => format!("Some({value:#010X})").replace("0X", "0x"),
            None => "None".to_owned(),
        };
        IdentityModel {
            vendor_id: number(identity.vendor_id),
            product_code: number(identity.product_code),
            revision_number: number(identity.revision_number),
            vendor_name: literal::string(&identity.vendor_name),
            product_name: literal::string(&identity.product_name),
            order_code: literal::string(&identity.order_code),
        }
    }
}

impl Clone for Alias {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Alias {}

const ALIASES: [Alias; 4] = [
    Alias { name: "ReadOnly", marker: "rt::Ro", text: "that can be read" },
    Alias { name: "WriteOnly", marker: "rt::Wo", text: "that can be written" },
    Alias { name: "ReadWrite", marker: "rt::Rw", text: "that can be read and written" },
    Alias { name: "Constant", marker: "rt::Const", text: "that can be read and never changes" },
];

fn alias(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "ReadOnly",
        Access::WriteOnly => "WriteOnly",
        Access::Constant => "Constant",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "ReadWrite",
    }
}

/// Each type of a handle once, sorted by name.
fn handle_types(objects: &[ObjectModel]) -> Vec<(String, &'static str, String)> {
    let all = objects.iter().flat_map(|object| &object.items);
    let names: BTreeMap<&str, &ItemModel> = all.map(|item| (item.alias.as_str(), item)).collect();
    // They stand beside the modules of objects, one level below the device.
    let arguments = |item: &ItemModel| {
        let arguments = item.arguments_at_top.replace("¦ objects::", "¦ ");
        if arguments.starts_with("types::") {
            format!("super::{arguments}")
        } else {
            arguments
        }
    };
    names.into_iter().map(|(name, item)| (name.to_owned(), item.access, arguments(item))).collect()
}

fn uses(objects: &[ObjectModel], alias: &str) -> bool {
    objects.iter().flat_map(|object| &object.items).any(|item| item.access == alias)
}

/// Objects that have values to read or write; the definitions of types have none.
pub(super) fn addressable<'a>(scope: &Scope<'a>) -> impl Iterator<Item = &'a Group> + use<'a> {
    scope.groups.iter().filter(|group| {
        let is_type =
            matches!(group.object_code(), Some(ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null));
        group.index().is_some() && !is_type && !group.items.is_empty()
    })
}

/// The items of chapters and images that a client can reach, with the titles of those.
pub(super) fn registers<'a>(scope: &Scope<'a>) -> Vec<(&'a str, &'a Item)> {
    let is_chapter = |group: &&Group| matches!(group.kind, GroupKind::Chapter | GroupKind::Image { .. });
    let chapters = scope.groups.iter().filter(is_chapter);
    // An image is told with the place of its fields.
    let title = |group: &'a Group| if group.kind == GroupKind::Chapter { group.name.as_str() } else { "" };
    let items = chapters.flat_map(|group| group.items.iter().map(move |item| (title(group), item)));
    items.filter(|(_, item)| !Address::of(scope, item).buses().is_empty()).collect()
}

/// Where the windows are, as seen from the handles.
const WINDOWS: &str = "super::windows::";

/// The name of the function that makes a location.
fn maker(at: usize) -> String {
    format!("place_{}", at + 1)
}

/// The buses on which items are found.
struct Locations {
    /// All of them.
    all: Buses,
    /// Whether not every item is on all of them.
    several: bool,
    /// Those of each item, each once.
    each: BTreeSet<Buses>,
    /// What makes the locations that several items have: body, parameters and type.
    makers: Vec<(String, String, Buses)>,
}

impl Locations {
    fn of(scope: &Scope<'_>) -> Self {
        let objects = addressable(scope).flat_map(|group| &group.items);
        let items = objects.chain(registers(scope).into_iter().map(|(_, item)| item));
        let mut makers: BTreeMap<(String, String), (usize, Buses)> = BTreeMap::new();
        let buses = items.map(|item| {
            let address = Address::of(scope, item);
            if let Some(own) = address.maker(scope, WINDOWS) {
                makers.entry((own.body, own.parameters)).or_insert((0, address.buses())).0 += 1;
            }
            address.buses()
        });
        let buses: Vec<Buses> = buses.collect();
        let makers = makers.into_iter().filter(|(_, (count, _))| *count > 1);
        let makers = makers.map(|((body, parameters), (_, buses))| (body, parameters, buses)).collect();
        let mut each: BTreeMap<Buses, usize> = BTreeMap::new();
        for own in &buses {
            *each.entry(*own).or_default() += 1;
        }
        // What most items have, unless all are addresses, and some have all of them.
        let all = match each.keys().all(|own| own.is_direct()) {
            true => each.keys().fold(Buses::default(), |all, own| all.union(*own)),
            false => each.iter().max_by_key(|(_, count)| **count).map_or(Buses::default(), |(own, _)| *own),
        };
        Locations {
            several: buses.iter().any(|own| *own != all),
            all,
            each: each.into_keys().chain([all]).collect(),
            makers,
        }
    }

    /// The functions that make locations.
    fn makers(&self) -> Vec<(String, String, String, String)> {
        let named = self.makers.iter().enumerate();
        named
            .map(|(at, (body, parameters, buses))| (maker(at), parameters.clone(), self.name(*buses, ""), body.clone()))
            .collect()
    }

    /// The code of an item's location; `outer` leads from the handle's place to the device's.
    fn code(&self, scope: &Scope<'_>, address: &Address<'_>, outer: &str) -> String {
        let own = address.maker(scope, WINDOWS);
        let found = own.and_then(|own| {
            let at = self
                .makers
                .iter()
                .position(|(body, parameters, _)| *body == own.body && *parameters == own.parameters)?;
            Some(format!("{}{}(«{}»)", outer.strip_prefix("super::").unwrap_or(outer), maker(at), own.arguments))
        });
        found.unwrap_or_else(|| address.code(scope, &format!("{outer}windows::")))
    }

    /// The name of a location's type; `outer` leads from where it stands to the device's place.
    fn name(&self, buses: Buses, outer: &str) -> String {
        match buses.path() {
            Some(path) => path.to_owned(),
            None => format!("{outer}{}", buses.word()),
        }
    }

    /// The locations that the runtime has no name for.
    fn own(&self) -> Vec<(String, String, String)> {
        let unnamed = self.each.iter().filter(|own| own.path().is_none() && !own.is_empty());
        let docs = |own: &Buses| format!("The location of what is found on {}.", own.titles());
        unnamed.map(|own| (own.word(), docs(own), own.written_out())).collect()
    }

    /// What follows the type of a value where handles of several locations exist.
    fn argument(&self, buses: Buses, outer: &str) -> String {
        if buses == self.all {
            return String::new();
        }
        // They stand beside the handles.
        let outer = match outer {
            "" => "objects::",
            outer => outer.strip_prefix("super::").unwrap_or(outer),
        };
        format!("¦ {}", self.name(buses, outer))
    }
}

fn handles(scope: &Scope<'_>) -> [&'static str; 3] {
    let has_objects = addressable(scope).next().is_some();
    match (registers(scope).is_empty(), has_objects) {
        (true, _) => ["entry of the object dictionary", "An entry", "an entry"],
        (false, true) => {
            ["register and every entry of the object dictionary", "A register or an entry", "a register or an entry"]
        }
        (false, false) => ["register", "A register", "a register"],
    }
}

/// The registers of the chapters, and then the objects.
fn objects(scope: &Scope<'_>, locations: &Locations) -> Vec<ObjectModel> {
    let registers = registers(scope);
    let groups: Vec<&Group> = addressable(scope).collect();
    let register_wish = |(_, item): &(&'_ str, &'_ Item)| (item.name.clone(), Address::of(scope, item).suffix());
    let named: Vec<_> = registers.iter().map(register_wish).collect();
    let mut wishes: Vec<Wish<'_>> = named
        .iter()
        .map(|(name, suffix)| Wish { name, fallback: format!("register {suffix}"), suffix: suffix.clone() })
        .collect();
    wishes.extend(groups.iter().map(|group| {
        let index = group.index().unwrap_or(0);
        Wish { name: &group.name, fallback: format!("object {index:04X}"), suffix: format!("{index:04X}") }
    }));
    let has_messages = scope.device.is_some_and(|device| !device.messages.is_empty());
    let reserved: Vec<&str> =
        RESERVED.into_iter().chain(BESIDE_MESSAGES.into_iter().filter(|_| has_messages)).collect();
    let mut names = names_unique::unique(&wishes, &reserved, Case::Snake).into_iter();
    let mut models = Vec::with_capacity(wishes.len());
    for ((chapter, own), name) in registers.iter().zip(&mut names) {
        models.push(register(scope, locations, chapter, own, &name));
    }
    models.extend(groups.iter().zip(names).map(|(group, name)| object(scope, locations, group, name)));
    models
}

fn register(scope: &Scope<'_>, locations: &Locations, chapter: &str, own: &Item, name: &str) -> ObjectModel {
    let mut model = item(scope, locations, own, name, &own.name, "super::");
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

pub(super) fn is_module(group: &Group) -> bool {
    group.object_code().is_some_and(ObjectCode::has_subs) || group.items.len() != 1
}

fn object(scope: &Scope<'_>, locations: &Locations, group: &Group, name: String) -> ObjectModel {
    let index = group.index().unwrap_or(0);
    let address = format!("0x{index:04X}");
    let title = if group.name.trim().is_empty() { address.clone() } else { docs::escape(&group.name) };
    let is_module = is_module(group);
    let items = if is_module {
        sub_items(scope, locations, group)
    } else {
        let only = group.items.iter().map(|only| item(scope, locations, only, &name, &group.name, "super::"));
        only.collect()
    };
    let code = group.object_code().map_or("", ObjectCode::name);
    ObjectModel {
        docs: vec![docs::sentence(&title), String::new(), format!("{code} {address}.")],
        heading: heading(&group.name, &address),
        method_allow: method_allow(items.iter().map(|item| item.method.as_str())),
        name: names_unique::escaped(&name),
        items,
        is_module,
    }
}

fn sub_items(scope: &Scope<'_>, locations: &Locations, group: &Group) -> Vec<ItemModel> {
    let wishes: Vec<Wish<'_>> = group
        .items
        .iter()
        .map(|item| {
            let sub = item.object().map_or(0, |(_, sub)| sub);
            Wish { name: &item.name, fallback: format!("sub {sub}"), suffix: sub.to_string() }
        })
        .collect();
    let names = names_unique::unique(&wishes, &RESERVED_IN_OBJECT, Case::Snake);
    let items = group.items.iter().zip(names);
    items.map(|(sub, name)| item(scope, locations, sub, &name, &sub.name, "super::super::")).collect()
}

fn heading(name: &str, address: &str) -> String {
    match name.trim() {
        "" => format!("{address}."),
        name => format!("{}: {address}.", docs::escape(name).trim_end_matches('.')),
    }
}

/// `outer` leads from the handle's place to the device's.
fn item(scope: &Scope<'_>, locations: &Locations, item: &Item, name: &str, original: &str, outer: &str) -> ItemModel {
    let address = Address::of(scope, item);
    let named = scope.enumeration(item.ty);
    // The number below an enumeration may be a truth value, which its code writes as one bit.
    let ty = named.map_or_else(|| scope.value_type(item.ty), |named| ValueType::of(named.ty));
    let named = named.map(|named| named.name.as_str());
    let scaled = if named.is_none() { quantity::of(scope, item) } else { None };
    let path = |outer: &str| match (named, &scaled) {
        (Some(name), _) => format!("{outer}types::{name}"),
        (None, Some(scaled)) => scaled.path.clone(),
        (None, None) => ty.path().to_owned(),
    };
    let word = match (named, &scaled) {
        (Some(name), _) => format!("Named{name}"),
        (None, Some(scaled)) => scaled.word.clone(),
        (None, None) => ty.word(),
    };
    let argument = |outer: &str| locations.argument(address.buses(), outer);
    let on = if argument("").is_empty() { String::new() } else { address.buses().word() };
    ItemModel {
        constant: name.to_ascii_uppercase(),
        method: names_unique::escaped(name),
        docs: docs::item(item, original, None, scope),
        heading: heading(original, &address.heading()),
        access: alias(item.access),
        arguments: format!("{}{}", path(outer), argument(outer)),
        arguments_at_top: format!("{}{}", path(""), argument("")),
        alias: format!("{}{word}{on}", alias(item.access)),
        constructor: constructor(
            &|| locations.code(scope, &address, outer),
            &address,
            item,
            (ty, &literal::string(original)),
            named.map(|_| path(outer)),
        ),
        real: ty.is_real() && (item.default.is_some() || !item.limits.is_empty()),
        object: address.object_on(scope.bus),
        mappable: None,
    }
}

/// The shortest call that says everything: every argument costs `rustc` a tenth of what the rest of the handle does.
fn constructor(
    location: &dyn Fn() -> String,
    address: &Address<'_>,
    item: &Item,
    (ty, name): (ValueType, &str),
    named: Option<String>,
) -> String {
    let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
    let wrap = |literal: String| match &named {
        Some(path) => format!("{path}::from_raw(«{literal}»)"),
        None => literal,
    };
    let (range, flags) = (ty.range_as(&variant::widest(item), &wrap), flags(item));
    // A truth value is the number of an enumeration.
    let number = item.default.as_ref().filter(|_| named.is_some()).and_then(Value::as_int).map(Value::Int);
    let default = number.as_ref().or(item.default.as_ref());
    let initial = ty.initial_as(default, &wrap);
    // Byte strings have the type of an array, which only a conversion of its own turns into a slice.
    let literal = default.and_then(|value| ty.literal(value));
    let literal = literal.filter(|_| !matches!(ty, ValueType::Bytes(_))).map(wrap);
    let is_plain = range == "rt::Range::Full" && unit.is_empty();
    let is_flagged = flags != "rt::Flags::NONE";
    if let Some((object, index, sub)) = address.only_object().filter(|_| is_plain) {
        let place = format!("0x{index:04X}¦ 0x{sub:02X}¦ {name}");
        match literal {
            None if initial == "rt::Initial::Unknown" && !is_flagged => return format!("{object}(«{place}»)"),
            None if initial == "rt::Initial::Unknown" => return format!("flagged_{object}(«{place}¦ {flags}»)"),
            Some(literal) if !is_flagged => return format!("{object}_with_default(«{place}¦ {literal}»)"),
            Some(literal) => return format!("flagged_{object}_with_default(«{place}¦ {flags}¦ {literal}»)"),
            None => {}
        }
    }
    if let Some(place) = address.with_register().filter(|_| initial == "rt::Initial::Unknown") {
        return match is_plain {
            true => format!("register(«{place}¦ {name}¦ {flags}»)"),
            false => {
                let unit = literal::string(unit);
                format!("register_within(«{place}¦ {name}¦ {range}¦ {unit}¦ {flags}»)")
            }
        };
    }
    format!("new(«{}¦ {name}¦ {range}¦ {initial}¦ {}¦ {flags}»)", location(), literal::string(unit))
}

pub(super) fn flags(item: &Item) -> &'static str {
    match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => "rt::Flags::PDO",
        (true, false) => "rt::Flags::RPDO",
        (false, true) => "rt::Flags::TPDO",
        (false, false) => "rt::Flags::NONE",
    }
}

/// The attribute that methods of these names need: clippy reads a meaning into some prefixes.
pub(super) fn method_allow<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    const PREFIXES: [&str; 5] = ["from_", "into_", "to_", "is_", "as_"];
    const TRAITS: [&str; 3] = ["next", "deref_mut", "borrow_mut"];
    let (mut conventions, mut traits) = (false, false);
    for name in names {
        conventions |= PREFIXES.iter().any(|prefix| name.starts_with(prefix));
        traits |= TRAITS.contains(&name);
    }
    match (conventions, traits) {
        (false, false) => None,
        (true, false) => Some("#[allow(clippy::wrong_self_convention)]".into()),
        (false, true) => Some("#[allow(clippy::should_implement_trait)]".into()),
        (true, true) => Some("#[allow(clippy::should_implement_trait, clippy::wrong_self_convention)]".into()),
    }
}
