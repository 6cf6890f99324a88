//! Mappings of one's own: which PDOs can be mapped anew, what can be mapped into them, and what has to hold.

use core::marker::PhantomData;

use super::cob_id::CobId;
pub use super::field::{Fields, Frame};
use super::mapping::MappedEntry;
use super::sdo_write::SdoWrite;

/// A PDO whose mapping can be changed; generated code implements it.
pub trait Remappable {
    /// [`Rpdo`] or [`Tpdo`].
    type Direction;

    /// What kind of identifier it has: a [`CobId`], [`NoCobId`] where there is none by default, or [`OnEtherCat`].
    type CobId: Identifier;

    /// The identifier by default (CiA 301 7.5.2.35); one that says "not used" where there is none.
    const COB_ID: CobId = CobId::fixed(0x8000_0000);

    /// Index of the mapping object.
    const INDEX: u16;

    /// How many entries the mapping object holds at most.
    const ENTRIES: usize;

    /// How many bits the PDO has at most: 64 on CANopen, what the sync manager takes on EtherCAT.
    const MAX_BITS: u32 = 64;

    /// The smallest unit of mapping in bits (`Granularity` of CiA 306).
    const GRANULARITY: u32 = 1;

    /// Which data types may stand for a gap as dummy entries (`DummyUsage` of CiA 306): bit 5 is that of UNSIGNED8,
    /// 0x0005. On EtherCAT a gap needs none.
    const DUMMIES: u32 = 0;

    /// Entries that can't be taken out of the mapping (`Fixed` of an entry, ETG.2000).
    const KEPT: &'static [MappedEntry] = &[];

    /// Index of the communication object; `None` where nobody may write the identifier, and on EtherCAT.
    const COMMUNICATION: Option<u16> = None;

    /// The writes that set the timing up as it is by default.
    const TIMING: &'static [SdoWrite] = &[];
}

/// The direction of a PDO that the device receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rpdo {}

/// The direction of a PDO that the device transmits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tpdo {}

/// Both directions: of an object that can be mapped into any PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyPdo {}

/// Stands for the default identifier of a CANopen PDO that has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoCobId {}

/// Stands for the default identifier of a PDO that is on EtherCAT alone, where PDOs have none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnEtherCat {}

/// What can be mapped: a field of type `F`, into PDOs of the direction `D`, as the entry `WORD` of a mapping object.
///
/// Generated code has a type alias for everything that can be mapped, in its module `mappable`.
pub struct Mappable<F, D, const WORD: u32>(PhantomData<fn() -> (F, D)>);

/// The field and the mapping entry of a [`Mappable`].
pub trait Mapped {
    /// The type of the field.
    type Field;

    /// The entry as the mapping object holds it: index, sub-index and bits, from the highest byte to the lowest.
    const WORD: u32;

    /// Length in bits.
    const BITS: u32 = Self::WORD & 0xFF;
}

impl<F, D, const WORD: u32> Mapped for Mappable<F, D, WORD> {
    type Field = F;
    const WORD: u32 = WORD;
}

/// Implemented by what can be mapped into PDOs of the direction `D`.
#[diagnostic::on_unimplemented(
    message = "this object can't be mapped here: the direction of the PDO is `{D}`",
    label = "the device lets it be mapped in the other direction only",
    note = "an `Rpdo` is received by the device, a `Tpdo` transmitted"
)]
pub trait MappableInto<D> {
    /// There is nothing more to it.
    const HOLDS: () = ();
}

impl<F, const WORD: u32> MappableInto<Rpdo> for Mappable<F, Rpdo, WORD> {}
impl<F, const WORD: u32> MappableInto<Tpdo> for Mappable<F, Tpdo, WORD> {}
impl<F, const WORD: u32> MappableInto<Rpdo> for Mappable<F, AnyPdo, WORD> {}
impl<F, const WORD: u32> MappableInto<Tpdo> for Mappable<F, AnyPdo, WORD> {}

/// Implemented by [`CobId`]. The lifetime says nothing: it lets a method demand of a type what may not hold.
#[diagnostic::on_unimplemented(
    message = "this PDO has no identifier by default",
    label = "no COB-ID is known",
    note = "on CANopen, choose one: `configuration_as(cob_id)`; on EtherCAT, where there are none, call `mapping_writes()`"
)]
pub trait IsCobId<'a> {}

