//! Custom mappings: traits for PDOs with a writable mapping and for mappable objects, and the checks of
//! [`pdo!`](crate::pdo!).

use core::marker::PhantomData;

use super::cob_id::CobId;
pub use super::field::{Fields, Frame};
use super::mapping::MappedEntry;
use super::sdo_write::SdoWrite;

/// A PDO with a writable mapping. Generated code implements this trait.
pub trait Remappable {
    /// Direction of the PDO: [`Rpdo`] or [`Tpdo`].
    type Direction;

    /// Type of the default COB-ID: [`CobId`], [`NoCobId`] if there is no default, or [`OnEtherCat`].
    type CobId: Identifier;

    /// The default COB-ID (CiA 301 7.5.2.35). If there is no default, the constant is the COB-ID of a disabled PDO.
    const COB_ID: CobId = CobId::fixed(0x8000_0000);

    /// Index of the mapping object.
    const INDEX: u16;

    /// Maximum number of entries in the mapping object.
    const ENTRIES: usize;

    /// Maximum length in bits: 64 on CANopen, or the maximum length of the sync manager on EtherCAT.
    const MAX_BITS: u32 = 64;

    /// Granularity of the mapping in bits (`Granularity` of CiA 306). The length of each entry is a multiple of the
    /// granularity.
    const GRANULARITY: u32 = 1;

    /// Data types that are allowed as dummy entries (`DummyUsage` of CiA 306). Each bit represents one data type. For
    /// example, bit 5 represents UNSIGNED8 (0x0005). On EtherCAT, gaps don't need dummy entries.
    const DUMMIES: u32 = 0;

    /// Entries that must stay in the mapping (`Fixed` of an entry, ETG.2000).
    const KEPT: &'static [MappedEntry] = &[];

    /// Index of the communication parameters; `None` on EtherCAT, and if the COB-ID is read-only.
    const COMMUNICATION: Option<u16> = None;

    /// Writes that set the default transmission type and timers.
    const TIMING: &'static [SdoWrite] = &[];
}

/// Marks a PDO that the device receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rpdo {}

/// Marks a PDO that the device transmits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tpdo {}

/// Marks an object that can be mapped into PDOs of either direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyPdo {}

/// Marks an object that cannot be mapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPdo {}

/// Marks a CANopen PDO that has no default COB-ID.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoCobId {}

/// Marks an EtherCAT PDO, which has no COB-ID.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnEtherCat {}

/// An object that can be mapped into PDOs of direction `D`. The field of the PDO has the type `F`. `WORD` is the
/// mapping entry of the object.
///
/// The generated module `mappable` has a type alias for each object.
pub struct Mappable<F, D, const WORD: u32>(PhantomData<fn() -> (F, D)>);

/// An object that cannot be mapped. [`pdo!`](crate::pdo!) reports such an object as an error.
pub type NotMappable = Mappable<u8, NoPdo, 8>;

/// The field and the mapping entry of a [`Mappable`].
pub trait Mapped {
    /// The type of the field.
    type Field;

    /// The direction of PDOs that can contain the object: [`Rpdo`], [`Tpdo`], [`AnyPdo`] or [`NoPdo`].
    type Direction;

    /// Mapping entry, encoded as in the mapping object: index, sub-index and length in bits, with the index in the most
    /// significant bytes.
    const WORD: u32;

    /// Length in bits.
    const BITS: u32 = Self::WORD & 0xFF;
}

impl<F, D, const WORD: u32> Mapped for Mappable<F, D, WORD> {
    type Field = F;
    type Direction = D;
    const WORD: u32 = WORD;
}

/// Marks the directions of mappable objects: [`Rpdo`], [`Tpdo`] and [`AnyPdo`].
#[diagnostic::on_unimplemented(
    message = "this object is not mappable",
    label = "the description doesn't allow it in a PDO",
    note = "in an EDS, the object has `PDOMapping=0`; in an XDD, `PDOmapping=\"no\"`; in an ESI, no `PdoMapping`",
    note = "if the device can map the object, set `pdo = \"rx\"`, `\"tx\"` or `\"both\"` in an overlay"
)]
pub trait IsMappable {
    /// The code of [`pdo!`](crate::pdo!) evaluates this constant, so that rustc reports a type without this trait.
    const HOLDS: () = ();
}

impl IsMappable for Rpdo {}
impl IsMappable for Tpdo {}
impl IsMappable for AnyPdo {}

/// Marks the directions of objects that can be mapped into PDOs of direction `D`. [`NoPdo`] also implements this trait,
/// so that only [`IsMappable`] reports an unmappable object.
#[diagnostic::on_unimplemented(
    message = "this object is mappable only into a `{Self}`, and the PDO is an `{D}`",
    label = "the device allows it only in the other direction",
    note = "the device receives an `Rpdo` and transmits a `Tpdo`"
)]
pub trait MappableInto<D> {
    /// The code of [`pdo!`](crate::pdo!) evaluates this constant, so that rustc reports a type without this trait.
    const HOLDS: () = ();
}

