//! The serial line of a CAN adapter.

use std::io::{self, ErrorKind, Read, Write};
use std::time::{Duration, Instant};

use lexibus::clients::canopen::{CanFrame, CanPort};
use serialport::SerialPort;

use super::{line, setup, Decoder, Reply};

/// Bit rate of the serial line. Many adapters with USB ignore it.
const LINE_RATE: u32 = 115_200;
/// Minimum timeout of a read or write. On some systems, a timeout of zero would mean an unlimited time.
const MIN_TIMEOUT: Duration = Duration::from_millis(1);
/// Maximum timeout of a read or write. Some systems cannot represent much longer ones.
const MAX_TIMEOUT: Duration = Duration::from_secs(86_400);
/// Maximum time for the reply to a command. Some adapters send no replies.
const REPLY: Duration = Duration::from_millis(200);
/// If no byte arrives for this time, `open` assumes that the adapter has nothing left to send. Before, the adapter can send
/// replies to earlier commands and frames from the time before the channel was closed.
const SILENCE: Duration = Duration::from_millis(100);

/// A serial line with timeouts.
pub(super) trait SerialLine: Read + Write {
    /// Sets the maximum time of a read or write.
    fn limit(&mut self, time: Duration) -> io::Result<()>;

    /// Returns the number of received bytes that were not read.
    fn waiting(&self) -> io::Result<usize>;
}

impl SerialLine for Box<dyn SerialPort> {
    fn limit(&mut self, time: Duration) -> io::Result<()> {
        Ok(self.set_timeout(time.clamp(MIN_TIMEOUT, MAX_TIMEOUT))?)
    }

    fn waiting(&self) -> io::Result<usize> {
        Ok(self.bytes_to_read()? as usize)
    }
}

/// A CAN adapter on a serial line.
pub(crate) struct Adapter<L: SerialLine> {
    line: L,
    decoder: Decoder,
    /// True if the line of the last frame was written only in part and was not ended yet.
    is_cut: bool,
}

/// Opens the channel of a CAN adapter. If `bit_rate` is given, sets the bit rate of the CAN bus in kbit/s first.
pub(crate) fn open(path: &str, bit_rate: Option<u16>) -> io::Result<impl CanPort<Error = io::Error>> {
    let line = serialport::new(path, LINE_RATE).timeout(REPLY).open()?;
    let mut adapter = Adapter::new(line);
    adapter.open(bit_rate)?;
    Ok(adapter)
}

impl<L: SerialLine> Adapter<L> {
    fn new(line: L) -> Self {
        Adapter { line, decoder: Decoder::default(), is_cut: false }
    }

    fn open(&mut self, bit_rate: Option<u16>) -> io::Result<()> {
        let setup = bit_rate.map(|bit_rate| {
            let wrong = || io::Error::new(ErrorKind::InvalidInput, format!("slcan cannot set {bit_rate} kbit/s"));
            setup(bit_rate).ok_or_else(wrong)
        });
        let setup = setup.transpose()?;
        // An empty line ends an incomplete command. An open channel has to be closed before the bit rate changes. Many adapters refuse
        // to close a channel that is closed.
        self.line.limit(REPLY)?;
        self.line.write_all(b"\rC\r")?;
        self.discard()?;
        if let Some(setup) = setup {
            self.command(setup, "the adapter refuses the bit rate")?;
        }
        self.command(b"O\r", "the adapter refuses to open the channel")
    }

    /// Discards received bytes until the adapter sends nothing for [`SILENCE`]. Even if more bytes arrive,
    /// stops after at most about six times [`SILENCE`].
    fn discard(&mut self) -> io::Result<()> {
        let end = Instant::now() + 5 * SILENCE;
        while self.read(SILENCE)? > 0 && Instant::now() < end {}
        self.decoder = Decoder::default();
        Ok(())
    }

    /// Sends a command. Fails with the error message `refusal` if the adapter refuses it. An adapter that sends no reply counts as
    /// having executed it.
    fn command(&mut self, command: &[u8], refusal: &str) -> io::Result<()> {
        self.line.limit(REPLY)?;
        self.line.write_all(command)?;
        let end = Instant::now() + REPLY;
        loop {
            match self.decoder.take_reply() {
                Some(Reply::Accepted) => return Ok(()),
                Some(Reply::Refused) => return Err(io::Error::other(refusal)),
                None => {}
            }
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(());
            }
            self.read(left)?;
        }
    }

    /// Reads received bytes. Waits about `patience` at most for the first one. Returns the number of bytes, or 0 if none was read.
    fn read(&mut self, patience: Duration) -> io::Result<usize> {
        let mut buffer = [0; 1024];
        self.line.limit(patience)?;
        match self.line.read(&mut buffer) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => {
                self.decoder.push(&buffer[..count]);
                Ok(count)
            }
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(0),
            Err(error) => Err(error),
        }
    }

    /// Writes bytes until all are written or until `end`. Returns the number of written bytes.
    fn write(&mut self, bytes: &[u8], end: Option<Instant>) -> io::Result<usize> {
        let mut written = 0;
        while written < bytes.len() {
            let left = end.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()));
            self.line.limit(left)?;
            match self.line.write(&bytes[written..]) {
                Ok(0) => return Err(ErrorKind::WriteZero.into()),
                Ok(count) => written += count,
                Err(error) if error.kind() == ErrorKind::TimedOut => break,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(written)
    }

    /// Ends the line of a frame that was written only in part, so that the adapter refuses the frame if it is incomplete.
    /// Returns `false` if the serial line accepted no byte until `end`.
    fn end_line(&mut self, end: Option<Instant>) -> io::Result<bool> {
        if self.is_cut {
            self.is_cut = self.write(b"\r", end)? == 0;
        }
        Ok(!self.is_cut)
    }
}

