//! Compares the EtherCAT settings with which a master configures a slave.

use super::change::Judgment;
use super::comparison::{
    compare_fields, each, fact, fact_as, joined, list, optional, or_default, rules, text, Comparison, Elements, KEY,
    POSITION,
};
use super::show::{index, Show};
use lexibus_codegen::ir::{
    ClockMode, ClockSyncManager, ClockTime, Coe, CompactString, DistributedClocks, Eeprom, EtherCatSettings, Fmmu,
    InitCommand, LocalText, Mailbox, ModulePdoGroup, Protocol, SlaveController, SlotRules, SyncUnit, ToolSettings,
};
use lexibus_codegen::number::{self, bytes, hex, hex16, hex32};

rules!(pub(super) fn compare(EtherCatSettings) {
    physics: fact("ports", Judgment::BEHAVIOR),
    group: text("family"),
    hides: each("hidden revisions", Judgment::NONE, hidden),
    invisible: fact("hidden in lists of devices", Judgment::NONE),
    fmmus: each("FMMUs", Judgment::WIRE, fmmu),
    sync_units: each("sync units", Judgment::WIRE, sync_unit),
    mailbox: optional("mailbox", Judgment::ADDITION, Judgment::API_AND_WIRE, mailbox),
    clocks: optional("distributed clocks", Judgment::ADDITION, Judgment::API_AND_WIRE, clocks),
    slots: optional("slots", Judgment::ADDITION, Judgment::API_AND_WIRE, slots),
    registers: each("registers of the slave controller", Judgment::WIRE, |(address, value): &(u16, u32)| {
        format!("{} = {}", hex16(*address), hex(*value))
    }),
    eeprom: optional("EEPROM", Judgment::BEHAVIOR_COMPATIBLE, Judgment::BEHAVIOR, eeprom),
    timeouts: fact("timeouts in ms", Judgment::BEHAVIOR),
    ebus_current: fact("E-bus current in mA", Judgment::BEHAVIOR),
    identification_register: fact_as("identification register", Judgment::WIRE, |register: &Option<u16>| {
        register.map(hex16).unwrap_or_default()
    }),
    identification_in_al_status: fact("identification in the AL status code", Judgment::WIRE),
    without_lrw: fact("no LRW datagrams", Judgment::WIRE),
    safe_op_without_sync: fact("SafeOp before synchronization", Judgment::BEHAVIOR),
    tool: or_default(tool),
    controller: or_default(controller),
    station_alias: fact("station alias", Judgment::BEHAVIOR),
    urls: each("URLs", Judgment::NONE, |url: &LocalText| format!("{} {}", url.language, url.text)),
    picture: fact("picture", Judgment::NONE),
});

/// Formats the product code and revision of a device that this description hides in configuration tools.
fn hidden(identity: &(Option<u32>, Option<u32>)) -> String {
    [identity.0, identity.1].into_iter().flatten().map(hex32).collect::<Vec<_>>().join(" ")
}

/// Appends the names of all set flags to a text.
fn with_flags(text: String, flags: &[(bool, &str)]) -> String {
    let set = flags.iter().filter(|(is_set, _)| *is_set).map(|(_, name)| *name);
    std::iter::once(text.as_str()).chain(set).collect::<Vec<_>>().join(" ")
}

rules!(fn tool(ToolSettings) {
    check_product_code: fact("check of the product code", Judgment::BEHAVIOR),
    check_revision: fact("check of the revision", Judgment::BEHAVIOR),
    check_serial_number: fact("check of the serial number", Judgment::BEHAVIOR),
    sync_manager_class: fact("class of sync manager settings", Judgment::BEHAVIOR),
    safe_op_in_config_mode: fact("SafeOp in configuration mode", Judgment::BEHAVIOR),
    module_pdo_group: fact("module PDO group", Judgment::BEHAVIOR),
    download_module_list: fact("download of the module list", Judgment::BEHAVIOR),
    show_hideable_sub_devices: fact("shows hideable sub-devices", Judgment::NONE),
});

