//! Calls: send a message and receive the reply.

use core::error;
use core::fmt;

use super::{Message, Reader, Reply, Selector};
use crate::error::Error;

/// The protocol of one device, with the device's station address.
pub trait Station {
    /// Returns the station address; 0 for protocols without station addresses.
    fn station(&self) -> u32;
}

/// A client that sends messages to one device, such as [`Parameters`](crate::Parameters) over an
/// [`Exchange`](crate::Exchange).
pub trait MessageClient {
    /// Error type of the client.
    type Error;

    /// Sends a message and returns the reply, which borrows the client's buffer.
    ///
    /// # Errors
    ///
    /// Returns [`Failure::Refused`] if the device replies with a refusal, or [`Failure::Error`] for any other failure.
    fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, Self::Error, M>;
}

/// An asynchronous client that sends messages to one device. See [`MessageClient`].
#[allow(async_fn_in_trait)]
pub trait AsyncMessageClient {
    /// Error type of the client.
    type Error;

    /// Sends a message and returns the reply, as [`MessageClient::call`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`MessageClient::call`].
    async fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, Self::Error, M>;
}

/// The result of sending the message `M`: a reply `T` or a [`Failure`]. `E` is the error type of the client.
pub type Answer<T, E, M> = Result<T, Failure<E, <M as Message>::Refusal>>;

/// Reasons why a request failed. `E` is the error type of the client. `R` is the type of the device's refusal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure<E, R> {
    /// The device refused the request.
    Refused(R),
    /// The call failed for any other reason.
    Error(Error<E>),
}

impl<E, R, F: Into<Error<E>>> From<F> for Failure<E, R> {
    fn from(error: F) -> Self {
        Self::Error(error.into())
    }
}

impl<E, R> Failure<E, R> {
    /// Converts the failure into an [`Error`], without the content of the refusal.
    pub fn into_error(self) -> Error<E> {
        match self {
            Self::Refused(_) => Error::Refused,
            Self::Error(error) => error,
        }
    }
}

impl<E: fmt::Display, R> fmt::Display for Failure<E, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(_) => f.write_str("the device refused"),
            Self::Error(error) => error.fmt(f),
        }
    }
}

impl<E: error::Error, R: fmt::Debug> error::Error for Failure<E, R> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Refused(_) => None,
            Self::Error(error) => error.source(),
        }
    }
}

/// Parses `reply` as a reply to `request` or as a refusal.
pub(crate) fn answer<'r, E, M: Message>(request: &[u8], reply: &'r [u8]) -> Answer<M::Reply<'r>, E, M> {
    let refusal = || M::Refusal::read(request, &mut Reader::new(reply));
    if !<M::Reply<'r> as Reply<'r>>::IS_ANYTHING {
        if let Some(reply) = M::Reply::read(request, &mut Reader::new(reply)) {
            return Ok(reply);
        }
    }
    match refusal() {
        Some(refusal) => Err(Failure::Refused(refusal)),
        None => M::Reply::read(request, &mut Reader::new(reply)).ok_or(Failure::Error(Error::UnexpectedReply)),
    }
}

/// A message and the client that sends the message.
#[derive(Debug)]
#[must_use = "nothing is sent before `send` or `send_async`"]
pub struct Call<'c, C, M> {
    client: &'c mut C,
    /// The message to send.
    pub message: M,
}

impl<'c, C, M: Message> Call<'c, C, M> {
    /// Creates a call that sends `message` through `client`.
    pub fn new(client: &'c mut C, message: M) -> Self {
        Self { client, message }
    }
}

macro_rules! calls {
    ($MessageClient:ident $send:ident $select:ident $($async:ident $await:ident)?) => {
        impl<T: $MessageClient + ?Sized> $MessageClient for &mut T {
            type Error = T::Error;

            $($async)? fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, T::Error, M> {
                T::call(self, message)$(.$await)?
            }
        }

        impl<'c, C: $MessageClient, M: Message> Call<'c, C, M> {
            /// Sends the message and waits for the reply.
            ///
            /// # Errors
            ///
            /// - [`Failure::Refused`] if the device refuses the request.
            /// - [`Failure::Error`] for any other failure, for example if a field is out of range, if the communication
            ///   fails, or if the reply belongs to another request.
            pub $($async)? fn $send(self) -> Answer<M::Reply<'c>, C::Error, M> {
                self.client.call(&self.message)$(.$await)?
            }

            /// Sends this selector and returns a device with the methods for the requests that depend on the selector.
            /// The returned device borrows the client, so the program cannot send another selector while it uses this
            /// device.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send).
            pub $($async)? fn $select(self) -> Answer<M::Device<&'c mut C>, C::Error, M>
            where
                M: Selector,
            {
                match self.client.call(&self.message)$(.$await)? {
                    Ok(_) => {}
                    Err(failure) => return Err(failure),
                }
                Ok(M::device(self.client))
            }
        }
    };
}

calls! { MessageClient send select }
calls! { AsyncMessageClient send_async select_async async await }
