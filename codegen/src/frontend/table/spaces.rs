//! Maps register numbers to addresses on each bus.

use compact_str::{format_compact, CompactString};

use super::at::{At, FlagOr};
use super::format::{ModbusRule, ObjectRule, SpaceTable};
use super::tree::Reader;
use super::windows::{self, Window};
use crate::diagnostics::codes;
use crate::ir::{Binding, Bus, Buses, ModbusTable, ObjectBuses, RegisterBinding, RegisterSpace};
use crate::source::Span;

/// Number of bits per register number, if the space has no key `bits`.
const REGISTER_BITS: u8 = 16;

/// Space of register numbers, with the rules for addresses on each bus.
#[derive(Clone, Debug, Default)]
pub(super) struct Space {
    pub name: String,
    /// Number of bits that one register number addresses.
    pub bits: u8,
    modbus: Option<Modbus>,
    canopen: Option<ObjectBase>,
    ethercat: Option<ObjectBase>,
    parameter: bool,
    esc: bool,
    /// True if a value that is shorter than its registers is extended to their length.
    extend: bool,
    windows: Vec<Window>,
    /// Prefix that the manual prints before each Modbus register number.
    pub prefix: CompactString,
    /// Minimum number of digits of a printed register number.
    pub digits: u8,
    /// True if the word order is an assumption.
    pub is_order_assumed: bool,
}

#[derive(Clone, Copy, Debug)]
struct Modbus {
    space: RegisterSpace,
    shift: i64,
    low_word_first: bool,
    bytes_swapped: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct ObjectBase {
    index: i64,
    sub_index: u8,
}

/// First register number of a row, and the length, word order, byte order and bit offset of its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers {
    pub first: u32,
    /// Length of the value in bits, if known.
    pub bits: Option<u32>,
    pub low_word_first: Option<bool>,
    pub bytes_swapped: Option<bool>,
    /// First bit of a value that occupies only a part of a register.
    pub bit_offset: Option<u8>,
}

/// Reads the spaces of a table.
pub(super) fn read(reader: &mut Reader<'_, '_>, tables: &[(At<String>, SpaceTable)]) -> Vec<Space> {
    tables.iter().map(|(name, table)| space(reader, name, table)).collect()
}

fn space(reader: &mut Reader<'_, '_>, name: &At<String>, table: &SpaceTable) -> Space {
    let rule = table.modbus.as_ref();
    let modbus = rule.map(|rule| modbus(reader, rule));
    // In the Modbus tables of coils and discrete inputs, a register number addresses one bit.
    let is_bit = modbus.is_some_and(|rule| matches!(rule.space, RegisterSpace::Coil | RegisterSpace::DiscreteInput));
    if table.extend && modbus.is_none_or(|_| is_bit) {
        let message = "`extend` applies to Modbus registers, which the space does not have";
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
    }
    Space {
        name: name.value.clone(),
        bits: table.bits.filter(|&bits| bits > 0).unwrap_or(if is_bit { 1 } else { REGISTER_BITS }),
        modbus,
        prefix: rule.and_then(|rule| rule.prefix.as_deref()).unwrap_or_default().into(),
        digits: rule.and_then(|rule| rule.digits).unwrap_or(1).min(9),
        is_order_assumed: rule.is_some_and(|rule| rule.order_assumed),
        canopen: table.canopen.as_ref().map(objects),
        ethercat: table.ethercat.as_ref().map(objects),
        parameter: table.parameter.as_ref().is_some_and(|rule| !matches!(rule, FlagOr::Flag(false))),
        esc: table.esc,
        extend: table.extend,
        windows: windows::read(reader, name, table),
    }
}

