//! `lexibus backup` and `lexibus compare`.

use std::io::Write as _;

use lexibus_codegen::text::{count_of, printable};
use lexibus_device::backup::{backup, difference, Backup, Options};
use lexibus_device::{Description, Network};

use super::files;
use super::network::Values;
use super::target::Device;
use crate::args::{BackupCommand, BackupFormat, Compare, Described};
use crate::files::put;
use crate::{say, Failure};

pub(super) fn run(arguments: &BackupCommand) -> Result<bool, Failure> {
    let device = Device::of(&arguments.target, Values::Described)?;
    let description = &device.description;
    let include = files::addresses(&arguments.include, description)?;
    let format = format(arguments)?;
    let mut connection = device.connect()?;
    let options = Options { node_id: Some(device.node), include };
    let saved = backup(description, &mut connection, &options)?;
    let mut is_complete = saved.is_complete();
    let text = match format {
        BackupFormat::Toml => saved.toml(description),
        BackupFormat::Dcf => {
            let file = saved.dcf(description).map_err(|error| Failure::Usage(error.to_string()))?;
            is_complete &= file.lost.is_empty();
            file.lost.iter().for_each(|lost| say(&format!("warning: not saved: {lost}")));
            file.text
        }
    };
    put(Some(&arguments.out), &text)?;
    for skipped in &saved.skipped {
        let kind = if skipped.is_failure { "warning: not saved" } else { "left out" };
        say(&format!("{kind}: {skipped}"));
    }
    say(&format!("{} values saved to {}", saved.entries.len(), arguments.out.display()));
    Ok(is_complete)
}

fn format(arguments: &BackupCommand) -> Result<BackupFormat, Failure> {
    let extension = arguments.out.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    match (arguments.format, extension.to_ascii_lowercase().as_str()) {
        (Some(format), _) => Ok(format),
        (None, "dcf") => Ok(BackupFormat::Dcf),
        (None, "toml") => Ok(BackupFormat::Toml),
        (None, _) => {
            Err(Failure::Usage("the extension is neither .dcf nor .toml: add --format dcf or toml".to_owned()))
        }
    }
}

pub(super) fn compare(arguments: &Compare) -> Result<bool, Failure> {
    let description = either(arguments)?;
    let [old, new]: [Backup; 2] =
        [files::backup(&arguments.old, &description)?, files::backup(&arguments.new, &description)?];
    let differences = difference(&description, &old, &new);
    let mut out = std::io::stdout().lock();
    for difference in &differences {
        writeln!(out, "{}", printable(&difference.to_string()))?;
    }
    writeln!(out, "{}", count_of(differences.len(), "difference"))?;
    Ok(differences.is_empty())
}

/// Reads the description for CANopen. Reads the description for Modbus instead if it cannot be read for CANopen, or if
/// both backups are TOML files and the old backup does not match the CANopen description.
fn either(arguments: &Compare) -> Result<Description, Failure> {
    let Described { file, options } = &arguments.described;
    let of_objects = files::description(file, options, Network::CanOpen);
    let has_toml =
        [&arguments.old, &arguments.new].iter().all(|path| path.extension().is_some_and(|end| end == "toml"));
    match of_objects {
        Ok(description) if !has_toml => Ok(description),
        // A device can have both registers and objects, so the addresses in the old backup determine the bus.
        Ok(description) if files::backup(&arguments.old, &description).is_ok() => Ok(description),
        Ok(_) | Err(_) => files::description(file, options, Network::Modbus),
    }
}
