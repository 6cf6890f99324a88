//! Prints the diagnostics of all inputs in the selected format.

use std::borrow::Cow;
use std::io::{IsTerminal, Write};

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{render, Diagnostic, Severity};
use lexibus_codegen::source::{FileId, Source, Span};
use lexibus_codegen::text::{count_of, printable};
use lexibus_export::diagnostics::{github, json, sarif};
use lexibus_export::Note;
use serde::Serialize;

use super::super::args::{ColorChoice, Inputs, MessageFormat, Printing};
use super::super::baseline::Baseline;
use super::super::Failure;
use super::limited::{limited, Shown};
use super::statistics::Statistics;

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
pub(in super::super) struct Reporter {
    format: MessageFormat,
    color: bool,
    /// Whether diagnostics are the main output of the command, so that machine-readable diagnostics are printed to
    /// standard output.
    is_result: bool,
    errors: usize,
    warnings: usize,
    files: usize,
    /// Whether to print all diagnostics of a code in a file.
    all: bool,
    /// Numbers of diagnostics by code, if these numbers are printed instead of the diagnostics.
    statistics: Option<Statistics>,
    /// Baseline with the diagnostics that are not reported.
    baseline: Option<Baseline>,
    /// Diagnostics of all inputs. They are collected only for SARIF output, because a SARIF log is a single document.
    kept: Vec<Diagnostic>,
    sources: Vec<Source>,
}

impl Reporter {
    pub(in super::super) fn new(inputs: &Inputs, is_result: bool) -> Result<Self, Failure> {
        Reporter::with(&inputs.printing, is_result)
    }

    pub(in super::super) fn with(printing: &Printing, is_result: bool) -> Result<Self, Failure> {
        let format = printing.message_format;
        if printing.statistics && !matches!(format, MessageFormat::Text | MessageFormat::Json) {
            return Err(Failure::Usage("--statistics requires --message-format text or json".into()));
        }
        let to_terminal = if is_result && format != MessageFormat::Text {
            std::io::stdout().is_terminal()
        } else {
            std::io::stderr().is_terminal()
        };
        let color = match printing.color {
            ColorChoice::Auto => to_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
            ColorChoice::Always => true,
            ColorChoice::Never => false,
        };
        Ok(Reporter {
            format,
            color,
            is_result,
            errors: 0,
            warnings: 0,
            files: 0,
            all: printing.all,
            statistics: printing.statistics.then(Statistics::default),
            baseline: None,
            kept: Vec::new(),
            sources: Vec::new(),
        })
    }

    /// Leaves out the diagnostics of a baseline.
    pub(in super::super) fn leave_out(&mut self, baseline: Baseline) {
        self.baseline = Some(baseline);
    }

    /// Reports the diagnostics of one input.
    pub(in super::super) fn report(&mut self, compilation: &Compilation) -> Result<(), Failure> {
        self.files += 1;
        let diagnostics: Vec<Cow<Diagnostic>> = match &mut self.baseline {
            Some(baseline) => baseline.without_known(compilation),
            None => compilation.diagnostics.list().iter().map(Cow::Borrowed).collect(),
        };
        for diagnostic in &diagnostics {
            match diagnostic.severity {
                Severity::Error => self.errors += diagnostic.occurrences(),
                Severity::Warning => self.warnings += diagnostic.occurrences(),
            }
        }
        if let Some(statistics) = &mut self.statistics {
            statistics.add(&diagnostics, &compilation.sources);
            return Ok(());
        }
        match self.format {
            MessageFormat::Text => self.print_text(&diagnostics, &compilation.sources),
            MessageFormat::Json => {
                let lines = diagnostics.iter().map(|diagnostic| json::line(diagnostic, &compilation.sources));
                self.print(&lines.fold(String::new(), |text, line| text + &line + "\n"))
            }
            MessageFormat::Github => {
                let line = |shown| match shown {
                    Shown::Full(diagnostic) | Shown::Brief(diagnostic) => {
                        github::line(diagnostic, &compilation.sources) + "\n"
                    }
                    Shown::More(more) => more + "\n",
                };
                self.print(&limited(&diagnostics, self.all).map(line).collect::<String>())
            }
            MessageFormat::Sarif => {
                self.keep(&diagnostics, &compilation.sources);
                Ok(())
            }
        }
    }