/// Returns the Modbus requests that the device supports, according to the Modbus rules of the spaces. Reports spaces
/// whose rules contradict each other.
pub(super) fn modbus_tables(reader: &mut Reader<'_, '_>, tables: &[(At<String>, SpaceTable)]) -> Vec<ModbusTable> {
    let mut found: Vec<ModbusTable> = Vec::new();
    for (name, rule) in tables.iter().filter_map(|(name, table)| Some((name, table.modbus.as_ref()?))) {
        if rule.functions.is_none() && rule.max_read.is_none() && rule.max_write.is_none() && rule.split.is_none() {
            continue;
        }
        let space = modbus(reader, rule).space;
        widths(reader, rule, space);
        let table = ModbusTable {
            space,
            functions: rule.functions.iter().flat_map(|list| list.value.iter().copied()).collect(),
            max_read: rule.max_read.as_ref().map(|limit| limit.value),
            max_write: rule.max_write.as_ref().map(|limit| limit.value),
            split: rule.split.unwrap_or(false),
        };
        match found.iter().find(|other| other.space == table.space) {
            Some(other) if *other != table => {
                let message = "another space declares different requests for the same Modbus table";
                reader.report(&codes::TABLE_VALUE, reader.span(name), message);
            }
            Some(_) => {}
            None => found.push(table),
        }
    }
    found
}

/// Compares the request limits of a space with those of the standard (MODBUS Application Protocol V1.1b3, 6.1 to 6.12).
fn widths(reader: &mut Reader<'_, '_>, rule: &ModbusRule, space: RegisterSpace) {
    let (read, write, what) = match space {
        RegisterSpace::Coil | RegisterSpace::DiscreteInput => (2000, 1968, "bits"),
        RegisterSpace::Holding | RegisterSpace::Input => (125, 123, "registers"),
    };
    for (given, most, verb) in [(&rule.max_read, read, "reads"), (&rule.max_write, write, "writes")] {
        let Some(given) = given else { continue };
        if given.value == 0 {
            reader.report(&codes::TABLE_VALUE, reader.span(given), "a request has at least one register");
        } else if given.value > most {
            let message = format!("a Modbus request {verb} at most {most} {what}");
            reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        }
    }
}

fn modbus(reader: &mut Reader<'_, '_>, rule: &ModbusRule) -> Modbus {
    let tables = [
        ("holding", RegisterSpace::Holding),
        ("input", RegisterSpace::Input),
        ("coil", RegisterSpace::Coil),
        ("discrete", RegisterSpace::DiscreteInput),
    ];
    let table = rule.table.as_ref().and_then(|table| reader.word(table, "Modbus table", &tables));
    let order = rule.order.as_ref().and_then(|order| word_order(reader, order));
    Modbus {
        space: table.unwrap_or(RegisterSpace::Holding),
        shift: rule.add.unwrap_or(0).saturating_sub(rule.first.unwrap_or(0)),
        low_word_first: order.unwrap_or(false),
        bytes_swapped: rule.swap,
    }
}

/// Returns whether the less significant word comes first in the word order `order`.
pub(super) fn word_order(reader: &mut Reader<'_, '_>, order: &At<String>) -> Option<bool> {
    reader.word(order, "word order", &[("high_first", false), ("low_first", true)])
}

fn objects(rule: &ObjectRule) -> ObjectBase {
    let index = rule.index.as_ref().map_or(0, |index| index.value);
    ObjectBase { index, sub_index: rule.sub.as_ref().map_or(0, |sub| sub.value) }
}

impl Space {
    /// Returns the index and sub-index for a register number. Returns `None` if the space has no rule for objects, or
    /// the index is out of range.
    pub fn object(&self, number: u32) -> Option<(u16, u8)> {
        let rule = self.canopen.or(self.ethercat)?;
        Some((u16::try_from(rule.index.checked_add(number.into())?).ok()?, rule.sub_index))
    }

