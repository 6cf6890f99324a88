//! Devices for the tests.

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
        depends_on_slot: false,
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
    pdos: &[PdoInfo { depends_on_slot: true, ..pdo(0x1600, 12, &[MappedEntry::new(0x7000, 1, 12)]) }],
    init_commands: &[],
};

pub(crate) static INPUTS: Module = Module {
    ident: 1,
    name: "Inputs",
    class: "di",
    pdo_group: 1,
    pdos: &[PdoInfo { depends_on_slot: true, ..pdo(0x1A00, 8, &[MappedEntry::new(0x6000, 1, 8)]) }],
    init_commands: &[
        InitCommand {
            transitions: Transitions::of(&[Transition::PS]),
            index: 0x8000,
            sub_index: 2,
            complete_access: false,
            depends_on_slot: true,
            data: &[0x0A, 0],
        },
        InitCommand {
            transitions: Transitions::of(&[Transition::SO]),
            index: 0x8000,
            sub_index: 3,
            complete_access: false,
            depends_on_slot: true,
            data: &[1],
        },
    ],
};

pub(crate) static WIDE: Module =
    Module { ident: 3, name: "Wide", class: "", pdo_group: 0, pdos: &[], init_commands: &[] };

/// One slot for outputs, and five for anything of the two classes.
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
                index_increment: 0x10,
                pdo_increment: 4,
            },
            Slot {
                name: "Terminals",
                min: 0,
                max: 5,
                fits: &[Fit::Class("di"), Fit::Class("do")],
                default: None,
                index_increment: 0x10,
                pdo_increment: 4,
            },
        ],
        modules: &[&OUTPUTS, &INPUTS],
        pdo_groups: &[
            PdoGroup { alignment: 0, rx_pdo: None, tx_pdo: None },
            PdoGroup { alignment: 1, rx_pdo: Some(0x16F0), tx_pdo: Some(0x1AF0) },
        ],
        download_idents: true,
    }),
};
