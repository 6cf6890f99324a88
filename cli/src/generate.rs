//! `lexibus generate`: writes Rust bindings to files or standard output, or compares them with existing files.

use std::path::Path;

use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{self, Compilation};
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
    target.is_reported = true;
    inputs::each_by_path(&generate.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        match compilation.rust(&rust_options) {
            Some(text) => {
                if target.is_one_file() {
                    reporter.progress(&format!("read {}", summary_line(&json::info(&compilation))));
                }
                target.put(|| file_name(input, &compilation), "rs", &text, &mut reporter)
            }
            // The errors in the input have already been reported. If there are several inputs, an input without a
            // device is skipped.
            None if !compilation.is_usable() || target.many => Ok(()),
            None => {
                reporter.error(&format!("{}: {}", input.display(), compile::NOTHING_TO_GENERATE));
                Ok(())
            }
        }
    })?;
    target.summarize(&mut reporter);
    reporter.finish()
}

/// Returns the name of the output file: the input's file name in snake case. If the file name gives no valid name,
/// returns the name of the first device, or `device` if there is no device.
fn file_name(input: &Path, compilation: &Compilation) -> String {
    let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let name = rust::file_name(&stem).or_else(|| {
        let catalog = compilation.catalog.as_ref()?;
        Some(rust::module_name(catalog.devices.first()?, catalog.files.first()?))
    });
    name.unwrap_or_else(|| "device".to_owned())
}
