//! Arguments of the subcommands that write another form of a description: `generate` and `export`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lexibus_codegen::backend::rust::{Presence, RustOptions};

use super::Inputs;

/// Heading, in the help text, of the options about the generated code.
const RUST: &str = "Rust";

#[derive(Debug, Args)]
pub(crate) struct Generate {
    /// File (for one input) or folder to write to; by default, standard output.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write nothing, and fail if an output file is missing or out of date.
    #[arg(long, requires = "out")]
    pub check: bool,
    /// Name of the generated device type.
    #[arg(long, value_name = "NAME", help_heading = RUST)]
    pub device_name: Option<String>,
    /// Rust path of the runtime crate in the generated code.
    #[arg(long, value_name = "PATH", default_value = "::lexibus", value_parser = rust_path, help_heading = RUST)]
    pub runtime: String,
    /// Generate only handles, and no device type with accessor methods.
    #[arg(long, help_heading = RUST)]
    pub no_accessors: bool,
    /// Do not generate PDO structs.
    #[arg(long, help_heading = RUST)]
    pub no_pdos: bool,
    /// When to generate the static table of all entries: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence, help_heading = RUST)]
    pub table: Presence,
    /// When generated types implement Debug: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence, help_heading = RUST)]
    pub debug: Presence,
    /// When generated types implement PartialEq: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "always", value_parser = presence, help_heading = RUST)]
    pub partial_eq: Presence,
    /// When generated types implement defmt::Format: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence, help_heading = RUST)]
    pub defmt: Presence,
    /// When generated types implement the traits of serde: always, never, or feature=NAME.
    #[arg(long, value_name = "WHEN", default_value = "never", value_parser = presence, help_heading = RUST)]
    pub serde: Presence,
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Debug, Args)]
pub(crate) struct Export {
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
    #[command(flatten)]
    pub inputs: Inputs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RealForm {
    /// Decimal numbers, which Python's `canopen` library can read.
    Decimal,
    /// IEEE 754 bit patterns in hexadecimal, which the Lely CANopen tools can read.
    Hex,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExportFormat {
    /// CANopen electronic data sheet (CiA 306), which describes all devices of a type.
    Eds,
    /// CANopen device configuration file (CiA 306), which also contains the node-ID and configured values of one device.
    Dcf,
    /// EtherCAT slave information (ETG.2000). One file describes all devices of an input.
    Esi,
    /// Content of the EEPROM of an EtherCAT slave (SII, ETG.2010): a binary file for each device.
    Sii,
    /// PROFINET device description (GSDML). One file describes all devices of an input.
    Gsdml,
}

/// Parses an argument of the form `KEY=VALUE`.
fn fact(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected KEY=VALUE")?;
    Ok((key.trim().to_owned(), value.to_owned()))
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

impl Generate {
    pub(crate) fn rust_options(&self) -> RustOptions {
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
    fn presence_is_parsed() {
        assert_eq!(presence("feature=table"), Ok(Presence::Feature("table".into())));
        assert!(presence("feature=").is_err() && presence("maybe").is_err());
    }
}
