//! Executes a plan.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::order::pdo;
use super::plan::Plan;
use crate::address::Address;
use crate::connection::Connection;
use crate::failure::Failure;
use crate::write::{Write, WriteError};

/// The state of a write after a restore.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// The device confirmed the write.
    Written,
    /// The device refused the value, the client doesn't support the write, or a condition of the description doesn't hold
    /// or cannot be checked. The value before this write remains.
    Refused(WriteError),
    /// The bus failed, the write timed out, or the device refused a Modbus request for a value of several registers. The
    /// device has the old value, the new value, or a part of the new value.
    Uncertain(Failure),
    /// The bus failed or a read timed out when a condition of this write was checked. The value was not sent.
    NotSent(Failure),
    /// The restore ended before this write, or an earlier write of the same PDO failed. The old value remains, unless
    /// an earlier write changed it.
    NotWritten,
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Status::Written => f.write_str("written"),
            Status::Refused(reason) => write!(f, "refused: {reason}"),
            Status::Uncertain(failure) => {
                write!(f, "uncertain, the device has the old value, the new value or a part of it: {failure}")
            }
            Status::NotSent(failure) => write!(f, "not written: {failure}"),
            Status::NotWritten => f.write_str("not written"),
        }
    }
}

/// The result of a restore.
#[derive(Clone, Debug)]
pub struct Outcome<'d> {
    /// The state of every write, in the order of the plan.
    pub states: Vec<(Write<'d>, Status)>,
    /// Written parameters that have another value afterwards, or whose read is refused, with the value or the failure as
    /// text.
    pub mismatches: Vec<(Write<'d>, String)>,
    /// Number of confirmed values that were not read back because of timeouts or bus failures.
    pub unconfirmed: usize,
}

impl Outcome<'_> {
    /// Returns whether the device confirmed all writes, and there are neither mismatches nor values that were not read
    /// back because of failures.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.mismatches.is_empty()
            && self.unconfirmed == 0
            && self.states.iter().all(|(_, status)| *status == Status::Written)
    }

    /// Returns the number of confirmed writes.
    #[must_use]
    pub fn written(&self) -> usize {
        self.states.iter().filter(|(_, status)| *status == Status::Written).count()
    }
}

impl fmt::Display for Outcome<'_> {
    /// Writes one line for each write that was not confirmed and for each mismatch. Then writes the number of values that
    /// were not read back, if it is not 0, and a summary.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (write, status) in self.states.iter().filter(|(_, status)| *status != Status::Written) {
            writeln!(f, "{write}: {status}")?;
        }
        for (write, actual) in &self.mismatches {
            writeln!(f, "{write}: written, but reading it back returned: {actual}")?;
        }
        if self.unconfirmed > 0 {
            writeln!(f, "{} written values could not be read back", self.unconfirmed)?;
        }
        writeln!(f, "{} of {} values written", self.written(), self.states.len())
    }
}

impl<'d> Plan<'d> {
    /// Writes the values, and then reads back the written values that can be read.
    ///
    /// `proceed` is called before each write that is attempted. If it returns false, the restore ends, and the
    /// remaining values are not written. The restore also ends if the bus fails, if a request times out, or if the device
    /// refuses a Modbus value of several registers. After any other refusal, or if a condition doesn't hold, the restore
    /// continues, but the remaining values of the same PDO are not written. After a restore that ended early, the written
    /// values are read back too, because the device may have restarted.
    pub fn execute(
        &self,
        connection: &mut impl Connection,
        proceed: &mut dyn FnMut(&Write<'d>) -> bool,
    ) -> Outcome<'d> {
        let mut states = Vec::with_capacity(self.writes.len());
        let mut is_ended = false;
        // After a failed write of a PDO, its other values are not written, so that no mixture of old and new values is enabled.
        let mut failed_pdos = BTreeSet::new();
        for write in &self.writes {
            let pdo = write.parameter().address().object().and_then(|object| pdo(object.index));
            let is_failed = pdo.is_some_and(|pdo| failed_pdos.contains(&pdo));
            is_ended = is_ended || !(is_failed || proceed(write));
            let status = if is_ended || is_failed { Status::NotWritten } else { attempt(write, connection) };
            failed_pdos.extend(pdo.filter(|_| status != Status::Written));
            is_ended = is_ended || matches!(status, Status::Uncertain(_) | Status::NotSent(_));
            states.push((write.clone(), status));
        }
        let (mismatches, unconfirmed) = read_back(&states, connection);
        Outcome { states, mismatches, unconfirmed }
    }
}

fn attempt(write: &Write<'_>, connection: &mut impl Connection) -> Status {
    if let Err(error) = write.check_conditions(connection) {
        return match error {
            WriteError::Failed(failure) if !failure.is_refusal() => Status::NotSent(failure),
            error => Status::Refused(error),
        };
    }
    match connection.write(write.parameter().address(), write.bytes()) {
        Ok(()) => Status::Written,
        // The client may send a value of several registers in several requests. The requests before the refused one
        // succeeded.
        Err(failure @ Failure::Exception(_)) if is_of_several_registers(write) => Status::Uncertain(failure),
        Err(failure) if failure.is_refusal() => Status::Refused(failure.into()),
        Err(failure) => Status::Uncertain(failure),
    }
}

fn is_of_several_registers(write: &Write<'_>) -> bool {
    matches!(write.parameter().address(), Address::Register(register) if register.count > 1)
}

/// Reads back the last written value of each address that can be read. Returns the writes whose value differs or whose read
/// is refused. Also returns the number of values that were not read because of timeouts or bus failures. After such a
/// failure, the device may have restarted, so all values are read again, up to three times in total.
fn read_back<'d>(
    states: &[(Write<'d>, Status)],
    connection: &mut impl Connection,
) -> (Vec<(Write<'d>, String)>, usize) {
    /// Maximum number of attempts to read all values without a failure.
    const ATTEMPTS: usize = 3;
    let written = states.iter().filter(|(_, status)| *status == Status::Written).map(|(write, _)| write);
    let last: BTreeMap<Address, &Write<'d>> = written.map(|write| (write.parameter().address(), write)).collect();
    let readable: Vec<&Write<'d>> =
        last.into_values().filter(|write| write.parameter().read_refusal().is_none()).collect();
    let mut result = (Vec::new(), readable.len());
    for _ in 0..ATTEMPTS {
        result = read_all(&readable, connection);
        if result.1 == 0 {
            break;
        }
    }
    result
}

/// Reads values once. Stops after two timeouts or bus failures, and counts the remaining values as not read.
fn read_all<'d>(writes: &[&Write<'d>], connection: &mut impl Connection) -> (Vec<(Write<'d>, String)>, usize) {
    const MOST_FAILURES: usize = 2;
    let (mut mismatches, mut failures) = (Vec::new(), 0);
    for (at, write) in writes.iter().enumerate() {
        if failures == MOST_FAILURES {
            return (mismatches, failures + writes.len() - at);
        }
        let expected = write.parameter().decode(write.bytes());
        match write.parameter().read(connection) {
            Ok(reading) if reading.bytes == write.bytes() || expected.is_some() && reading.value == expected => {}
            Ok(reading) => mismatches.push(((*write).clone(), reading.to_string())),
            Err(failure) if failure.is_refusal() => mismatches.push(((*write).clone(), failure.to_string())),
            Err(_) => failures += 1,
        }
    }
    (mismatches, failures)
}
