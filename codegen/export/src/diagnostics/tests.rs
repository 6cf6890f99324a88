//! Tests of all three formats.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::limits::MAX_SAME_DIAGNOSTICS;
use lexibus_codegen::source::{FileId, Source, Span};
use lexibus_codegen::text::steers;

use super::{github, json, sarif};

#[test]
fn the_number_of_further_diagnostics_is_a_value() {
    let mut diagnostics = Diagnostics::default();
    for at in 0..MAX_SAME_DIAGNOSTICS as u32 + 4 {
        diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), at, at + 1), "junk"));
    }
    diagnostics.sort();
    let sources = [Source::new("a.eds", vec![b'x'; 3])];
    let lines: Vec<serde_json::Value> =
        diagnostics.list().iter().map(|found| serde_json::from_str(&json::line(found, &sources)).unwrap()).collect();
    let mores: Vec<_> = lines.iter().filter_map(|line| line["more"].as_u64()).collect();
    assert_eq!((lines.len(), mores.as_slice(), &lines[0]["more"]), (MAX_SAME_DIAGNOSTICS + 1, &[4][..], &().into()));
    let log: serde_json::Value = serde_json::from_str(&sarif::document(diagnostics.list(), &sources, "")).unwrap();
    let results = log["runs"][0]["results"].as_array().unwrap();
    let counts: Vec<_> = results.iter().filter_map(|result| result["occurrenceCount"].as_u64()).collect();
    assert_eq!((results.len(), counts.as_slice()), (MAX_SAME_DIAGNOSTICS + 1, &[4][..]));
}

#[test]
fn no_span_panics() {
    let text = "a=\r\n\u{e9}\t\u{20ac}\u{6f22}\u{1f469}\u{200d}\u{1f680}\r\u{1b}[;\n\u{fdd0}";
    let sources = [Source::new("a.eds", text.into())];
    let length = text.len() as u32 + 3;
    for (start, end) in (0..length).flat_map(|start| (0..length).map(move |end| (start, end))) {
        let span = Span::new(FileId(0), start, end);
        let diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, span, "message").note_at(span, "note").fix("10");
        assert!(!json::line(&diagnostic, &sources).contains('\n'));
        assert!(!github::line(&diagnostic, &sources).contains(steers));
        assert!(serde_json::from_str::<serde_json::Value>(&sarif::document(&[diagnostic], &sources, "")).is_ok());
    }
}
