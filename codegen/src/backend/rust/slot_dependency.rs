//! What the indices of a modular device grow with.

/// What an index grows with that is the same in every slot.
pub(super) const NOTHING: &str = "rt::ethercat::DependsOn::Nothing";

/// What an index grows with.
pub(super) fn depends_on(slot: bool, group: bool) -> &'static str {
    match (slot, group) {
        (false, false) => NOTHING,
        (true, false) => "rt::ethercat::DependsOn::Slot",
        (false, true) => "rt::ethercat::DependsOn::SlotGroup",
        (true, true) => "rt::ethercat::DependsOn::Both",
    }
}
