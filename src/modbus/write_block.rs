//! Blocks of items that are written together.

use super::limits::Limits;
use super::plan::{bytes, Plan};
use super::reading::MAX_BYTES;
use crate::access::Writable;
use crate::access_error::AccessError;
use crate::bus::Modbus;
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::raw_value::{limits, RawValue};
use crate::register::{Register, RegisterTable};
use crate::route::Direct;
use crate::value::{byte_len, Fixed};
use crate::value_error::{LengthError, OutOfRange};

/// An item that can be part of a [`WriteBlock`]: a writable [`Item`] that has a Modbus register or bit and a type of
/// fixed size.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be written in a Modbus block",
    label = "expected a writable Modbus item of fixed size"
)]
pub trait WriteItem {
    /// Type of the value.
    type Native: Copy;

    /// Length of the value in bytes, at most 8.
    const LENGTH: usize;

    /// Returns the name of the item.
    fn name(&self) -> &'static str;

    /// Returns the register of the item.
    fn register(&self) -> Register;

    /// Returns the encoded value in the first bytes of the array, the least significant byte first.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the value doesn't fit in the type of the item.
    fn encode(&self, value: Self::Native) -> Result<[u8; 8], OutOfRange>;

    /// Returns whether the value is within the range of the item.
    fn is_in_range(&self, value: Self::Native) -> bool;

    /// Returns the value as a number, or `None` if it isn't a number.
    fn raw_value(&self, value: Self::Native) -> Option<RawValue>;

    /// Returns the minimum and the maximum of the item as raw values, or `None` if the values aren't numbers.
    fn limits(&self) -> Option<[RawValue; 2]>;
}

impl<V: Fixed, A: Writable, L: On<Modbus, Route: Direct<Modbus>>> WriteItem for Item<V, A, L> {
    type Native = V::Native;

    const LENGTH: usize = byte_len(V::BITS);

    fn name(&self) -> &'static str {
        Item::name(self)
    }

    fn register(&self) -> Register {
        self.location().route().address()
    }

    fn encode(&self, value: V::Native) -> Result<[u8; 8], OutOfRange> {
        let mut buffer = [0; 8];
        V::encode(value, &mut buffer)?;
        Ok(buffer)
    }

    fn is_in_range(&self, value: V::Native) -> bool {
        V::in_range(value, self.range())
    }

    fn raw_value(&self, value: V::Native) -> Option<RawValue> {
        V::raw_value(value)
    }

    fn limits(&self) -> Option<[RawValue; 2]> {
        limits::<V>(self.range())
    }
}

impl<T: WriteItem> WriteItem for &T {
    type Native = T::Native;

    const LENGTH: usize = T::LENGTH;

    fn name(&self) -> &'static str {
        T::name(self)
    }

    fn register(&self) -> Register {
        T::register(self)
    }

    fn encode(&self, value: T::Native) -> Result<[u8; 8], OutOfRange> {
        T::encode(self, value)
    }

    fn is_in_range(&self, value: T::Native) -> bool {
        T::is_in_range(self, value)
    }

    fn raw_value(&self, value: T::Native) -> Option<RawValue> {
        T::raw_value(self, value)
    }

    fn limits(&self) -> Option<[RawValue; 2]> {
        T::limits(self)
    }
}

/// `N` items that are written together: a tuple of up to 12 items. The values are a tuple in the order of the items.
/// The values are raw, as for [`Accessor::write`](crate::Accessor::write).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Modbus block that can be written",
    label = "expected a tuple of up to 12 writable Modbus items"
)]
pub trait WriteBlock<const N: usize> {
    /// Type of the values.
    type Values;

    /// Length of each value in bytes, at most 8.
    const LENGTHS: [usize; N];

