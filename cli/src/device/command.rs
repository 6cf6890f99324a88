//! Selects the subcommand that accesses devices on a bus.

use super::{backup, decode, monitor, restore, scan, value, verify};
use crate::args::DeviceCommand;
use crate::Failure;

/// Runs a command. Returns false for exit code 1, for example after a failed read or if `verify` finds deviations.
pub fn run(command: &DeviceCommand) -> Result<bool, Failure> {
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
