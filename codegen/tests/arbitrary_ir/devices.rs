//! Devices with an object dictionary, registers or messages, and modules of theirs.

use lexibus_codegen::ir::{
    CanOpenSettings, Catalog, ClockMode, ClockTime, Commissioning, CompactString, Device, DistributedClocks, Eeprom,
    EtherCatSettings, Fit, Fmmu, Format, Group, InitCommand, Mailbox, ModbusTable, Module, ModuleId, ModuleUse,
    ObjectBuses, Places, ProcessData, RegisterSpace, Slot, SlotRules,
};

use super::bytes::Bytes;
use super::items::{self, Around, BOTH};
use super::machines;
use super::messages;
use super::names;
use super::process;
use super::profinet::identity;
use super::types;

/// The devices of an EDS, an XDD, an ESI or a register table, and their modules.
pub fn catalog(b: &mut Bytes<'_>, format: Format) -> Catalog {
    let modules = if format == Format::Esi { b.few(2, 3, module) } else { Vec::new() };
    let devices = if b.one_in(5) { 2 } else { 1 };
    let devices = (0..devices).map(|_| device(b, format, modules.len())).collect();
    Catalog { devices, modules, ..Catalog::default() }
}

fn device(b: &mut Bytes<'_>, format: Format, modules: usize) -> Device {
    let is_table = format == Format::Table;
    let is_ethercat = format == Format::Esi || is_table && b.one_in(3);
    let types = types::definitions(b, 10);
    let given = if is_table { b.few(2, 3, machines::given) } else { Vec::new() };
    let given_names: Vec<CompactString> = given.iter().map(|own| own.name.clone()).collect();
    let [images, spaces]: [Vec<CompactString>; 2] =
        if is_table { [0; 2].map(|_| b.list(2, names::name)) } else { Default::default() };
    let buses: &[ObjectBuses] = match format {
        Format::Table => &[BOTH, ObjectBuses::CANOPEN, ObjectBuses::COE],
        Format::Esi => &[ObjectBuses::COE],
        _ => &[ObjectBuses::CANOPEN],
    };
    let around = Around { types: &types, given: &given_names, images: &images, spaces: &spaces, buses, is_table };
    // Chapters have no index, and stand in front of what has one.
    let mut groups = if is_table { b.list(3, |b| items::chapter(b, &around)) } else { Vec::new() };
    groups.extend(items::objects(b, &around, 12));
    // An EDS has no PDOs but those that its objects describe.
    let has_declared = is_table || is_ethercat;
    if !has_declared {
        let objects = items::pdo_objects(b, &groups);
        groups.retain(|group| objects.iter().all(|own| own.index() != group.index()));
        groups.extend(objects);
        groups.sort_by_key(Group::index);
    }
    let messages = if is_table { messages::messages(b, &around, 6) } else { Vec::new() };
    let mut process_data =
        if has_declared { process::data(b, &groups, &types, is_ethercat) } else { ProcessData::default() };
    process_data.images = images.iter().map(|name| process::image(b, name.clone(), &types, 0)).collect();
    let message_names: Vec<CompactString> = messages.iter().map(|own| own.name.clone()).collect();
    let device = Device {
        name: names::name(b),
        names: names::texts(b),
        id: names::name(b),
        dictionary_only: b.one_in(20),
        identity: identity(b),
        canopen: if is_ethercat { None } else { b.maybe(2, canopen) },
        ethercat: is_ethercat.then(|| Box::new(ethercat(b))),
        node_ids: b.maybe(4, |b| (b.within(0..=9), b.within(9..=255))),
        profiles: b.few(2, 2, |b| b.pick(&[402, 301, 401, 0])),
        commissioning: b.maybe(8, |b| {
            Box::new(Commissioning { node_id: b.maybe(2, |b| b.within(0..=130)), ..Commissioning::default() })
        }),
        process_data,
        slots: b.few(4, 2, slot),
        modules: (0..modules as u32).map(|at| ModuleUse { module: ModuleId(at), places: Places::default() }).collect(),
        parameter_spaces: spaces.iter().map(|own| messages::space(b, own.clone(), &message_names)).collect(),
        framing: if is_table { b.maybe(3, |b| Box::new(messages::framing(b, &messages))) } else { None },
        given,
        code_tables: b.few(3, 2, machines::code_table),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        extensions: names::extensions(b),
        groups,
        messages,
        types,
        ..Device::default()
    };
    if is_table || b.one_in(6) {
        with_behaviour(b, device)
    } else {
        device
    }
}

