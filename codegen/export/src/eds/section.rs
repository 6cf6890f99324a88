//! Sections of the header and what several of them have: lists of indices, lines of comment.

use super::extras::Header;
use super::note::Subject;
use super::writer::Writer;
use lexibus_codegen::ir::CompactString;

/// The bit rates of CiA 306 in kbit/s.
pub(super) const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// A section that begins with its first entry.
pub(super) struct Section<'w> {
    writer: &'w mut Writer,
    header: Header,
    /// Whether it has begun.
    pub(super) is_open: bool,
}

impl<'w> Section<'w> {
    /// A section without entries, which is not written yet.
    pub(super) fn new(writer: &'w mut Writer, header: Header) -> Self {
        Section { writer, header, is_open: false }
    }

    /// The writer, within the section.
    pub(super) fn open(&mut self) -> &mut Writer {
        if !self.is_open {
            self.is_open = true;
            self.writer.section(self.header.name());
        }
        self.writer
    }
}

/// `Lines` and `LineN`.
pub(super) fn comment_lines(writer: &mut Writer, lines: &[CompactString]) {
    writer.entry("Lines", lines.len());
    for (line, number) in lines.iter().zip(1..) {
        let line = writer.one_line(line, Subject::Named("Comments"));
        writer.numbered(format_args!("Line{number}"), line);
    }
}

/// How many there are, and each by number.
pub(super) fn indices(writer: &mut Writer, key: &'static str, count: usize, list: impl Iterator<Item = u16>) {
    writer.entry(key, count);
    for (index, number) in list.zip(1..) {
        writer.numbered(number, format_args!("0x{index:04X}"));
    }
}
