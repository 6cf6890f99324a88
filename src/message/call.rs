//! Sends a message and takes the reply.

use core::error;
use core::fmt;

use super::{Message, Reader, Reply, Selector};
use crate::error::Error;

/// The number of the device that messages are for.
pub trait Station {
    /// The number; 0 in a protocol without numbers of devices.
    fn station(&self) -> u32;
}

/// What sends messages to one device. [`Parameters`](crate::Parameters) is one, over an [`Exchange`](crate::Exchange).
pub trait MessageClient {
    /// What can go wrong on the line.
    type Error;

    /// Sends a message and returns the reply, which stays in the client's buffer.
    ///
    /// # Errors
    ///
    /// [`Failure::Refused`] where the device refuses with a message of its own, [`Failure::Error`] otherwise.
    fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, Self::Error, M>;
}

/// What sends messages to one device without blocking. The same rules as for [`MessageClient`].
#[allow(async_fn_in_trait)]
pub trait AsyncMessageClient {
    /// What can go wrong on the line.
    type Error;

    /// Sends a message and returns the reply, as [`MessageClient::call`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`MessageClient::call`].
    async fn call<M: Message>(&mut self, message: &M) -> Answer<M::Reply<'_>, Self::Error, M>;
}

/// What comes of a message `M`: `T`, or why not. `E` is the client's own error.
pub type Answer<T, E, M> = Result<T, Failure<E, <M as Message>::Refusal>>;

/// Why a message has no reply. `E` is the client's own error, `R` what the device says where it refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure<E, R> {
    /// The device refused.
    Refused(R),
    /// Something else went wrong.
    Error(Error<E>),
}

impl<E, R, F: Into<Error<E>>> From<F> for Failure<E, R> {
    fn from(error: F) -> Self {
        Self::Error(error.into())
    }
}

impl<E, R> Failure<E, R> {
    /// The same without what the device said.
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

/// The reply to `request`, or the device's refusal.
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

/// A message that is ready to be sent through a client. The methods that end in `_async` don't block.
#[derive(Debug)]
#[must_use = "nothing is sent before `send` or `send_async`"]
pub struct Call<'c, C, M> {
    client: &'c mut C,
    /// What is sent.
    pub message: M,
}

impl<'c, C, M: Message> Call<'c, C, M> {
    /// `message` through `client`.
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
            /// [`Failure::Refused`] where the device refuses, [`Failure::Error`] where a field is outside its limits, the line
            /// fails, or the reply is another one.
            pub $($async)? fn $send(self) -> Answer<M::Reply<'c>, C::Error, M> {
                self.client.call(&self.message)$(.$await)?
            }

            /// Sends the message, and gives the device that has the messages whose meaning it decides. As long as that is in
            /// use, no other message of the kind can be sent.
            ///
            /// # Errors
            ///
            /// The same as of [`send`](Self::send).
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
