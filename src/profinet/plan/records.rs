//! Start-up records.

use super::{Plan, PlanError};
use crate::profinet::descriptor;

/// A record to write at start-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordWrite<'r> {
    /// Application process identifier (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Index of the record.
    pub index: u16,
    /// Content of the record.
    pub data: &'r [u8],
}

/// Content that replaces the default content of a record in a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Replacement<'r> {
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Index of the record.
    pub index: u16,
    /// Content of the record.
    pub data: &'r [u8],
}

impl<'r> Replacement<'r> {
    /// Creates a replacement for the record `index` of the submodule in `subslot` of `slot`.
    #[must_use]
    pub const fn new(slot: u16, subslot: u16, index: u16, data: &'r [u8]) -> Self {
        Self { slot, subslot, index, data }
    }
}

/// An iterator over the start-up records in the order of their transfer: by slot, by subslot, and by transfer sequence.
#[derive(Clone, Debug)]
pub struct Records<'r, const N: usize> {
    plan: Plan<N>,
    replacements: &'r [Replacement<'r>],
    entry: usize,
    record: usize,
}

impl<const N: usize> Plan<N> {
    /// Returns the start-up records with their default content.
    #[must_use]
    pub fn records(&self) -> Records<'static, N> {
        Records { plan: *self, replacements: &[], entry: 0, record: 0 }
    }

    /// Returns the start-up records. `replacements` contains the records whose content differs from the default
    /// content.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::NoSuchRecord`] if the plan doesn't contain the record of a replacement. Returns
    /// [`PlanError::RecordLength`] if the lengths of record and replacement differ.
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