rules!(fn controller(SlaveController) {
    memory_bytes: fact("memory of the slave controller in bytes", Judgment::BEHAVIOR),
    sync_managers: fact("sync managers of the slave controller", Judgment::BEHAVIOR),
    fmmus: fact("FMMUs of the slave controller", Judgment::BEHAVIOR),
});

fn fmmu(fmmu: &Fmmu) -> String {
    let Fmmu { purpose, sync_manager, sync_unit, op_only } = fmmu;
    let number = |name: &str, number: &Option<u8>| number.map(|number| format!(" {name} {number}")).unwrap_or_default();
    let text = format!("{purpose}{}{}", number("sync manager", sync_manager), number("sync unit", sync_unit));
    with_flags(text, &[(*op_only, "(in Op only)")])
}

fn sync_unit(sync_unit: &SyncUnit) -> String {
    let SyncUnit { name, separate, separate_frame, depends_on_input_state, frame_repeat } = sync_unit;
    let flags = [
        (*separate, "(separate)"),
        (*separate_frame, "(separate frame)"),
        (*depends_on_input_state, "(depends on the input state)"),
        (*frame_repeat, "(frames may be repeated)"),
    ];
    with_flags(format!("unit {name}"), &flags)
}

pub(super) fn mailbox(old: &Mailbox, new: &Mailbox, comparison: &mut Comparison<'_>) {
    let optional_protocol =
        |name: &'static str| optional::<Protocol, Protocol>(name, Judgment::ADDITION, Judgment::API_AND_WIRE, protocol);
    compare_fields!(Mailbox, old, new, comparison, {
        data_link_layer: fact("repeat requests", Judgment::WIRE),
        real_time: fact("real-time mode", Judgment::BEHAVIOR),
        aoe: optional_protocol("AoE"),
        eoe: optional_protocol("EoE"),
        coe: optional::<Coe, Coe>("CoE", Judgment::ADDITION, Judgment::API_AND_WIRE, coe),
        foe: optional_protocol("FoE"),
        soe: optional_protocol("SoE"),
        voe: optional_protocol("VoE"),
    });
}

rules!(fn protocol(Protocol) {
    attributes: fact("attributes", Judgment::BEHAVIOR),
    init_commands: init_commands(),
});

rules!(fn coe(Coe) {
    sdo_info: fact("SDO information", Judgment::BEHAVIOR),
    pdo_assign: fact("writable PDO assignment", Judgment::WIRE),
    pdo_config: fact("writable PDO mapping", Judgment::WIRE),
    pdo_upload: fact("the master reads the assignment", Judgment::WIRE),
    complete_access: fact("complete access", Judgment::WIRE),
    segmented_sdo: fact("segmented SDO transfer", Judgment::WIRE),
    diag_history: fact("diagnosis history", Judgment::BEHAVIOR),
    attributes: fact("attributes", Judgment::BEHAVIOR),
    init_commands: init_commands(),
});

/// Compares the start-up commands of the master. The commands are paired by their objects.
fn init_commands() -> impl Fn(&Vec<InitCommand>, &Vec<InitCommand>, &mut Comparison<'_>) {
    let title =
        |command: &InitCommand| format!("start-up write to {}", number::object(command.index, command.sub_index));
    list(Elements::titled(title).judged(Judgment::WIRE, Judgment::WIRE), init_command)
}

rules!(fn init_command(InitCommand) {
    transitions: fact("transitions", Judgment::WIRE),
    data: fact_as("data", Judgment::WIRE, |data: &Vec<u8>| bytes(data)),
    depends_on_slot: fact("index grows with the slot", Judgment::WIRE),
    depends_on_slot_group: fact("index grows with the slot group", Judgment::WIRE),
    complete_access: fact("complete access", Judgment::WIRE),
    fixed: fact("fixed", Judgment::NONE),
    adapt: fact("adapted by the master", Judgment::WIRE),
    overwritten_by_module: fact("replaced by a module", Judgment::WIRE),
    comment: text("comment"),
}, KEY => [index, sub_index], POSITION => [origin]);

