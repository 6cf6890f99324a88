        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x6000, 0x01, 3),
            rt::MappedEntry::new(0x0000, 0x00, 5),
            rt::MappedEntry::new(0x6000, 0x02, 8),
        ];
