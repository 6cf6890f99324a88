//! Arguments of the command line.

mod command;
mod inputs;
mod network;
mod output;

pub(super) use command::{
    Arguments, Bus, Check, Command, Diff, DiffFormat, Docs, DocsFormat, ExplainFormat, Fix, Import, InfoFormat, New,
    Schema, Shown,
};
pub(super) use inputs::{ColorChoice, Inputs, LevelArguments, MessageFormat, Printing};
pub(super) use network::{Network, NetworkBuild, NetworkCheck, NetworkCommand, NetworkInput};
pub(super) use output::{Export, ExportFormat, Generate, RealForm};
