//! The model of a device or module: plain data, ready to be printed.

use super::axes;
use super::bus_facts;
use super::cia402::Cia402Model;
use super::code::{seq, Declaration, Doc};
use super::code_table::{self, CodeTableModel};
use super::composite;
use super::configuration::{self, ConfigurationModel};
use super::constants::Constants;
use super::context::Context;
use super::device_models::{self, DeviceModel};
use super::device_names;
use super::docs;
use super::ethercat::{self, ImageModel, ModulePaths};
use super::example;
use super::given::{self, GivenModel};
use super::handle::{self, Alias};
use super::identity;
use super::links::Links;
use super::literal;
use super::located::Located;
use super::locations::Locations;
#[cfg(feature = "messages")]
use super::messages::ProtocolModel;
#[cfg(feature = "messages")]
use super::method_names::{reserved, RESERVED_WITH_MESSAGES};
use super::named::Types;
use super::naming::Names;
use super::objects::{self, ObjectModel};
use super::options::{Presence, RustOptions};
use super::pdo::{self, PdoModel};
use super::procedure;
use super::reexport::Reexport;
use super::remap::{self, RemappableModel};
use super::scope::{ObjectBus, Scope};
use super::table;
use super::walk::{self, WalkModel};
use super::window_model;
use crate::ir::{Device, FileInfo, Module};

/// Determines the addresses, names and links that the lowering needs.
pub(super) fn context<'a>(scope: Scope<'a>, options: &RustOptions, device_name: &str) -> Context<'a> {
    let located = Located::of(scope);
    let names = Names::of(&located);
    let links = Links::of(&located, &names, options, device_name);
    Context { located, names, links }
}