/// The device with what only register tables say.
fn with_behaviour(b: &mut Bytes<'_>, device: Device) -> Device {
    let of_items = |group: &Group| group.items.iter().map(|item| item.name.clone()).collect::<Vec<_>>();
    let items: Vec<CompactString> = device.groups.iter().flat_map(of_items).collect();
    let types: Vec<CompactString> = device.types.iter().map(|own| own.name.clone()).collect();
    let messages: Vec<CompactString> = device.messages.iter().map(|own| own.name.clone()).collect();
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

fn canopen(b: &mut Bytes<'_>) -> Box<CanOpenSettings> {
    Box::new(CanOpenSettings {
        bit_rates: b.list(3, |b| b.pick(&[10, 125, 1000])),
        granularity: b.maybe(2, |b| b.pick(&[0, 1, 8, 64])),
        rx_pdos: b.maybe(2, |b| b.within(0..=4)),
        tx_pdos: b.maybe(2, |b| b.within(0..=4)),
        lss: b.any(),
        compact_pdo: b.any(),
        dummies: b.list(2, |b| b.within(1..=7)),
        dummies_given: b.any(),
        ..CanOpenSettings::default()
    })
}

fn ethercat(b: &mut Bytes<'_>) -> EtherCatSettings {
    EtherCatSettings {
        physics: b.pick(&["YY", "", "Y*/"]).into(),
        group: names::name(b),
        fmmus: b.list(3, |b| Fmmu {
            purpose: b.pick(&["Outputs", "Inputs", "MBoxState", "odd\""]).into(),
            sync_manager: b.maybe(2, |b| b.within(0..=4)),
            sync_unit: b.maybe(4, |b| b.within(0..=2)),
            op_only: b.any(),
        }),
        mailbox: b.maybe(2, |b| Box::new(Mailbox { data_link_layer: b.any(), ..Mailbox::default() })),
        clocks: b.maybe(2, |b| {
            Box::new(DistributedClocks { attributes: names::attributes(b), modes: b.list(3, clock_mode) })
        }),
        slots: b.maybe(3, |b| {
            let [index_increment, pdo_increment] = [0; 2].map(|_| b.any());
            Box::new(SlotRules { max_slots: b.any(), index_increment, pdo_increment, ..SlotRules::default() })
        }),
        eeprom: b.maybe(4, |b| {
            let [config_data, boot_strap] = [0; 2].map(|_| b.list(8, Bytes::any));
            Box::new(Eeprom { byte_size: b.any(), config_data, boot_strap, ..Eeprom::default() })
        }),
        ..EtherCatSettings::default()
    }
}

fn clock_mode(b: &mut Bytes<'_>) -> ClockMode {
    let [cycle_sync0, shift_sync0, cycle_sync1, shift_sync1] =
        [0; 4].map(|_| ClockTime { nanoseconds: b.any(), factor: b.any(), input: b.any() });
    let (name, description, assign_activate) = (names::name(b), names::text(b), b.any());
    ClockMode {
        name,
        description,
        assign_activate,
        cycle_sync0,
        shift_sync0,
        cycle_sync1,
        shift_sync1,
        sync_managers: Vec::new(),
    }
}

fn init_command(b: &mut Bytes<'_>) -> InitCommand {
    InitCommand {
        transitions: b.list(2, |b| b.pick(&["PS", "IP", "odd"]).into()),
        index: b.within(0x2000..=0x2020),
        sub_index: b.within(0..=3),
        data: b.list(8, Bytes::any),
        depends_on_slot: b.any(),
        comment: names::text(b),
        ..InitCommand::default()
    }
}

fn slot(b: &mut Bytes<'_>) -> Slot {
    Slot {
        number: b.within(0..=3),
        name: names::name(b),
        instances: (b.within(0..=2), b.within(0..=4)),
        names: names::texts(b),
        fits: b.list(2, |b| match b.within(0..=2) {
            0 => Fit::Ident(b.within(0..=3)),
            1 => Fit::Class(names::name(b)),
            _ => Fit::Name(names::name(b)),
        }),
        index_increment: b.any(),
        pdo_increment: b.any(),
        ..Slot::default()
    }
}

/// A module of a modular slave.
fn module(b: &mut Bytes<'_>) -> Module {
    let types = types::definitions(b, 5);
    let around =
        Around { types: &types, given: &[], images: &[], spaces: &[], buses: &[ObjectBuses::COE], is_table: false };
    let groups = items::objects(b, &around, 5);
    let process_data = process::data(b, &groups, &types, true);
    Module {
        number: b.within(0..=3),
        id: names::name(b),
        class: names::name(b),
        name: names::name(b),
        names: names::texts(b),
        identity: identity(b),
        documentation: names::documentation(b),
        types,
        groups,
        process_data,
        pdo_group: b.maybe(4, |b| b.within(0..=2)),
        init_commands: b.few(3, 2, init_command),
        extensions: names::extensions(b),
        ..Module::default()
    }
}
