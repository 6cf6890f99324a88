//! Procedures: contradictions between steps and the facts of their items, wrong PDO assignments, and COB-IDs that other PDOs have
//! by default.

use std::collections::{BTreeMap, BTreeSet};

use super::context::Context;
use super::limits::beyond;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::{reserved, Owner};
use crate::ir::{stated, Device, Item, ItemRef, Procedure, Step, Value};
use crate::number::{hex, hex16};
use crate::source::Span;
use crate::text::brief;

/// Objects that assign PDOs to sync managers 2 and 3.
const ASSIGNMENTS: [u16; 2] = [0x1C12, 0x1C13];

/// Reports steps that contradict the facts of their items, wrong PDO assignments, and COB-IDs that a procedure writes
/// although another PDO has them by default.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Context { device, owner, .. } = context;
    for procedure in &device.procedures {
        for (step, span) in procedure.spanned() {
            for problem in problems(*owner, device, step) {
                diagnostics
                    .push(codes::STEP_IMPOSSIBLE.at(span, format!("a step of `{}` {problem}", brief(&procedure.name))));
            }
        }
        assignments(device, procedure, diagnostics);
    }
}

/// Reports PDOs that are assigned by default, but are not described.
pub(super) fn default_assignments(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for item in context.owner.items() {
        if let (Some((0x1C12 | 0x1C13, 1..)), Some(value)) = (item.object(), item.default_integer()) {
            assigned(context.device, value, item.at.default.or(item.origin.span), diagnostics);
        }
    }
}

/// Returns the problems in a step of a procedure.
fn problems(owner: Owner<'_>, device: &Device, step: &Step) -> Vec<String> {
    let read_only = |name: &ItemRef| {
        let unwritable = device.referred(name).is_some_and(|item| !item.access.writable());
        unwritable.then(|| format!("writes `{}`, which cannot be written", brief(name)))
    };
    let write_only = |name: &ItemRef, what: &str| {
        let unreadable = device.referred(name).is_some_and(|item| !item.access.readable());
        unreadable.then(|| format!("{what} `{}`, which cannot be read", brief(name)))
    };
    let outside = |name: &str, mask: u64, value: &Value| {
        let outside = value.as_int().is_some_and(|value| mask != u64::MAX && value & !i128::from(mask) != 0);
        outside.then(|| {
            let (name, mask) = (brief(name), hex(mask));
            format!(
                "has the value {value} for `{name}` with the mask {mask}, but {value} has bits outside of this mask"
            )
        })
    };
    match step {
        Step::Write(name, value) => {
            let item = device.referred(name);
            let why = item.zip(value.as_int()).and_then(|(item, number)| refused(owner, item, number));
            let why = why.map(|why| format!("writes {} to `{}`, {why}", shown(item, value), brief(name)));
            read_only(name).into_iter().chain(why).collect()
        }
        Step::WriteBits(name, mask, value) => read_only(name).into_iter().chain(outside(name, *mask, value)).collect(),
        Step::WriteArgument(name, _) => read_only(name).into_iter().collect(),
        Step::Read(name) => write_only(name, "reads").into_iter().collect(),
        Step::WaitFor(name, mask, value, _) => {
            outside(name, *mask, value).into_iter().chain(write_only(name, "waits for")).collect()
        }
        Step::Delay(_) | Step::Send(_) | Step::Exchange(_) | Step::Manual(_) => Vec::new(),
    }
}

/// Returns the value of a step as text. Numbers above 0xFFFF, and entries of PDO mappings and
/// assignments above 0xFF, are hexadecimal.
fn shown(item: Option<&Item>, value: &Value) -> String {
    let object = item.and_then(Item::object);
    let is_entry = matches!(object, Some((0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C12 | 0x1C13, 1..)));
    match value {
        Value::Int(number) if *number > 0xFFFF || (is_entry && *number > 0xFF) => hex(*number),
        _ => value.to_string(),
    }
}

