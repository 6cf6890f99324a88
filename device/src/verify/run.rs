//! Runs the comparison.

use super::extra;
use super::identity;
use super::item;
use super::mapping;
use super::report::Report;
use super::session::{Options, Run};
use crate::address::Network;
use crate::connection::Connection;
use crate::description::Description;
use crate::failure::Failure;

/// Compares a device with its description. Nothing is written.
///
/// # Errors
///
/// Fails if the bus fails while a value is read, or if five consecutive reads get no reply. Each read has up to three attempts.
pub fn verify(
    description: &Description,
    connection: &mut impl Connection,
    options: &Options,
) -> Result<Report, Failure> {
    let mut run = Run::new(description, connection, options);
    for parameter in description.parameters() {
        item::check(&mut run, &parameter)?;
    }
    if description.network() == Network::CanOpen {
        item::check_identity(&mut run)?;
        mapping::check(&mut run)?;
        extra::check(&mut run)?;
    } else {
        identity::check(&mut run);
    }
    let mut report = run.report;
    report.findings.sort_by_key(|finding| finding.kind);
    Ok(report)
}
