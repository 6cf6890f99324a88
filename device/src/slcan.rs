//! CAN adapters on a serial line, with the protocol slcan of Lawicel. A frame is a line that ends with a carriage return:
//! `t6058…`.

use std::collections::VecDeque;
use std::fmt::Write as _;

use lexibus::clients::canopen::CanFrame;

#[cfg(feature = "slcan")]
mod adapter;

#[cfg(feature = "slcan")]
pub(crate) use adapter::open;

/// Maximum length of a line: an extended data frame with a time stamp.
const LINE: usize = 32;

/// Returns the command that sets the bit rate, given in kbit/s.
pub(crate) fn setup(bit_rate: u16) -> Option<&'static [u8]> {
    Some(match bit_rate {
        10 => b"S0\r",
        20 => b"S1\r",
        50 => b"S2\r",
        100 => b"S3\r",
        125 => b"S4\r",
        250 => b"S5\r",
        500 => b"S6\r",
        800 => b"S7\r",
        1000 => b"S8\r",
        _ => return None,
    })
}

/// Converts received bytes to frames.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    line: Vec<u8>,
    frames: VecDeque<CanFrame>,
}

impl Decoder {
    /// Adds received bytes. Lines that are not frames, such as replies to commands, are skipped.
    pub fn push(&mut self, bytes: &[u8]) {
        /// Reply to a command that the adapter refused.
        const BELL: u8 = 7;
        for &byte in bytes {
            match byte {
                b'\r' | BELL => {
                    self.frames.extend(frame(&self.line));
                    self.line.clear();
                }
                _ if self.line.len() <= LINE => self.line.push(byte),
                // The line is too long for a frame. The rest of the line is ignored.
                _ => {}
            }
        }
    }

    /// Returns the next frame.
    pub fn next_frame(&mut self) -> Option<CanFrame> {
        self.frames.pop_front()
    }
}

/// Parses a line as a frame. A time stamp at the end is ignored.
fn frame(line: &[u8]) -> Option<CanFrame> {
    let text = std::str::from_utf8(line).ok().filter(|text| text.is_ascii())?;
    let (kind, digits) = text.split_at_checked(1)?;
    let (width, flag, is_remote) = match kind {
        "t" => (3, 0, false),
        "T" => (8, CanFrame::EXTENDED, false),
        "r" => (3, 0, true),
        "R" => (8, CanFrame::EXTENDED, true),
        _ => return None,
    };
    let number = |range: std::ops::Range<usize>| u32::from_str_radix(digits.get(range)?, 16).ok();
    let (id, length) = (number(0..width)?, number(width..width + 1)? as usize);
    // An identifier of 29 bits has no other bits.
    let id = if flag == 0 { id } else { flag | (id & 0x1FFF_FFFF) };
    if is_remote {
        return CanFrame::remote(id, length as u8);
    }
    let first = width + 1;
    let byte = |at: usize| number(first + 2 * at..first + 2 * at + 2).map(|byte| byte as u8);
    let data: Vec<u8> = (0..length).map(byte).collect::<Option<_>>()?;
    CanFrame::new(id, &data)
}

/// Formats a frame as a line.
#[must_use]
pub fn line(frame: &CanFrame) -> String {
    let kind = if frame.is_remote() { 'r' } else { 't' };
    let mut line = match frame.is_extended() {
        true => format!("{}{:08X}", kind.to_ascii_uppercase(), frame.id() & !CanFrame::EXTENDED),
        false => format!("{kind}{:03X}", frame.id()),
    };
    let _ = write!(line, "{}", frame.length());
    for byte in frame.data() {
        let _ = write!(line, "{byte:02X}");
    }
    line.push('\r');
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_become_lines_and_back() {
        let frames = [
            CanFrame::new(0x605, &[0x40, 0x18, 0x10, 1]),
            CanFrame::new(0x7FF, &[]),
            CanFrame::new(CanFrame::EXTENDED | 0x1234_5678, &[0xFF; 8]),
            CanFrame::remote(0x705, 1),
            CanFrame::remote(CanFrame::EXTENDED | 1, 8),
        ];
        let frames = frames.map(|frame| frame.expect("a frame"));
        let text: String = frames.iter().map(line).collect();
        assert!(text.starts_with("t605440181001\rt7FF0\rT123456788FF"), "{text}");
        let mut decoder = Decoder::default();
        // The bytes arrive one by one.
        text.bytes().for_each(|byte| decoder.push(&[byte]));
        let decoded: Vec<CanFrame> = std::iter::from_fn(|| decoder.next_frame()).collect();
        assert_eq!(decoded, frames);
    }

    #[test]
    fn other_lines_are_skipped() {
        let mut decoder = Decoder::default();
        decoder.push(b"\x07\rz\rZ\rV1013\rt12\rtXYZ0\rt1239\rt12320A\rt8000\r");
        decoder.push(&[b'x'; 100_000]);
        assert!(decoder.line.len() <= LINE + 1);
        // A time stamp follows the data.
        decoder.push(b"\rt12320A0B1234\r");
        let expected = CanFrame::new(0x123, &[0x0A, 0x0B]).expect("a frame");
        assert_eq!((decoder.next_frame(), decoder.next_frame()), (Some(expected), None));
    }
}
