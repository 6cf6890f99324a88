//! A lexer that does the minimum work for reading an EDS: it finds the spans of sections, keys and values without converting them.

use memchr::{memchr, memchr_iter};

/// A piece of text without surrounding whitespace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub start: u32,
    pub end: u32,
}

/// A section. The entries of a section end before the first entry of the next section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Section {
    pub name: Span,
    pub first_entry: u32,
}

/// Spans of the sections and entries of a file, in file order.
#[derive(Default)]
pub struct Spans {
    pub sections: Vec<Section>,
    pub entries: Vec<(Span, Span)>,
}

pub fn lex(text: &str) -> Spans {
    let bytes = text.as_bytes();
    // Estimate the number of spans from the typical size of lines and sections in real files.
    let mut spans =
        Spans { sections: Vec::with_capacity(bytes.len() / 160), entries: Vec::with_capacity(bytes.len() / 20) };
    let mut start = 0;
    for end in memchr_iter(b'\n', bytes) {
        line(bytes, start, end, &mut spans);
        start = end + 1;
    }
    line(bytes, start, bytes.len(), &mut spans);
    spans
}

fn line(bytes: &[u8], start: usize, end: usize, spans: &mut Spans) {
    let (start, end) = trim(bytes, start, end);
    match bytes[start..end].first() {
        None | Some(b';') => {}
        Some(b'[') => {
            let close = memchr(b']', &bytes[start..end]).map_or(end, |at| start + at);
            spans
                .sections
                .push(Section { name: span(bytes, start + 1, close), first_entry: spans.entries.len() as u32 });
        }
        Some(_) => {
            if let Some(equals) = memchr(b'=', &bytes[start..end]) {
                let at = start + equals;
                spans.entries.push((span(bytes, start, at), span(bytes, at + 1, end)));
            }
        }
    }
}

fn span(bytes: &[u8], start: usize, end: usize) -> Span {
    let (start, end) = trim(bytes, start, end);
    Span { start: start as u32, end: end as u32 }
}

fn trim(bytes: &[u8], mut start: usize, mut end: usize) -> (usize, usize) {
    while start < end && bytes[start].is_ascii_whitespace() {
        start += 1;
    }
    while start < end && bytes[end - 1].is_ascii_whitespace() {
        end -= 1;
    }
    (start, end)
}

#[test]
fn finds_sections_keys_and_values() {
    let text = "; a comment\r\n[1000]\r\n Name = Device type \r\n\n[1000sub1 ]\nDataType=0x7";
    let spans = lex(text);
    let of = |span: Span| &text[span.start as usize..span.end as usize];
    let names: Vec<_> = spans.sections.iter().map(|section| (of(section.name), section.first_entry)).collect();
    assert_eq!(names, [("1000", 0), ("1000sub1", 1)]);
    let entries: Vec<_> = spans.entries.iter().map(|&(key, value)| (of(key), of(value))).collect();
    assert_eq!(entries, [("Name", "Device type"), ("DataType", "0x7")]);
}
