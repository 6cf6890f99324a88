//! Diagnostics for programs, as JSON lines.

use lexibus_codegen::diagnostics::render::marked::{self, MarkedSource};
use lexibus_codegen::diagnostics::{Diagnostic, Note};
use lexibus_codegen::source::Source;

use super::ordered::{list, object, without_nulls, Json};

/// Returns the diagnostic as one line of JSON, without a line feed.
///
/// Lines and columns start at 1; columns count characters. `start` and `end` are byte offsets in the file's text, which
/// is decoded to UTF-8 without a byte order mark. `end` and `end_column` are exclusive. `source` is the line on which
/// the marked text starts. If this line is longer than 200 characters, `…` replaces the text that is far from the
/// marked text. A diagnostic about a whole file has a `file` and no position. The compiler keeps a limited number of
/// diagnostics per code and file. If the compiler left out diagnostics, `more` in the last diagnostic of the code is
/// their number; otherwise, `more` is `null`.
pub fn line(diagnostic: &Diagnostic, sources: &[Source]) -> String {
    let place = MarkedSource::of(diagnostic.span, sources);
    let mark = place.and_then(|place| place.mark);
    let line = object([
        ("code", diagnostic.code.id.into()),
        ("name", diagnostic.code.name.into()),
        ("severity", diagnostic.severity.name().into()),
        ("message", diagnostic.message.as_str().into()),
        ("file", place.map(|place| place.source.name()).into()),
        ("line", mark.map(|mark| mark.from.line).into()),
        ("column", mark.map(|mark| mark.from.column).into()),
        ("end_line", mark.map(|mark| mark.to.line).into()),
        ("end_column", mark.map(|mark| mark.to.column).into()),
        ("start", mark.map(|mark| mark.start).into()),
        ("end", mark.map(|mark| mark.end).into()),
        ("source", place.and_then(|place| Some(marked::quoted(place.source, &place.mark?))).into()),
        ("label", Some(diagnostic.label.as_str()).filter(|label| !label.is_empty()).into()),
        ("notes", list(diagnostic.notes.iter().map(|each| note(each, sources)))),
        ("help", diagnostic.help.as_deref().into()),
        ("fix", diagnostic.fix.as_deref().into()),
        ("more", Some(diagnostic.more).filter(|&more| more > 0).into()),
    ]);
    line.to_text()
}

fn note<'a>(note: &'a Note, sources: &'a [Source]) -> Json<'a> {
    let place = note.span.and_then(|span| MarkedSource::of(span, sources));
    let from = place.and_then(|place| place.mark).map(|mark| mark.from);
    without_nulls([
        ("message", note.message.as_str().into()),
        ("file", place.map(|place| place.source.name()).into()),
        ("line", from.map(|from| from.line).into()),
        ("column", from.map(|from| from.column).into()),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::codes;
    use lexibus_codegen::source::{FileId, Span};

    #[test]
    fn a_line_has_all_parts_of_a_diagnostic() {
        let sources = [Source::new("a/drive.eds", b"[1018]\r\nGer\xe4t=012\r\n".to_vec())];
        let diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(0), 15, 18), "`012` is octal")
            .label("read as 10")
            .note("a fact")
            .note_at(Span::new(FileId(0), 1, 5), "a place")
            .note_at(Span::default(), "a file")
            .help("write it in decimal")
            .fix("10");
        insta::assert_snapshot!(line(&diagnostic, &sources), @r#"{"code":"EDS020","name":"octal-number","severity":"error","message":"`012` is octal","file":"a/drive.eds","line":2,"column":7,"end_line":2,"end_column":10,"start":15,"end":18,"source":"Gerät=012","label":"read as 10","notes":[{"message":"a fact"},{"message":"a place","file":"a/drive.eds","line":1,"column":2},{"message":"a file","file":"a/drive.eds"}],"help":"write it in decimal","fix":"10","more":null}"#);
    }

    #[test]
    fn missing_values_are_null() {
        let diagnostic = Diagnostic::new(&codes::NOT_AN_EDS, Span::default(), "no section\n\u{9b}2J\u{1b}");
        insta::assert_snapshot!(line(&diagnostic, &[]), @r#"{"code":"EDS002","name":"not-an-eds","severity":"error","message":"no section\n\u009b2J\u001b","file":null,"line":null,"column":null,"end_line":null,"end_column":null,"start":null,"end":null,"source":null,"label":null,"notes":[],"help":null,"fix":null,"more":null}"#);
        let sources = [Source::new("x.eds", Vec::new())];
        assert!(line(&diagnostic, &sources).contains(r#""file":"x.eds","line":null"#));
    }

    #[test]
    fn any_span_has_a_position() {
        let text = format!("{}€{}", "x".repeat(500), "y".repeat(500));
        let sources = [Source::new("x.eds", text.into_bytes())];
        for (start, end) in [(501, 502), (0, u32::MAX), (u32::MAX - 1, u32::MAX), (7, 3)] {
            let diagnostic = Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), start, end), "");
            let line: serde_json::Value = serde_json::from_str(&line(&diagnostic, &sources)).unwrap();
            let source = line["source"].as_str().unwrap_or_default();
            assert!(source.chars().count() <= marked::MAX_CHARS + 2);
        }
        let diagnostic = Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), 501, 502), "");
        let line: serde_json::Value = serde_json::from_str(&line(&diagnostic, &sources)).unwrap();
        assert_eq!(
            (line["start"].as_u64(), line["end"].as_u64(), line["column"].as_u64()),
            (Some(500), Some(503), Some(501))
        );
        assert_eq!(line["source"], format!("…{}€{}…", "x".repeat(60), "y".repeat(139)));
    }
}