impl IsCobId<'_> for CobId {}

/// Implemented by what stands for the identifier of a PDO on CANopen. The lifetime says nothing.
#[diagnostic::on_unimplemented(
    message = "this PDO is on EtherCAT, where PDOs have no identifier",
    label = "not on CANopen",
    note = "call `mapping_writes()` for what Pre-Operational needs"
)]
pub trait IsOnCanOpen<'a> {}

impl IsOnCanOpen<'_> for CobId {}
impl IsOnCanOpen<'_> for NoCobId {}

/// [`CobId`], [`NoCobId`] or [`OnEtherCat`].
pub trait Identifier {
    /// Whether only a dummy entry makes a gap.
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

/// Whether a check of [`pdo!`](crate::pdo!) holds.
pub struct Check<const HOLDS: bool>;

/// Implemented where the bits of an entry are a multiple of the granularity.
#[diagnostic::on_unimplemented(
    message = "this object can't be mapped: its bits are no multiple of the granularity",
    label = "not a multiple of what the device maps"
)]
pub trait FitsGranularity {
    /// There is nothing more to it.
    const HOLDS: () = ();
}

impl FitsGranularity for Check<true> {}

/// What [`pdo!`](crate::pdo!) asks the compiler.
pub mod check {
    use super::{MappedEntry, Remappable};

    /// Whether `bits` are a multiple of the PDO's granularity.
    #[must_use]
    pub const fn is_multiple<P: Remappable>(bits: u32) -> bool {
        P::GRANULARITY == 0 || bits % P::GRANULARITY == 0
    }

    /// Whether the device has an entry for every gap.
    #[must_use]
    pub const fn has_gaps(mapping: &[MappedEntry]) -> bool {
        !contains(mapping, 0)
    }

    /// Whether a mapping has no more entries than the device holds.
    #[must_use]
    pub const fn fits_entries<P: Remappable>(mapping: &[MappedEntry]) -> bool {
        mapping.len() <= P::ENTRIES && mapping.len() <= u8::MAX as usize
    }

    /// Whether a mapping has no more bits than the PDO.
    #[must_use]
    pub const fn fits_bits<P: Remappable>(mapping: &[MappedEntry]) -> bool {
        super::bits(mapping) <= P::MAX_BITS
    }

    /// Whether a mapping has all entries that the device doesn't give up.
    #[must_use]
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

/// The entry for a gap of `bits` bits, as the mapping object holds it: a dummy entry, or padding on EtherCAT; 0 where
/// the device has no such entry.
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

/// Length in bits of the basic type with this code (CiA 301 7.4.7); 0 where it has none.
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

/// Entries as the mapping object holds them.
#[must_use]
pub const fn entries<const N: usize>(words: [u32; N]) -> [MappedEntry; N] {
    let mut out = [MappedEntry::from_word(0); N];
    let mut at = 0;
    while at < N {
        out[at] = MappedEntry::from_word(words[at]);
        at += 1;
    }
    out
}

/// Length of a mapping in bits.
#[must_use]
pub const fn bits(mapping: &[MappedEntry]) -> u32 {
    let (mut bits, mut at) = (0u32, 0);
    while at < mapping.len() {
        bits = bits.saturating_add(mapping[at].bits);
        at += 1;
    }
    bits
}

/// Clear, entries, count: the writes that change a mapping of `N` less 2 entries. The PDO has to be off meanwhile (CANopen),
/// or the device in Pre-Operational (EtherCAT).
#[must_use]
pub const fn mapping_writes<P: Remappable, const N: usize>(mapping: &[MappedEntry]) -> [SdoWrite; N] {
    let clear = SdoWrite::new_u8(P::INDEX, 0, 0);
    put_mapping::<P, N>([clear; N], 0, mapping)
}

/// How many writes [`configuration`] has.
#[must_use]
pub const fn configuration_len<P: Remappable>(mapping: &[MappedEntry]) -> usize {
    let identifier = if P::COMMUNICATION.is_some() { 2 } else { 0 };
    identifier + mapping.len() + 2 + P::TIMING.len()
}

/// Disable, clear, map, count, timing, enable (CiA 301 7.5.2.36). What the device lets nobody write is left out.
#[must_use]
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

/// `out` with the writes of a mapping from `first` on; where they begin, `out` has the write that clears.
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
