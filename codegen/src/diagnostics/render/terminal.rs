//! Diagnostics in the format of rustc.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Element, Group, Level, Message, Origin, Patch, Renderer, Snippet};

use super::super::{Diagnostic, Severity};
use super::marked::{self, Mark, MarkedSource};
use crate::source::Source;
use crate::text::steers;

/// Maximum number of marked lines. If a span has more lines, only its first line is marked.
const MAX_LINES: u32 = 6;

/// Maximum number of characters of a message, label or replacement. Longer texts are shortened.
const MAX_TEXT: usize = 2000;

/// Width of the rendered text. The width exceeds any terminal window, so that the renderer does not shorten lines a second time.
const WIDTH: usize = 10 * marked::MAX_CHARS;

/// Character that ends the text `file:line:column`. It is a Unicode noncharacter, which [`visible`] replaces in texts
/// of a file.
const END_OF_ORIGIN: char = '\u{fdd0}';

/// Renders a diagnostic with its marked lines, notes, help and fix, without a line feed at the end.
///
/// `color` adds ANSI escapes for colors. Control characters in the file or message are rendered as pictures (`␛`) or as `�`. For a
/// diagnostic about a whole file, the output contains the name of the file instead of marked lines. The rendering time depends on
/// the marked lines, not on the size of the file.
pub fn render(diagnostic: &Diagnostic, sources: &[Source], color: bool) -> String {
    let location = MarkedSource::of(diagnostic.span, sources);
    let suggestion = suggestion(diagnostic, location);
    let (mut facts, mut located_notes) = (Vec::new(), Vec::new());
    for note in &diagnostic.notes {
        let text = paragraph(&note.message);
        match note.span.and_then(|span| MarkedSource::of(span, sources)) {
            Some(location) => located_notes.push(Level::NOTE.secondary_title(text).element(quote(location, ""))),
            None => facts.push(Level::NOTE.message(text)),
        }
    }
    if suggestion.is_none() {
        facts.extend(diagnostic.help.as_deref().map(|help| Level::HELP.message(paragraph(help))));
        let fix = diagnostic.fix.as_deref();
        facts.extend(fix.map(|fix| Level::HELP.message(format!("write `{}` instead", visible(fix)))));
    }

    let mut groups = vec![primary(diagnostic, location).elements(facts)];
    groups.extend(located_notes);
    groups.extend(suggestion);
    print(&groups, color)
}

/// Renders the message, position and label of a diagnostic, without the marked lines, notes, help and fix.
///
/// In all other respects, the output is like that of [`render`]. Use this form if a similar diagnostic has already been rendered in
/// full.
pub fn brief(diagnostic: &Diagnostic, sources: &[Source], color: bool) -> String {
    let origin = MarkedSource::of(diagnostic.span, sources).map(|MarkedSource { source, mark }| {
        let name = visible(source.name());
        Origin::path(match mark {
            Some(mark) => format!("{name}:{}:{}", mark.from.line, mark.from.column),
            None => name,
        })
    });
    print(&[title(diagnostic).elements(origin).elements(label_note(diagnostic))], color)
}

fn print(groups: &[Group], color: bool) -> String {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    without_counted_origins(&renderer.term_width(WIDTH).render(groups))
}

/// Returns the message and the marked lines.
fn primary(diagnostic: &Diagnostic, location: Option<MarkedSource>) -> Group<'static> {
    let has_mark = location.is_some_and(|location| location.mark.is_some());
    let label_alone = (!has_mark).then(|| label_note(diagnostic)).flatten();
    let quoted = location.map(|location| quote(location, &diagnostic.label));
    title(diagnostic).elements(quoted).elements(label_alone)
}

fn title(diagnostic: &Diagnostic) -> Group<'static> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    Group::with_title(level.primary_title(visible(&diagnostic.message)).id(diagnostic.code.id))
}

/// Returns the label as a note, or `None` if the label is empty.
fn label_note(diagnostic: &Diagnostic) -> Option<Message<'static>> {
    let label = diagnostic.label.as_str();
    (!label.is_empty()).then(|| Level::NOTE.message(paragraph(label)))
}

