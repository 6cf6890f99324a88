//! Clients that read and write blocks of items.

use core::future::Future;
use core::time::Duration;

use super::block::Block;
use super::limits::Limits;
use super::reading::{Reading, MAX_BYTES};
use super::write_block::{masked, masks, WriteBlock, WriteItem, Writing};
use crate::access_error::AccessError;
use crate::bus::Modbus;
use crate::client::{AsyncClient, Client, Timed};
use crate::error::Error;
use crate::register::{Register, RegisterTable};

/// Sends the requests of a [`Reading`], blocking or async.
macro_rules! read_all {
    ($client:ident, $reading:ident $(, $await:ident)?) => {
        while let Some((request, length)) = $reading.request() {
            let mut answer = [0; MAX_BYTES];
            let answer = answer.get_mut(..length).unwrap_or_default();
            let received = $client.read(request, answer)$(.$await)?.map_err(|error| $reading.failed(error))?;
            $reading.answered(answer, received).map_err(|error| $reading.failed(error.into()))?;
        }
    };
}

/// Writes a block and reads another block, blocking or async. If possible, one request combines the last write and the
/// first read.
macro_rules! exchange {
    ($client:ident, $write:ident, $values:ident, $read:ident $(, $await:ident)?) => {{
        let writing = Writing::new(&$write, $values, $client.limits())?;
        let mut reading = Reading::new(&$read, $client.limits())?;
        let last = writing.len().saturating_sub(1);
        for at in 0..writing.len() {
            let Some((register, data)) = writing.write(at) else { break };
            let combined = reading.request().filter(|(request, _)| at == last && is_combined(&register, request));
            let Some((request, length)) = combined else {
                $client.write(register, data)$(.$await)?.map_err(|error| writing.failed(at, error))?;
                continue;
            };
            let mut answer = [0; MAX_BYTES];
            let answer = answer.get_mut(..length).unwrap_or_default();
            let received = $client.write_and_read(register, data, request, answer)$(.$await)?;
            let received = received.map_err(|error| writing.failed(at, error))?;
            reading.answered(answer, received).map_err(|error| reading.failed(error.into()))?;
        }
        read_all!($client, reading $(, $await)?);
        reading.values(&$read)
    }};
}

/// A client that reads and writes several items with one call.
///
/// The provided methods use [`Client::read`] and [`Client::write`]. Implement [`limits`](Self::limits) to set the
/// [`Limits`] of the device:
///
/// ```
/// # use lexibus::{Client, Error, Modbus, Register};
/// use lexibus::modbus::{Limits, RegisterClient};
///
/// struct Line(Limits);
/// # impl Client for Line {
/// #     type Bus = Modbus;
/// #     type Error = ();
/// #     fn read(&mut self, _: Register, _: &mut [u8]) -> Result<usize, Error<()>> { Err(Error::Client(())) }
/// #     fn write(&mut self, _: Register, _: &[u8]) -> Result<(), Error<()>> { Err(Error::Client(())) }
/// # }
///
/// impl RegisterClient for Line {
///     fn limits(&self) -> &Limits {
///         &self.0
///     }
/// }
/// ```
pub trait RegisterClient: Client<Bus = Modbus> {
    /// Returns the limits of the device's requests; by default [`Limits::STANDARD`].
    fn limits(&self) -> &Limits {
        &Limits::STANDARD
    }

    /// Changes some bits of a holding register (function 22, MODBUS Application Protocol V1.1b3, 6.16). If the register
    /// has the value `held`, the new value is `held & and | or & !and`. [`write_masked`](Self::write_masked) calculates
    /// the masks.
    ///
    /// The default implementation reads the register and then writes it. If another client writes the register between
    /// the two requests, the change of that client is lost.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::read`] and [`Client::write`].
    fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Self::Error>> {
        let register = Register::holding(address);
        let mut held = [0; 2];
        self.read(register, &mut held)?;
        self.write(register, &masked(u16::from_le_bytes(held), and, or).to_le_bytes())
    }

    /// Writes `data` to the register `write`, then reads the register `read` into the start of `buffer` (function 23,
    /// MODBUS Application Protocol V1.1b3, 6.17). Returns the length of the read value in bytes.
    /// [`exchange`](Self::exchange) does the same for items.
    ///
    /// The default implementation sends a write request, then a read request.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::read`] and [`Client::write`]. After an error, the device may have executed the write.
    fn write_and_read(
        &mut self,
        write: Register,
        data: &[u8],
        read: Register,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>> {
        self.write(write, data)?;
        self.read(read, buffer)
    }

    /// Reads items with as few requests as the device allows. The [module documentation](super) describes which items
    /// one request can read. If the device doesn't have one of the items, the request with this item fails.
    ///
    /// # Errors
    ///
    /// The error names the first item of the failed request and the number of its [other items](AccessError::others).
    ///
    /// - The errors of [`Client::read`].
    /// - [`Error::Length`] if an item exceeds one request and the device doesn't allow a
    ///   [split](super::TableLimits::split). The client then sends no request.
    /// - [`Error::Length`] if the length of an item's type differs from the length of its registers.
    fn read_block<const N: usize, B: Block<N>>(&mut self, block: B) -> Result<B::Values, AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let mut reading = Reading::new(&block, self.limits())?;
        read_all!(self, reading);
        reading.values(&block)
    }

