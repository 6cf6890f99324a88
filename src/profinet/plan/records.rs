//! The records that a controller sends at start-up.

use super::{Plan, PlanError};
use crate::profinet::descriptor;

/// A record to be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordWrite<'r> {
    /// Number of the application process (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// The record's index.
    pub index: u16,
    /// What to write.
    pub data: &'r [u8],
}

/// Bytes for a record of a plan, in place of its defaults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Replacement<'r> {
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// The record's index.
    pub index: u16,
    /// What to write.
    pub data: &'r [u8],
}

impl<'r> Replacement<'r> {
    /// `data` for the record `index` of the submodule in `subslot` of `slot`.
    #[must_use]
    pub const fn new(slot: u16, subslot: u16, index: u16, data: &'r [u8]) -> Self {
        Self { slot, subslot, index, data }
    }
}

/// Start-up records in the order of transfer: by slot and subslot, and within a submodule as its description orders
/// them.
#[derive(Clone, Debug)]
pub struct Records<'r, const N: usize> {
    plan: Plan<N>,
    replacements: &'r [Replacement<'r>],
    entry: usize,
    record: usize,
}

impl<const N: usize> Plan<N> {
    /// The records that a controller sends at start-up, with their defaults.
    #[must_use]
    pub fn records(&self) -> Records<'static, N> {
        Records { plan: *self, replacements: &[], entry: 0, record: 0 }
    }

    /// The same with some of them replaced.
    ///
    /// # Errors
    ///
    /// When a replacement belongs to no record of the plan, or has another length.
    pub fn records_with<'r>(&self, replacements: &'r [Replacement<'r>]) -> Result<Records<'r, N>, PlanError> {
        for replacement in replacements {
            let submodule = self.submodule(replacement.slot, replacement.subslot).ok_or(PlanError::NoSuchRecord)?;
            let mut records = submodule.records.iter();
            let record = records.find(|record| record.index == replacement.index).ok_or(PlanError::NoSuchRecord)?;
            if record.data.len() != replacement.data.len() {
                return Err(PlanError::RecordLength);
            }
        }
        Ok(Records { replacements, ..self.records() })
    }
}

impl<'r, const N: usize> Iterator for Records<'r, N> {
    type Item = RecordWrite<'r>;

    fn next(&mut self) -> Option<RecordWrite<'r>> {
        loop {
            let entry = (*self.plan.entries.get(self.entry)?)?;
            let records: &[descriptor::Record] = entry.submodule.map_or(&[], |submodule| submodule.records);
            let (Some(record), Some(submodule)) = (records.get(self.record), entry.submodule) else {
                self.entry += 1;
                self.record = 0;
                continue;
            };
            self.record += 1;
            let place = (entry.slot, entry.subslot, record.index);
            let mut replacements = self.replacements.iter();
            let replaced = replacements.find(|other| (other.slot, other.subslot, other.index) == place);
            return Some(RecordWrite {
                api: submodule.api,
                slot: entry.slot,
                subslot: entry.subslot,
                index: record.index,
                data: replaced.map_or(record.data, |replacement| replacement.data),
            });
        }
    }
}
