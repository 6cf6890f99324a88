//! Random devices with an object dictionary, registers or messages, and their modules.

use lexibus_codegen::ir::{
    Binding, Catalog, CompactString, Device, Format, Graphic, Group, ModbusTable, Module, ModuleId, ModuleUse,
    ObjectBuses, ProcessData, RegisterSpace, SlotNumbers, SubExtension,
};

use super::bytes::Bytes;
use super::items::{self, Around, BOTH};
use super::machines;
use super::messages;
use super::names;
use super::process;
use super::profinet::identity;
use super::settings;
use super::types;

/// Returns the devices of an EDS, DCF, XDD, ESI or register table, with their modules.
pub fn catalog(b: &mut Bytes<'_>, format: Format) -> Catalog {
    let is_ethercat = format == Format::Esi;
    let modules = if format == Format::Table { Vec::new() } else { b.few(2, 3, |b| module(b, is_ethercat)) };
    let devices = if b.one_in(5) { 2 } else { 1 };
    let devices = (0..devices).map(|_| device(b, format, modules.len())).collect();
    let graphics = b.few(4, 2, |b| Graphic { id: names::name(b), file: names::path(b) });
    let vendor_names = names::texts(b);
    let vendor_urls = b.few(4, 2, names::text);
    let extensions = names::extensions(b);
    Catalog { devices, modules, graphics, vendor_names, vendor_urls, extensions, ..Catalog::default() }
}

fn device(b: &mut Bytes<'_>, format: Format, modules: usize) -> Device {
    let is_table = format == Format::Table;
    let is_ethercat = format == Format::Esi || is_table && b.one_in(3);
    let types = types::definitions(b, 10);
    let given = if is_table { b.few(2, 3, machines::given) } else { Vec::new() };
    let given_names: Vec<CompactString> = given.iter().map(|element| element.name.clone()).collect();
    let [images, spaces]: [Vec<CompactString>; 2] =
        if is_table { [0; 2].map(|_| b.list(2, names::name)) } else { Default::default() };
    let buses: &[ObjectBuses] = match format {
        Format::Table => &[BOTH, ObjectBuses::CANOPEN, ObjectBuses::COE],
        Format::Esi => &[ObjectBuses::COE],
        _ => &[ObjectBuses::CANOPEN],
    };
    let around = Around { types: &types, given: &given_names, images: &images, spaces: &spaces, buses, is_table };
    // Chapters have no index and come before the groups that have an index.
    let mut groups = if is_table { b.list(3, |b| items::chapter(b, &around)) } else { Vec::new() };
    groups.extend(items::objects(b, &around, 12));
    // EDS, DCF and XDD files declare no PDOs, because their objects determine the PDOs.
    let has_declared = is_table || is_ethercat;
    if !has_declared {
        let objects = items::pdo_objects(b, &groups);
        groups.retain(|group| objects.iter().all(|object| object.index() != group.index()));
        groups.extend(objects);
        groups.sort_by_key(Group::index);
    }
    let messages = if is_table { messages::messages(b, &around, 6) } else { Vec::new() };
    let mut process_data =
        if has_declared { process::data(b, &groups, &types, is_ethercat) } else { ProcessData::default() };
    process_data.images = images.iter().map(|name| process::image(b, name.clone(), &types, 0)).collect();
    let message_names: Vec<CompactString> = messages.iter().map(|element| element.name.clone()).collect();
    let device = Device {
        name: names::name(b),
        names: names::texts(b),
        id: names::name(b),
        dictionary_only: b.one_in(20),
        identity: identity(b),
        header: settings::header(b),
        canopen: if is_ethercat { None } else { b.maybe(2, |b| Box::new(settings::canopen(b))) },
        ethercat: is_ethercat.then(|| Box::new(settings::ethercat(b))),
        node_ids: b.maybe(4, |b| (b.within(0..=9), b.within(9..=255))),
        profiles: b.few(2, 2, |b| b.pick(&[402, 301, 401, 0])),
        commissioning: b.maybe(8, |b| Box::new(settings::commissioning(b))),
        process_data,
        slots: b.few(4, 2, settings::slot),
        modules: (0..modules as u32)
            .map(|at| ModuleUse { module: ModuleId(at), places: SlotNumbers::default() })
            .collect(),
        parameter_spaces: spaces.iter().map(|element| messages::space(b, element.clone(), &message_names)).collect(),
        framing: if is_table { b.maybe(3, |b| Box::new(messages::framing(b, &messages))) } else { None },
        given,
        code_tables: b.few(3, 2, machines::code_table),
        manual: b.maybe(4, names::manual).map(Box::new),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        extensions: names::extensions(b),
        groups,
        messages,
        types,
        ..Device::default()
    };
    if is_table || b.one_in(6) {
        with_behavior(b, device)
    } else {
        device
    }
}

