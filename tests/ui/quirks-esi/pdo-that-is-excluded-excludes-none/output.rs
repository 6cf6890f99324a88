/// EtherCAT description of Maker Drive for the master.
pub static DEVICE: rt::ethercat::Device = rt::ethercat::Device {
    identity: IDENTITY,
    sync_managers: &[],
    pdos: &[
        rt::ethercat::PdoInfo {
            index: 0x1601,
            direction: rt::ethercat::Direction::Output,
            bits: 16,
            sync_manager: Some(0),
            excluded_sync_managers: &[],
            fixed: true,
            mandatory: false,
            depends_on: rt::ethercat::DependsOn::Nothing,
            excludes: &[],
            mapping: <pdo::P1601 as rt::Pdo>::MAPPING,
        },
        rt::ethercat::PdoInfo {
            index: 0x1602,
            direction: rt::ethercat::Direction::Output,
            bits: 16,
            sync_manager: Some(0),
            excluded_sync_managers: &[],
            fixed: true,
            mandatory: false,
            depends_on: rt::ethercat::DependsOn::Nothing,
            excludes: &[0x1601, 0x1603],
            mapping: <pdo::P1602 as rt::Pdo>::MAPPING,
        },
        rt::ethercat::PdoInfo {
            index: 0x1603,
            direction: rt::ethercat::Direction::Output,
            bits: 16,
            sync_manager: Some(0),
            excluded_sync_managers: &[],
            fixed: true,
            mandatory: false,
            depends_on: rt::ethercat::DependsOn::Nothing,
            excludes: &[],
            mapping: <pdo::P1603 as rt::Pdo>::MAPPING,
        },
    ],
    default_pdos: &[0x1601, 0x1603],
    mailbox: rt::ethercat::Mailbox::NONE,
    slots: None,
};
    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: P1601.
        pub p1601: super::pdo::P1601,
        /// RxPDO 0x1603: P1603.
        pub p1603: super::pdo::P1603,
    }