impl MappableInto<Rpdo> for Rpdo {}
impl MappableInto<Tpdo> for Tpdo {}
impl<D> MappableInto<D> for AnyPdo {}
impl<D> MappableInto<D> for NoPdo {}

/// Only [`CobId`] implements this trait. The trait has a lifetime parameter, so that rustc checks a bound with this
/// trait only when the method with the bound is called.
#[diagnostic::on_unimplemented(
    message = "this PDO has no default COB-ID",
    label = "the default COB-ID is unknown",
    note = "on CANopen, pass a COB-ID to `configuration_as(cob_id)`; on EtherCAT, call `mapping_writes()`"
)]
pub trait IsCobId<'a> {}

impl IsCobId<'_> for CobId {}

/// Only the COB-ID types of CANopen PDOs implement this trait. The lifetime parameter has the same purpose as in
/// [`IsCobId`].
#[diagnostic::on_unimplemented(
    message = "this is an EtherCAT PDO, which has no COB-ID",
    label = "not a CANopen PDO",
    note = "call `mapping_writes()` for the writes in Pre-Operational"
)]
pub trait IsOnCanOpen<'a> {}

impl IsOnCanOpen<'_> for CobId {}
impl IsOnCanOpen<'_> for NoCobId {}

/// A type of default COB-ID: [`CobId`], [`NoCobId`] or [`OnEtherCat`].
pub trait Identifier {
    /// True if a gap needs a dummy entry.
    const NEEDS_DUMMIES: bool;
}

impl Identifier for CobId {
    const NEEDS_DUMMIES: bool = true;
}

impl Identifier for NoCobId {
    const NEEDS_DUMMIES: bool = true;
}

impl Identifier for OnEtherCat {
    const NEEDS_DUMMIES: bool = false;
}

/// The result of a compile-time check, represented as a type.
pub struct Check<const HOLDS: bool>;

/// Requires that the length of the entry is a multiple of the granularity. Only [`Check<true>`](Check) implements this
/// trait.
#[diagnostic::on_unimplemented(
    message = "this object cannot be mapped: its length is not a multiple of the granularity",
    label = "not a multiple of the device's mapping granularity"
)]
pub trait FitsGranularity {
    /// The code of [`pdo!`](crate::pdo!) evaluates this constant, so that rustc reports a type without this trait.
    const HOLDS: () = ();
}

impl FitsGranularity for Check<true> {}

/// Requires that the entry ends within the maximum length of the PDO. Only [`Check<true>`](Check) implements this trait.
#[diagnostic::on_unimplemented(
    message = "this object doesn't fit into the PDO",
    label = "ends beyond the maximum length of the PDO",
    note = "a PDO on CANopen has at most 64 bits; on EtherCAT, the sync manager has a maximum length"
)]
pub trait FitsLength {
    /// The code of [`pdo!`](crate::pdo!) evaluates this constant, so that rustc reports a type without this trait.
    const HOLDS: () = ();
}

impl FitsLength for Check<true> {}

/// The checks that [`pdo!`](crate::pdo!) performs at compile time.
pub mod check {
    use super::{MappedEntry, Remappable};

    /// Returns whether `bits` is a multiple of the PDO's granularity.
    #[must_use]
    pub const fn is_multiple<P: Remappable>(bits: u32) -> bool {
        P::GRANULARITY == 0 || bits % P::GRANULARITY == 0
    }

    /// Returns whether every gap has a mapping entry. [`gap`](super::gap) returns 0 for a gap that the device doesn't
    /// support.
    #[must_use]
    pub const fn has_gaps(mapping: &[MappedEntry]) -> bool {
        !contains(mapping, 0)
    }

    /// Returns whether the mapping object can hold all entries of the mapping.
    #[must_use]
    pub const fn fits_entries<P: Remappable>(mapping: &[MappedEntry]) -> bool {
        mapping.len() <= P::ENTRIES && mapping.len() <= u8::MAX as usize
    }

    /// Returns whether the first `bits` bits of a mapping fit into the PDO.
    #[must_use]
    pub const fn fits_bits<P: Remappable>(bits: u32) -> bool {
        bits <= P::MAX_BITS
    }

    /// Returns whether the mapping contains all fixed entries.
    #[must_use]
    #[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
    pub const fn keeps_fixed<P: Remappable>(mapping: &[MappedEntry]) -> bool {
        let mut at = 0;
        while at < P::KEPT.len() {
            if !contains(mapping, P::KEPT[at].word()) {
                return false;
            }
            at += 1;
        }
        true
    }

    #[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
    const fn contains(mapping: &[MappedEntry], word: u32) -> bool {
        let mut at = 0;
        while at < mapping.len() {
            if mapping[at].word() == word {
                return true;
            }
            at += 1;
        }
        false
    }
}

