//! Clients that repeat failed accesses, and async clients with a timeout.

use core::future::Future;
use core::time::Duration;

use crate::bus::{Bus, Modbus};
use crate::client::{AsyncClient, Client, Write};
use crate::clock::Timer;
use crate::error::Error;
use crate::modbus::{AsyncRegisterClient, Limits, RegisterClient};
use crate::register::Register;

/// Client that repeats an access after a bus error: [`Error::Timeout`], [`Error::UnexpectedReply`], or an
/// [`Error::Client`] that is [transient](Client::is_transient). The access isn't repeated after any other error, for
/// example a refusal by the device. On Modbus, a refused access is repeated only after the exceptions 6 (server device
/// busy) and 11 (gateway target device failed to respond).
///
/// Writes are not repeated by default: the device may have executed a write whose reply is lost. Don't use this client
/// for reads that change the device, for example reads of a queue.
///
/// ```
/// # use lexibus::{Client, Error, Parameter, Serial};
/// use lexibus::Retrying;
///
/// # struct Line(u32);
/// # impl Client for Line {
/// #     type Bus = Serial;
/// #     type Error = ();
/// #     fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<()>> {
/// #         self.0 += 1;
/// #         if self.0 < 3 { Err(Error::Timeout) } else { Ok(1) }
/// #     }
/// #     fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> { Err(Error::Timeout) }
/// # }
/// # let line = Line(0);
/// let mut client = Retrying::reads(line, 2);
/// assert_eq!(client.read(Parameter(7), &mut [0]), Ok(1)); // the third attempt
/// assert_eq!(client.write(Parameter(7), &[0]), Err(Error::Timeout)); // the only attempt
/// ```
#[derive(Clone, Debug)]
pub struct Retrying<C> {
    client: C,
    reads: u8,
    writes: u8,
}

impl<C> Retrying<C> {
    /// Creates a client that repeats a failed read up to `count` times.
    pub const fn reads(client: C, count: u8) -> Self {
        Self { client, reads: count, writes: 0 }
    }

    /// Returns the client, which now also repeats a failed write up to `count` times.
    #[must_use]
    pub fn and_writes(self, count: u8) -> Self {
        Self { writes: count, ..self }
    }

    /// Returns the wrapped client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the wrapped client and drops the settings.
    pub fn into_client(self) -> C {
        self.client
    }
}

/// Returns whether another attempt is allowed, and counts this attempt.
fn again<T, E>(result: &Result<T, Error<E>>, is_transient: impl FnOnce(&E) -> bool, left: &mut u8) -> bool {
    let is_transient = match result {
        Err(Error::Timeout | Error::UnexpectedReply) => true,
        Err(Error::Client(error)) => is_transient(error),
        _ => false,
    };
    let is_again = is_transient && *left > 0;
    *left = left.saturating_sub(1);
    is_again
}

/// Repeats an access to a client up to `left` times.
macro_rules! repeat {
    ($client:expr, $left:expr, $access:expr) => {{
        let mut left = $left;
        loop {
            let result = $access;
            if !again(&result, |error| $client.is_transient(error), &mut left) {
                return result;
            }
        }
    }};
}

macro_rules! retrying {
    ($Client:ident $RegisterClient:ident $($async:ident $await:ident)?) => {
        impl<C: $Client> $Client for Retrying<C> {
            type Bus = C::Bus;
            type Error = C::Error;

            $($async)? fn read(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                buffer: &mut [u8],
            ) -> Result<usize, Error<Self::Error>> {
                repeat!(self.client, self.reads, self.client.read(address, buffer)$(.$await)?)
            }

            $($async)? fn write(
                &mut self,
                address: <Self::Bus as Bus>::Address,
                data: &[u8],
            ) -> Result<(), Error<Self::Error>> {
                repeat!(self.client, self.writes, self.client.write(address, data)$(.$await)?)
            }

            $($async)? fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
                repeat!(self.client, self.writes, self.client.write_both(writes)$(.$await)?)
            }

            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
                self.client.wait(time)$(.$await)?
            }

            fn now(&mut self) -> Option<Duration> {
                self.client.now()
            }

            fn is_transient(&self, error: &Self::Error) -> bool {
                self.client.is_transient(error)
            }
        }

        /// A request that changes bits, or that writes and reads, is repeated as often as a write.
        impl<C: $RegisterClient<Bus = Modbus>> $RegisterClient for Retrying<C> {
            fn limits(&self) -> &Limits {
                self.client.limits()
            }

            $($async)? fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Self::Error>> {
                repeat!(self.client, self.writes, self.client.mask_register(address, and, or)$(.$await)?)
            }

            $($async)? fn write_and_read(
                &mut self,
                write: Register,
                data: &[u8],
                read: Register,
                buffer: &mut [u8],
            ) -> Result<usize, Error<Self::Error>> {
                repeat!(self.client, self.writes, self.client.write_and_read(write, data, read, buffer)$(.$await)?)
            }
        }
    };
}

retrying! { Client RegisterClient }
retrying! { AsyncClient AsyncRegisterClient async await }

