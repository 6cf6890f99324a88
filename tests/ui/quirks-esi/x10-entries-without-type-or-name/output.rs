        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x6000, 0x01, 16),
            rt::MappedEntry::new(0x6000, 0x02, 64),
            rt::MappedEntry::new(0x6000, 0x03, 65),
            rt::MappedEntry::new(0x6000, 0x04, 1),
            rt::MappedEntry::new(0x0000, 0x00, 8),
        ];
