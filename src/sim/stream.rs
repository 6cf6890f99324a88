//! A byte stream with faults.

use core::fmt;
use core::time::Duration;
use std::io;
use std::vec::Vec;

use super::faults::Faults;

/// A fault of a message on a byte stream. [`FaultyStream`] injects the fault.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StreamFault {
    /// The message is sent after this delay.
    Late(Duration),
    /// The message is not sent.
    Lost,
    /// The message is sent twice.
    Duplicated,
    /// Only the first half of the message is sent.
    Truncated,
    /// Instead of the message, other bytes are sent `count` times.
    Foreign {
        /// The bytes that are sent.
        bytes: Vec<u8>,
        /// Number of times that the bytes are sent.
        count: u32,
        /// Pause before each transmission of the bytes.
        period: Duration,
    },
    /// These bytes are sent before the message.
    Noise(Vec<u8>),
}

impl StreamFault {
    /// Returns the parts of a message with this fault, with the pause before each part.
    fn parts(self, message: &[u8]) -> Vec<(Duration, Vec<u8>)> {
        let at_once = |bytes| Vec::from([(Duration::ZERO, bytes)]);
        match self {
            Self::Late(delay) => Vec::from([(delay, message.to_vec())]),
            Self::Lost => Vec::new(),
            Self::Duplicated => at_once([message, message].concat()),
            Self::Truncated => at_once(message.iter().copied().take(message.len() / 2).collect()),
            Self::Foreign { bytes, count, period } => (0..count).map(|_| (period, bytes.clone())).collect(),
            Self::Noise(noise) => at_once([&noise, message].concat()),
        }
    }
}

/// The device's end of a byte stream, with injected faults, for tests of Modbus clients and of clients of serial
/// protocols.
///
/// Bytes that the device reads are unchanged. Each call to `write` sends one message, such as a reply. A
/// [`StreamFault`] affects one of the messages, or all messages that a function selects.
///
/// ```
/// use std::collections::VecDeque;
/// use std::io::Write;
///
/// use lexibus::sim::{FaultyStream, StreamFault};
///
/// let mut line = FaultyStream::new(VecDeque::new());
/// line.inject_nth(StreamFault::Truncated, 2);
/// line.write_all(b"one")?;
/// line.write_all(b"second")?;
/// line.write_all(b"three")?;
/// assert_eq!(line.into_inner(), b"onesecthree");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// With the traits of `std::io`, `write` blocks the device until the delay of a late message has passed. `W` is the
/// function that waits, by default `std::thread::sleep`. With the feature `modbus`, the stream also implements the
/// traits of `tokio::io`. With the traits of `tokio::io`, `write` returns before the delay has passed. The device then
/// sends the late message while it reads, flushes the stream or writes the next message. The tokio runtime must have
/// timers enabled. Use the stream in one task: if `tokio::io::split` divides it between tasks, a late message can wait
/// for the next call of the other task.
///
/// The crate `embedded-io-adapters` converts streams of `std::io` and of `tokio::io` to streams of `embedded-io`.
pub struct FaultyStream<S, W = fn(Duration)> {
    pub(super) inner: S,
    faults: Faults<StreamFault, [u8]>,
    wait: W,
    #[cfg(feature = "modbus")]
    pub(super) late: super::stream_async::Late,
}

impl<S: fmt::Debug, W> fmt::Debug for FaultyStream<S, W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FaultyStream").field("inner", &self.inner).field("faults", &self.faults).finish_non_exhaustive()
    }
}

impl<S> FaultyStream<S> {
    /// Creates a stream without faults.
    pub fn new(inner: S) -> Self {
        Self {
            inner,
            faults: Faults::default(),
            wait: std::thread::sleep,
            #[cfg(feature = "modbus")]
            late: super::stream_async::Late::default(),
        }
    }
}

