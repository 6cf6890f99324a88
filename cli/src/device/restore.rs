//! `lexibus restore`.

use std::io::Write as _;

use lexibus_codegen::text::printable;
use lexibus_device::restore::Plan;

use super::network::Values;
use super::target::Device;
use super::{files, question};
use crate::args::Restore;
use crate::interrupt::Deferred;
use crate::{say, Failure};

pub(super) fn run(arguments: &Restore) -> Result<bool, Failure> {
    let device = Device::of(&arguments.target, Values::Described)?;
    let description = &device.description;
    let include = files::addresses(&arguments.include, description)?;
    let saved = files::backup(&arguments.backup, description)?;
    let plan = Plan::new(description, &saved, Some(device.node), &include);
    let mut out = std::io::stdout().lock();
    for line in plan.to_string().lines() {
        writeln!(out, "{}", printable(line))?;
    }
    let has_failures = plan.refused.iter().any(|refused| refused.is_failure);
    if arguments.dry_run {
        writeln!(out, "{} writes, {} values refused; nothing was written", plan.writes.len(), plan.refused.len())?;
        return Ok(!has_failures);
    }
    drop(out);
    if !question::confirm(arguments.yes, &format!("Write these {} values?", plan.writes.len()))? {
        say("nothing was written");
        return Ok(false);
    }
    let mut connection = device.connect()?;
    let deferred = Deferred::new();
    let outcome = plan.execute(&mut connection, &mut |_| !deferred.is_requested());
    for line in outcome.to_string().lines() {
        say(line);
    }
    if deferred.is_requested() {
        say("interrupted: PDOs that the restore disabled stay disabled until their COB-ID is written");
    }
    Ok(outcome.is_complete() && !has_failures)
}