/// A device or module, ready to be printed.
#[derive(Default)]
pub(super) struct Model {
    pub device_name: String,
    pub title: String,
    /// Example at the beginning of the documentation of the device's type.
    pub example: Vec<String>,
    /// Constants and statics at the start of the module: identity, node-ID, facts about the buses, composite numbers,
    /// EtherCAT description and axes.
    pub constants: Vec<Declaration>,
    /// True if the device's type has accessor methods.
    pub has_accessors: bool,
    /// Default location type of the handles.
    pub location: String,
    /// True if the handles have several location types.
    pub has_locations: bool,
    /// Location types that are not part of the runtime: name, documentation and fields.
    pub locations: Vec<(String, String, Vec<Doc>)>,
    /// Functions that create the locations of several items: name, parameters, return type and body.
    pub makers: Vec<(String, Vec<String>, String, Doc)>,
    /// Windows through which some items are accessed.
    pub windows: Vec<Declaration>,
    /// Two noun phrases for items with handles: one to follow "every", and one to follow an adjective.
    pub handles: [&'static str; 2],
    pub types: Types,
    /// Methods that lead a state machine to a state.
    pub walks: Vec<WalkModel>,
    /// Objects of CiA 402 that the runtime uses for its CiA 402 operations.
    pub cia402: Option<Cia402Model>,
    pub code_tables: Vec<CodeTableModel>,
    /// Procedures that consist only of object writes.
    pub procedures: Vec<Declaration>,
    /// Names of the device models that have several axes, as a phrase. `None` if the device has a single axis.
    pub axes: Option<String>,
    /// Constants and items that differ between the models of the device.
    pub models: Vec<DeviceModel>,
    /// Constants of the machine that are not stored in the device, and the unit conversions that depend on them.
    pub given: Option<GivenModel>,
    /// Message protocol with requests and replies.
    #[cfg(feature = "messages")]
    pub protocol: Option<ProtocolModel>,
    /// Configured values of a DCF, XDC or network file.
    pub configuration: Option<ConfigurationModel>,
    pub accessor_derives: Vec<String>,
    pub objects: Vec<ObjectModel>,
    pub aliases: Vec<Alias>,
    /// Private aliases of handle types: name, access and arguments.
    pub handle_types: Vec<(String, &'static str, Vec<Doc>)>,
    pub pdos: Vec<PdoModel>,
    /// PDOs whose mapping a program can change.
    pub remappable: Vec<RemappableModel>,
    /// True if PDOs have views within a process image.
    pub has_views: bool,
    /// Default process images on EtherCAT.
    pub images: Vec<ImageModel>,
    /// Rows of the static table.
    pub table: Option<Vec<Doc>>,
    pub table_feature: Option<String>,
    /// True if the file has several devices or modules, which may re-export definitions from each other.
    pub is_one_of_several: bool,
    /// Definitions that the runtime or an earlier device or module of the file contains.
    pub reexports: Vec<Reexport>,
}

impl Model {
    /// Creates the model of a device. `modules` contains the paths of the modules' statics `MODULE`.
    pub(super) fn new(device: &Device, file: &FileInfo, options: &RustOptions, modules: &ModulePaths) -> Self {
        let device_name = device_names::device_name(device, file, options.device_name.as_deref());
        let context = context(Scope::of_device(device), options, &device_name);
        let mut model = Model::of_context(&context, options);
        #[cfg(feature = "messages")]
        {
            model.protocol = model.protocol_of(&context, options);
        }
        model.has_accessors = context.links.has_methods;
        model.example = example::lines(&context, &device_name, &model.walks);
        model.device_name = device_name;
        model.title = docs::escape(&device_names::title(device));
        model.procedures = procedure::models(&context, device);
        model.models = device_models::models(&context, device, &model.objects);
        model.given = given::model(&context, device, options);
        model.code_tables = code_table::models(&context, device, options);
        model.configuration = configuration::model(device, options);
        model.add_constants(&context, device, modules);
        model
    }

    fn add_constants(&mut self, context: &Context<'_>, device: &Device, modules: &ModulePaths) {
        let identity = (!device.dictionary_only).then(|| identity::constant(device, &self.title));
        let node_id = device.commissioning.as_ref().and_then(|commissioning| commissioning.node_id).map(|number| {
            let value = seq!["rt::NodeId::new(", number, ")"];
            let docs = "Node-ID of this device in the configuration file.";
            Declaration::new([docs], "const NODE_ID: Option<rt::NodeId>", value)
        });
        self.constants.extend(identity.into_iter().chain(node_id));
        self.constants.extend(bus_facts::models(device).chain(composite::models(context)));
        if let Some((constants, images)) = ethercat::device(device, &self.title, &self.pdos, modules) {
            self.constants.extend(constants);
            self.images = images;
        }
        if let Some((constant, models)) = axes::model(device) {
            self.constants.push(constant);
            self.axes = Some(models);
        }
    }

    /// Creates the model of a module of a modular device.
    pub(super) fn of_module(module: &Module, options: &RustOptions) -> Self {
        let context = context(Scope::of_module(module), options, "");
        let mut model = Model::of_context(&context, options);
        model.title = docs::escape(&module.name);
        model.constants.push(ethercat::module(module, &model.title, &model.pdos));
        model
    }

    /// Creates the parts of a model that both devices and modules have.
    fn of_context(context: &Context<'_>, options: &RustOptions) -> Self {
        let locations = Locations::of(context);
        let mut objects = objects::models(context, &locations);
        let pdos = if options.pdos { pdo::models(context, options) } else { Vec::new() };
        let types = Types::of(context, options);
        let remappable = if options.pdos { remap::models(context, &mut objects) } else { Vec::new() };
        let constants = Constants { context, locations: &locations, objects: &objects };
        let walks = walk::models(&constants, &types.machines);
        let cia402 = Cia402Model::new(&constants, &walks);
        Model {
            location: locations.name(locations.usual, ""),
            has_locations: locations.several,
            locations: locations.generated_types(),
            makers: locations.makers(),
            windows: window_model::models(context),
            handles: context.handles(),
            cia402,
            walks,
            types,
            accessor_derives: options.derives(false),
            aliases: handle::aliases(&objects),
            handle_types: handle::types(&objects),
            objects,
            has_views: context.bus == ObjectBus::CoE && !pdos.is_empty(),
            pdos,
            remappable,
            table: (options.table != Presence::Never).then(|| table::models(context)),
            table_feature: match &options.table {
                Presence::Feature(feature) => Some(literal::string(feature)),
                _ => None,
            },
            ..Model::default()
        }
    }

    /// Creates the message protocol. The device's type has the methods of the protocol and the accessors of the
    /// objects, so their names must differ.
    #[cfg(feature = "messages")]
    fn protocol_of(&self, context: &Context<'_>, options: &RustOptions) -> Option<ProtocolModel> {
        let objects = self.objects.iter().map(|object| object.name.trim_start_matches("r#"));
        let reserved: Vec<&str> = objects.chain(reserved()).chain(RESERVED_WITH_MESSAGES).collect();
        ProtocolModel::new(context, options, &self.types, &reserved)
    }

    /// Returns whether the device's type tracks which selecting request was sent last.
    pub(super) fn selects(&self) -> bool {
        #[cfg(feature = "messages")]
        return self.protocol.as_ref().is_some_and(ProtocolModel::selects);
        #[cfg(not(feature = "messages"))]
        false
    }
}
