//! `lexibus verify`.

use std::io::Write as _;
use std::path::Path;

use lexibus_codegen::output::write_if_changed;
use lexibus_device::verify::{verify, Options};
use lexibus_device::Network;

use super::target::Device;
use crate::args::{Verify, VerifyFormat};
use crate::{say, Failure};

pub(super) fn run(arguments: &Verify) -> Result<bool, Failure> {
    let device = Device::configured(&arguments.target)?;
    let description = &device.description;
    let mut connection = device.connect()?;
    let is_canopen = description.network() == Network::CanOpen;
    let options = Options { node_id: is_canopen.then_some(device.node), search: arguments.search.clone() };
    let report = verify(description, &mut connection, &options)?;
    let text = match arguments.format {
        VerifyFormat::Text => report.text(arguments.changed),
        VerifyFormat::Json => report.json(),
        VerifyFormat::Html => report.html(),
    };
    put(arguments.out.as_deref(), &text)?;
    if let Some(path) = &arguments.write_overlay {
        match report.overlay() {
            Some(overlay) => put(Some(path), &overlay)?,
            None => say("no overlay was written, because there is no deviation that an overlay can express"),
        }
    }
    let has_deviations = report.deviations().next().is_some();
    Ok(!has_deviations)
}

/// Writes a text to a file or standard output.
pub(super) fn put(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path {
        Some(path) => write_if_changed(path, text)
            .map_err(|error| Failure::Failed(format!("cannot write {}: {error}", path.display()))),
        None => Ok(std::io::stdout().lock().write_all(text.as_bytes())?),
    }
}
