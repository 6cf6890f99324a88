        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x6040, 0x00, 16),
            rt::MappedEntry::new(0x60FF, 0x00, 32),
        ];
        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x0000, 0x00, 16),
            rt::MappedEntry::new(0x0000, 0x00, 32),
            rt::MappedEntry::new(0x0000, 0x00, 8),
        ];
/// SDO writes that configure the default PDO assignment. Send them in the state "Pre-Operational".
pub const STARTUP: &[rt::SdoWrite] = &[
    rt::SdoWrite::new_u8(0x1C12, 0x00, 0),
    rt::SdoWrite::new_u8(0x1C13, 0x00, 0),
    rt::SdoWrite::new_u8(0x1600, 0x00, 0),
    rt::SdoWrite::new_u32(0x1600, 0x01, 0x6040_0010),
    rt::SdoWrite::new_u32(0x1600, 0x02, 0x60FF_0020),
    rt::SdoWrite::new_u8(0x1600, 0x00, 2),
    rt::SdoWrite::new_u16(0x1C12, 0x01, 0x1600),
    rt::SdoWrite::new_u8(0x1C12, 0x00, 1),
    rt::SdoWrite::new_u16(0x1C13, 0x01, 0x1A00),
    rt::SdoWrite::new_u8(0x1C13, 0x00, 1),
];
