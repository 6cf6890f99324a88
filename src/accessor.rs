//! Accessors, which read and write an item through a client.

mod fixed;
mod octets;
mod scaled;
mod text;

use core::fmt;

use crate::access_error::{AccessError, AccessedItem};
use crate::bus::Bus;
use crate::bus_address::BusAddress;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::raw_value::RawValue;
use crate::route::{ReadRoute, WriteRoute};
use crate::value::Value;
use crate::value_error::LengthError;

/// Reads and writes one [`Item`] through one client. [`Item::at`] creates an accessor.
///
/// The access rights `A`, the location `L` and the bus of the client `C` determine which methods compile. The value
/// type `V` determines the argument types of these methods. Methods without a suffix need a [`Client`]. Methods with
/// the suffix `_async` need an [`AsyncClient`] and don't block.
///
/// # Errors
///
/// A failed read or write returns an [`AccessError`], which names the item. The reason is an error of the client (see
/// [`Client::read`]) or one of the errors that the method documents. If a reply has the wrong length, the method
/// returns [`Error::Length`] and doesn't panic.
pub struct Accessor<'c, C, V: Value, A, L> {
    client: &'c mut C,
    item: Item<V, A, L>,
}

impl<V: Value, A, L> Item<V, A, L> {
    /// Creates the accessor that reads and writes the item through `client`.
    #[inline]
    pub fn at<C>(self, client: &mut C) -> Accessor<'_, C, V, A, L> {
        Accessor::new(client, self)
    }
}

impl<'c, C, V: Value, A, L> Accessor<'c, C, V, A, L> {
    /// Creates the accessor that reads and writes `item` through `client`.
    #[must_use]
    #[inline]
    pub fn new(client: &'c mut C, item: Item<V, A, L>) -> Self {
        Self { client, item }
    }

    /// Returns the item.
    #[must_use]
    pub const fn item(&self) -> &Item<V, A, L> {
        &self.item
    }
}

impl<C, V: Value, A, L> Accessor<'_, C, V, A, L> {
    /// Returns the name and the address of the item for an error. The function is always inlined, so that the compiler
    /// doesn't have to store the whole item.
    #[inline(always)]
    fn accessed(&self, address: Option<BusAddress>) -> AccessedItem {
        (self.item.name(), address)
    }

    #[inline(always)]
    fn read_failed<B: Bus, E>(&self, error: Error<E>) -> AccessError<E>
    where
        L: On<B, Route: ReadRoute<B>>,
    {
        AccessError::read(error, self.accessed(self.item.location().route().read_address()))
    }

    #[inline(always)]
    fn write_failed<B: Bus, E>(&self, error: Error<E>, value: Option<RawValue>) -> AccessError<E>
    where
        L: On<B, Route: WriteRoute<B>>,
    {
        AccessError::write(error, self.accessed(self.item.location().route().write_address()), value)
    }
}

/// Defines the methods that transfer bytes, blocking and async.
macro_rules! transfers {
    ($Client:ident $fetch:ident $read:ident $send:ident $write:ident $($async:ident $await:ident)?) => {
        impl<C: $Client, V: Value, A, L> Accessor<'_, C, V, A, L> {
            #[inline]
            $($async)? fn $fetch<'b>(&mut self, buffer: &'b mut [u8]) -> Result<&'b [u8], Error<C::Error>>
            where
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                let length = self.item.location().route().$read(self.client, buffer)$(.$await)??;
                Ok(filled(buffer, length)?)
            }

            #[inline]
            $($async)? fn $send(&mut self, data: &[u8]) -> Result<(), Error<C::Error>>
            where
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                self.item.location().route().$write(self.client, data)$(.$await)?
            }
        }
    };
}

transfers! { Client fetch read send write }
transfers! { AsyncClient fetch_async read_async send_async write_async async await }

impl<C, V: Value, A, L: fmt::Debug> fmt::Debug for Accessor<'_, C, V, A, L>
where
    V::Native: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Accessor").field("item", &self.item).finish_non_exhaustive()
    }
}

/// Returns the first `length` bytes of `buffer`, or an error if a client reports more bytes than the buffer has.
#[inline]
fn filled(buffer: &[u8], length: usize) -> Result<&[u8], LengthError> {
    buffer.get(..length).ok_or(LengthError { expected: buffer.len(), actual: length })
}

#[cfg(test)]
mod testing;

#[cfg(test)]
mod tests {
    use super::testing::{item, Device};
    use super::*;
    use crate::Rw;
    use std::format;

    #[test]
    fn a_length_beyond_the_buffer_is_an_error() {
        assert_eq!(filled(&[1, 2], 2), Ok([1, 2].as_slice()));
        assert_eq!(filled(&[1, 2], 3), Err(LengthError { expected: 2, actual: 3 }));
    }

    #[test]
    fn prints_its_item() {
        let mut device = Device::default();
        let accessor = item::<u8, Rw>().at(&mut device);
        assert!(format!("{accessor:?}").contains("Test item"));
        assert_eq!(accessor.item().name(), "Test item");
    }
}
