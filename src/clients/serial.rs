//! Messages over a byte stream of `embedded-io`, blocking or async.
//!
//! ```
//! use embedded_io::{Read, ReadReady, Write};
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
//! fn state<S: Read + Write + ReadReady>(port: S) -> Result<u8, Error<SerialError<S::Error>>> {
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
//! The crate `embedded-io-adapters` converts streams of `std` to streams of `embedded-io`.
//!
//! # Timeouts
//!
//! The timeout of a blocking line, by default [`TIMEOUT`], limits the wait for each reply, whether the line is silent or
//! noise arrives continuously. For this, the line needs a clock, and must know whether a read returns at once (see below).
//! It then reads only bytes that have arrived. With the feature `std`, the line uses the clock of the standard library, and
//! sleeps between two polls of the stream. Without `std`, set a clock with [`SerialLine::with_time`].
//!
//! If the line has no clock, or does not know whether a read returns at once, a read can block. If no byte arrives, only the
//! stream can end the read, for example with a timeout. The exchange then returns the error of the stream. Without a clock,
//! only the [number of received bytes](SerialLine) limits an exchange in which noise arrives continuously.
//!
//! Async streams have no timeout, so an async line needs a timer. An async exchange on a line without a timer doesn't
//! compile. Set the timeout of a line as follows:
//!
//! ```
//! use core::time::Duration;
//! use lexibus::clients::serial::SerialLine;
//! use lexibus::framing::Delimited;
//!
//! # let (port, other) = ((), ());
//! const LINES: Delimited = Delimited::new(None, b'\r');
//! // A blocking line; `|| timer.elapsed()` without the feature `std`.
//! let line = SerialLine::<_, _, 140>::with_ready(port, LINES, None).with_timeout(Duration::from_secs(2));
//! // An async line; `embassy_time::Timer::after` on a microcontroller.
//! let line = SerialLine::<_, _, 140>::with_ready(other, LINES, None).with_time(tokio::time::sleep, Duration::from_secs(1));
//! ```
//!
//! # Late replies
//!
//! A frame does not identify the request to which it replies. Bytes that arrived before a request cannot belong to its
//! reply: they are late or repeated replies, noise, or messages that the device sends without a request. Each exchange
//! first discards all bytes that the stream has already received. It does not wait for further bytes. For this step,
//! the line must know whether a read returns at once: from `embedded_io::ReadReady`, or from the function that you pass
//! to [`SerialLine::with_ready`]. A line without this information cannot discard bytes before a request unless the last
//! exchange failed.
//!
//! After a timeout, an invalid reply or a dropped exchange, the late reply can still be on its way. The next exchange
//! therefore waits before its request until a frame arrives, a read of the stream times out, or the timeout of the line
//! expires, and discards what it receives. A blocking line needs a clock and the information above, or a stream whose
//! reads have timed out before. Without these, the exchange does not wait.

use core::error;
use core::fmt;
use core::time::Duration;

use crate::clock::{Clock, DefaultClock, Timer};
use crate::error::Error;
use crate::exchange::{AsyncExchange, Exchange};
use crate::framing::{FrameError, Framing};

pub use embedded_io;
pub use embedded_io_async;

/// Default timeout of an exchange.
pub const TIMEOUT: Duration = Duration::from_secs(1);

/// Maximum number of bytes of an exchange that aren't part of the reply.
const MOST_NOISE: usize = 4096;

/// Client for a device on a stream `S` with the framing `F`. `N` is the maximum length of a frame to send, in bytes. If
/// the framing has escapes, `N` must be twice the length of data and checksum, plus start and end byte.
///
/// The client is an [`Exchange`] if the stream implements the traits of `embedded_io`, and an [`AsyncExchange`] if the
/// stream implements those of `embedded_io_async`. The client reads single bytes, and no bytes after the end of a
/// reply. Use a buffered stream if single reads are too slow.
///
/// Bytes before a reply are ignored. An invalid reply ends the exchange with an error, unless another frame starts
/// within the invalid reply. If another frame starts, the client decodes this frame as the reply. Only the protocol can
/// check whether a reply belongs to its request. The exchange ends with [`Error::Timeout`] if the reply isn't complete
/// after 4096 bytes plus twice the length of the reply buffer.
///
/// `T` is the [`Clock`] of a blocking line or the [`Timer`] of an async line.
pub struct SerialLine<S, F: Framing, const N: usize, T = DefaultClock> {
    line: Line<S, F, N>,
    time: T,
    timeout: Duration,
    /// True if the reply to the last request may still arrive.
    is_unsettled: bool,
    /// True if an exchange has failed with a timeout of the stream: reads of this stream don't block forever.
    times_out: bool,
}

