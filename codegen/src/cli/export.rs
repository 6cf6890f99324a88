//! `lexibus export`: device descriptions in another format, and a list of what that format has no place for.

use std::path::Path;

use super::args::{Export, ExportFormat, MessageFormat};
use super::inputs;
use super::output::Target;
use super::report::Reporter;
use super::Failure;
use crate::backend::eds::{self, Flavour};
use crate::compile::Compilation;
use crate::ir::{Catalog, Device};

pub(super) fn run(export: &Export) -> Result<bool, Failure> {
    if export.inputs.message_format == MessageFormat::Sarif {
        let message = "what an export leaves out is told as text or JSON lines, not as SARIF";
        return Err(Failure::Usage(message.into()));
    }
    let mut options = export.inputs.options()?;
    // What profiles add is known wherever the export is read, and no place for it is no loss.
    options.no_profiles = true;
    let mut reporter = Reporter::new(&export.inputs, false);
    let mut target = Target::new(&export.inputs, export.out.as_deref(), export.check)?;
    inputs::each(&export.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        match compilation.catalog.as_ref().filter(|_| compilation.is_usable()) {
            Some(catalog) => devices(export, input, &compilation, catalog, &mut target, &mut reporter),
            None => Ok(()),
        }
    })?;
    reporter.finish()
}

/// Writes every device of an input.
fn devices(
    export: &Export,
    input: &Path,
    compilation: &Compilation,
    catalog: &Catalog,
    target: &mut Target<'_>,
    reporter: &mut Reporter,
) -> Result<(), Failure> {
    let (flavour, ending) = match export.format {
        ExportFormat::Eds => (Flavour::Eds, "eds"),
        ExportFormat::Dcf => (Flavour::Dcf, "dcf"),
    };
    let exports = catalog.devices.iter().filter_map(|device| Some((device, eds::export(catalog, device, flavour)?)));
    let exports: Vec<(&Device, eds::Export)> = exports.collect();
    if exports.is_empty() && !target.many {
        reporter
            .error(&format!("{}: it describes no device with objects, so there is nothing to export", input.display()));
    }
    if exports.len() > 1 && !target.takes_many() {
        let message = "devices: choose one with --device, or name a folder with --out";
        reporter.error(&format!("{}: it describes {} {message}", input.display(), exports.len()));
        return Ok(());
    }
    for (device, file) in &exports {
        let name = || file_name(input, device, exports.len() > 1);
        target.put(name, ending, &file.text, reporter)?;
        let source = compilation.sources.first().map_or("", |source| source.name());
        let whose = if exports.len() > 1 { device.name.as_str() } else { "" };
        reporter.export_notes(source, whose, &file.notes)?;
    }
    Ok(())
}

/// The name of the input; of several devices, with that of the device.
fn file_name(input: &Path, device: &Device, several: bool) -> String {
    let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    if !several {
        return stem;
    }
    let names = [&device.identity.order_code, &device.name, &device.id];
    let name = names.into_iter().find(|name| !name.is_empty()).map_or("device", |name| name.as_str());
    let is_safe = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.');
    let name: String = name.chars().map(|letter| if is_safe(letter) { letter } else { '_' }).collect();
    format!("{stem}_{name}")
}