rules!(fn clocks(DistributedClocks) {
    attributes: fact("attributes", Judgment::BEHAVIOR),
    modes: list(Elements::titled(|mode: &ClockMode| format!("mode {}", mode.name)), clock_mode),
});

rules!(fn clock_mode(ClockMode) {
    description: text("description"),
    assign_activate: fact_as("AssignActivate", Judgment::WIRE, |value| hex(*value)),
    cycle_sync0: fact_as("cycle of Sync0", Judgment::WIRE, clock_time),
    shift_sync0: fact_as("shift of Sync0", Judgment::WIRE, clock_time),
    cycle_sync1: fact_as("cycle of Sync1", Judgment::WIRE, clock_time),
    shift_sync1: fact_as("shift of Sync1", Judgment::WIRE, clock_time),
    sync_managers: each("sync managers", Judgment::WIRE, clock_sync_manager),
}, KEY => [name]);

fn clock_time(time: &ClockTime) -> String {
    let ClockTime { nanoseconds, factor, input } = time;
    let factor = factor.map(|factor| format!(" × {factor}")).unwrap_or_default();
    with_flags(format!("{nanoseconds} ns{factor}"), &[(*input, "(relative to the inputs)")])
}

fn clock_sync_manager(sync_manager: &ClockSyncManager) -> String {
    let ClockSyncManager { number, sync_type, pdos } = sync_manager;
    let sync_type = sync_type.map(|number| format!(" type {number}")).unwrap_or_default();
    let pdo = |(index, factor): &(u16, Option<u16>)| format!(" {} × {}", hex16(*index), factor.show());
    format!("{number}{sync_type}{}", joined(pdos, pdo))
}

rules!(fn slots(SlotRules) {
    max_slots: fact("maximum number of slots", Judgment::BEHAVIOR),
    max_groups: fact("maximum number of slot groups", Judgment::BEHAVIOR),
    index_increment: fact_as("index increment of a slot", Judgment::WIRE, index),
    pdo_increment: fact("PDO increment of a slot", Judgment::WIRE),
    group_index_increment: fact_as("index increment of a slot group", Judgment::WIRE, index),
    group_pdo_increment: fact("PDO increment of a slot group", Judgment::WIRE),
    download_idents: fact("the master writes module idents", Judgment::WIRE),
    download_addresses: fact("the master writes module addresses", Judgment::WIRE),
    download_transition: fact("transition of these writes", Judgment::WIRE),
    pdo_groups: each("module PDO groups", Judgment::WIRE, pdo_group),
    groups: text("names of slot groups"),
    selections: each("arrangements of modules", Judgment::NONE, |(name, modules): &(CompactString, Vec<u32>)| {
        format!("{name}: {}", modules.show())
    }),
});

fn pdo_group(group: &ModulePdoGroup) -> String {
    let ModulePdoGroup { alignment, rx_pdo, tx_pdo } = group;
    let pdo = |name: &str, pdo: &Option<u16>| pdo.map(|index| format!(", {name} {}", hex16(index))).unwrap_or_default();
    format!("alignment {alignment}{}{}", pdo("RxPDO", rx_pdo), pdo("TxPDO", tx_pdo))
}

fn eeprom(old: &Eeprom, new: &Eeprom, comparison: &mut Comparison<'_>) {
    let block = |data: &Vec<u8>| bytes(data);
    compare_fields!(Eeprom, old, new, comparison, {
        data: fact_as("content", Judgment::BEHAVIOR, block),
        byte_size: fact("size in bytes", Judgment::BEHAVIOR),
        config_data: fact_as("configuration", Judgment::BEHAVIOR, block),
        boot_strap: fact_as("bootstrap mailbox", Judgment::WIRE, block),
        categories: each("categories", Judgment::BEHAVIOR, |(number, data): &(u16, Vec<u8>)| {
            format!("{number}: {}", bytes(data))
        }),
        assign_to_pdi: fact("assigned to the process data interface", Judgment::BEHAVIOR),
    });
}