impl<L: SerialLine> Drop for Adapter<L> {
    fn drop(&mut self) {
        // A failure cannot be reported. The adapter may then keep its channel open.
        let _ = self.line.write_all(if self.is_cut { b"\rC\r" } else { b"C\r" });
    }
}

impl<L: SerialLine> CanPort for Adapter<L> {
    type Error = io::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> io::Result<bool> {
        let end = Instant::now().checked_add(patience);
        if !self.end_line(end)? {
            return Ok(false);
        }
        let text = line(frame);
        let missing = text.len() - self.write(text.as_bytes(), end)?;
        self.is_cut = (1..text.len()).contains(&missing);
        // If only the carriage return is missing, `send`, `receive` or `drop` writes it later, and the frame is sent.
        Ok(missing <= 1)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> io::Result<Option<CanFrame>> {
        let end = Instant::now().checked_add(patience);
        self.end_line(Some(Instant::now()))?;
        // Number of bytes that were unread at the end of `patience` and have not been read since. Bytes that arrive later don't extend
        // the call.
        let mut last = None;
        loop {
            while let Some(frame) = self.decoder.next_frame() {
                let frame = frame.at(self.now());
                if wanted(&frame) {
                    return Ok(Some(frame));
                }
            }
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            if left.is_zero() && last.is_none() {
                last = Some(self.line.waiting()?);
            }
            if last == Some(0) {
                return Ok(None);
            }
            let count = self.read(left)?;
            last = last.map(|last| if count == 0 { 0 } else { last.saturating_sub(count) });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use super::*;

    /// A serial line that accepts `free` bytes, and that receives `noise` before each read.
    #[derive(Default)]
    struct Fake {
        free: usize,
        written: Vec<u8>,
        received: VecDeque<u8>,
        noise: &'static [u8],
    }

    impl Read for Fake {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.received.extend(self.noise);
            match self.received.read(buffer)? {
                0 => Err(ErrorKind::TimedOut.into()),
                count => Ok(count),
            }
        }
    }

    impl Write for Fake {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let count = self.free.min(bytes.len());
            self.free -= count;
            self.written.extend(&bytes[..count]);
            if count == 0 {
                Err(ErrorKind::TimedOut.into())
            } else {
                Ok(count)
            }
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl SerialLine for Fake {
        fn limit(&mut self, _: Duration) -> io::Result<()> {
            Ok(())
        }

        fn waiting(&self) -> io::Result<usize> {
            Ok(self.received.len().max(self.noise.len()))
        }
    }

    fn frame(number: u8) -> CanFrame {
        CanFrame::new(0x605, &[number; 4]).expect("a frame")
    }

    #[test]
    fn a_frame_that_is_cut_does_not_damage_the_next_one() {
        let length = line(&frame(1)).len();
        for free in 0..=length {
            let mut adapter = Adapter::new(Fake { free, ..Fake::default() });
            let is_sent = adapter.send(&frame(1), Duration::ZERO).expect("no error");
            assert!(!adapter.send(&frame(2), Duration::ZERO).expect("no error"), "the line is full");
            adapter.line.free = 100;
            assert!(adapter.send(&frame(3), Duration::ZERO).expect("no error"));
            let mut decoder = Decoder::default();
            decoder.push(&adapter.line.written);
            let received: Vec<CanFrame> = std::iter::from_fn(|| decoder.next_frame()).collect();
            let expected = if is_sent { vec![frame(1), frame(3)] } else { vec![frame(3)] };
            assert_eq!((received, is_sent), (expected, free + 1 >= length), "after {free} bytes");
        }
    }

    #[test]
    fn the_end_of_a_frame_is_written_before_a_reply_is_expected() {
        let length = line(&frame(1)).len();
        let mut adapter = Adapter::new(Fake { free: length - 1, ..Fake::default() });
        assert!(adapter.send(&frame(1), Duration::ZERO).expect("no error"));
        adapter.line.free = 100;
        assert_eq!(adapter.receive(Duration::ZERO, &mut |_| true).expect("no error"), None);
        assert_eq!(adapter.line.written, line(&frame(1)).as_bytes());
    }

    #[test]
    fn continuous_bytes_do_not_extend_the_patience() {
        for noise in [&b"t60540000\rt6051"[..], &[b'x'; 5000], b"\x07\x07"] {
            let mut adapter = Adapter::new(Fake { noise, ..Fake::default() });
            assert_eq!(adapter.receive(Duration::from_millis(5), &mut |_| false).expect("no error"), None);
        }
    }
}
