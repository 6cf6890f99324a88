//! Compares devices: identity, file header, CANopen and Modbus settings, models and axes.

use super::change::{Effect, Judgment};
use super::comparison::{
    compare_fields, each, each_positioned, fact, fact_as, judged, list, optional, or_default, part, rules, slice, text,
    Comparison, Elements, COMPARED, KEY, POSITION,
};
use super::conditions::restricted;
use super::identity::identity;
use super::names::identifier;
use super::show::{index, Show};
use super::texts::{documentation, doubts, extensions, manual, renamed};
use super::{codes, ethercat, groups, machines, messages, modules, pdos, profinet, types};
use lexibus_codegen::facts;
use lexibus_codegen::ir::{
    AxisRange, AxisRule, CanOpenSettings, Commissioning, Composite, Device, DynamicChannel, GivenNumber, Header,
    ModbusTable, Procedure, ProcessData, StateMachine, Value, Variant,
};
use lexibus_codegen::number::hex;

/// Compares all facts and elements of a device.
pub(super) fn compare(old: &Device, new: &Device, comparison: &mut Comparison<'_>) {
    comparison.within("the device", |comparison| facts_of_device(old, new, comparison));
    compare_fields!(Device, old, new, comparison, {
        header: part("the file", header),
        canopen: optional("CANopen", Judgment::ADDITION, Judgment::API_AND_WIRE, canopen),
        ethercat: optional("EtherCAT", Judgment::ADDITION, Judgment::API_AND_WIRE, ethercat::compare),
        profinet: optional("PROFINET", Judgment::ADDITION, Judgment::API_AND_WIRE, profinet::settings),
        modbus: slice(modbus_tables),
        commissioning: part("commissioning", or_default(commissioning)),
        groups: slice(groups::compare),
        process_data: |one: &ProcessData, other: &ProcessData, comparison: &mut Comparison<'_>| {
            pdos::compare(one, other, facts::pdo::buses(new), comparison);
        },
        slots: list(modules::slots(), modules::slot),
        modules: slice(modules::compare_uses),
        submodules: slice(profinet::compare_uses),
        messages: slice(messages::compare),
        parameter_spaces: messages::spaces(),
        framing: optional("framing", Judgment::ADDITION, Judgment::API_AND_WIRE, messages::framing),
        given: list(Elements::titled(|number: &GivenNumber| format!("machine constant {}", number.name))
            .paired_by(|number| identifier(&number.name)).judged(Judgment::API, Judgment::API), given),
        code_tables: codes::tables(),
        machines: list(Elements::titled(|machine: &StateMachine| format!("machine {}", machine.name))
            .paired_by(|machine| identifier(&machine.name))
            .judged(Judgment::API_COMPATIBLE, Judgment::API), machines::compare),
        procedures: list(Elements::titled(|procedure: &Procedure| format!("procedure {}", procedure.name))
            .paired_by(|procedure| identifier(&procedure.name))
            .judged(Judgment::API_COMPATIBLE, Judgment::API), machines::procedure),
        composites: list(Elements::titled(|composite: &Composite| format!("composite {}", composite.name))
            .paired_by(|composite| identifier(&composite.name)).judged(Judgment::API_COMPATIBLE, Judgment::API), composite),
        variants: list(Elements::titled(|model: &Variant| format!("model {}", model.name))
            .paired_by(|model| identifier(&model.name)).judged(Judgment::API_COMPATIBLE, Judgment::API), model),
        axes: optional("axes", Judgment::API_COMPATIBLE, Judgment::API, axes),
        manual: part("the manual", or_default(manual)),
    },
    COMPARED => [name, names, id, dictionary_only, identity, modbus_examples, node_ids, profiles, types, documentation,
        doubts, extensions],
    POSITION => [origin],
    );
    types::compare_unused(comparison);
}

/// Compares the facts that concern the whole device.
fn facts_of_device(old: &Device, new: &Device, comparison: &mut Comparison<'_>) {
    let titles = [old, new].map(|device| facts::device::title(device).to_owned());
    judged("name", renamed)(&titles[0], &titles[1], comparison);
    if titles[0] == titles[1] {
        text("name in the file")(&old.name, &new.name, comparison);
    }
    text("name in other languages")(&old.names, &new.names, comparison);
    text("identifier in the file")(&old.id, &new.id, comparison);
    fact("dictionary without a device", Judgment::API)(&old.dictionary_only, &new.dictionary_only, comparison);
    identity(&old.identity, &new.identity, comparison);
    each_positioned("examples of frames", messages::example)(&old.modbus_examples, &new.modbus_examples, comparison);
    fact_as("node-IDs", Judgment::BEHAVIOR, node_ids)(&old.node_ids, &new.node_ids, comparison);
    fact("profiles", Judgment::BEHAVIOR)(&old.profiles, &new.profiles, comparison);
    or_default(documentation)(&old.documentation, &new.documentation, comparison);
    doubts(&old.doubts, &new.doubts, comparison);
    extensions(&old.extensions, &new.extensions, comparison);
}

fn node_ids(range: &Option<(u8, u8)>) -> String {
    range.map(|(first, last)| format!("{first} to {last}")).unwrap_or_default()
}

rules!(fn header(Header) {
    file_name: text("name of the file"),
    file_version: text("version of the file"),
    file_revision: text("revision of the file"),
    format_version: text("version of the format"),
    description: text("description of the file"),
    creation_time: text("time of creation"),
    creation_date: text("date of creation"),
    created_by: text("created by"),
    modification_time: text("time of modification"),
    modification_date: text("date of modification"),
    modified_by: text("modified by"),
    last_eds: text("made from"),
    comments: text("comments"),
});

