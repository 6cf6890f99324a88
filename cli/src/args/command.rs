//! The subcommands and their arguments.

use std::path::PathBuf;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use lexibus_codegen::selection::DeviceFilter;
use lexibus_import::Field;

use super::inputs::{choice, DIAGNOSTICS};
use super::{Export, Generate, Inputs, Network, NetworkCommand, Printing};

/// The object-dictionary compiler: generates typed Rust from device descriptions.
#[derive(Debug, Parser)]
#[command(name = "lexibus", version, arg_required_else_help = true)]
pub(in super::super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub(in super::super) enum Command {
    /// Generate Rust bindings.
    #[command(after_help = "Example:\n  lexibus generate drive.eds --out src/drive.rs")]
    Generate(Generate),
    /// Convert device descriptions to another format.
    #[command(after_help = "Example:\n  lexibus export vendor.xml --format eds --out drive.eds")]
    Export(Export),
    /// Write a documentation site with a search. The pages can be opened from disk.
    #[command(after_help = "Example:\n  lexibus docs vendor-files/ --out site/")]
    Docs(Docs),
    /// Compare two versions of a description. The exit code is 1 if a change breaks Rust code or the communication, or
    /// if a description has errors.
    #[command(after_help = "Example:\n  lexibus diff old.eds new.eds --show breaking")]
    Diff(Diff),
    /// Read and check device descriptions.
    #[command(after_help = "Example:\n  lexibus check vendor-files/ --strict --baseline known.jsonl")]
    Check(Check),
    /// Apply the fixes that diagnostics suggest.
    #[command(after_help = "Example:\n  lexibus fix drive.eds --dry-run")]
    Fix(Fix),
    /// Summarize device descriptions.
    #[command(after_help = "Example:\n  lexibus info coupler.esi.xml --format json")]
    Info(Info),
    /// Print the intermediate representation as JSON.
    #[command(after_help = "Example:\n  lexibus dump drive.eds")]
    Dump(Dump),
    /// Create a drive crate, or a register table with example rows.
    #[command(after_help = "Example:\n  lexibus new --crate my-drive --from drive.eds")]
    New(New),
    /// Convert a list of registers (CSV) to a register table.
    #[command(after_help = "Example:\n  lexibus import registers.csv --out pump.toml")]
    Import(Import),
    /// Print the JSON Schema of register tables.
    #[command(after_help = "Example:\n  lexibus schema --out lexibus.schema.json")]
    Schema(Schema),
    /// Check and build the configuration of a CANopen network or an EtherCAT segment.
    #[command(after_help = "Example:\n  lexibus network build network.toml --out network/")]
    Network(Network),
    /// Explain a diagnostic code. Without a code, list all codes.
    #[command(after_help = "Example:\n  lexibus explain EDS020")]
    Explain {
        /// Identifier or name of a diagnostic code, such as EDS020 or octal-number.
        code: Option<String>,
        /// Output format of the explanation.
        #[arg(long, value_enum, value_name = "FORMAT", default_value_t = ExplainFormat::Text)]
        format: ExplainFormat,
    },
    #[cfg(feature = "bus")]
    #[command(flatten)]
    Device(super::device::DeviceCommand),
    /// Print a completion script for a shell.
    #[command(after_help = "Example:\n  lexibus completions bash")]
    Completions {
        /// Shell that runs the completion script.
        shell: Shell,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum ExplainFormat {
    /// Human-readable text. The list of codes has one line per code.
    Text,
    /// Markdown. The list of codes includes their explanations.
    Markdown,
}

#[derive(Debug, Args)]
pub(in super::super) struct Diff {
    /// Old version of the description.
    pub old: PathBuf,
    /// New version of the description.
    pub new: PathBuf,
    /// Output format of the report.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = DiffFormat::Text)]
    pub format: DiffFormat,
    /// Changes to show. The summary and the exit code do not depend on this option.
    #[arg(long, value_enum, value_name = "CHANGES", default_value_t = Shown::All)]
    pub show: Shown,
    /// File to write; by default, standard output.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Set an option that the register table defines; can be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice)]
    pub option: Vec<(String, String)>,
    /// Do not add facts from profiles (CiA 301, CiA 402, CoE, PROFIdrive) to devices.
    #[arg(long)]
    pub no_profiles: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum DiffFormat {
    /// One line per change, followed by a summary.
    Text,
    /// One JSON object per line, one for each change.
    Json,
    /// HTML page.
    Html,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum Shown {
    /// All changes.
    All,
    /// All changes except those without an effect, such as changed texts.
    Compatible,
    /// Changes that break Rust code, the communication or the behavior.
    Behavior,
    /// Changes that break Rust code or the communication.
    Breaking,
}

#[derive(Debug, Args)]
pub(in super::super) struct Docs {
    /// Folder to write to.
    #[arg(short, long, value_name = "FOLDER")]
    pub out: PathBuf,
    /// Format of the pages.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = DocsFormat::Html)]
    pub format: DocsFormat,
    /// Add a page with the changes between two descriptions. Can be given up to 20 times.
    #[arg(long, num_args = 2, value_names = ["OLD", "NEW"])]
    pub compare: Vec<PathBuf>,
    /// Write nothing, and fail if a page is missing or out of date.
    #[arg(long)]
    pub check: bool,
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum DocsFormat {
    /// HTML site with drawings and a search. The pages can be opened from disk.
    Html,
    /// Markdown pages for repositories and for mdBook.
    Markdown,
}

#[derive(Debug, Args)]
pub(in super::super) struct Check {
    /// Report only the diagnostics that this file does not list.
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Write all diagnostics to the baseline instead of reporting them.
    #[arg(long, requires = "baseline", conflicts_with = "statistics")]
    pub write_baseline: bool,
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(in super::super) struct Fix {
    /// Write nothing, and print the changes as a unified diff.
    #[arg(long)]
    pub dry_run: bool,
    /// Do not keep the old content of a changed file in FILE.bak.
    #[arg(long, conflicts_with = "dry_run")]
    pub no_backup: bool,
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(in super::super) struct Info {
    /// Output format of the summary.
    #[arg(long, value_enum, default_value_t = InfoFormat::Text)]
    pub format: InfoFormat,
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum InfoFormat {
    /// Human-readable text.
    Text,
    /// One JSON object per line.
    Json,
}

#[derive(Debug, Args)]
pub(in super::super) struct Dump {
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(in super::super) struct New {
    /// Name of the device, for a register table.
    #[arg(required_unless_present = "crate_name")]
    pub name: Option<String>,
    /// Create a drive crate with this name instead of a register table.
    #[arg(long = "crate", value_name = "NAME", requires = "from", conflicts_with = "name")]
    pub crate_name: Option<String>,
    /// Device description of the crate. The file is copied into the crate.
    #[arg(long, value_name = "FILE", requires = "crate_name", conflicts_with = "name")]
    pub from: Option<PathBuf>,
    /// Device of the crate, if the file describes several (a name, order code or product code, optionally with @REVISION or
    /// @latest).
    #[arg(long, value_name = "DEVICE", requires = "crate_name", conflicts_with = "name")]
    pub device: Option<DeviceFilter>,
    /// File or folder to create, which must not exist; by default, the name of the device with the extension .toml, or the
    /// name of the crate.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Bus of the example rows (by default, modbus), or of the crate's driver (by default, the first bus of the device).
    #[arg(long, value_enum, value_name = "BUS")]
    pub bus: Option<Bus>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in super::super) enum Bus {
    /// Modbus registers and coils.
    Modbus,
    /// CANopen object dictionary.
    Canopen,
    /// Object dictionary on EtherCAT (CoE).
    Ethercat,
}

#[derive(Debug, Args)]
pub(in super::super) struct Import {
    /// List of registers with a row of column titles. Commas, semicolons or tabs separate the cells.
    #[arg(value_name = "TABLE.csv")]
    pub path: PathBuf,
    /// File to create, which must not exist; by default, standard output.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Column to read for a field: FIELD=TITLE or FIELD=#NUMBER, such as reg="Start address"; can be repeated.
    #[arg(long, value_name = "FIELD=COLUMN", value_parser = lexibus_import::mapping)]
    pub map: Vec<(Field, String)>,
    /// Cell delimiter: a character, `tab`, `comma` or `semicolon`; by default, it is detected.
    #[arg(long, value_name = "CHARACTER", value_parser = lexibus_import::delimiter)]
    pub delimiter: Option<u8>,
    /// Name of the device; by default, the name of the file.
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Report unreadable cells as errors.
    #[arg(long, help_heading = DIAGNOSTICS)]
    pub strict: bool,
    /// Do not report this diagnostic code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE", help_heading = DIAGNOSTICS)]
    pub allow: Vec<String>,
    #[command(flatten)]
    pub printing: Printing,
}

#[derive(Debug, Args)]
pub(in super::super) struct Schema {
    /// File to write; by default, standard output.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write nothing, and fail if the file is missing or out of date.
    #[arg(long, requires = "out")]
    pub check: bool,
}

impl Arguments {
    /// Parses the arguments of this process. Records the order in which the user wrote the options `--allow`, `--warn` and
    /// `--deny`.
    pub(in super::super) fn parse_in_order() -> Self {
        let matches = Arguments::command().get_matches();
        let mut arguments = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
        let mut matches = matches.subcommand();
        let levels = match &mut arguments.command {
            Command::Generate(generate) => &mut generate.inputs.levels,
            Command::Export(export) => &mut export.inputs.levels,
            Command::Docs(docs) => &mut docs.inputs.levels,
            Command::Check(check) => &mut check.inputs.levels,
            Command::Fix(fix) => &mut fix.inputs.levels,
            Command::Info(info) => &mut info.inputs.levels,
            Command::Dump(dump) => &mut dump.inputs.levels,
            Command::Network(network) => {
                matches = matches.and_then(|(_, matches)| matches.subcommand());
                match &mut network.command {
                    NetworkCommand::Check(check) => &mut check.input.levels,
                    NetworkCommand::Build(build) => &mut build.input.levels,
                    NetworkCommand::Schema(_) => return arguments,
                }
            }
            Command::New(_) | Command::Import(_) | Command::Schema(_) | Command::Diff(_) => return arguments,
            Command::Explain { .. } | Command::Completions { .. } => return arguments,
            #[cfg(feature = "bus")]
            Command::Device(_) => return arguments,
        };
        if let Some((_, matches)) = matches {
            levels.order(matches);
        }
        arguments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_help_of_each_subcommand_ends_with_valid_examples() {
        for command in Arguments::command().get_subcommands_mut() {
            let name = command.get_name().to_owned();
            let help = command.render_long_help().to_string();
            let (_, examples) = help
                .trim_end()
                .rsplit_once("\nExample:\n")
                .or_else(|| help.trim_end().rsplit_once("\nExamples:\n"))
                .unwrap_or_else(|| panic!("{name}: {help}"));
            for example in examples.lines().map(str::trim) {
                assert!(example.starts_with(&format!("lexibus {name} ")), "{example}");
                Arguments::try_parse_from(example.split_whitespace())
                    .unwrap_or_else(|error| panic!("{example}: {error}"));
            }
        }
    }
}
