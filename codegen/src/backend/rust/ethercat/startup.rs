//! Generates a constant with the SDO writes that configure the default PDO assignment and the mapping of the assigned
//! PDOs. At run time, the method `Assignment::commands` returns the writes for any assignment.

use super::Assigned;
use crate::backend::rust::code::Doc;
use crate::backend::rust::literal;
use crate::backend::rust::pdo;
use crate::ir::{Device, EtherCatSettings, SyncManager, SyncManagerPurpose, MAX_PDO_SUBS};
use crate::number::hex16;

/// Index of the object that assigns PDOs to sync manager 0 (ETG.1000.6 5.6.7.4).
const ASSIGN: u16 = 0x1C10;

pub(super) fn commands(device: &Device, settings: &EtherCatSettings, assigned: &[Assigned<'_>]) -> Vec<Doc> {
    let Some(coe) = settings.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref()) else { return Vec::new() };
    // The PDO assignment of a modular device depends on the modules in its slots, so the constant cannot contain it.
    if assigned.is_empty() || settings.slots.is_some() {
        return Vec::new();
    }
    let of = |number: u8| {
        assigned.iter().filter(move |(_, sync_manager)| *sync_manager == number).map(|(pdo, _)| pdo.mapping_index)
    };
    // More than `MAX_PDO_SUBS` PDOs do not fit into the sub-indices of an assignment object.
    if device.process_data.sync_managers.iter().any(|manager| of(manager.number).count() > MAX_PDO_SUBS) {
        return Vec::new();
    }
    let mut commands = Vec::new();
    let carries =
        |manager: &&SyncManager| matches!(manager.purpose, SyncManagerPurpose::Outputs | SyncManagerPurpose::Inputs);
    let managers: Vec<&SyncManager> =
        device.process_data.sync_managers.iter().filter(carries).filter(|_| coe.pdo_assign).collect();
    commands.extend(managers.iter().map(|manager| write("u8", ASSIGN + u16::from(manager.number), 0, "0")));
    for (pdo, _) in assigned.iter().filter(|_| coe.pdo_config) {
        let fits = pdo.entries.len() <= MAX_PDO_SUBS && pdo.entries.iter().all(|entry| entry.bits <= 255);
        if pdo.fixed || !fits || !pdo.is_mapping_known() {
            continue;
        }
        commands.push(write("u8", pdo.mapping_index, 0, "0"));
        for (entry, sub) in pdo.entries.iter().zip(1..=u8::MAX) {
            let word = u32::from(entry.index) << 16 | u32::from(entry.sub_index) << 8 | entry.bits;
            commands.push(write("u32", pdo.mapping_index, sub, &literal::word(word)));
        }
        commands.push(write("u8", pdo.mapping_index, 0, &pdo.entries.len().to_string()));
    }
    for manager in managers {
        let object = ASSIGN + u16::from(manager.number);
        let list: Vec<u16> = of(manager.number).collect();
        let entries = list.iter().zip(1..=u8::MAX);
        commands.extend(entries.map(|(index, sub)| write("u16", object, sub, &hex16(*index))));
        if !list.is_empty() {
            commands.push(write("u8", object, 0, &list.len().to_string()));
        }
    }
    commands
}

fn write(ty: &str, index: u16, sub: u8, value: &str) -> Doc {
    Doc::from(pdo::write(ty, index, sub, value))
}
