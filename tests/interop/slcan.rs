//! A CAN interface behind a serial line, by the protocol `slcan` of Lawicel: `t6058…` and a carriage return is a frame.

use std::collections::VecDeque;
use std::fmt::Write as _;
use std::io;
use std::time::{Duration, Instant};

use lexibus::clients::canopen::{CanFrame, CanPort};

use crate::pty::Pty;

/// The adapter and the bus behind it. Frames that nobody has asked for yet are kept.
pub struct Slcan {
    line: Pty,
    bytes: Vec<u8>,
    frames: VecDeque<CanFrame>,
}

impl Slcan {
    pub fn new(line: Pty) -> Self {
        Self { line, bytes: Vec::new(), frames: VecDeque::new() }
    }

    /// Takes frames from the line, waiting for `patience` where there are none.
    fn listen(&mut self, patience: Duration) -> io::Result<()> {
        let mut buffer = [0; 4096];
        let count = self.line.read(&mut buffer, patience)?;
        self.bytes.extend_from_slice(&buffer[..count]);
        while let Some(end) = self.bytes.iter().position(|&byte| byte == b'\r') {
            let line: Vec<u8> = self.bytes.drain(..=end).collect();
            self.frames.extend(frame(&line[..end])?);
        }
        Ok(())
    }
}

/// The frame of a line; `None` where it is one of the commands that set the adapter up.
fn frame(line: &[u8]) -> io::Result<Option<CanFrame>> {
    let wrong = || io::Error::new(io::ErrorKind::InvalidData, format!("no frame: {}", line.escape_ascii()));
    let digits = match line {
        [b't', digits @ ..] => std::str::from_utf8(digits).map_err(|_| wrong())?,
        [b'C' | b'O' | b'S', ..] | [] => return Ok(None),
        _ => return Err(wrong()),
    };
    let number =
        |digits: Option<&str>| digits.and_then(|digits| u16::from_str_radix(digits, 16).ok()).ok_or_else(wrong);
    let (id, length) = (number(digits.get(..3))?, number(digits.get(3..4))?);
    let byte = |at: u16| number(digits.get(4 + 2 * usize::from(at)..6 + 2 * usize::from(at))).map(|byte| byte as u8);
    let data: Vec<u8> = (0..length).map(byte).collect::<Result<_, _>>()?;
    CanFrame::new(id, &data).map(Some).ok_or_else(wrong)
}

impl CanPort for Slcan {
    type Error = io::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> io::Result<bool> {
        let mut line = format!("t{:03X}{}", frame.id(), frame.data().len());
        frame.data().iter().for_each(|byte| write!(line, "{byte:02X}").expect("memory"));
        line.push('\r');
        self.line.write(line.as_bytes(), patience)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> io::Result<Option<CanFrame>> {
        let end = Instant::now() + patience;
        loop {
            if let Some(at) = self.frames.iter().position(&mut *wanted) {
                return Ok(self.frames.remove(at));
            }
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(None);
            }
            self.listen(left)?;
        }
    }
}