/// Adds facts that only register tables contain.
fn with_behavior(b: &mut Bytes<'_>, device: Device) -> Device {
    let of_items = |group: &Group| group.items.iter().map(|item| item.name.clone()).collect::<Vec<_>>();
    let items: Vec<CompactString> = device.groups.iter().flat_map(of_items).collect();
    let types: Vec<CompactString> = device.types.iter().map(|element| element.name.clone()).collect();
    let messages: Vec<CompactString> = device.messages.iter().map(|element| element.name.clone()).collect();
    Device {
        modbus: b.few(2, 2, modbus),
        modbus_examples: b.few(6, 1, messages::example),
        machines: b.list(2, |b| machines::machine(b, &items, &types)),
        procedures: b.list(3, |b| machines::procedure(b, &items, &messages)),
        composites: b.few(3, 2, |b| machines::composite(b, &items)),
        variants: b.few(2, 3, machines::variant),
        axes: b.maybe(5, machines::axes),
        ..device
    }
}

fn modbus(b: &mut Bytes<'_>) -> ModbusTable {
    let spaces = [RegisterSpace::Holding, RegisterSpace::Input, RegisterSpace::Coil, RegisterSpace::DiscreteInput];
    ModbusTable {
        space: b.pick(&spaces),
        functions: b.list(3, |b| b.pick(&[3, 6, 16, 4, 0, 255])),
        max_read: b.any(),
        max_write: b.any(),
        split: b.any(),
    }
}

/// Returns a module of a modular EtherCAT slave or CANopen bus coupler.
fn module(b: &mut Bytes<'_>, is_ethercat: bool) -> Module {
    let types = types::definitions(b, 5);
    let buses: &[ObjectBuses] = if is_ethercat { &[ObjectBuses::COE] } else { &[ObjectBuses::CANOPEN] };
    let around = Around { types: &types, given: &[], images: &[], spaces: &[], buses, is_table: false };
    let groups = items::objects(b, &around, 5);
    let fixed_objects = if is_ethercat { Vec::new() } else { items::objects(b, &around, 3) };
    let sub_extensions = if is_ethercat { Vec::new() } else { b.list(2, |b| sub_extension(b, &around)) };
    let process_data =
        if is_ethercat { process::data(b, &groups, &types, is_ethercat) } else { ProcessData::default() };
    Module {
        number: b.within(0..=3),
        id: names::name(b),
        class: names::name(b),
        name: names::name(b),
        names: names::texts(b),
        version: names::version(b),
        revision: names::version(b),
        identity: identity(b),
        comments: b.few(4, 2, names::text),
        documentation: names::documentation(b),
        types,
        fixed_objects,
        sub_extensions,
        groups,
        process_data,
        pdo_group: b.maybe(4, |b| b.within(0..=2)),
        mailbox: b.maybe(3, |b| Box::new(settings::mailbox(b))),
        clock_mode: names::name(b),
        add_info: b.maybe(6, Bytes::any),
        sub_add_info: b.maybe(8, Bytes::any),
        profiles: b.few(4, 2, |b| b.pick(&[402, 0])),
        extensions: names::extensions(b),
        // PROFINET modules are created in `profinet`.
        ..Module::default()
    }
}

/// Returns entries that a module adds to an object.
fn sub_extension(b: &mut Bytes<'_>, around: &Around<'_>) -> SubExtension {
    let index = b.within(0x2000..=0x2020);
    let binding = Binding::Object { buses: b.pick(around.buses), index, sub_index: 1 };
    SubExtension {
        index,
        count: b.within(0..=4),
        per: b.maybe(4, |b| b.within(0..=2)),
        extends_object: b.any(),
        template: items::item(b, around, binding),
    }
}
