//! Traits that transfer the bytes of items. Adapters to bus libraries implement the traits of this module.

use core::future::Future;
use core::time::Duration;

use crate::bus::Bus;
use crate::clock::{Clock, DefaultClock};
use crate::error::Error;

/// Reads and writes the items of one device. Each call blocks until the device replies or the access fails.
///
/// The bytes of a value are in little-endian order, as in CANopen. If the bus uses a different byte order, the client
/// converts the value.
///
/// # Example
///
/// ```
/// use lexibus::{CanOpen, Client, Error, Flags, Initial, Item, Object, OnCanOpen, OutOfRange, Range, Ro, Rw};
///
/// // The compiler generates this for two objects of a drive:
/// const TARGET_POSITION: Item<i32, Rw, OnCanOpen> = Item::new(
///     OnCanOpen::canopen(0x607A, 0x00),
///     "Target position",
///     Range::Between(-200_000, 200_000),
///     Initial::Value(0),
///     "inc",
///     Flags::RPDO,
/// );
/// const STATUSWORD: Item<u16, Ro, OnCanOpen> =
///     Item::new(OnCanOpen::canopen(0x6041, 0x00), "Statusword", Range::Full, Initial::Unknown, "", Flags::TPDO);
///
/// // A bus library implements this trait. This example is a device that stores its last write:
/// struct Echo([u8; 4]);
///
/// impl Client for Echo {
///     type Bus = CanOpen;
///     type Error = core::convert::Infallible;
///
///     fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
///         for (to, from) in buffer.iter_mut().zip(self.0) {
///             *to = from;
///         }
///         Ok(buffer.len())
///     }
///
///     fn write(&mut self, _: Object, data: &[u8]) -> Result<(), Error<Self::Error>> {
///         for (to, from) in self.0.iter_mut().zip(data) {
///             *to = *from;
///         }
///         Ok(())
///     }
/// }
///
/// let mut client = Echo([0; 4]);
/// TARGET_POSITION.at(&mut client).write(100_000)?;
/// assert_eq!(TARGET_POSITION.at(&mut client).read()?, 100_000);
/// assert_eq!(STATUSWORD.at(&mut client).read()?, 0x86A0);
///
/// // 300,000 is outside the range of the item, so nothing is sent:
/// let refused = TARGET_POSITION.at(&mut client).write(300_000);
/// assert_eq!(refused.map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
pub trait Client {
    /// Bus of the device.
    type Bus: Bus;

    /// Error type of the bus library.
    type Error;

