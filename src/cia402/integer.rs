//! Access to items as integers, independent of their value types.

use crate::abort::AbortCode;
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::bus::Bus;
use crate::client::{AsyncClient, Client};
use crate::item::Item;
use crate::location::On;
use crate::machine::StateWord;
use crate::pdo::sign_extend;
use crate::raw_value::{limits, RawValue};
use crate::route::{ReadRoute, WriteRoute};
use crate::value::Fixed;
use crate::value_error::OutOfRange;

/// An item that a client of bus `B` can read as an integer. [`Item`]s with read access implement this trait if their
/// value is an integer, an enumeration, a bit field or a scaled integer of up to 32 bits. The integer is the raw value.
pub trait ReadInteger<B: Bus>: Copy {
    /// Reads the raw value.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Accessor::read`](crate::Accessor::read).
    fn read<C: Client<Bus = B>>(self, client: &mut C) -> Result<i64, AccessError<C::Error>>;

    /// Reads the raw value without blocking.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Accessor::read`](crate::Accessor::read).
    #[allow(async_fn_in_trait)]
    async fn read_async<C: AsyncClient<Bus = B>>(self, client: &mut C) -> Result<i64, AccessError<C::Error>>;
}

/// An item that a client of bus `B` can write as an integer. [`Item`]s with write access implement this trait for the
/// same types of values as [`ReadInteger`].
pub trait WriteInteger<B: Bus>: Copy {
    /// Writes the raw value.
    ///
    /// # Errors
    ///
    /// Returns [`Error::OutOfRange`](crate::Error::OutOfRange), and sends nothing, if the value doesn't fit the item's
    /// type or is outside its range. Also returns the errors of the client.
    fn write<C: Client<Bus = B>>(self, client: &mut C, value: i32) -> Result<(), AccessError<C::Error>>;

    /// Writes the raw value without blocking.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`write`](Self::write).
    #[allow(async_fn_in_trait)]
    async fn write_async<C: AsyncClient<Bus = B>>(
        self,
        client: &mut C,
        value: i32,
    ) -> Result<(), AccessError<C::Error>>;
}

/// An object that the device doesn't have. A read fails with [`AbortCode::NO_OBJECT`], without a bus access.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Absent;

fn absent<E>() -> AccessError<E> {
    AccessError::read(AbortCode::NO_OBJECT.into(), ("an object that the device doesn't have", None))
}

/// Returns the error for an integer that doesn't fit the type of the item.
fn out_of_range<B: Bus, E, V: Fixed, A, L>(item: &Item<V, A, L>, value: i32) -> AccessError<E>
where
    L: On<B, Route: WriteRoute<B>>,
{
    let place = (item.name(), item.location().route().write_address());
    AccessError::out_of_range(place, Some(RawValue::Signed(value.into())), limits::<V>(item.range()))
}

impl<B: Bus> ReadInteger<B> for Absent {
    fn read<C: Client<Bus = B>>(self, _: &mut C) -> Result<i64, AccessError<C::Error>> {
        Err(absent())
    }

    async fn read_async<C: AsyncClient<Bus = B>>(self, _: &mut C) -> Result<i64, AccessError<C::Error>> {
        Err(absent())
    }
}

impl<B: Bus, V: Fixed<Native: StateWord>, A: Readable, L: Copy> ReadInteger<B> for Item<V, A, L>
where
    L: On<B, Route: ReadRoute<B>>,
{
    fn read<C: Client<Bus = B>>(self, client: &mut C) -> Result<i64, AccessError<C::Error>> {
        Ok(integer::<V>(self.at(client).read()?))
    }

    async fn read_async<C: AsyncClient<Bus = B>>(self, client: &mut C) -> Result<i64, AccessError<C::Error>> {
        Ok(integer::<V>(self.at(client).read_async().await?))
    }
}

impl<B: Bus, V: Fixed<Native: StateWord>, A: Writable, L: Copy> WriteInteger<B> for Item<V, A, L>
where
    L: On<B, Route: WriteRoute<B>>,
{
    fn write<C: Client<Bus = B>>(self, client: &mut C, value: i32) -> Result<(), AccessError<C::Error>> {
        let native = native::<V>(value).map_err(|_| out_of_range(&self, value))?;
        self.at(client).write(native)
    }

    async fn write_async<C: AsyncClient<Bus = B>>(
        self,
        client: &mut C,
        value: i32,
    ) -> Result<(), AccessError<C::Error>> {
        let native = native::<V>(value).map_err(|_| out_of_range(&self, value))?;
        self.at(client).write_async(native).await
    }
}

/// Converts a value to an integer, which is sign-extended if the data type is signed.
fn integer<V: Fixed<Native: StateWord>>(native: V::Native) -> i64 {
    let bits = native.bits();
    if V::DATA_TYPE.is_signed() {
        sign_extend(bits.into(), V::BITS)
    } else {
        bits.into()
    }
}

/// Converts an integer to a value, or returns an error if the integer doesn't fit the type.
fn native<V: Fixed<Native: StateWord>>(value: i32) -> Result<V::Native, OutOfRange> {
    let native = V::Native::from_bits(value as u32);
    (integer::<V>(native) == i64::from(value)).then_some(native).ok_or(OutOfRange)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cia402::Mode;
    use crate::{Int, PerItem, Scaled};

    #[test]
    fn integers_keep_their_sign() {
        assert_eq!((integer::<i8>(-3), integer::<u8>(253), integer::<Mode>(Mode::Unknown(-3))), (-3, 253, -3));
        assert_eq!((integer::<Scaled<i32, 1, 100>>(-5), integer::<u32>(u32::MAX)), (-5, 0xFFFF_FFFF));
        assert_eq!((integer::<Int<24>>(-5), integer::<PerItem<i32, 60>>(i32::MIN)), (-5, i32::MIN.into()));
    }

    #[test]
    fn integers_that_do_not_fit() {
        assert_eq!((native::<i16>(-32_768), native::<i16>(32_768)), (Ok(i16::MIN), Err(OutOfRange)));
        assert_eq!(
            (native::<u8>(255), native::<u8>(256), native::<u8>(-1)),
            (Ok(255), Err(OutOfRange), Err(OutOfRange))
        );
        assert_eq!((native::<u32>(-1), native::<Scaled<i32, 1, 100>>(-1)), (Err(OutOfRange), Ok(-1)));
        assert_eq!((native::<Mode>(6), native::<Mode>(-200)), (Ok(Mode::Homing), Err(OutOfRange)));
    }
}