impl<S, W> FaultyStream<S, W> {
    /// Returns the stream with another function that waits, for example in simulated time.
    #[must_use]
    pub fn with_wait<V: FnMut(Duration)>(self, wait: V) -> FaultyStream<S, V> {
        FaultyStream {
            inner: self.inner,
            faults: self.faults,
            wait,
            #[cfg(feature = "modbus")]
            late: self.late,
        }
    }

    /// Injects a fault into the `n`th message that the device writes from now on: 1 is the next message.
    pub fn inject_nth(&mut self, fault: StreamFault, n: u64) {
        self.faults.add_nth(fault, n);
    }

    /// Injects a fault into each message that `selects` accepts, until [`clear_faults`](Self::clear_faults). `selects` is
    /// called once for each message. If several faults affect a message, the first one that was injected applies.
    pub fn inject(&mut self, fault: StreamFault, selects: impl FnMut(&[u8]) -> bool + Send + 'static) {
        self.faults.add(fault, selects);
    }

    /// Removes all faults. Messages that are already late remain late.
    pub fn clear_faults(&mut self) {
        self.faults.clear();
    }

    /// Returns the wrapped stream.
    pub fn inner(&mut self) -> &mut S {
        &mut self.inner
    }

    /// Returns the wrapped stream. Late messages are lost.
    pub fn into_inner(self) -> S {
        self.inner
    }

    /// Returns the parts of the next message, with the pause before each part.
    pub(super) fn parts(&mut self, message: &[u8]) -> Vec<(Duration, Vec<u8>)> {
        match self.faults.next(message) {
            Some(fault) => fault.parts(message),
            None => Vec::from([(Duration::ZERO, message.to_vec())]),
        }
    }
}

impl<S: io::Read, W> io::Read for FaultyStream<S, W> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.inner.read(buffer)
    }
}

impl<S: io::Write, W: FnMut(Duration)> io::Write for FaultyStream<S, W> {
    fn write(&mut self, message: &[u8]) -> io::Result<usize> {
        if message.is_empty() {
            return Ok(0);
        }
        for (pause, part) in self.parts(message) {
            if !pause.is_zero() {
                (self.wait)(pause);
            }
            self.inner.write_all(&part)?;
        }
        Ok(message.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    /// Returns the parts of the message "abcd" with a fault, with the times at which they are sent.
    fn sent(fault: StreamFault) -> Vec<(u64, Vec<u8>)> {
        struct Parts(Vec<Vec<u8>>);
        impl io::Write for Parts {
            fn write(&mut self, part: &[u8]) -> io::Result<usize> {
                self.0.push(part.to_vec());
                Ok(part.len())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let (mut now, mut times) = (0, Vec::new());
        let mut stream = FaultyStream::new(Parts(Vec::new())).with_wait(|pause: Duration| {
            now += pause.as_secs();
            times.push(now);
        });
        stream.inject(fault, |message| message == b"abcd");
        stream.write_all(b"abcd").expect("it is sent");
        let parts = stream.into_inner().0;
        parts.into_iter().enumerate().map(|(at, part)| (times.get(at).copied().unwrap_or(0), part)).collect()
    }

    #[test]
    fn each_fault() {
        let second = Duration::from_secs(1);
        assert_eq!(sent(StreamFault::Late(3 * second)), [(3, b"abcd".to_vec())]);
        assert_eq!(sent(StreamFault::Lost), []);
        assert_eq!(sent(StreamFault::Duplicated), [(0, b"abcdabcd".to_vec())]);
        assert_eq!(sent(StreamFault::Truncated), [(0, b"ab".to_vec())]);
        let foreign = StreamFault::Foreign { bytes: b"x".to_vec(), count: 2, period: second };
        assert_eq!(sent(foreign), [(1, b"x".to_vec()), (2, b"x".to_vec())]);
        assert_eq!(sent(StreamFault::Noise(b"?".to_vec())), [(0, b"?abcd".to_vec())]);
    }
}
