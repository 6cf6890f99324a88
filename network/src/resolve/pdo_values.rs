//! Reads PDOs from the values of a device's objects.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Span;

use crate::declared::{DeclaredNode, DeclaredPdo};
use crate::model::{communication_index, MappedObject, NetworkPdo, DISABLED};
use crate::syntax::At;
use crate::values::{Values, Write};

/// Returns the direction of a declared PDO.
pub(super) fn direction(declared: &DeclaredPdo) -> Direction {
    if declared.is_tpdo {
        Direction::Transmit
    } else {
        Direction::Receive
    }
}

/// Returns the PDOs of a node after its configuration.
pub(super) fn configured(node: &DeclaredNode, values: Values<'_>) -> Vec<NetworkPdo> {
    let mut pdos = pdos(values);
    for pdo in &mut pdos {
        let index = pdo.index();
        let of_pdo = |write: &&Write| [index, index + 0x200].contains(&write.object.0) && !write.span.is_empty();
        pdo.span = values.writes.iter().find(of_pdo).map_or(Span::MISSING, |write| write.span);
        let is_declared =
            |declared: &&DeclaredPdo| direction(declared) == pdo.direction && declared.number.value == pdo.number;
        if let Some(declared) = node.pdos.iter().find(is_declared) {
            pdo.span = declared.number.span;
            of_master(pdo, declared);
        }
        pdo.cob_id_at = values.set_at((index, 1)).or(pdo.span);
    }
    pdos
}

/// Sets the declared values of a PDO that its node does not contain. For an RPDO, these are the timers and the SYNC start
/// value of its sender. For a TPDO, this is the deadline of its receiver.
fn of_master(pdo: &mut NetworkPdo, declared: &DeclaredPdo) {
    fn number<T: Copy + Default>(declared: &Option<At<T>>) -> T {
        declared.as_ref().map_or(T::default(), |declared| declared.value)
    }
    match pdo.direction {
        Direction::Transmit => pdo.event_deadline = number(&declared.event_deadline),
        Direction::Receive => {
            pdo.inhibit_time = number(&declared.inhibit_time);
            pdo.event_timer = number(&declared.event_timer);
            pdo.sync_start = number(&declared.sync_start);
        }
    }
}

/// Returns all PDOs of a device: RPDOs, then TPDOs, each sorted by number.
pub(super) fn pdos(values: Values<'_>) -> Vec<NetworkPdo> {
    let of = |direction| (1..=512).filter_map(move |number| pdo(values, direction, number));
    [Direction::Receive, Direction::Transmit].into_iter().flat_map(of).collect()
}

/// Returns a PDO of a device. Returns `None` if the device does not have the PDO.
pub(super) fn pdo(values: Values<'_>, direction: Direction, number: u16) -> Option<NetworkPdo> {
    let index = communication_index(direction, number);
    values.device.object(index)?;
    let last = values.get((index, 0)).unwrap_or(i128::from(u8::MAX));
    let is_valid = |sub_index: u8| last >= sub_index.into() || values.is_set((index, sub_index));
    let value = |sub_index| values.get((index, sub_index)).filter(|_| is_valid(sub_index));
    let cob_id = value(1).map_or(DISABLED, |cob_id| cob_id as u32);
    let is_sender = direction == Direction::Transmit;
    let entries = mapping(values, index + 0x200);
    Some(NetworkPdo {
        direction,
        number,
        span: Span::MISSING,
        is_enabled: cob_id & DISABLED == 0 && !entries.is_empty(),
        cob_id,
        cob_id_at: Span::MISSING,
        transmission: value(2).unwrap_or(0) as u8,
        inhibit_time: value(3).filter(|_| is_sender).unwrap_or(0) as u16,
        event_timer: value(5).filter(|_| is_sender).unwrap_or(0) as u16,
        event_deadline: value(5).filter(|_| !is_sender).unwrap_or(0) as u16,
        sync_start: value(6).filter(|_| is_sender).unwrap_or(0) as u8,
        entries,
    })
}

/// Returns the kind of multiplexed PDO that a number of mapped objects represents, or `None` for other numbers (CiA 301 7.5.2.36).
fn multiplexed_name(count: u8) -> Option<&'static str> {
    match count {
        254 => Some("SAM-MPDO"),
        255 => Some("DAM-MPDO"),
        _ => None,
    }
}

/// Reports the enabled multiplexed PDOs of a node. The master does not exchange them, and the DBC does not contain them.
pub(super) fn report_multiplexed(
    node: &DeclaredNode,
    pdos: &[NetworkPdo],
    values: Values<'_>,
    diagnostics: &mut Diagnostics,
) {
    for pdo in pdos.iter().filter(|pdo| pdo.cob_id & DISABLED == 0 && pdo.entries.is_empty()) {
        let count = values.number((pdo.index() + 0x200, 0));
        let Some(name) = count.and_then(multiplexed_name) else { continue };
        let message = format!(
            "{} of `{}` is multiplexed ({name}), so Lexibus leaves it out of the network",
            pdo.title(),
            node.name.value
        );
        let found = Diagnostic::new(&codes::MULTIPLEXED_NETWORK_PDO, pdo.span.or(node.name.span), message);
        let kind = if pdo.direction == Direction::Transmit { "tpdo" } else { "rpdo" };
        let help = format!("declare `map` in `{kind}.{}`, or disable the PDO with `enabled = false`", pdo.number);
        diagnostics.push(found.help(help));
    }
}

fn mapping(values: Values<'_>, index: u16) -> Vec<MappedObject> {
    let count = values.number((index, 0)).filter(|count| multiplexed_name(*count).is_none()).unwrap_or(0);
    let words = (1..=count.min(64)).filter_map(|sub_index| values.number((index, sub_index)));
    words.filter(|word| *word != 0).map(MappedObject::of_word).collect()
}
