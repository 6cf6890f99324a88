//! The macro `pdo!`.
//!
//! It is a declarative one, so that it needs no feature and runs no code on the build machine. Generated code has what it
//! looks up by name: `remappable` the PDOs, `mappable` the objects. A name that isn't there can't be mapped, and rustc says
//! so at the name; what two things don't agree on is a trait that isn't implemented, and what all of them don't is a constant
//! that panics.

/// A mapping of one's own: a struct for a PDO whose mapping the device lets anyone change, checked while it is compiled.
///
/// ```
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::{self, types::Controlword};
///
/// lexibus::pdo! {
///     /// Cyclic set-points.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub struct Fast: demo_drive::pdo::RxPdo2 { controlword, profile_velocity }
/// }
///
/// lexibus::pdo! {
///     /// What comes back.
///     pub struct Feedback: demo_drive::pdo::TxPdo2 {
///         /// Under a name of one's own: an entry of an array.
///         pressure: analogue_inputs::input_2,
///         position: position_actual_value,
///     }
/// }
///
/// let frame = Fast { controlword: Controlword::from_raw(0x000F), profile_velocity: 1000 }.pack();
/// assert_eq!(frame, [0x0F, 0x00, 0xE8, 0x03, 0x00, 0x00]);
/// assert_eq!(Feedback::unpack(&[0xFE, 0xFF, 5, 0, 0, 0])?.pressure, -2);
///
/// // On CANopen: disable, clear, map, count, timing, enable.
/// # let node_id = NodeId::new(5).unwrap();
/// for write in Fast::configuration(node_id) {
///     println!("{write:?}");
/// }
/// # Ok::<(), lexibus::LengthError>(())
/// ```
///
/// The path is that of the PDO's struct in `pdo`, through the module of its device; a PDO that is empty by default is named
/// in the same way. Fields are called as the accessors: `controlword`, or `analogue_inputs::input_2` for an entry of
/// an array or a record, behind a name for the field. They have the types of the values. `_: 8` is a gap of 8 bits: a dummy
/// entry on CANopen (CiA 301 7.4.9.2), which the device has to have, and padding on EtherCAT. Attributes of the struct
/// and its fields are passed on; nothing is derived that isn't asked for.
///
/// # What it makes
///
/// As the structs of generated code: `BITS`, `LEN`, `COB_ID`, `pack`, `unpack`, an implementation of [`Pdo`](crate::Pdo), and
///
/// - on CANopen `configuration(node_id)` and `configuration_as(cob_id)`, the writes that set the device up;
/// - `mapping_writes()`, those of the mapping alone: what EtherCAT needs in Pre-Operational while the PDO isn't assigned.
///   [`Assignment::with_mapping`](crate::ethercat::Assignment::with_mapping) has them at their place in the assignment.
///
/// # What the compiler checks
///
/// The PDO can be mapped anew, and each object exists and can be mapped (`cannot find type … in module …::mappable`) in its
/// direction; the bits of each are a multiple of the granularity; there are dummy entries for all gaps, no more entries than
/// the mapping object has, and no more bits than 64 on CANopen or than the sync manager takes on EtherCAT; and entries that the
/// device keeps are there (`Fixed`, ETG.2000).
///
/// An object can be mapped where the description says so, or maps it by default. A description that says too
/// little is corrected by an overlay, with `pdo = "rx"`, `"tx"` or `"both"`.
///
/// A mapping of more than 60 documented fields may need `#![recursion_limit = "256"]`.
#[macro_export]
macro_rules! pdo {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: $($segment:ident)::+ { $($body:tt)* }) => {
        $crate::pdo!(@path [$(#[$attribute])* $visibility] $name [] [$($segment)+] { $($body)* });
    };
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: :: $($segment:ident)::+ { $($body:tt)* }) => {
        $crate::pdo!(@path [$(#[$attribute])* $visibility] $name [::] [$($segment)+] { $($body)* });
    };

    // The path to the device is what stands in front of `pdo::Name`.
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
            "expected the path of a PDO that leads through its device, as `drive::pdo::RxPdo1`; found `",
            ::core::stringify!($($device)* $($rest)::*), "`"
        ));
    };

    // Entries one by one: `[fields] [words of the mapping] [bits so far] [attributes of the next field] { rest }`. A field is
    // a `tt` and not an `ident`, or errors would point to the whole call.
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
    (@entries $head:tt $name:ident [$($device:tt)*] $path:ty, [$($fields:tt)*] [$($words:tt)*] [$($bits:tt)*]
        $attributes:tt { $field:tt: $($segment:ident)::+ $(, $($rest:tt)*)? }
    ) => {
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
            /// The identifier by default (CiA 301 7.5.2.35).
            pub const COB_ID: $crate::CobId = <$path as $crate::pdo::Remappable>::COB_ID;

            /// The bytes of a frame; padding is zero.
            #[inline]
            #[must_use]
            pub fn pack(&self) -> [u8; Self::LEN] {
                $crate::pdo::custom::Frame::<{ Self::LEN }>::new()
                    $(.with(self.$field, const { 0 $($at)* }, const { <$item as $crate::pdo::Mapped>::BITS }))+
                    .into_bytes()
            }

            /// The fields of a frame. Bytes behind the mapped ones are not looked at.
            ///
            /// # Errors
            ///
            /// When `data` has fewer bytes than the PDO.
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

            /// The writes that map the PDO, and nothing else: clear, map, count. On EtherCAT they belong into
            /// Pre-Operational, with the PDO not assigned; on CANopen the PDO has to be off meanwhile.
            #[must_use]
            pub const fn mapping_writes() -> [$crate::SdoWrite; <Self as $crate::Pdo>::MAPPING.len() + 2] {
                $crate::pdo::custom::mapping_writes::<$path, { <Self as $crate::Pdo>::MAPPING.len() + 2 }>(
                    <Self as $crate::Pdo>::MAPPING,
                )
            }

            /// The writes that set the PDO up in a CANopen device with its default identifier, and switch it on.
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

            /// The writes that set the PDO up in a CANopen device with the identifier `cob_id`: disable, clear, map,
            /// count, timing, enable. What the device lets nobody write is left out.
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

        // An alias with the name of the field: what the compiler has to say of it points to the field.
        $(
            #[allow(non_camel_case_types)]
            const _: () = {
                type MappedObject = $item;
                type Granularity = $crate::pdo::custom::Check<
                    { $crate::pdo::custom::check::is_multiple::<$path>(<$item as $crate::pdo::Mapped>::BITS) },
                >;
                {
                    type $field = MappedObject;
                    type Direction = <$path as $crate::pdo::Remappable>::Direction;
                    <$field as $crate::pdo::custom::MappableInto<Direction>>::HOLDS
                }
                {
                    type $field = Granularity;
                    <$field as $crate::pdo::custom::FitsGranularity>::HOLDS
                }
            };
        )+
        const _: () = {
            let mapping = <$name as $crate::Pdo>::MAPPING;
            ::core::assert!(
                $crate::pdo::custom::check::has_gaps(mapping),
                ::core::concat!(
                    "`", ::core::stringify!($name), "` has a gap `_` that the device can't map: it has no dummy entry ",
                    "of that many bits for this PDO, or for such a PDO none at all"
                )
            );
            ::core::assert!(
                $crate::pdo::custom::check::fits_entries::<$path>(mapping),
                ::core::concat!("`", ::core::stringify!($name), "` has more entries than the device maps into this PDO")
            );
            ::core::assert!(
                $crate::pdo::custom::check::fits_bits::<$path>(mapping),
                ::core::concat!(
                    "`", ::core::stringify!($name), "` has more bits than this PDO can have: 64 on CANopen, what the ",
                    "sync manager takes on EtherCAT"
                )
            );
            ::core::assert!(
                $crate::pdo::custom::check::keeps_fixed::<$path>(mapping),
                ::core::concat!(
                    "`", ::core::stringify!($name), "` leaves out an entry that the device doesn't let anyone take out ",
                    "of this PDO"
                )
            );
        };
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
            "expected `field`, `field: name` or `field: object::entry`, or a gap `_: 8`, with commas in between; found `",
            ::core::stringify!($($rest)*), "`"
        ));
    };
    ($($other:tt)*) => {
        ::core::compile_error!("expected `pub struct Name: drive::pdo::RxPdo1 { field, field: object::entry, _: 8 }`");
    };
}
