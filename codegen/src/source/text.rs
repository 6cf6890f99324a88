//! A description file as text, with the line and column of each byte offset.

use std::borrow::Cow;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use super::decode;
use super::digest::Content;
use super::{Digest, Encoding, Position, Span};

/// One input file, decoded to UTF-8 with its byte order mark removed.
#[derive(Clone, Debug)]
pub struct Source {
    name: String,
    content: Arc<Content>,
    /// Folder of the files to which this source refers.
    pub(super) folder: Option<PathBuf>,
    /// Numbers of line ends and characters before each multiple of [`STRIDE`] bytes. A list of all lines would need up to a fifth
    /// of the size of the text.
    counts: OnceLock<Vec<Counts>>,
}

/// Numbers of line ends and characters in a part of the text.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    line_ends: u32,
    characters: u32,
}

/// Number of bytes between two entries of the list of counts.
const STRIDE: usize = 1024;

/// Maximum size of an input in bytes. The size is limited because spans contain 32-bit offsets into the decoded text, which can be
/// longer than the input.
pub const MAX_INPUT_BYTES: usize = u32::MAX as usize / 4;

fn too_large() -> std::io::Error {
    let message = format!("the file exceeds the maximum of {MAX_INPUT_BYTES} bytes");
    std::io::Error::new(std::io::ErrorKind::FileTooLarge, message)
}

impl Source {
    /// Decodes `bytes`; `name` is the file name in diagnostics.
    ///
    /// Decoding never fails. A file that is neither UTF-8 nor UTF-16 is read in the encoding that its XML declaration names.
    /// Without such an encoding, the file is read as Windows-1252, in which every byte is a character. [`Source::encoding`] returns
    /// the encoding that was used.
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Source {
            name: name.into(),
            content: Content::new(decode::decode(bytes)),
            folder: None,
            counts: OnceLock::new(),
        }
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// Returns the error of the operating system, `FileTooLarge` above [`MAX_INPUT_BYTES`], or `InvalidInput` for a
    /// pipe or a device.
    pub fn read(path: &Path) -> std::io::Result<Self> {
        Source::read_from(path, path)
    }

    /// Reads the file at `location`. Diagnostics show the name `path`.
    pub(super) fn read_from(location: &Path, path: &Path) -> std::io::Result<Self> {
        // Reading a pipe or a device may never end.
        if crate::output::is_no_regular_file(location) {
            return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is not a regular file"));
        }
        let file = std::fs::File::open(location)?;
        // Memory for the whole file is reserved at once. The file is read completely even if its reported length is
        // wrong or unknown.
        let length = file.metadata().map_or(0, |metadata| metadata.len());
        if length > MAX_INPUT_BYTES as u64 {
            return Err(too_large());
        }
        let mut bytes = Vec::with_capacity(length as usize + 1);
        file.take(MAX_INPUT_BYTES as u64 + 1).read_to_end(&mut bytes)?;
        if bytes.len() > MAX_INPUT_BYTES {
            return Err(too_large());
        }
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        Ok(Source::new(path.to_string_lossy(), bytes).in_folder(folder))
    }

