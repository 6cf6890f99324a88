//! Arguments of `lexibus network`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{LevelArguments, Printing, Schema};

#[derive(Debug, Args)]
pub(crate) struct Network {
    #[command(subcommand)]
    pub command: NetworkCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum NetworkCommand {
    /// Read and check a network file, and print its bus load or the length of its process data.
    #[command(after_help = "Example:\n  lexibus network check network.toml")]
    Check(NetworkCheck),
    /// Write the DCFs and concise DCFs of the nodes and the master, a DBC, Rust modules, and the data of an EtherCAT segment.
    #[command(after_help = "Example:\n  lexibus network build network.toml --out network/")]
    Build(NetworkBuild),
    /// Print the JSON Schema of network.toml.
    #[command(after_help = "Example:\n  lexibus network schema --out network.schema.json")]
    Schema(Schema),
}

#[derive(Debug, Args)]
pub(crate) struct NetworkCheck {
    #[command(flatten)]
    pub input: NetworkInput,
}

#[derive(Debug, Args)]
pub(crate) struct NetworkBuild {
    /// Folder to write to.
    #[arg(short, long, value_name = "FOLDER")]
    pub out: PathBuf,
    /// Write nothing, and fail if a file is missing or out of date.
    #[arg(long)]
    pub check: bool,
    #[command(flatten)]
    pub input: NetworkInput,
}

/// A network file, and options for reporting its diagnostics.
#[derive(Debug, Args)]
pub(crate) struct NetworkInput {
    /// Network file: network.toml, bus.yml (dcfgen, ros2_canopen) or .cpj (CiA 306-3).
    #[arg(value_name = "FILE")]
    pub path: PathBuf,
    #[command(flatten)]
    pub levels: LevelArguments,
    #[command(flatten)]
    pub printing: Printing,
}
