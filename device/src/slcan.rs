//! CAN adapters on a serial line, with the slcan protocol of Lawicel. A frame is a line that ends with a carriage
//! return: `t6058…`.

use std::collections::VecDeque;
use std::fmt::Write as _;

use lexibus::clients::canopen::CanFrame;

#[cfg(feature = "slcan")]
mod adapter;

#[cfg(feature = "slcan")]
pub(crate) use adapter::open;

/// Maximum length of a line: an extended data frame with 8 bytes and a time stamp.
const LINE: usize = 1 + 8 + 1 + 16 + STAMP;
/// Number of digits of a time stamp.
const STAMP: usize = 4;

/// Returns the command that sets a bit rate in kbit/s, or `None` if slcan has no command for it.
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

/// Reply of an adapter to a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reply {
    /// The adapter executed the command.
    Accepted,
    /// The adapter refused the command.
    Refused,
}

/// Converts received bytes to frames.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    line: Vec<u8>,
    frames: VecDeque<CanFrame>,
    reply: Option<Reply>,
}

impl Decoder {
    /// Adds received bytes. Lines that are not valid frames, such as replies to commands, are skipped.
    pub fn push(&mut self, bytes: &[u8]) {
        const BELL: u8 = 7;
        for &byte in bytes {
            match byte {
                b'\r' | BELL => {
                    match byte {
                        BELL => self.reply = Some(Reply::Refused),
                        _ if self.line.is_empty() => self.reply = Some(Reply::Accepted),
                        _ => self.frames.extend(frame(&self.line)),
                    }
                    self.line.clear();
                }
                _ if self.line.len() <= LINE => self.line.push(byte),
                // The line is too long for a frame, so its remaining bytes are ignored.
                _ => {}
            }
        }
    }

    /// Returns the next frame.
    pub fn next_frame(&mut self) -> Option<CanFrame> {
        self.frames.pop_front()
    }

    /// Removes and returns the last reply to a command.
    #[cfg(feature = "slcan")]
    pub(crate) fn take_reply(&mut self) -> Option<Reply> {
        self.reply.take()
    }
}

