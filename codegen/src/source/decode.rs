//! Decodes bytes to text. Handles byte order marks, UTF-8, UTF-16, encodings of XML declarations, and Windows-1252.

use std::borrow::Cow;

use encoding_rs::{CoderResult, Encoding as Charset, UTF_16BE, UTF_16LE, UTF_8, WINDOWS_1252};

/// The byte order mark of UTF-8.
pub(super) const MARK: &[u8] = b"\xef\xbb\xbf";

/// Number of free bytes in the decoded text that is sufficient for any character.
const ROOM: usize = 16;

/// The encoding from which a file's bytes were decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Encoding {
    /// ASCII, or valid UTF-8 without a byte order mark.
    #[cfg_attr(feature = "serde", serde(rename = "utf-8"))]
    Utf8,
    /// UTF-8 that starts with a byte order mark.
    #[cfg_attr(feature = "serde", serde(rename = "utf-8-bom"))]
    Utf8Bom,
    /// UTF-16, recognized by its byte order mark or by the zero bytes of its first characters.
    #[cfg_attr(feature = "serde", serde(rename = "utf-16"))]
    Utf16,
    /// Not UTF-8: every byte was read as Windows-1252, which contains the printable characters of ISO 8859-1.
    #[cfg_attr(feature = "serde", serde(rename = "windows-1252"))]
    Windows1252,
    /// Not UTF-8: the XML declaration names another encoding, such as GB2312 or Shift JIS.
    #[cfg_attr(feature = "serde", serde(rename = "declared"))]
    Declared,
}

impl Encoding {
    /// Returns the name that `lexibus info` prints.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Utf8 => "utf-8",
            Encoding::Utf8Bom => "utf-8-bom",
            Encoding::Utf16 => "utf-16",
            Encoding::Windows1252 => "windows-1252",
            Encoding::Declared => "declared",
        }
    }
}

/// Result of decoding a file's bytes.
#[derive(Debug)]
pub(super) struct Decoded {
    pub text: String,
    pub encoding: Encoding,
    /// The bytes as read, if [`encode`] does not reproduce these bytes from the text.
    pub original: Option<Vec<u8>>,
    /// True if some bytes are invalid in the encoding.
    pub has_lost: bool,
}

impl Decoded {
    /// Returns the bytes of the file as read.
    pub fn bytes(&self) -> Cow<'_, [u8]> {
        self.original.as_deref().map_or_else(|| encode(&self.text, self.encoding), Cow::Borrowed)
    }
}

/// Decodes bytes to text.
pub(super) fn decode(mut bytes: Vec<u8>) -> Decoded {
    let decoded = |(text, has_lost), encoding, original| Decoded { text, encoding, original: Some(original), has_lost };
    if bytes.starts_with(MARK) {
        if std::str::from_utf8(&bytes[MARK.len()..]).is_err() {
            return decoded(with(WINDOWS_1252, &bytes[MARK.len()..]), Encoding::Windows1252, bytes);
        }
        bytes.drain(..MARK.len());
        let text = String::from_utf8(bytes).unwrap_or_default();
        return Decoded { text, encoding: Encoding::Utf8Bom, original: None, has_lost: false };
    }
    for (mark, charset) in [(b"\xff\xfe", UTF_16LE), (b"\xfe\xff", UTF_16BE)] {
        if let Some(rest) = bytes.strip_prefix(mark) {
            let text = with(charset, rest);
            return decoded(text, Encoding::Utf16, bytes);
        }
    }
    // An XML file in UTF-16 without a byte order mark starts with the characters `<?` (XML 1.0, appendix F).
    for (start, charset) in [(b"<\0?\0", UTF_16LE), (b"\0<\0?", UTF_16BE)] {
        if bytes.starts_with(start) {
            return decoded(with(charset, &bytes), Encoding::Utf16, bytes);
        }
    }
    match String::from_utf8(bytes) {
        Ok(text) => Decoded { text, encoding: Encoding::Utf8, original: None, has_lost: false },
        Err(error) => {
            let bytes = error.into_bytes();
            let declared = declared(&bytes).and_then(|label| Charset::for_label(label.as_bytes()));
            let charset = declared.filter(|charset| charset.is_ascii_compatible() && *charset != UTF_8);
            let charset = charset.unwrap_or(WINDOWS_1252);
            if charset != WINDOWS_1252 {
                return decoded(with(charset, &bytes), Encoding::Declared, bytes);
            }
            // The original bytes are not kept, because each byte of Windows-1252 is one character and each such
            // character is one byte.
            let (text, has_lost) = with(WINDOWS_1252, &bytes);
            Decoded { text, encoding: Encoding::Windows1252, original: None, has_lost }
        }
    }
}

/// Encodes a text in UTF-8, with or without a byte order mark, or in Windows-1252.
fn encode(text: &str, encoding: Encoding) -> Cow<'_, [u8]> {
    match encoding {
        Encoding::Utf8Bom => Cow::Owned([MARK, text.as_bytes()].concat()),
        Encoding::Windows1252 => WINDOWS_1252.encode(text).0,
        Encoding::Utf8 | Encoding::Utf16 | Encoding::Declared => Cow::Borrowed(text.as_bytes()),
    }
}

