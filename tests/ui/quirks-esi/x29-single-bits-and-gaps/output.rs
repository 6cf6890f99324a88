    /// TxPDO 0x1A00: Sensors.
    ///
    /// Mapping object 0x1A00, 44 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0.0 | [`ready`](Self::ready) | [0x6000:01](super::objects::object_6000::READY) | `bool` |
    /// | 0.1–0.2 | padding |  |  |
    /// | 0.3–0.7 | [`mode`](Self::mode) | [0x6000:02](super::objects::object_6000::MODE) | `Uint<5>` |
    /// | 1–3 | [`count`](Self::count) | [0x6010:00](super::objects::COUNT) | `Uint<24>` |
    /// | 4.0–5.3 | [`level`](Self::level) | [0x6020:00](super::objects::LEVEL) | `Uint<12>` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Sensors {
        /// Ready: [0x6000:01](super::objects::object_6000::READY), 1 bit at bit offset 0.
        pub ready: bool,
        /// Mode: [0x6000:02](super::objects::object_6000::MODE), 5 bits at bit offset 3.
        pub mode: rt::Uint<5>,
        /// Count: [0x6010:00](super::objects::COUNT), 24 bits at bit offset 8.
        pub count: rt::Uint<24>,
        /// Level: [0x6020:00](super::objects::LEVEL), 12 bits at bit offset 32.
        pub level: rt::Uint<12>,
    }
    impl Sensors {
        /// Length in bits.
        pub const BITS: u32 = 44;
        /// Length in bytes.
        pub const LEN: usize = 6;
        /// Returns the bytes of the PDO. Unmapped bits are 0.
        #[inline]
        pub const fn pack(&self) -> [u8; 6] {
            let mut word = 0;
            let bits = self.ready as u64;
            word |= bits;
            let bits = self.mode.raw();
            word |= bits << 3;
            let bits = self.count.raw();
            word |= bits << 8;
            let bits = self.level.raw();
            word |= bits << 32;
            rt::pdo::to_bytes(word)
        }
        /// Decodes the fields of the PDO. Bytes after the mapped objects are ignored.
        ///
        /// # Errors
        ///
        /// Returns an error if `data` has fewer bytes than the PDO.
        #[inline]
        pub const fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {
            let Some(data) = data.first_chunk::<6>() else {
                return Err(rt::LengthError::new(Self::LEN, data.len()));
            };
            let word = rt::pdo::from_bytes(data);
            let pdo = Self {
                ready: (word) & 1 == 1,
                mode: rt::Uint::from_raw(word >> 3),
                count: rt::Uint::from_raw(word >> 8),
                level: rt::Uint::from_raw(word >> 32),
            };
            Ok(pdo)
        }
    }
        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x6000, 0x01, 1),
            rt::MappedEntry::new(0x0000, 0x00, 2),
            rt::MappedEntry::new(0x6000, 0x02, 5),
            rt::MappedEntry::new(0x6010, 0x00, 24),
            rt::MappedEntry::new(0x6020, 0x00, 12),
        ];