/// A stream with a framing.
struct Line<S, F: Framing, const N: usize> {
    stream: S,
    framing: F,
    /// Function that returns whether a read would return without blocking.
    ready: Option<fn(&mut S) -> bool>,
    /// Decoder state after an invalid reply whose end wasn't received.
    within: Option<F::Decoder>,
}

impl<S: Clone, F: Framing + Clone, const N: usize, T: Clone> Clone for SerialLine<S, F, N, T>
where
    F::Decoder: Clone,
{
    fn clone(&self) -> Self {
        let Line { stream, framing, ready, within } = &self.line;
        let line = Line { stream: stream.clone(), framing: framing.clone(), ready: *ready, within: within.clone() };
        Self { line, time: self.time.clone(), ..*self }
    }
}

impl<S: fmt::Debug, F: Framing + fmt::Debug, const N: usize, T> fmt::Debug for SerialLine<S, F, N, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SerialLine")
            .field("stream", &self.line.stream)
            .field("framing", &self.line.framing)
            .finish_non_exhaustive()
    }
}

impl<S, F: Framing, const N: usize> SerialLine<S, F, N> {
    /// Creates a client for the device that `stream` is connected to. The client discards waiting bytes before each
    /// request.
    pub const fn new(stream: S, framing: F) -> Self
    where
        S: embedded_io::ReadReady,
    {
        Self::with_ready(stream, framing, Some(|stream| stream.read_ready().unwrap_or(true)))
    }

    /// Creates a client for a stream that doesn't implement `embedded_io::ReadReady`. `ready` returns whether a read of the
    /// stream returns at once. For a port of the crate `serialport` in a `FromStd` adapter, `ready` is `|port|
    /// port.inner().bytes_to_read().map_or(true, |count| count > 0)`. `ready` must return true if its query fails, so that
    /// the exchange reads the stream and returns the error of this read.
    ///
    /// Pass `None` only if the stream has no such information. Then a repeated reply, or a message that the device
    /// sends without a request, is taken for the reply to the next request, unless the protocol detects it. The stream
    /// of a blocking line then also needs a timeout for each read, because the timeout of the line cannot end a read.
    pub const fn with_ready(stream: S, framing: F, ready: Option<fn(&mut S) -> bool>) -> Self {
        let line = Line { stream, framing, ready, within: None };
        Self { line, time: DefaultClock, timeout: TIMEOUT, is_unsettled: false, times_out: false }
    }

    /// Returns the line with another timeout for each exchange, measured with the [`DefaultClock`]. Without the feature
    /// `std`, and for async lines, use [`with_time`](Self::with_time).
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        self.with_time(DefaultClock, timeout)
    }

    /// Returns the line with a timeout for each exchange. `time` is the [`Clock`] of a blocking line or the [`Timer`]
    /// of an async line.
    #[must_use]
    pub fn with_time<T>(self, time: T, timeout: Duration) -> SerialLine<S, F, N, T> {
        let Self { line, is_unsettled, times_out, .. } = self;
        SerialLine { line, time, timeout, is_unsettled, times_out }
    }
}

impl<S, F: Framing, const N: usize, T> SerialLine<S, F, N, T> {
    /// Returns the stream.
    pub fn stream(&mut self) -> &mut S {
        &mut self.line.stream
    }

    /// Returns the stream and drops the client.
    pub fn into_stream(self) -> S {
        self.line.stream
    }
}

