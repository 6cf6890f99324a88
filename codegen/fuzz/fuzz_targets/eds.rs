//! Any bytes, given as .eds: read, checked, rendered and emitted without a panic.
#![no_main]

use lexibus_codegen::backend::{json, rust};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::render;
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let compilation = check(Source::new("fuzz.eds", bytes.to_vec()), &Options::default());
    for diagnostic in compilation.diagnostics.list().iter().take(20) {
        render::terminal::render(diagnostic, &compilation.sources, true);
        render::json::line(diagnostic, &compilation.sources);
    }
    json::info(&compilation);
    if let Some(catalog) = &compilation.catalog {
        for device in &catalog.devices {
            rust::emit(device, &catalog.files[0], &RustOptions::default());
        }
    }
});
