//! Breaks the lines of documents.

use super::doc::{Doc, Mark};

/// Maximum width of a line in bytes. Like `prettyplease`, the writer counts bytes and not characters.
pub(in crate::backend::rust) const MARGIN: usize = 89;

/// Number of spaces per indentation level.
pub(super) const STEP: usize = 4;

/// Writes a document with the given indentation and ends the line.
pub(super) fn write(doc: &Doc, indent: usize, out: &mut String) {
    self::indent(out, indent);
    let text = doc.text();
    if doc.marks(0).next().is_none() || indent + text.len() <= MARGIN && !doc.has_long() {
        out.extend([text, "\n"]);
        return;
    }
    let mut printer = Printer { doc, out, at: 0, column: indent, indent, open: Vec::new() };
    for (position, (offset, mark)) in doc.marks(0).enumerate() {
        printer.mark(position, offset, mark);
    }
    printer.text_to(text.len());
    out.push('\n');
}

/// Writes the spaces at the beginning of a line.
pub(super) fn indent(out: &mut String, indent: usize) {
    out.extend(std::iter::repeat_n(' ', indent));
}

/// A list whose end has not been written yet.
#[derive(Clone, Copy)]
struct List {
    kind: Mark,
    is_broken: bool,
}

struct Printer<'d, 'o> {
    doc: &'d Doc,
    out: &'o mut String,
    /// Byte offset of the text that has not been written yet.
    at: usize,
    column: usize,
    indent: usize,
    open: Vec<List>,
}

impl Printer<'_, '_> {
    fn mark(&mut self, position: usize, offset: usize, mark: Mark) {
        self.text_to(offset);
        let may_break = self.open.last().is_none_or(|list| list.is_broken);
        match mark {
            Mark::Open | Mark::OpenNumbers | Mark::OpenStruct { .. } => {
                let is_broken = may_break && self.column.saturating_add(self.width(position)) > MARGIN;
                self.open.push(List { kind: mark, is_broken });
                if is_broken {
                    self.indent += STEP;
                    self.newline();
                    self.skip_blank();
                }
            }
            Mark::Next => self.next(position),
            Mark::Close => {
                if self.open.pop().is_some_and(|list| list.is_broken) {
                    self.out.push(',');
                    self.indent -= STEP;
                    self.newline();
                    self.skip_blank();
                }
            }
            Mark::Soft => {
                if may_break && self.column + self.width(position) > MARGIN {
                    self.indent += STEP;
                    self.newline();
                    self.indent -= STEP;
                    self.skip_blank();
                }
            }
            Mark::Stop => {}
        }
    }

    /// Writes the comma after a member of a broken list. Starts a new line, unless the members are numbers or names and
    /// the next member fits.
    fn next(&mut self, position: usize) {
        let Some(list) = self.open.last().copied().filter(|list| list.is_broken) else { return };
        self.text_to(self.at + 1);
        if list.kind == Mark::OpenNumbers && self.column + self.width_of_next(position) <= MARGIN {
            return;
        }
        self.newline();
        self.skip_blank();
    }

    /// Returns the width of the next member with the space before it. A comma is included if another member follows.
    fn width_of_next(&self, position: usize) -> usize {
        let next_mark = self.doc.marks(position + 1).next();
        next_mark.map_or(0, |(offset, mark)| offset - self.at + usize::from(mark == Mark::Next))
    }

    fn text_to(&mut self, end: usize) {
        let text = self.doc.text().get(self.at..end).unwrap_or_default();
        self.out.push_str(text);
        self.column += text.len();
        self.at = self.at.max(end);
    }

    /// Skips the space at a position where the line is broken.
    fn skip_blank(&mut self) {
        if self.doc.text()[self.at..].starts_with(' ') {
            self.at += 1;
        }
    }

    fn newline(&mut self) {
        self.out.push('\n');
        indent(self.out, self.indent);
        self.column = self.indent;
    }

