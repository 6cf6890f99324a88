//! Default PDO assignment of EtherCAT slaves: missing sync managers, conflicts, lengths and excluded PDOs.

use super::context::{Context, PdoOwner};
use crate::collections::HashSet;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{DefaultAssignment, Pdo, ProcessData, SyncManager, MAX_PDO_SUBS};
use crate::number::hex16;
use crate::text::count_of;

/// Reports PDOs whose sync manager is not described, and PDOs that are assigned by default but exclude each other. Also
/// reports sync managers with too many or too long default PDOs.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let data = &context.device.process_data;
    for pdo in &data.pdos {
        sync_manager_exists(pdo, data, diagnostics);
    }
    let by_default = data.default_assignment();
    conflicts(&by_default, diagnostics);
    lengths(&by_default, &data.sync_managers, diagnostics);
}

/// Reports PDOs that exclude an undescribed PDO.
pub(super) fn excluded(owner: &PdoOwner<'_>, diagnostics: &mut Diagnostics) {
    let data = owner.data;
    let known: HashSet<u16> = data.pdos.iter().map(|pdo| pdo.mapping_index).collect();
    for pdo in &data.pdos {
        let missing = pdo.excludes.iter().find(|index| !known.contains(index));
        if let Some(index) = missing {
            let (pdo_index, index) = (hex16(pdo.mapping_index), hex16(*index));
            let message = format!("the PDO {pdo_index} excludes {index}, which is not described");
            diagnostics.push(codes::EXCLUDED_PDO_MISSING.at(pdo.origin.span, message));
        }
    }
}

fn sync_manager_exists(pdo: &Pdo, data: &ProcessData, diagnostics: &mut Diagnostics) {
    let Some(number) = pdo.sync_manager.filter(|&number| !data.has_sync_manager(number)) else { return };
    let message =
        format!("the PDO {} is assigned to sync manager {number}, which is not described", hex16(pdo.mapping_index));
    diagnostics
        .push(codes::NO_SUCH_SYNC_MANAGER.at(pdo.origin.span, message).label("left out of the default process image"));
}

fn conflicts(by_default: &DefaultAssignment, diagnostics: &mut Diagnostics) {
    // PDOs that share an index are left out here, because the lint `pdo-entries` reports them.
    for (pdo, other) in by_default.left_out.iter().filter(|(pdo, other)| other.mapping_index != pdo.mapping_index) {
        let (first, second) = (hex16(other.mapping_index), hex16(pdo.mapping_index));
        let message = format!("the PDOs {first} and {second} are both assigned by default, but exclude each other");
        let found = codes::DEFAULT_PDOS_CONFLICT.at(pdo.origin.span, message);
        let found = found.label("left out of the default process image");
        diagnostics.push(found.note_at(other.origin.span, "used in the default process image"));
    }
}

fn lengths(by_default: &DefaultAssignment, sync_managers: &[SyncManager], diagnostics: &mut Diagnostics) {
    // For each sync manager, the number of assigned PDOs and the sum of their lengths in bits.
    let mut inside = [(0usize, 0u64); 256];
    for (pdo, number) in &by_default.assigned {
        let (count, bits) = &mut inside[usize::from(*number)];
        *count += 1;
        *bits += u64::from(pdo.bits());
    }
    for manager in sync_managers {
        let number = manager.number;
        let (count, bits) = inside[usize::from(number)];
        if count > MAX_PDO_SUBS {
            let message = format!(
                "sync manager {number} has {count} default PDOs, but a PDO assignment holds at most {MAX_PDO_SUBS}"
            );
            diagnostics.push(codes::TOO_MANY_PDOS.at(manager.origin.span, message));
        }
        let Some(max) = manager.size_range.1.filter(|&max| max > 0) else { continue };
        let bytes = bits.div_ceil(8);
        if bytes > u64::from(max) {
            let length = count_of(bytes, "byte");
            let message = format!("the default PDOs of sync manager {number} have {length}, but MaxSize is {max}");
            diagnostics.push(codes::IMAGE_TOO_LONG.at(manager.origin.span, message));
        }
    }
}
