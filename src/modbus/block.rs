//! Items that are read together.

use crate::access::Readable;
use crate::bus::Modbus;
use crate::item::Item;
use crate::location::On;
use crate::register::Register;
use crate::route::Direct;
use crate::value::{byte_len, Fixed};
use crate::value_error::LengthError;

/// What can be read as a part of a [`Block`]: an [`Item`] that can be read, is a register or a bit of Modbus, and has a type
/// of a fixed size.
#[diagnostic::on_unimplemented(
    message = "`{Self}` can't be read in a block of Modbus",
    label = "an item of a block can be read, is on Modbus, and is no text"
)]
pub trait BlockItem {
    /// The value.
    type Native: Copy;

    /// How many bytes the value takes, 8 at most.
    const LENGTH: usize;

    /// Where it is.
    fn register(&self) -> Register;

    /// The value of these bytes, the least significant first.
    ///
    /// # Errors
    ///
    /// [`LengthError`] where they aren't as many as the value takes.
    fn decode(&self, bytes: &[u8]) -> Result<Self::Native, LengthError>;
}

impl<V: Fixed, A: Readable, L: On<Modbus, Route: Direct<Modbus>>> BlockItem for Item<V, A, L> {
    type Native = V::Native;

    const LENGTH: usize = byte_len(V::BITS);

    fn register(&self) -> Register {
        self.location().route().address()
    }

    fn decode(&self, bytes: &[u8]) -> Result<V::Native, LengthError> {
        V::decode(bytes)
    }
}

impl<T: BlockItem> BlockItem for &T {
    type Native = T::Native;

    const LENGTH: usize = T::LENGTH;

    fn register(&self) -> Register {
        T::register(self)
    }

    fn decode(&self, bytes: &[u8]) -> Result<T::Native, LengthError> {
        T::decode(self, bytes)
    }
}

/// `N` values that are read together: a tuple of up to 12 items, or an array of items.
///
/// The result of a tuple is the tuple of the values, that of an array an array, in the same order, whatever the order of the
/// addresses. Values are those of [`Accessor::read`](crate::Accessor::read); [`Item::physical`] scales them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no block of Modbus",
    label = "a block is a tuple of up to 12 items that can be read on Modbus, or an array of such items"
)]
pub trait Block<const N: usize> {
    /// The values.
    type Values;

    /// How many bytes each value takes, 8 at most.
    const LENGTHS: [usize; N];

    /// Where each value is.
    fn registers(&self) -> [Register; N];

    /// The values, of as many of the bytes as each takes.
    ///
    /// # Errors
    ///
    /// [`LengthError`] where a value doesn't take as many bytes as it says.
    fn values(&self, bytes: &[[u8; 8]; N]) -> Result<Self::Values, LengthError>;
}

/// An array of no items can't be read: [`LengthError`].
impl<T: BlockItem, const N: usize> Block<N> for [T; N] {
    type Values = [T::Native; N];

    const LENGTHS: [usize; N] = [T::LENGTH; N];

    fn registers(&self) -> [Register; N] {
        core::array::from_fn(|at| self[at].register())
    }

    fn values(&self, bytes: &[[u8; 8]; N]) -> Result<Self::Values, LengthError> {
        let (Some(first), Some(of_first)) = (self.first(), bytes.first()) else { return Err(LengthError::new(1, 0)) };
        let mut values = [value(first, of_first)?; N];
        for ((to, item), bytes) in values.iter_mut().zip(self).zip(bytes) {
            *to = value(item, bytes)?;
        }
        Ok(values)
    }
}

/// The value of the bytes that it takes.
fn value<T: BlockItem>(item: &T, bytes: &[u8; 8]) -> Result<T::Native, LengthError> {
    item.decode(&bytes[..T::LENGTH.min(8)])
}

macro_rules! tuples {
    ($($count:literal: $($item:ident $at:tt)*;)*) => {$(
        impl<$($item: BlockItem),*> Block<$count> for ($($item,)*) {
            type Values = ($($item::Native,)*);

            const LENGTHS: [usize; $count] = [$($item::LENGTH),*];

            fn registers(&self) -> [Register; $count] {
                [$(self.$at.register()),*]
            }

            fn values(&self, bytes: &[[u8; 8]; $count]) -> Result<Self::Values, LengthError> {
                Ok(($(value(&self.$at, &bytes[$at])?,)*))
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
