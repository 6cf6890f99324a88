//! Splits tab-separated files in which quotation marks are ordinary characters. Many tools write such files without
//! quoting. A quotation mark at the start of a cell is an ordinary character unless another one ends the cell.

use lexibus_codegen::source::{FileId, Source, Span};

use super::records::{visible, Cell, Record, Records};

/// Delimiter between cells.
pub(super) const TAB: u8 = b'\t';

/// Returns whether a quotation mark is not closed, or a cell contains both tabs and line ends. Such a cell contains the
/// texts of other cells, because a quotation mark was misinterpreted.
pub(super) fn swallows(records: &Records) -> bool {
    let cells = || records.list.iter().flat_map(|record| &record.cells);
    records.unclosed.is_some() || cells().any(|cell| cell.text.contains('\t') && cell.text.contains('\n'))
}

/// Splits the text after the position `start` into lines and cells.
pub(super) fn divide(source: &Source, file: FileId, start: usize) -> Records {
    let (text, mut at) = (source.text(), start);
    let (mut records, mut record) = (Records::default(), Record::default());
    while at < text.len() {
        let rest = text.get(at..).unwrap_or_default();
        let plain = rest.find(['\t', '\n']).unwrap_or(rest.len());
        let length = match rest.strip_prefix('"') {
            Some(body) => closed(body).map(|length| length + 2),
            None => None,
        };
        let is_letter = rest.starts_with('"') && length.is_none();
        if is_letter {
            records.letters.push(Span::new(file, at as u32, at as u32 + 1));
        }
        let length = length.unwrap_or(plain);
        record.cells.push(cell(source, Span::new(file, at as u32, (at + length) as u32), is_letter));
        let ends_line = !rest.get(length..).unwrap_or_default().starts_with('\t');
        at += (length + 1).min(rest.len());
        if ends_line || at >= text.len() {
            super::records::finish(&mut records, std::mem::take(&mut record));
        }
    }
    records
}

/// Returns the length of a quoted text. Returns `None` if the text contains a tab, or if no quotation mark ends the
/// cell.
fn closed(body: &str) -> Option<usize> {
    let mut skip = false;
    for (at, letter) in body.char_indices() {
        let after = body.get(at + 1..).unwrap_or_default();
        match letter {
            '\t' => return None,
            '"' if skip => skip = false,
            '"' if after.starts_with('"') => skip = true,
            '"' if after.trim_start_matches('\r').starts_with(['\t', '\n']) || after.trim().is_empty() => {
                return Some(at)
            }
            _ => {}
        }
    }
    None
}

fn cell(source: &Source, raw: Span, is_letter: bool) -> Cell {
    let raw_text = source.slice(raw);
    if is_letter {
        let start = raw.start + (raw_text.len() - raw_text.trim_start().len()) as u32;
        let text = raw_text.trim().to_owned();
        let end = start + text.len() as u32;
        return Cell { text, span: Span { start, end, ..raw } };
    }
    let (span, _) = visible(source, raw, TAB);
    let is_quoted = raw_text.starts_with('"');
    let text = if is_quoted { source.slice(span).replace("\"\"", "\"") } else { raw_text.trim().to_owned() };
    Cell { text: text.trim().to_owned(), span }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<Vec<String>>, usize) {
        let source = Source::new("x.tsv", text.as_bytes().to_vec());
        let records = divide(&source, FileId(0), 0);
        let texts = |record: &Record| record.cells.iter().map(|cell| cell.text.clone()).collect();
        for cell in records.list.iter().flat_map(|record| &record.cells) {
            let shown = source.slice(cell.span);
            assert!(shown == cell.text || shown.replace("\"\"", "\"") == cell.text, "{cell:?}");
        }
        (records.list.iter().map(texts).collect(), records.letters.len())
    }

    #[test]
    fn a_quote_without_another_is_a_letter() {
        let (rows, letters) = read("a\tb\n1\t\"RW SAVE\n2\t\"RW\r\n3\t\"x\ty\"\t\"z\"\n\"4\"\"\n4\"\t5");
        let expected: [&[&str]; 5] =
            [&["a", "b"], &["1", "\"RW SAVE"], &["2", "\"RW"], &["3", "\"x", "y\"", "z"], &["4\"\n4", "5"]];
        assert_eq!(rows, expected);
        assert_eq!(letters, 3);
    }

    #[test]
    fn any_text_comes_to_an_end() {
        for text in ["", "\"", "\t", "\n", "\"\t", "\"\"", "\"\"\"", "é\t\"é", "\"a\"b\tc", "\r\n\"", "a\t"] {
            let (rows, _) = read(text);
            assert!(rows.len() <= 3, "{text:?}: {rows:?}");
        }
    }
}
