//! `lexibus verify`.

use lexibus_device::verify::{verify, Options};
use lexibus_device::Network;

use super::network::Values;
use super::target::Device;
use crate::args::{Verify, VerifyFormat};
use crate::files::put;
use crate::{say, Failure};

pub(super) fn run(arguments: &Verify) -> Result<bool, Failure> {
    let device = Device::of(&arguments.target, Values::Configured)?;
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