/// Parses a line as a frame. A time stamp at the end is ignored. Returns `None` if the line is not a frame. For
/// example, the CAN-ID or length is invalid, a digit is not hexadecimal, or the line has too few or too many digits.
fn frame(line: &[u8]) -> Option<CanFrame> {
    let (kind, digits) = line.split_first()?;
    let (width, flag, is_remote) = match kind {
        b't' => (3, 0, false),
        b'T' => (8, CanFrame::EXTENDED, false),
        b'r' => (3, 0, true),
        b'R' => (8, CanFrame::EXTENDED, true),
        _ => return None,
    };
    let digits = std::str::from_utf8(digits).ok().filter(|text| text.bytes().all(|byte| byte.is_ascii_hexdigit()))?;
    let (id, rest) = digits.split_at_checked(width)?;
    let (length, rest) = rest.split_at_checked(1)?;
    let number = |digits: &str| u32::from_str_radix(digits, 16).ok();
    let length = number(length).filter(|length| *length <= 8)?;
    let count = if is_remote { 0 } else { 2 * length as usize };
    let (data, stamp) = rest.split_at_checked(count)?;
    if !matches!(stamp.len(), 0 | STAMP) {
        return None;
    }
    let id = number(id).filter(|id| id & !0x1FFF_FFFF == 0)? | flag;
    if is_remote {
        return CanFrame::remote(id, length as u8);
    }
    let byte = |at: usize| number(&data[at..at + 2]).map(|byte| byte as u8);
    CanFrame::new(id, &(0..count).step_by(2).map(byte).collect::<Option<Vec<u8>>>()?)
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
    use proptest::prelude::*;

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
        // The next lines are not frames. They contain wrong CAN-IDs, length codes, signs, additional digits, time stamps or
        // other bytes, or end with a bell.
        decoder.push(
            b"t12390102030405060708\xff\rt1239010203040506070809\rr1239\rr123F\rt+120\rt1231+1\rt12310\rt1231012\r",
        );
        decoder.push(
            b"t1231011\rt1231011234X\rt12310112345\rt12310112345678\rT200000000\rTFFFFFFFF0\rr12321234\x07t1230\x07",
        );
        decoder.push("tä30\r".as_bytes());
        decoder.push(&[b'x'; 100_000]);
        assert!(decoder.line.len() <= LINE + 1);
        // A time stamp follows the data.
        decoder.push(b"\rt12320A0B1234\r");
        let expected = CanFrame::new(0x123, &[0x0A, 0x0B]).expect("a frame");
        assert_eq!((decoder.next_frame(), decoder.next_frame()), (Some(expected), None));
    }
    fn frames() -> impl Strategy<Value = CanFrame> {
        let id = prop_oneof![0..=0x7FF_u32, (0..=0x1FFF_FFFF_u32).prop_map(|id| id | CanFrame::EXTENDED)];
        let data = proptest::collection::vec(any::<u8>(), 0..=8);
        (id, data, any::<bool>()).prop_map(|(id, data, is_remote)| {
            let frame = match is_remote {
                true => CanFrame::remote(id, data.len() as u8),
                false => CanFrame::new(id, &data),
            };
            frame.expect("a frame")
        })
    }

    /// Decodes bytes.
    fn decoded(bytes: &[u8]) -> Vec<CanFrame> {
        let mut decoder = Decoder::default();
        decoder.push(bytes);
        std::iter::from_fn(|| decoder.next_frame()).collect()
    }

    proptest! {
        #[test]
        fn any_frame_becomes_a_line_and_back(frame in frames(), stamp in proptest::option::of(any::<u16>())) {
            let mut text = line(&frame);
            if let Some(stamp) = stamp {
                text.insert_str(text.len() - 1, &format!("{stamp:04X}"));
            }
            prop_assert_eq!(decoded(text.as_bytes()), [frame]);
            let lower = format!("{}{}", &text[..1], text[1..].to_lowercase());
            prop_assert_eq!(decoded(lower.as_bytes()), [frame]);
        }

        /// If a line is changed, the decoder rejects it or decodes exactly the frame that the changed line contains, possibly
        /// with a time stamp.
        #[test]
        fn a_changed_line_is_rejected_or_another_frame(
            frame in frames(),
            changes in proptest::collection::vec((0..3_u8, any::<proptest::sample::Index>(), any::<u8>()), 1..4),
        ) {
            let mut bytes = line(&frame).into_bytes();
            bytes.pop();
            for (kind, at, byte) in changes {
                match kind {
                    0 if !bytes.is_empty() => drop(bytes.remove(at.index(bytes.len()))),
                    1 if !bytes.is_empty() => {
                        let at = at.index(bytes.len());
                        bytes[at] = byte;
                    }
                    _ => bytes.insert(at.index(bytes.len() + 1), byte),
                }
            }
            // A change can insert a carriage return, which ends a line.
            for text in bytes.split(|byte| *byte == b'\r') {
                let Some(found) = self::frame(text) else { continue };
                let canonical = line(&found);
                let (same, stamp) = text.split_at(canonical.len() - 1);
                prop_assert!(same.eq_ignore_ascii_case(canonical.trim_end().as_bytes()) && same[..1] == canonical.as_bytes()[..1]);
                prop_assert!(matches!(stamp.len(), 0 | STAMP) && stamp.iter().all(u8::is_ascii_hexdigit));
                prop_assert_eq!(decoded(canonical.as_bytes()), [found]);
            }
        }

        #[test]
        fn any_bytes_are_accepted(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            for found in decoded(&bytes) {
                prop_assert_eq!(decoded(line(&found).as_bytes()), [found]);
            }
        }
    }
}
