    /// Pump: device access point 0x00000001.
    pub static DAP: rt::profinet::Dap = rt::profinet::Dap {
        vendor_id: 0x0FFF,
        device_id: 0x0001,
        slot: 0,
        module: rt::profinet::Module {
            ident: 0x00000001,
            name: "Pump",
            submodules: &[],
            subslots: &[],
        },
        slots: &[(0, 4)],
        modules: &[
            rt::profinet::ModuleUse::new(
                &super::modules::module_a::MODULE,
                rt::profinet::Places::new(&[], &[], &[]),
            ),
        ],
        max_lengths: rt::profinet::IoLengths {
            input: None,
            output: None,
            data: None,
        },
        max_record_size: 4068,
    };
    /// Large pump: device access point 0x00000009.
    pub static DAP: rt::profinet::Dap = rt::profinet::Dap {
        vendor_id: 0x0FFF,
        device_id: 0x0001,
        slot: 0,
        module: rt::profinet::Module {
            ident: 0x00000009,
            name: "Large pump",
            submodules: &[],
            subslots: &[],
        },
        slots: &[(0, 1)],
        modules: &[
            rt::profinet::ModuleUse::new(
                &super::modules::module_b::MODULE,
                rt::profinet::Places::allowed(&[(1, 1)]),
            ),
            rt::profinet::ModuleUse::new(
                &super::modules::module_a::MODULE,
                rt::profinet::Places::fixed(&[(1, 1)]),
            ),
        ],
        max_lengths: rt::profinet::IoLengths {
            input: None,
            output: None,
            data: None,
        },
        max_record_size: 4068,
    };
