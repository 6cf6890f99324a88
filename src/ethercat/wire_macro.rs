//! The macro `ethercrab_wire!`.

/// Implements the wire traits of the crate `ethercrab` for a PDO struct, if the feature `ethercat` of `lexibus` is
/// enabled: `EtherCrabWireRead`, `EtherCrabWireWrite`, `EtherCrabWireSized` and `EtherCrabWireWriteSized`. `ethercrab`
/// implements `EtherCrabWireReadWrite` and `EtherCrabWireReadSized` for every type with these traits. Without the
/// feature, the macro expands to nothing.
///
/// In `ethercrab_wire!(Type, BYTES)`, the type must have the methods `pack(&self) -> [u8; BYTES]` and
/// `unpack(&[u8]) -> Result<Self, LengthError>`.
///
/// Structs of [`pdo!`](crate::pdo!) and generated structs of PDOs on EtherCAT already have these traits. Use the macro
/// for a handwritten struct:
///
/// ```
/// struct Counter {
///     value: u16,
/// }
///
/// impl Counter {
///     fn pack(&self) -> [u8; 2] {
///         self.value.to_le_bytes()
///     }
///
///     fn unpack(data: &[u8]) -> Result<Self, lexibus::LengthError> {
///         let Some(bytes) = data.first_chunk() else { return Err(lexibus::LengthError::new(2, data.len())) };
///         Ok(Counter { value: u16::from_le_bytes(*bytes) })
///     }
/// }
///
/// lexibus::ethercrab_wire!(Counter, 2);
/// ```
///
/// If a buffer is too short, `unpack_from_slice` and `pack_to_slice` return an error of `ethercrab`.
/// `pack_to_slice_unchecked` panics in this case, as `ethercrab` requires.
#[cfg(feature = "ethercat")]
#[macro_export]
macro_rules! ethercrab_wire {
    ($type:ty, $bytes:expr $(,)?) => {
        impl $crate::clients::ethercat::wire::EtherCrabWireSized for $type {
            const PACKED_LEN: usize = $bytes;
            type Buffer = [u8; $bytes];

            fn buffer() -> Self::Buffer {
                [0; $bytes]
            }
        }

        impl $crate::clients::ethercat::wire::EtherCrabWireWriteSized for $type {
            fn pack(&self) -> Self::Buffer {
                <$type>::pack(self)
            }
        }

        impl $crate::clients::ethercat::wire::EtherCrabWireWrite for $type {
            fn pack_to_slice_unchecked<'buffer>(&self, buffer: &'buffer mut [u8]) -> &'buffer [u8] {
                $crate::clients::ethercat::wire::copy::<{ $bytes }>(<$type>::pack(self), buffer)
            }

            fn packed_len(&self) -> usize {
                $bytes
            }
        }

        impl $crate::clients::ethercat::wire::EtherCrabWireRead for $type {
            fn unpack_from_slice(
                buffer: &[u8],
            ) -> ::core::result::Result<Self, $crate::clients::ethercat::wire::WireError> {
                $crate::clients::ethercat::wire::read(<$type>::unpack(buffer))
            }
        }
    };
}

/// Implements the wire traits of the crate `ethercrab` for a PDO struct, if the feature `ethercat` of `lexibus` is
/// enabled. The feature is not enabled, so the macro expands to nothing.
///
/// ```
/// struct Counter {
///     value: u16,
/// }
///
/// impl Counter {
///     fn pack(&self) -> [u8; 2] {
///         self.value.to_le_bytes()
///     }
///
///     fn unpack(data: &[u8]) -> Result<Self, lexibus::LengthError> {
///         let Some(bytes) = data.first_chunk() else { return Err(lexibus::LengthError::new(2, data.len())) };
///         Ok(Counter { value: u16::from_le_bytes(*bytes) })
///     }
/// }
///
/// lexibus::ethercrab_wire!(Counter, 2);
/// ```
#[cfg(not(feature = "ethercat"))]
#[macro_export]
macro_rules! ethercrab_wire {
    ($type:ty, $bytes:expr $(,)?) => {};
}
