//! Arguments of the command line.

use std::path::PathBuf;

use clap::{ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use lexibus_codegen::backend::rust::{Presence, RustOptions};
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_codegen::selection::{DeviceFilter, Filter, ObjectFilter, Selection};
use lexibus_codegen::source::Source;
use lexibus_import::Field;

use super::Failure;

/// The object-dictionary compiler: generates typed Rust from device descriptions.
#[derive(Debug, Parser)]
#[command(name = "lexibus", version, arg_required_else_help = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Generate Rust bindings.
    Generate(Generate),
    /// Convert device descriptions to another format.
    Export(Export),
    /// Write a documentation site with a search. The pages can be opened from disk.
    Docs(Docs),
    /// Compare two versions of a description. The exit code is 1 if a change breaks Rust code or the communication.
    Diff(Diff),
    /// Read and check device descriptions.
    Check(Check),
    /// Summarize device descriptions.
    Info(Info),
    /// Print the intermediate representation as JSON.
    Dump(Dump),
    /// Create a register table with example rows.
    New(New),
    /// Convert a list of registers (CSV) to a register table.
    Import(Import),
    /// Print the JSON Schema of register tables.
    Schema(Schema),
    /// Explain a diagnostic code. Without a code, list all codes.
    Explain {
        /// Identifier or name of a diagnostic code, such as EDS020 or octal-number.
        code: Option<String>,
        /// Output format of the explanation.
        #[arg(long, value_enum, value_name = "FORMAT", default_value_t = ExplainFormat::Text)]
        format: ExplainFormat,
    },
    /// Print a completion script for a shell.
    Completions {
        /// Shell that runs the completion script.
        shell: Shell,
    },
}

