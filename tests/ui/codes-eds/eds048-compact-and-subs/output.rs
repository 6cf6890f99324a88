    /// Speeds.
    ///
    /// ARRAY 0x2000.
    pub mod speeds {
        /// NrOfObjects: Default 2, 0x2000:00, UNSIGNED8, read-only.
        /// Accessor: [`SpeedsAccessors::nr_of_objects`].
        ///
        /// Name, type, access rights and default from the rule for compact sub-indices.
        pub const NR_OF_OBJECTS: super::ReadOnly<u8> = super::ReadOnlyU8::object_with_default(
            0x2000,
            0x00,
            "NrOfObjects",
            2,
        );
        /// Described: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SpeedsAccessors::described`].
        pub const DESCRIBED: super::ReadWrite<u16> = super::ReadWriteU16::object(
            0x2000,
            0x01,
            "Described",
        );
        /// Speeds2: 0x2000:02, UNSIGNED16, read-only.
        /// Accessor: [`SpeedsAccessors::speeds2`].
        pub const SPEEDS2: super::ReadOnly<u16> = super::ReadOnlyU16::object(
            0x2000,
            0x02,
            "Speeds2",
        );
        /// Accessors for the entries of the object. Speeds: 0x2000.
        pub struct SpeedsAccessors<'c, C> {
            pub(in super::super) client: &'c mut C,
        }
        impl<C> SpeedsAccessors<'_, C> {
            /// NrOfObjects.
            ///
            /// Default 2, 0x2000:00, UNSIGNED8, read-only.
            /// Constant: [`NR_OF_OBJECTS`].
            pub fn nr_of_objects(&mut self) -> super::ReadOnlyAccess<'_, C, u8> {
                NR_OF_OBJECTS.at(self.client)
            }
            /// Described.
            ///
            /// 0x2000:01, UNSIGNED16, read-write.
            /// Constant: [`DESCRIBED`].
            pub fn described(&mut self) -> super::ReadWriteAccess<'_, C, u16> {
                DESCRIBED.at(self.client)
            }
            /// Speeds2.
            ///
            /// 0x2000:02, UNSIGNED16, read-only.
            /// Constant: [`SPEEDS2`].
            pub fn speeds2(&mut self) -> super::ReadOnlyAccess<'_, C, u16> {
                SPEEDS2.at(self.client)
            }
        }
    }
