//! `lexibus generate`: writes Rust bindings to files or standard output, or compares them with existing files.

use std::path::Path;

use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::NOTHING_TO_GENERATE;
use lexibus_codegen::ir::Catalog;
use lexibus_export::json;

use super::args::Generate;
use super::inputs;
use super::output::Target;
use super::report::{summary_line, Reporter};
use super::Failure;

pub(super) fn run(generate: &Generate) -> Result<bool, Failure> {
    let options = generate.inputs.options()?;
    let rust_options = generate.rust_options();
    let mut reporter = Reporter::new(&generate.inputs, false)?;
    let mut target = Target::new(&generate.inputs, generate.out.as_deref(), generate.check)?;
    inputs::each_by_path(&generate.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        let summary = target.is_one_file().then(|| summary_line(&json::info(&compilation)));
        // The errors in the input have already been reported.
        let Some(catalog) = compilation.into_usable() else { return Ok(()) };
        let write = |sink: &mut dyn FnMut(&[u8])| {
            rust::write_catalog(&catalog, &rust_options, &mut |part| sink(part.as_bytes()))
        };
        let exists = target.put_parts(|| file_name(input, &catalog), "rs", summary, &mut reporter, write)?;
        // If there are several inputs, an input without a device is skipped.
        if !exists && !target.many {
            reporter.error(&format!("{}: {}", input.display(), NOTHING_TO_GENERATE));
        }
        Ok(())
    })?;
    target.summarize(&mut reporter);
    reporter.finish()
}

/// Returns the name of the output file: the input's file name in snake case. If the file name gives no valid name,
/// returns the name of the first device, or `device` if there is no device.
fn file_name(input: &Path, catalog: &Catalog) -> String {
    let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let name =
        rust::file_name(&stem).or_else(|| Some(rust::module_name(catalog.devices.first()?, catalog.files.first()?)));
    name.unwrap_or_else(|| "device".to_owned())
}
