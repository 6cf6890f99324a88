//! Compiles each EDS and XML input with all line ends. Adds a byte order mark to EDS files, and to XML files without an
//! XML declaration. Compiles each EDS also in Windows-1252 if this encoding contains all its characters. The IR and the
//! diagnostics must not depend on the form. The fast lane tests fewer combinations, and only the `quirks` cases.

use lexibus_codegen::compile::{check, Compilation};
use lexibus_codegen::source::Source;

use crate::case::{ending, Case};
use crate::corpus_support::{lane, round_trip::content};

/// Checks that all forms of a test case's inputs give the same IR and diagnostics.
///
/// # Errors
///
/// Returns the name of the first form whose IR or diagnostics differ.
pub fn all_say_the_same(case: &Case) -> Result<(), String> {
    if case.settings.one_form || !(lane::is_full() || case.name().starts_with("quirks-")) {
        return Ok(());
    }
    let options = case.options();
    for input in case.inputs() {
        let forms = forms(&input);
        if forms.is_empty() {
            continue;
        }
        let name = input.name().to_owned();
        let plain = check(input, &options);
        let (described, found) = (plain.catalog.as_ref().map(content), findings(&plain));
        for (form, bytes) in forms {
            let other = check(case.source_of(&name, bytes), &options);
            if findings(&other) != found {
                return Err(format!("{name} as {form}: {:?} instead of {found:?}", findings(&other)));
            }
            if other.catalog.as_ref().map(content) != described {
                return Err(format!("{name} as {form}: the IR differs"));
            }
        }
    }
    Ok(())
}

/// Returns the file in other forms, which differ in line ends, byte order mark and encoding: the name and the bytes of
/// each form. The list is empty for register tables and register lists.
fn forms(input: &Source) -> Vec<(String, Vec<u8>)> {
    let is_eds = match ending(input.name()) {
        "eds" | "dcf" => true,
        "xml" | "xdd" | "xdc" | "xpd" => false,
        _ => return Vec::new(),
    };
    let text = input.text();
    let mut forms = Vec::new();
    for (name, end) in [("LF", "\n"), ("CRLF", "\r\n"), ("CR", "\r")] {
        let text = text.replace("\r\n", "\n").replace('\n', end);
        forms.push((name.to_owned(), text.clone().into_bytes()));
        if is_eds || !text.starts_with("<?xml") {
            forms.push((format!("{name} with a byte order mark"), [b"\xef\xbb\xbf", text.as_bytes()].concat()));
        }
        let (cp1252, _, lossy) = encoding_rs::WINDOWS_1252.encode(&text);
        if is_eds && !lossy {
            forms.push((format!("{name} in Windows-1252"), cp1252.into_owned()));
        }
    }
    if !lane::is_full() {
        forms.retain(|(name, _)| {
            matches!(name.as_str(), "CRLF with a byte order mark" | "CRLF" | "CR" | "LF in Windows-1252")
        });
    }
    forms
}

/// Returns the code, line and column of each diagnostic. Diagnostics about the encoding differ between forms and are
/// excluded.
fn findings(compilation: &Compilation) -> Vec<String> {
    let list = compilation.diagnostics.list().iter().filter(|found| found.code.id != "EDS013");
    let position = |file: u32, offset| compilation.sources[file as usize].position(offset);
    list.map(|found| {
        let at = position(found.span.file.0, found.span.start);
        format!("{} {}:{}", found.code.id, at.line, at.column)
    })
    .collect()
}
