//! Messages over a byte stream of `embedded-io`, blocking or async.
//!
//! ```
//! use embedded_io::{Read, Write};
//! use lexibus::clients::serial::{SerialError, SerialLine};
//! use lexibus::framing::{Check, Delimited};
//! use lexibus::{Error, Exchange};
//!
//! const FRAMING: Delimited = Delimited::new(Some(0x02), 0x03)
//!     .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
//!     .with_check(Check::Xor(0xFF))
//!     .with_max_data(68);
//!
//! /// Requests the state of node 5 over any serial interface of a microcontroller or a computer.
//! fn state<S: Read + Write>(port: S) -> Result<u8, Error<SerialError<S::Error>>> {
//!     let mut line: SerialLine<_, _, 140> = SerialLine::new(port, FRAMING);
//!     let mut reply = [0; 68];
//!     let length = line.exchange(&[0x05, 0x08, 0xA8, 0x00, 0x00, 0x00], &mut reply)?;
//!     match reply[..length] {
//!         [0x05, _, 0xA8, _, _, state] => Ok(state),
//!         _ => Err(Error::UnexpectedReply),
//!     }
//! }
//! ```
//!
//! The crate `embedded-io-adapters` converts streams of `std` to streams of `embedded-io`. The stream determines the
//! timeout for a reply, and its timeout error becomes the error of the exchange.

use core::error;
use core::fmt;

use crate::error::Error;
use crate::exchange::{AsyncExchange, Exchange};
use crate::framing::{FrameError, Framing};

pub use embedded_io;
pub use embedded_io_async;

/// Client for a device on a stream `S` with the framing `F`. `N` is the maximum length of a frame to send, in bytes. If
/// the framing has escapes, this is twice the length of data and check, plus start and end.
///
/// It is an [`Exchange`] if the stream implements the traits of `embedded_io`, and an [`AsyncExchange`] if it
/// implements those of `embedded_io_async`. It reads single bytes, and none after the end of a reply. Use a buffered
/// stream if this is too slow.
///
/// Bytes before a reply are ignored. An invalid reply ends the exchange with an error, unless another frame starts
/// within it. That frame is then the reply. Only the protocol can check whether a reply belongs to its request.
pub struct SerialLine<S, F: Framing, const N: usize> {
    stream: S,
    framing: F,
    /// Decoder state after an invalid reply whose end wasn't received.
    within: Option<F::Decoder>,
}

impl<S: Clone, F: Framing + Clone, const N: usize> Clone for SerialLine<S, F, N>
where
    F::Decoder: Clone,
{
    fn clone(&self) -> Self {
        Self { stream: self.stream.clone(), framing: self.framing.clone(), within: self.within.clone() }
    }
}

impl<S: fmt::Debug, F: Framing + fmt::Debug, const N: usize> fmt::Debug for SerialLine<S, F, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SerialLine")
            .field("stream", &self.stream)
            .field("framing", &self.framing)
            .finish_non_exhaustive()
    }
}

impl<S, F: Framing, const N: usize> SerialLine<S, F, N> {
    /// Creates a client for the device at the other end of `stream`.
    pub const fn new(stream: S, framing: F) -> Self {
        Self { stream, framing, within: None }
    }

    /// Returns the stream, for example to discard late bytes.
    pub fn stream(&mut self) -> &mut S {
        &mut self.stream
    }

    /// Returns the stream and drops the client.
    pub fn into_stream(self) -> S {
        self.stream
    }

    /// Returns the decoder for the next bytes. It also detects the rest of a reply that was cut off, which isn't a
    /// reply.
    fn decoder(&mut self) -> F::Decoder {
        self.within.take().unwrap_or_else(|| self.framing.decoder())
    }

    /// Stores the decoder if the reply became invalid before its end, because its remaining bytes still arrive. Returns
    /// `error`.
    fn failed<E>(&mut self, decoder: F::Decoder, error: Error<SerialError<E>>) -> Error<SerialError<E>> {
        if matches!(error, Error::Client(SerialError::Frame(FrameError::TooLong | FrameError::Escape))) {
            self.within = Some(decoder);
        }
        error
    }

    /// Decodes one byte of the reply.
    fn take<E>(
        &self,
        decoder: &mut F::Decoder,
        byte: u8,
        reply: &mut [u8],
    ) -> Result<Option<usize>, Error<SerialError<E>>> {
        match self.framing.decode(decoder, byte, reply) {
            Err(FrameError::Interrupted) => Ok(None),
            decoded => decoded.map_err(|error| Error::Client(SerialError::Frame(error))),
        }
    }
}

/// Error of an exchange on a serial line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SerialError<E> {
    /// The stream failed, or its timeout expired.
    Stream(E),
    /// The stream was closed.
    Closed,
    /// The reply is invalid.
    Frame(FrameError),
}

impl<E: fmt::Display> fmt::Display for SerialError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stream(error) => error.fmt(f),
            Self::Closed => f.write_str("the serial line was closed"),
            Self::Frame(error) => error.fmt(f),
        }
    }
}

impl<E: error::Error> error::Error for SerialError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Stream(error) => error.source(),
            _ => None,
        }
    }
}

const fn failed<E>(error: E) -> Error<SerialError<E>> {
    Error::Client(SerialError::Stream(error))
}

/// Returns the byte that was read, or an error at the end of the stream.
fn one<E>(byte: [u8; 1], count: usize) -> Result<u8, Error<SerialError<E>>> {
    match count {
        0 => Err(Error::Client(SerialError::Closed)),
        _ => Ok(byte[0]),
    }
}

macro_rules! exchanges {
    ($Exchange:ident $io:ident $($async:ident $await:ident)?) => {
        impl<S, F, const N: usize> $Exchange for SerialLine<S, F, N>
        where
            S: $io::Read + $io::Write,
            F: Framing,
        {
            type Error = SerialError<S::Error>;

            $($async)? fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>> {
                let mut frame = [0; N];
                let length = self.framing.encode(request, &mut frame)?;
                let sent = self.stream.write_all(frame.get(..length).unwrap_or_default())$(.$await)?;
                sent.map_err(failed)?;
                self.stream.flush()$(.$await)?.map_err(failed)?;
                let mut decoder = self.decoder();
                loop {
                    let mut byte = [0];
                    let count = self.stream.read(&mut byte)$(.$await)?.map_err(failed)?;
                    match self.take(&mut decoder, one(byte, count)?, reply) {
                        Ok(None) => {}
                        Ok(Some(length)) => return Ok(length),
                        Err(error) => return Err(self.failed(decoder, error)),
                    }
                }
            }
        }
    };
}

exchanges! { Exchange embedded_io }
exchanges! { AsyncExchange embedded_io_async async await }
