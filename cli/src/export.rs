//! `lexibus export`: writes device descriptions in another format, and reports what that format cannot express.

use std::path::Path;

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_export::eds::{self, Flavor, Reals};
use lexibus_export::{esi, gsdml, sii, Export as Exported, Note, Refusal};

use super::args::{Export, ExportFormat, MessageFormat, RealForm};
use super::inputs;
use super::output::Target;
use super::report::Reporter;
use super::Failure;

/// An export format with its options.
enum Format {
    Eds(eds::Options),
    Esi(Box<esi::Options>),
    Sii(Box<sii::Options>),
    Gsdml(Box<gsdml::Options>),
}

impl Format {
    fn new(export: &Export) -> Result<Self, Failure> {
        let reals = match export.real {
            None | Some(RealForm::Decimal) => Reals::Decimal,
            Some(RealForm::Hex) => Reals::Pattern,
        };
        let mut format = match export.format {
            ExportFormat::Eds => Format::Eds(eds::Options { flavor: Flavor::Eds, reals }),
            ExportFormat::Dcf => Format::Eds(eds::Options { flavor: Flavor::Dcf, reals }),
            ExportFormat::Esi => Format::Esi(Box::default()),
            ExportFormat::Sii => Format::Sii(Box::default()),
            ExportFormat::Gsdml => Format::Gsdml(Box::default()),
        };
        if export.real.is_some() && !matches!(format, Format::Eds(_)) {
            return Err(Failure::Usage("--real is only for the formats eds and dcf".into()));
        }
        for (key, value) in &export.facts {
            let set = match &mut format {
                Format::Eds(_) => Err("an EDS or DCF needs no additional facts".to_owned()),
                Format::Esi(options) => options.set(key, value),
                Format::Sii(options) => options.set(key, value),
                Format::Gsdml(options) => options.set(key, value),
            };
            set.map_err(|message| Failure::Usage(format!("--set {key}: {message}")))?;
        }
        Ok(format)
    }

    /// Returns the error message for an input that contains nothing to export.
    fn nothing(&self) -> &'static str {
        match self {
            Format::Eds(_) => "no device with objects",
            Format::Esi(_) => "no EtherCAT slave and no device with objects",
            Format::Sii(_) => "no EtherCAT slave",
            Format::Gsdml(_) => "no PROFINET device and no process image",
        }
    }

    fn ending(&self) -> &'static str {
        match self {
            Format::Eds(eds::Options { flavor: Flavor::Eds, .. }) => "eds",
            Format::Eds(_) => "dcf",
            Format::Esi(_) | Format::Gsdml(_) => "xml",
            Format::Sii(_) => "bin",
        }
    }
}

/// An exported file, with its device if the format needs one file per device.
struct File<'c> {
    device: Option<&'c Device>,
    /// File name that the format requires. `None` means that the name of the input is used.
    name: Option<String>,
    content: Vec<u8>,
    notes: Vec<Note>,
}

impl<'c> File<'c> {
    fn new(device: Option<&'c Device>, name: Option<String>, exported: Exported) -> Self {
        File { device, name, content: exported.text.into_bytes(), notes: exported.notes }
    }
}

pub(super) fn run(export: &Export) -> Result<bool, Failure> {
    if export.inputs.printing.message_format == MessageFormat::Sarif {
        let message = "export notes can be printed as text or JSON lines, not as SARIF";
        return Err(Failure::Usage(message.into()));
    }
    let format = Format::new(export)?;
    let mut options = export.inputs.options()?;
    // Export only facts of the description, without those that profiles add.
    options.no_profiles = true;
    options.select.pdos = matches!(format, Format::Eds(_));
    let mut reporter = Reporter::new(&export.inputs, false)?;
    let mut target = Target::new(&export.inputs, export.out.as_deref(), export.check)?;
    inputs::each_by_path(&export.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        match compilation.usable() {
            Some(catalog) => write(&format, input, &compilation, catalog, &mut target, &mut reporter),
            None => Ok(()),
        }
    })?;
    reporter.finish()
}

