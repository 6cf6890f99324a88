//! From bytes to text: byte order marks, UTF-8, UTF-16 and Windows-1252.

use encoding_rs::{Encoding as Charset, UTF_16BE, UTF_16LE, WINDOWS_1252};
use serde::{Deserialize, Serialize};

/// How a file's bytes were turned into text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Encoding {
    /// Only ASCII, or valid UTF-8 without a byte order mark.
    #[serde(rename = "utf-8")]
    Utf8,
    /// UTF-8 that starts with a byte order mark.
    #[serde(rename = "utf-8-bom")]
    Utf8Bom,
    /// UTF-16, recognised by its byte order mark.
    #[serde(rename = "utf-16")]
    Utf16,
    /// Not UTF-8: every byte read as Windows-1252, which contains ISO 8859-1.
    #[serde(rename = "windows-1252")]
    Windows1252,
}

impl Encoding {
    /// The name that `lexibus info` prints.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Utf8 => "utf-8",
            Encoding::Utf8Bom => "utf-8-bom",
            Encoding::Utf16 => "utf-16",
            Encoding::Windows1252 => "windows-1252",
        }
    }
}

/// Text, its encoding, and the bytes as read where they differ from the text's.
pub(super) fn decode(bytes: Vec<u8>) -> (String, Encoding, Option<Vec<u8>>) {
    if let Some(rest) = bytes.strip_prefix(b"\xef\xbb\xbf") {
        let text = match std::str::from_utf8(rest) {
            Ok(text) => text.to_owned(),
            Err(_) => WINDOWS_1252.decode_without_bom_handling(rest).0.into_owned(),
        };
        return (text, Encoding::Utf8Bom, Some(bytes));
    }
    for (mark, charset) in [(b"\xff\xfe", UTF_16LE), (b"\xfe\xff", UTF_16BE)] {
        if let Some(rest) = bytes.strip_prefix(mark) {
            let text = with(charset, rest);
            return (text, Encoding::Utf16, Some(bytes));
        }
    }
    match String::from_utf8(bytes) {
        Ok(text) => (text, Encoding::Utf8, None),
        Err(error) => {
            let bytes = error.into_bytes();
            let text = with(WINDOWS_1252, &bytes);
            (text, Encoding::Windows1252, Some(bytes))
        }
    }
}

fn with(charset: &'static Charset, bytes: &[u8]) -> String {
    charset.decode_without_bom_handling(bytes).0.into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_stripped_and_bytes_that_are_not_utf8_are_cp1252() {
        assert_eq!(decode(b"\xef\xbb\xbfa".to_vec()).0, "a");
        assert_eq!(decode(b"\xff\xfea\0".to_vec()), ("a".into(), Encoding::Utf16, Some(b"\xff\xfea\0".to_vec())));
        let (text, encoding, _) = decode(b"Ger\xe4t \x80".to_vec());
        assert_eq!((text.as_str(), encoding), ("Gerät €", Encoding::Windows1252));
        assert_eq!(decode("µ".as_bytes().to_vec()).1, Encoding::Utf8);
    }
}
