//! PDOs that are assigned by default.

use crate::ir::{Device, Pdo};

/// A PDO that is assigned by default, and the number of its sync manager.
pub(in super::super) struct Assigned<'a> {
    pub pdo: &'a Pdo,
    pub sync_manager: u8,
}

pub(super) fn assigned_by_default(device: &Device) -> Vec<Assigned<'_>> {
    let assigned = device.process_data.assigned_by_default();
    assigned.into_iter().map(|(pdo, sync_manager)| Assigned { pdo, sync_manager }).collect()
}
