/// EtherCAT description of Maker Drive for the master.
pub static DEVICE: rt::ethercat::Device = rt::ethercat::Device {
    identity: IDENTITY,
    sync_managers: &[
        rt::ethercat::SyncManager {
            number: 0,
            purpose: rt::ethercat::SyncManagerPurpose::Outputs,
            start_address: 0x1100,
            default_size: 0,
            min_size: None,
            max_size: None,
            control: 0x64,
            enable: true,
            op_only: false,
        },
    ],
    pdos: &[
        rt::ethercat::PdoInfo {
            index: 0x1601,
            direction: rt::ethercat::Direction::Output,
            bits: 65536,
            sync_manager: Some(0),
            excluded_sync_managers: &[],
            fixed: true,
            mandatory: false,
            depends_on: rt::ethercat::DependsOn::Nothing,
            excludes: &[],
            mapping: &[rt::MappedEntry::new(0x7000, 0x01, 65536)],
        },
        rt::ethercat::PdoInfo {
            index: 0x1602,
            direction: rt::ethercat::Direction::Output,
            bits: 65535,
            sync_manager: Some(0),
            excluded_sync_managers: &[],
            fixed: true,
            mandatory: false,
            depends_on: rt::ethercat::DependsOn::Nothing,
            excludes: &[],
            mapping: <pdo::P1602 as rt::Pdo>::MAPPING,
        },
    ],
    default_pdos: &[0x1601, 0x1602],
    mailbox: rt::ethercat::Mailbox::NONE,
    slots: None,
};
/// PDOs with their default mapping.
pub mod pdo {
    use ::lexibus as rt;
    /// RxPDO 0x1602: P1602.
    ///
    /// Mapping object 0x1602, 65535 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0.0–8191.6 | [`output_2`](Self::output_2) | [0x7000:02](super::objects::object_7000::OUTPUT_2) | `[u8; 8192]` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct P1602 {
        /// Output: [0x7000:02](super::objects::object_7000::OUTPUT_2), 65535 bits at bit offset 0.
        pub output_2: [u8; 8192],
    }
    impl P1602 {
        /// Length in bits.
        pub const BITS: u32 = 65535;
        /// Length in bytes.
        pub const LEN: usize = 8192;
        /// Returns the bytes of the PDO. Unmapped bits are 0.
        #[inline]
        pub fn pack(&self) -> [u8; 8192] {
            let mut data = [0; 8192];
            data = rt::bits::put_bits(data, 0, 65535, &self.output_2);
            data
        }
        /// Decodes the fields of the PDO. Bytes after the mapped objects are ignored.
        ///
        /// # Errors
        ///
        /// Returns an error if `data` has fewer bytes than the PDO.
        #[inline]
        pub fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {
            let Some(data) = data.first_chunk::<8192>() else {
                return Err(rt::LengthError::new(Self::LEN, data.len()));
            };
            let pdo = Self {
                output_2: rt::bits::get_bits(data, 0, 65535),
            };
            Ok(pdo)
        }
    }
    impl rt::Pdo for P1602 {
        const INDEX: u16 = 0x1602;
        const LEN: usize = Self::LEN;
        const MAPPING: &'static [rt::MappedEntry] = &[
            rt::MappedEntry::new(0x7000, 0x02, 65535),
        ];
    }
    rt::ethercrab_wire!(P1602, 8192);
}
    impl Outputs {
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 0;
        /// Length in bytes.
        pub const LEN: usize = 16384;
        /// Returns the bytes of the process image. Unmapped bits are 0.
        #[inline]
        pub fn pack(&self) -> [u8; 16384] {
            let mut data = [0; 16384];
            rt::bits::set_bytes(&mut data, 65536, &self.p1602.pack());
            data
        }
        /// Decodes the PDOs of a process image. Bytes after the image are ignored.
        ///
        /// # Errors
        ///
        /// Returns an error if `data` has fewer bytes than the image.
        #[inline]
        pub fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {
            rt::bits::check_length(data, 131071)?;
            let image = Self {
                p1602: super::pdo::P1602::unpack(
                    &rt::bits::get_bytes::<8192>(data, 65536),
                )?,
            };
            Ok(image)
        }
    }