    /// Returns the width that a construct would have on one line. The width includes the text after the construct, up
    /// to the next break position that is not inside a later list. Returns `usize::MAX` if the width exceeds
    /// [`MARGIN`], or if a struct in the construct needs several lines.
    fn width(&self, position: usize) -> usize {
        let (mut depth, mut is_inside) = (0_usize, true);
        let Some((start, first)) = self.doc.marks(position).next() else { return 0 };
        for (offset, mark) in self.doc.marks(position + usize::from(first == Mark::Soft)) {
            if offset - start > MARGIN {
                return usize::MAX;
            }
            match mark {
                Mark::OpenStruct { is_long: true } if is_inside => return usize::MAX,
                Mark::Open | Mark::OpenNumbers | Mark::OpenStruct { .. } => depth += 1,
                Mark::Next if depth == 0 => return offset - start + 1,
                Mark::Close | Mark::Stop | Mark::Soft if depth == 0 => return offset - start,
                Mark::Close => {
                    depth -= 1;
                    is_inside &= depth > 0;
                }
                Mark::Next | Mark::Stop | Mark::Soft => {}
            }
        }
        self.doc.text().len() - start
    }
}

#[cfg(test)]
mod tests {
    use super::write;
    use crate::backend::rust::code::{call, generic, seq, Break, Data, Doc, Stop};

    fn written(indent: usize, doc: &Doc) -> String {
        let mut out = String::new();
        write(doc, indent, &mut out);
        out
    }

    #[test]
    fn short_lines_are_unchanged() {
        assert_eq!(written(0, &seq![call!("a", "b", "c"), ";"]), "a(b, c);\n");
        assert_eq!(written(4, &seq![Stop, "x", Break, " as u8"]), "    x as u8\n");
    }

    #[test]
    fn long_lists_break_from_the_outside() {
        let name = "n".repeat(70);
        assert_eq!(
            written(4, &seq![call!(name, "aaaaaaaa", call!("f", "b")), ";"]),
            format!("    {name}(\n        aaaaaaaa,\n        f(b),\n    );\n")
        );
        assert_eq!(
            written(0, &seq![name, ": ", call!("get", "a", "b"), Break, " as u32,"]),
            format!("{name}: get(a, b) as u32,\n")
        );
        let long = "n".repeat(75);
        assert_eq!(
            written(0, &seq![long, ": ", call!("get", "a"), Break, " as u32,"]),
            format!("{long}: get(a)\n    as u32,\n")
        );
        assert_eq!(
            written(0, &seq![call!(seq!["fn ", name], "&mut self"), " -> ", generic!("f", "u8"), " {"]),
            format!("fn {name}(\n    &mut self,\n) -> f<u8> {{\n")
        );
    }

    fn canonical(value: &Doc) {
        let text = written(0, &seq!["static X: T = ", value, ";"]);
        assert_eq!(text, prettyplease::unparse(&syn::parse_file(&text).unwrap()));
    }

    #[test]
    fn literals_are_as_prettyplease_prints_them() {
        let numbers = |count: u16| Data::slice((0..count).map(|at| Data::index(at * 7)));
        (0..60).for_each(|count| canonical(&numbers(count)));
        let point = |size: usize| {
            Data::fields("rt::P", [("x", Doc::from("1".repeat(size))), ("long_name", Data::option(Some(2)))])
        };
        for size in 1..70 {
            canonical(&point(size));
            canonical(&Data::slice([point(size), point(1)]));
            canonical(&Data::call("Some", [point(size)]));
            let call = Data::call("rt::f", [Doc::from("a".repeat(size)), Doc::from("b".repeat(20))]);
            canonical(&call);
            canonical(&Data::slice([call.clone(), call.clone()]));
            canonical(&Data::fields("rt::Q", [("call", call), ("numbers", numbers(size as u16)), ("point", point(3))]));
        }
    }
}