/// Input files, and options for reading them.
#[derive(Debug, Args)]
pub(super) struct Inputs {
    /// Device descriptions, or folders to search for them (.eds, .dcf, .xdd, .xdc, .xpd, .xml and .toml files).
    #[arg(required = true, value_name = "FILE")]
    pub paths: Vec<PathBuf>,
    /// Report repairs of the input as errors.
    #[arg(long)]
    pub strict: bool,
    /// Do not report this diagnostic code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE")]
    pub allow: Vec<String>,
    /// Report this diagnostic code as a warning.
    #[arg(short = 'W', long = "warn", value_name = "CODE")]
    pub warn: Vec<String>,
    /// Report this diagnostic code as an error.
    #[arg(short = 'D', long = "deny", value_name = "CODE")]
    pub deny: Vec<String>,
    /// The codes in `allow`, `warn` and `deny`, in the order in which the user wrote them. If a code occurs several times, the
    /// last level applies.
    #[arg(skip)]
    pub levels: Vec<(String, Level)>,
    /// Name that formulas may use for the node-ID instead of $NODEID.
    #[arg(long, value_name = "NAME")]
    pub node_id_alias: Vec<String>,
    /// Set an option that the register table defines; can be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice)]
    pub option: Vec<(String, String)>,
    /// Use only this device (a name, order code or product code, optionally with @REVISION or @latest); can be repeated.
    #[arg(long, value_name = "DEVICE")]
    pub device: Vec<DeviceFilter>,
    /// Use only this module (a name, identifier or ident number); can be repeated.
    #[arg(long, value_name = "MODULE", value_parser = module_filter)]
    pub module: Vec<Filter>,
    /// Use only these objects (an index or a range, such as 0x6000..0x67FF); can be repeated.
    #[arg(long, value_name = "OBJECTS")]
    pub objects: Vec<ObjectFilter>,
    /// Apply this overlay, a table that corrects and extends descriptions; can be repeated.
    #[arg(long, value_name = "FILE")]
    pub overlay: Vec<PathBuf>,
    /// Do not add facts from profiles (CiA 301, CiA 402, CoE, PROFIdrive) to devices.
    #[arg(long)]
    pub no_profiles: bool,
    /// Output format of diagnostics.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Text)]
    pub message_format: MessageFormat,
    /// When to print diagnostics in color.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
    /// Number of files to read in parallel; by default, the number of processors.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MessageFormat {
    /// Human-readable text with position, source line and labels.
    Text,
    /// One JSON object per line.
    Json,
    /// One SARIF 2.1.0 document.
    Sarif,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorChoice {
    /// Use colors if the output is a terminal.
    Auto,
    /// Always use colors.
    Always,
    /// Never use colors.
    Never,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExplainFormat {
    /// Human-readable text. The list of codes has one line per code.
    Text,
    /// Markdown. The list of codes includes their explanations.
    Markdown,
}

#[derive(Debug, Args)]
pub(super) struct Diff {
    /// Old version of the description.
    pub old: PathBuf,
    /// New version of the description.
    pub new: PathBuf,
    /// Output format of the report.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = DiffFormat::Text)]
    pub format: DiffFormat,
    /// Changes to show. The summary and the exit code count all changes.
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
pub(super) enum DiffFormat {
    /// One line per change, followed by a summary.
    Text,
    /// One line per change, which contains a JSON object.
    Json,
    /// HTML page.
    Html,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Shown {
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
pub(super) struct Docs {
    #[command(flatten)]
    pub inputs: Inputs,
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
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DocsFormat {
    /// HTML site with drawings and a search. The pages can be opened from disk.
    Html,
    /// Markdown pages for repositories and for mdBook.
    Markdown,
}

#[derive(Debug, Args)]
pub(super) struct Check {
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(super) struct Info {
    #[command(flatten)]
    pub inputs: Inputs,
    /// Output format of the summary.
    #[arg(long, value_enum, default_value_t = InfoFormat::Text)]
    pub format: InfoFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum InfoFormat {
    /// Human-readable text.
    Text,
    /// One JSON object per line.
    Json,
}

#[derive(Debug, Args)]
pub(super) struct Dump {
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(super) struct Generate {
    #[command(flatten)]
    pub inputs: Inputs,
    /// File (for one input) or folder to write to; by default, standard output.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write nothing, and fail if an output file is missing or out of date.
    #[arg(long, requires = "out")]
    pub check: bool,
    /// Name of the generated device type.
    #[arg(long, value_name = "NAME")]
    pub device_name: Option<String>,
    /// Rust path of the runtime crate in the generated code.
    #[arg(long, value_name = "PATH", default_value = "::lexibus", value_parser = rust_path)]
    pub runtime: String,
    /// Generate only handles, and no device type with accessor methods.
    #[arg(long)]
    pub no_accessors: bool,
    /// Do not generate PDO structs.
    #[arg(long)]
    pub no_pdos: bool,
    /// When to generate the static table of all entries: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub table: Presence,
    /// When generated types implement Debug: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence)]
    pub debug: Presence,
    /// When generated types implement PartialEq: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence)]
    pub partial_eq: Presence,
    /// When generated types implement defmt::Format: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub defmt: Presence,
    /// When generated types implement the traits of serde: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub serde: Presence,
}

#[derive(Debug, Args)]
pub(super) struct Export {
    #[command(flatten)]
    pub inputs: Inputs,
    /// Format to write.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: ExportFormat,
    /// Fact that the format requires, such as physics=YY; can be repeated. The fact takes precedence over the input. If a key is
    /// missing or unknown, the error message lists the keys.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = fact)]
    pub facts: Vec<(String, String)>,
    /// Notation of REAL32 and REAL64 values in an EDS or DCF [default: decimal]
    #[arg(long, value_enum, value_name = "FORM")]
    pub real: Option<RealForm>,
    /// File (for one device) or folder to write to; by default, standard output.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write nothing, and fail if an output file is missing or out of date.
    #[arg(long, requires = "out")]
    pub check: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum RealForm {
    /// Decimal numbers, which Python's `canopen` library can read.
    Decimal,
    /// IEEE 754 bit patterns in hexadecimal, which the Lely CANopen tools can read.
    Hex,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExportFormat {
    /// CANopen electronic data sheet (CiA 306), which describes all devices of a type.
    Eds,
    /// CANopen device configuration file (CiA 306), which also contains the node-ID and configured values of one device.
    Dcf,
    /// EtherCAT slave information (ETG.2000). One file describes all devices of an input.
    Esi,
    /// PROFINET device description (GSDML). One file describes all devices of an input.
    Gsdml,
}

/// Parses an argument of the form `KEY=VALUE`.
fn fact(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected KEY=VALUE")?;
    Ok((key.trim().to_owned(), value.to_owned()))
}

#[derive(Debug, Args)]
pub(super) struct New {
    /// Name of the device.
    pub name: String,
    /// File to create, which must not exist; by default, the name of the device with the extension .toml.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Bus of the example rows.
    #[arg(long, value_enum, value_name = "BUS", default_value_t = Bus::Modbus)]
    pub bus: Bus,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Bus {
    /// Modbus registers and coils.
    Modbus,
    /// CANopen object dictionary.
    Canopen,
    /// Object dictionary on EtherCAT (CoE).
    Ethercat,
}

#[derive(Debug, Args)]
pub(super) struct Import {
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
    #[arg(long)]
    pub strict: bool,
    /// Do not report this diagnostic code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE")]
    pub allow: Vec<String>,
    /// Output format of diagnostics.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Text)]
    pub message_format: MessageFormat,
    /// When to print diagnostics in color.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
}

#[derive(Debug, Args)]
pub(super) struct Schema {
    /// File to write; by default, standard output.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write nothing, and fail if the file is missing or out of date.
    #[arg(long, requires = "out")]
    pub check: bool,
}

fn module_filter(text: &str) -> Result<Filter, std::convert::Infallible> {
    Ok(text.into())
}

fn rust_path(text: &str) -> Result<String, String> {
    let is_name = |name: &str| {
        !name.is_empty() && name.chars().all(|letter| letter.is_alphanumeric() || matches!(letter, '_' | '#'))
    };
    match text.strip_prefix("::").unwrap_or(text).split("::").all(is_name) {
        true => Ok(text.to_owned()),
        false => Err("expected a Rust path, such as ::lexibus or crate::rt".to_owned()),
    }
}

fn presence(text: &str) -> Result<Presence, String> {
    match (text, text.strip_prefix("feature=")) {
        ("always", _) => Ok(Presence::Always),
        ("never", _) => Ok(Presence::Never),
        (_, Some(feature)) if !feature.is_empty() => Ok(Presence::Feature(feature.to_owned())),
        _ => Err("expected always, never or feature=NAME".to_owned()),
    }
}

impl Arguments {
    /// Parses the arguments of this process. `levels` contains the options `--allow`, `--warn` and `--deny` in the order in
    /// which the user wrote them.
    pub(super) fn parse_in_order() -> Self {
        let matches = Arguments::command().get_matches();
        let mut arguments = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
        let inputs = match &mut arguments.command {
            Command::Generate(generate) => &mut generate.inputs,
            Command::Export(export) => &mut export.inputs,
            Command::Docs(docs) => &mut docs.inputs,
            Command::Check(check) => &mut check.inputs,
            Command::Info(info) => &mut info.inputs,
            Command::Dump(dump) => &mut dump.inputs,
            Command::New(_) | Command::Import(_) | Command::Schema(_) | Command::Diff(_) => return arguments,
            Command::Explain { .. } | Command::Completions { .. } => return arguments,
        };
        if let Some((_, matches)) = matches.subcommand() {
            inputs.order_levels(matches);
        }
        arguments
    }
}

impl Inputs {
    /// Fills `levels` with the options `--allow`, `--warn` and `--deny` in the order in which the user wrote them.
    fn order_levels(&mut self, matches: &ArgMatches) {
        let settings = [
            ("allow", &self.allow, Level::Allow),
            ("warn", &self.warn, Level::Warn),
            ("deny", &self.deny, Level::Deny),
        ];
        let mut ordered = Vec::new();
        for (name, codes, level) in settings {
            let positions = matches.indices_of(name).into_iter().flatten();
            ordered.extend(positions.zip(codes).map(|(position, code)| (position, code.clone(), level)));
        }
        ordered.sort_by_key(|&(position, ..)| position);
        self.levels = ordered.into_iter().map(|(_, code, level)| (code, level)).collect();
    }

    pub(super) fn options(&self) -> Result<Options, Failure> {
        let mut levels = if self.strict { Levels::strict() } else { Levels::lenient() };
        for (code, level) in &self.levels {
            levels.set(code, *level).map_err(|error| Failure::Usage(error.to_string()))?;
        }
        let overlay = |path: &PathBuf| {
            Source::read(path).map_err(|error| Failure::Usage(format!("cannot read {}: {error}", path.display())))
        };
        let overlays: Result<Vec<Source>, Failure> = self.overlay.iter().map(overlay).collect();
        let select =
            Selection { devices: self.device.clone(), modules: self.module.clone(), objects: self.objects.clone() };
        Ok(Options {
            levels,
            node_id_aliases: self.node_id_alias.clone(),
            choices: self.option.clone(),
            select,
            overlays: overlays?,
            no_profiles: self.no_profiles,
            ..Options::default()
        })
    }
}

fn choice(text: &str) -> Result<(String, String), String> {
    compile::choice(text).ok_or_else(|| "expected NAME=CHOICE".to_owned())
}

impl Generate {
    pub(super) fn rust_options(&self) -> RustOptions {
        RustOptions {
            device_name: self.device_name.clone(),
            runtime: self.runtime.clone(),
            accessors: !self.no_accessors,
            pdos: !self.no_pdos,
            table: self.table.clone(),
            debug: self.debug.clone(),
            partial_eq: self.partial_eq.clone(),
            defmt: self.defmt.clone(),
            serde: self.serde.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
        assert_eq!(presence("feature=table"), Ok(Presence::Feature("table".into())));
        assert!(presence("feature=").is_err() && presence("maybe").is_err());
    }
}
