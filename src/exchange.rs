//! Messages that are answered: what carries them, and parameters in them.

use crate::bus::{Parameter, Serial};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::message::{answer, Answer, AsyncMessageClient, Message, MessageClient, Station, WriteError, Writer};
use crate::value_error::LengthError;

/// Sends a request to one device and waits for its reply, for protocols of messages.
///
/// Requests and replies are the data of a message, without what frames them on the line. The feature `serial` has one over
/// any stream of bytes; here is one for a test:
///
/// ```
/// use lexibus::{Error, Exchange, LengthError};
///
/// /// A device that sends back what it gets, behind a status.
/// struct Echo;
///
/// impl Exchange for Echo {
///     type Error = core::convert::Infallible;
///
///     fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>> {
///         let length = 1 + request.len();
///         let error = LengthError::new(reply.len(), length);
///         let reply = reply.get_mut(..length).ok_or(error)?;
///         reply[0] = 0x0A;
///         reply[1..].copy_from_slice(request);
///         Ok(length)
///     }
/// }
///
/// let mut reply = [0; 8];
/// assert_eq!(Echo.exchange(&[1, 2], &mut reply)?, 3);
/// assert_eq!(reply[..3], [0x0A, 1, 2]);
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
pub trait Exchange {
    /// What can go wrong on the line.
    type Error;

    /// Sends `request`, puts the reply to the start of `reply` and returns its length.
    ///
    /// # Errors
    ///
    /// [`Error::Client`] where the line fails, or no reply comes; [`Error::Length`] where `request` is too long for the
    /// protocol, or the reply for `reply`.
    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>>;
}

/// Sends a request to one device and takes its reply without blocking. The same rules as for [`Exchange`].
///
/// ```
/// use lexibus::{AsyncExchange, Error};
///
/// /// A device that has nothing to say.
/// struct Silent;
///
/// impl AsyncExchange for Silent {
///     type Error = core::convert::Infallible;
///
///     async fn exchange(&mut self, _: &[u8], _: &mut [u8]) -> Result<usize, Error<Self::Error>> {
///         Ok(0)
///     }
/// }
/// ```
#[allow(async_fn_in_trait)]
pub trait AsyncExchange {
    /// What can go wrong on the line.
    type Error;

    /// Sends `request` and takes the reply, as [`Exchange::exchange`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`Exchange::exchange`].
    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>>;
}

/// The messages of a protocol that read and write numbered parameters.
///
/// Values are as in a [`Client`]: the least significant byte first. A protocol with another order turns them around.
///
/// ```
/// use lexibus::message::WriteError;
/// use lexibus::{Error, LengthError, Parameter, ParameterMessages};
///
/// /// Number and value, with the device's order of bytes; the reply begins with the number, too.
/// struct Messages;
///
/// impl ParameterMessages for Messages {
///     fn read_request(&self, parameter: Parameter, _: usize, request: &mut [u8]) -> Result<usize, WriteError> {
///         self.write_request(parameter, &[], request)
///     }
///
///     fn read_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
///         let own = reply.strip_prefix(&[parameter.0 as u8]).ok_or(Error::UnexpectedReply)?;
///         value.iter_mut().zip(own).for_each(|(to, from)| *to = *from);
///         Ok(own.len())
///     }
///
///     fn write_request(&self, parameter: Parameter, value: &[u8], request: &mut [u8]) -> Result<usize, WriteError> {
///         let error = LengthError::new(1 + value.len(), request.len());
///         let request = request.get_mut(..1 + value.len()).ok_or(error)?;
///         request[0] = parameter.0 as u8;
///         request[1..].copy_from_slice(value);
///         Ok(request.len())
///     }
///
///     fn write_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8]) -> Result<(), Error<E>> {
///         if reply == [parameter.0 as u8] { Ok(()) } else { Err(Error::UnexpectedReply) }
///     }
/// }
///
/// let mut request = [0; 8];
/// assert_eq!(Messages.write_request(Parameter(7), &[1, 2], &mut request), Ok(3));
/// assert_eq!(request[..3], [7, 1, 2]);
/// ```
pub trait ParameterMessages {
    /// Puts the data of the request that reads a parameter of `length` bytes to the start of `request` and returns their
    /// number.
    ///
    /// # Errors
    ///
    /// When the request doesn't fit, or no message reads the parameter.
    fn read_request(&self, parameter: Parameter, length: usize, request: &mut [u8]) -> Result<usize, WriteError>;

