//! Recorded traces of a CAN bus: the formats of `candump` and of ASC files.

use std::time::Duration;

use lexibus::clients::canopen::CanFrame;

/// A line of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// A frame. The frame has the time that the line states, or no time if the line states none.
    Frame(CanFrame),
    /// A line without a frame, such as an empty line, a comment, a header, or an event of an ASC file.
    Other,
    /// A line that cannot be parsed in the format of the trace.
    Unknown,
}

/// Reads a trace line by line. After a line that begins with `date` or `base`, the format is ASC; otherwise, it is that
/// of `candump`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reader {
    is_asc: bool,
    is_decimal: bool,
}

impl Reader {
    /// Creates a reader.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Reads a line.
    pub fn line(&mut self, line: &str) -> Line {
        let line = line.trim();
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [] => Line::Other,
            ["date", ..] => {
                self.is_asc = true;
                Line::Other
            }
            ["base", base, ..] => {
                (self.is_asc, self.is_decimal) = (true, *base == "dec");
                Line::Other
            }
            _ if line.starts_with("//") || line.starts_with('#') => Line::Other,
            words if self.is_asc => self.asc(words),
            words => candump(words),
        }
    }

    /// Parses a line of an ASC file: `0.001234 1 123 Rx d 2 0A 0B`.
    fn asc(&self, words: &[&str]) -> Line {
        let Some(time) = words.first().and_then(|time| seconds(time)) else { return Line::Other };
        let [_, _, id, "Rx" | "Tx", kind, rest @ ..] = words else { return Line::Other };
        match self.asc_frame(id, kind, rest) {
            Some(frame) => Line::Frame(frame.at(Some(time))),
            None => Line::Unknown,
        }
    }

    fn asc_frame(&self, id: &str, kind: &str, rest: &[&str]) -> Option<CanFrame> {
        let radix = if self.is_decimal { 10 } else { 16 };
        let (digits, flag) = id.strip_suffix('x').map_or((id, 0), |digits| (digits, CanFrame::EXTENDED));
        let id = u32::from_str_radix(digits, radix).ok()? | flag;
        let length = rest.first().map_or(Some(0), |length| u8::from_str_radix(length, 16).ok())?;
        if kind == "r" {
            return CanFrame::remote(id, length);
        }
        let data = rest.get(1..1 + usize::from(length))?;
        let byte = |text: &&str| u8::from_str_radix(text, radix).ok();
        let data: Vec<u8> = data.iter().map(byte).collect::<Option<_>>()?;
        (kind == "d").then(|| CanFrame::new(id, &data))?
    }
}

/// Parses a line of `candump -L` (`(1.5) can0 123#0A0B`) or `candump` (`can0 123 [2] 0A 0B`, with or without a time).
fn candump(words: &[&str]) -> Line {
    let (time, words) = match words {
        [time, rest @ ..] if time.starts_with('(') => {
            let Some(time) = seconds(time.trim_matches(['(', ')'])) else { return Line::Unknown };
            (Some(time), rest)
        }
        words => (None, words),
    };
    let frame = match words {
        [_, frame, ..] if frame.contains('#') => compact(frame),
        [_, id, length, rest @ ..] if length.starts_with('[') => columns(id, length, rest),
        _ => None,
    };
    frame.map_or(Line::Unknown, |frame| Line::Frame(frame.at(time)))
}

/// Parses `123#0A0B`, `123#R2` or `12345678#`.
fn compact(text: &str) -> Option<CanFrame> {
    let (id, data) = text.split_once('#')?;
    let id = identifier(id)?;
    if let Some(length) = data.strip_prefix('R') {
        return CanFrame::remote(id, if length.is_empty() { 0 } else { length.parse().ok()? });
    }
    let digits: Vec<char> = data.chars().filter(|letter| *letter != '.').collect();
    let byte = |pair: &[char]| u8::from_str_radix(&pair.iter().collect::<String>(), 16).ok();
    let is_complete = digits.len().is_multiple_of(2) && digits.iter().all(char::is_ascii_hexdigit);
    let data: Vec<u8> = is_complete.then(|| digits.chunks(2).map(byte).collect::<Option<_>>())??;
    CanFrame::new(id, &data)
}

