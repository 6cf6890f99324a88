//! What a master has to know of a device on Modbus, and of the numbers that nodes may have: constants.

use std::collections::BTreeMap;

use super::code::{seq, Data, Doc};
use crate::ir::{Availability, Binding, Device, Item, ModbusTable, RegisterBinding, RegisterSpace};

/// A constant, ready to be written.
pub(super) struct FactModel {
    pub docs: String,
    pub code: Doc,
}

/// The names of these constants, as modules name things.
pub(super) const RESERVED: [&str; 2] = ["node_ids", "modbus"];

pub(super) fn models(device: &Device) -> Vec<FactModel> {
    let mut facts = Vec::new();
    if let Some((first, last)) = device.node_ids {
        facts.push(FactModel {
            docs: "The numbers that a node may have.".to_owned(),
            code: seq!["pub const NODE_IDS: core::ops::RangeInclusive<u8> = ", first, "..=", last, ";"],
        });
    }
    facts.extend(modbus(device));
    facts
}

/// The tables of Modbus: field and constant of the runtime, and how much Modbus itself reads and writes at once.
const TABLES: [(RegisterSpace, &str, &str, u16, u16); 4] = [
    (RegisterSpace::Holding, "holding", "rt::modbus::TableLimits::HOLDING", 125, 123),
    (RegisterSpace::Input, "input", "rt::modbus::TableLimits::INPUT", 125, 0),
    (RegisterSpace::Coil, "coil", "rt::modbus::TableLimits::COIL", 2000, 1968),
    (RegisterSpace::DiscreteInput, "discrete", "rt::modbus::TableLimits::DISCRETE", 2000, 0),
];

/// `MODBUS`, of a device that has registers.
fn modbus(device: &Device) -> Option<FactModel> {
    let has_registers = items(device).any(|item| registers(item).next().is_some());
    if !has_registers && device.modbus.is_empty() {
        return None;
    }
    let table = |(space, field, standard, max_read, max_write)| {
        let own = device.modbus.iter().find(|own| own.space == space);
        let spans = spans(device, space, max_read);
        let data = match (own, spans.is_empty()) {
            (None, true) => Doc::from(standard),
            _ => limits(own, (max_read, max_write), spans),
        };
        (field, data)
    };
    let data = Data::fields("rt::modbus::Limits", TABLES.map(table));
    Some(FactModel {
        docs: "Which requests the device takes on Modbus, and which registers can be read together.".to_owned(),
        code: seq!["pub const MODBUS: rt::modbus::Limits = ", data, ";"],
    })
}

fn limits(own: Option<&ModbusTable>, (max_read, max_write): (u16, u16), spans: Vec<Doc>) -> Doc {
    let functions = own.map_or(&[][..], |own| &own.functions);
    let number = |given: Option<u16>, standard: u16| Doc::from(given.unwrap_or(standard).to_string());
    Data::fields(
        "rt::modbus::TableLimits",
        vec![
            ("functions", Data::slice(functions.iter().map(|own| Doc::from(own.to_string())))),
            ("max_read", number(own.and_then(|own| own.max_read), max_read)),
            ("max_write", number(own.and_then(|own| own.max_write), max_write)),
            ("split", Doc::from((own.is_some_and(|own| own.split)).to_string())),
            ("readable", Data::slice(spans)),
        ],
    )
}

/// The addresses of a table that can be read along with their neighbours. What is longer than Modbus reads at once never is.
fn spans(device: &Device, space: RegisterSpace, longest: u16) -> Vec<Doc> {
    let mut addresses: BTreeMap<u16, Option<u8>> = BTreeMap::new();
    let all = items(device).flat_map(|item| registers(item).map(move |own| (item, own)));
    for (item, register) in all.filter(|(_, own)| own.space == space && own.count <= longest) {
        let kind = is_read_along(item).then_some(register.words_per_address);
        for address in register.address..=register.last() {
            // What one item forbids, another one of the same address doesn't allow.
            let known = addresses.entry(address).or_insert(kind);
            *known = known.filter(|_| *known == kind);
        }
    }
    let mut spans: Vec<(u16, u16, u8)> = Vec::new();
    for (address, kind) in addresses.into_iter().filter_map(|(address, kind)| Some((address, kind?))) {
        match spans.last_mut() {
            Some((_, last, own)) if *own == kind && last.checked_add(1) == Some(address) => *last = address,
            _ => spans.push((address, address, kind)),
        }
    }
    spans.into_iter().map(span).collect()
}

fn span((first, last, words): (u16, u16, u8)) -> Doc {
    match words {
        1 => Data::call("rt::modbus::Span::new", vec![Doc::from(first.to_string()), Doc::from(last.to_string())]),
        _ => Doc::from(format!("rt::modbus::Span::new({first}, {last}).words_per_address({words})")),
    }
}

/// Whether reading the item unasked does no harm: every device has it, at any time, and nothing happens.
fn is_read_along(item: &Item) -> bool {
    /// ObjFlags of CiA 306: not to be read on a scan.
    const REFUSES_SCAN: u32 = 2;
    let is_everywhere = |own: &Availability| {
        own.models.is_empty() && own.options.is_empty() && own.since.is_none() && own.until.is_none()
    };
    item.access.readable()
        && item.flags & REFUSES_SCAN == 0
        && item.availability.as_deref().is_none_or(is_everywhere)
        && item.behaviour.as_deref().is_none_or(|own| own.side_effects.is_empty() && own.read_states.is_empty())
}

fn items(device: &Device) -> impl Iterator<Item = &Item> {
    device.groups.iter().flat_map(|group| &group.items)
}

fn registers(item: &Item) -> impl Iterator<Item = &RegisterBinding> {
    item.bindings.iter().filter_map(|binding| match binding {
        Binding::Register(own) => Some(&**own),
        _ => None,
    })
}
