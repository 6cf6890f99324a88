//! Finds the ends of tokens. All delimiters are ASCII characters, so each result is a character boundary.

use memchr::{memchr, memmem};

use crate::syntax::words;

/// Length of a name with its prefix, and position of the colon after the prefix, in bytes.
#[derive(Clone, Copy)]
pub(super) struct Name {
    pub length: usize,
    colon: Option<usize>,
}

/// Bytes with this value or a higher value, such as letters, never end a name.
const LETTER: u8 = b'@';

impl Name {
    /// Returns the name at the start of `text`, up to white space, a quotation mark or one of the characters `=/><&`.
    /// Returns `None` if `text` does not start with a name.
    pub fn of(text: &str) -> Option<Self> {
        let bytes = text.as_bytes();
        let starts = |byte: u8| byte.is_ascii_alphabetic() || byte >= 0x80 || matches!(byte, b'_' | b':');
        if !bytes.first().copied().is_some_and(starts) {
            return None;
        }
        let (mut length, mut colon) = (0, None);
        while let Some(&byte) = bytes.get(length) {
            match byte {
                b' ' | b'\t' | b'\n' | b'\r' | b'=' | b'/' | b'>' | b'"' | b'\'' | b'<' | b'&' => break,
                b':' if colon.is_none() => colon = Some(length),
                // Bytes from `LETTER` upward never end a name, so up to eight such bytes are skipped at once.
                LETTER.. => {
                    if let Some(word) = bytes.get(length..length + 8) {
                        let others = words::less(words::word(word), LETTER);
                        length += if others == 0 { 8 } else { words::first(others) };
                        continue;
                    }
                }
                _ => {}
            }
            length += 1;
        }
        Some(Name { length, colon })
    }

    /// Splits the name into prefix and local name. `full` is the text of the name.
    pub fn split(self, full: &str) -> (&str, &str) {
        self.colon.map_or(("", full), |colon| (&full[..colon], &full[colon + 1..]))
    }
}

pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

/// Returns the offset of the first byte at or after `at` that is not white space.
pub(super) fn after_blanks(bytes: &[u8], at: usize) -> usize {
    let mut rest = bytes.get(at..).unwrap_or(&[]);
    while let [byte, after @ ..] = rest {
        if !is_blank(*byte) {
            break;
        }
        rest = after;
        // Indentation is skipped eight bytes at once.
        while let Some(after) = rest.strip_prefix(b"        ") {
            rest = after;
        }
    }
    bytes.len() - rest.len()
}

/// Returns the position of the first occurrence of `byte`. Most positions are near, and a loop finds them faster than a
/// vectorized search.
pub(super) fn find_near(byte: u8, bytes: &[u8]) -> Option<usize> {
    const NEAR: usize = 16;
    let near = &bytes[..bytes.len().min(NEAR)];
    match near.iter().position(|&other| other == byte) {
        None if bytes.len() > NEAR => memchr(byte, &bytes[NEAR..]).map(|at| at + NEAR),
        found => found,
    }
}

/// Length of an attribute value up to its closing quotation mark, and whether the value needs decoding.
#[derive(Clone, Copy)]
pub(super) struct Value {
    pub length: usize,
    /// True if the value needs no decoding: it has no reference and no control character.
    pub plain: bool,
}

impl Value {
    /// Measures the value at the start of `bytes`. Returns `None` if the closing quotation mark `quote` is missing. Compares eight
    /// bytes at once.
    #[inline]
    pub fn of(quote: u8, bytes: &[u8]) -> Option<Self> {
        let marks = |word: u64| words::equal(word, b'&') | words::less(word, b' ');
        let mut plain = true;
        let mut chunks = bytes.chunks_exact(8);
        for (number, chunk) in chunks.by_ref().enumerate() {
            let word = words::word(chunk);
            let end = words::equal(word, quote);
            if end != 0 {
                let before = (end & end.wrapping_neg()) - 1;
                plain &= marks(word) & before == 0;
                return Some(Value { length: number * 8 + words::first(end), plain });
            }
            plain &= marks(word) == 0;
        }
        let rest = chunks.remainder();
        let length = rest.iter().position(|&byte| byte == quote)?;
        plain &= rest[..length].iter().all(|&byte| byte >= b' ' && byte != b'&');
        Some(Value { length: bytes.len() - rest.len() + length, plain })
    }
}

/// Returns the offset after the first occurrence of `end` at or after `at`, or `None` if there is none.
pub(super) fn after(bytes: &[u8], at: usize, end: &str) -> Option<usize> {
    let rest = bytes.get(at..)?;
    Some(at + memmem::find(rest, end.as_bytes())? + end.len())
}

/// Returns the offset of the `>` that ends a start tag, and whether the tag contains a `<` after `from`. Returns `None` if there is no
/// such `>`. `from` is the offset after the element name.
pub(super) fn tag_end(bytes: &[u8], from: usize) -> Option<(usize, bool)> {
    if bytes.get(from) == Some(&b'>') {
        return Some((from, false));
    }
    let end = from + memchr(b'>', bytes.get(from..)?)?;
    if has_only_pairs_of_quotes(&bytes[from..end]) {
        return Some((end, false));
    }
    let mut at = from;
    loop {
        match bytes.get(at)? {
            b'>' => return Some((at, memchr(b'<', &bytes[from..at]).is_some())),
            quote @ (b'"' | b'\'') => at += memchr(*quote, &bytes[at + 1..])? + 2,
            _ => at += 1,
        }
    }
}

/// Returns whether `bytes` contain an even number of double quotation marks, but no single quotation mark and no `<`. If so, the `>`
/// after `bytes` ends the tag. The loop has no early exit, which allows vectorization.
fn has_only_pairs_of_quotes(bytes: &[u8]) -> bool {
    let (odd, others) = bytes.iter().fold((0u8, 0u8), |(odd, others), &byte| {
        (odd ^ u8::from(byte == b'"'), others | u8::from(byte == b'\'') | u8::from(byte == b'<'))
    });
    odd | others == 0
}

/// Returns the offset after a document type declaration, which may contain other declarations.
pub(super) fn after_doctype(bytes: &[u8], start: usize) -> Option<usize> {
    let (mut at, mut depth) = (start, 0usize);
    loop {
        match bytes.get(at)? {
            b'<' if bytes[at..].starts_with(b"<!--") => {
                at = after(bytes, at + 4, "-->")?;
                continue;
            }
            b'<' => depth += 1,
            b'>' if depth <= 1 => return Some(at + 1),
            b'>' => depth -= 1,
            quote @ (b'"' | b'\'') => at += memchr(*quote, &bytes[at + 1..])? + 1,
            _ => {}
        }
        at += 1;
    }
}
