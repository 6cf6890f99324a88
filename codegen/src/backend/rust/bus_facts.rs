//! Constants for facts about the buses: Modbus limits and the node-ID range.

use std::collections::BTreeMap;

use super::code::{seq, Data, Declaration, Doc};
use crate::ir::{Availability, Binding, Device, Item, ModbusTable, RegisterBinding, RegisterSpace};

/// Names of the bus constants in lower case. Other constants of the module must not have these names.
pub(super) const RESERVED: [&str; 2] = ["node_ids", "modbus"];

pub(super) fn models(device: &Device) -> impl Iterator<Item = Declaration> {
    let node_ids = device.node_ids.map(|(first, last)| {
        let start = "const NODE_IDS: core::ops::RangeInclusive<u8>";
        Declaration::new(["Node-ID range of the device."], start, seq![first, "..=", last])
    });
    node_ids.into_iter().chain(modbus(device))
}

/// For each Modbus table: its field in `rt::modbus::Limits`, the constant with its standard limits, and the maximum
/// numbers of values per read request and per write request.
const TABLES: [(RegisterSpace, &str, &str, u16, u16); 4] = [
    (RegisterSpace::Holding, "holding", "rt::modbus::TableLimits::HOLDING", 125, 123),
    (RegisterSpace::Input, "input", "rt::modbus::TableLimits::INPUT", 125, 0),
    (RegisterSpace::Coil, "coil", "rt::modbus::TableLimits::COIL", 2000, 1968),
    (RegisterSpace::DiscreteInput, "discrete", "rt::modbus::TableLimits::DISCRETE", 2000, 0),
];

/// Returns the constant `MODBUS`. Returns `None` if the device has no registers and declares no Modbus limits.
fn modbus(device: &Device) -> Option<Declaration> {
    let has_registers = items(device).any(|item| registers(item).next().is_some());
    if !has_registers && device.modbus.is_empty() {
        return None;
    }
    let table = |(space, field, standard, max_read, max_write)| {
        let stated = device.modbus.iter().find(|stated| stated.space == space);
        let spans = spans(device, space, max_read);
        let data = match (stated, spans.is_empty()) {
            (None, true) => Doc::from(standard),
            _ => limits(stated, max_read, max_write, spans),
        };
        (field, data)
    };
    let data = Data::fields("rt::modbus::Limits", TABLES.map(table));
    let docs = "Modbus requests that the device supports, and the registers that one request can read together.";
    Some(Declaration::new([docs], "const MODBUS: rt::modbus::Limits", data))
}

fn limits(stated: Option<&ModbusTable>, max_read: u16, max_write: u16, spans: Vec<Doc>) -> Doc {
    let functions = stated.map_or(&[][..], |table| &table.functions);
    let number = |value: Option<u16>, standard: u16| Doc::from(value.unwrap_or(standard).to_string());
    Data::fields(
        "rt::modbus::TableLimits",
        vec![
            ("functions", Data::slice(functions.iter().map(|function| Doc::from(function.to_string())))),
            ("max_read", number(stated.and_then(|table| table.max_read), max_read)),
            ("max_write", number(stated.and_then(|table| table.max_write), max_write)),
            ("split", Doc::from((stated.is_some_and(|table| table.split)).to_string())),
            ("readable", Data::slice(spans)),
        ],
    )
}

/// Returns the address ranges of a Modbus table that a read request for other items may include. Values that are too
/// long for one read request are excluded.
fn spans(device: &Device, space: RegisterSpace, longest: u16) -> Vec<Doc> {
    let mut addresses: BTreeMap<u16, Option<u8>> = BTreeMap::new();
    let all = items(device).flat_map(|item| registers(item).map(move |register| (item, register)));
    for (item, register) in all.filter(|(_, register)| register.space == space && register.count <= longest) {
        let word_count = is_read_along(item).then_some(register.words_per_address);
        for address in register.address..=register.last() {
            // An address can be read together with others only if all items at the address allow it. These items must
            // also have the same number of words per address.
            let known = addresses.entry(address).or_insert(word_count);
            *known = known.filter(|_| *known == word_count);
        }
    }
    let mut spans: Vec<(u16, u16, u8)> = Vec::new();
    for (address, word_count) in addresses.into_iter().filter_map(|(address, word_count)| Some((address, word_count?)))
    {
        match spans.last_mut() {
            Some((_, last, span_words)) if *span_words == word_count && last.checked_add(1) == Some(address) => {
                *last = address
            }
            _ => spans.push((address, address, word_count)),
        }
    }
    spans.into_iter().map(span).collect()
}

fn span(span: (u16, u16, u8)) -> Doc {
    let (first, last, words) = span;
    match words {
        1 => Data::call("rt::modbus::Span::new", vec![Doc::from(first.to_string()), Doc::from(last.to_string())]),
        _ => Doc::from(format!("rt::modbus::Span::new({first}, {last}).words_per_address({words})")),
    }
}

/// Returns whether a read request for other items may include this item. The item must exist on all models and firmware
/// versions and with all options. It must be readable in all states and have no side effects. Its flags must not
/// exclude it from scans.
fn is_read_along(item: &Item) -> bool {
    /// Flag in ObjFlags (CiA 306): do not read the object during a scan.
    const REFUSES_SCAN: u32 = 2;
    let is_everywhere = |availability: &Availability| {
        availability.models.is_empty()
            && availability.options.is_empty()
            && availability.since.is_none()
            && availability.until.is_none()
    };
    item.access.readable()
        && item.flags & REFUSES_SCAN == 0
        && item.availability.as_deref().is_none_or(is_everywhere)
        && item
            .behavior
            .as_deref()
            .is_none_or(|behavior| behavior.side_effects.is_empty() && behavior.read_states.is_empty())
}

fn items(device: &Device) -> impl Iterator<Item = &Item> {
    device.groups.iter().flat_map(|group| &group.items)
}

fn registers(item: &Item) -> impl Iterator<Item = &RegisterBinding> {
    item.bindings.iter().filter_map(|binding| match binding {
        Binding::Register(register) => Some(&**register),
        _ => None,
    })
}