    /// Sets the folder of the files that the source refers to. [`Source::read`] sets this folder to that of the file.
    pub fn in_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = Some(folder.into());
        self
    }

    /// Returns the folder of the files that the source refers to, if this folder is known.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Returns the encoding name in the XML declaration, as written.
    pub fn declared_encoding(&self) -> Option<&str> {
        decode::declared(self.text().as_bytes())
    }

    /// Returns the name that the WHATWG Encoding Standard defines for the encoding in the XML declaration, such as `UTF-8`
    /// or `windows-1252`. Returns `None` if the declaration names no encoding or an unsupported encoding.
    pub fn declared_charset(&self) -> Option<&'static str> {
        self.declared_encoding().and_then(decode::charset)
    }

    /// Returns the file name that diagnostics show.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the decoded text.
    pub fn text(&self) -> &str {
        &self.content.decoded.text
    }

    /// Returns the encoding from which the bytes were decoded.
    pub fn encoding(&self) -> Encoding {
        self.content.decoded.encoding
    }

    /// Returns whether some bytes were invalid in the encoding. In the text, U+FFFD replaces invalid bytes.
    pub fn has_lost_bytes(&self) -> bool {
        self.content.decoded.has_lost
    }

    /// Returns the bytes as read.
    pub fn bytes(&self) -> Cow<'_, [u8]> {
        self.content.decoded.bytes()
    }

    /// Returns whether the file starts with a UTF-8 byte order mark but is not UTF-8.
    pub fn has_wrong_mark(&self) -> bool {
        self.encoding() == Encoding::Windows1252 && self.content.decoded.original.is_some()
    }

    /// Returns the SHA-256 of the bytes as read, in lower-case hexadecimal.
    pub fn sha256(&self) -> &str {
        self.content.sha256()
    }

    /// Returns the SHA-256 as a digest that is computed on first use.
    pub fn digest(&self) -> Digest {
        Digest::of(&self.content)
    }

    /// Returns the text of `span`, or an empty text if the span is outside this source.
    pub fn slice(&self, span: Span) -> &str {
        self.text().get(span.range()).unwrap_or("")
    }

    /// Returns line and column of a byte offset into the text.
    ///
    /// CR LF, LF and a single CR each end a line.
    pub fn position(&self, offset: u32) -> Position {
        let (line, start) = self.line_start(offset as usize);
        let end = (offset as usize).clamp(start, self.text().len());
        let column = self.characters_before(end) - self.characters_before(start);
        Position { line, column: column + 1 }
    }

    /// Returns the line number of [`Source::position`] without counting characters.
    pub fn line_at(&self, offset: u32) -> u32 {
        self.line_start(offset as usize).0
    }

    /// Returns the number of characters that begin before the byte `offset`.
    fn characters_before(&self, offset: usize) -> u32 {
        let (at, before) = self.counts_before(offset);
        before.characters + characters(&self.text().as_bytes()[at..offset])
    }

    /// Returns the text of line `line` (counted from 1) without its line end, or an empty text if there is no such line.
    pub fn line(&self, line: u32) -> &str {
        let Some(start) = self.start_of_line(line.max(1)) else { return "" };
        let length = self.text().len();
        let end = self.line_starts(start..length).next().unwrap_or(length);
        self.text()[start..end].trim_end_matches(['\r', '\n'])
    }

    /// Returns the number of the line that contains the byte `offset`, and the offset of the start of this line.
    fn line_start(&self, offset: usize) -> (u32, usize) {
        let (at, before) = self.counts_before(offset);
        let starts = self.line_starts(at..offset.min(self.text().len()));
        let (count, start) = starts.fold((0, None), |(count, _), start| (count + 1, Some(start)));
        let line = before.line_ends + count + 1;
        (line, start.or_else(|| self.start_of_line(line)).unwrap_or(0))
    }

    /// Returns the offset of the start of a line, or `None` if there is no such line.
    fn start_of_line(&self, line: u32) -> Option<usize> {
        let Some(last) = line.checked_sub(2) else { return Some(0) };
        // The line starts after the line end number `last + 1`. The search starts at the last entry that does not count
        // this line end.
        let part = self.counts().partition_point(|counts| counts.line_ends <= last).saturating_sub(1);
        let before = self.counts()[part].line_ends;
        self.line_starts(part * STRIDE..self.text().len()).nth((last - before) as usize)
    }

    /// Returns the offsets after the line ends in a part of the text. CR LF is one line end.
    fn line_starts(&self, part: Range<usize>) -> impl Iterator<Item = usize> + '_ {
        let (bytes, at) = (self.text().as_bytes(), part.start);
        let ends = memchr::memchr2_iter(b'\n', b'\r', &bytes[part]).map(move |end| at + end);
        ends.filter(|&end| bytes[end] == b'\n' || bytes.get(end + 1) != Some(&b'\n')).map(|end| end + 1)
    }

    /// Returns the largest multiple of [`STRIDE`] up to `offset`, and the counts before this multiple.
    fn counts_before(&self, offset: usize) -> (usize, Counts) {
        let entry = (offset / STRIDE).min(self.counts().len() - 1);
        (entry * STRIDE, self.counts()[entry])
    }

    fn counts(&self) -> &[Counts] {
        self.counts.get_or_init(|| {
            let bytes = self.text().as_bytes();
            let mut total = Counts::default();
            let parts = bytes.chunks_exact(STRIDE).enumerate().map(|(number, part)| {
                let after = |at: usize| bytes.get(number * STRIDE + at + 1);
                let returns = memchr::memchr_iter(b'\r', part).filter(|&at| after(at) != Some(&b'\n')).count();
                total.line_ends += (memchr::memchr_iter(b'\n', part).count() + returns) as u32;
                total.characters += characters(part);
                total
            });
            std::iter::once(Counts::default()).chain(parts).collect()
        })
    }
}

