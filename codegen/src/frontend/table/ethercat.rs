//! Reads the EtherCAT settings of a table, except objects and PDOs: mailbox protocols and sync managers.

use super::at::{At, FlagOr};
use super::format::{CoeTable, EtherCatTable, SyncManagerTable};
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Bus, Buses, Coe, Device, Mailbox, Protocol, SyncManager, SyncManagerPurpose};

/// Words for the key `purpose`.
const PURPOSES: [(&str, SyncManagerPurpose); 4] = [
    ("mailbox_out", SyncManagerPurpose::MailboxOut),
    ("mailbox_in", SyncManagerPurpose::MailboxIn),
    ("outputs", SyncManagerPurpose::Outputs),
    ("inputs", SyncManagerPurpose::Inputs),
];

/// Reads the table `[ethercat]`.
pub(super) fn settings(reader: &mut Reader<'_, '_>, table: &At<EtherCatTable>, buses: Buses, device: &mut Device) {
    let settings_table = &table.value;
    if !buses.contains(Bus::EtherCat) {
        let found = codes::TABLE_VALUE.at(reader.span(table), "`buses` of the device does not contain EtherCAT");
        reader.diagnostics.push(found.help("add the bus to `buses` of `[device]`, or delete the table"));
        return;
    }
    let settings = device.ethercat.get_or_insert_with(Box::default);
    settings.mailbox = mailbox(settings_table).map(Box::new);
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(settings_table, origin));
    for given in &settings_table.sync_managers {
        let manager = sync_manager(reader, given, device);
        device.process_data.sync_managers.extend(manager);
    }
    device.process_data.sync_managers.sort_by_key(|manager| manager.number);
}

fn mailbox(table: &EtherCatTable) -> Option<Mailbox> {
    let coe = match &table.coe {
        Some(FlagOr::Table(table)) => Some(coe(table)),
        Some(FlagOr::Flag(true)) => Some(Coe::default()),
        Some(FlagOr::Flag(false)) | None => None,
    };
    let plain = |is_there: bool| is_there.then(Protocol::default);
    let mailbox = Mailbox {
        coe,
        aoe: plain(table.aoe),
        eoe: plain(table.eoe),
        foe: plain(table.foe),
        soe: plain(table.soe),
        voe: plain(table.voe),
        ..Mailbox::default()
    };
    (mailbox != Mailbox::default()).then_some(mailbox)
}

fn coe(table: &CoeTable) -> Coe {
    Coe {
        sdo_info: table.sdo_info,
        pdo_assign: table.pdo_assign,
        pdo_config: table.pdo_config,
        pdo_upload: table.pdo_upload,
        complete_access: table.complete_access,
        segmented_sdo: table.segmented_sdo,
        ..Coe::default()
    }
}

fn sync_manager(reader: &mut Reader<'_, '_>, given: &At<SyncManagerTable>, device: &mut Device) -> Option<SyncManager> {
    let manager = &given.value;
    let origin = reader.origin(given);
    device.doubts.extend(reader.doubts_of(manager, origin));
    let purpose = manager.purpose.as_ref().and_then(|word| reader.word(word, "purpose of a sync manager", &PURPOSES));
    let (Some(number), Some(start_address), Some(purpose)) = (manager.number, manager.start, purpose) else {
        let message = "a sync manager needs a `number`, a `start` and a `purpose`";
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        return None;
    };
    if device.process_data.sync_managers.iter().any(|other| other.number == number) {
        let message = format!("two sync managers have the number {number}");
        reader.report(&codes::TABLE_DUPLICATE, reader.span(given), message);
        return None;
    }
    if manager.size.zip(manager.max).is_some_and(|(size, max)| size > max) {
        let message = format!("the default size of sync manager {number} exceeds its maximum size");
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
    }
    Some(SyncManager {
        number,
        purpose,
        label: purpose.label().into(),
        start_address,
        default_size: manager.size,
        size_range: (manager.min, manager.max),
        control: manager.control.unwrap_or(0),
        enable: true,
        op_only: false,
        is_virtual: false,
        origin,
    })
}
