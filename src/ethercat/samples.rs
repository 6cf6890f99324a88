//! Example devices for the tests.

use super::*;
use crate::pdo::MappedEntry;

const fn manager(number: u8, purpose: SyncManagerPurpose, max_size: Option<u16>) -> SyncManager {
    SyncManager {
        number,
        purpose,
        start_address: 0x1000 + 0x100 * number as u16,
        default_size: 0,
        min_size: None,
        max_size,
        control: 0x20,
        enable: true,
        op_only: false,
    }
}

const NOBODY: Identity = Identity {
    vendor_id: None,
    product_code: None,
    revision_number: None,
    vendor_name: "",
    product_name: "",
    order_code: "",
};

const fn pdo(index: u16, bits: u32, mapping: &'static [MappedEntry]) -> PdoInfo {
    PdoInfo {
        index,
        direction: if index < 0x1A00 { Direction::Output } else { Direction::Input },
        bits,
        sync_manager: None,
        excluded_sync_managers: &[],
        fixed: true,
        mandatory: false,
        depends_on: DependsOn::Nothing,
        excludes: &[],
        mapping,
    }
}

const COE: Coe = Coe { sdo_info: true, pdo_assign: true, pdo_config: true, complete_access: false, init_commands: &[] };

pub(crate) static DRIVE: Device = Device {
    identity: NOBODY,
    sync_managers: &[
        manager(0, SyncManagerPurpose::MailboxOut, None),
        manager(2, SyncManagerPurpose::Outputs, None),
        manager(3, SyncManagerPurpose::Inputs, Some(8)),
    ],
    pdos: &[
        PdoInfo { sync_manager: Some(2), ..pdo(0x1600, 16, &[MappedEntry::new(0x6040, 0, 16)]) },
        pdo(0x1601, 3, &[MappedEntry::new(0x2000, 1, 3)]),
        PdoInfo { excludes: &[0x1600], ..pdo(0x1602, 16, &[MappedEntry::new(0x6040, 0, 16)]) },
        PdoInfo {
            fixed: false,
            mandatory: true,
            sync_manager: Some(3),
            ..pdo(0x1A00, 16, &[MappedEntry::new(0x6041, 0, 16)])
        },
        pdo(0x1A01, 64, &[MappedEntry::new(0x2001, 0, 64)]),
    ],
    default_pdos: &[0x1600, 0x1A00],
    mailbox: Mailbox { coe: Some(COE), ..Mailbox::NONE },
    slots: None,
};

pub(crate) static OUTPUTS: Module = Module {
    ident: 2,
    name: "Outputs",
    class: "do",
    pdo_group: 0,
    pdos: &[PdoInfo { depends_on: DependsOn::Slot, ..pdo(0x1600, 12, &[MappedEntry::in_slot(0x7000, 1, 12)]) }],
    init_commands: &[],
    objects: &[SlotObjects::new(0x7000, 0x7000, DependsOn::Slot)],
};

pub(crate) static INPUTS: Module = Module {
    ident: 1,
    name: "Inputs",
    class: "di",
    pdo_group: 1,
    // The mapping is writable. The last entry of the mapping contains an object of the coupler.
    pdos: &[PdoInfo {
        depends_on: DependsOn::Slot,
        fixed: false,
        ..pdo(0x1A00, 8, &[MappedEntry::in_slot(0x6000, 1, 7), MappedEntry::new(0xF100, 2, 1)])
    }],
    init_commands: &[
        InitCommand {
            transitions: Transitions::of(&[Transition::PS]),
            index: 0x8000,
            sub_index: 2,
            complete_access: false,
            depends_on: DependsOn::Slot,
            data: &[0x0A, 0],
        },
        InitCommand {
            transitions: Transitions::of(&[Transition::SO]),
            index: 0x8000,
            sub_index: 3,
            complete_access: false,
            depends_on: DependsOn::Slot,
            data: &[1],
        },
    ],
    objects: &[
        SlotObjects::new(0x6000, 0x8000, DependsOn::Slot),
        SlotObjects::new(0x9000, 0x9000, DependsOn::SlotGroup),
        SlotObjects::new(0xA000, 0xA001, DependsOn::Both),
    ],
};

pub(crate) static WIDE: Module =
    Module { ident: 3, name: "Wide", class: "", pdo_group: 0, pdos: &[], init_commands: &[], objects: &[] };

/// A coupler with two kinds of slots: one slot for an output module, and five slots of group 2 for input and output
/// modules.
pub(crate) static COUPLER: Device = Device {
    identity: NOBODY,
    sync_managers: &[manager(2, SyncManagerPurpose::Outputs, None), manager(3, SyncManagerPurpose::Inputs, None)],
    pdos: &[PdoInfo { sync_manager: Some(3), ..pdo(0x1AFF, 4, &[MappedEntry::new(0xF100, 1, 4)]) }],
    default_pdos: &[0x1AFF],
    mailbox: Mailbox { coe: Some(COE), ..Mailbox::NONE },
    slots: Some(Slots {
        slots: &[
            Slot {
                name: "First",
                min: 1,
                max: 1,
                fits: &[Fit::Ident(2)],
                default: Some(2),
                increments: Increments::new(0x10, 4),
                group: None,
            },
            Slot {
                name: "Terminals",
                min: 0,
                max: 5,
                fits: &[Fit::Class("di"), Fit::Class("do")],
                default: None,
                increments: Increments::new(0x10, 4),
                group: Some(SlotGroup::new(2, Increments::new(0x400, 0x20))),
            },
        ],
        modules: &[&OUTPUTS, &INPUTS],
        pdo_groups: &[
            PdoGroup { alignment: 0, rx_pdo: None, tx_pdo: None },
            PdoGroup { alignment: 1, rx_pdo: Some(0x16F0), tx_pdo: Some(0x1AF0) },
        ],
        download_idents: Transitions::of(&[Transition::PS]),
    }),
};