rules!(fn canopen(CanOpenSettings) {
    bit_rates: judged("bit rates in kbit/s", |old: &Vec<u16>, new: &Vec<u16>| {
        let is_lost = old.iter().any(|value| !new.contains(value));
        if is_lost { Judgment::BEHAVIOR } else { Judgment::BEHAVIOR_COMPATIBLE }
    }),
    auto_bit_rate: fact("detects the bit rate", Judgment::BEHAVIOR),
    boot_up_master: fact("boot-up master", Judgment::BEHAVIOR),
    boot_up_slave: fact("boot-up slave", Judgment::BEHAVIOR),
    granularity: fact("granularity of mappings in bits", Judgment::BEHAVIOR),
    dynamic_channels_supported: fact("support of dynamic channels", Judgment::BEHAVIOR),
    group_messaging: fact("multiplexed PDOs", Judgment::BEHAVIOR),
    rx_pdos: fact("number of RPDOs", Judgment::BEHAVIOR),
    tx_pdos: fact("number of TPDOs", Judgment::BEHAVIOR),
    lss: fact("layer setting services", Judgment::BEHAVIOR),
    compact_pdo: fact("sub-indices of implicit PDOs", Judgment::BEHAVIOR),
    dummies: fact("dummy entries", Judgment::BEHAVIOR),
    dummies_given: fact("list of dummy entries", Judgment::NONE),
    dynamic_channels: each("dynamic channels", Judgment::BEHAVIOR, dynamic_channel),
}, POSITION => [at]);

fn dynamic_channel(channel: &DynamicChannel) -> String {
    let DynamicChannel { data_type, direction, range, offset, difference, max_number } = channel;
    let further = [difference.show(), max_number.show()].join(" ");
    format!("type {} {direction} {range} at {offset} {further}", hex(*data_type)).trim_end().to_owned()
}

/// Compares the requests that the Modbus tables accept.
fn modbus_tables(old: &[ModbusTable], new: &[ModbusTable], comparison: &mut Comparison<'_>) {
    let missing = |table: &ModbusTable| ModbusTable {
        space: table.space,
        functions: Vec::new(),
        max_read: None,
        max_write: None,
        split: false,
    };
    for (old, new) in super::pairing::pairs(old, new, |table| table.space.title().to_owned(), |_| String::new()) {
        let Some(table) = new.or(old) else { continue };
        let missing = missing(table);
        comparison.within(&format!("Modbus table {}", table.space.title()), |comparison| {
            modbus_table(old.unwrap_or(&missing), new.unwrap_or(&missing), comparison);
        });
    }
}

rules!(fn modbus_table(ModbusTable) {
    // An empty list means that all functions are accepted. If the preferred function was removed, a driver uses
    // another one, so its requests change.
    functions: judged("function codes", |old: &Vec<u8>, new: &Vec<u8>| {
        let is_lost = !new.is_empty() && (old.is_empty() || old.iter().any(|value| !new.contains(value)));
        if is_lost { Judgment::WIRE } else { Judgment::WIRE_COMPATIBLE }
    }),
    max_read: judged("longest read", shorter),
    max_write: judged("longest write", shorter),
    split: judged("longer values in several requests", |old: &bool, _: &bool| {
        if *old { Judgment::WIRE } else { Judgment::WIRE_COMPATIBLE }
    }),
}, KEY => [space]);

/// Returns the effects of a changed maximum request length.
fn shorter(old: &Option<u16>, new: &Option<u16>) -> Judgment {
    let is_shorter = new.is_some_and(|new| old.is_none_or(|old| new < old));
    let wire = if is_shorter { Effect::Breaking } else { Effect::Compatible };
    Judgment { wire, ..Judgment::NONE }
}

rules!(fn commissioning(Commissioning) {
    node_id: fact("node-ID", Judgment::WIRE),
    node_name: text("name of the node"),
    bit_rate: fact("bit rate in kbit/s", Judgment::WIRE),
    net_number: fact("number of the network", Judgment::BEHAVIOR),
    network_name: text("name of the network"),
    manager: fact("CANopen manager", Judgment::BEHAVIOR),
    lss_serial_number: fact("serial number for layer setting services", Judgment::BEHAVIOR),
    connected_modules: fact("connected modules", Judgment::BEHAVIOR),
});

rules!(fn given(GivenNumber) {
    name,
    unit: fact("unit", Judgment::API),
    models: fact_as("numbers of models", Judgment::BEHAVIOR, constants),
    documentation, doubts,
}, POSITION => [origin]);

/// Formats names with their values, such as `Small 5, Large 10`.
fn constants<Name: Show>(constants: &Vec<(Name, Value)>) -> String {
    constants.show()
}

rules!(fn composite(Composite) {
    name, names,
    parts: fact("parts", Judgment::API_AND_WIRE),
    base: fact("base", Judgment::WIRE),
    sign: fact("sign", Judgment::API_AND_WIRE),
    unit: fact("unit", Judgment::API_AND_BEHAVIOR),
    documentation, doubts,
}, POSITION => [origin]);

rules!(fn model(Variant) {
    name,
    identity: identity,
    constants: fact_as("constants", Judgment::BEHAVIOR, constants),
    documentation, doubts,
}, POSITION => [origin]);

rules!(fn axes(AxisRule) {
    axes: judged("number of axes", |old: &u8, new: &u8| {
        if new < old { Judgment::API_AND_WIRE } else { Judgment::ADDITION }
    }),
    models: restricted("models"),
    rules: each("addresses of further axes", Judgment::WIRE, |rule: &AxisRange| {
        format!("{} to {}: {}", index(&rule.indices.0), index(&rule.indices.1), rule.step.show())
    }),
});
