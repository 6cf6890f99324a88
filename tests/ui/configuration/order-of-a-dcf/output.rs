/// Node-ID of this device in the configuration file.
pub const NODE_ID: Option<rt::NodeId> = rt::NodeId::new(5);
/// Values that the file configures, in the order in which the device accepts them.
///
/// Left out: read-only objects (0x1018:01).
///
/// Left out: objects that refuse writes on download (ObjFlags) (0x2007:00).
///
/// Left out: commands, targets of a drive, and the error history (0x1010:01).
///
/// Left out: mapping entries above the number of mapped objects (0x1600:03).
///
/// Left out: objects whose value does not fit the type (0x2008:00).
pub const CONFIGURATION: rt::Configuration = rt::Configuration {
    disable_pdos: &[
        rt::Setting::from_node(rt::SdoWrite::new_u32(0x1400, 0x01, 0x8000_0200)),
        rt::Setting::from_node_default(rt::SdoWrite::new_u32(0x1800, 0x01, 0x8000_0180)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1801, 0x01, 0x8000_0281)),
        rt::Setting::from_node(rt::SdoWrite::new_u32(0x1802, 0x01, 0x8000_0380)),
    ],
    communication: &[
        rt::Setting::from_node_default(rt::SdoWrite::new_u32(0x1014, 0x00, 0x0000_0080)),
        rt::Setting::fixed(rt::SdoWrite::new_u16(0x1017, 0x00, 0x03E8)),
        rt::Setting::fixed(rt::SdoWrite::new_u8(0x1019, 0x00, 0x04)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1006, 0x00, 0x0000_2710)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1005, 0x00, 0x4000_0080)),
    ],
    parameters: &[
        rt::Setting::fixed(rt::SdoWrite::new_bytes(0x2003, 0x00, b"Conveyor of hall 4")),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x2004, 0x00, 0x4020_0000)),
        rt::Setting::fixed(rt::SdoWrite::new_bytes(0x2005, 0x00, b"\xfe\xff\xff")),
        rt::Setting::write_only(
            rt::Setting::fixed(rt::SdoWrite::new_u16(0x2006, 0x00, 0x1234)),
        ),
        rt::Setting::fixed_default(rt::SdoWrite::new_u16(0x2009, 0x00, 0x01F4)),
    ],
    mapping: &[
        rt::Setting::fixed(rt::SdoWrite::new_u8(0x1600, 0x00, 0x00)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1600, 0x01, 0x2000_0010)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1600, 0x02, 0x2001_0010)),
        rt::Setting::fixed(rt::SdoWrite::new_u8(0x1600, 0x00, 0x02)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u8(0x1A00, 0x00, 0x00)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u32(0x1A00, 0x01, 0x2010_0010)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u8(0x1A00, 0x00, 0x01)),
    ],
    pdo_parameters: &[
        rt::Setting::fixed(rt::SdoWrite::new_u8(0x1400, 0x02, 0x01)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u8(0x1401, 0x02, 0xFF)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u8(0x1800, 0x02, 0xFF)),
        rt::Setting::fixed_default(rt::SdoWrite::new_u16(0x1800, 0x05, 0x0000)),
        rt::Setting::fixed(rt::SdoWrite::new_u16(0x1801, 0x03, 0x0064)),
        rt::Setting::fixed(rt::SdoWrite::new_u16(0x1801, 0x05, 0x0032)),
    ],
    enable_pdos: &[
        rt::Setting::from_node(rt::SdoWrite::new_u32(0x1400, 0x01, 0x0000_0200)),
        rt::Setting::from_node_default(rt::SdoWrite::new_u32(0x1800, 0x01, 0x0000_0180)),
        rt::Setting::fixed(rt::SdoWrite::new_u32(0x1801, 0x01, 0x0000_0281)),
    ],
    ..rt::Configuration::EMPTY
};
