//! The macro `pdo!`.
//!
//! A declarative macro needs no cargo feature and runs no code on the build machine. The macro refers to names in
//! generated code: PDOs in the module `remappable`, objects in `mappable`. If a name is unknown, rustc reports the
//! error at the position of the name. If a single field is invalid, rustc reports that a trait isn't implemented. If
//! the mapping as a whole is invalid, a constant panics at compile time.

/// Declares a custom mapping: a struct for a PDO with a writable mapping. The mapping is checked at compile time.
///
/// ```
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::{self, types::Controlword};
///
/// lexibus::pdo! {
///     /// Cyclic setpoints.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub struct Fast: demo_drive::pdo::RxPdo2 { controlword, profile_velocity }
/// }
///
/// lexibus::pdo! {
///     /// Cyclic actual values.
///     pub struct Feedback: demo_drive::pdo::TxPdo2 {
///         /// An entry of an array, with a custom field name.
///         pressure: analog_inputs::input_2,
///         position: position_actual_value,
///     }
/// }
///
/// let frame = Fast { controlword: Controlword::from_raw(0x000F), profile_velocity: 1000 }.pack();
/// assert_eq!(frame, [0x0F, 0x00, 0xE8, 0x03, 0x00, 0x00]);
/// assert_eq!(Feedback::unpack(&[0xFE, 0xFF, 5, 0, 0, 0])?.pressure, -2);
///
/// // The writes for CANopen: disable the PDO, clear, write and count the mapping, set the timing, enable the PDO.
/// # let node_id = NodeId::new(5).unwrap();
/// for write in Fast::configuration(node_id) {
///     println!("{write:?}");
/// }
/// # Ok::<(), lexibus::LengthError>(())
/// ```
///
/// The path in the declaration is the path of the PDO's struct in the module `pdo` of the device. Use a path of the
/// same form for a PDO without a default mapping, although such a PDO has no struct.
///
/// A field has the name and the value type of an accessor of the device, such as `controlword`. For an entry of an
/// array or a record, write a field name and the path of the entry: `pressure: analog_inputs::input_2`. `_: 8` is a gap
/// of 8 bits. On EtherCAT, a gap is padding. On CANopen, a gap is a dummy entry (CiA 301 7.4.9.2) that the device must
/// support.
///
/// The macro keeps the attributes of the struct and its fields. Use `#[derive]` for the traits that you need.
///
/// # Generated items
///
/// The struct has the same items as the struct of a generated PDO: `BITS`, `LEN`, `COB_ID`, `pack`, `unpack` and an
/// implementation of [`Pdo`](crate::Pdo). In addition, the struct has these methods:
///
/// - `configuration(node_id)` and `configuration_as(cob_id)` return the writes that configure a CANopen device.
/// - `mapping_writes()` returns only the writes of the mapping. On EtherCAT, send the writes of the mapping in
///   Pre-Operational while the PDO isn't assigned.
///   [`Assignment::with_mapping`](crate::ethercat::Assignment::with_mapping) includes these writes in the assignment.
///
/// # Compile-time checks
///
/// - The mapping of the PDO must be writable.
/// - Each object must exist (`cannot find type … in module …::mappable`), be mappable, and be mappable in the PDO's
///   direction.
/// - The length of each object must be a multiple of the granularity.
/// - On CANopen, the device must support a dummy entry for each gap. On EtherCAT, a gap has 1 to 255 bits.
/// - The mapping object must have enough sub-indices for all entries. The number of bits must not exceed 64 on CANopen,
///   or the maximum length of the sync manager on EtherCAT.
/// - The mapping must include all fixed entries (`Fixed`, ETG.2000).
///
/// An object is mappable if the device description allows its mapping, or maps the object by default. If the
/// description is incomplete, use an overlay to set `pdo = "rx"`, `"tx"` or `"both"`.
///
/// A mapping of more than 60 fields with doc comments may need `#![recursion_limit = "256"]`.
#[macro_export]
macro_rules! pdo {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: $($segment:ident)::+ { $($body:tt)* }) => {
        $crate::pdo!(@path [$(#[$attribute])* $visibility] $name [] [$($segment)+] { $($body)* });
    };
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: :: $($segment:ident)::+ { $($body:tt)* }) => {
        $crate::pdo!(@path [$(#[$attribute])* $visibility] $name [::] [$($segment)+] { $($body)* });
    };

    // The path of the device is everything before `pdo::Name`.
    (@path $head:tt $name:ident [$($device:tt)+] [pdo $pdo:ident] $body:tt) => {
        $crate::pdo!(@path $head $name [$($device)+] { $($device)+ remappable::$pdo } $body);
    };
    (@path $head:tt $name:ident $device:tt { $path:ty } $body:tt) => {
        $crate::pdo!(@entries $head $name $device $path, [] [] [] [] $body);
    };
    (@path $head:tt $name:ident [$($device:tt)*] [$first:ident $second:ident $($rest:ident)+] $body:tt) => {
        $crate::pdo!(@path $head $name [$($device)* $first ::] [$second $($rest)+] $body);
    };
    (@path $head:tt $name:ident [$($device:tt)*] [$($rest:ident)*] $body:tt) => {
        ::core::compile_error!(::core::concat!(
            "expected the full path of a PDO, such as `drive::pdo::RxPdo1`; found `",
            ::core::stringify!($($device)* $($rest)::*), "`"
        ));
    };

    // Processes one entry at a time: `[fields] [mapping words] [bits so far] [attributes of the next field] { rest }`.
    // A field is a `tt` because errors at an `ident` would point to the whole call.
    (@entries $head:tt $name:ident $device:tt $path:ty, $fields:tt $words:tt $bits:tt [$($attributes:tt)*]
        { #[$one:meta] #[$two:meta] #[$three:meta] #[$four:meta] $($rest:tt)* }
    ) => {
        $crate::pdo!(@entries $head $name $device $path, $fields $words $bits
            [$($attributes)* #[$one] #[$two] #[$three] #[$four]] { $($rest)* });
    };
    (@entries $head:tt $name:ident $device:tt $path:ty, $fields:tt $words:tt $bits:tt [$($attributes:tt)*]
        { #[$one:meta] $($rest:tt)* }
    ) => {
        $crate::pdo!(@entries $head $name $device $path, $fields $words $bits
            [$($attributes)* #[$one]] { $($rest)* });
    };
    (@entries $head:tt $name:ident $device:tt $path:ty, $fields:tt [$($words:tt)*] [$($bits:tt)*] []
        { _: $gap:literal $(, $($rest:tt)*)? }
    ) => {
        $crate::pdo!(@entries $head $name $device $path, $fields
            [$($words)* { gap $gap }] [$($bits)* + $gap] [] { $($($rest)*)? });
    };
    (@entries $head:tt $name:ident [$($device:tt)*] $path:ty, [$($fields:tt)*] [$($words:tt)*] [$($bits:tt)*]
        $attributes:tt { $field:tt $(, $($rest:tt)*)? }
    ) => {
        $crate::pdo!(@entries $head $name [$($device)*] $path,
            [$($fields)* { $attributes $field [$($device)* mappable::$field] [$($bits)*] }]
            [$($words)* { item $($device)* mappable::$field }]
            [$($bits)* + <$($device)* mappable::$field as $crate::pdo::Mapped>::BITS] [] { $($($rest)*)? });
    };
    (@entries $head:tt $name:ident $device:tt $path:ty, $fields:tt $words:tt $bits:tt $attributes:tt
        { $field:tt: types::$type:ident $($rest:tt)* }
    ) => {
        $crate::pdo!(@typed $field types::$type);
    };
    (@entries $head:tt $name:ident [$($device:tt)*] $path:ty, [$($fields:tt)*] [$($words:tt)*] [$($bits:tt)*]
        $attributes:tt { $field:tt: $($segment:ident)::+ $(, $($rest:tt)*)? }
    ) => {
        $crate::pdo!(@refuse $field $($segment)::+);
        $crate::pdo!(@entries $head $name [$($device)*] $path,
            [$($fields)* { $attributes $field [$($device)* mappable::$($segment)::+] [$($bits)*] }]
            [$($words)* { item $($device)* mappable::$($segment)::+ }]
            [$($bits)* + <$($device)* mappable::$($segment)::+ as $crate::pdo::Mapped>::BITS]
            [] { $($($rest)*)? });
    };

    (@entries [$(#[$attribute:meta])* $visibility:vis] $name:ident $device:tt $path:ty,
        [$({ [$(#[$field_attribute:meta])*] $field:tt [$item:ty] [$($at:tt)*] })+] [$($word:tt)+] $bits:tt [] {}
    ) => {
        $(#[$attribute])*
        $visibility struct $name {
            $(
                $(#[$field_attribute])*
                #[doc = ::core::concat!("Mapped from `", ::core::stringify!($item), "`.")]
                pub $field: <$item as $crate::pdo::Mapped>::Field,
            )+
        }

        $crate::ethercrab_wire!($name, $name::LEN);

        impl $crate::Pdo for $name {
            const INDEX: u16 = <$path as $crate::pdo::Remappable>::INDEX;
            const LEN: usize = Self::LEN;
            const MAPPING: &'static [$crate::MappedEntry] =
                &$crate::pdo::custom::entries([$($crate::pdo!(@word $path, $word)),+]);
        }

        impl $name {
            /// Length in bits.
            pub const BITS: u32 = $crate::pdo::custom::bits(<Self as $crate::Pdo>::MAPPING);
            /// Length in bytes.
            pub const LEN: usize = Self::BITS.div_ceil(8) as usize;
            /// The default COB-ID (CiA 301 7.5.2.35).
            pub const COB_ID: $crate::CobId = <$path as $crate::pdo::Remappable>::COB_ID;

            /// Returns the bytes of the PDO. Unmapped bits are 0.
            #[inline]
            #[must_use]
            pub fn pack(&self) -> [u8; Self::LEN] {
                $crate::pdo::custom::Frame::<{ Self::LEN }>::new()
                    $(.with(self.$field, const { 0 $($at)* }, const { <$item as $crate::pdo::Mapped>::BITS }))+
                    .into_bytes()
            }

            /// Decodes the fields of the PDO. Bytes after the mapped objects are ignored.
            ///
            /// # Errors
            ///
            /// Returns `LengthError` if `data` is shorter than the PDO.
            #[inline]
            pub fn unpack(data: &[u8]) -> ::core::result::Result<Self, $crate::LengthError> {
                match $crate::pdo::custom::Fields::<{ Self::LEN }>::new(data) {
                    ::core::result::Result::Ok(fields) => ::core::result::Result::Ok(Self {
                        $($field: fields.get(
                            const { 0 $($at)* },
                            const { <$item as $crate::pdo::Mapped>::BITS },
                        ),)+
                    }),
                    ::core::result::Result::Err(error) => ::core::result::Result::Err(error),
                }
            }

            /// Returns only the writes of the mapping: clear the mapping, write the entries, write the number of
            /// entries.
            ///
            /// On EtherCAT, send the writes in Pre-Operational while the PDO is not assigned. On CANopen, the PDO must
            /// be disabled.
            #[must_use]
            pub const fn mapping_writes() -> [$crate::SdoWrite; <Self as $crate::Pdo>::MAPPING.len() + 2] {
                $crate::pdo::custom::mapping_writes::<$path, { <Self as $crate::Pdo>::MAPPING.len() + 2 }>(
                    <Self as $crate::Pdo>::MAPPING,
                )
            }

            /// Returns the writes that configure and enable the PDO with the default COB-ID in a CANopen device.
            #[must_use]
            pub const fn configuration(
                node_id: $crate::NodeId,
            ) -> [$crate::SdoWrite; $crate::pdo::custom::configuration_len::<$path>(<Self as $crate::Pdo>::MAPPING)]
            where
                for<'a> <$path as $crate::pdo::Remappable>::CobId: $crate::pdo::custom::IsCobId<'a>,
            {
                $crate::pdo::custom::configuration::<
                    $path,
                    { $crate::pdo::custom::configuration_len::<$path>(<Self as $crate::Pdo>::MAPPING) },
                >(<Self as $crate::Pdo>::MAPPING, Self::COB_ID.resolve(node_id))
            }

            /// Returns the writes that configure and enable the PDO with the COB-ID `cob_id` in a CANopen device. In
            /// order, they disable the PDO, clear the mapping, write the entries and their number, set the transmission
            /// type and timers, and enable the PDO. Read-only parameters are left out.
            #[must_use]
            pub const fn configuration_as(
                cob_id: u32,
            ) -> [$crate::SdoWrite; $crate::pdo::custom::configuration_len::<$path>(<Self as $crate::Pdo>::MAPPING)]
            where
                for<'a> <$path as $crate::pdo::Remappable>::CobId: $crate::pdo::custom::IsOnCanOpen<'a>,
            {
                $crate::pdo::custom::configuration::<
                    $path,
                    { $crate::pdo::custom::configuration_len::<$path>(<Self as $crate::Pdo>::MAPPING) },
                >(<Self as $crate::Pdo>::MAPPING, cob_id)
            }
        }

        // An alias with the name of the field makes compiler errors point to the field.
        $(
            #[allow(non_camel_case_types)]
            const _: () = {
                type MappedInto = <$item as $crate::pdo::Mapped>::Direction;
                type Granularity = $crate::pdo::custom::Check<
                    { $crate::pdo::custom::check::is_multiple::<$path>(<$item as $crate::pdo::Mapped>::BITS) },
                >;
                type Length = $crate::pdo::custom::Check<
                    {
                        $crate::pdo::custom::check::fits_bits::<$path>(
                            0 $($at)* + <$item as $crate::pdo::Mapped>::BITS,
                        )
                    },
                >;
                {
                    type $field = MappedInto;
                    type Direction = <$path as $crate::pdo::Remappable>::Direction;
                    <$field as $crate::pdo::custom::IsMappable>::HOLDS;
                    <$field as $crate::pdo::custom::MappableInto<Direction>>::HOLDS
                }
                {
                    type $field = Granularity;
                    <$field as $crate::pdo::custom::FitsGranularity>::HOLDS
                }
                {
                    type $field = Length;
                    <$field as $crate::pdo::custom::FitsLength>::HOLDS
                }
            };
        )+
        const _: () = {
            let mapping = <$name as $crate::Pdo>::MAPPING;
            ::core::assert!(
                $crate::pdo::custom::check::has_gaps(mapping),
                ::core::concat!(
                    "`", ::core::stringify!($name), "` has a gap `_` that cannot be mapped: ",
                    "the device has no dummy entry of that length for this PDO"
                )
            );
            ::core::assert!(
                $crate::pdo::custom::check::fits_entries::<$path>(mapping),
                ::core::concat!("`", ::core::stringify!($name), "` has more entries than this PDO can have")
            );
            ::core::assert!(
                // A field beyond the end is reported at the field.
                $crate::pdo::custom::check::fits_bits::<$path>($crate::pdo::custom::bits(mapping))
                    $(|| !$crate::pdo::custom::check::fits_bits::<$path>(
                        0 $($at)* + <$item as $crate::pdo::Mapped>::BITS,
                    ))+,
                ::core::concat!(
                    "`", ::core::stringify!($name), "` has a gap `_` beyond the maximum length of this PDO: ",
                    "64 bits on CANopen, the length of the sync manager on EtherCAT"
                )
            );
            ::core::assert!(
                $crate::pdo::custom::check::keeps_fixed::<$path>(mapping),
                ::core::concat!("`", ::core::stringify!($name), "` lacks a fixed entry of this PDO")
            );
        };
    };

    // A field has the type of its object.
    (@refuse $field:tt bool) => { $crate::pdo!(@typed $field bool); };
    (@refuse $field:tt u8) => { $crate::pdo!(@typed $field u8); };
    (@refuse $field:tt u16) => { $crate::pdo!(@typed $field u16); };
    (@refuse $field:tt u32) => { $crate::pdo!(@typed $field u32); };
    (@refuse $field:tt u64) => { $crate::pdo!(@typed $field u64); };
    (@refuse $field:tt i8) => { $crate::pdo!(@typed $field i8); };
    (@refuse $field:tt i16) => { $crate::pdo!(@typed $field i16); };
    (@refuse $field:tt i32) => { $crate::pdo!(@typed $field i32); };
    (@refuse $field:tt i64) => { $crate::pdo!(@typed $field i64); };
    (@refuse $field:tt f32) => { $crate::pdo!(@typed $field f32); };
    (@refuse $field:tt f64) => { $crate::pdo!(@typed $field f64); };
    (@refuse $field:tt $($object:tt)+) => {};
    (@typed $field:tt $($type:tt)+) => {
        ::core::compile_error!(::core::concat!(
            "`", ::core::stringify!($field: $($type)+), "` names a type. A field has the type of its object: write `",
            ::core::stringify!($field), "`, or the name of an object after the colon"
        ));
    };

    (@word $path:ty, { gap $gap:literal }) => {
        $crate::pdo::custom::gap::<$path>($gap)
    };
    (@word $path:ty, { item $item:ty }) => {
        <$item as $crate::pdo::Mapped>::WORD
    };

    (@entries $head:tt $name:ident $device:tt $path:ty, [] $words:tt $bits:tt $attributes:tt {}) => {
        ::core::compile_error!(::core::concat!("`", ::core::stringify!($name), "` has no field"));
    };
    (@entries $head:tt $name:ident $device:tt $path:ty, $fields:tt $words:tt $bits:tt $attributes:tt { $($rest:tt)* }) => {
        ::core::compile_error!(::core::concat!(
            "expected `field`, `field: name` or `field: object::entry`, or a gap `_: 8`, separated by commas; found `",
            ::core::stringify!($($rest)*), "`"
        ));
    };
    ($($other:tt)*) => {
        ::core::compile_error!("expected `pub struct Name: drive::pdo::RxPdo1 { field, field: object::entry, _: 8 }`");
    };
}
