//! Blocks of items that are read together.

use crate::access::Readable;
use crate::bus::Modbus;
use crate::item::Item;
use crate::location::On;
use crate::register::Register;
use crate::route::Direct;
use crate::value::{byte_len, Fixed};
use crate::value_error::LengthError;

/// An item that can be part of a [`Block`]: a readable [`Item`] that has a Modbus register or bit and a type of fixed
/// size.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be read in a Modbus block",
    label = "expected a readable Modbus item of fixed size"
)]
pub trait BlockItem {
    /// Type of the value.
    type Native: Copy;

    /// Length of the value in bytes, at most 8.
    const LENGTH: usize;

    /// Returns the name of the item.
    fn name(&self) -> &'static str;

    /// Returns the register of the item.
    fn register(&self) -> Register;

    /// Decodes a value from little-endian bytes.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the number of bytes isn't the length of the value.
    fn decode(&self, bytes: &[u8]) -> Result<Self::Native, LengthError>;
}

impl<V: Fixed, A: Readable, L: On<Modbus, Route: Direct<Modbus>>> BlockItem for Item<V, A, L> {
    type Native = V::Native;

    const LENGTH: usize = byte_len(V::BITS);

    fn name(&self) -> &'static str {
        Item::name(self)
    }

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

    fn name(&self) -> &'static str {
        T::name(self)
    }

    fn register(&self) -> Register {
        T::register(self)
    }

    fn decode(&self, bytes: &[u8]) -> Result<T::Native, LengthError> {
        T::decode(self, bytes)
    }
}

/// `N` items that are read together: a tuple of up to 12 items, or an array of items.
///
/// A tuple of items is read as a tuple of values; an array of items is read as an array of values. The values are in
/// the order of the items. The addresses of the items may be in any order. The values are raw, as from
/// [`Accessor::read`](crate::Accessor::read). Use [`Item::physical`] to convert the raw values to physical values.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Modbus block",
    label = "expected a tuple of up to 12 readable Modbus items, or an array of them"
)]
pub trait Block<const N: usize> {
    /// Type of the values.
    type Values;

    /// Length of each value in bytes, at most 8.
    const LENGTHS: [usize; N];

    /// Returns the name of each item.
    fn names(&self) -> [&'static str; N];

    /// Returns the register of each item.
    fn registers(&self) -> [Register; N];

    /// Decodes the values. Each value is at the start of its 8-byte array; the remaining bytes are ignored.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the length of a value differs from the length that its item declares.
    fn values(&self, bytes: &[[u8; 8]; N]) -> Result<Self::Values, LengthError>;
}

/// An array of items. Reading an empty array returns a [`LengthError`].
impl<T: BlockItem, const N: usize> Block<N> for [T; N] {
    type Values = [T::Native; N];

    const LENGTHS: [usize; N] = [T::LENGTH; N];

    fn names(&self) -> [&'static str; N] {
        self.each_ref().map(|item| item.name())
    }

    fn registers(&self) -> [Register; N] {
        self.each_ref().map(|item| item.register())
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

/// Decodes one value from the start of `bytes`.
fn value<T: BlockItem>(item: &T, bytes: &[u8; 8]) -> Result<T::Native, LengthError> {
    item.decode(bytes.get(..T::LENGTH).unwrap_or(bytes))
}

macro_rules! tuples {
    ($($count:literal: $($item:ident $at:tt)*;)*) => {$(
        impl<$($item: BlockItem),*> Block<$count> for ($($item,)*) {
            type Values = ($($item::Native,)*);

            const LENGTHS: [usize; $count] = [$($item::LENGTH),*];

            fn names(&self) -> [&'static str; $count] {
                [$(self.$at.name()),*]
            }

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
