//! Runs the complete compiler on an input and checks that it does not panic.
//!
//! The tests of damaged files and the fuzz targets use this module.

use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{codes, render, Diagnostic, Level};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_export::diagnostics::{json as report, sarif};
use lexibus_export::{eds, esi, gsdml, json, sii};
use lexibus_site::compare::compare;
use lexibus_site::{Format, Site};

/// Compiles an input as far as possible. Checks that spans are within their files and that the output is valid Rust.
///
/// Returns whether the compiler creates a catalog from the input.
pub fn exercise(name: &str, bytes: &[u8]) -> bool {
    exercise_with(name, bytes, Vec::new())
}

/// Compiles an input like [`exercise`], with overlays.
pub fn exercise_with(name: &str, bytes: &[u8], overlays: Vec<Source>) -> bool {
    let compilation = check(Source::new(name, bytes.to_vec()), &everything_reported(overlays));
    let list = compilation.diagnostics.list();
    let some: Vec<Diagnostic> = list.iter().take(12).chain(list.iter().rev().take(3)).cloned().collect();
    for found in &some {
        rendered(&compilation, found);
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

/// Maximum size of inputs for which documentation is written, because writing it takes long.
const SHORT: usize = 4_000;

/// Writes the documentation of a description and compares the description with itself.
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

/// Checks the span of a diagnostic, and renders the diagnostic for a terminal, as JSON and as one line of text.
fn rendered(compilation: &Compilation, found: &Diagnostic) {
    let (start, end) = (found.span.start as usize, found.span.end as usize);
    let source = compilation.sources.get(found.span.file.0 as usize);
    let inside = source.is_some_and(|source| source.text().get(start..end).is_some());
    assert!(inside, "{}: {:?} is not in the file", found.code.id, found.span);
    assert!(!render::terminal::render(found, &compilation.sources, true).is_empty());
    assert!(!report::line(found, &compilation.sources).contains('\n'));
    assert!(!compilation.one_line(found).contains('\n'));
}

/// Returns options that enable all lints. By default, some lints are disabled.
fn everything_reported(overlays: Vec<Source>) -> Options {
    let mut options = Options { overlays, ..Options::default() };
    for code in codes::CODES {
        options.levels.set(code.id, Level::Warn).expect("a code");
    }
    options
}

/// Generates the exports and the Rust code of all devices, even if there are errors.
fn emitted(compilation: &Compilation) {
    /// Maximum size of generated code that is parsed to check it, because `syn` is slow.
    const PARSED: usize = 60_000;
    let Some(catalog) = &compilation.catalog else { return };
    exported(catalog);
    let Some(text) = rust::emit_catalog(catalog, &Options::default().rust) else { return };
    if text.len() < PARSED {
        if let Err(error) = syn::parse_file(&text) {
            panic!("the output is not Rust: {error}:\n{text}");
        }
    }
}

/// Exports the catalog as ESI and as GSDML, and the first two devices as DCF. Ignores notes and refusals.
fn exported(catalog: &Catalog) {
    let _ = esi::export(catalog, &esi::Options::default());
    let _ = gsdml::export(catalog, &gsdml::Options::default());
    for device in catalog.devices.iter().take(2) {
        eds::export(catalog, device, eds::Flavor::Dcf);
        let _ = sii::export(device, &sii::Options::default());
    }
}
