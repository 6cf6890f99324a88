//! Prints diagnostics and summaries.

use std::fmt::Write as _;
use std::io::{IsTerminal, Write};

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{render, Diagnostic, Severity};
use lexibus_codegen::facts::number::{hex16, hex32};
use lexibus_codegen::source::{FileId, Source, Span};
use lexibus_codegen::text::printable;
use lexibus_export::diagnostics::{json, sarif};
use lexibus_export::json::{DeviceInfo, Info, ModuleContent, ModuleInfo, PdoInfo, SubmoduleInfo};
use lexibus_export::Note;
use serde::Serialize;

use super::args::{ColorChoice, Inputs, MessageFormat};
use super::Failure;

/// A note of an export as a JSON object.
#[derive(Serialize)]
struct ExportNote<'a> {
    severity: &'static str,
    name: &'static str,
    message: &'static str,
    file: &'a str,
    device: &'a str,
    count: usize,
    first: &'a str,
}

/// Prints the diagnostics of all inputs in the selected format.
pub(super) struct Reporter {
    format: MessageFormat,
    color: bool,
    /// Whether diagnostics are the main output of the command, so that machine-readable diagnostics are printed to
    /// standard output.
    is_result: bool,
    errors: usize,
    warnings: usize,
    files: usize,
    /// Diagnostics of all inputs. SARIF output needs all diagnostics because it is a single document.
    kept: Vec<Diagnostic>,
    sources: Vec<Source>,
}

impl Reporter {
    pub(super) fn new(inputs: &Inputs, is_result: bool) -> Self {
        Reporter::with(inputs.message_format, inputs.color, is_result)
    }

    pub(super) fn with(format: MessageFormat, color: ColorChoice, is_result: bool) -> Self {
        let to_terminal = if is_result && format != MessageFormat::Text {
            std::io::stdout().is_terminal()
        } else {
            std::io::stderr().is_terminal()
        };
        let color = match color {
            ColorChoice::Auto => to_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
            ColorChoice::Always => true,
            ColorChoice::Never => false,
        };
        Reporter { format, color, is_result, errors: 0, warnings: 0, files: 0, kept: Vec::new(), sources: Vec::new() }
    }

    /// Reports the diagnostics of one input.
    pub(super) fn report(&mut self, compilation: &Compilation) -> Result<(), Failure> {
        self.files += 1;
        self.errors += compilation.diagnostics.count(Severity::Error);
        self.warnings += compilation.diagnostics.count(Severity::Warning);
        let diagnostics = compilation.diagnostics.list();
        match self.format {
            MessageFormat::Text => {
                let mut out = std::io::stderr().lock();
                for diagnostic in diagnostics {
                    let text = render::terminal::render(diagnostic, &compilation.sources, self.color);
                    writeln!(out, "{text}\n")?;
                }
            }
            MessageFormat::Json => {
                let lines = diagnostics.iter().map(|diagnostic| json::line(diagnostic, &compilation.sources));
                let text = lines.fold(String::new(), |text, line| text + &line + "\n");
                self.print(&text)?;
            }
            MessageFormat::Sarif => self.keep(compilation),
        }
        Ok(())
    }

    /// Prints the notes of an export with one note per line.
    pub(super) fn export_notes(&mut self, source: &str, device: &str, notes: &[Note]) -> Result<(), Failure> {
        for note in notes {
            match self.format {
                MessageFormat::Json => {
                    let line = ExportNote {
                        severity: "note",
                        name: note.kind.name(),
                        message: note.kind.text(),
                        file: source,
                        device,
                        count: note.count,
                        first: &note.first,
                    };
                    self.print(&(serde_json::to_string(&line).map_err(std::io::Error::other)? + "\n"))?;
                }
                _ => {
                    let whose = if device.is_empty() { String::new() } else { format!("{}: ", printable(device)) };
                    super::say(&format!("note: {}: {whose}{note}", printable(source)));
                }
            }
        }
        Ok(())
    }

    /// Reports an error that has no position in a file.
    pub(super) fn error(&mut self, message: &str) {
        self.errors += 1;
        super::say(&format!("error: {message}"));
    }

    /// Prints a progress message, unless the output is in a machine-readable format.
    pub(super) fn progress(&self, line: &str) {
        if self.format == MessageFormat::Text {
            super::say(line);
        }
    }

    /// Returns whether errors occurred.
    pub(super) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Prints the summary or the SARIF document. Returns whether no errors occurred.
    pub(super) fn finish(self) -> Result<bool, Failure> {
        match self.format {
            MessageFormat::Text if self.is_result || self.errors + self.warnings > 0 => {
                let files = if self.files == 1 { "1 file" } else { &format!("{} files", self.files) };
                super::say(&format!("{files}: {}", render::summary(self.errors, self.warnings)));
            }
            MessageFormat::Sarif => {
                let text = sarif::document(&self.kept, &self.sources, env!("CARGO_PKG_VERSION"));
                self.print(&(text + "\n"))?;
            }
            _ => {}
        }
        Ok(self.errors == 0)
    }

    /// Prints machine-readable diagnostics. The destination is standard output for `check`, and standard error for
    /// other commands.
    fn print(&self, text: &str) -> Result<(), Failure> {
        if self.is_result {
            std::io::stdout().lock().write_all(text.as_bytes())?;
        } else {
            std::io::stderr().lock().write_all(text.as_bytes())?;
        }
        Ok(())
    }

