//! The categories "FMMU", "SyncM", "TxPDO" and "RxPDO" (ETG.2010, tables 9, 11 and 14).

use lexibus_codegen::etg::type_name::{self, Basic};
use lexibus_codegen::facts::pdo::MAX_ENTRY;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::{Direction, Pdo, PdoEntry, SyncManager, SyncManagerPurpose, Type};

use super::general::bits;
use super::Context;
use crate::note::{NoteKind, Subject};
use crate::types::without_length;

/// Length in bits of a part of a PDO entry. Entries with more than 255 bits are split into parts. The last part can be
/// shorter.
const PART: u32 = 248;

/// Sync manager number of PDOs that are not assigned to a sync manager by default.
const UNASSIGNED: u8 = 0xFF;

/// Returns the purposes of the FMMUs, one byte for each FMMU. Adds notes on purposes and settings that the category
/// cannot express.
pub(super) fn fmmus(context: &mut Context<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for fmmu in &context.settings.fmmus {
        let subject = Subject::Named("Fmmu");
        bytes.push(match fmmu.purpose.as_str() {
            "" => 0,
            "Outputs" => 1,
            "Inputs" => 2,
            "MBoxState" => 3,
            _ => {
                context.notes.add(NoteKind::Spelling, subject);
                0
            }
        });
        let others = [fmmu.sync_manager.is_some(), fmmu.sync_unit.is_some(), fmmu.op_only];
        context.notes.add_many(NoteKind::Setting, others.iter().filter(|is_set| **is_set).count(), subject);
    }
    context.notes.add_many(NoteKind::Setting, context.settings.sync_units.len(), Subject::Named("Su"));
    bytes
}

/// Returns the sync managers, eight bytes for each sync manager. Gaps in the sync manager numbers are filled with unused
/// sync managers, whose bytes are all 0.
pub(super) fn sync_managers(context: &Context<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let assigned = context.device.process_data.assigned_by_default();
    for manager in &context.device.process_data.sync_managers {
        bytes.resize(8 * usize::from(manager.number), 0);
        let purpose = match manager.purpose {
            SyncManagerPurpose::MailboxOut => 1,
            SyncManagerPurpose::MailboxIn => 2,
            SyncManagerPurpose::Outputs => 3,
            SyncManagerPurpose::Inputs => 4,
        };
        bytes.extend(manager.start_address.to_le_bytes());
        bytes.extend(length(&assigned, manager).to_le_bytes());
        let enable = bits(&[manager.enable, false, manager.is_virtual, manager.op_only]);
        bytes.extend([manager.control, 0, enable, purpose]);
    }
    bytes
}

/// Returns the length of a sync manager in bytes. If the description declares no default length, returns the total length of
/// the default PDOs of this sync manager, at most 65535.
fn length(assigned: &[(&Pdo, u8)], manager: &SyncManager) -> u16 {
    manager.default_size.unwrap_or_else(|| {
        let of_manager = assigned.iter().filter(|(_, number)| *number == manager.number);
        let bits = of_manager.fold(0, |bits: u32, (pdo, _)| bits.saturating_add(pdo.bits()));
        bits.div_ceil(8).try_into().unwrap_or(u16::MAX)
    })
}

/// Returns the content of the category "TxPDO" or "RxPDO", which lists the PDOs of this direction. Leaves out PDOs with more
/// than 255 entries. Each part of a split entry counts as an entry. `with_names` selects whether the entries have names.
pub(super) fn pdos(context: &mut Context<'_>, direction: Direction, with_names: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    for pdo in context.pdos().filter(|pdo| pdo.direction == direction) {
        let count = pdo.entries.iter().fold(0, |count: u32, entry| count.saturating_add(parts(entry).1));
        let Ok(count) = u8::try_from(count) else {
            context.notes.add(NoteKind::PdoEntries, Subject::Object(pdo.mapping_index));
            continue;
        };
        let long = pdo.entries.iter().filter(|entry| entry.bits > MAX_ENTRY).count();
        context.notes.add_many(NoteKind::SplitEntry, long, Subject::Object(pdo.mapping_index));
        bytes.extend(pdo.mapping_index.to_le_bytes());
        bytes.extend([count, pdo.sync_manager.unwrap_or(UNASSIGNED), 0]);
        bytes.push(context.texts.number(&pdo.name, &mut context.notes));
        bytes.extend(flags(pdo).to_le_bytes());
        for entry in &pdo.entries {
            let (length, count) = parts(entry);
            let name = context.texts.number(if with_names { &entry.name } else { "" }, &mut context.notes);
            let ty = type_code(context, entry.ty);
            for part in 0..count {
                let bits = length.min(entry.bits - part * length);
                bytes.extend(entry.index.to_le_bytes());
                bytes.extend([entry.sub_index, name, ty, bits as u8, 0, 0]);
            }
        }
    }
    bytes
}

/// Returns the maximum length in bits of the parts of an entry, and the number of parts. An entry has several parts if it
/// is too long for its length field.
fn parts(entry: &PdoEntry) -> (u32, u32) {
    match entry.bits {
        0..=MAX_ENTRY => (MAX_ENTRY, 1),
        bits => (PART, bits.div_ceil(PART)),
    }
}

fn flags(pdo: &Pdo) -> u16 {
    let flags = [
        (0x0001, pdo.mandatory),
        (0x0002, pdo.sync_manager.is_some()),
        (0x0004, pdo.oversampling.is_some()),
        (0x0010, pdo.fixed),
        (0x0020, pdo.is_virtual),
        (0x0200, pdo.depends_on_slot),
        (0x0400, pdo.depends_on_slot_group),
        (0x0800, pdo.overwritten_by_module),
    ];
    flags.iter().filter(|(_, is_set)| *is_set).fold(0, |all, (flag, _)| all | flag)
}

/// Returns the lowest number of a type in ETG.1000.6, or 0 if the type has no number below 256.
fn type_code(context: &Context<'_>, ty: Type) -> u8 {
    let without_length = without_length(types::basic(&context.device.types, ty));
    // A type can have several numbers. The lowest is the one that CiA 301 defines.
    let is_type = |code: &u8| type_name::by_code((*code).into()) == Some(Basic::Type(without_length));
    (1..=u8::MAX).find(is_type).unwrap_or(0)
}
