//! Methods that read and write values with a fixed size.

use super::{filled, Accessor};
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::bus::Bus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::raw_value::limits;
use crate::route::{ReadRoute, WriteRoute};
use crate::value::{byte_len, Fixed};
use crate::value_error::{LengthError, OutOfRange};

/// Methods for items that can be read.
impl<C, V: Fixed, A: Readable, L> Accessor<'_, C, V, A, L> {
    /// Reads the value.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Length`] if the device sends a value whose length differs from the length of the type.
    #[inline]
    pub fn read(&mut self) -> Result<V::Native, AccessError<C::Error>>
    where
        C: Client,
        L: On<C::Bus, Route: ReadRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let room = room::<V>(&mut buffer);
        let length = self.item.location().route().read(self.client, room);
        match length.and_then(|length| decode::<V, _>(room, length)) {
            Ok(value) => Ok(value),
            Err(error) => Err(self.read_failed(error)),
        }
    }

    /// Reads the value without blocking.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Length`] if the device sends a value whose length differs from the length of the type.
    pub async fn read_async(&mut self) -> Result<V::Native, AccessError<C::Error>>
    where
        C: AsyncClient,
        L: On<C::Bus, Route: ReadRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let room = room::<V>(&mut buffer);
        let length = self.item.location().route().read_async(self.client, room).await;
        match length.and_then(|length| decode::<V, _>(room, length)) {
            Ok(value) => Ok(value),
            Err(error) => Err(self.read_failed(error)),
        }
    }
}

/// Methods for items that can be written.
impl<C, V: Fixed, A: Writable, L> Accessor<'_, C, V, A, L> {
    /// Writes the value.
    ///
    /// # Errors
    ///
    /// Returns [`Error::OutOfRange`] if the value is outside the item's range or doesn't fit its type. An invalid value
    /// isn't sent.
    #[inline]
    pub fn write(&mut self, value: V::Native) -> Result<(), AccessError<C::Error>>
    where
        C: Client,
        L: On<C::Bus, Route: WriteRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let Ok(length) = encode(&self.item, value, &mut buffer) else { return Err(self.out_of_range(value)) };
        let sent = match filled(&buffer, length) {
            Ok(data) => self.send(data),
            Err(error) => Err(error.into()),
        };
        sent.map_err(|error| self.write_failed(error, V::raw_value(value)))
    }

    /// Writes the value without blocking.
    ///
    /// # Errors
    ///
    /// Returns [`Error::OutOfRange`] if the value is outside the item's range or doesn't fit its type. An invalid value
    /// isn't sent.
    pub async fn write_async(&mut self, value: V::Native) -> Result<(), AccessError<C::Error>>
    where
        C: AsyncClient,
        L: On<C::Bus, Route: WriteRoute<C::Bus>>,
    {
        let mut buffer = [0; 8];
        let Ok(length) = encode(&self.item, value, &mut buffer) else { return Err(self.out_of_range(value)) };
        let sent = match filled(&buffer, length) {
            Ok(data) => self.send_async(data).await,
            Err(error) => Err(error.into()),
        };
        sent.map_err(|error| self.write_failed(error, V::raw_value(value)))
    }
}

