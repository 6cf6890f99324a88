//! From a span to a place in a file, with every offset made safe to slice with.

use std::ops::Range;

use crate::source::{Position, Source, Span};

/// Lines are shortened to this many characters.
pub const MAX_CHARS: usize = 200;

/// How much of a shortened line is kept before the mark.
const CHARS_BEFORE: usize = 60;

/// A file, and the part of it that is meant.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    /// The file.
    pub source: &'a Source,
    /// `None` for the file as a whole.
    pub mark: Option<Mark>,
}

/// A part of a file.
#[derive(Clone, Copy)]
pub struct Mark {
    /// First byte; in the file, on a character's edge.
    pub start: usize,
    /// One past the last byte; not before `start`, in the file, on a character's edge.
    pub end: usize,
    /// The position of `start`.
    pub from: Position,
    /// The position of `end`.
    pub to: Position,
}

impl<'a> Place<'a> {
    /// Whether [`Place::of`] gives one, at less cost.
    pub fn exists(span: Span, sources: &[Source]) -> bool {
        (span.file.0 as usize) < sources.len()
    }

    /// Where `span` points; `None` when its file isn't among `sources`.
    pub fn of(span: Span, sources: &'a [Source]) -> Option<Self> {
        let source = sources.get(span.file.0 as usize)?;
        if span.is_empty() {
            return Some(Place { source, mark: None });
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
        Some(Place { source, mark: Some(Mark { start, end, from, to }) })
    }
}

/// The position at the end of `marked`, which starts at `from`.
///
/// A position is found by counting the characters before it on its line, and a file may be one long line: the marked
/// text is most often the shorter way.
fn end_position(source: &Source, marked: Range<usize>, from: Position) -> Position {
    let text = &source.text()[marked.clone()];
    match memchr::memchr2(b'\r', b'\n', text.as_bytes()) {
        Some(_) => source.position(marked.end as u32),
        None => Position { line: from.line, column: from.column + text.chars().count() as u32 },
    }
}

/// The text of a line and the offset in the file at which it starts.
pub fn line(source: &Source, number: u32) -> (&str, usize) {
    let line = source.line(number);
    // Both point into the same string: the difference is what a search for the line's start would find.
    (line, (line.as_ptr() as usize).saturating_sub(source.text().as_ptr() as usize))
}

/// The part of `line` to show so that `at`, a character's edge, is in it.
pub fn shown(line: &str, at: usize) -> Range<usize> {
    if line.chars().nth(MAX_CHARS).is_none() {
        return 0..line.len();
    }
    let left = line[..at].char_indices().rev().take(CHARS_BEFORE).last().map_or(at, |(index, _)| index);
    let right = line[left..].char_indices().nth(MAX_CHARS).map_or(line.len(), |(index, _)| left + index);
    left..right
}

/// The line on which `mark` starts, shortened around the mark where it is long.
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
    fn both_ways_to_the_end_of_a_mark_agree() {
        let source = [Source::new("x", "a\r\nbä\rc\n\ne".into())];
        let length = source[0].text().len() as u32;
        for (start, end) in (0..length).flat_map(|start| (start + 1..=length).map(move |end| (start, end))) {
            let mark = Place::of(Span::new(FileId(0), start, end), &source).unwrap().mark.unwrap();
            assert_eq!(mark.to, source[0].position(mark.end as u32), "{start}..{end}");
        }
    }
}
