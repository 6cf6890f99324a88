//! What every fuzz target does with a file.

use lexibus_codegen::backend::{json, rust};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::render;
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

/// Reads, checks, renders and emits `bytes` as a file called `name`; nothing of it may panic.
pub fn everything(name: &str, bytes: &[u8]) {
    let compilation = check(Source::new(name, bytes.to_vec()), &Options::default());
    for diagnostic in compilation.diagnostics.list().iter().take(20) {
        render::terminal::render(diagnostic, &compilation.sources, true);
        render::json::line(diagnostic, &compilation.sources);
    }
    json::info(&compilation);
    if let Some(catalog) = &compilation.catalog {
        rust::emit_catalog(catalog, &RustOptions::default());
    }
}
