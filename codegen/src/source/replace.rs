//! Replaces parts of a file and keeps all other bytes, in the encoding of the file.

use std::ops::Range;

use encoding_rs::{Encoding as Charset, WINDOWS_1252};

use super::decode::{declared, MARK};
use super::{Encoding, Source};

/// Maximum number of UTF-8 bytes that a decoder writes for one byte of input.
const MAX_STEP: usize = 32;

impl Source {
    /// Returns the file with parts of its text replaced. The bytes outside of `replacements` stay the same, including line ends and
    /// the byte order mark.
    ///
    /// The ranges are byte offsets into [`Source::text`]. They must be in ascending order and must not overlap.
    ///
    /// Returns `None` if the ranges violate these rules, or do not start and end at character boundaries. Also returns `None` if
    /// the encoding of the file lacks a character of a replacement, or if a reader would not decode the new bytes to the new text.
    pub fn replaced(&self, replacements: &[(Range<usize>, &str)]) -> Option<Source> {
        let bytes = self.bytes();
        let form = Form::of(self, &bytes)?;
        let offsets: Vec<usize> = replacements.iter().flat_map(|(range, _)| [range.start, range.end]).collect();
        let offsets = form.byte_offsets(self.text(), &bytes, &offsets)?;
        let (mut new, mut text) = (Vec::with_capacity(bytes.len()), String::with_capacity(self.text().len()));
        let (mut byte, mut character) = (0, 0);
        for ((range, replacement), at) in replacements.iter().zip(offsets.chunks_exact(2)) {
            new.extend_from_slice(bytes.get(byte..at[0])?);
            new.extend(form.encode(replacement)?);
            text += self.text().get(character..range.start)?;
            text += replacement;
            (byte, character) = (at[1], range.end);
        }
        new.extend_from_slice(bytes.get(byte..)?);
        text += self.text().get(character..)?;
        // A replacement can change the encoding that a reader detects, as in an XML declaration.
        let mut new = Source::new(self.name(), new);
        new.folder.clone_from(&self.folder);
        (new.text() == text).then_some(new)
    }
}

/// Relation between the bytes of a file and its text.
enum Form {
    /// UTF-8 after a byte order mark of `mark` bytes.
    Utf8 { mark: usize },
    /// One byte per character after a byte order mark of `mark` bytes.
    Windows1252 { mark: usize },
    /// Units of two bytes after a byte order mark of `mark` bytes.
    Utf16 { mark: usize, is_big_endian: bool },
    /// The encoding that the XML declaration names.
    Declared(&'static Charset),
}

impl Form {
    fn of(source: &Source, bytes: &[u8]) -> Option<Form> {
        let has_mark = bytes.starts_with(MARK);
        let mark = if has_mark { MARK.len() } else { 0 };
        Some(match source.encoding() {
            Encoding::Utf8 => Form::Utf8 { mark: 0 },
            Encoding::Utf8Bom => Form::Utf8 { mark },
            Encoding::Windows1252 => Form::Windows1252 { mark },
            Encoding::Utf16 => {
                let is_marked = matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]);
                let is_big_endian = matches!(bytes, [0xfe, 0xff, ..] | [0, ..]);
                Form::Utf16 { mark: if is_marked { 2 } else { 0 }, is_big_endian }
            }
            Encoding::Declared => Form::Declared(Charset::for_label(declared(bytes)?.as_bytes())?),
        })
    }

    /// Converts ascending offsets into the text to offsets into the bytes. Returns `None` if an offset is not at a
    /// character boundary.
    fn byte_offsets(&self, text: &str, bytes: &[u8], offsets: &[usize]) -> Option<Vec<usize>> {
        if let Form::Declared(charset) = self {
            return decoded_offsets(charset, bytes, offsets);
        }
        let (mut byte, mut character) = (self.mark(), 0);
        let mut converted = Vec::with_capacity(offsets.len());
        for &offset in offsets {
            let part = text.get(character..offset)?;
            byte += match self {
                Form::Utf8 { .. } | Form::Declared(_) => part.len(),
                Form::Windows1252 { .. } => part.chars().count(),
                Form::Utf16 { .. } => 2 * part.chars().map(char::len_utf16).sum::<usize>(),
            };
            converted.push(byte);
            character = offset;
        }
        Some(converted)
    }

    fn mark(&self) -> usize {
        match *self {
            Form::Utf8 { mark } | Form::Windows1252 { mark } | Form::Utf16 { mark, .. } => mark,
            Form::Declared(_) => 0,
        }
    }

    /// Encodes a text without a byte order mark. Returns `None` if the encoding lacks a character.
    fn encode(&self, text: &str) -> Option<Vec<u8>> {
        let charset = match self {
            Form::Utf8 { .. } => return Some(text.into()),
            Form::Utf16 { is_big_endian, .. } => {
                let order = if *is_big_endian { u16::to_be_bytes } else { u16::to_le_bytes };
                return Some(text.encode_utf16().flat_map(order).collect());
            }
            Form::Windows1252 { .. } => WINDOWS_1252,
            Form::Declared(charset) => charset,
        };
        let (bytes, _, has_lost) = charset.encode(text);
        (!has_lost).then(|| bytes.into_owned())
    }
}

