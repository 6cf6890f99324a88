//! How indices depend on the slot of a modular device.

/// Rust path of the dependency for an index that is the same in all slots.
pub(super) const NOTHING: &str = "rt::ethercat::DependsOn::Nothing";

/// Returns the dependency of an index on the slot and on the slot group.
pub(super) fn depends_on(slot: bool, group: bool) -> &'static str {
    match (slot, group) {
        (false, false) => NOTHING,
        (true, false) => "rt::ethercat::DependsOn::Slot",
        (false, true) => "rt::ethercat::DependsOn::SlotGroup",
        (true, true) => "rt::ethercat::DependsOn::Both",
    }
}
