/// EtherCAT description of an unnamed device by Maker for the master.
pub static DEVICE: rt::ethercat::Device = rt::ethercat::Device {
    identity: IDENTITY,
    sync_managers: &[],
    pdos: &[],
    default_pdos: &[],
    mailbox: rt::ethercat::Mailbox::NONE,
    slots: Some(rt::ethercat::Slots {
        slots: &[
            rt::ethercat::Slot {
                name: "Bay",
                min: 0,
                max: 4,
                fits: &[
                    rt::ethercat::Fit::Ident(0x00000030),
                    rt::ethercat::Fit::Ident(0x00000031),
                ],
                default: Some(0x00000030),
                increments: rt::ethercat::Increments::new(0x10, 0x8),
                group: None,
            },
            rt::ethercat::Slot {
                name: "",
                min: 1,
                max: 1,
                fits: &[rt::ethercat::Fit::Class("Di")],
                default: None,
                increments: rt::ethercat::Increments::new(0x40, 0x0),
                group: Some(
                    rt::ethercat::SlotGroup::new(
                        1,
                        rt::ethercat::Increments::new(0x0, 0x0),
                    ),
                ),
            },
        ],
        modules: &[&modules::di4::MODULE, &modules::r#do::MODULE],
        pdo_groups: &[
            rt::ethercat::PdoGroup {
                alignment: 16,
                rx_pdo: Some(0x1700),
                tx_pdo: Some(0x1B00),
            },
        ],
        download_idents: rt::ethercat::Transitions::of(&[rt::ethercat::Transition::PS]),
    }),
};
