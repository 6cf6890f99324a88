//! What the index of an object or PDO of a module grows with.

/// What an index of a module grows with (`DependOnSlot` and `DependOnSlotGroup` of ETG.2000).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DependsOn {
    /// It is the same in every slot.
    #[default]
    Nothing,
    /// The number of the slot.
    Slot,
    /// The number of the slot group.
    SlotGroup,
    /// Both numbers.
    Both,
}

/// What the indices of a module grow by at its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Growth {
    /// Those that depend on the slot.
    pub slot: u16,
    /// Those that depend on the slot group.
    pub group: u16,
}

impl Growth {
    /// What an index that depends on this grows by.
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
