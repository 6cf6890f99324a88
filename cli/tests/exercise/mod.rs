//! What becomes of any input: it is read, checked, told and emitted, and nothing of that panics.
//!
//! Two crates have this module: the test of damaged files, and the fuzz targets.

use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{codes, render, Diagnostic, Level};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_export::diagnostics::{json as report, sarif};
use lexibus_export::{eds, esi, gsdml, json};
use lexibus_site::compare::compare;
use lexibus_site::{Format, Site};

/// Takes an input as far as it goes: spans lie in their files, and what is emitted is Rust. Whether it is a description.
pub fn exercise(name: &str, bytes: &[u8]) -> bool {
    exercise_with(name, bytes, Vec::new())
}

/// The same with tables that correct the description.
pub fn exercise_with(name: &str, bytes: &[u8], overlays: Vec<Source>) -> bool {
    let compilation = check(Source::new(name, bytes.to_vec()), &everything_reported(overlays));
    let list = compilation.diagnostics.list();
    let some: Vec<Diagnostic> = list.iter().take(12).chain(list.iter().rev().take(3)).cloned().collect();
    for found in &some {
        told(&compilation, found);
    }
    let log: Result<serde_json::Value, _> = serde_json::from_str(&sarif::document(&some, &compilation.sources, "0"));
    assert!(log.is_ok(), "{log:?}");
    serde_json::to_string(&json::info(&compilation)).expect("a summary");
    emitted(&compilation);
    if bytes.len() < SHORT {
        documented(&compilation);
    }
    compilation.catalog.is_some()
}

/// Inputs of fewer bytes get pages, which are many for each of their bytes.
const SHORT: usize = 4_000;

/// The pages, and the differences from itself.
fn documented(compilation: &Compilation) {
    for format in [Format::Html, Format::Markdown] {
        let mut site = Site::new(format);
        site.add_compilation("fuzz", compilation);
        assert!(!site.finish().is_empty());
    }
    if let Some(catalog) = &compilation.catalog {
        let changes = compare(catalog, catalog);
        assert!(changes.is_empty(), "a description differs from itself: {}", changes[0]);
    }
}

fn told(compilation: &Compilation, found: &Diagnostic) {
    let (start, end) = (found.span.start as usize, found.span.end as usize);
    let source = compilation.sources.get(found.span.file.0 as usize);
    let inside = source.is_some_and(|source| source.text().get(start..end).is_some());
    assert!(inside, "{}: {:?} isn't in the file", found.code.id, found.span);
    assert!(!render::terminal::render(found, &compilation.sources, true).is_empty());
    assert!(!report::line(found, &compilation.sources).contains('\n'));
    assert!(!compilation.one_line(found).contains('\n'));
}

/// Most of the lints are off by default: on, they run more of the compiler.
fn everything_reported(overlays: Vec<Source>) -> Options {
    let mut options = Options { overlays, ..Options::default() };
    for code in codes::CODES {
        options.levels.set(code.id, Level::Warn).expect("a code");
    }
    options
}

/// The Rust of every device, even where there are errors, and even if nobody would ask for it.
fn emitted(compilation: &Compilation) {
    /// More text than this takes `syn` too long.
    const PARSED: usize = 60_000;
    let Some(catalog) = &compilation.catalog else { return };
    exported(catalog);
    let Some(text) = rust::emit_catalog(catalog, &Options::default().rust) else { return };
    if text.len() < PARSED {
        if let Err(error) = syn::parse_file(&text) {
            panic!("what is emitted is no Rust: {error}:\n{text}");
        }
    }
}

/// The exports, whatever they leave out or ask for.
fn exported(catalog: &Catalog) {
    let _ = esi::export(catalog, &esi::Options::default());
    let _ = gsdml::export(catalog, &gsdml::Options::default());
    for device in catalog.devices.iter().take(2) {
        eds::export(catalog, device, eds::Flavour::Dcf);
    }
}
