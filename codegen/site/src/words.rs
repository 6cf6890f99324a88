//! Words of documentation pages. Templates escape them.

use lexibus_codegen::facts::register;
pub(super) use lexibus_codegen::facts::words::{one_line, PLAIN};
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{
    Binding, Documentation, Item, ModbusTable, ObjectBuses, RegisterBinding, RegisterSpace, Texts, Type, TypeDef,
    TypeId, Value,
};

/// The basic type below; of arrays and records, nothing is known.
pub(super) fn basic(types: &[TypeDef], ty: Type) -> Type {
    match Owner::of_types(types).basic(ty) {
        Type::Named(_) => Type::Opaque(None),
        basic => basic,
    }
}

/// A type as a table shows it: its length where it is a text, and what the source calls it where that says more.
pub(super) fn type_name(types: &[TypeDef], ty: Type) -> String {
    basic(types, ty).with_length()
}

/// The definition of a named type.
pub(super) fn definition(types: &[TypeDef], ty: Type) -> Option<&TypeDef> {
    match ty {
        Type::Named(TypeId(id)) => types.get(id as usize),
        _ => None,
    }
}

/// A name in other languages.
pub(super) fn names(names: &Texts) -> Vec<(String, String)> {
    names.iter().map(|own| (own.language.to_string(), own.text.to_string())).collect()
}

/// A description in other languages.
pub(super) fn translations(documentation: Option<&Documentation>) -> Vec<(String, String)> {
    documentation.map(|own| names(&own.translations)).unwrap_or_default()
}

/// `3`, `4 to 7`.
pub(super) fn numbers(first: i128, last: Option<i128>) -> String {
    match last.filter(|last| *last != first) {
        Some(last) => format!("{} to {}", number(first), number(last)),
        None => number(first),
    }
}

/// A number; of large ones that are bit patterns more often than amounts, both forms.
fn number(number: i128) -> String {
    match number {
        0..=255 => number.to_string(),
        256.. => format!("{number} (0x{number:X})"),
        _ => number.to_string(),
    }
}

/// A value in a table: numbers of unsigned types that look like bit patterns in hexadecimal.
pub(super) fn value(value: &Value, ty: Type) -> String {
    match (value, ty) {
        (Value::Int(number @ 0x1_0000..), Type::Unsigned(_)) => format!("0x{number:X}"),
        _ => PLAIN.value(value),
    }
}

/// An address of an item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Address {
    pub bus: &'static str,
    /// The address in a few characters, as the source prints it.
    pub number: String,
    /// By what a search finds it: printed and wire address; empty if it only repeats another address.
    pub lookup: String,
    /// The address with all its facts.
    pub text: String,
}

/// The addresses of an item, the one that it is named by first. `tables` are the requests that the device takes on Modbus.
pub(super) fn addresses(item: &Item, tables: &[ModbusTable]) -> Vec<Address> {
    item.bindings.iter().map(|binding| address(binding, item, tables)).collect()
}

fn address(binding: &Binding, item: &Item, tables: &[ModbusTable]) -> Address {
    let (bus, text) = match binding {
        Binding::Register(own) => return register_address(own, item, tables),
        Binding::Object { buses, index, sub_index } => (object_bus(*buses), format!("0x{index:04X}:{sub_index:02X}")),
        Binding::Record { index, bit_offset, bits } => {
            ("PROFINET", format!("record 0x{index:04X}, {}", span(*bit_offset, *bits)))
        }
        Binding::Image(own) => ("Process image", format!("{}, {}", own.image, span(own.bit_offset, own.bits))),
        Binding::Parameter { space, code } => ("Serial", format!("{space} 0x{code:04X}")),
        Binding::Ascii(name) => ("ASCII", name.to_string()),
        Binding::EscMemory { address, length } => ("Slave controller", format!("0x{address:04X}, {length} bytes")),
        Binding::Indirect(own) => {
            let buses: Vec<&str> = own.buses.iter().map(|bus| lexibus_codegen::facts::words::bus_name(bus)).collect();
            ("Window", format!("{} 0x{:04X} on {}", own.space, own.number, buses.join(", ")))
        }
    };
    // A window takes the number of a register or parameter, which is found anyway.
    let lookup = if bus == "Window" { String::new() } else { text.clone() };
    Address { bus, number: text.clone(), lookup, text }
}

fn register_address(own: &RegisterBinding, item: &Item, tables: &[ModbusTable]) -> Address {
    let table = match own.space {
        RegisterSpace::Coil => "coil",
        RegisterSpace::DiscreteInput => "discrete input",
        RegisterSpace::Input => "input register",
        RegisterSpace::Holding => "register",
    };
    let number = format!("{table} {}", register::printed(own));
    let is_wire = register::printed(own) == register::wire(own);
    let wire = if is_wire { String::new() } else { format!(" (wire {})", register::wire(own)) };
    let text = register::text(own, item, tables);
    Address { bus: "Modbus", lookup: format!("{number}{wire}"), number, text }
}

fn object_bus(buses: ObjectBuses) -> &'static str {
    match (buses.canopen, buses.coe) {
        (true, true) => "CANopen, EtherCAT",
        (false, true) => "EtherCAT",
        _ => "CANopen",
    }
}

/// `byte 3`, `byte 3 bit 4`, `bytes 2–5`.
pub(super) fn span(first: u32, bits: u32) -> String {
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

/// So many letters of a text, the last one being `…` where there are more.
pub(super) fn cut(text: &str, letters: usize) -> String {
    match text.chars().count() {
        count if count <= letters => text.to_owned(),
        _ => text.chars().take(letters.saturating_sub(1)).chain(['…']).collect(),
    }
}
