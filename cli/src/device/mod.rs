//! The subcommands that access devices on a bus.

mod backup;
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

use super::args::DeviceCommand;
use super::Failure;

/// Runs a command. Returns false for exit code 1, for example after a failed read or if `verify` finds deviations.
pub(super) fn run(command: &DeviceCommand) -> Result<bool, Failure> {
    match command {
        DeviceCommand::Read(read) => value::read(read),
        DeviceCommand::Write(write) => value::write(write),
        DeviceCommand::Verify(verify) => verify::run(verify),
        DeviceCommand::Backup(backup) => backup::run(backup),
        DeviceCommand::Restore(restore) => restore::run(restore),
        DeviceCommand::Compare(compare) => backup::compare(compare),
        DeviceCommand::Scan(scan) => scan::run(scan),
        DeviceCommand::Monitor(monitor) => monitor::run(monitor),
        DeviceCommand::Decode(decode) => decode::run(decode),
    }
}
