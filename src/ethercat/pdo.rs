//! Description of a PDO.

use super::depends_on::DependsOn;
use crate::pdo::MappedEntry;

/// Maximum number of entries of a PDO mapping (ETG.1000.6, 5.6.7.4).
pub(super) const MAX_MAPPED_ENTRIES: usize = 254;

/// Direction of process data from the master's point of view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From master to slave: an RxPDO.
    Output,
    /// From slave to master: a TxPDO.
    Input,
}

/// A PDO of the device description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoInfo {
    /// Index of the mapping object.
    pub index: u16,
    /// Direction of the PDO.
    pub direction: Direction,
    /// Length of the PDO in bits.
    pub bits: u32,
    /// Number of the default sync manager; `None` if the PDO is not assigned by default.
    pub sync_manager: Option<u8>,
    /// Numbers of the sync managers that the PDO must not be assigned to.
    pub excluded_sync_managers: &'static [u8],
    /// True if the mapping is read-only.
    pub fixed: bool,
    /// True if the PDO must be assigned.
    pub mandatory: bool,
    /// Slot dependency of the PDO's index.
    pub depends_on: DependsOn,
    /// Indices of PDOs that must not be assigned together with this PDO.
    pub excludes: &'static [u16],
    /// The mapped entries. The index of each entry has its own slot dependency.
    pub mapping: &'static [MappedEntry],
}

impl PdoInfo {
    /// Returns whether this PDO excludes `other`, or `other` excludes this PDO.
    #[must_use]
    pub fn conflicts_with(&self, other: &PdoInfo) -> bool {
        self.excludes.contains(&other.index) || other.excludes.contains(&self.index)
    }

    /// Returns whether the mapping can be written: the mapping isn't read-only, and has at most 254 entries of at most
    /// 255 bits each.
    #[must_use]
    pub fn is_writable(&self) -> bool {
        self.holds(self.mapping)
    }

    /// Returns whether `mapping` can be written to the mapping object.
    pub(super) fn holds(&self, mapping: &[MappedEntry]) -> bool {
        !self.fixed && mapping.len() <= MAX_MAPPED_ENTRIES && mapping.iter().all(|entry| entry.bits <= 255)
    }
}
