//! Arguments of the subcommands that access devices.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use lexibus_codegen::selection::DeviceFilter;
use lexibus_device::BusAddress;

use super::inputs::choice;

/// Subcommands that access devices on a bus.
#[derive(Debug, Subcommand)]
pub(crate) enum DeviceCommand {
    /// Read values of a device by name.
    #[command(
        after_help = "Examples:\n  lexibus read --bus can:can0 --node 5 drive.eds \"Profile velocity\"\n  lexibus read axis1 \"Profile velocity\""
    )]
    Read(Read),
    /// Write a value of a device by name. The command checks and shows the value before it writes.
    #[command(
        after_help = "Examples:\n  lexibus write --bus can:can0 --node 5 drive.eds \"Profile velocity\" 15.5 rev/s\n  lexibus write axis1 \"Profile velocity\" 15.5 rev/s"
    )]
    Write(WriteCommand),
    /// Compare a device with its description. Nothing is written. The exit code is 1 if there is a deviation.
    #[command(
        after_help = "Example:\n  lexibus verify --bus can:can0 --node 5 drive.eds --format html --out report.html"
    )]
    Verify(Verify),
    /// Save the parameters of a device to a file.
    #[command(after_help = "Example:\n  lexibus backup --bus can:can0 --node 5 drive.eds --out axis.dcf")]
    Backup(BackupCommand),
    /// Write saved parameters to a device. The command shows all writes before the first one.
    #[command(after_help = "Example:\n  lexibus restore --bus can:can0 --node 5 drive.eds axis.dcf --dry-run")]
    Restore(Restore),
    /// Compare the values in two backups. The exit code is 1 if there is a difference.
    #[command(after_help = "Example:\n  lexibus compare drive.eds monday.dcf friday.dcf")]
    Compare(Compare),
    /// List the nodes on a CANopen bus, with the descriptions that fit each node.
    #[command(after_help = "Example:\n  lexibus scan --bus can:can0 vendor-files/")]
    Scan(Scan),
    /// Show the traffic on a CANopen bus, or values of a device, with their names. Ends on Ctrl-C or after
    /// `--duration`.
    #[command(
        after_help = "Examples:\n  lexibus monitor --bus can:can0 5=drive.eds\n  lexibus monitor --network network.toml"
    )]
    Monitor(Monitor),
    /// Convert a recorded trace of a CANopen bus (candump, ASC) to names and values.
    #[command(after_help = "Example:\n  lexibus decode trace.log 5=drive.eds")]
    Decode(Decode),
}

/// A description file.
#[derive(Debug, Args)]
pub(crate) struct Described {
    /// Device description.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    #[command(flatten)]
    pub options: DescriptionOptions,
}

/// How a description file is read.
#[derive(Debug, Args)]
pub(crate) struct DescriptionOptions {
    /// Use this device of the file (a name, order code or product code, optionally with @REVISION or @latest).
    #[arg(long, value_name = "DEVICE")]
    pub device: Option<DeviceFilter>,
    /// Set an option that the register table defines; can be repeated.
    #[arg(long, value_name = "NAME=CHOICE", value_parser = choice)]
    pub option: Vec<(String, String)>,
    /// Apply this overlay, a table that corrects and extends descriptions; can be repeated.
    #[arg(long, value_name = "OVERLAY")]
    pub overlay: Vec<PathBuf>,
}

