//! The generated Rust has the form that `prettyplease` would give it, for every file of the corpus.

mod corpus_support;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::Presence;

/// `prettyplease` drops comments that are no documentation: the header is all that we have of them.
fn without_header(text: &str) -> String {
    text.lines()
        .skip_while(|line| line.starts_with("//"))
        .skip_while(|line| line.is_empty())
        .map(|line| format!("{line}\n"))
        .collect()
}

fn assert_canonical(name: &str, text: &str) {
    let text = without_header(text);
    let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
    let expected = prettyplease::unparse(&parsed);
    for (line, (ours, theirs)) in text.lines().zip(expected.lines()).enumerate() {
        assert_eq!(ours, theirs, "{name}, line {}", line + 1);
    }
    assert_eq!(text.len(), expected.len(), "{name}");
}

#[test]
fn output_is_as_prettyplease_prints_it() {
    let Some(files) = corpus_support::files() else { return };
    let mut compiled = 0;
    for file in files {
        let mut options = Options::default();
        options.rust.table = Presence::Feature("table".into());
        let compilation = check(Source::new(file.name.as_str(), file.bytes), &options);
        if let Some(text) = compilation.rust(&options.rust) {
            assert_canonical(&file.name, &text);
            compiled += 1;
        }
    }
    assert!(compiled > 200, "only {compiled} files were compiled");
}
