//! Diagnostics as workflow commands of GitHub Actions. When a change is reviewed, GitHub shows these diagnostics at the
//! marked lines.

use std::fmt::Write as _;

use lexibus_codegen::diagnostics::render::marked::MarkedSource;
use lexibus_codegen::diagnostics::Diagnostic;
use lexibus_codegen::source::Source;
use lexibus_codegen::text::steers;

/// Returns the diagnostic as one workflow command without a line feed:
/// `::warning file=drive.eds,line=2,col=7,title=EDS020 octal-number::message`.
///
/// Lines and columns start at 1; columns count characters. A diagnostic about a whole file has no `line` and `col`. The
/// message also contains the label, the notes and the help text of the diagnostic, on separate lines. A marked part of
/// several lines has `endLine` and no `col`, because GitHub ignores columns in this case.
pub fn line(diagnostic: &Diagnostic, sources: &[Source]) -> String {
    let mut command = format!("::{} ", diagnostic.severity.name());
    let place = MarkedSource::of(diagnostic.span, sources);
    if let Some(place) = place {
        let _ = write!(command, "file={},", property(place.source.name()));
    }
    if let Some(mark) = place.and_then(|place| place.mark) {
        let _ = match mark.to.line > mark.from.line {
            true => write!(command, "line={},endLine={},", mark.from.line, mark.to.line),
            false => write!(command, "line={},col={},", mark.from.line, mark.from.column),
        };
    }
    let title = format!("{} {}", diagnostic.code.id, diagnostic.code.name);
    let _ = write!(command, "title={}::{}", property(&title), escaped(&message(diagnostic, sources)));
    command
}

/// Returns the message with the label, the notes and the help text.
fn message(diagnostic: &Diagnostic, sources: &[Source]) -> String {
    let mut text = diagnostic.message.clone();
    if !diagnostic.label.is_empty() {
        let _ = write!(text, "\n{}", diagnostic.label);
    }
    for note in &diagnostic.notes {
        let place = note.span.and_then(|span| MarkedSource::of(span, sources));
        let line =
            place.and_then(|place| place.mark).map_or(String::new(), |mark| format!("line {}: ", mark.from.line));
        let _ = write!(text, "\nnote: {line}{}", note.message);
    }
    if let Some(help) = &diagnostic.help {
        let _ = write!(text, "\nhelp: {help}");
    }
    if let Some(fix) = &diagnostic.fix {
        let _ = match fix.is_empty() {
            true => write!(text, "\nhelp: remove the marked text"),
            false => write!(text, "\nhelp: write `{fix}` instead"),
        };
    }
    text
}

/// Escapes the text of a command. Control characters other than line ends become spaces.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '%' => escaped += "%25",
            '\r' => escaped += "%0D",
            '\n' => escaped += "%0A",
            letter if steers(letter) => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}

/// Escapes the value of a property.
fn property(text: &str) -> String {
    escaped(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::codes;
    use lexibus_codegen::source::{FileId, Span};

    #[test]
    fn a_command_has_the_position_and_all_texts() {
        let sources = [Source::new("a,b/drive: 100%.eds", b"[1018]\r\nGer\xe4t=012\r\n".to_vec())];
        let at = |start, end| Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(0), start, end), "`012` is octal");
        let full = at(15, 18).label("read as 10").note("a fact").note_at(Span::new(FileId(0), 1, 5), "a place");
        let full = full.help("100 %\u{1b}").fix("10");
        insta::assert_snapshot!(line(&full, &sources), @"::error file=a%2Cb/drive%3A 100%25.eds,line=2,col=7,title=EDS020 octal-number::`012` is octal%0Aread as 10%0Anote: a fact%0Anote: line 1: a place%0Ahelp: 100 %25 %0Ahelp: write `10` instead");
        insta::assert_snapshot!(line(&at(0, 12).fix(""), &sources), @"::error file=a%2Cb/drive%3A 100%25.eds,line=1,endLine=2,title=EDS020 octal-number::`012` is octal%0Ahelp: remove the marked text");
        insta::assert_snapshot!(line(&at(0, 0), &sources), @"::error file=a%2Cb/drive%3A 100%25.eds,title=EDS020 octal-number::`012` is octal");
        insta::assert_snapshot!(line(&at(0, 0), &[]), @"::error title=EDS020 octal-number::`012` is octal");
    }
}
