/// Pump: device access point 0x00000001.
pub static DAP: rt::profinet::Dap = rt::profinet::Dap {
    vendor_id: 0x0FFF,
    device_id: 0x0001,
    slot: 0,
    module: rt::profinet::Module {
        ident: 0x00000001,
        name: "Pump",
        submodules: &[
            rt::profinet::SubmoduleUse::new(
                &submodules::submodule_00000001_sub::SUBMODULE,
                rt::profinet::Places::fixed(&[(1, 1)]),
            ),
            rt::profinet::SubmoduleUse::new(
                &submodules::submodule::SUBMODULE,
                rt::profinet::Places::allowed(&[(2, 2)]),
            ),
        ],
        subslots: &[],
    },
    slots: &[(0, 4)],
    modules: &[
        rt::profinet::ModuleUse::new(
            &modules::module::MODULE,
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
