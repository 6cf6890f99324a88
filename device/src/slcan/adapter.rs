//! The serial line of a CAN adapter.

use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

use lexibus::clients::canopen::{CanFrame, CanPort};
use serialport::SerialPort;

use super::{line, setup, Decoder};

/// Bit rate of the serial line. Adapters with USB ignore it.
const LINE_RATE: u32 = 115_200;
/// Minimum timeout of a read. A timeout of zero would mean no timeout on some systems.
const MIN_TIMEOUT: Duration = Duration::from_millis(1);

/// A CAN adapter on a serial line.
pub(crate) struct Adapter {
    line: Box<dyn SerialPort>,
    decoder: Decoder,
}

/// Opens the channel of a CAN adapter. Sets its bit rate, given in kbit/s, if there is one.
pub(crate) fn open(path: &str, bit_rate: Option<u16>) -> io::Result<Adapter> {
    let line = serialport::new(path, LINE_RATE).timeout(Duration::from_millis(100)).open()?;
    let mut adapter = Adapter { line, decoder: Decoder::default() };
    // An empty line ends an incomplete command. An open channel has to be closed before the bit rate changes.
    adapter.line.write_all(b"\rC\r")?;
    if let Some(setup) = bit_rate.and_then(setup) {
        adapter.line.write_all(setup)?;
    }
    adapter.line.write_all(b"O\r")?;
    Ok(adapter)
}

impl Drop for Adapter {
    fn drop(&mut self) {
        // A failure cannot be reported. The adapter then keeps its channel open.
        let _ = self.line.write_all(b"C\r");
    }
}

impl CanPort for Adapter {
    type Error = io::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> io::Result<bool> {
        self.line.set_timeout(patience.max(MIN_TIMEOUT))?;
        match self.line.write_all(line(frame).as_bytes()) {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::TimedOut => Ok(false),
            Err(error) => Err(error),
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> io::Result<Option<CanFrame>> {
        let end = Instant::now().checked_add(patience);
        let mut buffer = [0; 1024];
        loop {
            while let Some(frame) = self.decoder.next_frame() {
                let frame = frame.at(self.now());
                if wanted(&frame) {
                    return Ok(Some(frame));
                }
            }
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            if left.is_zero() && self.line.bytes_to_read()? == 0 {
                return Ok(None);
            }
            self.line.set_timeout(left.max(MIN_TIMEOUT))?;
            match self.line.read(&mut buffer) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                Ok(count) => self.decoder.push(&buffer[..count]),
                Err(error) if error.kind() == io::ErrorKind::TimedOut => {}
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}
