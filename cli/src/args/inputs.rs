//! Arguments that several subcommands share: input files, options for reading them, and options for reporting
//! diagnostics.

use std::path::PathBuf;

use clap::{ArgMatches, Args, ValueEnum};
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_codegen::selection::{DeviceFilter, Filter, ObjectFilter, Selection};
use lexibus_codegen::source::Source;

use crate::files::read;
use crate::Failure;

/// Heading in the help text for the options that affect how inputs are read.
const INPUT: &str = "Input";
/// Heading in the help text for the options that select the diagnostics to report.
pub(super) const DIAGNOSTICS: &str = "Diagnostics";
/// Heading in the help text for the options that select the format of diagnostics.
const OUTPUT: &str = "Output";

/// Input files, and options for reading them.
#[derive(Debug, Args)]
pub(crate) struct Inputs {
    /// Device descriptions, or folders to search for them (.eds, .dcf, .xdd, .xdc, .xpd, .xml and .toml files).
    #[arg(required = true, value_name = "FILE")]
    pub paths: Vec<PathBuf>,
    /// Name that formulas may use for the node-ID instead of $NODEID.
    #[arg(long, value_name = "NAME", help_heading = INPUT)]
    pub node_id_alias: Vec<String>,
    /// Set an option that the register table defines; can be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice, help_heading = INPUT)]
    pub option: Vec<(String, String)>,
    /// Use only this device (a name, order code or product code, optionally with @REVISION or @latest); can be repeated.
    #[arg(long, value_name = "DEVICE", help_heading = INPUT)]
    pub device: Vec<DeviceFilter>,
    /// Use only this module (a name, identifier or ident number); can be repeated.
    #[arg(long, value_name = "MODULE", help_heading = INPUT)]
    pub module: Vec<Filter>,
    /// Use only these objects (an index or a range, such as 0x6000..0x67FF); can be repeated.
    #[arg(long, value_name = "OBJECTS", help_heading = INPUT)]
    pub objects: Vec<ObjectFilter>,
    /// Apply this overlay, a table that corrects and extends descriptions; can be repeated.
    #[arg(long, value_name = "FILE", help_heading = INPUT)]
    pub overlay: Vec<PathBuf>,
    /// Do not add facts from profiles (CiA 301, CiA 402, CoE, PROFIdrive) to devices.
    #[arg(long, help_heading = INPUT)]
    pub no_profiles: bool,
    /// Number of files to read in parallel; by default, the number of processors.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = INPUT)]
    pub jobs: Option<u16>,
    #[command(flatten)]
    pub levels: LevelArguments,
    #[command(flatten)]
    pub printing: Printing,
}

/// Levels of diagnostics.
#[derive(Debug, Args)]
pub(crate) struct LevelArguments {
    /// Report repairs of the input as errors.
    #[arg(long, help_heading = DIAGNOSTICS)]
    pub strict: bool,
    /// Do not report this diagnostic code (an identifier, a name, or `warnings`).
    #[arg(short = 'A', long = "allow", value_name = "CODE", help_heading = DIAGNOSTICS)]
    pub allow: Vec<String>,
    /// Report this diagnostic code as a warning.
    #[arg(short = 'W', long = "warn", value_name = "CODE", help_heading = DIAGNOSTICS)]
    pub warn: Vec<String>,
    /// Report this diagnostic code as an error.
    #[arg(short = 'D', long = "deny", value_name = "CODE", help_heading = DIAGNOSTICS)]
    pub deny: Vec<String>,
    /// The codes in `allow`, `warn` and `deny`, in the order in which the user wrote them. If a code occurs several times, the
    /// last level applies.
    #[arg(skip)]
    ordered: Vec<(String, Level)>,
}

/// Selection and form of the printed diagnostics.
#[derive(Clone, Debug, Args)]
pub(crate) struct Printing {
    /// Print all diagnostics in full. By default, at most three diagnostics of a code are printed for each file, the second and
    /// third warning without the marked lines, notes and help.
    #[arg(long, help_heading = DIAGNOSTICS)]
    pub all: bool,
    /// Print the number of diagnostics of each code, and the first position, instead of the diagnostics.
    #[arg(long, help_heading = DIAGNOSTICS)]
    pub statistics: bool,
    /// Output format of diagnostics.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Text, help_heading = OUTPUT)]
    pub message_format: MessageFormat,
    /// When to print diagnostics in color.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto, help_heading = OUTPUT)]
    pub color: ColorChoice,
}

impl Printing {
    /// Options that print all diagnostics in full as text.
    pub(crate) const TEXT: Printing =
        Printing { all: true, statistics: false, message_format: MessageFormat::Text, color: ColorChoice::Auto };
    /// Options that print a limited number of diagnostics of each code as text.
    pub(crate) const NEW: Printing = Printing { all: false, ..Printing::TEXT };
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MessageFormat {
    /// Human-readable text with position, source line and labels.
    Text,
    /// One JSON object per line.
    Json,
    /// One SARIF 2.1.0 document.
    Sarif,
    /// Annotations of GitHub Actions, which GitHub shows at the marked lines.
    Github,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorChoice {
    /// Use colors if the output is a terminal.
    Auto,
    /// Always use colors.
    Always,
    /// Never use colors.
    Never,
}

impl LevelArguments {
    /// Fills `ordered` with the options `--allow`, `--warn` and `--deny` in the order in which the user wrote them.
    pub(super) fn order(&mut self, matches: &ArgMatches) {
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
        self.ordered = ordered.into_iter().map(|(_, code, level)| (code, level)).collect();
    }

    /// Returns the levels of all codes, or an error if an option names an unknown code.
    pub(crate) fn levels(&self) -> Result<Levels, Failure> {
        let mut levels = if self.strict { Levels::strict() } else { Levels::lenient() };
        for (code, level) in &self.ordered {
            levels.set(code, *level).map_err(|error| Failure::Usage(error.to_string()))?;
        }
        Ok(levels)
    }
}

impl Inputs {
    pub(crate) fn options(&self) -> Result<Options, Failure> {
        let overlays: Result<Vec<Source>, Failure> = self.overlay.iter().map(|path| read(path)).collect();
        let select = Selection {
            devices: self.device.clone(),
            modules: self.module.clone(),
            objects: self.objects.clone(),
            pdos: false,
        };
        Ok(Options {
            levels: self.levels.levels()?,
            node_id_aliases: self.node_id_alias.clone(),
            choices: self.option.clone(),
            select,
            overlays: overlays?,
            no_profiles: self.no_profiles,
            ..Options::default()
        })
    }
}

pub(super) fn choice(text: &str) -> Result<(String, String), String> {
    compile::choice(text).ok_or_else(|| "expected NAME=CHOICE".to_owned())
}