    /// Collects diagnostics and their source files for SARIF. Renumbers the file identifiers so that they are unique
    /// among all inputs.
    fn keep(&mut self, compilation: &Compilation) {
        let shift = self.sources.len() as u32;
        let moved = |span: Span| Span::new(FileId(span.file.0 + shift), span.start, span.end);
        for source in &compilation.sources {
            self.sources.push(Source::new(source.name(), source.bytes().into_owned()));
        }
        for diagnostic in compilation.diagnostics.list() {
            let mut diagnostic = diagnostic.clone();
            diagnostic.span = moved(diagnostic.span);
            for note in &mut diagnostic.notes {
                note.span = note.span.map(moved);
            }
            self.kept.push(diagnostic);
        }
    }
}

/// Returns a one-line summary of a file: `drive.eds: EDS, Demo Drive, 32 objects, 59 entries, 2 RPDOs, 2 TPDOs`.
pub(super) fn summary_line(info: &Info) -> String {
    let mut parts = vec![info.format.unwrap_or("unknown format").to_uppercase()];
    match info.devices.as_slice() {
        [device] => {
            parts.push(device_title(device));
            match device.registers {
                Some(registers) if registers > 0 => parts.extend(counted(registers, "register")),
                _ => {
                    parts.extend(counted(device.objects, "object").into_iter().chain(counted(device.entries, "entry")))
                }
            }
            parts.extend(counted(device.rx_pdos.len(), "RPDO"));
            parts.extend(counted(device.tx_pdos.len(), "TPDO"));
        }
        devices => parts.extend(counted(devices.len(), "device")),
    }
    parts.extend(info.dictionary.and_then(|dictionary| counted(dictionary.objects, "object")));
    parts.extend(info.modules.as_ref().and_then(|modules| counted(modules.len(), "module")));
    parts.extend(info.submodules.as_ref().and_then(|submodules| counted(submodules.len(), "submodule")));
    format!("{}: {}", info.file, parts.join(", "))
}

/// Formats a count such as `2 entries`. Returns `None` if the count is 0.
fn counted(count: usize, noun: &str) -> Option<String> {
    match (count, noun.strip_suffix('y')) {
        (0, _) => None,
        (1, _) => Some(format!("1 {noun}")),
        (_, Some(stem)) => Some(format!("{count} {stem}ies")),
        _ => Some(format!("{count} {noun}s")),
    }
}

/// Returns the summary of a file for human readers.
pub(super) fn info_text(info: &Info) -> String {
    let mut text = String::new();
    let _ =
        writeln!(text, "{} ({}, {})", printable(&info.file), info.format.unwrap_or("unknown format"), info.encoding);
    let number = |value: Option<u32>| value.map_or("unknown".to_owned(), hex32);
    for device in &info.devices {
        let _ = writeln!(text, "  {}", printable(&device_title(device)));
        let _ = writeln!(
            text,
            "    vendor {}, product {}, revision {}",
            number(device.vendor_id),
            number(device.product_code),
            number(device.revision)
        );
        let registers = device.registers.map(|number| format!(", {number} registers")).unwrap_or_default();
        let _ = writeln!(text, "    {} objects, {} entries{registers}", device.objects, device.entries);
        for (direction, pdos) in [("RPDO", &device.rx_pdos), ("TPDO", &device.tx_pdos)] {
            let all: Vec<String> = pdos.iter().map(pdo_text).collect();
            if !all.is_empty() {
                let _ = writeln!(text, "    {direction}: {}", all.join(", "));
            }
        }
    }
    if let Some(dictionary) = &info.dictionary {
        let _ = writeln!(text, "  a dictionary: {} objects, {} entries", dictionary.objects, dictionary.entries);
    }
    for module in info.modules.iter().flatten() {
        let _ = writeln!(text, "  module {} ({}): {}", printable(&module.id), hex32(module.ident), module_text(module));
    }
    for submodule in info.submodules.iter().flatten() {
        let SubmoduleInfo { input_bytes, output_bytes, .. } = submodule;
        let (id, ident) = (printable(&submodule.id), hex32(submodule.ident));
        let _ = writeln!(text, "  submodule {id} ({ident}): {input_bytes} bytes in, {output_bytes} bytes out");
    }
    for (severity, counts) in [("errors", &info.errors), ("warnings", &info.warnings)] {
        let all: Vec<String> = counts.iter().map(|(code, count)| format!("{code} × {count}")).collect();
        if !all.is_empty() {
            let _ = writeln!(text, "  {severity}: {}", all.join(", "));
        }
    }
    text
}

/// Returns the name of a device, preceded by the order code with which the user can select it.
fn device_title(device: &DeviceInfo) -> String {
    match (device.order_code.is_empty(), device.name.is_empty()) {
        (true, true) => "(no name)".to_owned(),
        (true, false) => device.name.clone(),
        (false, true) => device.order_code.clone(),
        (false, false) if device.name.contains(&device.order_code) => device.name.clone(),
        (false, false) => format!("{}: {}", device.order_code, device.name),
    }
}

fn module_text(module: &ModuleInfo) -> String {
    match &module.content {
        ModuleContent::Profinet { input_bytes, output_bytes, records, .. } => {
            format!("{input_bytes} bytes in, {output_bytes} bytes out, {} records", records.len())
        }
        ModuleContent::EtherCat { objects, entries, rx_pdos, tx_pdos } => {
            let pdos = rx_pdos.len() + tx_pdos.len();
            format!("{objects} objects, {entries} entries, {pdos} PDOs")
        }
    }
}

fn pdo_text(pdo: &PdoInfo) -> String {
    format!("{} ({} entries, {} bits)", hex16(pdo.index), pdo.entries, pdo.bits)
}