/// Returns the reason why `number` is not a valid value of an item, or `None` if it is valid.
fn refused(owner: Owner<'_>, item: &Item, number: i128) -> Option<String> {
    let ty = owner.basic(item.ty);
    // Manuals often print negative numbers as bit patterns, such as 0xFFFF for -1.
    let signed = ty.bits().filter(|&bits| ty.is_signed() && bits <= 64 && number >> (bits - 1) == 1);
    let number = signed.map_or(number, |bits| number - (1i128 << bits));
    if ty.integer_range().is_some_and(|(low, high)| number < low || number > high) {
        return Some(format!("but the type {ty} of this item cannot hold the value"));
    }
    let (low, high) = item.limits.integers();
    let are_ordered = low.zip(high).is_none_or(|(low, high)| low <= high);
    if let Some(limit) = beyond(item, number).filter(|_| are_ordered) {
        return Some(format!("whose {limit}"));
    }
    let writable = stated::behavior(item).into_iter().flat_map(|behavior| &behavior.writable_values);
    let writable: Vec<i128> = writable.filter_map(Value::as_int).collect();
    if !writable.is_empty() && !writable.contains(&number) {
        return Some("but this value is not one of the writable values".to_owned());
    }
    let (labels, closed) = stated::enumeration(owner, item)?;
    match reserved(labels, number) {
        None => closed.then(|| "but this value has no name".to_owned()),
        Some(is_reserved) => is_reserved.then(|| "but this value is reserved".to_owned()),
    }
}

/// Reports PDOs that a procedure maps but does not assign, and PDOs that it assigns although the source does not
/// describe them. Also reports COB-IDs that a procedure writes to a PDO although another PDO has them by default.
fn assignments(device: &Device, procedure: &Procedure, diagnostics: &mut Diagnostics) {
    let (mut mapped, mut assigned_to) = (BTreeMap::new(), [BTreeSet::new(), BTreeSet::new()]);
    let name = brief(&procedure.name);
    for (step, span) in procedure.spanned() {
        let Step::Write(item, value) = step else { continue };
        let (Some(object), Some(value)) = (device.referred(item).and_then(Item::object), value.as_int()) else {
            continue;
        };
        match object {
            (index @ (0x1600..=0x17FF | 0x1A00..=0x1BFF), 1..) => _ = mapped.entry(index).or_insert(span),
            (index @ (0x1C12 | 0x1C13), 1..) => {
                assigned_to[usize::from(index - ASSIGNMENTS[0])].insert(value);
                assigned(device, value, span, diagnostics);
            }
            (index @ (0x1400..=0x15FF | 0x1800..=0x19FF), 1) => {
                if let Some(other) = owner_of_cob_id(device, index, value) {
                    let (cob_id, index, other) = (hex(value), hex16(index), hex16(other));
                    let message = format!(
                        "the procedure `{name}` writes the COB-ID {cob_id} to {index}, but {other} already has this COB-ID"
                    );
                    diagnostics.push(codes::STEP_IMPOSSIBLE.at(span, message));
                }
            }
            _ => {}
        }
    }
    for (index, span) in mapped {
        let assigned = &assigned_to[usize::from(index >= 0x1A00)];
        if !assigned.is_empty() && !assigned.contains(&i128::from(index)) {
            let message = format!("the procedure `{name}` maps the PDO {}, but assigns other PDOs", hex16(index));
            diagnostics.push(codes::MAPPED_NOT_ASSIGNED.at(span, message));
        }
    }
}

fn assigned(device: &Device, value: i128, span: Span, diagnostics: &mut Diagnostics) {
    let described = |index: u16| {
        device.object(index).is_some() || device.process_data.pdos.iter().any(|pdo| pdo.mapping_index == index)
    };
    if value != 0 && !u16::try_from(value).is_ok_and(described) {
        let message = format!("the PDO {} is assigned, but not described", hex16(value));
        diagnostics.push(codes::ASSIGNED_PDO_MISSING.at(span, message));
    }
}

/// Returns the index of the communication parameters of the first PDO that has this COB-ID by default, for at least one
/// node-ID.
/// Returns `None` if there is no such PDO, or if the PDO at `index` can have this COB-ID by default.
fn owner_of_cob_id(device: &Device, index: u16, value: i128) -> Option<u16> {
    let is_of_some_node = |item: &Item| match item.default {
        Some(Value::NodeId(base)) => value.checked_sub(base).is_some_and(|node| (1..=127).contains(&node)),
        Some(Value::Int(default)) => default == value,
        _ => false,
    };
    let is_communication = |index: u16| matches!(index, 0x1400..=0x15FF | 0x1800..=0x19FF);
    let pdos = device.groups.iter().filter_map(|group| Some((group.index()?, group.sub(1)?)));
    let owners = pdos.filter(|(index, item)| is_communication(*index) && is_of_some_node(item));
    let owners: Vec<u16> = owners.map(|(index, _)| index).collect();
    owners.first().copied().filter(|_| !owners.contains(&index))
}
