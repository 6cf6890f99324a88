//! Connections to devices.

use std::time::Duration;

use lexibus_device::{Connection, Description};

use super::files;
use crate::args::Target;
use crate::Failure;

/// Reads the description of a target.
pub(super) fn description(target: &Target) -> Result<Description, Failure> {
    files::description(&target.described, target.bus.network())
}

/// Connects to the device of a target.
pub(super) fn connect(target: &Target, description: &Description) -> Result<Box<dyn Connection>, Failure> {
    let timeout = Duration::from_millis(target.timeout.into());
    Ok(target.bus.connect(description, target.node, timeout)?)
}

impl From<lexibus_device::Failure> for Failure {
    fn from(failure: lexibus_device::Failure) -> Self {
        Failure::Device(failure.to_string())
    }
}
