//! Tests that the outputs for each corpus file and each dictionary do not change unintentionally. `tests/frozen.tsv` contains
//! digests of the generated Rust, the diagnostics and the resolved values.
//!
//! `LEXIBUS_BLESS=1 LEXIBUS_LANE=full cargo test -p lexibus-codegen --test frozen` updates the list. Set
//! `LEXIBUS_FROZEN=FOLDER` to write the outputs to a folder, for example to compare two versions.

mod corpus_support;
#[path = "frozen/values.rs"]
mod values;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::sync::Mutex;

use corpus_support::{bindings, files_of, is_read, lane};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Diagnostic;
use lexibus_codegen::source::Source;

const LIST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/frozen.tsv");
const KINDS: [&str; 3] = ["rust", "diagnostics", "values"];

const HEADER: &str = "# Digests of what is generated, reported and read of each file. Written by codegen/tests/frozen.rs: do not edit.\n\
    # file\trust\tdiagnostics\tvalues\n";

/// An input file and its name in `tests/frozen.tsv`.
struct Frozen {
    name: String,
    source: Source,
}

fn frozen_files() -> Vec<Frozen> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
    let drives = ["aec-vector-step.toml", "demo-drive.eds", "eco.toml", "hsd-sm137-sm140.toml", "kollmorgen-akd.toml"];
    let drive = |name: &str| Frozen {
        name: format!("dictionaries/{name}"),
        source: Source::read(&folder.join(name)).expect("a dictionary"),
    };
    let mut all: Vec<Frozen> = drives.into_iter().map(drive).collect();
    for format in ["eds", "esi", "gsdml"] {
        let files = files_of(format).into_iter().flatten();
        all.extend(files.map(|file| Frozen {
            name: format!("{format}/{}", file.name),
            source: Source::new(file.name.as_str(), file.bytes),
        }));
    }
    all
}

/// Returns the outputs for a file in the order of [`KINDS`].
fn texts(source: Source) -> [String; 3] {
    let options = Options::default();
    let compilation = check(source, &options);
    let rust = compilation.rust(&options.rust).unwrap_or_default();
    let values = compilation.catalog.as_ref().map(values::text).unwrap_or_default();
    [rust, diagnostics(&compilation), values]
}

fn diagnostics(compilation: &Compilation) -> String {
    let mut text = String::new();
    for entry in compilation.diagnostics.list() {
        // Leave `more` out, because the message already contains this number.
        let Diagnostic { code, severity, span, message, label, notes, help, fix, more: _ } = entry;
        let _ = writeln!(text, "{} {severity:?} {}..{} {message} | {label:?}", code.id, span.start, span.end);
        for note in notes {
            let _ = writeln!(text, "    {}", note.message);
        }
        if let Some(help) = help {
            let _ = writeln!(text, "    {help} | {fix:?}");
        }
    }
    text
}

fn digest(text: &str) -> String {
    Source::new("text", text.as_bytes().to_vec()).sha256()[..16].to_owned()
}

/// Reads the expected digests of each file from `tests/frozen.tsv`.
fn listed() -> BTreeMap<String, Vec<String>> {
    let text = std::fs::read_to_string(LIST).unwrap_or_default();
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let parts = lines.map(|line| line.split('\t').map(str::to_owned).collect::<Vec<_>>());
    parts.filter_map(|mut parts| (!parts.is_empty()).then(|| (parts.remove(0), parts))).collect()
}

#[test]
fn nothing_changes_unnoticed() {
    let found = Mutex::new(BTreeMap::new());
    bindings::on_all_processors(frozen_files(), |file| {
        let texts = texts(file.source);
        if let Some(folder) = std::env::var_os("LEXIBUS_FROZEN") {
            for (kind, text) in KINDS.iter().zip(&texts) {
                let path = Path::new(&folder).join(format!("{}.{kind}", file.name.replace('/', "__")));
                std::fs::create_dir_all(&folder)
                    .and_then(|()| std::fs::write(path, text))
                    .expect("a folder for the texts");
            }
        }
        found.lock().expect("the digests").insert(file.name, texts.map(|text| digest(&text)).to_vec());
    });
    let found = found.into_inner().expect("the digests");
    if std::env::var_os("LEXIBUS_BLESS").is_some() && lane::is_full() {
        let line = |(name, digests): (&String, &Vec<String>)| format!("{name}\t{}\n", digests.join("\t"));
        std::fs::write(LIST, found.iter().map(line).fold(HEADER.to_owned(), |all, line| all + &line))
            .expect("the list");
        return;
    }
    let listed = listed();
    let mut changed = Vec::new();
    for (name, digests) in &found {
        let Some(before) = listed.get(name) else {
            changed.push(format!("{name}: not in the list"));
            continue;
        };
        let differ = KINDS.iter().zip(before.iter().zip(digests)).filter(|(_, (before, now))| before != now);
        changed.extend(differ.map(|(kind, _)| format!("{name}: {kind}")));
    }
    let is_there = |name: &str| name.split_once('/').is_some_and(|(format, file)| is_read(format, file));
    let gone =
        listed.keys().filter(|name| corpus_support::folder().is_some() && is_there(name) && !found.contains_key(*name));
    changed.extend(gone.map(|name| format!("{name}: in the list, and not in the corpus")));
    assert!(changed.is_empty(), "{} differ from tests/frozen.tsv:\n{}", changed.len(), changed.join("\n"));
}