/// Converts ascending offsets into the decoded text to offsets into the bytes, by decoding byte after byte.
fn decoded_offsets(charset: &'static Charset, bytes: &[u8], offsets: &[usize]) -> Option<Vec<usize>> {
    let mut decoder = charset.new_decoder_without_bom_handling();
    let mut converted = Vec::with_capacity(offsets.len());
    let (mut length, mut buffer) = (0, [0; MAX_STEP]);
    for at in 0..=bytes.len() {
        while offsets.get(converted.len()) == Some(&length) {
            converted.push(at);
        }
        if let Some(byte) = bytes.get(at..at + 1) {
            let (_, _, written, _) = decoder.decode_to_utf8(byte, &mut buffer, at + 1 == bytes.len());
            length += written;
        }
    }
    (converted.len() == offsets.len()).then_some(converted)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Replaces `12` with `new` in a file.
    fn fixed(bytes: &[u8], new: &str) -> Option<Vec<u8>> {
        let source = Source::new("x", bytes.to_vec());
        let start = source.text().find("12").unwrap();
        Some(source.replaced(&[(0..0, ""), (start..start + 2, new)])?.bytes().into_owned())
    }

    #[test]
    fn only_the_bytes_of_the_replacement_change() {
        assert_eq!(fixed("ä\r\n12\rb\n".as_bytes(), "7").unwrap(), "ä\r\n7\rb\n".as_bytes());
        assert_eq!(fixed(b"\xef\xbb\xbfa=12\r\n", "").unwrap(), b"\xef\xbb\xbfa=\r\n");
        assert_eq!(fixed(b"\xe4\x81=12\xe4\n", "\u{20ac}").unwrap(), b"\xe4\x81=\x80\xe4\n");
        assert_eq!(fixed(b"\xef\xbb\xbf\xe4=12", "7").unwrap(), b"\xef\xbb\xbf\xe4=7");
        for order in [u16::to_le_bytes as fn(u16) -> [u8; 2], u16::to_be_bytes] {
            let encoded = |text: &str| text.encode_utf16().flat_map(order).collect::<Vec<u8>>();
            for mark in ["\u{feff}", "<?xml?>"] {
                let old = encoded(&format!("{mark}\u{1f600}=12\r\n"));
                assert_eq!(fixed(&old, "ä").unwrap(), encoded(&format!("{mark}\u{1f600}=ä\r\n")));
            }
        }
        let head = b"<?xml version='1.0' encoding='Shift_JIS'?>";
        let file = |value: &[u8]| [head, &b"\x93\xfa\xb1="[..], value, b"\x93\xfa\r\n"].concat();
        assert_eq!(fixed(&file(b"12"), "\u{65e5}7").unwrap(), file(b"\x93\xfa7"));
    }

    #[test]
    fn what_cannot_be_written_is_refused() {
        assert_eq!(fixed(b"\xe4=12", "\u{65e5}"), None);
        let source = Source::new("x", "äb".into());
        for ranges in [&[(1..2, "")][..], &[(0..9, "")], &[(2..3, ""), (0..2, "")], &[(0..3, ""), (2..3, "")]] {
            assert!(source.replaced(ranges).is_none(), "{ranges:?}");
        }
        // Without the first byte, the file is valid UTF-8, so it would be decoded to another text.
        let source = Source::new("x", b"\xe4\xc3\xa4".to_vec());
        assert_eq!((source.text(), source.replaced(&[(0..2, "")]).is_none()), ("äÃ¤", true));
    }
}