    /// Changes some bits of an item that has exactly one holding register. Each bit that is set in `mask` gets its
    /// value from `value`; the other bits of the register don't change. The range of the item is not checked.
    ///
    /// If the limits include function 22, [`ModbusClient`](crate::clients) sends one request. Otherwise, the client
    /// reads the register and then writes it.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`mask_register`](Self::mask_register). Returns [`Error::Length`] if the item doesn't have
    /// exactly one holding register, or [`Error::OutOfRange`] if `value` or `mask` doesn't fit the item's type.
    fn write_masked<I: WriteItem>(
        &mut self,
        item: I,
        value: I::Native,
        mask: I::Native,
    ) -> Result<(), AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let (address, and, or) = masks(&item, value, mask).map_err(|error| mask_failed(&item, value, error))?;
        self.mask_register(address, and, or).map_err(|error| mask_failed(&item, value, error))
    }

    /// Writes items. If the items are whole holding registers at consecutive addresses, and the device allows it, one
    /// request writes all items. Otherwise, each item is written with a separate request, in the order of the block.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::write`]; after such an error, some items may have been written. If a value is
    /// outside the range of its item, returns [`Error::OutOfRange`] and sends nothing.
    fn write_block<const N: usize, B: WriteBlock<N>>(
        &mut self,
        block: B,
        values: B::Values,
    ) -> Result<(), AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let writing = Writing::new(&block, values, self.limits())?;
        for at in 0..writing.len() {
            if let Some((register, data)) = writing.write(at) {
                self.write(register, data).map_err(|error| writing.failed(at, error))?;
            }
        }
        Ok(())
    }

    /// Writes items, then reads items. If the limits of the holding registers include function 23,
    /// [`ModbusClient`](crate::clients) combines a write and a read in one request. The device writes before it reads.
    ///
    /// The combined request contains the last write and the first read. They are combined only if both fit into one
    /// request, the write is for whole holding registers and the read is for holding registers. The other requests are
    /// sent as in [`write_block`](Self::write_block) and [`read_block`](Self::read_block).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`write_block`](Self::write_block) and [`read_block`](Self::read_block). After an error of
    /// the client, some or all items may have been written.
    fn exchange<const N: usize, const M: usize, W: WriteBlock<N>, B: Block<M>>(
        &mut self,
        write: W,
        values: W::Values,
        read: B,
    ) -> Result<B::Values, AccessError<Self::Error>>
    where
        Self: Sized,
    {
        exchange!(self, write, values, read)
    }
}

/// An asynchronous client that reads and writes several items with one call. See [`RegisterClient`].
#[allow(async_fn_in_trait)]
pub trait AsyncRegisterClient: AsyncClient<Bus = Modbus> {
    /// Returns the limits of the device's requests; by default [`Limits::STANDARD`].
    fn limits(&self) -> &Limits {
        &Limits::STANDARD
    }

    /// Changes some bits of a holding register (function 22, MODBUS Application Protocol V1.1b3, 6.16). If the register
    /// has the value `held`, the new value is `held & and | or & !and`.
    /// [`write_masked_async`](Self::write_masked_async) calculates the masks.
    ///
    /// The default implementation reads the register and then writes it. If another client writes the register between
    /// the two requests, the change of that client is lost.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`AsyncClient::read`] and [`AsyncClient::write`].
    async fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Self::Error>> {
        let register = Register::holding(address);
        let mut held = [0; 2];
        self.read(register, &mut held).await?;
        self.write(register, &masked(u16::from_le_bytes(held), and, or).to_le_bytes()).await
    }

    /// Writes `data` to the register `write`, then reads the register `read` into the start of `buffer` (function 23,
    /// MODBUS Application Protocol V1.1b3, 6.17). Returns the length of the read value in bytes.
    /// [`exchange_async`](Self::exchange_async) does the same for items.
    ///
    /// The default implementation sends a write request, then a read request.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`AsyncClient::read`] and [`AsyncClient::write`]. After an error, the device may have executed the write.
    async fn write_and_read(
        &mut self,
        write: Register,
        data: &[u8],
        read: Register,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>> {
        self.write(write, data).await?;
        self.read(read, buffer).await
    }

    /// Reads items with as few requests as the device allows, as [`RegisterClient::read_block`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`RegisterClient::read_block`].
    async fn read_block_async<const N: usize, B: Block<N>>(
        &mut self,
        block: B,
    ) -> Result<B::Values, AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let mut reading = Reading::new(&block, self.limits())?;
        read_all!(self, reading, await);
        reading.values(&block)
    }