    /// Returns the addresses of a register on each bus. Reports a register number that has no address on a bus.
    pub fn bindings(&self, reader: &mut Reader<'_, '_>, numbers: Numbers, buses: Buses, span: Span) -> Vec<Binding> {
        let mut bindings = self.object_bindings(reader, numbers, buses, span);
        if let Some(rule) = self.modbus.filter(|_| buses.contains(Bus::Modbus)) {
            bindings.extend(self.register(reader, rule, numbers, span));
        }
        if self.parameter {
            bindings.push(Binding::parameter(&self.name, numbers.first));
        }
        if self.esc {
            let length = numbers.bits.map_or(1, |bits| bits.div_ceil(8)) as u16;
            match u16::try_from(numbers.first) {
                Ok(address) => bindings.push(Binding::EscMemory { address, length }),
                Err(_) => no_address(reader, span, numbers.first, "the memory of a slave controller"),
            }
        }
        bindings.extend(windows::bindings(&self.name, &self.windows, numbers.first, buses));
        bindings
    }

    fn object_bindings(&self, reader: &mut Reader<'_, '_>, numbers: Numbers, buses: Buses, span: Span) -> Vec<Binding> {
        let canopen = self.canopen.filter(|_| buses.contains(Bus::CanOpen));
        let ethercat = self.ethercat.filter(|_| buses.contains(Bus::EtherCat));
        let mut bindings = Vec::new();
        let mut add = |rule: Option<ObjectBase>, buses: ObjectBuses| {
            let Some(rule) = rule else { return };
            match u16::try_from(rule.index.saturating_add(numbers.first.into())) {
                Ok(index) => bindings.push(Binding::Object { buses, index, sub_index: rule.sub_index }),
                Err(_) => no_address(reader, span, numbers.first, "an object dictionary"),
            }
        };
        if canopen.is_some() && canopen == ethercat {
            add(canopen, ObjectBuses { canopen: true, coe: true });
        } else {
            add(canopen, ObjectBuses::CANOPEN);
            add(ethercat, ObjectBuses::COE);
        }
        bindings
    }

    fn register(&self, reader: &mut Reader<'_, '_>, rule: Modbus, numbers: Numbers, span: Span) -> Option<Binding> {
        let Ok(address) = u16::try_from(i64::from(numbers.first).saturating_add(rule.shift)) else {
            no_address(reader, span, numbers.first, "Modbus");
            return None;
        };
        let bits = numbers.bits.unwrap_or(u32::from(self.bits));
        // Coils and discrete inputs are bits. All other Modbus registers have 16 bits, even if a register number addresses more
        // bits.
        let unit = match rule.space {
            RegisterSpace::Coil | RegisterSpace::DiscreteInput => 1,
            _ => 16,
        };
        // A value that occupies only a part of a register is not extended.
        let extended = self.extend && unit > 1 && numbers.bit_offset.is_none();
        let bits = if extended { bits.next_multiple_of(self.bits.into()) } else { bits };
        let mut register = RegisterBinding {
            space: rule.space,
            address,
            printed: CompactString::default(),
            is_order_assumed: self.is_order_assumed && numbers.low_word_first.is_none(),
            count: u16::try_from(bits.div_ceil(unit)).unwrap_or(u16::MAX).max(1),
            low_word_first: numbers.low_word_first.unwrap_or(rule.low_word_first),
            bytes_swapped: numbers.bytes_swapped.unwrap_or(rule.bytes_swapped),
            bit_offset: numbers.bit_offset,
            // A register number that addresses 32 bits has one wire address for two 16-bit words.
            words_per_address: if unit == 16 { (self.bits / 16).max(1) } else { 1 },
            extended,
        };
        register.printed = self.printed(numbers.first, &register);
        Some(Binding::Register(Box::new(register)))
    }

    /// Returns the register numbers as the manual prints them.
    fn printed(&self, first: u32, register: &RegisterBinding) -> CompactString {
        let (prefix, digits) = (self.prefix.as_str(), usize::from(self.digits));
        match u32::from(register.last() - register.address) {
            0 => format_compact!("{prefix}{first:0digits$}"),
            further => format_compact!("{prefix}{first:0digits$}–{prefix}{:0digits$}", first.saturating_add(further)),
        }
    }
}

fn no_address(reader: &mut Reader<'_, '_>, span: Span, number: u32, bus: &str) {
    reader.report(&codes::TABLE_PLACE, span, format!("register number {number} has no address on {bus}"));
}
