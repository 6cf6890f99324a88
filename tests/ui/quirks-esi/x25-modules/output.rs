        /// EtherCAT description of 4 inputs for the master.
        pub static MODULE: rt::ethercat::Module = rt::ethercat::Module {
            ident: 0x00000030,
            name: "4 inputs",
            class: "Di",
            pdo_group: 1,
            pdos: &[
                rt::ethercat::PdoInfo {
                    index: 0x1A00,
                    direction: rt::ethercat::Direction::Input,
                    bits: 1,
                    sync_manager: Some(3),
                    excluded_sync_managers: &[],
                    fixed: true,
                    mandatory: false,
                    depends_on: rt::ethercat::DependsOn::Slot,
                    excludes: &[],
                    mapping: <pdo::Inputs as rt::Pdo>::MAPPING,
                },
            ],
            init_commands: &[
                rt::ethercat::InitCommand {
                    transitions: rt::ethercat::Transitions::of(
                        &[rt::ethercat::Transition::PS],
                    ),
                    index: 0x8000,
                    sub_index: 0x01,
                    complete_access: false,
                    depends_on: rt::ethercat::DependsOn::Slot,
                    data: b"\x05",
                },
            ],
            objects: &[
                rt::ethercat::SlotObjects::new(
                    0x6000,
                    0x8000,
                    rt::ethercat::DependsOn::Slot,
                ),
            ],
        };
            /// FILTER.
            ///
            /// Value type of [`FILTER`](super::objects::FILTER).
            ///
            /// | Value | Name |
            /// |---|---|
            /// | 5 | [`Slow`](Self::Slow) |
            #[derive(Clone, Copy, Debug)]
            pub enum Filter {
                /// 5: Slow.
                Slow,
                /// A number that no other variant represents.
                Unknown(u8),
            }
            /// Filter: 0x8000:00, UNSIGNED8, read-write.
            /// Value type: [`Filter`](super::types::Filter).
            pub const FILTER: ReadWrite<super::types::Filter> = ReadWriteNamedFilter::coe_object(
                0x8000,
                0x00,
                "Filter",
            );
                /// In 1: 0x6000:01, BOOLEAN, read-only, mappable into TPDOs.
                /// Mapped in [`Inputs`](super::pdo::Inputs).
                ///
                /// Access rights and PDO mapping from the rule for objects that occur only in PDOs.
                pub const IN_1: ReadOnly<bool> = ReadOnlyBool::flagged_coe_object(
                    0x6000,
                    0x01,
                    "In 1",
                    rt::Flags::TPDO,
                );
