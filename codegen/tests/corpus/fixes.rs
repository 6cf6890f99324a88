//! Tests the suggested fixes for corpus files. Each fix must remove its diagnostic and cause no other diagnostic.

use crate::corpus_support;

use std::sync::Mutex;

use corpus_support::{all_files, bindings::on_all_processors, fixes, lane};
use lexibus_codegen::compile::Options;
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;

#[test]
fn a_fix_removes_its_diagnostic_and_adds_none() {
    let Some(files) = all_files() else { return };
    let most = if lane::is_full() { 40 } else { 3 };
    let (applied, failures) = (Mutex::new(0), Mutex::new(Vec::new()));
    on_all_processors(files, |file| {
        let text = Source::new(file.name.as_str(), file.bytes).text().to_owned();
        let options = Options { levels: Levels::lenient(), ..Options::default() };
        match fixes::all_hold(&text, &options, most, |text| Source::new(file.name.as_str(), text.into_bytes())) {
            Ok(count) => *applied.lock().expect("the number") += count,
            Err(message) => failures.lock().expect("the failures").push(format!("{}: {message}", file.name)),
        }
    });
    let (applied, failures) = (applied.into_inner().expect("the number"), failures.into_inner().expect("the failures"));
    assert!(failures.is_empty(), "{} files:\n{}", failures.len(), failures.join("\n"));
    assert!(applied > lane::at_least(800), "only {applied} fixes");
}
