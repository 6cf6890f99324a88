//! Converts the settings of a segment to the types of the runtime.

use lexibus::ethercat::{Direction, FmmuSettings, SyncManagerSettings};
use lexibus_codegen::ir::Direction::Receive;
use lexibus_network::ethercat::{Fmmu, SyncManager};

pub fn manager_settings(manager: &SyncManager) -> SyncManagerSettings {
    let &SyncManager { number, start_address, length, control, enable, op_only, .. } = manager;
    SyncManagerSettings { number, start_address, length, control, enable, op_only }
}

pub fn fmmu_settings(fmmu: &Fmmu) -> FmmuSettings {
    let &Fmmu { number, sync_manager, direction, logical_address, length, physical_address, op_only } = fmmu;
    let direction = if direction == Receive { Direction::Output } else { Direction::Input };
    FmmuSettings { number, sync_manager, direction, logical_address, length, physical_address, op_only }
}