/// An async client with a timeout for each access. Use this client to add a timeout to another client, or to limit the
/// time of an access with several transfers. `T` is a [`Timer`], for example `tokio::time::sleep` or
/// `embassy_time::Timer::after`.
///
/// When the timeout expires, the transfer is dropped. The clients of this crate remain usable after a dropped transfer,
/// except a `ModbusClient` that uses a context of `tokio-modbus` directly instead of a `Link`.
///
/// ```
/// # use core::time::Duration;
/// # use lexibus::{AsyncClient, Error, Parameter, Serial};
/// use lexibus::Deadline;
///
/// # struct Silent;
/// # impl AsyncClient for Silent {
/// #     type Bus = Serial;
/// #     type Error = ();
/// #     async fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<()>> {
/// #         std::future::pending().await
/// #     }
/// #     async fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> { Ok(()) }
/// # }
/// # #[tokio::main(flavor = "current_thread")]
/// # async fn main() {
/// # let silent = Silent;
/// let mut client = Deadline::new(silent, tokio::time::sleep, Duration::from_millis(20));
/// assert_eq!(client.read(Parameter(7), &mut [0]).await, Err(Error::Timeout));
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Deadline<C, T> {
    client: C,
    timer: T,
    timeout: Duration,
}

impl<C, T> Deadline<C, T> {
    /// Creates a client whose accesses fail with [`Error::Timeout`] if they take longer than `timeout`.
    pub const fn new(client: C, timer: T, timeout: Duration) -> Self {
        Self { client, timer, timeout }
    }

    /// Returns the wrapped client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the wrapped client and drops the timer.
    pub fn into_client(self) -> C {
        self.client
    }
}

/// Returns the result of an access, or [`Error::Timeout`] if the access takes longer than `timeout`.
async fn limit<T: Timer, O, E>(
    timer: &mut T,
    timeout: Duration,
    access: impl Future<Output = Result<O, Error<E>>>,
) -> Result<O, Error<E>> {
    timer.limit(timeout, access).await.unwrap_or(Err(Error::Timeout))
}

impl<C: AsyncClient, T: Timer> AsyncClient for Deadline<C, T> {
    type Bus = C::Bus;
    type Error = C::Error;

    async fn read(
        &mut self,
        address: <Self::Bus as Bus>::Address,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>> {
        limit(&mut self.timer, self.timeout, self.client.read(address, buffer)).await
    }

    async fn write(&mut self, address: <Self::Bus as Bus>::Address, data: &[u8]) -> Result<(), Error<Self::Error>> {
        limit(&mut self.timer, self.timeout, self.client.write(address, data)).await
    }

    async fn write_both(&mut self, writes: [Write<'_, Self::Bus>; 2]) -> Result<(), Error<Self::Error>> {
        limit(&mut self.timer, self.timeout, self.client.write_both(writes)).await
    }

    async fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        self.client.wait(time).await
    }

    fn now(&mut self) -> Option<Duration> {
        self.client.now()
    }

    fn is_transient(&self, error: &Self::Error) -> bool {
        self.client.is_transient(error)
    }
}

impl<C: AsyncRegisterClient<Bus = Modbus>, T: Timer> AsyncRegisterClient for Deadline<C, T> {
    fn limits(&self) -> &Limits {
        self.client.limits()
    }

    async fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Self::Error>> {
        limit(&mut self.timer, self.timeout, self.client.mask_register(address, and, or)).await
    }

    async fn write_and_read(
        &mut self,
        write: Register,
        data: &[u8],
        read: Register,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Self::Error>> {
        limit(&mut self.timer, self.timeout, self.client.write_and_read(write, data, read, buffer)).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::now::now;
    use crate::{AbortCode, Parameter, Serial};

    /// A client whose first accesses fail with an error. The second field contains the number of accesses that fail.
    struct Failing(Error<()>, u8);

    impl Failing {
        fn next(&mut self) -> Result<(), Error<()>> {
            let left = self.1;
            self.1 = left.saturating_sub(1);
            if left > 0 {
                Err(self.0)
            } else {
                Ok(())
            }
        }
    }

    impl Client for Failing {
        type Bus = Serial;
        type Error = ();

        fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<()>> {
            self.next().map(|()| 4)
        }

        fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> {
            self.next()
        }
    }

    impl AsyncClient for Failing {
        type Bus = Serial;
        type Error = ();

        async fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<()>> {
            self.next().map(|()| 4)
        }

        async fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<()>> {
            core::future::pending().await
        }
    }

    #[test]
    fn faults_of_the_bus_are_repeated() {
        for error in [Error::Timeout, Error::UnexpectedReply, Error::Client(())] {
            let read = |fails, retries| {
                Client::read(&mut Retrying::reads(Failing(error, fails), retries), Parameter(1), &mut [])
            };
            assert_eq!((read(2, 2), read(3, 2), read(1, 0)), (Ok(4), Err(error), Err(error)));
            let retrying = || Retrying::reads(Failing(error, 1), 5);
            assert_eq!(Client::write(&mut retrying(), Parameter(1), &[]), Err(error));
            assert_eq!(Client::write(&mut retrying().and_writes(1), Parameter(1), &[]), Ok(()));
            let mut both = retrying().and_writes(1);
            assert_eq!(Client::write_both(&mut both, [(Parameter(1), &[]), (Parameter(2), &[])]), Ok(()));
            assert_eq!(now(AsyncClient::read(&mut retrying(), Parameter(1), &mut [])), Ok(4));
        }
        let refused = Error::Abort(AbortCode::READ_ONLY);
        let mut client = Retrying::reads(Failing(refused, 1), 5);
        assert_eq!(Client::read(&mut client, Parameter(1), &mut []), Err(refused), "the device replied");
    }

    #[test]
    fn accesses_end_at_the_deadline() {
        let at_once = |_: Duration| core::future::ready(());
        let mut client = Deadline::new(Failing(Error::Timeout, 0), at_once, Duration::ZERO);
        assert_eq!(now(client.read(Parameter(1), &mut [])), Ok(4));
        assert_eq!(now(client.write(Parameter(1), &[])), Err(Error::Timeout));
        assert_eq!(now(client.write_both([(Parameter(1), &[]), (Parameter(2), &[])])), Err(Error::Timeout));
    }
}