    fn print_text(&self, diagnostics: &[Cow<Diagnostic>], sources: &[Source]) -> Result<(), Failure> {
        let mut out = std::io::stderr().lock();
        for shown in limited(diagnostics, self.all) {
            let text = match shown {
                Shown::Full(diagnostic) => render::terminal::render(diagnostic, sources, self.color),
                Shown::Brief(diagnostic) => render::terminal::brief(diagnostic, sources, self.color),
                Shown::More(more) => more,
            };
            writeln!(out, "{text}\n")?;
        }
        Ok(())
    }

    /// Prints the notes of an export with one note per line.
    pub(in super::super) fn export_notes(&mut self, source: &str, device: &str, notes: &[Note]) -> Result<(), Failure> {
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
                    self.print(&json_line(&line)?)?;
                }
                _ => {
                    let whose = if device.is_empty() { String::new() } else { format!("{}: ", printable(device)) };
                    super::super::say(&format!("note: {}: {whose}{note}", printable(source)));
                }
            }
        }
        Ok(())
    }

    /// Reports an error that has no position in a file.
    pub(in super::super) fn error(&mut self, message: &str) {
        self.errors += 1;
        super::super::say(&format!("error: {message}"));
    }

    /// Prints a progress message if the output format of diagnostics is text.
    pub(in super::super) fn progress(&self, line: &str) {
        if self.format == MessageFormat::Text {
            super::super::say(line);
        }
    }

    /// Returns whether errors occurred.
    pub(in super::super) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Prints the statistics or the SARIF document if the user selected them. In the formats `text` and `github`, also
    /// prints a summary if diagnostics are the main output of the command or if there are diagnostics. A note after the
    /// summary states how many diagnostics of the baseline no longer occur, if any. Returns whether no errors occurred.
    pub(in super::super) fn finish(self) -> Result<bool, Failure> {
        match (&self.statistics, self.format) {
            (Some(statistics), MessageFormat::Json) => self.print(&statistics.json()?)?,
            (Some(statistics), _) => std::io::stderr().lock().write_all(statistics.text().as_bytes())?,
            (None, MessageFormat::Sarif) => {
                let text = sarif::document(&self.kept, &self.sources, env!("CARGO_PKG_VERSION"));
                self.print(&(text + "\n"))?;
            }
            _ => {}
        }
        let is_for_people = matches!(self.format, MessageFormat::Text | MessageFormat::Github);
        if is_for_people && (self.is_result || self.errors + self.warnings > 0) {
            let files = count_of(self.files, "file");
            let known = self.baseline.as_ref().map_or(String::new(), Baseline::summary);
            super::super::say(&format!("{files}: {}{known}", render::summary(self.errors, self.warnings)));
            self.baseline.as_ref().and_then(Baseline::obsolete).iter().for_each(|note| super::super::say(note));
        }
        Ok(self.errors == 0)
    }

    /// Prints machine-readable diagnostics. The destination is standard output if diagnostics are the main output of
    /// the command, and standard error otherwise.
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
    fn keep(&mut self, diagnostics: &[Cow<Diagnostic>], sources: &[Source]) {
        let shift = self.sources.len() as u32;
        let moved = |span: Span| Span::new(FileId(span.file.0 + shift), span.start, span.end);
        for source in sources {
            self.sources.push(Source::new(source.name(), source.bytes().into_owned()));
        }
        for diagnostic in diagnostics {
            let mut diagnostic = Diagnostic::clone(diagnostic);
            diagnostic.span = moved(diagnostic.span);
            for note in &mut diagnostic.notes {
                note.span = note.span.map(moved);
            }
            self.kept.push(diagnostic);
        }
    }
}

/// Returns a value as one line of JSON that ends with a line feed.
pub(crate) fn json_line(value: &impl serde::Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string(value).map_err(std::io::Error::other)? + "\n")
}
