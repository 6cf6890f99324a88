    /// 0x2022.
    ///
    /// RECORD 0x2022. Object type from the rule for missing or wrong object types.
    pub mod object_2022 {
        /// Highest sub-index: Default 1, 0x2022:00, UNSIGNED8, read-only.
        /// Accessor: [`Object2022Accessors::highest_sub_index`].
        pub const HIGHEST_SUB_INDEX: super::ReadOnly<u8> = super::ReadOnlyU8::object_with_default(
            0x2022,
            0x00,
            "Highest sub-index",
            1,
        );
        /// Speed: 0x2022:01, UNSIGNED16, read-write.
        /// Accessor: [`Object2022Accessors::speed`].
        pub const SPEED: super::ReadWrite<u16> = super::ReadWriteU16::object(
            0x2022,
            0x01,
            "Speed",
        );
        /// Accessors for the entries of the object. 0x2022.
        pub struct Object2022Accessors<'c, C> {
            pub(in super::super) client: &'c mut C,
        }
        impl<C> Object2022Accessors<'_, C> {
            /// Highest sub-index.
            ///
            /// Default 1, 0x2022:00, UNSIGNED8, read-only.
            /// Constant: [`HIGHEST_SUB_INDEX`].
            pub fn highest_sub_index(&mut self) -> super::ReadOnlyAccess<'_, C, u8> {
                HIGHEST_SUB_INDEX.at(self.client)
            }
            /// Speed.
            ///
            /// 0x2022:01, UNSIGNED16, read-write.
            /// Constant: [`SPEED`].
            pub fn speed(&mut self) -> super::ReadWriteAccess<'_, C, u16> {
                SPEED.at(self.client)
            }
        }
    }