impl<S, F: Framing, const N: usize> Line<S, F, N> {
    /// Returns the decoder for the next bytes. After an invalid reply whose end wasn't received, the decoder doesn't
    /// mistake the rest of this reply for a new one.
    fn decoder(&mut self) -> F::Decoder {
        self.within.take().unwrap_or_else(|| self.framing.decoder())
    }

    /// Stores the decoder if the reply became invalid before its end, because the remaining bytes of the reply still
    /// arrive. Returns `error`.
    fn failed<E>(&mut self, decoder: F::Decoder, error: Error<SerialError<E>>) -> Error<SerialError<E>> {
        if matches!(error, Error::Client(SerialError::Frame(FrameError::TooLong | FrameError::Escape))) {
            self.within = Some(decoder);
        }
        error
    }

    /// Returns whether a read returns at once.
    fn is_ready(&mut self) -> bool {
        self.ready.is_some_and(|ready| ready(&mut self.stream))
    }

    /// Waits until a read returns at once. Returns false if the limit expires first. Returns true without waiting if there
    /// is no limit, or if the line doesn't know whether a read returns at once.
    fn await_byte(&mut self, limit: &mut impl Limit) -> bool {
        while limit.is_set() && self.ready.is_some() && !self.is_ready() {
            if limit.is_over() {
                return false;
            }
            limit.pause();
        }
        true
    }

    /// Decodes a byte that arrived before the request. The byte can be the end of an invalid reply.
    fn skip(&mut self, byte: u8, data: &mut [u8]) {
        if let Some(within) = &mut self.within {
            if matches!(self.framing.decode(within, byte, data), Ok(Some(_))) {
                self.within = None;
            }
        }
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

/// Returns whether the error is a timeout of the stream.
fn is_timeout<E: embedded_io::Error>(error: &Error<SerialError<E>>) -> bool {
    matches!(error, Error::Client(SerialError::Stream(error)) if error.kind() == embedded_io::ErrorKind::TimedOut)
}

/// Limit of the time that a line waits for bytes.
trait Limit {
    /// Returns whether there is a limit.
    fn is_set(&self) -> bool;

    /// Returns whether the limit has expired.
    fn is_over(&mut self) -> bool;

    /// Waits for a moment between two polls of the stream.
    fn pause(&mut self);
}

/// Time limit of a blocking line. Without a clock, there is no limit.
struct Deadline<'t, T> {
    time: &'t mut T,
    end: Option<Duration>,
}

impl<'t, T: Clock> Deadline<'t, T> {
    /// Creates a limit that expires after `timeout`.
    fn after(time: &'t mut T, timeout: Duration) -> Self {
        let end = time.now().map(|now| now.saturating_add(timeout));
        Self { time, end }
    }
}

impl<T: Clock> Limit for Deadline<'_, T> {
    fn is_set(&self) -> bool {
        self.end.is_some()
    }

    fn is_over(&mut self) -> bool {
        self.end.zip(self.time.now()).is_some_and(|(end, now)| now >= end)
    }

    fn pause(&mut self) {
        self.time.pause();
    }
}

/// No time limit. The timer of an async line ends a wait that takes too long.
struct ByTimer;

impl Limit for ByTimer {
    fn is_set(&self) -> bool {
        false
    }

    fn is_over(&mut self) -> bool {
        false
    }

    fn pause(&mut self) {}
}

