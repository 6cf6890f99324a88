//! Request-reply protocols that exchange messages or access numbered parameters.

use crate::bus::{Parameter, Serial};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::message::{
    answer, Answer, AsyncMessageClient, Failure, Message, MessageClient, Station, WriteError, Writer,
};
use crate::value_error::LengthError;

/// Sends a request to one device and blocks until the reply arrives. Clients of request-reply protocols use this trait.
///
/// Requests and replies contain the data of a message, without framing. The feature `serial` provides an implementation
/// for byte streams of `embedded-io`. This example implements the trait for a test:
///
/// ```
/// use lexibus::{Error, Exchange, LengthError};
///
/// /// A device whose reply is a status byte and a copy of the request.
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
    /// Error type of the transport.
    type Error;

    /// Sends `request`, writes the reply to the start of `reply` and returns the length of the reply.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Client`] if the transport fails, or [`Error::Timeout`] if no reply arrives in time. Returns
    /// [`Error::Length`] if `request` is too long for the protocol or the reply is longer than `reply`.
    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Notifies the transport that the last reply doesn't belong to the last request. The correct reply may still
    /// arrive, and the next exchange should discard it. The default implementation does nothing.
    fn unsettle(&mut self) {}
}

/// Sends a request to one device and receives the reply without blocking, under the same rules as [`Exchange`].
///
/// ```
/// use lexibus::{AsyncExchange, Error};
///
/// /// A device whose replies are empty.
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
    /// Error type of the transport.
    type Error;

    /// Sends `request` and receives the reply, as [`Exchange::exchange`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Exchange::exchange`].
    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Notifies the transport that the last reply doesn't belong to the last request, as [`Exchange::unsettle`] does.
    fn unsettle(&mut self) {}
}

/// Encodes and decodes the messages of a protocol that reads and writes numbered parameters.
///
/// The least significant byte of a value comes first, as in a [`Client`]. If the protocol uses another byte order, the
/// implementation converts the values.
///
/// ```
/// use lexibus::message::WriteError;
/// use lexibus::{Error, LengthError, Parameter, ParameterMessages};
///
/// /// Messages contain the parameter number and the value, both big-endian. The reply repeats the parameter number.
/// struct Messages;
///
/// impl ParameterMessages for Messages {
///     fn read_request(&self, parameter: Parameter, _: usize, request: &mut [u8]) -> Result<usize, WriteError> {
///         self.write_request(parameter, &[], request)
///     }
///
///     fn read_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
///         let bytes = reply.strip_prefix(&[parameter.0 as u8]).ok_or(Error::UnexpectedReply)?;
///         value.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
///         Ok(bytes.len())
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
    /// Encodes the read request for a parameter of `length` bytes at the start of `request`. Returns the length of the
    /// request.
    ///
    /// # Errors
    ///
    /// Returns an error if the request doesn't fit into `request`, or if the protocol has no message that reads the
    /// parameter.
    fn read_request(&self, parameter: Parameter, length: usize, request: &mut [u8]) -> Result<usize, WriteError>;

    /// Copies the value from the reply to the start of `value` and returns the length of the value.
    ///
    /// # Errors
    ///
    /// - [`Error::UnexpectedReply`] if the reply belongs to another request.
    /// - [`Error::Refused`] or [`Error::Abort`] if the device refuses the request.
    /// - [`Error::Length`] if the length of the received value differs from the length of `value`.
    fn read_reply<E>(
        &self,
        parameter: Parameter,
        request: &[u8],
        reply: &[u8],
        value: &mut [u8],
    ) -> Result<usize, Error<E>>;

    /// Encodes the write request for a parameter at the start of `request`. Returns the length of the request.
    ///
    /// # Errors
    ///
    /// Returns an error if the request doesn't fit into `request`, or if the protocol has no message that writes the
    /// parameter.
    fn write_request(&self, parameter: Parameter, value: &[u8], request: &mut [u8]) -> Result<usize, WriteError>;

    /// Checks that the reply confirms the write request.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read_reply`](Self::read_reply).
    fn write_reply<E>(&self, parameter: Parameter, request: &[u8], reply: &[u8]) -> Result<(), Error<E>>;
}

/// Client for a device with a request-reply protocol. The client sends the messages of the protocol `M` through the
/// exchange `X`. `N` is the maximum length of a message in bytes.
///
/// The client implements [`Client`] or [`AsyncClient`] for the bus [`Serial`] if `M` implements [`ParameterMessages`].
/// The client implements [`MessageClient`] or [`AsyncMessageClient`] if `M` implements [`Station`]. The asynchronous
/// traits need an [`AsyncExchange`].
#[derive(Clone, Debug)]
pub struct Parameters<X, M, const N: usize> {
    exchange: X,
    messages: M,
    request: [u8; N],
    reply: [u8; N],
}

impl<X, M, const N: usize> Parameters<X, M, N> {
    /// Creates a client for the protocol `messages`. The client sends the messages through `exchange`.
    pub const fn new(exchange: X, messages: M) -> Self {
        Self { exchange, messages, request: [0; N], reply: [0; N] }
    }

    /// Returns the exchange.
    pub fn exchange(&mut self) -> &mut X {
        &mut self.exchange
    }

    /// Returns the exchange and drops the client.
    pub fn into_exchange(self) -> X {
        self.exchange
    }
}

/// Returns the first `length` bytes of `buffer`, or an error if `length` exceeds the length of the buffer.
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

            fn unsettle(&mut self) {
                T::unsettle(self);
            }
        }

        impl<X: $Exchange, M: ParameterMessages, const N: usize> $Client for Parameters<X, M, N> {
            type Bus = Serial;
            type Error = X::Error;

            $($async)? fn read(&mut self, parameter: Parameter, buffer: &mut [u8]) -> Result<usize, Error<X::Error>> {
                let length = self.messages.read_request(parameter, buffer.len(), &mut self.request)?;
                let request = filled(&self.request, length)?;
                let length = self.exchange.exchange(request, &mut self.reply)$(.$await)??;
                let read = self.messages.read_reply(parameter, request, filled(&self.reply, length)?, buffer);
                if matches!(read, Err(Error::UnexpectedReply | Error::Length(_))) {
                    self.exchange.unsettle();
                }
                read
            }

            $($async)? fn write(&mut self, parameter: Parameter, data: &[u8]) -> Result<(), Error<X::Error>> {
                let length = self.messages.write_request(parameter, data, &mut self.request)?;
                let request = filled(&self.request, length)?;
                let length = self.exchange.exchange(request, &mut self.reply)$(.$await)??;
                let written = self.messages.write_reply(parameter, request, filled(&self.reply, length)?);
                if matches!(written, Err(Error::UnexpectedReply | Error::Length(_))) {
                    self.exchange.unsettle();
                }
                written
            }
        }

        impl<X: $Exchange, S: Station, const N: usize> $MessageClient for Parameters<X, S, N> {
            type Error = X::Error;

            $($async)? fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, X::Error, M> {
                let mut request = Writer::new(&mut self.request);
                message.write(self.messages.station(), &mut request)?;
                let length = self.exchange.exchange(request.written(), &mut self.reply)$(.$await)??;
                let answer = answer::<_, M>(request.written(), filled(&self.reply, length)?);
                if matches!(answer, Err(Failure::Error(Error::UnexpectedReply | Error::Length(_)))) {
                    self.exchange.unsettle();
                }
                answer
            }
        }
    };
}

clients! { Exchange Client MessageClient }
clients! { AsyncExchange AsyncClient AsyncMessageClient async await }
