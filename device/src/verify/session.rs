//! The state of a running comparison.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use super::finding::{Finding, FindingKind};
use super::report::Report;
use crate::connection::Connection;
use crate::description::Description;
use crate::failure::{retried, Failure};
use crate::parameter::Parameter;

/// Number of consecutive reads without a reply after which the comparison ends. Each of these reads has three attempts.
const MOST_TIMEOUTS: usize = 5;

/// Options of a comparison.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Node-ID of a CANopen device, for values that depend on it.
    pub node_id: Option<u8>,
    /// Ranges of indices in which to search for undeclared objects, in addition to 0x1000 to 0x1029 and the PDO
    /// parameters and mappings. Reading an undeclared object may have unknown effects.
    pub search: Vec<RangeInclusive<u16>>,
}

/// The state of a running comparison.
pub(super) struct Run<'r, C> {
    pub description: &'r Description,
    pub connection: &'r mut C,
    pub options: &'r Options,
    pub report: Report,
    /// Indices of the objects that were reported as missing.
    pub missing: BTreeSet<u16>,
    timeouts: usize,
}

impl<'r, C: Connection> Run<'r, C> {
    pub fn new(description: &'r Description, connection: &'r mut C, options: &'r Options) -> Self {
        let report = Report::new(description);
        Run { description, connection, options, report, missing: BTreeSet::new(), timeouts: 0 }
    }

    pub fn add(&mut self, finding: Finding) {
        self.report.findings.push(finding);
    }

    /// Reads a parameter. The inner error is the failure of this read only. The outer error ends the comparison, because the
    /// bus failed or the device doesn't reply any more.
    pub fn read(&mut self, parameter: &Parameter<'_>) -> Result<Result<Vec<u8>, Failure>, Failure> {
        let result = retried(|| parameter.read(self.connection).map(|reading| reading.bytes));
        self.checked(result)
    }

    /// Reads an object, even if the description doesn't declare it.
    pub fn read_object(&mut self, index: u16, sub_index: u8) -> Result<Result<Vec<u8>, Failure>, Failure> {
        let address = crate::address::Address::Object(lexibus::Object::new(index, sub_index));
        let result = retried(|| self.connection.read(address, 0));
        self.checked(result)
    }

    fn checked(&mut self, result: Result<Vec<u8>, Failure>) -> Result<Result<Vec<u8>, Failure>, Failure> {
        match &result {
            Err(failure) if failure.is_timeout() => {
                self.timeouts += 1;
                if self.timeouts >= MOST_TIMEOUTS {
                    return Err(failure.clone());
                }
            }
            Err(Failure::Bus(text)) => return Err(Failure::Bus(text.clone())),
            _ => self.timeouts = 0,
        }
        Ok(result)
    }
}

/// Creates a finding about a fact that cannot be verified.
pub(super) fn unverifiable(parameter: &Parameter<'_>, message: &str) -> Finding {
    Finding::of(parameter, FindingKind::Unverifiable, message)
}
