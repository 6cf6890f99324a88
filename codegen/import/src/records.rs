//! Splits a file into lines and cells with their positions.

use csv_core::{ReadFieldResult, ReaderBuilder};
use lexibus_codegen::source::{FileId, Source, Span};

/// A cell. The text and the span exclude quotation marks and surrounding whitespace.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell {
    pub text: String,
    pub span: Span,
}

/// A line of a file, divided into cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Record {
    pub cells: Vec<Cell>,
    pub span: Span,
}

impl Record {
    /// Returns the text of a cell. Returns an empty text if the line has no such cell.
    pub fn text(&self, column: usize) -> &str {
        self.cells.get(column).map_or("", |cell| cell.text.as_str())
    }

    /// Returns the non-empty cells and the positions of their columns.
    pub fn filled(&self) -> impl Iterator<Item = (usize, &Cell)> {
        self.cells.iter().enumerate().filter(|(_, cell)| !cell.text.is_empty())
    }
}

/// The lines of a file.
#[derive(Debug, Default)]
pub(super) struct Records {
    pub list: Vec<Record>,
    /// Span of the cell at the end of the file, if its opening quotation mark is not closed.
    pub unclosed: Option<Span>,
    /// Spans of quotation marks that were read as ordinary characters.
    pub letters: Vec<Span>,
}

/// Returns the delimiter from a first line such as `sep=;`, which is an Excel convention. Also returns the length of
/// that line.
pub(super) fn declared_delimiter(text: &str) -> Option<(u8, usize)> {
    let line = text.lines().next()?;
    let &[delimiter] = line.trim_end().strip_prefix("sep=")?.as_bytes() else { return None };
    Some((delimiter, line.len())).filter(|_| delimiter.is_ascii())
}

/// Splits the text from `start` into cells.
pub(super) fn read(source: &Source, file: FileId, delimiter: u8, start: usize) -> Records {
    let bytes = source.text().as_bytes();
    let mut reader = ReaderBuilder::new().delimiter(delimiter).build();
    let mut records = Records::default();
    let mut record = Record::default();
    let mut buffer = vec![0; 256];
    let (mut at, mut length, mut first) = (start, 0, start);
    loop {
        let (result, read, written) = reader.read_field(bytes.get(at..).unwrap_or_default(), &mut buffer[length..]);
        (at, length) = (at + read, length + written);
        match result {
            // At the end of the file, the next call returns `End`.
            ReadFieldResult::InputEmpty => {}
            ReadFieldResult::OutputFull => buffer.resize(buffer.len() * 2, 0),
            ReadFieldResult::Field { record_end } => {
                let text = String::from_utf8_lossy(&buffer[..length]);
                let span = Span::new(file, first as u32, at as u32);
                let (span, is_open) = visible(source, span, delimiter);
                record.cells.push(Cell { text: text.trim().to_owned(), span });
                (length, first) = (0, at);
                if record_end {
                    records.unclosed = records.unclosed.or(is_open.then_some(span).filter(|_| at == bytes.len()));
                    finish(&mut records, std::mem::take(&mut record));
                }
            }
            ReadFieldResult::End => return records,
        }
    }
}

/// Adds a line with the span of its cells. Lines without cells are ignored.
pub(super) fn finish(records: &mut Records, mut record: Record) {
    if let (Some(first), Some(last)) = (record.cells.first(), record.cells.last()) {
        record.span = Span { end: last.span.end.max(first.span.start), ..first.span };
        records.list.push(record);
    }
}

/// Returns the span of a cell's text, and whether its quotation mark is not closed.
pub(super) fn visible(source: &Source, raw: Span, delimiter: u8) -> (Span, bool) {
    let text = source.slice(raw);
    let body = text.trim_start_matches(['\r', '\n']);
    let start = text.len() - body.len();
    let ends = ['\r', '\n'];
    let body = body.strip_suffix(char::from(delimiter)).unwrap_or_else(|| body.trim_end_matches(ends));
    let is_quoted = body.starts_with('"');
    let is_open = is_quoted && (body.len() < 2 || !body.trim_end().ends_with('"'));
    let inner = if is_quoted { body.trim_matches('"') } else { body };
    let blanks = inner.len() - inner.trim_start().len();
    let from = start + usize::from(is_quoted && !body.is_empty()) + blanks;
    let first = raw.start + from.min(text.len()) as u32;
    (Span { start: first, end: (first + inner.trim().len() as u32).min(raw.end), ..raw }, is_open)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_all(text: &str, delimiter: u8) -> (Source, Records) {
        let source = Source::new("x.csv", text.as_bytes().to_vec());
        let records = read(&source, FileId(0), delimiter, 0);
        (source, records)
    }

    #[test]
    fn cells_have_their_place() {
        let (source, records) = read_all("a; b ;\"c;\n d\"\r\n\r\n1;\"\";é\n", b';');
        let texts: Vec<Vec<&str>> =
            records.list.iter().map(|record| record.cells.iter().map(|cell| cell.text.as_str()).collect()).collect();
        assert_eq!(texts, [vec!["a", "b", "c;\n d"], vec!["1", "", "é"]]);
        for record in &records.list {
            for cell in &record.cells {
                assert_eq!(source.slice(cell.span), cell.text);
            }
        }
        assert_eq!(source.position(records.list[1].cells[2].span.start).line, 4);
        assert_eq!(records.unclosed, None);
    }

    #[test]
    fn what_is_odd_is_read_all_the_same() {
        let (_, records) = read_all("a,b\n\"1,2\n3,4\n", b',');
        assert!(records.unclosed.is_some() && records.list.len() == 2);
        assert!(read_all("", b',').1.list.is_empty());
        assert_eq!(read_all("a,\"\"\"x\"\"\"", b',').1.list[0].text(1), "\"x\"");
        assert_eq!(declared_delimiter("sep=;\r\na;b"), Some((b';', 5)));
        assert_eq!(declared_delimiter("sep=\u{e9}\n"), None);
    }
}
