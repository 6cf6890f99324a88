//! Addresses of items on each bus.

use super::register;
use super::words::bus_name;
use crate::ir::{Binding, Item, ModbusTable, ObjectBuses, RegisterBinding, RegisterSpace};
use crate::number::{self, hex16};

/// An address of an item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Bus or buses on which the item has this address. For an address that is not specific to a bus, the kind of address, such as
    /// `Window`.
    pub bus: &'static str,
    /// Short form of the address, as the source prints it.
    pub number: String,
    /// Search terms: printed address and wire address. The text is empty for indirect access.
    pub lookup: String,
    /// Complete form of the address, with all facts about the address.
    pub text: String,
}

/// Returns the addresses of an item, in the order of its bindings. `tables` contains the requests that the device
/// accepts on Modbus.
pub fn addresses(item: &Item, tables: &[ModbusTable]) -> Vec<Address> {
    item.bindings.iter().map(|binding| address(binding, item, tables)).collect()
}

fn address(binding: &Binding, item: &Item, tables: &[ModbusTable]) -> Address {
    let text = match binding {
        Binding::Register(register) => return register_address(register, item, tables),
        Binding::Record { index, bit_offset, bits } => {
            format!("record {}, {}", hex16(*index), bits_of(*bit_offset, *bits))
        }
        Binding::EscMemory { address, length } => format!("{}, {length} bytes", hex16(*address)),
        Binding::Indirect(window) => {
            let buses: Vec<&str> = window.buses.iter().map(bus_name).collect();
            format!("{} on {}", number(binding), buses.join(", "))
        }
        Binding::Image(image) => format!("{}, {}", image.image, bits_of(image.bit_offset, image.bits)),
        Binding::Object { .. } | Binding::Parameter(_) | Binding::Ascii(_) => number(binding),
    };
    // Indirect access adds no search term: the window uses the number of a register or parameter, which is already a search term.
    let lookup = if matches!(binding, Binding::Indirect(_)) { String::new() } else { text.clone() };
    Address { bus: bus(binding), number: text.clone(), lookup, text }
}

fn register_address(register: &RegisterBinding, item: &Item, tables: &[ModbusTable]) -> Address {
    let number = format!("{} {}", table(register.space), register::printed(register));
    let is_wire = register::printed(register) == register::wire(register);
    let wire = if is_wire { String::new() } else { format!(" (wire {})", register::wire(register)) };
    let text = register::text(register, item, tables);
    Address { bus: "Modbus", lookup: format!("{number}{wire}"), number, text }
}

/// Returns the name of an element of a Modbus table.
pub fn table(space: RegisterSpace) -> &'static str {
    match space {
        RegisterSpace::Coil => "coil",
        RegisterSpace::DiscreteInput => "discrete input",
        RegisterSpace::Input => "input register",
        RegisterSpace::Holding => "register",
    }
}

/// Returns the short form of an address, with the wire address of a register: `0x6040:00`, `register 101.3`, `record
/// 0x0001 bit 8`.
pub fn number(binding: &Binding) -> String {
    match binding {
        Binding::Object { index, sub_index, .. } => number::object(*index, *sub_index),
        Binding::Register(register) => {
            let bit = register.bit_offset.map(|bit| format!(".{bit}")).unwrap_or_default();
            format!("{} {}{bit}", table(register.space), register::wire_address(register.address))
        }
        Binding::Record { index, bit_offset, .. } => format!("record {} bit {bit_offset}", hex16(*index)),
        Binding::Image(image) => format!("{} bit {}", image.image, image.bit_offset),
        Binding::Parameter(parameter) => format!("{} {}", parameter.space, hex16(parameter.code)),
        Binding::Ascii(name) => name.to_string(),
        Binding::EscMemory { address, .. } => format!("memory {}", hex16(*address)),
        Binding::Indirect(window) => format!("{} {}", window.space, hex16(window.number)),
    }
}

/// Returns the bus or buses of an address. For an address that is not specific to a bus, returns the kind of address.
pub fn bus(binding: &Binding) -> &'static str {
    match binding {
        Binding::Object { buses, .. } => object_bus(*buses),
        Binding::Register(_) => "Modbus",
        Binding::Record { .. } => "PROFINET",
        Binding::Image(_) => "Process image",
        Binding::Parameter(_) => "Serial",
        Binding::Ascii(_) => "ASCII",
        Binding::EscMemory { .. } => "Slave controller",
        Binding::Indirect(_) => "Window",
    }
}

/// Returns the buses of an object.
pub fn object_bus(buses: ObjectBuses) -> &'static str {
    match (buses.canopen, buses.coe) {
        (true, true) => "CANopen, EtherCAT",
        (false, true) => "EtherCAT",
        _ => "CANopen",
    }
}

/// Returns a range of bits: `byte 3`, `byte 3 bit 4`, `bytes 2–5`.
pub fn bits_of(first: u32, bits: u32) -> String {
    let last = first.saturating_add(bits.max(1) - 1);
    let (byte, last_byte) = (first / 8, last / 8);
    if first.is_multiple_of(8) && bits.is_multiple_of(8) {
        return if byte == last_byte { format!("byte {byte}") } else { format!("bytes {byte}–{last_byte}") };
    }
    match (byte == last_byte, bits) {
        (true, 1) => format!("byte {byte} bit {}", first % 8),
        (true, _) => format!("byte {byte} bits {}–{}", last % 8, first % 8),
        (false, _) => format!("bits {first}–{last}"),
    }
}
