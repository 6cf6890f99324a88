//! `lexibus read` and `lexibus write`.

use std::io::Write as _;

use lexibus_codegen::text::printable;
use lexibus_device::Write;

use super::network::Values;
use super::question;
use super::target::Device;
use crate::args::{Read, WriteCommand};
use crate::interrupt::Deferred;
use crate::{say, Failure};

pub(super) fn read(arguments: &Read) -> Result<bool, Failure> {
    let device = Device::of(&arguments.target, Values::Described)?;
    let parameters = arguments.names.iter().map(|name| device.description.find(name));
    let parameters = parameters.collect::<Result<Vec<_>, _>>().map_err(|error| Failure::Usage(error.to_string()))?;
    let mut connection = device.connect()?;
    let mut is_ok = true;
    for parameter in parameters {
        match parameter.read(&mut connection) {
            Ok(reading) => {
                let line = format!("{parameter} = {reading}");
                writeln!(std::io::stdout(), "{}", printable(&line))?;
            }
            Err(failure) => {
                is_ok = false;
                say(&format!("error: {parameter}: {failure}"));
            }
        }
    }
    Ok(is_ok)
}

pub(super) fn write(arguments: &WriteCommand) -> Result<bool, Failure> {
    let device = Device::of(&arguments.target, Values::Described)?;
    let parameter = device.description.find(&arguments.name).map_err(|error| Failure::Usage(error.to_string()))?;
    let text = arguments.value.join(" ");
    let write = Write::parse(parameter, &text, Some(device.node));
    let write = write.map_err(|error| Failure::Failed(format!("{parameter}: {error}")))?;
    let mut connection = device.connect()?;
    let old = match parameter.read_refusal() {
        Some(refusal) => format!("not read: {refusal}"),
        None => match parameter.read(&mut connection) {
            Ok(reading) => reading.to_string(),
            Err(failure) => format!("unknown: {failure}"),
        },
    };
    say(&format!("{write} (now {old})"));
    if let Some(protection) = parameter.protection() {
        say(&format!("note: this parameter {protection}"));
    }
    if !question::confirm(arguments.yes, "Write this value?")? {
        say("nothing was written");
        return Ok(false);
    }
    // Defer Ctrl-C, because after an interrupted transfer it would be unknown whether the device has the new value.
    let deferred = Deferred::new();
    let result = write.execute(&mut connection);
    drop(deferred);
    result.map_err(|error| Failure::Failed(format!("{parameter}: {error}")))?;
    say("written");
    Ok(true)
}
