//! The `lexibus` command: `lexibus generate`, `export`, `docs`, `diff`, `check`, `fix`, `info`, `dump`, `new`, `import`,
//! `schema`, `network`, `explain`, `completions`, and with the feature `bus` also `read`, `write`, `verify`, `backup`, `restore`, `compare`,
//! `scan`, `monitor`, `decode`.
//!
//! ```text
//! $ lexibus generate drive.eds --out src/drive.rs
//! $ lexibus check vendor-files/
//! $ lexibus explain EDS020
//! ```
//!
//! Exit codes: 0 on success; 1 for errors in the input, output that cannot be written, stale output, breaking changes,
//! device failures, deviations or differences; 2 for invalid arguments; 130 after Ctrl-C.
//!
//! `args` declares the arguments of all subcommands. Most subcommands have a module with the same name; `device`
//! implements those that access devices, and this file implements the others. `inputs` reads files in parallel,
//! `output` writes or compares files, and `report` prints diagnostics.

#![forbid(unsafe_code)]

mod args;
mod baseline;
mod check;
#[cfg(feature = "bus")]
mod device;
mod diff;
mod docs;
mod docs_networks;
mod explain;
mod export;
mod files;
mod fix;
mod generate;
mod import;
mod inputs;
mod interrupt;
mod network;
mod new;
mod output;
mod report;
mod schema;
mod shell;
mod unified;

use std::io::Write;
use std::process::ExitCode;

use clap::CommandFactory;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::codes;
use lexibus_codegen::output::settled;
use lexibus_codegen::text::printable;
use lexibus_export::json;

use args::{Arguments, Command, ExplainFormat, InfoFormat, Inputs};
use report::Reporter;

/// Exit code for errors in the input, output that cannot be written, stale output, breaking changes, device failures,
/// deviations or differences.
const FAILED: u8 = 1;
/// Exit code for invalid arguments, including names of files that a command cannot use.
const USAGE: u8 = 2;
/// Exit code after Ctrl-C, as in shells: 128 plus the number of the signal. Each output file is then complete or
/// unchanged.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    // Ignore a failure to install the handler. Without the handler, the signal ends the process at once.
    let _ = ctrlc::set_handler(|| {
        if interrupt::is_deferred() {
            return;
        }
        let _settled = settled();
        std::process::exit(INTERRUPTED)
    });
    match run(Arguments::parse_in_order()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(FAILED),
        Err(Failure::Output(error)) => {
            // Print no message about a closed pipe, because programs such as `head` close it on purpose. The exit code
            // still reports the failure.
            if error.kind() != std::io::ErrorKind::BrokenPipe {
                say(&format!("error: cannot write the output: {error}"));
            }
            ExitCode::from(FAILED)
        }
        Err(Failure::Failed(message)) => {
            say(&format!("error: {message}"));
            ExitCode::from(FAILED)
        }
        Err(Failure::Usage(message)) => {
            say(&format!("error: {message}"));
            say("");
            say("For more information, try '--help'.");
            ExitCode::from(USAGE)
        }
    }
}

/// Prints a line to standard error. Replaces control characters with spaces. Ignores errors because they cannot be
/// reported.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{}", printable(line));
}

/// The reason why a command ended early.
enum Failure {
    /// The arguments are invalid, or a file that they name cannot be used.
    Usage(String),
    /// The output cannot be written.
    Output(std::io::Error),
    /// The command failed for another reason, such as a file that cannot be read or written, or an error of a device or
    /// bus.
    Failed(String),
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Failure::Output(error)
    }
}

/// Runs a command. Returns whether it succeeded.
fn run(arguments: Arguments) -> Result<bool, Failure> {
    match arguments.command {
        Command::Generate(generate) => generate::run(&generate),
        Command::Export(export) => export::run(&export),
        Command::Docs(docs) => docs::run(&docs),
        Command::Diff(diff) => diff::run(&diff),
        Command::Check(check) => check::run(&check),
        Command::Fix(fix) => fix::run(&fix),
        Command::Info(info) => info_files(&info.inputs, info.format),
        Command::Dump(dump) => dump_files(&dump.inputs),
        Command::New(new) => new::run(&new),
        Command::Import(import) => import::run(&import),
        Command::Schema(schema) => schema::run(&schema),
        Command::Network(arguments) => network::run(&arguments),
        Command::Explain { code, format } => explain(code.as_deref(), format),
        #[cfg(feature = "bus")]
        Command::Device(command) => device::run(&command),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "lexibus", &mut script);
            std::io::stdout().lock().write_all(&script)?;
            Ok(true)
        }
    }
}

fn info_files(inputs: &Inputs, format: InfoFormat) -> Result<bool, Failure> {
    let options = inputs.options()?;
    let mut ok = true;
    let mut out = std::io::stdout().lock();
    inputs::each(inputs, &options, |_, compilation| {
        let info = json::info(&compilation);
        ok &= info.errors.is_empty();
        match format {
            InfoFormat::Json => writeln!(out, "{}", serde_json::to_string(&info).map_err(std::io::Error::other)?)?,
            InfoFormat::Text => write!(out, "{}", report::info_text(&info))?,
        }
        Ok(())
    })?;
    out.flush()?;
    Ok(ok)
}

fn dump_files(inputs: &Inputs) -> Result<bool, Failure> {
    let options: Options = inputs.options()?;
    let mut reporter = Reporter::new(inputs, false)?;
    let mut out = std::io::stdout().lock();
    inputs::each(inputs, &options, |_, compilation: compile::Compilation| {
        reporter.report(&compilation)?;
        if let Some(catalog) = &compilation.catalog {
            writeln!(out, "{}", json::dump(catalog))?;
        }
        Ok(())
    })?;
    out.flush()?;
    reporter.finish()
}

fn explain(code: Option<&str>, format: ExplainFormat) -> Result<bool, Failure> {
    let text = match code {
        None if format == ExplainFormat::Markdown => explain::markdown::catalog(),
        None => explain::catalog(),
        Some(name) => match codes::find(name) {
            Some(code) if format == ExplainFormat::Markdown => explain::markdown::explain(code),
            Some(code) => explain::explain(code),
            None => {
                let hint = codes::similar(name).map_or(String::new(), |similar| format!("; did you mean `{similar}`?"));
                return Err(Failure::Usage(format!("there is no diagnostic code `{name}`{hint}")));
            }
        },
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(true)
}
