//! Random facts of a device that do not concern its items: the header of its file, and its capabilities on the bus.

use lexibus_codegen::ir::{
    CanOpenSettings, CanOpenSpans, ClockMode, ClockSyncManager, ClockTime, Coe, Commissioning, DistributedClocks,
    DynamicChannel, Eeprom, EtherCatSettings, Fit, Fmmu, Header, InitCommand, LocalText, Mailbox, ModulePdoGroup,
    Protocol, SlaveController, Slot, SlotRules, SyncUnit, ToolSettings,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::names;

/// Returns the header of a file.
pub fn header(b: &mut Bytes<'_>) -> Header {
    Header {
        file_name: names::path(b),
        file_version: names::version(b),
        file_revision: names::version(b),
        format_version: names::version(b),
        description: names::text(b),
        creation_time: names::name(b),
        creation_date: names::name(b),
        created_by: names::text(b),
        modification_time: names::name(b),
        modification_date: names::name(b),
        modified_by: names::text(b),
        last_eds: names::path(b),
        comments: b.few(3, 3, names::text),
    }
}

pub fn canopen(b: &mut Bytes<'_>) -> CanOpenSettings {
    CanOpenSettings {
        bit_rates: b.list(3, |b| b.pick(&[10, 125, 1000])),
        auto_bit_rate: b.any(),
        boot_up_master: b.any(),
        boot_up_slave: b.any(),
        granularity: b.maybe(2, |b| b.pick(&[0, 1, 8, 64])),
        dynamic_channels_supported: b.any(),
        group_messaging: b.any(),
        rx_pdos: b.maybe(2, |b| b.within(0..=4)),
        tx_pdos: b.maybe(2, |b| b.within(0..=4)),
        lss: b.any(),
        compact_pdo: b.any(),
        dummies: b.list(2, |b| b.within(1..=7)),
        dummies_given: b.any(),
        dynamic_channels: b.few(4, 2, |b| DynamicChannel {
            data_type: b.within(0..=0x20),
            direction: names::name(b),
            range: names::name(b),
            offset: b.any(),
            difference: b.any(),
            max_number: b.any(),
        }),
        at: CanOpenSpans::default(),
    }
}

pub fn commissioning(b: &mut Bytes<'_>) -> Commissioning {
    Commissioning {
        node_id: b.maybe(2, |b| b.within(0..=130)),
        node_name: names::name(b),
        bit_rate: b.any(),
        net_number: b.any(),
        network_name: names::name(b),
        manager: b.any(),
        lss_serial_number: b.any(),
        connected_modules: b.list(3, |b| b.within(0..=3)),
    }
}

pub fn ethercat(b: &mut Bytes<'_>) -> EtherCatSettings {
    EtherCatSettings {
        physics: b.pick(&["YY", "", "Y*/"]).into(),
        group: names::name(b).into(),
        hides: b.few(6, 2, |b| (b.any(), b.any())),
        invisible: b.one_in(6),
        fmmus: b.list(3, |b| Fmmu {
            purpose: b.pick(&["Outputs", "Inputs", "MBoxState", "odd\""]).into(),
            sync_manager: b.maybe(2, |b| b.within(0..=4)),
            sync_unit: b.maybe(4, |b| b.within(0..=2)),
            op_only: b.any(),
        }),
        sync_units: b.few(4, 2, |b| SyncUnit {
            name: names::name(b),
            separate: b.any(),
            separate_frame: b.any(),
            depends_on_input_state: b.any(),
            frame_repeat: b.any(),
        }),
        mailbox: b.maybe(2, |b| Box::new(mailbox(b))),
        clocks: b.maybe(2, |b| {
            Box::new(DistributedClocks { attributes: names::attributes(b), modes: b.list(3, clock_mode) })
        }),
        slots: b.maybe(3, |b| Box::new(slot_rules(b))),
        registers: b.few(6, 2, |b| (b.any(), b.any())),
        eeprom: b.maybe(4, |b| Box::new(eeprom(b))),
        timeouts: b.few(6, 2, |b| (b.pick(&["RequestTimeout", "PreopTimeout"]).into(), b.any())),
        ebus_current: b.maybe(4, Bytes::any),
        identification_register: b.maybe(4, Bytes::any),
        identification_in_al_status: b.one_in(4),
        without_lrw: b.one_in(4),
        safe_op_without_sync: b.one_in(4),
        tool: b.maybe(4, |b| Box::new(tool(b))),
        controller: b.maybe(4, |b| SlaveController { memory_bytes: b.any(), sync_managers: b.any(), fmmus: b.any() }),
        station_alias: b.maybe(4, Bytes::any),
        urls: b.few(4, 2, |b| LocalText { language: names::name(b), text: names::text(b) }),
        picture: b.maybe(4, |b| (b.pick(&["Image16x14", "ImageFile16x14"]).into(), names::path(b))),
    }
}

fn tool(b: &mut Bytes<'_>) -> ToolSettings {
    ToolSettings {
        check_product_code: names::text(b),
        check_revision: names::text(b),
        check_serial_number: names::text(b),
        sync_manager_class: names::text(b),
        safe_op_in_config_mode: names::text(b),
        module_pdo_group: names::text(b),
        download_module_list: names::text(b),
        show_hideable_sub_devices: names::text(b),
    }
}

pub fn mailbox(b: &mut Bytes<'_>) -> Mailbox {
    let [aoe, eoe, foe, soe, voe] = [0; 5].map(|_| b.maybe(6, protocol));
    Mailbox { data_link_layer: b.any(), real_time: b.any(), aoe, eoe, coe: b.maybe(2, coe), foe, soe, voe }
}

fn protocol(b: &mut Bytes<'_>) -> Protocol {
    Protocol { attributes: names::attributes(b), init_commands: b.few(3, 2, init_command) }
}

fn coe(b: &mut Bytes<'_>) -> Coe {
    Coe {
        sdo_info: b.any(),
        pdo_assign: b.any(),
        pdo_config: b.any(),
        pdo_upload: b.any(),
        complete_access: b.any(),
        segmented_sdo: b.any(),
        diag_history: b.any(),
        attributes: names::attributes(b),
        init_commands: b.few(3, 2, init_command),
    }
}

fn init_command(b: &mut Bytes<'_>) -> InitCommand {
    InitCommand {
        transitions: b.list(2, |b| b.pick(&["PS", "IP", "odd"]).into()),
        index: b.within(0x2000..=0x2020),
        sub_index: b.within(0..=3),
        data: b.list(8, Bytes::any),
        depends_on_slot: b.any(),
        depends_on_slot_group: b.any(),
        complete_access: b.any(),
        fixed: b.any(),
        adapt: b.any(),
        overwritten_by_module: b.any(),
        comment: names::text(b),
        origin: Origin::default(),
    }
}

fn clock_mode(b: &mut Bytes<'_>) -> ClockMode {
    let [cycle_sync0, shift_sync0, cycle_sync1, shift_sync1] =
        [0; 4].map(|_| ClockTime { nanoseconds: b.any(), factor: b.any(), input: b.any() });
    ClockMode {
        name: names::name(b),
        description: names::text(b),
        assign_activate: b.any(),
        cycle_sync0,
        shift_sync0,
        cycle_sync1,
        shift_sync1,
        sync_managers: b.few(3, 2, |b| ClockSyncManager {
            number: b.within(0..=4),
            sync_type: b.any(),
            pdos: b.list(2, |b| (b.within(0x1600..=0x1602), b.any())),
        }),
    }
}

fn slot_rules(b: &mut Bytes<'_>) -> SlotRules {
    let [index_increment, pdo_increment, group_index_increment, group_pdo_increment] = [0; 4].map(|_| b.any());
    SlotRules {
        max_slots: b.any(),
        max_groups: b.any(),
        index_increment,
        pdo_increment,
        group_index_increment,
        group_pdo_increment,
        download_idents: b.any(),
        download_addresses: b.any(),
        download_transition: b.pick(&["", "PS", "\""]).into(),
        pdo_groups: b.few(4, 2, |b| ModulePdoGroup { alignment: b.any(), rx_pdo: b.any(), tx_pdo: b.any() }),
        groups: b.few(4, 2, |b| (b.within(0..=3), names::name(b))),
        selections: b.few(4, 2, |b| (names::name(b), b.list(3, |b| b.within(0..=3)))),
    }
}

fn eeprom(b: &mut Bytes<'_>) -> Eeprom {
    let [data, config_data, boot_strap] = [0; 3].map(|_| b.list(8, Bytes::any));
    let categories = b.few(4, 2, |b| (b.any(), b.list(4, Bytes::any)));
    Eeprom { data, byte_size: b.any(), config_data, boot_strap, categories, assign_to_pdi: b.any() }
}

pub fn slot(b: &mut Bytes<'_>) -> Slot {
    let [index_increment, pdo_increment, group_index_increment, group_pdo_increment] = [0; 4].map(|_| b.any());
    Slot {
        number: b.within(0..=3),
        name: names::name(b),
        instances: (b.within(0..=2), b.within(0..=4)),
        names: names::texts(b),
        fits: b.list(2, fit),
        default: b.maybe(3, fit),
        group: b.maybe(4, |b| b.within(0..=3)),
        index_increment,
        pdo_increment,
        group_index_increment,
        group_pdo_increment,
    }
}

fn fit(b: &mut Bytes<'_>) -> Fit {
    match b.within(0..=2) {
        0 => Fit::Ident(b.within(0..=3)),
        1 => Fit::Class(names::name(b)),
        _ => Fit::Name(names::name(b)),
    }
}
