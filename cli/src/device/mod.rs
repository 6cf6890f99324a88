//! The subcommands that access devices on a bus.

mod backup;
mod command;
mod decode;
mod events;
mod files;
mod monitor;
mod network;
mod question;
mod restore;
mod scan;
mod target;
mod value;
mod verify;

pub(super) use command::run;
