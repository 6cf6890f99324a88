//! Arguments of the command line.

mod command;
#[cfg(feature = "bus")]
mod device;
mod inputs;
mod network;
mod output;

pub(super) use command::{
    Arguments, Bus, Check, Command, Diff, DiffFormat, Docs, DocsFormat, ExplainFormat, Fix, Import, InfoFormat, New,
    Schema, Shown,
};
#[cfg(feature = "bus")]
pub(super) use device::{
    BackupCommand, BackupFormat, Compare, Decode, Described, DescriptionOptions, DeviceCommand, EventFormat, Monitor,
    Read, Restore, Scan, ScanFormat, Target, Verify, VerifyFormat, WatchedNode, WatchedNodes, WriteCommand,
};
pub(super) use inputs::{ColorChoice, Inputs, LevelArguments, MessageFormat, Printing};
pub(super) use network::{Network, NetworkBuild, NetworkCheck, NetworkCommand, NetworkInput};
pub(super) use output::{Export, ExportFormat, Generate, RealForm};
