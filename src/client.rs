//! What carries an item's bytes: implemented by adapters to bus libraries.

use crate::bus::Bus;
use crate::error::Error;

/// Reads and writes one device, waiting for each answer.
///
/// Bytes are in the order of CANopen, the least significant first, on every bus: a client of a bus with another order
/// turns them around.
pub trait Client {
    /// The bus that the device is on.
    type Bus: Bus;

    /// What can go wrong on the bus.
    type Error;

    /// Reads the value at `address` to the start of `buffer` and returns its length in bytes.
    ///
    /// For a value of a fixed size, `buffer` is exactly as long as the value, so a bus that doesn't send lengths fills
    /// it. Where the device sends more than `buffer` holds, return the length of what it sent (what is in the buffer
    /// then doesn't matter) or an error.
    ///
    /// # Errors
    ///
    /// [`Error::Client`] where the bus fails, [`Error::Abort`] where the device refuses, [`Error::UnexpectedReply`] and
    /// [`Error::Length`] where it answers something else.
    fn read(&mut self, address: <Self::Bus as Bus>::Address, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the value at `address`.
    ///
    /// # Errors
    ///
    /// The same as of [`read`](Self::read).
    fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>>;
}

/// Reads and writes one device without blocking. The same rules as for [`Client`].
///
/// Nothing is said about whether the futures can move to another thread; that is up to the client.
#[allow(async_fn_in_trait)]
pub trait AsyncClient {
    /// The bus that the device is on.
    type Bus: Bus;

    /// What can go wrong on the bus.
    type Error;

    /// Reads the value at `address`, as [`Client::read`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`read`](Self::read).
    async fn read(
        &mut self,
        address: <Self::Bus as Bus>::Address,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the value at `address`, as [`Client::write`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`read`](Self::read).
    async fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>>;
}

impl<T: Client + ?Sized> Client for &mut T {
    type Bus = T::Bus;
    type Error = T::Error;

    fn read(&mut self, address: <Self::Bus as Bus>::Address, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
        T::read(self, address, buffer)
    }

    fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>> {
        T::write(self, address, data)
    }
}

impl<T: AsyncClient + ?Sized> AsyncClient for &mut T {
    type Bus = T::Bus;
    type Error = T::Error;

    async fn read(
        &mut self,
        address: <Self::Bus as Bus>::Address,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>> {
        T::read(self, address, buffer).await
    }

    async fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>> {
        T::write(self, address, data).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Parameter, Serial};

    struct Number;

    impl Client for Number {
        type Bus = Serial;
        type Error = ();

        fn read(&mut self, address: Parameter, buffer: &mut [u8]) -> Result<usize, Error<()>> {
            buffer.fill(address.0 as u8);
            Ok(buffer.len())
        }

        fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> {
            Err(Error::Client(()))
        }
    }

    fn first<C: Client<Bus = Serial>>(mut client: C, number: u32) -> Option<u8> {
        let mut buffer = [0];
        client.read(Parameter(number), &mut buffer).ok().map(|_| buffer[0])
    }

    #[test]
    fn a_borrowed_client_is_a_client() {
        let mut client = Number;
        assert_eq!(first(&mut client, 3), Some(3));
        let object: &mut dyn Client<Bus = Serial, Error = ()> = &mut client;
        assert_eq!(first(object, 4), Some(4));
        assert_eq!(client.write(Parameter(0), &[]), Err(Error::Client(())));
    }
}
