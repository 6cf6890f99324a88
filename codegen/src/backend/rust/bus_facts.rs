//! What a master has to know of a device on Modbus, and of the numbers that nodes may have: constants.

use crate::ir::{Device, ModbusTable, RegisterSpace};

/// A constant, ready to be written.
pub(super) struct FactModel {
    pub docs: String,
    pub code: String,
}

/// The names of these constants, as modules name things.
pub(super) const RESERVED: [&str; 13] = [
    "node_ids",
    "holding_functions",
    "holding_max_read",
    "holding_max_write",
    "input_functions",
    "input_max_read",
    "input_max_write",
    "coil_functions",
    "coil_max_read",
    "coil_max_write",
    "discrete_functions",
    "discrete_max_read",
    "discrete_max_write",
];

pub(super) fn models(device: &Device) -> Vec<FactModel> {
    let mut facts = Vec::new();
    if let Some((first, last)) = device.node_ids {
        facts.push(FactModel {
            docs: "The numbers that a node may have.".to_owned(),
            code: format!("pub const NODE_IDS: core::ops::RangeInclusive<u8> = {first}..={last};"),
        });
    }
    for table in &device.modbus {
        of_table(table, &mut facts);
    }
    facts
}

fn of_table(table: &ModbusTable, facts: &mut Vec<FactModel>) {
    let (name, what) = match table.space {
        RegisterSpace::Holding => ("HOLDING", "holding registers"),
        RegisterSpace::Input => ("INPUT", "input registers"),
        RegisterSpace::Coil => ("COIL", "coils"),
        RegisterSpace::DiscreteInput => ("DISCRETE", "discrete inputs"),
    };
    if !table.functions.is_empty() {
        let list: Vec<String> = table.functions.iter().map(u8::to_string).collect();
        facts.push(FactModel {
            docs: format!("The functions of Modbus that {what} take."),
            code: format!("pub const {name}_FUNCTIONS: &[u8] = &[«{}»];", list.join("¦ ")),
        });
    }
    for (limit, key, verb) in [(table.max_read, "READ", "reads"), (table.max_write, "WRITE", "writes")] {
        facts.extend(limit.map(|limit| FactModel {
            docs: format!("The greatest number of {what} that one request {verb}."),
            code: format!("pub const {name}_MAX_{key}: u16 = {limit};"),
        }));
    }
}
