//! What carries an item's bytes: implemented by adapters to bus libraries.

use core::future::Future;
use core::time::Duration;

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

    /// Writes two values, in this order; at once where the bus can, as in one cycle of a process image. Unless said otherwise,
    /// one after the other.
    ///
    /// # Errors
    ///
    /// The same as of [`write`](Self::write); the first value may have been written then.
    fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
        writes.into_iter().try_for_each(|(address, data)| self.write(address, data))
    }

    /// Waits so long, or a little longer.
    ///
    /// Some devices need time between two transfers of one access: see [`Handshake`](crate::Handshake). Unless said
    /// otherwise, the thread sleeps (feature `std`), or there is no clock; [`Timed`] gives any client one.
    ///
    /// # Errors
    ///
    /// [`Error::NoClock`] where the client can't wait; else those of what it has to do meanwhile.
    fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        sleep(time)
    }
}

/// An address, and the bytes that are written there.
pub type Write<'d, B> = (<B as Bus>::Address, &'d [u8]);

/// Lets the thread sleep, where there are threads.
#[inline]
pub(crate) fn sleep<E>(time: Duration) -> Result<(), Error<E>> {
    #[cfg(feature = "std")]
    std::thread::sleep(time);
    let _ = time;
    if cfg!(feature = "std") {
        Ok(())
    } else {
        Err(Error::NoClock)
    }
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

    /// Writes two values, as [`Client::write_both`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`Client::write_both`].
    async fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
        for (address, data) in writes {
            self.write(address, data).await?;
        }
        Ok(())
    }

    /// Waits so long, as [`Client::wait`] does. Unless said otherwise, there is no clock: that is up to the executor.
    ///
    /// # Errors
    ///
    /// The same as of [`Client::wait`].
    async fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        let _ = time;
        Err(Error::NoClock)
    }
}

/// A client with a clock, for the accesses that have to [wait](Client::wait). `D` waits: a function that takes as long as it is
/// told, or gives a future that does.
///
/// ```
/// use core::time::Duration;
/// use lexibus::{Client, Timed};
/// # use lexibus::{Error, Parameter, Serial};
/// # struct Line;
/// # impl Client for Line {
/// #     type Bus = Serial;
/// #     type Error = ();
/// #     fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<()>> { Err(Error::Timeout) }
/// #     fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> { Err(Error::Timeout) }
/// # }
/// # struct Delay(u32);
/// # impl Delay { fn delay_us(&mut self, time: u32) { self.0 += time; } }
/// # let (line, mut delay) = (Line, Delay(0));
///
/// // `embedded_hal::delay::DelayNs`, say; of an async client, `embassy_time::Timer::after` or `tokio::time::sleep`.
/// let mut client = Timed::new(line, |time: Duration| delay.delay_us(time.as_micros() as u32));
/// client.wait(Duration::from_millis(3))?;
/// # drop(client);
/// # assert_eq!(delay.0, 3000);
/// # Ok::<(), Error<()>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Timed<C, D> {
    client: C,
    delay: D,
}

impl<C, D> Timed<C, D> {
    /// `client`, which waits with `delay`.
    pub const fn new(client: C, delay: D) -> Self {
        Self { client, delay }
    }

    /// The client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Gives the client back.
    pub fn into_client(self) -> C {
        self.client
    }

    pub(crate) const fn inner(&self) -> &C {
        &self.client
    }
}

/// Clients that hand everything, or all but the time, to another one; blocking and not.
macro_rules! forwarding {
    ($Client:ident [$($future:tt)*] $($async:ident $await:ident)?) => {
        impl<C: $Client, D: FnMut(Duration) $($future)*> $Client for Timed<C, D> {
            type Bus = C::Bus;
            type Error = C::Error;

            $($async)? fn read(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                buffer: &mut [u8],
            ) -> Result<usize, Error<Self::Error>> {
                self.client.read(address, buffer)$(.$await)?
            }

            $($async)? fn write(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                data: &[u8],
            ) -> Result<(), Error<Self::Error>> {
                self.client.write(address, data)$(.$await)?
            }

            $($async)? fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
                self.client.write_both(writes)$(.$await)?
            }

            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
                (self.delay)(time)$(.$await)?;
                Ok(())
            }
        }

        impl<T: $Client + ?Sized> $Client for &mut T {
            type Bus = T::Bus;
            type Error = T::Error;

            $($async)? fn read(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                buffer: &mut [u8],
            ) -> Result<usize, Error<Self::Error>> {
                T::read(self, address, buffer)$(.$await)?
            }

            $($async)? fn write(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                data: &[u8],
            ) -> Result<(), Error<Self::Error>> {
                T::write(self, address, data)$(.$await)?
            }

            $($async)? fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
                T::write_both(self, writes)$(.$await)?
            }

            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
                T::wait(self, time)$(.$await)?
            }
        }
    };
}

forwarding! { Client [] }
forwarding! { AsyncClient [-> F, F: Future<Output = ()>] async await }

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