/// Returns the marked lines with the suggested replacement. Returns `None` if there is no replacement, if the replacement is too
/// long, if no lines are marked, or if the marked lines are not shown in full.
fn suggestion(diagnostic: &Diagnostic, location: Option<MarkedSource>) -> Option<Group<'static>> {
    let (fix, location) = (diagnostic.fix.as_deref()?, location?);
    let window = Window::new(location.source, location.mark?);
    if !window.is_whole || fix.chars().nth(marked::MAX_CHARS).is_some() {
        return None;
    }
    let title = diagnostic.help.as_deref().map_or("replace the marked text".into(), paragraph);
    let patch = Patch::new(window.mark, paragraph(fix));
    let snippet = Snippet::source(window.text).line_start(window.first_line).patch(patch);
    Some(Level::HELP.secondary_title(title).element(snippet))
}

/// Returns the marked lines below the name of their file, or only the name if the whole file is marked.
fn quote(location: MarkedSource, label: &str) -> Element<'static> {
    let MarkedSource { source, mark } = location;
    let name = visible(source.name());
    let Some(mark) = mark else { return Origin::path(name).into() };

    let window = Window::new(source, mark);
    let label = match (visible(label), window.goes_on_to) {
        (label, None) => label,
        (label, Some(line)) if label.is_empty() => format!("up to line {line}"),
        (label, Some(line)) => format!("{label} (up to line {line})"),
    };
    let annotation = AnnotationKind::Primary.span(window.mark).label((!label.is_empty()).then_some(label));
    let origin = format!("{name}:{}:{}{END_OF_ORIGIN}", mark.from.line, mark.from.column);
    Snippet::source(window.text).line_start(window.first_line).path(origin).annotation(annotation).into()
}

/// Removes the line and column that the renderer appends to each origin. The origin already ends with the line and column in the
/// file, and the appended numbers refer to the window.
fn without_counted_origins(rendered: &str) -> String {
    let mut parts = rendered.split(END_OF_ORIGIN);
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text += part.trim_start_matches(|c: char| c == ':' || c.is_ascii_digit());
    }
    text
}

/// The marked lines of a file, prepared for the renderer, which does not see other parts of the file.
struct Window {
    /// Marked lines, separated by line feeds. Long lines are shortened, and visible characters replace control characters.
    text: String,
    first_line: usize,
    /// Range of the marked part in `text`.
    mark: Range<usize>,
    /// Number of the last marked line; `None` if this line is in the window.
    goes_on_to: Option<u32>,
    /// True if the window contains all marked lines in full.
    is_whole: bool,
}

impl Window {
    fn new(source: &Source, mark: Mark) -> Self {
        // The mark must not include a final line end, which would extend the mark into the next line.
        let end = mark.start + source.text()[mark.start..mark.end].trim_end_matches(['\r', '\n']).len();
        let first = mark.from.line;
        let last = if end == mark.end { mark.to.line } else { source.position(end as u32).line };
        let goes_on_to = (last - first >= MAX_LINES).then_some(last);

        let is_whole = goes_on_to.is_none();
        let first_line = first as usize;
        let mut window = Window { text: String::new(), first_line, mark: 0..0, goes_on_to, is_whole };
        for number in first..=if is_whole { last } else { first } {
            if number > first {
                window.text.push('\n');
            }
            window.push_line(source, number, mark.start..end);
        }
        window
    }

    /// Appends a line. Extends the mark by the part of `marked` on this line. `marked` is a range of the file.
    fn push_line(&mut self, source: &Source, number: u32, marked: Range<usize>) {
        let (line, offset) = marked::line(source, number);
        let in_line = |at: usize| at.saturating_sub(offset).min(line.len());
        let (start, end) = (in_line(marked.start), in_line(marked.end));
        let shown = marked::shown(line, start);
        let end = end.min(shown.end);
        self.is_whole &= shown == (0..line.len());

        if shown.start > 0 {
            self.text.push('…');
        }
        push_visible(&mut self.text, &line[shown.start..start]);
        if number as usize == self.first_line {
            self.mark.start = self.text.len();
        }
        push_visible(&mut self.text, &line[start..end]);
        self.mark.end = self.text.len();
        push_visible(&mut self.text, &line[end..shown.end]);
        if shown.end < line.len() {
            self.text.push('…');
        }
    }
}

