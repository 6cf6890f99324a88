//! Header sections, and two common parts of sections: lists of indices and comment lines.

use super::extras::Header;
use super::note::Subject;
use super::writer::Writer;
use lexibus_codegen::ir::CompactString;

/// The bit rates in CiA 306, in kbit/s.
pub(super) const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// A header section. The line `[name]` is written before the first entry.
pub(super) struct Section<'w> {
    writer: &'w mut Writer,
    header: Header,
    /// True if the line `[name]` has been written.
    pub(super) is_open: bool,
}

impl<'w> Section<'w> {
    /// Creates a section. The section is not written before its first entry.
    pub(super) fn new(writer: &'w mut Writer, header: Header) -> Self {
        Section { writer, header, is_open: false }
    }

    /// Writes the line `[name]` if it has not been written, and returns the writer.
    pub(super) fn open(&mut self) -> &mut Writer {
        if !self.is_open {
            self.is_open = true;
            self.writer.section(self.header.name());
        }
        self.writer
    }
}

/// Writes the `Lines` and `LineN` keys of a comment.
pub(super) fn comment_lines(writer: &mut Writer, lines: &[CompactString]) {
    writer.entry("Lines", lines.len());
    for (line, number) in lines.iter().zip(1..) {
        let line = writer.one_line(line, Subject::Named("Comments"));
        writer.numbered(format_args!("Line{number}"), line);
    }
}

/// Writes the number of indices, followed by each index.
pub(super) fn indices(writer: &mut Writer, key: &'static str, count: usize, list: impl Iterator<Item = u16>) {
    writer.entry(key, count);
    for (index, number) in list.zip(1..) {
        writer.numbered(number, format_args!("0x{index:04X}"));
    }
}