/// A device on a bus, with its description: a description file with `--bus` and `--node`, or a node of a network file.
#[derive(Debug, Args)]
pub(crate) struct Target {
    /// Bus, such as can:can0, slcan:/dev/ttyACM0@500k, tcp:192.168.1.5:502 or rtu:/dev/ttyUSB0@19200-8E1. A network file can state the
    /// bus.
    #[arg(long, value_name = "BUS")]
    pub bus: Option<BusAddress>,
    /// Node-ID on CANopen, or server address on Modbus. Without this option, the device is a node of a network file.
    #[arg(long, value_name = "NODE")]
    pub node: Option<u8>,
    /// Network file with the node; by default, network.toml in the working directory.
    #[arg(long, value_name = "FILE", conflicts_with = "node")]
    pub network: Option<PathBuf>,
    /// Maximum time for a reply, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = 500, value_parser = clap::value_parser!(u16).range(1..))]
    pub timeout: u16,
    /// Device description, or the name of a node in the network file.
    #[arg(value_name = "FILE|NODE")]
    pub file_or_node: PathBuf,
    #[command(flatten)]
    pub options: DescriptionOptions,
}

#[derive(Debug, Args)]
pub(crate) struct Read {
    #[command(flatten)]
    pub target: Target,
    /// Names, paths (OBJECT/NAME) or addresses (0x6081, 0x1018:1, 101) of the values.
    #[arg(required = true, value_name = "NAME")]
    pub names: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct WriteCommand {
    #[command(flatten)]
    pub target: Target,
    /// Name, path (OBJECT/NAME) or address (0x6081, 0x1018:1, 101) of the value.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// Value, such as 15.5 rev/s, 1550 raw, 0x10 or the name of a value. A number for a scaled value needs its unit or
    /// `raw`.
    #[arg(required = true, value_name = "VALUE", allow_negative_numbers = true)]
    pub value: Vec<String>,
    /// Write without asking.
    #[arg(long)]
    pub yes: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Verify {
    #[command(flatten)]
    pub target: Target,
    /// Output format of the report.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = VerifyFormat::Text)]
    pub format: VerifyFormat,
    /// File to write; by default, standard output.
    #[arg(short, long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// In the text format, also list the values that differ from their defaults. The other formats always list them.
    #[arg(long)]
    pub changed: bool,
    /// Also search this range of indices, such as 0x2000..0x5FFF, for undeclared objects; can be repeated. Reading an
    /// undeclared object may have unknown effects.
    #[arg(long, value_name = "RANGE", value_parser = indices)]
    pub search: Vec<std::ops::RangeInclusive<u16>>,
    /// Write the deviations as an overlay to this file, as far as an overlay can express them.
    #[arg(long, value_name = "PATH")]
    pub write_overlay: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum VerifyFormat {
    /// One line per finding, followed by a summary.
    Text,
    /// JSON object.
    Json,
    /// HTML page.
    Html,
}

#[derive(Debug, Args)]
pub(crate) struct BackupCommand {
    #[command(flatten)]
    pub target: Target,
    /// File to write: a DCF (.dcf) or TOML (.toml).
    #[arg(short, long, value_name = "PATH")]
    pub out: PathBuf,
    /// Format of the file; by default, the extension determines the format.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Option<BackupFormat>,
    /// Also save this protected or volatile parameter (a name, path or address); can be repeated.
    #[arg(long, value_name = "NAME")]
    pub include: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackupFormat {
    /// CANopen device configuration file (CiA 306).
    Dcf,
    /// One line per parameter, with name, address and value.
    Toml,
}

#[derive(Debug, Args)]
pub(crate) struct Restore {
    #[command(flatten)]
    pub target: Target,
    /// Backup file: DCF, XDC or TOML.
    #[arg(value_name = "BACKUP")]
    pub backup: PathBuf,
    /// Also restore this protected parameter (a name, path or address); can be repeated.
    #[arg(long, value_name = "NAME")]
    pub include: Vec<String>,
    /// List the writes and the refused values, and write nothing. The bus is not accessed.
    #[arg(long)]
    pub dry_run: bool,
    /// Write without asking.
    #[arg(long, conflicts_with = "dry_run")]
    pub yes: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Compare {
    #[command(flatten)]
    pub described: Described,
    /// Old backup file: DCF, XDC or TOML.
    #[arg(value_name = "OLD")]
    pub old: PathBuf,
    /// New backup file: DCF, XDC or TOML.
    #[arg(value_name = "NEW")]
    pub new: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Scan {
    /// CAN bus, such as can:can0 or slcan:/dev/ttyACM0@500k.
    #[arg(long, value_name = "BUS")]
    pub bus: BusAddress,
    /// Time to wait for replies, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = 200, value_parser = clap::value_parser!(u16).range(1..))]
    pub timeout: u16,
    /// Output format.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = ScanFormat::Text)]
    pub format: ScanFormat,
    /// Device descriptions, or folders that contain them. For each node, the command lists those with the same vendor
    /// ID and product code.
    #[arg(value_name = "FILE")]
    pub descriptions: Vec<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ScanFormat {
    /// One line per node.
    Text,
    /// One line with a JSON object per node.
    Json,
}

/// A node that is watched.
#[derive(Clone, Debug)]
pub(crate) enum WatchedNode {
    /// A node-ID with a description: `5=drive.eds`.
    File(u8, PathBuf),
    /// The name of a node in the network file.
    Named(String),
}

/// The nodes that are watched.
#[derive(Debug, Args)]
pub(crate) struct WatchedNodes {
    /// Network file; by default, network.toml in the working directory.
    #[arg(long, value_name = "FILE")]
    pub network: Option<PathBuf>,
    /// Nodes with their descriptions, as NODE=FILE, or names of nodes in the network file. By default, all nodes of the
    /// network file (with `decode`, only if --network is given).
    #[arg(value_name = "NODE", value_parser = watched_node)]
    pub nodes: Vec<WatchedNode>,
}

#[derive(Debug, Args)]
pub(crate) struct Monitor {
    /// Bus, such as can:can0, slcan:/dev/ttyACM0@500k, tcp:192.168.1.5:502 or rtu:/dev/ttyUSB0@19200-8E1. A network file can state the
    /// bus.
    #[arg(long, value_name = "BUS")]
    pub bus: Option<BusAddress>,
    #[command(flatten)]
    pub watched: WatchedNodes,
    /// Read this value of the first node periodically (a name, path or address); can be repeated. On Modbus, at least one value is
    /// required.
    #[arg(long, value_name = "NAME")]
    pub read: Vec<String>,
    /// Time between two reads of the values, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..))]
    pub period: u32,
    /// Stop after this time, in milliseconds.
    #[arg(long, value_name = "MS")]
    pub duration: Option<u32>,
    /// Maximum time for a reply, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = 500, value_parser = clap::value_parser!(u16).range(1..))]
    pub timeout: u16,
    /// Output format.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = EventFormat::Text)]
    pub format: EventFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EventFormat {
    /// One line per message.
    Text,
    /// Table with the last value for each name. A terminal shows each update; otherwise, the table is printed at the
    /// end.
    Table,
    /// CSV with the columns time, node, kind, address, name and value. One row per value, or per message without
    /// values.
    Csv,
    /// One line with a JSON object per message.
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct Decode {
    /// Trace: the output of candump, with or without -L, or an ASC file.
    #[arg(value_name = "TRACE")]
    pub trace: PathBuf,
    #[command(flatten)]
    pub watched: WatchedNodes,
    /// Output format.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = EventFormat::Text)]
    pub format: EventFormat,
}

fn watched_node(text: &str) -> Result<WatchedNode, String> {
    let Some((node, file)) = text.split_once('=') else { return Ok(WatchedNode::Named(text.to_owned())) };
    let node = node.parse().ok().filter(|node| *node > 0).ok_or("the node must be a number from 1 to 255")?;
    Ok(WatchedNode::File(node, file.into()))
}

fn indices(text: &str) -> Result<std::ops::RangeInclusive<u16>, String> {
    let number = |text: &str| u16::from_str_radix(text.trim_start_matches("0x"), 16).ok();
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    number(first)
        .zip(number(last))
        .map(|(first, last)| first..=last)
        .ok_or_else(|| "expected a range of indices, such as 0x2000..0x5FFF".to_owned())
}