    /// Returns the name of each item.
    fn names(&self) -> [&'static str; N];

    /// Returns the register of each item.
    fn registers(&self) -> [Register; N];

    /// Encodes the values. Each value is at the start of its 8-byte array.
    ///
    /// # Errors
    ///
    /// Returns an error with [`Error::OutOfRange`] if a value is outside the range of its item or of the item's type.
    fn encode<E>(&self, values: Self::Values) -> Result<[Encoded; N], AccessError<E>>;
}

/// The bytes of a value of a [`WriteBlock`], and the value if it is a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoded {
    bytes: [u8; 8],
    value: Option<RawValue>,
}

/// Checks the range of a value and encodes the value.
fn encode<T: WriteItem, E>(item: &T, value: T::Native) -> Result<Encoded, AccessError<E>> {
    let raw_value = item.raw_value(value);
    match item.encode(value) {
        Ok(bytes) if item.is_in_range(value) => Ok(Encoded { bytes, value: raw_value }),
        _ => {
            let place = (item.name(), Some(item.register().into()));
            Err(AccessError::out_of_range(place, raw_value, item.limits()))
        }
    }
}

macro_rules! tuples {
    ($($count:literal: $($item:ident $at:tt)*;)*) => {$(
        impl<$($item: WriteItem),*> WriteBlock<$count> for ($($item,)*) {
            type Values = ($($item::Native,)*);

            const LENGTHS: [usize; $count] = [$($item::LENGTH),*];

            fn names(&self) -> [&'static str; $count] {
                [$(self.$at.name()),*]
            }

            fn registers(&self) -> [Register; $count] {
                [$(self.$at.register()),*]
            }

            fn encode<Error>(&self, values: Self::Values) -> Result<[Encoded; $count], AccessError<Error>> {
                Ok([$(encode(&self.$at, values.$at)?),*])
            }
        }
    )*};
}

tuples! {
    1: A 0;
    2: A 0 B 1;
    3: A 0 B 1 C 2;
    4: A 0 B 1 C 2 D 3;
    5: A 0 B 1 C 2 D 3 E 4;
    6: A 0 B 1 C 2 D 3 E 4 F 5;
    7: A 0 B 1 C 2 D 3 E 4 F 5 G 6;
    8: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7;
    9: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7 I 8;
    10: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7 I 8 J 9;
    11: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7 I 8 J 9 K 10;
    12: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7 I 8 J 9 K 10 L 11;
}

/// The writes of a block.
pub(super) struct Writing<const N: usize> {
    names: [&'static str; N],
    registers: [Register; N],
    lengths: [usize; N],
    values: [Encoded; N],
    /// One write for all items, if one request can write them.
    joined: Option<(Register, [u8; MAX_BYTES])>,
}

impl<const N: usize> Writing<N> {
    pub(super) fn new<B: WriteBlock<N>, E>(
        block: &B,
        values: B::Values,
        limits: &Limits,
    ) -> Result<Self, AccessError<E>> {
        let (registers, lengths) = (block.registers(), B::LENGTHS.map(|length| length.min(8)));
        let values = block.encode(values)?;
        let mut writing = Self { names: block.names(), registers, lengths, values, joined: None };
        writing.joined = writing.join(limits).map_err(|error| writing.failed(0, error.into()))?;
        Ok(writing)
    }

    /// Adds the items of write `at` to an error.
    pub(super) fn failed<E>(&self, at: usize, error: Error<E>) -> AccessError<E> {
        let name = self.names.get(at).copied().unwrap_or_default();
        let Some((register, _)) = self.joined else {
            let value = self.values.get(at).and_then(|encoded| encoded.value);
            return AccessError::write(error, (name, self.registers.get(at).map(|register| (*register).into())), value);
        };
        AccessError::write(error, (name, Some(register.into())), None).with_others(N.saturating_sub(1))
    }

    /// Returns the number of writes.
    pub(super) const fn len(&self) -> usize {
        if self.joined.is_some() {
            1
        } else {
            N
        }
    }

