/// Values that the file configures, in the order in which the device accepts them.
pub const CONFIGURATION: rt::Configuration = rt::Configuration {
    disable_pdos: &[
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1800, 0x01, 0x8000_0185)),
    ],
    communication: &[rt::Setting::fixed(rt::SdoWrite::new_u16(0x1017, 0x00, 0x0064))],
    parameters: &[rt::Setting::fixed(rt::SdoWrite::new_u16(0x2000, 0x00, 0x0014))],
    enable_pdos: &[rt::Setting::fixed(rt::SdoWrite::new_u32(0x1800, 0x01, 0x0000_0185))],
    ..rt::Configuration::EMPTY
};
