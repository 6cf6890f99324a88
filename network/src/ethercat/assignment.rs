//! The PDO assignment of a SubDevice.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::facts::pdo::title;
use lexibus_codegen::ir::{Device, Direction, ObjectBuses, Pdo, ProcessData, SyncManagerPurpose};
use lexibus_codegen::number::hex16;
use lexibus_codegen::source::Span;
use lexibus_codegen::text::similar;

use super::declared::DeclaredSubDevice;
use crate::declared::ObjectName;
use crate::syntax::At;

/// A PDO and the number of its sync manager.
pub(super) type Assigned<'d> = (&'d Pdo, u8);

const ETHERCAT: ObjectBuses = ObjectBuses { canopen: false, coe: true };

/// Returns the assigned PDOs with their sync managers. If the file chooses no PDOs, these are the default PDOs of the
/// description.
pub(super) fn assign<'d>(
    device: &'d Device,
    declared: &DeclaredSubDevice,
    diagnostics: &mut Diagnostics,
) -> Vec<Assigned<'d>> {
    match &declared.pdos {
        None => device.process_data.assigned_by_default().into_iter().filter(|(pdo, _)| is_assignable(pdo)).collect(),
        Some(pdos) => chosen(device, pdos, diagnostics),
    }
}

/// Returns whether a MainDevice can assign a PDO on EtherCAT.
fn is_assignable(pdo: &Pdo) -> bool {
    !pdo.is_virtual && pdo.buses.is_none_or(|buses| buses.coe)
}

/// Returns the PDOs that a MainDevice can assign.
pub(super) fn assignable(data: &ProcessData) -> impl Iterator<Item = &Pdo> {
    data.pdos.iter().filter(|pdo| is_assignable(pdo))
}

fn fault(span: Span, message: String) -> Diagnostic {
    Diagnostic::new(&codes::PDO_ASSIGNMENT, span, message)
}

fn chosen<'d>(device: &'d Device, names: &At<Vec<At<ObjectName>>>, diagnostics: &mut Diagnostics) -> Vec<Assigned<'d>> {
    let mut assigned: Vec<Assigned<'d>> = Vec::new();
    for name in &names.value {
        let checked = find(device, name).and_then(|pdo| {
            let sync_manager = combined(device, pdo, &assigned, name.span)?;
            Ok((pdo, sync_manager))
        });
        match checked {
            Ok(pdo) => assigned.push(pdo),
            Err(found) => diagnostics.push(*found),
        }
    }
    let is_missing = |pdo: &&Pdo| pdo.mandatory && assigned.iter().all(|(other, _)| !std::ptr::eq(*other, *pdo));
    // Otherwise, a rejected PDO could be reported again as missing.
    if assigned.len() == names.len() {
        for pdo in assignable(&device.process_data).filter(is_missing) {
            let message = format!("the mandatory {} is not assigned", shown(pdo));
            diagnostics.push(fault(names.span, message).help(format!("add \"{}\"", hex16(pdo.mapping_index))));
        }
    }
    assigned
}

/// Formats a PDO: ``RxPDO 0x1600 `Position mode` ``.
fn shown(pdo: &Pdo) -> String {
    match pdo.name.as_str() {
        "" => title(pdo, ETHERCAT),
        name => format!("{} `{name}`", title(pdo, ETHERCAT)),
    }
}

fn find<'d>(device: &'d Device, name: &At<ObjectName>) -> Result<&'d Pdo, Box<Diagnostic>> {
    let (found, text): (Vec<&Pdo>, String) = match &name.value {
        ObjectName::Address(index, _) => {
            (assignable(&device.process_data).filter(|pdo| pdo.mapping_index == *index).collect(), hex16(*index))
        }
        ObjectName::Name(text) => (
            assignable(&device.process_data).filter(|pdo| pdo.name.eq_ignore_ascii_case(text)).collect(),
            format!("`{text}`"),
        ),
    };
    match found[..] {
        [pdo] => Ok(pdo),
        [] => {
            let found = fault(name.span, format!("`{}` has no PDO {text}", device.name));
            let names = assignable(&device.process_data).map(|pdo| pdo.name.as_str()).filter(|name| !name.is_empty());
            let known =
                assignable(&device.process_data).map(|pdo| hex16(pdo.mapping_index)).take(8).collect::<Vec<_>>();
            Err(Box::new(match similar(text.trim_matches('`'), names) {
                Some(similar) => found.help(format!("write `{similar}`")),
                None if known.is_empty() => found.help("remove the PDO"),
                None => found.help(format!("use one of the PDOs {}", known.join(", "))),
            }))
        }
        ref several => {
            let indices: Vec<String> = several.iter().map(|pdo| hex16(pdo.mapping_index)).collect();
            let found = fault(name.span, format!("{text} is the name of {} PDOs", several.len()));
            Err(Box::new(found.help(format!("write the index of one PDO: {}", indices.join(", ")))))
        }
    }
}

/// Returns the sync manager of a PDO, or the reason why the PDO cannot be assigned.
fn combined(device: &Device, pdo: &Pdo, others: &[Assigned<'_>], span: Span) -> Result<u8, Box<Diagnostic>> {
    for (other, _) in others {
        if std::ptr::eq(*other, pdo) {
            return Err(Box::new(fault(span, format!("{} is assigned twice", shown(pdo))).help("remove one of them")));
        }
        if other.conflicts_with(pdo) {
            let message = format!("{} cannot be assigned together with {}", shown(pdo), shown(other));
            let label = "the description excludes this combination";
            return Err(Box::new(fault(span, message).label(label).help("remove one of them")));
        }
    }
    sync_manager(&device.process_data, pdo).ok_or_else(|| {
        Box::new(fault(span, format!("no sync manager can contain {}", shown(pdo))).help("remove the PDO"))
    })
}

/// Returns the default sync manager of a PDO, or `None` if the description lists only other sync managers. A PDO without a
/// default gets the first sync manager with its direction that it does not exclude. If the description lists no sync
/// managers, the PDO gets the sync manager of another PDO with the same direction, if there is one.
pub(super) fn sync_manager(data: &ProcessData, pdo: &Pdo) -> Option<u8> {
    if pdo.sync_manager.is_some() {
        return pdo.sync_manager.filter(|number| data.has_sync_manager(*number));
    }
    let is_allowed = |number: u8| !pdo.excluded_sync_managers.contains(&number);
    let mut managers = data.sync_managers.iter();
    let listed =
        managers.find(|manager| direction(manager.purpose) == Some(pdo.direction) && is_allowed(manager.number));
    let of_others =
        || assignable(data).filter(|other| other.direction == pdo.direction).find_map(|other| other.sync_manager);
    match listed {
        Some(manager) => Some(manager.number),
        None if data.sync_managers.is_empty() => of_others(),
        None => None,
    }
}

/// Returns the direction of process data; `None` for a mailbox.
pub(super) fn direction(purpose: SyncManagerPurpose) -> Option<Direction> {
    match purpose {
        SyncManagerPurpose::Outputs => Some(Direction::Receive),
        SyncManagerPurpose::Inputs => Some(Direction::Transmit),
        SyncManagerPurpose::MailboxOut | SyncManagerPurpose::MailboxIn => None,
    }
}
