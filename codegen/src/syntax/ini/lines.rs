//! Finds lines, and trims and counts them.

use crate::syntax::words;

/// Bytes `start..end` of the text. The file number is left out to keep the lists small.
pub(super) type Range = (u32, u32);

pub(super) fn range(start: usize, end: usize) -> Range {
    (start as u32, end as u32)
}

/// Iterator over the lines of a part of the text.
#[derive(Clone, Debug)]
pub(super) struct Lines<'a> {
    /// The text without the blanks, line ends, zeros and Ctrl-Z at its end.
    pub bytes: &'a [u8],
    /// Offset of the next line.
    pub at: usize,
    /// Offset of the end of the part: the start of a line, or the end of the text.
    pub end: usize,
    /// Number of the next line, counted from 1.
    pub line: u32,
}

/// A line without its line end: the text before the first `=`, and the text after it.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub start: usize,
    pub key: &'a [u8],
    pub value: Option<&'a [u8]>,
    pub number: u32,
}

impl<'a> Lines<'a> {
    #[inline(always)]
    pub fn next(&mut self) -> Option<Line<'a>> {
        // Empty lines are frequent.
        while self.at < self.end && self.bytes.get(self.at) == Some(&b'\n') {
            (self.at, self.line) = (self.at + 1, self.line + 1);
        }
        if self.at >= self.end {
            return None;
        }
        let (start, number) = (self.at, self.line);
        let rest = self.bytes.get(start..)?;
        let (key, mut rest) =
            rest.split_at_checked(words::find(rest, |word| words::equal(word, b'=') | line_end(word)))?;
        let mut value = None;
        if let [b'=', text @ ..] = rest {
            let (text, below) = text.split_at_checked(words::find(text, line_end))?;
            (value, rest) = (Some(text), below);
        }
        self.at = self.bytes.len() - rest.len() + line_end_length(rest);
        self.line += 1;
        Some(Line { start, key, value, number })
    }
}

impl Line<'_> {
    /// Returns the offset of the end of the line.
    pub fn end(&self) -> usize {
        self.start + self.key.len() + self.value.map_or(0, |value| 1 + value.len())
    }
}

/// Returns a mask of the line ends in a word, as [`words::equal`] does.
#[inline(always)]
pub(super) fn line_end(word: u64) -> u64 {
    // Most words contain no control character.
    if words::less(word, b' ') == 0 {
        return 0;
    }
    words::equal(word, b'\n') | words::equal(word, b'\r')
}

/// Returns the length of the line end at the start of `rest`: 2 for CR LF, otherwise 1, also at the end of the text.
#[inline(always)]
pub(super) fn line_end_length(rest: &[u8]) -> usize {
    if rest.starts_with(b"\r\n") {
        2
    } else {
        1
    }
}

/// Counts the bytes that equal `byte`. For a short text, this function is faster than the one of `memchr`.
fn count(bytes: &[u8], byte: u8) -> u32 {
    bytes.chunks(255).map(|chunk| u32::from(chunk.iter().map(|&other| u8::from(other == byte)).sum::<u8>())).sum()
}

/// Counts the line ends in `bytes`: CR LF, LF and single CR. `has_returns` states whether the text contains any CR.
pub(super) fn line_ends(bytes: &[u8], has_returns: bool) -> u32 {
    let feeds = count(bytes, b'\n');
    if !has_returns {
        return feeds;
    }
    let both = memchr::memchr_iter(b'\n', bytes).filter(|&at| bytes[..at].ends_with(b"\r")).count();
    feeds + count(bytes, b'\r') - both as u32
}

/// Returns the range of `text`, which starts at `start`, without the spaces and tabs at both ends.
#[inline(always)]
pub(super) fn trimmed(start: usize, text: &[u8]) -> Range {
    let text = trim_end(text);
    let end = start + text.len();
    range(end - trim_start(text).len(), end)
}

#[inline(always)]
pub(super) fn trim_start(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t', rest @ ..] = text {
        text = rest;
    }
    text
}

#[inline(always)]
pub(super) fn trim_end(mut text: &[u8]) -> &[u8] {
    while let [rest @ .., b' ' | b'\t'] = text {
        text = rest;
    }
    text
}