/// Parses `123 [2] 0A 0B` or `123 [2] remote request`.
fn columns(id: &str, length: &str, rest: &[&str]) -> Option<CanFrame> {
    let id = identifier(id)?;
    let length: usize = length.trim_matches(['[', ']']).parse().ok()?;
    if rest.first() == Some(&"remote") {
        return CanFrame::remote(id, u8::try_from(length).ok()?);
    }
    let byte = |text: &&str| u8::from_str_radix(text, 16).ok();
    let data: Vec<u8> = rest.get(..length)?.iter().map(byte).collect::<Option<_>>()?;
    CanFrame::new(id, &data)
}

/// Parses an identifier of `candump`: three digits for 11 bits, eight digits for 29 bits.
fn identifier(text: &str) -> Option<u32> {
    let id = u32::from_str_radix(text, 16).ok()?;
    match text.len() {
        3 => Some(id),
        8 if id <= 0x1FFF_FFFF => Some(id | CanFrame::EXTENDED),
        _ => None,
    }
}

fn seconds(text: &str) -> Option<Duration> {
    Duration::try_from_secs_f64(text.parse().ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u32, data: &[u8]) -> Line {
        Line::Frame(CanFrame::new(id, data).expect("a frame"))
    }

    #[test]
    fn lines_of_candump() {
        let mut reader = Reader::new();
        for (line, expected) in [
            ("(1436509052.249713) can0 185#0A0B", frame(0x185, &[10, 11])),
            ("(000.000001) vcan0 12345678#", frame(CanFrame::EXTENDED | 0x1234_5678, &[])),
            ("  can0  185   [2]  0A 0B", frame(0x185, &[10, 11])),
            ("(001.5) can0 185 [2] 0A 0B  '..'", frame(0x185, &[10, 11])),
            ("can0 705#R1", Line::Frame(CanFrame::remote(0x705, 1).expect("a frame"))),
            ("can0 705 [1] remote request", Line::Frame(CanFrame::remote(0x705, 1).expect("a frame"))),
            ("", Line::Other),
            ("can0 185#0A0", Line::Unknown),
            ("can0 85#", Line::Unknown),
            ("hello world", Line::Unknown),
        ] {
            assert_eq!(reader.line(line), expected, "{line}");
        }
        let Line::Frame(timed) = reader.line("(1.500000) can0 185#") else { panic!("a frame") };
        assert_eq!(timed.time(), Some(Duration::from_millis(1500)));
    }

    #[test]
    fn lines_of_asc_files() {
        let mut reader = Reader::new();
        for (line, expected) in [
            ("date Fri Jan 16 09:00:00.000 am 2026", Line::Other),
            ("base hex  timestamps absolute", Line::Other),
            ("internal events logged", Line::Other),
            ("   0.001234 1  185             Rx   d 2 0A 0B  Length = 1 BitCount = 2", frame(0x185, &[10, 11])),
            ("   0.002 1  12345678x Tx d 0", frame(CanFrame::EXTENDED | 0x1234_5678, &[])),
            ("   0.003 1  705 Rx r 1", Line::Frame(CanFrame::remote(0x705, 1).expect("a frame"))),
            ("   0.004 1  ErrorFrame", Line::Other),
            ("   0.005 1  185 Rx d 2 0A", Line::Unknown),
        ] {
            assert_eq!(reader.line(line), expected, "{line}");
        }
        let mut reader = Reader::new();
        reader.line("base dec timestamps absolute");
        assert_eq!(reader.line("0.1 1 389 Rx d 2 10 11"), frame(0x185, &[10, 11]));
    }
}
