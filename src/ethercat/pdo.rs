//! What a master has to know of a PDO.

use super::depends_on::DependsOn;
use crate::pdo::MappedEntry;

/// Direction of process data, seen from the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Master to slave: an RxPDO.
    Output,
    /// Slave to master: a TxPDO.
    Input,
}

/// A PDO as the description has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoInfo {
    /// Index of its mapping object.
    pub index: u16,
    /// Its direction.
    pub direction: Direction,
    /// Length in bits.
    pub bits: u32,
    /// The sync manager to which it is assigned by default; `None` for a PDO that is assigned on demand.
    pub sync_manager: Option<u8>,
    /// Sync managers to which it can't be assigned.
    pub excluded_sync_managers: &'static [u8],
    /// Whether the mapping can't be changed.
    pub fixed: bool,
    /// Whether it has to be assigned.
    pub mandatory: bool,
    /// What its index grows with.
    pub depends_on: DependsOn,
    /// PDOs that can't be assigned together with this one.
    pub excludes: &'static [u16],
    /// What it carries. Each entry says itself whether its index grows with the slot.
    pub mapping: &'static [MappedEntry],
}

impl PdoInfo {
    /// Whether the two can't be assigned together.
    #[must_use]
    pub fn conflicts_with(&self, other: &PdoInfo) -> bool {
        self.excludes.contains(&other.index) || other.excludes.contains(&self.index)
    }

    /// Whether a mapping object can hold the mapping: it has 254 sub-indices, and 8 bits for the length of an entry.
    #[must_use]
    pub fn is_writable(&self) -> bool {
        self.holds(self.mapping)
    }

    /// Whether the mapping object can hold `mapping`.
    pub(super) fn holds(&self, mapping: &[MappedEntry]) -> bool {
        !self.fixed && mapping.len() <= 254 && mapping.iter().all(|entry| entry.bits <= 255)
    }
}
