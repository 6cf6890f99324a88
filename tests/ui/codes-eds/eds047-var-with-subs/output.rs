    /// Speeds.
    ///
    /// RECORD 0x2000. Object type from the rule for missing or wrong object types.
    pub mod speeds {
        /// Highest sub-index: Default 1, 0x2000:00, UNSIGNED8, read-only.
        /// Accessor: [`SpeedsAccessors::highest_sub_index`].
        pub const HIGHEST_SUB_INDEX: super::ReadOnly<u8> = super::ReadOnlyU8::object_with_default(
            0x2000,
            0x00,
            "Highest sub-index",
            1,
        );
        /// First: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SpeedsAccessors::first`].
        pub const FIRST: super::ReadWrite<u16> = super::ReadWriteU16::object(
            0x2000,
            0x01,
            "First",
        );
        /// Accessors for the entries of the object. Speeds: 0x2000.
        pub struct SpeedsAccessors<'c, C> {
            pub(in super::super) client: &'c mut C,
        }
        impl<C> SpeedsAccessors<'_, C> {
            /// Highest sub-index.
            ///
            /// Default 1, 0x2000:00, UNSIGNED8, read-only.
            /// Constant: [`HIGHEST_SUB_INDEX`].
            pub fn highest_sub_index(&mut self) -> super::ReadOnlyAccess<'_, C, u8> {
                HIGHEST_SUB_INDEX.at(self.client)
            }
            /// First.
            ///
            /// 0x2000:01, UNSIGNED16, read-write.
            /// Constant: [`FIRST`].
            pub fn first(&mut self) -> super::ReadWriteAccess<'_, C, u16> {
                FIRST.at(self.client)
            }
        }
    }