/// Returns the mapping entry for a gap of `bits` bits. The entry is a dummy entry on CANopen and padding on EtherCAT.
/// Returns 0 if the device supports no entry for such a gap.
#[must_use]
pub const fn gap<P: Remappable>(bits: u32) -> u32 {
    if !P::CobId::NEEDS_DUMMIES && bits <= 0xFF {
        return bits;
    }
    let mut code = 1;
    while code < 32 {
        if P::DUMMIES >> code & 1 == 1 && bits_of_type(code) == bits && bits > 0 {
            return code << 16 | bits;
        }
        code += 1;
    }
    0
}

/// Returns the length in bits of the data type with this index (CiA 301 7.4.7); 0 if the type has no fixed length.
const fn bits_of_type(code: u32) -> u32 {
    match code {
        0x01 => 1,
        0x02 | 0x05 => 8,
        0x03 | 0x06 => 16,
        0x10 | 0x16 => 24,
        0x04 | 0x07 | 0x08 => 32,
        0x12 | 0x18 => 40,
        0x0C | 0x0D | 0x13 | 0x19 => 48,
        0x14 | 0x1A => 56,
        0x11 | 0x15 | 0x1B => 64,
        _ => 0,
    }
}

/// Decodes mapping entries from their representation in a mapping object.
#[must_use]
#[expect(clippy::indexing_slicing, reason = "`at` is below `N`")]
pub const fn entries<const N: usize>(words: [u32; N]) -> [MappedEntry; N] {
    let mut out = [MappedEntry::from_word(0); N];
    let mut at = 0;
    while at < N {
        out[at] = MappedEntry::from_word(words[at]);
        at += 1;
    }
    out
}

/// Returns the length of a mapping in bits.
#[must_use]
#[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
pub const fn bits(mapping: &[MappedEntry]) -> u32 {
    let (mut bits, mut at) = (0u32, 0);
    while at < mapping.len() {
        bits = bits.saturating_add(mapping[at].bits);
        at += 1;
    }
    bits
}

/// Returns the writes that change the mapping: clear the mapping, write the entries, write the number of entries. `N`
/// is the number of entries plus 2.
///
/// While you send the writes of a mapping, a CANopen PDO must be disabled, and an EtherCAT device must be in
/// Pre-Operational.
#[must_use]
pub const fn mapping_writes<P: Remappable, const N: usize>(mapping: &[MappedEntry]) -> [SdoWrite; N] {
    let clear = SdoWrite::new_u8(P::INDEX, 0, 0);
    put_mapping::<P, N>([clear; N], 0, mapping)
}

/// Returns the number of writes in [`configuration`].
#[must_use]
pub const fn configuration_len<P: Remappable>(mapping: &[MappedEntry]) -> usize {
    let identifier = if P::COMMUNICATION.is_some() { 2 } else { 0 };
    identifier + mapping.len() + 2 + P::TIMING.len()
}

/// Returns the writes that configure a CANopen PDO (CiA 301 7.5.2.36). In order, they disable the PDO, clear the
/// mapping, write the entries and their number, set the transmission type and timers, and enable the PDO. Read-only
/// parameters are left out.
#[must_use]
#[expect(clippy::indexing_slicing, reason = "`N` is `configuration_len`")]
pub const fn configuration<P: Remappable, const N: usize>(mapping: &[MappedEntry], cob_id: u32) -> [SdoWrite; N] {
    let mut out = [SdoWrite::new_u8(P::INDEX, 0, 0); N];
    let mut next = 0;
    if let Some(index) = P::COMMUNICATION {
        out[0] = SdoWrite::new_u32(index, 1, cob_id | 0x8000_0000);
        next = 1;
    }
    out = put_mapping::<P, N>(out, next, mapping);
    next += mapping.len() + 2;
    let mut at = 0;
    while at < P::TIMING.len() {
        out[next + at] = P::TIMING[at];
        at += 1;
    }
    if let Some(index) = P::COMMUNICATION {
        out[next + at] = SdoWrite::new_u32(index, 1, cob_id & 0x7FFF_FFFF);
    }
    out
}

/// Writes a mapping into `out`, starting at `first`. The element of `out` at `first` is already the write that clears
/// the mapping.
#[expect(clippy::indexing_slicing, reason = "`N` is at least `first` and the number of writes of the mapping")]
const fn put_mapping<P: Remappable, const N: usize>(
    mut out: [SdoWrite; N],
    first: usize,
    mapping: &[MappedEntry],
) -> [SdoWrite; N] {
    let mut at = 0;
    while at < mapping.len() {
        out[first + 1 + at] = SdoWrite::new_u32(P::INDEX, at as u8 + 1, mapping[at].word());
        at += 1;
    }
    out[first + 1 + at] = SdoWrite::new_u8(P::INDEX, 0, mapping.len() as u8);
    out
}