/// Returns the number of characters that begin in `bytes`.
fn characters(bytes: &[u8]) -> u32 {
    if bytes.is_ascii() {
        return bytes.len() as u32;
    }
    bytes.iter().filter(|&&byte| byte & 0xC0 != 0x80).count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_and_every_kind_of_line_end() {
        let source = Source::new("x.eds", "a\r\nb\rGerät=1\nz".as_bytes().to_vec());
        assert_eq!(source.position(0), Position { line: 1, column: 1 });
        assert_eq!(source.position(3), Position { line: 2, column: 1 });
        assert_eq!(source.position(5), Position { line: 3, column: 1 });
        let equals = source.text().find('=').unwrap() as u32;
        assert_eq!(source.position(equals), Position { line: 3, column: 6 });
        assert_eq!(source.line(3), "Gerät=1");
        assert_eq!(source.line(4), "z");
        assert_eq!(source.line(9), "");
        let long = Source::new("x.xdd", "ä".repeat(5000).into_bytes());
        assert_eq!(long.position(2 * 4321), Position { line: 1, column: 4322 });
        assert_eq!(long.position(10_000), Position { line: 1, column: 5001 });
    }

    #[test]
    fn positions_in_long_texts_are_those_of_a_list_of_lines() {
        for line_end in ["\n", "\r", "\r\n"] {
            // Lines of 0 to 70 characters, then some lines that are longer than `STRIDE` bytes.
            let lengths =
                (0..5 * STRIDE).map(|number| number % 71).chain([STRIDE - 1, 3 * STRIDE, 2 * STRIDE + 1, 0, 5]);
            let lines: Vec<String> =
                lengths.map(|length| "\u{e4}a".repeat(length / 2) + &"z".repeat(length % 2)).collect();
            let source = Source::new("x.xml", lines.join(line_end).into_bytes());
            let mut start = 0;
            for (number, line) in (1..).zip(&lines) {
                assert_eq!(source.line(number), line);
                for (offset, column) in [(0, 1), (line.len(), line.chars().count() as u32 + 1)] {
                    assert_eq!(source.position((start + offset) as u32), Position { line: number, column });
                }
                start += line.len() + line_end.len();
            }
            let last = lines.len() as u32;
            assert_eq!((source.line(last + 1), source.line_at(u32::MAX)), ("", last));
        }
    }

    #[test]
    fn digest_is_of_the_original_bytes() {
        let utf8 = Source::new("a", b"abc".to_vec());
        assert_eq!(utf8.sha256(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        let latin = Source::new("a", b"\xfc".to_vec());
        assert_eq!(latin.text(), "ü");
        assert_eq!(&*latin.bytes(), b"\xfc");
    }
}
