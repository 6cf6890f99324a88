//! Reads and writes of values with a fixed size.

use super::{filled, Accessor};
use crate::access::{Readable, Writable};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::route::{ReadRoute, WriteRoute};
use crate::value::{byte_len, Fixed};
use crate::value_error::{LengthError, OutOfRange};

impl<C, V: Fixed, A, L> Accessor<'_, C, V, A, L> {
    /// Reads the value.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Length`] if the device sends a value whose length differs from the length of the type.
    #[inline]
    pub fn read(&mut self) -> Result<V::Native, Error<C::Error>>
    where
        A: Readable,
        C: Client,
        L: On<C::Bus, Route: ReadRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let room = room::<V>(&mut buffer);
        let length = self.item.location().route().read(self.client, room)?;
        decode::<V, _>(room, length)
    }

    /// Reads the value without blocking.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Length`] if the device sends a value whose length differs from the length of the type.
    pub async fn read_async(&mut self) -> Result<V::Native, Error<C::Error>>
    where
        A: Readable,
        C: AsyncClient,
        L: On<C::Bus, Route: ReadRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let room = room::<V>(&mut buffer);
        let length = self.item.location().route().read_async(self.client, room).await?;
        decode::<V, _>(room, length)
    }

    /// Writes the value.
    ///
    /// # Errors
    ///
    /// Returns [`Error::OutOfRange`] if the value is outside the item's range or doesn't fit its type. An invalid value
    /// isn't sent.
    #[inline]
    pub fn write(&mut self, value: V::Native) -> Result<(), Error<C::Error>>
    where
        A: Writable,
        C: Client,
        L: On<C::Bus, Route: WriteRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let length = encode(&self.item, value, &mut buffer)?;
        self.send(filled(&buffer, length)?)
    }

    /// Writes the value without blocking.
    ///
    /// # Errors
    ///
    /// Returns [`Error::OutOfRange`] if the value is outside the item's range or doesn't fit its type. An invalid value
    /// isn't sent.
    pub async fn write_async(&mut self, value: V::Native) -> Result<(), Error<C::Error>>
    where
        A: Writable,
        C: AsyncClient,
        L: On<C::Bus, Route: WriteRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let length = encode(&self.item, value, &mut buffer)?;
        self.send_async(filled(&buffer, length)?).await
    }
}

/// Returns the part of `buffer` that can hold a value of type `V`.
#[inline]
fn room<V: Fixed>(buffer: &mut [u8; 8]) -> &mut [u8] {
    &mut buffer[..byte_len(V::BITS)]
}

/// Decodes the value in `room`. `length` is the length that the client reported in bytes.
#[inline]
fn decode<V: Fixed, E>(room: &[u8], length: usize) -> Result<V::Native, Error<E>> {
    if length != room.len() {
        return Err(LengthError { expected: room.len(), actual: length }.into());
    }
    Ok(V::decode(room)?)
}

/// Checks the range, encodes the value into `buffer` and returns the length in bytes.
#[inline]
fn encode<V: Fixed, A, L>(item: &Item<V, A, L>, value: V::Native, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
    if !V::in_range(value, item.range()) {
        return Err(OutOfRange);
    }
    V::encode(value, buffer)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{item, now, Device};
    use crate::{Error, Flags, Initial, Int, Item, LengthError, OnCanOpen, OutOfRange, Range, Ro, Rw, Wo};

    const LIMITED: Item<i16, Rw, OnCanOpen> = Item::new(
        OnCanOpen::canopen(0x6071, 0),
        "Target torque",
        Range::Between(-1000, 1000),
        Initial::Value(0),
        "‰",
        Flags::RPDO,
    );

    #[test]
    fn reads() {
        let mut device = Device::answering(&[0xFE, 0xFF]);
        assert_eq!(item::<i16, Ro>().at(&mut device).read(), Ok(-2));
        assert_eq!(now(item::<i16, Ro>().at(&mut device).read_async()), Ok(-2));
    }

    #[test]
    fn another_length_is_an_error() {
        let mut device = Device::answering(&[1, 2, 3]);
        let short = Error::Length(LengthError { expected: 4, actual: 3 });
        let long = Error::Length(LengthError { expected: 2, actual: 3 });
        assert_eq!(item::<u32, Ro>().at(&mut device).read(), Err(short));
        assert_eq!(item::<u16, Ro>().at(&mut device).read(), Err(long));
        assert_eq!(now(item::<u16, Ro>().at(&mut device).read_async()), Err(long));
    }

    #[test]
    fn a_client_that_claims_too_much_is_an_error() {
        let mut device = Device { claimed: Some(usize::MAX), ..Device::default() };
        let error = Error::Length(LengthError { expected: 8, actual: usize::MAX });
        assert_eq!(item::<u64, Ro>().at(&mut device).read(), Err(error));
    }

    #[test]
    fn writes() {
        let mut device = Device::default();
        assert_eq!(LIMITED.at(&mut device).write(-1000), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0x18, 0xFC].as_slice()));
        assert_eq!(now(LIMITED.at(&mut device).write_async(1)), Ok(()));
        assert_eq!(device.written.as_deref(), Some([1, 0].as_slice()));
    }

    #[test]
    fn sends_nothing_that_is_out_of_range() {
        let mut device = Device::default();
        let refused = Err(Error::OutOfRange(OutOfRange));
        assert_eq!(LIMITED.at(&mut device).write(1001), refused);
        assert_eq!(now(LIMITED.at(&mut device).write_async(-1001)), refused);
        assert_eq!(item::<Int<24>, Wo>().at(&mut device).write(1 << 23), refused);
        assert_eq!(device.written, None);
    }
}
