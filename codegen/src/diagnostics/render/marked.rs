//! Position of a span in a file, with offsets that are safe for slicing.

use std::ops::Range;

use crate::source::{Position, Source, Span};

/// Maximum number of characters of a displayed line. Longer lines are shortened.
pub const MAX_CHARS: usize = 200;

/// Number of characters before the mark that a shortened line keeps.
const CHARS_BEFORE: usize = 60;

/// A source file with its marked part.
#[derive(Clone, Copy)]
pub struct MarkedSource<'a> {
    /// The source file.
    pub source: &'a Source,
    /// Marked part of the file; `None` for the whole file.
    pub mark: Option<Mark>,
}

/// The marked part of a file.
#[derive(Clone, Copy)]
pub struct Mark {
    /// Offset of the first byte: within the file and on a character boundary.
    pub start: usize,
    /// Offset after the last byte: not before `start`, within the file and on a character boundary.
    pub end: usize,
    /// Line and column of `start`.
    pub from: Position,
    /// Line and column of `end`.
    pub to: Position,
}

impl<'a> MarkedSource<'a> {
    /// Returns whether [`MarkedSource::of`] returns `Some`, without computing the position.
    pub fn exists(span: Span, sources: &[Source]) -> bool {
        (span.file.0 as usize) < sources.len()
    }

    /// Returns the file and position of `span`, or `None` if its file is not among `sources`.
    pub fn of(span: Span, sources: &'a [Source]) -> Option<Self> {
        let source = sources.get(span.file.0 as usize)?;
        if span.is_empty() {
            return Some(MarkedSource { source, mark: None });
        }
        let text = source.text();
        let (mut start, mut end) = (text.len().min(span.start as usize), text.len().min(span.end as usize));
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        while !text.is_char_boundary(end) {
            end += 1;
        }
        let from = source.position(start as u32);
        let to = end_position(source, start..end, from);
        Some(MarkedSource { source, mark: Some(Mark { start, end, from, to }) })
    }
}

/// Returns the position of the end of `marked`, which starts at `from`.
///
/// If the marked text is on one line, counts only its characters. The part of the line before the mark is often longer,
/// because a file can be one long line.
fn end_position(source: &Source, marked: Range<usize>, from: Position) -> Position {
    let text = &source.text()[marked.clone()];
    match memchr::memchr2(b'\r', b'\n', text.as_bytes()) {
        Some(_) => source.position(marked.end as u32),
        None => Position { line: from.line, column: from.column + text.chars().count() as u32 },
    }
}

/// Returns the text of a line and the offset of its start in the file.
pub fn line(source: &Source, number: u32) -> (&str, usize) {
    let line = source.line(number);
    // The line is a part of the file's text, so the difference of both pointers is the offset of the line.
    (line, (line.as_ptr() as usize).saturating_sub(source.text().as_ptr() as usize))
}

/// Returns the byte range of the part of `line` to show. This part contains the offset `at`, which is on a character boundary.
pub fn shown(line: &str, at: usize) -> Range<usize> {
    if line.chars().nth(MAX_CHARS).is_none() {
        return 0..line.len();
    }
    let left = line[..at].char_indices().rev().take(CHARS_BEFORE).last().map_or(at, |(index, _)| index);
    let right = line[left..].char_indices().nth(MAX_CHARS).map_or(line.len(), |(index, _)| left + index);
    left..right
}

/// Returns the line on which `mark` starts. A long line is shortened around the mark.
pub fn quoted(source: &Source, mark: &Mark) -> String {
    let (line, offset) = line(source, mark.from.line);
    let shown = shown(line, mark.start.saturating_sub(offset).min(line.len()));
    let before = if shown.start > 0 { "…" } else { "" };
    let after = if shown.end < line.len() { "…" } else { "" };
    format!("{before}{}{after}", &line[shown])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::FileId;

    #[test]
    fn both_computations_of_the_end_of_a_mark_agree() {
        let source = [Source::new("x", "a\r\nbä\rc\n\ne".into())];
        let length = source[0].text().len() as u32;
        for (start, end) in (0..length).flat_map(|start| (start + 1..=length).map(move |end| (start, end))) {
            let mark = MarkedSource::of(Span::new(FileId(0), start, end), &source).unwrap().mark.unwrap();
            assert_eq!(mark.to, source[0].position(mark.end as u32), "{start}..{end}");
        }
    }
}
