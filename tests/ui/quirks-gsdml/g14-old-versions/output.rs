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
                &submodules::interface::SUBMODULE,
                rt::profinet::Places::fixed(&[(0x8000, 0x8000)]),
            ),
            rt::profinet::SubmoduleUse::new(
                &submodules::port::SUBMODULE,
                rt::profinet::Places::fixed(&[(0x8001, 0x8001)]),
            ),
            rt::profinet::SubmoduleUse::new(
                &submodules::submodule_00000001::SUBMODULE,
                rt::profinet::Places::fixed(&[(1, 1)]),
            ),
        ],
        subslots: &[],
    },
    slots: &[(0, 4)],
    modules: &[],
    max_lengths: rt::profinet::IoLengths {
        input: None,
        output: None,
        data: None,
    },
    max_record_size: 4068,
};