/// Methods for items that can be read and written.
impl<C, V: Fixed, A: Readable + Writable, L> Accessor<'_, C, V, A, L> {
    /// Reads the value, changes it with `change`, and writes the result: one read and one write. Bits that `change`
    /// doesn't modify are written back with the values that were read.
    ///
    /// The access isn't atomic: the device or another client can change the value between the read and the write.
    ///
    /// ```
    /// # #[cfg(feature = "std")]
    /// # fn run() -> Result<(), lexibus::AccessError<lexibus::sim::Fault>> {
    /// # let mut device = lexibus::sim::Device::new(lexibus_drives::demo_drive::ENTRIES);
    /// # let mut drive = lexibus_drives::demo_drive::DemoDrive::new(device.client::<lexibus::CanOpen>());
    /// drive.controlword().modify(|word| word.with_halt(true))?;
    /// # assert!(drive.controlword().read()?.halt());
    /// # Ok(())
    /// # }
    /// # #[cfg(feature = "std")]
    /// # run().unwrap();
    /// ```
    ///
    /// An item can have different addresses for reading and writing (see [`Split`](crate::Split)). For such an item,
    /// `change` receives the value at the read address, not the last written value.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read`](Self::read) and [`write`](Self::write). A result of `change` that is out of range
    /// isn't sent.
    #[inline]
    pub fn modify(&mut self, change: impl FnOnce(V::Native) -> V::Native) -> Result<(), AccessError<C::Error>>
    where
        C: Client,
        L: On<C::Bus, Route: ReadRoute<C::Bus> + WriteRoute<C::Bus>>,
    {
        let value = self.read()?;
        self.write(change(value))
    }

    /// Reads, changes and writes the value without blocking, as [`modify`](Self::modify) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read_async`](Self::read_async) and [`write_async`](Self::write_async). A result of `change`
    /// that is out of range isn't sent.
    pub async fn modify_async(
        &mut self,
        change: impl FnOnce(V::Native) -> V::Native,
    ) -> Result<(), AccessError<C::Error>>
    where
        C: AsyncClient,
        L: On<C::Bus, Route: ReadRoute<C::Bus> + WriteRoute<C::Bus>>,
    {
        let value = self.read_async().await?;
        self.write_async(change(value)).await
    }
}

impl<C, V: Fixed, A, L> Accessor<'_, C, V, A, L> {
    #[inline(always)]
    fn out_of_range<B: Bus, E>(&self, value: V::Native) -> AccessError<E>
    where
        L: On<B, Route: WriteRoute<B>>,
    {
        let accessed = self.accessed(self.item.location().route().write_address());
        AccessError::out_of_range(accessed, V::raw_value(value), limits::<V>(self.item.range()))
    }
}

/// Returns the part of `buffer` that can hold a value of type `V`.
#[inline]
fn room<V: Fixed>(buffer: &mut [u8; 8]) -> &mut [u8] {
    buffer.get_mut(..byte_len(V::BITS)).unwrap_or_default()
}

/// Decodes the value in `room`. `length` is the length in bytes that the client reported.
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
    use std::string::ToString;

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
        assert_eq!(item::<u32, Ro>().at(&mut device).read().map_err(Error::from), Err(short));
        assert_eq!(item::<u16, Ro>().at(&mut device).read().map_err(Error::from), Err(long));
        assert_eq!(now(item::<u16, Ro>().at(&mut device).read_async()).map_err(Error::from), Err(long));
    }

    #[test]
    fn a_client_that_claims_too_much_is_an_error() {
        let mut device = Device { claimed: Some(usize::MAX), ..Device::default() };
        let error = Error::Length(LengthError { expected: 8, actual: usize::MAX });
        assert_eq!(item::<u64, Ro>().at(&mut device).read().map_err(Error::from), Err(error));
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
        assert_eq!(LIMITED.at(&mut device).write(1001).map_err(Error::from), refused);
        assert_eq!(now(LIMITED.at(&mut device).write_async(-1001)).map_err(Error::from), refused);
        assert_eq!(item::<Int<24>, Wo>().at(&mut device).write(1 << 23).map_err(Error::from), refused);
        assert_eq!(device.written, None);
    }

    #[test]
    fn modifies_with_one_read_and_one_write() {
        let mut device = Device::answering(&[0x0F, 0x01]);
        assert_eq!(item::<u16, Rw>().at(&mut device).modify(|word| word | 0x80), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0x8F, 0x01].as_slice()));
        assert_eq!(now(item::<u16, Rw>().at(&mut device).modify_async(|word| word & 0xFF)), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0x0F, 0x00].as_slice()));
        assert_eq!(device.reads, 2);
    }

    #[test]
    fn a_modified_value_has_to_be_in_range() {
        let mut device = Device::answering(&[0xE8, 0x03]);
        let refused = LIMITED.at(&mut device).modify(|torque| torque + 1).unwrap_err();
        assert_eq!(refused.to_string(), "write 1001 to Target torque (0x6071:00): outside the range -1000 to 1000");
        let refused = now(item::<u32, Rw>().at(&mut device).modify_async(|_| panic!("nothing was read"))).unwrap_err();
        assert_eq!(refused.to_string(), "read Test item (0x2000:01): expected 4 bytes, got 2");
        assert_eq!(device.written, None);
    }
}