/// Defines the steps of an exchange, blocking and async.
macro_rules! exchanges {
    ($io:ident $call:ident $receive:ident $discard:ident $($async:ident $await:ident)?) => {
        impl<S: $io::Read + $io::Write, F: Framing, const N: usize> Line<S, F, N> {
            /// Discards waiting bytes, sends a frame, and reads until the reply is complete or invalid, too many bytes
            /// have arrived, or the limit expires.
            $($async)? fn $call(
                &mut self,
                frame: &[u8],
                reply: &mut [u8],
                mut limit: impl Limit,
            ) -> Result<usize, Error<SerialError<S::Error>>> {
                for _ in 0..MOST_NOISE {
                    if !self.is_ready() {
                        break;
                    }
                    let byte = self.$receive()$(.$await)??;
                    self.skip(byte, reply);
                }
                self.stream.write_all(frame)$(.$await)?.map_err(failed)?;
                self.stream.flush()$(.$await)?.map_err(failed)?;
                let mut decoder = self.decoder();
                for _ in 0..MOST_NOISE.saturating_add(reply.len().saturating_mul(2)) {
                    if !self.await_byte(&mut limit) {
                        break;
                    }
                    let byte = self.$receive()$(.$await)??;
                    match self.take(&mut decoder, byte, reply) {
                        Ok(None) if limit.is_over() => break,
                        Ok(None) => {}
                        Ok(Some(length)) => return Ok(length),
                        Err(error) => return Err(self.failed(decoder, error)),
                    }
                }
                Err(Error::Timeout)
            }

            /// Discards bytes up to the end of a frame, or until the limit expires, but at most [`MOST_NOISE`] bytes.
            $($async)? fn $discard(&mut self, mut limit: impl Limit) -> Result<(), Error<SerialError<S::Error>>> {
                let (mut decoder, mut data) = (self.decoder(), [0; N]);
                for _ in 0..MOST_NOISE {
                    if !self.await_byte(&mut limit) {
                        break;
                    }
                    let byte = self.$receive()$(.$await)??;
                    let decoded = self.framing.decode(&mut decoder, byte, &mut data);
                    if matches!(decoded, Ok(Some(_))) || limit.is_over() {
                        break;
                    }
                }
                Ok(())
            }

            $($async)? fn $receive(&mut self) -> Result<u8, Error<SerialError<S::Error>>> {
                let mut byte = [0];
                let count = self.stream.read(&mut byte)$(.$await)?.map_err(failed)?;
                one(byte, count)
            }
        }
    };
}

exchanges! { embedded_io call receive discard }
exchanges! { embedded_io_async call_async receive_async discard_async async await }

impl<S, F, const N: usize, T> Exchange for SerialLine<S, F, N, T>
where
    S: embedded_io::Read + embedded_io::Write,
    F: Framing,
    T: Clock,
{
    type Error = SerialError<S::Error>;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>> {
        let mut frame = [0; N];
        let length = self.line.framing.encode(request, &mut frame)?;
        // Without one of these, the line can't wait for a limited time.
        let waits = self.times_out || (self.line.ready.is_some() && self.time.now().is_some());
        if self.is_unsettled && waits {
            match self.line.discard(Deadline::after(&mut self.time, self.timeout)) {
                Err(error) if !is_timeout(&error) => return Err(error),
                _ => {}
            }
        }
        let frame = frame.get(..length).unwrap_or_default();
        let received = self.line.call(frame, reply, Deadline::after(&mut self.time, self.timeout));
        self.times_out |= received.as_ref().is_err_and(is_timeout);
        self.is_unsettled = received.is_err();
        received
    }

    fn unsettle(&mut self) {
        self.is_unsettled = true;
    }
}

impl<S, F, const N: usize, T> AsyncExchange for SerialLine<S, F, N, T>
where
    S: embedded_io_async::Read + embedded_io_async::Write,
    F: Framing,
    T: Timer,
{
    type Error = SerialError<S::Error>;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Self::Error>> {
        const { assert!(T::EXPIRES, "an async serial line needs a timer: call `SerialLine::with_time`") };
        let mut frame = [0; N];
        let length = self.line.framing.encode(request, &mut frame)?;
        let frame = frame.get(..length).unwrap_or_default();
        if self.is_unsettled {
            self.time.limit(self.timeout, self.line.discard_async(ByTimer)).await.unwrap_or(Ok(()))?;
        }
        // The line stays unsettled if the exchange is dropped.
        self.is_unsettled = true;
        let call = self.line.call_async(frame, reply, ByTimer);
        let received = self.time.limit(self.timeout, call).await.unwrap_or(Err(Error::Timeout));
        self.is_unsettled = received.is_err();
        received
    }

    fn unsettle(&mut self) {
        self.is_unsettled = true;
    }
}