    /// Returns the register and the data of write `at`.
    pub(super) fn write(&self, at: usize) -> Option<(Register, &[u8])> {
        match &self.joined {
            Some((register, data)) if at == 0 => {
                Some((*register, data.get(..bytes(register.table, register.count)).unwrap_or(data)))
            }
            Some(_) => None,
            None => Some((*self.registers.get(at)?, self.values.get(at)?.bytes.get(..*self.lengths.get(at)?)?)),
        }
    }

    /// Joins several items in adjacent holding registers into one write. Coils and parts of registers are not joined.
    fn join(&self, limits: &Limits) -> Result<Option<(Register, [u8; MAX_BYTES])>, LengthError> {
        let can_join = |register: &Register| register.table == RegisterTable::Holding && register.part.is_none();
        if N < 2 || !self.registers.iter().all(can_join) {
            return Ok(None);
        }
        // The plan of a write follows the rules of a read: only the limit differs, and no write includes a gap.
        let mut holding = limits.holding;
        (holding.max_read, holding.readable) = (limits.max_write(RegisterTable::Holding), &[]);
        let Ok(plan) = Plan::new(self.registers, &Limits { holding, ..*limits }) else { return Ok(None) };
        let &[register] = plan.requests() else { return Ok(None) };
        let occupied: usize = self.registers.iter().map(|item| usize::from(item.addresses())).sum();
        let is_whole = |item: &Register| item.count % item.step() == 0;
        // Overlapping items, and items that leave a part of their last address free, are written one after the other.
        if occupied != usize::from(register.addresses()) || !self.registers.iter().all(is_whole) {
            return Ok(None);
        }
        let mut words = [0; MAX_BYTES / 2];
        for ((item, Encoded { bytes, .. }), length) in self.registers.iter().zip(&self.values).zip(self.lengths) {
            let first = usize::from(item.address.saturating_sub(register.address)) * usize::from(item.step());
            let count = usize::from(item.count);
            let part = words.get_mut(first..first + count).ok_or(LengthError::new(MAX_BYTES, 2 * (first + count)))?;
            item.encode(bytes.get(..length).unwrap_or(bytes), part)?;
        }
        let mut data = [0; MAX_BYTES];
        data.chunks_exact_mut(2).zip(words).for_each(|(to, word)| to.copy_from_slice(&word.to_le_bytes()));
        Ok(Some((register, data)))
    }
}

/// Returns the address and the masks of a mask write request (function 22) that sets the bits of `mask` to those of
/// `value`. The first mask contains the bits to keep, and the second mask contains the bits to set.
pub(super) fn masks<I: WriteItem, E>(item: &I, value: I::Native, mask: I::Native) -> Result<(u16, u16, u16), Error<E>> {
    let register = item.register();
    let length = I::LENGTH.min(8);
    if register.count != 1 || register.table != RegisterTable::Holding {
        return Err(LengthError::new(2, bytes(register.table, register.count)).into());
    }
    let word = |value: [u8; 8]| {
        let mut word = [0];
        register.encode(value.get(..length).unwrap_or(&value), &mut word)?;
        let [word] = word;
        Ok::<_, LengthError>(word)
    };
    let (value, mask) = (word(item.encode(value)?)?, word(item.encode(mask)?)?);
    Ok((register.address, !mask, value & mask))
}

/// Returns the value of the register after a mask write request (MODBUS Application Protocol V1.1b3, 6.16).
pub(crate) const fn masked(held: u16, and: u16, or: u16) -> u16 {
    held & and | or & !and
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::TableLimits;
    use crate::{Flags, OnModbus, Rw};

    type RegisterItem<V> = Item<V, Rw, OnModbus>;

    const fn item<V: Fixed>(register: Register) -> RegisterItem<V> {
        RegisterItem::register(register, "", Flags::NONE)
    }

    const CONTROL: RegisterItem<u16> = item(Register::holding(10));
    const SPEED: RegisterItem<i32> = item(Register::high_first(11, 2));

    #[track_caller]
    fn writes<const N: usize, B: WriteBlock<N>>(
        block: B,
        values: B::Values,
        limits: &Limits,
        expected: &[(u16, u16, &[u8])],
    ) {
        let writing = Writing::new::<B, ()>(&block, values, limits).unwrap();
        assert_eq!(writing.len(), expected.len());
        for (at, (address, count, data)) in expected.iter().enumerate() {
            let (register, bytes) = writing.write(at).unwrap();
            assert_eq!((register.address, register.count, bytes), (*address, *count, *data));
        }
        assert!(writing.write(expected.len()).is_none());
    }

    #[test]
    fn adjacent_items_are_one_write() {
        let all: &[u8] = &[0x0F, 0, 1, 0, 2, 0];
        writes((SPEED, CONTROL), (0x1_0002, 15), &Limits::STANDARD, &[(10, 3, all)]);
        writes((SPEED,), (2,), &Limits::STANDARD, &[(11, 2, &[2, 0, 0, 0])]);
    }

    #[test]
    fn items_that_no_request_can_write() {
        let separate: &[(u16, u16, &[u8])] = &[(10, 1, &[15, 0]), (11, 2, &[2, 0, 0, 0])];
        let narrow = Limits { holding: TableLimits { max_write: 2, ..TableLimits::HOLDING }, ..Limits::STANDARD };
        writes((CONTROL, SPEED), (15, 2), &narrow, separate);
        // A gap, an overlap, a part of a register, and a bit.
        writes(
            (CONTROL, item::<u8>(Register::holding(12))),
            (1, 2),
            &Limits::STANDARD,
            &[(10, 1, &[1, 0]), (12, 1, &[2])],
        );
        writes(
            (SPEED, item::<u16>(Register::holding(11))),
            (1, 2),
            &Limits::STANDARD,
            &[(11, 2, &[1, 0, 0, 0]), (11, 1, &[2, 0])],
        );
        let upper = item::<u8>(Register::holding(11).part(8, 8));
        writes((CONTROL, upper), (1, 2), &Limits::STANDARD, &[(10, 1, &[1, 0]), (11, 1, &[2])]);
        let coil = item::<bool>(Register::new(RegisterTable::Coil, 11, 1));
        writes((CONTROL, coil), (1, true), &Limits::STANDARD, &[(10, 1, &[1, 0]), (11, 1, &[1])]);
    }

    #[test]
    fn values_outside_the_range_are_not_written() {
        const LIMITED: RegisterItem<i16> =
            RegisterItem::register_within(Register::holding(9), "", crate::Range::Between(-5, 5), "", Flags::NONE);
        let refused = Writing::new::<_, ()>(&(LIMITED, CONTROL), (6, 0), &Limits::STANDARD).map(|_| ()).unwrap_err();
        assert_eq!(refused.error, Error::OutOfRange(OutOfRange));
        assert_eq!((refused.value(), refused.address()), (Some(6_i16.into()), Some(Register::holding(9).into())));
    }

    #[test]
    fn masks_of_bits() {
        assert_eq!(masks::<_, ()>(&CONTROL, 0x0102, 0x0F0F), Ok((10, 0xF0F0, 0x0102)));
        // Bits of the value outside the mask are ignored.
        assert_eq!(masks::<_, ()>(&CONTROL, 0xFFFF, 1), Ok((10, 0xFFFE, 1)));
        let swapped = item::<u16>(Register::holding(10).swapped());
        assert_eq!(masks::<_, ()>(&swapped, 0x0002, 0x000F), Ok((10, 0xF0FF, 0x0200)));
        let upper = item::<u8>(Register::holding(10).part(8, 8));
        assert_eq!(masks::<_, ()>(&upper, 0x11, 0x1F), Ok((10, 0xE0FF, 0x1100)));
        assert_eq!(masks::<_, ()>(&SPEED, 1, 1), Err(Error::Length(LengthError::new(2, 4))));
        // The example in MODBUS Application Protocol V1.1b3, 6.16.
        assert_eq!(masked(0x12, 0xF2, 0x25), 0x17);
    }
}
