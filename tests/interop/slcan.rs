//! A CAN interface on a serial line with the Lawicel `slcan` protocol. A frame is sent as `t6058…` and a carriage
//! return.

use std::collections::VecDeque;
use std::fmt::Write as _;
use std::io;
use std::time::{Duration, Instant};

use lexibus::clients::canopen::{AsyncCanPort, CanFrame, CanPort};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::time::timeout;
use tokio_serial::SerialStream;

use crate::pty::Pty;

/// The CAN adapter with its serial line. The line is blocking if it is a [`Pty`], and asynchronous if it is a
/// [`SerialStream`].
pub struct Slcan<L> {
    line: L,
    received: Received,
}

/// Received data that have not been processed: an incomplete line and complete frames.
#[derive(Default)]
struct Received {
    bytes: Vec<u8>,
    frames: VecDeque<CanFrame>,
}

impl<L> Slcan<L> {
    pub fn new(line: L) -> Self {
        Self { line, received: Received::default() }
    }
}

impl Received {
    fn push(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes.extend_from_slice(bytes);
        while let Some(end) = self.bytes.iter().position(|&byte| byte == b'\r') {
            let line: Vec<u8> = self.bytes.drain(..=end).collect();
            self.frames.extend(frame(&line[..end])?);
        }
        Ok(())
    }

    fn take(&mut self, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        std::iter::from_fn(|| self.frames.pop_front()).find(|frame| wanted(frame))
    }
}

/// Parses a line as a frame. Returns `None` if the line is empty or a setup command of the adapter.
fn frame(line: &[u8]) -> io::Result<Option<CanFrame>> {
    let wrong = || io::Error::new(io::ErrorKind::InvalidData, format!("no frame: {}", line.escape_ascii()));
    // `t` and `T` mark data frames, and `r` and `R` mark remote frames. Frames with lowercase letters have CAN-IDs of 11 bits,
    // and frames with uppercase letters have CAN-IDs of 29 bits.
    let (kind, digits) = match line {
        [kind @ (b't' | b'T' | b'r' | b'R'), digits @ ..] => (*kind, std::str::from_utf8(digits).map_err(|_| wrong())?),
        [b'C' | b'O' | b'S', ..] | [] => return Ok(None),
        _ => return Err(wrong()),
    };
    let number =
        |digits: Option<&str>| digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()).ok_or_else(wrong);
    let (width, flag) = if kind.is_ascii_uppercase() { (8, CanFrame::EXTENDED) } else { (3, 0) };
    let (id, length) = (flag | number(digits.get(..width))?, number(digits.get(width..width + 1))? as usize);
    if kind.eq_ignore_ascii_case(&b'r') {
        return CanFrame::remote(id, length as u8).map(Some).ok_or_else(wrong);
    }
    let first = width + 1;
    let byte = |at: usize| number(digits.get(first + 2 * at..first + 2 * at + 2)).map(|byte| byte as u8);
    let data: Vec<u8> = (0..length).map(byte).collect::<Result<_, _>>()?;
    CanFrame::new(id, &data).map(Some).ok_or_else(wrong)
}

/// Formats a frame as a line.
fn line(frame: &CanFrame) -> String {
    let kind = if frame.is_remote() { 'r' } else { 't' };
    let mut line = match frame.is_extended() {
        true => format!("{}{:08X}", kind.to_ascii_uppercase(), frame.id() & !CanFrame::EXTENDED),
        false => format!("{kind}{:03X}", frame.id()),
    };
    write!(line, "{}", frame.length()).expect("memory");
    frame.data().iter().for_each(|byte| write!(line, "{byte:02X}").expect("memory"));
    line.push('\r');
    line
}

impl CanPort for Slcan<Pty> {
    type Error = io::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> io::Result<bool> {
        self.line.write(line(frame).as_bytes(), patience)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> io::Result<Option<CanFrame>> {
        let end = Instant::now() + patience;
        let mut buffer = [0; 4096];
        loop {
            let left = end.saturating_duration_since(Instant::now());
            if let Some(frame) = self.received.take(wanted) {
                return Ok(Some(frame));
            }
            let count = self.line.read(&mut buffer, left)?;
            if count == 0 && left.is_zero() {
                return Ok(None);
            }
            self.received.push(&buffer[..count])?;
        }
    }
}

impl AsyncCanPort for Slcan<SerialStream> {
    type Error = io::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> io::Result<bool> {
        let line = line(frame);
        match timeout(patience, self.line.write_all(line.as_bytes())).await {
            Ok(written) => written.map(|()| true),
            Err(_) => Ok(false),
        }
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> io::Result<Option<CanFrame>> {
        let end = tokio::time::Instant::now() + patience;
        let mut buffer = [0; 4096];
        loop {
            if let Some(frame) = self.received.take(wanted) {
                return Ok(Some(frame));
            }
            match tokio::time::timeout_at(end, self.line.read(&mut buffer)).await {
                Ok(count) => self.received.push(&buffer[..count?])?,
                Err(_) => return Ok(None),
            }
        }
    }
}