    /// Changes some bits of an item that has exactly one holding register. Each bit that is set in `mask` gets its
    /// value from `value`; the other bits of the register don't change. The range of the item is not checked.
    ///
    /// If the limits include function 22, [`ModbusClient`](crate::clients) sends one request. Otherwise, the client
    /// reads the register and then writes it.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`mask_register`](Self::mask_register). Returns [`Error::Length`] if the item doesn't have
    /// exactly one holding register, or [`Error::OutOfRange`] if `value` or `mask` doesn't fit the item's type.
    async fn write_masked_async<I: WriteItem>(
        &mut self,
        item: I,
        value: I::Native,
        mask: I::Native,
    ) -> Result<(), AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let (address, and, or) = masks(&item, value, mask).map_err(|error| mask_failed(&item, value, error))?;
        self.mask_register(address, and, or).await.map_err(|error| mask_failed(&item, value, error))
    }

    /// Writes items. If the items are whole holding registers at consecutive addresses, and the device allows it, one
    /// request writes all items. Otherwise, each item is written with a separate request, in the order of the block.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`AsyncClient::write`]; after such an error, some items may have been written. If a value
    /// is outside the range of its item, returns [`Error::OutOfRange`] and sends nothing.
    async fn write_block_async<const N: usize, B: WriteBlock<N>>(
        &mut self,
        block: B,
        values: B::Values,
    ) -> Result<(), AccessError<Self::Error>>
    where
        Self: Sized,
    {
        let writing = Writing::new(&block, values, self.limits())?;
        for at in 0..writing.len() {
            if let Some((register, data)) = writing.write(at) {
                self.write(register, data).await.map_err(|error| writing.failed(at, error))?;
            }
        }
        Ok(())
    }

    /// Writes items, then reads items. If the limits of the holding registers include function 23,
    /// [`ModbusClient`](crate::clients) combines a write and a read in one request. The device writes before it reads.
    ///
    /// The combined request contains the last write and the first read. They are combined only if both fit into one
    /// request, the write is for whole holding registers and the read is for holding registers. The other requests are
    /// sent as in [`write_block_async`](Self::write_block_async) and [`read_block_async`](Self::read_block_async).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`write_block_async`](Self::write_block_async) and
    /// [`read_block_async`](Self::read_block_async). After an error of the client, some or all items may have been
    /// written.
    async fn exchange_async<const N: usize, const M: usize, W: WriteBlock<N>, B: Block<M>>(
        &mut self,
        write: W,
        values: W::Values,
        read: B,
    ) -> Result<B::Values, AccessError<Self::Error>>
    where
        Self: Sized,
    {
        exchange!(self, write, values, read, await)
    }
}

/// Adds the item and the value to an error of a mask write request.
fn mask_failed<I: WriteItem, E>(item: &I, value: I::Native, error: Error<E>) -> AccessError<E> {
    AccessError::write(error, (item.name(), Some(item.register().into())), item.raw_value(value))
}

/// Returns whether one request with function 23 can write and read these registers.
pub(crate) fn is_combined(write: &Register, read: &Register) -> bool {
    let is_holding = |register: &Register| register.table == RegisterTable::Holding;
    is_holding(write) && write.part.is_none() && is_holding(read)
}

/// Defines the methods of a [`RegisterClient`] that forward to another client.
macro_rules! forwarded {
    ($client:ident: $get:expr, $mut:expr $(, $async:ident $await:ident)?) => {
        fn limits(&self) -> &Limits {
            let $client = self;
            $get.limits()
        }

        $($async)? fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Self::Error>> {
            let $client = self;
            $mut.mask_register(address, and, or)$(.$await)?
        }

        $($async)? fn write_and_read(
            &mut self,
            write: Register,
            data: &[u8],
            read: Register,
            buffer: &mut [u8],
        ) -> Result<usize, Error<Self::Error>> {
            let $client = self;
            $mut.write_and_read(write, data, read, buffer)$(.$await)?
        }
    };
}

macro_rules! forwarding {
    ($RegisterClient:ident [$($future:tt)*] $(, $async:ident $await:ident)?) => {
        impl<C: $RegisterClient, D: FnMut(Duration) $($future)*> $RegisterClient for Timed<C, D> {
            forwarded! { timed: timed.inner(), timed.client() $(, $async $await)? }
        }

        impl<T: $RegisterClient> $RegisterClient for &mut T {
            forwarded! { client: (**client), (**client) $(, $async $await)? }
        }
    };
}

forwarding! { RegisterClient [] }
forwarding! { AsyncRegisterClient [-> F, F: Future<Output = ()>], async await }
