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

/// The object-dictionary compiler: device descriptions in, typed Rust out.
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
    /// Write device descriptions in another format.
    Export(Export),
    /// Write a site of documentation: pages that open from disk, with a search.
    Docs(Docs),
    /// Compare two versions of a description. The exit code is 1 if a change breaks Rust code or the communication.
    Diff(Diff),
    /// Read and check device descriptions.
    Check(Check),
    /// Sum up device descriptions.
    Info(Info),
    /// Print the intermediate representation as JSON.
    Dump(Dump),
    /// Start a register table.
    New(New),
    /// Turn a list of registers (CSV) into a register table.
    Import(Import),
    /// Print the JSON Schema of register tables.
    Schema(Schema),
    /// Explain a diagnostic code; without one, list all of them.
    Explain {
        /// Identifier or name of the code, such as EDS020 or octal-number.
        code: Option<String>,
        /// How it is printed.
        #[arg(long, value_enum, value_name = "FORMAT", default_value_t = ExplainFormat::Text)]
        format: ExplainFormat,
    },
    /// Print a completion script for a shell.
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// Files to read, and how.
#[derive(Debug, Args)]
pub(super) struct Inputs {
    /// Device descriptions, and folders of them (searched for .eds, .dcf, .xdd, .xdc, .xpd, .xml and .toml).
    #[arg(required = true, value_name = "FILE")]
    pub paths: Vec<PathBuf>,
    /// Turn every repair of the input into an error.
    #[arg(long)]
    pub strict: bool,
    /// Don't report this code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE")]
    pub allow: Vec<String>,
    /// Report this code as a warning.
    #[arg(short = 'W', long = "warn", value_name = "CODE")]
    pub warn: Vec<String>,
    /// Report this code as an error.
    #[arg(short = 'D', long = "deny", value_name = "CODE")]
    pub deny: Vec<String>,
    /// The three lists above in the order of the command line: the last setting of a code counts.
    #[arg(skip)]
    pub levels: Vec<(String, Level)>,
    /// Another name that formulas use for $NODEID.
    #[arg(long, value_name = "NAME")]
    pub node_id_alias: Vec<String>,
    /// Choose what the manual of a register table leaves open; may be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice)]
    pub option: Vec<(String, String)>,
    /// Take this device only (a name, order code or product code, with @REVISION or @latest); may be repeated.
    #[arg(long, value_name = "DEVICE")]
    pub device: Vec<DeviceFilter>,
    /// Take this module only (a name, identifier or ident number); may be repeated.
    #[arg(long, value_name = "MODULE", value_parser = module_filter)]
    pub module: Vec<Filter>,
    /// Take these objects only (an index or a range, such as 0x6000..0x67FF); may be repeated.
    #[arg(long, value_name = "OBJECTS")]
    pub objects: Vec<ObjectFilter>,
    /// Apply this overlay, a table that corrects descriptions and adds to them; may be repeated.
    #[arg(long, value_name = "FILE")]
    pub overlay: Vec<PathBuf>,
    /// Profiles (CiA 301, CiA 402, CoE, PROFIdrive) add nothing to the objects of devices that follow them.
    #[arg(long)]
    pub no_profiles: bool,
    /// How findings are printed.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Text)]
    pub message_format: MessageFormat,
    /// When to use colours.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
    /// Number of files to read at once; by default, one a processor.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MessageFormat {
    /// For people: the place, the line, a label.
    Text,
    /// One JSON object a line.
    Json,
    /// One SARIF 2.1.0 document.
    Sarif,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorChoice {
    /// On a terminal.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExplainFormat {
    /// For people; without a code, a line a code.
    Text,
    /// Markdown, each code with its explanation.
    Markdown,
}

#[derive(Debug, Args)]
pub(super) struct Diff {
    /// The old description.
    pub old: PathBuf,
    /// The new one.
    pub new: PathBuf,
    /// The format of the report.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = DiffFormat::Text)]
    pub format: DiffFormat,
    /// The changes to show. The summary and the exit code count all of them.
    #[arg(long, value_enum, value_name = "CHANGES", default_value_t = Shown::All)]
    pub show: Shown,
    /// The file to write; standard output where it isn't given.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Choose what the manual of a register table leaves open; may be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice)]
    pub option: Vec<(String, String)>,
    /// Profiles (CiA 301, CiA 402, CoE, PROFIdrive) add nothing to the objects of devices that follow them.
    #[arg(long)]
    pub no_profiles: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DiffFormat {
    /// One line per change, and a summary.
    Text,
    /// One JSON object per change, each on a line.
    Json,
    /// A page.
    Html,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Shown {
    /// All changes.
    All,
    /// Changes that break something, and compatible ones: all except those of texts.
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
    /// The folder to write to.
    #[arg(short, long, value_name = "FOLDER")]
    pub out: PathBuf,
    /// What the pages are written in.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = DocsFormat::Html)]
    pub format: DocsFormat,
    /// Write nothing; fail where a page isn't what would be written.
    #[arg(long)]
    pub check: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DocsFormat {
    /// A site that opens from disk, with drawings and a search.
    Html,
    /// Pages for repositories and for mdBook.
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
    /// How the summary is printed.
    #[arg(long, value_enum, default_value_t = InfoFormat::Text)]
    pub format: InfoFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum InfoFormat {
    /// For people.
    Text,
    /// One JSON object a line.
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
    /// The file to write (for one input), or the folder to write to; standard output where neither is given.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write nothing; fail where the output is missing or isn't what would be written.
    #[arg(long, requires = "out")]
    pub check: bool,
    /// Name of the device's type.
    #[arg(long, value_name = "NAME")]
    pub device_name: Option<String>,
    /// Path of the runtime crate.
    #[arg(long, value_name = "PATH", default_value = "::lexibus", value_parser = rust_path)]
    pub runtime: String,
    /// Handles only: no device type with accessor methods.
    #[arg(long)]
    pub no_accessors: bool,
    /// No PDO structs.
    #[arg(long)]
    pub no_pdos: bool,
    /// The static table of all entries: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub table: Presence,
    /// Debug on generated types: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence)]
    pub debug: Presence,
    /// PartialEq on generated types: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence)]
    pub partial_eq: Presence,
    /// defmt::Format on generated types: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub defmt: Presence,
    /// serde's traits on generated types: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence)]
    pub serde: Presence,
}

#[derive(Debug, Args)]
pub(super) struct Export {
    #[command(flatten)]
    pub inputs: Inputs,
    /// What to write.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: ExportFormat,
    /// A fact that the format wants and the source doesn't say, such as physics=YY; counts before what the source says, and may
    /// be repeated. Which ones there are is told where one is missing, or unknown.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = fact)]
    pub facts: Vec<(String, String)>,
    /// The form of REAL32 and REAL64 values in an EDS or DCF [default: decimal]
    #[arg(long, value_enum, value_name = "FORM")]
    pub real: Option<RealForm>,
    /// The file to write (for one device), or the folder to write to; standard output where neither is given.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write nothing; fail where the output is missing or isn't what would be written.
    #[arg(long, requires = "out")]
    pub check: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum RealForm {
    /// Decimal numbers, which Python's `canopen` reads.
    Decimal,
    /// The bits of IEEE 754 in hexadecimal, which the tools of lely read.
    Hex,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExportFormat {
    /// CANopen electronic data sheet (CiA 306): what all devices of the type have in common.
    Eds,
    /// CANopen device configuration file (CiA 306): also the node-ID and the values of one device.
    Dcf,
    /// EtherCAT slave information (ETG.2000), of all devices of an input in one file.
    Esi,
    /// PROFINET device description (GSDML), of all devices of an input in one file.
    Gsdml,
}

/// Parses `KEY=VALUE`.
fn fact(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected KEY=VALUE")?;
    Ok((key.trim().to_owned(), value.to_owned()))
}

#[derive(Debug, Args)]
pub(super) struct New {
    /// Name of the device.
    pub name: String,
    /// The file to write, which must not exist; by default, the name with the ending .toml.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The bus that the rows of the table are for.
    #[arg(long, value_enum, value_name = "BUS", default_value_t = Bus::Modbus)]
    pub bus: Bus,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Bus {
    /// Registers and coils.
    Modbus,
    /// An object dictionary on CAN.
    Canopen,
    /// An object dictionary on EtherCAT.
    Ethercat,
}

#[derive(Debug, Args)]
pub(super) struct Import {
    /// A list of registers with a line of column titles: comma, semicolon or tab between cells.
    #[arg(value_name = "TABLE.csv")]
    pub path: PathBuf,
    /// The file to write, which must not exist; standard output where it isn't given.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Which column is what: FIELD=TITLE or FIELD=#NUMBER, such as reg="Start address"; may be repeated.
    #[arg(long, value_name = "FIELD=COLUMN", value_parser = lexibus_import::mapping)]
    pub map: Vec<(Field, String)>,
    /// What stands between cells: a character, `tab`, `comma` or `semicolon`; by default, what fits.
    #[arg(long, value_name = "CHARACTER", value_parser = lexibus_import::delimiter)]
    pub delimiter: Option<u8>,
    /// Name of the device; by default, that of the file.
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Turn every cell that can't be read into an error.
    #[arg(long)]
    pub strict: bool,
    /// Don't report this code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE")]
    pub allow: Vec<String>,
    /// How findings are printed.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Text)]
    pub message_format: MessageFormat,
    /// When to use colours.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
}

#[derive(Debug, Args)]
pub(super) struct Schema {
    /// The file to write; standard output where it isn't given.
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write nothing; fail where the file is missing or isn't what would be written.
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
    /// Parses the arguments of this process. Levels keep the order of the command line.
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
    /// Stores the levels in the order of the command line.
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
