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
            &modules::lists::MODULE,
            rt::profinet::Places::new(&[(1, 3), (4, 4)], &[(1, 1), (2, 2)], &[(3, 3)]),
        ),
        rt::profinet::ModuleUse::new(
            &modules::reversed::MODULE,
            rt::profinet::Places::allowed(&[(1, 3)]),
        ),
        rt::profinet::ModuleUse::new(
            &modules::not_a_number::MODULE,
            rt::profinet::Places::allowed(&[(1, 1), (3, 3)]),
        ),
        rt::profinet::ModuleUse::new(
            &modules::too_great::MODULE,
            rt::profinet::Places::new(&[], &[], &[]),
        ),
        rt::profinet::ModuleUse::new(
            &modules::slot_5::MODULE,
            rt::profinet::Places::allowed(&[(3, 5)]),
        ),
    ],
    max_lengths: rt::profinet::IoLengths {
        input: None,
        output: None,
        data: None,
    },
    max_record_size: 4068,
};