    /// Puts the value in the reply to that request to the start of `value` and returns its length.
    ///
    /// # Errors
    ///
    /// [`Error::UnexpectedReply`] where it is a reply to something else, [`Error::Refused`] or [`Error::Abort`] where the device
    /// refuses, [`Error::Length`] where the value has another length.
    fn read_reply<E>(
        &self,
        parameter: Parameter,
        request: &[u8],
        reply: &[u8],
        value: &mut [u8],
    ) -> Result<usize, Error<E>>;

    /// Puts the data of the request that writes a parameter to the start of `request` and returns their number.
    ///
    /// # Errors
    ///
    /// When the request doesn't fit, or no message writes the parameter.
    fn write_request(&self, parameter: Parameter, value: &[u8], request: &mut [u8]) -> Result<usize, WriteError>;

    /// Whether the reply to that request says that it was done.
    ///
    /// # Errors
    ///
    /// As of [`read_reply`](Self::read_reply).
    fn write_reply<E>(&self, parameter: Parameter, request: &[u8], reply: &[u8]) -> Result<(), Error<E>>;
}

/// A device with a protocol of messages, over `X`, which exchanges their data: its parameters as a [`Client`] of [`Serial`] or
/// an [`AsyncClient`], where `M` knows the messages that carry them, and its messages as a [`MessageClient`]. `N` is the length
/// of the longest of them, in bytes.
#[derive(Clone, Debug)]
pub struct Parameters<X, M, const N: usize> {
    exchange: X,
    messages: M,
    request: [u8; N],
    reply: [u8; N],
}

impl<X, M, const N: usize> Parameters<X, M, N> {
    /// The device that `exchange` talks to.
    pub const fn new(exchange: X, messages: M) -> Self {
        Self { exchange, messages, request: [0; N], reply: [0; N] }
    }

    /// What exchanges messages.
    pub fn exchange(&mut self) -> &mut X {
        &mut self.exchange
    }

    /// Gives back what exchanges messages.
    pub fn into_exchange(self) -> X {
        self.exchange
    }
}

/// The part of `buffer` that was filled.
fn filled(buffer: &[u8], length: usize) -> Result<&[u8], LengthError> {
    buffer.get(..length).ok_or(LengthError::new(buffer.len(), length))
}

macro_rules! clients {
    ($Exchange:ident $Client:ident $MessageClient:ident $($async:ident $await:ident)?) => {
        impl<T: $Exchange + ?Sized> $Exchange for &mut T {
            type Error = T::Error;

            $($async)? fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<T::Error>> {
                T::exchange(self, request, reply)$(.$await)?
            }
        }

        impl<X: $Exchange, M: ParameterMessages, const N: usize> $Client for Parameters<X, M, N> {
            type Bus = Serial;
            type Error = X::Error;

            $($async)? fn read(&mut self, parameter: Parameter, buffer: &mut [u8]) -> Result<usize, Error<X::Error>> {
                let length = self.messages.read_request(parameter, buffer.len(), &mut self.request)?;
                let request = filled(&self.request, length)?;
                let length = self.exchange.exchange(request, &mut self.reply)$(.$await)??;
                self.messages.read_reply(parameter, request, filled(&self.reply, length)?, buffer)
            }

            $($async)? fn write(&mut self, parameter: Parameter, data: &[u8]) -> Result<(), Error<X::Error>> {
                let length = self.messages.write_request(parameter, data, &mut self.request)?;
                let request = filled(&self.request, length)?;
                let length = self.exchange.exchange(request, &mut self.reply)$(.$await)??;
                self.messages.write_reply(parameter, request, filled(&self.reply, length)?)
            }
        }

        impl<X: $Exchange, S: Station, const N: usize> $MessageClient for Parameters<X, S, N> {
            type Error = X::Error;

            $($async)? fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, X::Error, M> {
                let mut request = Writer::new(&mut self.request);
                message.write(self.messages.station(), &mut request)?;
                let length = self.exchange.exchange(request.written(), &mut self.reply)$(.$await)??;
                answer::<_, M>(request.written(), filled(&self.reply, length)?)
            }
        }
    };
}

clients! { Exchange Client MessageClient }
clients! { AsyncExchange AsyncClient AsyncMessageClient async await }
