//! Dependency of object and PDO indices on the slot of a module.

/// Specifies whether the index of a module's object or PDO depends on the slot and the slot group (`DependOnSlot` and
/// `DependOnSlotGroup` of ETG.2000).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DependsOn {
    /// The index is the same in every slot.
    #[default]
    Nothing,
    /// The index increases by an increment per slot.
    Slot,
    /// The index increases by an increment per slot group.
    SlotGroup,
    /// The index increases by an increment per slot and an increment per slot group.
    Both,
}

/// Offsets that a slot adds to the slot-dependent indices of its module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Growth {
    /// Offset of indices that depend on the slot number.
    pub slot: u16,
    /// Offset of indices that depend on the slot group number.
    pub group: u16,
}

impl Growth {
    /// Returns the offset that the slot adds to an index with this dependency.
    pub const fn of(self, depends_on: DependsOn) -> u16 {
        match depends_on {
            DependsOn::Nothing => 0,
            DependsOn::Slot => self.slot,
            DependsOn::SlotGroup => self.group,
            DependsOn::Both => self.slot.wrapping_add(self.group),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_index_grows_with_what_it_depends_on() {
        let growth = Growth { slot: 0x30, group: 0x100 };
        let kinds = [DependsOn::Nothing, DependsOn::Slot, DependsOn::SlotGroup, DependsOn::Both];
        assert_eq!(kinds.map(|depends_on| growth.of(depends_on)), [0, 0x30, 0x100, 0x130]);
    }
}
