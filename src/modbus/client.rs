//! Clients that read blocks of items.

use core::future::Future;
use core::time::Duration;

use super::block::Block;
use super::limits::Limits;
use super::reading::{Reading, MAX_BYTES};
use crate::bus::Modbus;
use crate::client::{AsyncClient, Client, Timed};
use crate::error::Error;

/// A client that reads several items with one call.
///
/// The provided methods use [`Client::read`]. Implement [`limits`](Self::limits) if you know the [`Limits`] of the
/// device:
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

    /// Reads items with as few requests as the device allows. The [module documentation](super) describes which items
    /// one request can read. The whole request fails if the device lacks one of its items.
    ///
    /// # Errors
    ///
    /// - The errors of [`Client::read`].
    /// - [`Error::Length`] if an item exceeds one request and the device doesn't allow a
    ///   [split](super::TableLimits::split). The client then sends no request. [`Error::Length`] also occurs if the
    ///   length of an item's type differs from the length of its registers.
    fn read_block<const N: usize, B: Block<N>>(&mut self, block: B) -> Result<B::Values, Error<Self::Error>>
    where
        Self: Sized,
    {
        let mut reading = Reading::new(&block, self.limits())?;
        while let Some((request, length)) = reading.request() {
            let mut answer = [0; MAX_BYTES];
            let received = self.read(request, &mut answer[..length])?;
            reading.answered(&answer[..length], received)?;
        }
        Ok(block.values(reading.values())?)
    }
}

/// An asynchronous client that reads several items with one call, as [`RegisterClient`] does.
#[allow(async_fn_in_trait)]
pub trait AsyncRegisterClient: AsyncClient<Bus = Modbus> {
    /// Returns the limits of the device's requests; by default [`Limits::STANDARD`].
    fn limits(&self) -> &Limits {
        &Limits::STANDARD
    }

    /// Reads items with as few requests as the device allows, as [`RegisterClient::read_block`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`RegisterClient::read_block`].
    async fn read_block_async<const N: usize, B: Block<N>>(&mut self, block: B) -> Result<B::Values, Error<Self::Error>>
    where
        Self: Sized,
    {
        let mut reading = Reading::new(&block, self.limits())?;
        while let Some((request, length)) = reading.request() {
            let mut answer = [0; MAX_BYTES];
            let received = self.read(request, &mut answer[..length]).await?;
            reading.answered(&answer[..length], received)?;
        }
        Ok(block.values(reading.values())?)
    }
}

macro_rules! forwarding {
    ($RegisterClient:ident $($future:tt)*) => {
        impl<C: $RegisterClient, D: FnMut(Duration) $($future)*> $RegisterClient for Timed<C, D> {
            fn limits(&self) -> &Limits {
                self.inner().limits()
            }
        }

        impl<T: $RegisterClient> $RegisterClient for &mut T {
            fn limits(&self) -> &Limits {
                T::limits(self)
            }
        }
    };
}

forwarding! { RegisterClient }
forwarding! { AsyncRegisterClient -> F, F: Future<Output = ()> }