/// Returns the encoding name in the XML declaration at the start of `bytes`.
pub(super) fn declared(bytes: &[u8]) -> Option<&str> {
    const LOOK_AHEAD: usize = 512;
    let head = bytes.trim_ascii_start().strip_prefix(b"<?xml")?;
    let head = &head[..head.len().min(LOOK_AHEAD)];
    let end = memchr::memmem::find(head, b"?>")?;
    let declaration = std::str::from_utf8(&head[..end]).ok()?;
    let (_, rest) = declaration.split_once("encoding")?;
    let rest = rest.trim_start().strip_prefix('=')?.trim_start();
    let quote = rest.chars().next().filter(|letter| matches!(letter, '"' | '\''))?;
    rest[1..].split_once(quote).map(|(label, _)| label.trim())
}

/// Returns the name that the WHATWG Encoding Standard defines for the encoding `label`.
pub(super) fn charset(label: &str) -> Option<&'static str> {
    Charset::for_label(label.as_bytes()).map(Charset::name)
}

/// Returns the decoded text, and whether some bytes are invalid in the encoding.
fn with(charset: &'static Charset, bytes: &[u8]) -> (String, bool) {
    let mut decoder = charset.new_decoder_without_bom_handling();
    // Most characters have no more bytes in UTF-8 than in the input. In the worst case, the text has three times as many bytes as
    // the input.
    let mut text = String::with_capacity(bytes.len() + bytes.len() / 32 + ROOM);
    let (mut rest, mut has_lost) = (bytes, false);
    loop {
        let (result, read, lost) = decoder.decode_to_string(rest, &mut text, true);
        (rest, has_lost) = (&rest[read..], has_lost || lost);
        if result == CoderResult::InputEmpty {
            text.shrink_to_fit();
            return (text, has_lost);
        }
        text.reserve(rest.len() / 4 + ROOM);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(bytes: Vec<u8>) -> (String, Encoding, Option<Vec<u8>>) {
        let Decoded { text, encoding, original, .. } = super::decode(bytes.clone());
        // The decoded file either keeps the original bytes or can reproduce them from the text.
        assert_eq!(original.as_deref().unwrap_or(&encode(&text, encoding)), bytes);
        (text, encoding, original)
    }

    #[test]
    fn marks_are_stripped_and_bytes_that_are_not_utf8_are_cp1252() {
        assert_eq!(decode(b"\xef\xbb\xbfa".to_vec()).0, "a");
        assert_eq!(decode(b"\xff\xfea\0".to_vec()), ("a".into(), Encoding::Utf16, Some(b"\xff\xfea\0".to_vec())));
        for (start, order) in [(b'<', u16::to_le_bytes as fn(u16) -> [u8; 2]), (0, u16::to_be_bytes)] {
            let bytes: Vec<u8> = "<?xml?><ä/>".encode_utf16().flat_map(order).collect();
            assert_eq!(
                (bytes[0], decode(bytes.clone())),
                (start, ("<?xml?><ä/>".into(), Encoding::Utf16, Some(bytes)))
            );
        }
        let (text, encoding, _) = decode(b"Ger\xe4t \x80".to_vec());
        assert_eq!((text.as_str(), encoding), ("Gerät €", Encoding::Windows1252));
        assert_eq!(decode("µ".as_bytes().to_vec()).1, Encoding::Utf8);
        assert_eq!(decode(b"\xef\xbb\xbf\xe4".to_vec()).1, Encoding::Windows1252);
        assert_eq!(decode((0..=255).collect()).1, Encoding::Windows1252);
    }

    #[test]
    fn what_xml_declares_counts_where_the_bytes_are_no_utf8() {
        let decoded = |declared: &str, rest: &[u8]| {
            let mut bytes = format!("<?xml version='1.0' encoding='{declared}'?>").into_bytes();
            let start = bytes.len();
            bytes.extend(rest);
            let (text, encoding, _) = decode(bytes);
            (text[start..].to_owned(), encoding)
        };
        for name in ["ISO-8859-1", "iso8859-1", "windows-1252", "utf-8", "klingon", ""] {
            assert_eq!(decoded(name, b"\xe4\x80"), ("ä€".into(), Encoding::Windows1252), "{name}");
        }
        assert_eq!(decoded("iso-8859-1", "ä".as_bytes()), ("ä".into(), Encoding::Utf8));
        assert_eq!(decoded("GB2312", b"\xd6\xd0"), ("中".into(), Encoding::Declared));
        assert_eq!(decoded("Shift_JIS", b"\x93\xfa"), ("日".into(), Encoding::Declared));
        assert_eq!(declared(b" <?xml version=\"1.0\" encoding = \"x\" ?>"), Some("x"));
        assert_eq!(declared(b"<?xml version=\"1.0\"?> encoding='x'"), None);
    }
}
