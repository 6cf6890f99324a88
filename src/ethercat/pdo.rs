//! Description of a PDO.

use super::depends_on::DependsOn;
use crate::pdo::MappedEntry;

/// Direction of process data, as seen by the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Master to slave: an RxPDO.
    Output,
    /// Slave to master: a TxPDO.
    Input,
}

/// A PDO of the device description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoInfo {
    /// Index of the mapping object.
    pub index: u16,
    /// Direction of the PDO.
    pub direction: Direction,
    /// Length in bits.
    pub bits: u32,
    /// The default sync manager; `None` if the PDO is not assigned by default.
    pub sync_manager: Option<u8>,
    /// Sync managers that the PDO must not be assigned to.
    pub excluded_sync_managers: &'static [u8],
    /// Whether the mapping is read-only.
    pub fixed: bool,
    /// Whether the PDO must be assigned.
    pub mandatory: bool,
    /// What the index of the PDO depends on.
    pub depends_on: DependsOn,
    /// Indices of PDOs that must not be assigned together with this one.
    pub excludes: &'static [u16],
    /// The mapped entries. Each entry has its own slot dependency.
    pub mapping: &'static [MappedEntry],
}

impl PdoInfo {
    /// Returns whether the two PDOs exclude each other.
    #[must_use]
    pub fn conflicts_with(&self, other: &PdoInfo) -> bool {
        self.excludes.contains(&other.index) || other.excludes.contains(&self.index)
    }

    /// Returns whether the mapping fits into a mapping object: at most 254 entries of at most 255 bits.
    #[must_use]
    pub fn is_writable(&self) -> bool {
        self.holds(self.mapping)
    }

    /// Returns whether `mapping` fits into the mapping object.
    pub(super) fn holds(&self, mapping: &[MappedEntry]) -> bool {
        !self.fixed && mapping.len() <= 254 && mapping.iter().all(|entry| entry.bits <= 255)
    }
}