    /// Reads the value at `address` into the start of `buffer`, and returns the length of the value in bytes.
    ///
    /// For a value of a fixed size, `buffer` has exactly the length of the value. If the bus doesn't transmit lengths,
    /// fill the whole buffer. If the device sends a value that is longer than `buffer`, return the length of this
    /// value, or an error. If a value is too long, the content of `buffer` is unspecified.
    ///
    /// # Errors
    ///
    /// - [`Error::Client`] if the bus fails.
    /// - [`Error::Abort`] if the device refuses the access.
    /// - [`Error::Timeout`] if the device doesn't reply in time.
    /// - [`Error::UnexpectedReply`] or [`Error::Length`] if the reply doesn't match the request.
    fn read(&mut self, address: <Self::Bus as Bus>::Address, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the value at `address`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read`](Self::read).
    fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Writes two values in the order of `writes`. A client of a bus with a process image can send both values in one
    /// cycle. The default implementation writes one value after the other.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`write`](Self::write). After an error, the first value may already be written.
    fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
        writes.into_iter().try_for_each(|(address, data)| self.write(address, data))
    }

    /// Waits for at least `time`.
    ///
    /// Some devices need time between two transfers of one access: see [`Handshake`](crate::Handshake). The default
    /// implementation sleeps if the feature `std` is enabled, and otherwise returns an error. [`Timed`] adds a delay
    /// function to any client.
    ///
    /// # Errors
    ///
    /// Returns [`Error::NoClock`] if the client cannot wait. A client that communicates while it waits also returns
    /// communication errors.
    fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        sleep(time)
    }

    /// Returns the time since a fixed moment, or `None` if the client has no clock. Operations with a deadline, such as
    /// [`Machine::walk`](crate::Machine::walk), measure the time with this clock. Without a clock, these operations
    /// count only their pauses between two accesses: slow accesses then prolong the operation. The default
    /// implementation returns the time of the [`DefaultClock`].
    fn now(&mut self) -> Option<Duration> {
        DefaultClock.now()
    }

    /// Returns whether another attempt may succeed after this error of the bus library. If this method returns false,
    /// [`Retrying`](crate::Retrying) doesn't repeat the access. The default implementation returns true.
    fn is_transient(&self, error: &Self::Error) -> bool {
        let _ = error;
        true
    }
}

/// An address and the bytes to write to this address.
pub type Write<'d, B> = (<B as Bus>::Address, &'d [u8]);

/// Puts the thread to sleep. Returns an error if the feature `std` is not enabled.
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

/// Reads and writes the items of one device without blocking, under the same rules as [`Client`].
///
/// The client type determines whether the futures of the methods are `Send`.
#[allow(async_fn_in_trait)]
pub trait AsyncClient {
    /// Bus of the device.
    type Bus: Bus;

    /// Error type of the bus library.
    type Error;

    /// Reads the value at `address`, as [`Client::read`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::read`].
    async fn read(
        &mut self,
        address: <Self::Bus as Bus>::Address,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the value at `address`, as [`Client::write`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::write`].
    async fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Writes two values, as [`Client::write_both`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::write_both`].
    async fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
        for (address, data) in writes {
            self.write(address, data).await?;
        }
        Ok(())
    }

    /// Waits for `time`, as [`Client::wait`] does. The default implementation returns an error, because a timer depends
    /// on the executor.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Client::wait`].
    async fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        let _ = time;
        Err(Error::NoClock)
    }

    /// Returns the time since a fixed moment, as [`Client::now`] does.
    fn now(&mut self) -> Option<Duration> {
        DefaultClock.now()
    }

    /// Returns whether another attempt may succeed after this error, as [`Client::is_transient`] does.
    fn is_transient(&self, error: &Self::Error) -> bool {
        let _ = error;
        true
    }
}

/// Adds a delay function to a client, for accesses that have to [wait](Client::wait). The delay function `D` waits for
/// the given time, or returns a future that is ready after this time.
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
/// // `delay` is an `embedded_hal::delay::DelayNs`. An async client can use `embassy_time::Timer::after`.
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
    clock: Option<fn() -> Duration>,
}

impl<C, D> Timed<C, D> {
    /// Creates a client that uses `client` for transfers and `delay` to wait.
    pub const fn new(client: C, delay: D) -> Self {
        Self { client, delay, clock: None }
    }

    /// Returns the client with a clock for deadlines: a function that returns the time since any fixed moment. By default,
    /// the clock is that of the wrapped client.
    #[must_use]
    pub fn with_clock(self, clock: fn() -> Duration) -> Self {
        Self { clock: Some(clock), ..self }
    }

    /// Returns the wrapped client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the wrapped client, and drops the delay function and the clock.
    pub fn into_client(self) -> C {
        self.client
    }

    pub(crate) const fn inner(&self) -> &C {
        &self.client
    }
}

/// Defines the clients that forward calls to another client, `Timed` and `&mut T`, blocking and async.
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

            fn now(&mut self) -> Option<Duration> {
                self.clock.map_or_else(|| self.client.now(), |clock| Some(clock()))
            }

            fn is_transient(&self, error: &Self::Error) -> bool {
                self.client.is_transient(error)
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

            fn now(&mut self) -> Option<Duration> {
                T::now(self)
            }

            fn is_transient(&self, error: &Self::Error) -> bool {
                T::is_transient(self, error)
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
