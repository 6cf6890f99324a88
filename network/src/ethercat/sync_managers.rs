//! Sync managers and FMMUs of a SubDevice.

use lexibus_codegen::ir::{self, Device};

use super::assignment::direction;
use super::process_data::{bytes, Placed};
use super::segment::{Fmmu, SyncManager};

/// Returns the settings of the sync managers. Sync managers that exist only in the description are left out.
pub(super) fn sync_managers(device: &Device, placed: &[Placed<'_>]) -> Vec<SyncManager> {
    let described = device.process_data.sync_managers.iter().filter(|manager| !manager.is_virtual);
    described.map(|manager| sync_manager(manager, placed)).collect()
}

fn sync_manager(manager: &ir::SyncManager, placed: &[Placed<'_>]) -> SyncManager {
    let length = match direction(manager.purpose) {
        // A longer length is an error, which is reported.
        Some(_) => u16::try_from(bytes(placed, manager.number)).unwrap_or(u16::MAX),
        None => manager.default_size.unwrap_or(0),
    };
    SyncManager {
        number: manager.number,
        purpose: manager.purpose.label(),
        start_address: manager.start_address,
        length,
        control: manager.control,
        enable: manager.enable && length > 0,
        op_only: manager.op_only,
    }
}

/// Returns an FMMU for each sync manager with process data. Each sync manager gets the first free FMMU that the description
/// declares for its purpose. If there is none, it gets the first free FMMU after the declared ones. The logical addresses
/// are 0.
pub(super) fn fmmus(device: &Device, placed: &[Placed<'_>]) -> Vec<Fmmu> {
    let declared = device.ethercat.as_ref().map_or(&[][..], |settings| &settings.fmmus);
    let mut fmmus: Vec<Fmmu> = Vec::new();
    let described = device.process_data.sync_managers.iter();
    let of_data = described.filter_map(|manager| Some((sync_manager(manager, placed), direction(manager.purpose)?)));
    for (manager, direction) in of_data.filter(|(manager, _)| manager.length > 0) {
        let is_free = |number: usize| fmmus.iter().all(|fmmu| usize::from(fmmu.number) != number);
        let maps = |fmmu: &ir::Fmmu| {
            fmmu.purpose == manager.purpose && fmmu.sync_manager.is_none_or(|number| number == manager.number)
        };
        let matching = (0..declared.len()).find(|number| is_free(*number) && maps(&declared[*number]));
        let number = matching.or_else(|| (declared.len()..).find(|number| is_free(*number)));
        fmmus.push(Fmmu {
            number: number.and_then(|number| u8::try_from(number).ok()).unwrap_or(u8::MAX),
            sync_manager: manager.number,
            direction,
            logical_address: 0,
            length: manager.length,
            physical_address: manager.start_address,
            op_only: matching.is_some_and(|number| declared[number].op_only),
        });
    }
    fmmus
}