/// Returns untrusted text as one line that is safe to print.
fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len().min(MAX_TEXT));
    let cut = text.char_indices().nth(MAX_TEXT).map(|(index, _)| index);
    push_visible(&mut shown, &text[..cut.unwrap_or(text.len())]);
    if cut.is_some() {
        shown.push('…');
    }
    shown
}

/// Returns untrusted text like [`visible`], but keeps its lines. The renderer indents the lines, so none of them looks like a
/// separate message.
fn paragraph(text: &str) -> String {
    let lines: Vec<String> = text.lines().map(visible).collect();
    lines.join("\n")
}

fn push_visible(shown: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '\t' => *shown += "    ",
            '\u{7f}' => shown.push('␡'),
            // The Unicode control pictures have the same order as the control characters.
            '\0'..='\u{1f}' => shown.push(char::from_u32(0x2400 + u32::from(c)).unwrap_or('�')),
            '\u{fdd0}'..='\u{fdef}' => shown.push('�'),
            _ if steers(c) => shown.push('�'),
            _ => shown.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::codes;
    use super::*;
    use crate::source::{FileId, Span};

    const OCTAL: &str = "[1018]\nParameterName=Identity\nSubNumber=012\nObjectType=0x9\n";

    fn file(text: impl AsRef<[u8]>) -> [Source; 1] {
        [Source::new("drive.eds", text.as_ref().to_vec())]
    }

    /// Creates a warning about `start..end` of the first file.
    fn at(start: usize, end: usize) -> Diagnostic {
        let span = Span::new(FileId(0), start as u32, end as u32);
        let mut diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, span, "`012` is octal").label("read as 10");
        diagnostic.severity = Severity::Warning;
        diagnostic
    }

    /// Creates a warning about the first occurrence of `marked` in a text.
    fn on(text: &str, marked: &str) -> Diagnostic {
        let start = text.find(marked).unwrap();
        at(start, start + marked.len())
    }

    fn plain(diagnostic: &Diagnostic, sources: &[Source]) -> String {
        let text = render(diagnostic, sources, false);
        assert!(!text.contains(|c: char| c != '\n' && steers(c)), "{text:?}");
        text
    }

    #[test]
    fn the_marked_text_is_underlined_and_labeled() {
        insta::assert_snapshot!(plain(&on(OCTAL, "012"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
        ");
    }

    #[test]
    fn notes_help_and_fix_follow() {
        let start = OCTAL.find("1018").unwrap() as u32;
        let diagnostic = on(OCTAL, "012")
            .note("CiA 306 numbers are C numbers")
            .note_at(Span::new(FileId(0), start, start + 4), "in this object")
            .note_at(Span::new(FileId(7), 0, 1), "in a missing file")
            .help("write the number in decimal")
            .fix("10");
        insta::assert_snapshot!(plain(&diagnostic, &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
          |
          = note: CiA 306 numbers are C numbers
          = note: in a missing file
        note: in this object
         --> drive.eds:1:2
          |
        1 | [1018]
          |  ^^^^
        help: write the number in decimal
          |
        3 - SubNumber=012
        3 + SubNumber=10
          |
        ");
    }

    #[test]
    fn a_fix_without_help_has_a_title() {
        insta::assert_snapshot!(plain(&on(OCTAL, "012").fix("0x012"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
          |
        help: replace the marked text
          |
        3 | SubNumber=0x012
          |           ++
        ");
        // Without marked text, a help text contains the replacement.
        insta::assert_snapshot!(plain(&at(0, 0).fix("a\u{1b}b").help("correct it"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
        --> drive.eds
         = note: read as 10
         = help: correct it
         = help: write `a␛b` instead
        ");
    }

    #[test]
    fn a_fix_can_delete_repeat_or_add_lines() {
        insta::assert_snapshot!(plain(&on(OCTAL, "012").fix(""), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
          |
        help: replace the marked text
          |
        3 - SubNumber=012
        3 + SubNumber=
          |
        ");
        insta::assert_snapshot!(plain(&on(OCTAL, "012").fix("012"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
          |
        help: replace the marked text
          |
        3 | SubNumber=012
          |
        ");
        insta::assert_snapshot!(plain(&on(OCTAL, "012").fix("10\r\nDataType=7"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:3:11
          |
        3 | SubNumber=012
          |           ^^^ read as 10
          |
        help: replace the marked text
          |
        3 ~ SubNumber=10
        4 + DataType=7
          |
        ");
    }

    #[test]
    fn colors_only_add_escapes() {
        let diagnostic = on(OCTAL, "012").note("fact").note_at(Span::new(FileId(0), 1, 5), "here").fix("10");
        let colored = render(&diagnostic, &file(OCTAL), true);
        assert!(colored.contains("\u{1b}["));
        let mut parts = colored.split("\u{1b}[");
        let mut stripped = parts.next().unwrap().to_owned();
        parts.for_each(|part| stripped += part.split_once('m').unwrap().1);
        assert_eq!(stripped, plain(&diagnostic, &file(OCTAL)));
    }

    #[test]
    fn a_file_as_a_whole_is_only_named() {
        insta::assert_snapshot!(plain(&at(0, 0), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
        --> drive.eds
         = note: read as 10
        ");
        insta::assert_snapshot!(plain(&at(0, 0).note_at(Span::default(), "this one"), &file("")), @r"
        warning[EDS020]: `012` is octal
        --> drive.eds
         = note: read as 10
        note: this one
        --> drive.eds
        ");
    }

    #[test]
    fn the_brief_form_has_message_position_and_label() {
        let diagnostic = on(OCTAL, "012").note("a fact").help("write the number in decimal").fix("10");
        insta::assert_snapshot!(brief(&diagnostic, &file(OCTAL), false), @r"
        warning[EDS020]: `012` is octal
        --> drive.eds:3:11
         = note: read as 10
        ");
        insta::assert_snapshot!(brief(&at(0, 0).label(""), &file(OCTAL), false), @r"
        warning[EDS020]: `012` is octal
        --> drive.eds
        ");
    }

    #[test]
    fn a_missing_file_has_no_location() {
        insta::assert_snapshot!(plain(&at(0, 3).help("write 10"), &[]), @r"
        warning[EDS020]: `012` is octal
         |
         = note: read as 10
         = help: write 10
        ");
    }

    #[test]
    fn every_kind_of_line_end_is_one() {
        let expected = plain(&on(OCTAL, "012"), &file(OCTAL));
        for line_end in ["\r", "\r\n"] {
            let text = OCTAL.replace('\n', line_end);
            assert_eq!(plain(&on(&text, "012"), &file(&text)), expected);
        }
    }

    #[test]
    fn tabs_and_wide_characters_keep_the_mark_in_place() {
        let text = "\tName\t=\tGerät 漢字 012 µ";
        insta::assert_snapshot!(plain(&on(text, "012"), &file(text)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:18
          |
        1 |     Name    =    Gerät 漢字 012 µ
          |                             ^^^ read as 10
        ");
    }

    #[test]
    fn control_characters_never_reach_the_terminal() {
        let text = "a\u{1b}[31m=\u{7}012\u{9b}2J\u{202e}\0\u{fdd0}:1:1";
        let mut diagnostic = on(text, "012").help("\u{1b}[2J\nnext\rline").note("\u{85}").fix("\u{1b}c");
        diagnostic.message = "`\u{1b}]0;title\u{7}`\nerror: forged".into();
        diagnostic.label = "\u{8}\n\t.".into();
        let sources = [Source::new("a\u{1b}[0mb.eds", text.as_bytes().to_vec())];
        insta::assert_snapshot!(plain(&diagnostic, &sources), @r"
        warning[EDS020]: `␛]0;title␇`␊error: forged
         --> a␛[0mb.eds:1:9
          |
        1 | a␛[31m=␇012�2J�␀�:1:1
          |         ^^^ ␈␊    .
          |
          = note: �
        help: ␛[2J
              next␍line
          |
        1 - a␛[31m=␇012�2J�␀�:1:1
        1 + a␛[31m=␇␛c�2J�␀�:1:1
          |
        ");
        // Windows-1252 maps five bytes to C1 control characters.
        plain(&at(0, 2), &file(b"\x81\x8d\x8f\x90\x9d"));
    }

    #[test]
    fn a_mark_at_the_end_of_the_file_is_shown() {
        insta::assert_snapshot!(plain(&at(2, 3), &file("a=0")), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:3
          |
        1 | a=0
          |   ^ read as 10
        ");
        insta::assert_snapshot!(plain(&at(3, 9), &file("a=0")), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:4
          |
        1 | a=0
          |    ^ read as 10
        ");
        insta::assert_snapshot!(plain(&at(4, 5), &file("a=0\n")), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:2:1
          |
        2 |
          | ^ read as 10
        ");
    }

    #[test]
    fn a_mark_over_a_few_lines_is_drawn_whole() {
        insta::assert_snapshot!(plain(&on(OCTAL, &OCTAL[..43]), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:1
          |
        1 | / [1018]
        2 | | ParameterName=Identity
        3 | | SubNumber=012
          | |_____________^ read as 10
        ");
        // A line end in the marked text is not drawn.
        insta::assert_snapshot!(plain(&on(OCTAL, "[1018]\n"), &file(OCTAL)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:1
          |
        1 | [1018]
          | ^^^^^^ read as 10
        ");
    }

    #[test]
    fn a_mark_over_many_lines_is_drawn_on_the_first() {
        let text = "<a>\n".repeat(5000);
        insta::assert_snapshot!(plain(&at(0, text.len()).fix("<b/>"), &file(text)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:1
          |
        1 | <a>
          | ^^^ read as 10 (up to line 5000)
          |
          = help: write `<b/>` instead
        ");
    }

    #[test]
    fn a_long_line_is_shortened_around_the_mark() {
        let text = format!("first=1\n{}012{}", "x".repeat(100_000), "y".repeat(100_000));
        let rendered = plain(&on(&text, "012").fix("10"), &file(&text));
        assert!(rendered.lines().all(|line| line.chars().count() < marked::MAX_CHARS + 10), "{rendered}");
        insta::assert_snapshot!(rendered.replace(&"x".repeat(60), "<60>").replace(&"y".repeat(137), "<137>"), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:2:100001
          |
        2 | …<60>012<137>…
          |                                                              ^^^ read as 10
          |
          = help: write `10` instead
        ");
    }

    #[test]
    fn a_long_mark_ends_where_the_line_is_cut() {
        let text = format!("a={}", "7".repeat(100_000));
        let diagnostic = on(&text, &text[2..]).fix("8".repeat(5000));
        let mut rendered = plain(&diagnostic, &file(&text));
        for (c, count) in [("7", 198), ("^", 198), ("8", 2000)] {
            rendered = rendered.replace(&c.repeat(count), &format!("{c}<{count}>"));
        }
        insta::assert_snapshot!(rendered, @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:3
          |
        1 | a=7<198>…
          |   ^<198> read as 10
          |
          = help: write `8<2000>…` instead
        ");
    }

    #[test]
    fn offsets_inside_of_a_character_are_moved_to_its_edges() {
        let text = "a=€";
        insta::assert_snapshot!(plain(&at(3, 4), &file(text)), @r"
        warning[EDS020]: `012` is octal
         --> drive.eds:1:3
          |
        1 | a=€
          |   ^ read as 10
        ");
    }

    #[test]
    fn no_text_and_no_span_panics() {
        let pieces = "a|=|\n|\r|\r\n|\t|€|漢|👩\u{200d}🚀|e\u{301}|\u{1b}[| |;|\u{fdd0}";
        let pieces: Vec<&str> = pieces.split('|').collect();
        let mut state = 1u32;
        let mut random = |below: usize| {
            // The pseudorandom generator xorshift32 produces the same texts in every run.
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            state as usize % below
        };
        for _ in 0..2000 {
            let text: String =
                (0..random(40)).map(|_| pieces[random(pieces.len())].repeat(1 + random(9).pow(3) % 70)).collect();
            let (length, fix) = (text.len() + 4, pieces[random(pieces.len())].repeat(random(4)));
            let span = Span::new(FileId(0), random(length) as u32, random(length) as u32);
            let diagnostic = at(random(length), random(length)).note_at(span, "note").fix(fix);
            let sources = file(text);
            plain(&diagnostic, &sources);
        }
    }
}