/// Writes the exported files of an input. Reports an error if there are several files and the output is not a folder.
fn write(
    format: &Format,
    input: &Path,
    compilation: &Compilation,
    catalog: &Catalog,
    target: &mut Target<'_>,
    reporter: &mut Reporter,
) -> Result<(), Failure> {
    let Some(files) = files(format, input, catalog, target, reporter) else { return Ok(()) };
    if files.len() > 1 && !target.takes_many() {
        let message = "devices: choose one with --device, or name a folder with --out";
        reporter.error(&format!("{}: the input describes {} {message}", input.display(), files.len()));
        return Ok(());
    }
    for file in &files {
        let several = files.len() > 1;
        let name = || match &file.name {
            Some(name) => name.clone(),
            None => file_name(input, file.device.filter(|_| several)),
        };
        target.put(name, format.ending(), &file.content, reporter)?;
        let source = compilation.sources.first().map_or("", |source| source.name());
        let whose = file.device.filter(|_| several).map_or("", |device| device.name.as_str());
        reporter.export_notes(source, whose, &file.notes)?;
    }
    Ok(())
}

/// Returns the exported files of an input: one EDS or SII per device, or one file for all devices.
///
/// Returns `None` if the input contains nothing to export. Reports this as an error unless the command has several
/// inputs or a folder as an input. Also reports an error and returns `None` if facts that the format requires are
/// missing, or if the content is too long for an EEPROM.
fn files<'c>(
    format: &Format,
    input: &Path,
    catalog: &'c Catalog,
    target: &Target<'_>,
    reporter: &mut Reporter,
) -> Option<Vec<File<'c>>> {
    let one = |exported, name| vec![File::new(None, name, exported)];
    let files = match format {
        Format::Eds(options) => {
            let file = |device| Some(File::new(Some(device), None, eds::export(catalog, device, *options)?));
            of_devices(catalog.devices.iter().filter_map(file).map(Ok))
        }
        Format::Esi(options) => esi::export(catalog, options).map(|exported| one(exported, None)),
        Format::Sii(options) => {
            let file = |device| {
                let sii::Image { bytes, notes } = sii::export(device, options)?;
                Ok(File { device: Some(device), name: None, content: bytes, notes })
            };
            of_devices(catalog.devices.iter().map(file).filter(|file| !matches!(file, Err(Refusal::Nothing))))
        }
        Format::Gsdml(options) => {
            gsdml::export(catalog, options).map(|exported| one(exported, gsdml::file_name(catalog, options)))
        }
    };
    let message = match files {
        Ok(files) => return Some(files),
        Err(Refusal::Nothing) if target.many => return None,
        Err(Refusal::Nothing) => format!("there is nothing to export: the input describes {}", format.nothing()),
        Err(refusal @ (Refusal::Missing(_) | Refusal::TooLong { .. })) => format!("{refusal}, with --set KEY=VALUE"),
    };
    reporter.error(&format!("{}: {message}", input.display()));
    None
}

/// Returns the files of several devices. Refuses a list without files.
fn of_devices<'c>(files: impl Iterator<Item = Result<File<'c>, Refusal>>) -> Result<Vec<File<'c>>, Refusal> {
    let files: Vec<File<'c>> = files.collect::<Result<_, _>>()?;
    if files.is_empty() {
        return Err(Refusal::Nothing);
    }
    Ok(files)
}

/// Returns a file name: the name of the input, followed by the order code, name or ID of `device` if there is a device.
fn file_name(input: &Path, device: Option<&Device>) -> String {
    let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let Some(device) = device else { return stem };
    let names = [&device.identity.order_code, &device.name, &device.id];
    let name = names.into_iter().find(|name| !name.is_empty()).map_or("device", |name| name.as_str());
    let is_safe = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.');
    let name: String = name.chars().map(|letter| if is_safe(letter) { letter } else { '_' }).collect();
    format!("{stem}_{name}")
}
