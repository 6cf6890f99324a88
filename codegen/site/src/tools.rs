//! Attributes of a row for the script of the page, which converts values and shows requests.

use super::requests::OfRecord;
use lexibus_codegen::facts::{register, types};
use lexibus_codegen::ir::{Binding, Bus, Item, ModbusTable, RegisterBinding, RegisterSpace, Scale, TypeDef, Value};

/// Returns the conversion from raw values to physical values: `0.01 0` (scale factor and offset), or `/25000000`
/// (numerator of a reciprocal). The text is empty if the raw value equals the physical value, or if the conversion
/// needs further values.
pub(super) fn scale(item: &Item) -> String {
    match item.quantity.as_deref().and_then(|quantity| quantity.scale.as_ref()) {
        Some(&Scale::Linear { factor, offset }) if factor != 1.0 || offset != 0.0 => format!("{factor} {offset}"),
        Some(Scale::Reciprocal { numerator }) => format!("/{numerator}"),
        _ => String::new(),
    }
}

/// Returns the raw values that can be written: `1..99`, or several ranges separated by spaces. A missing number means
/// no limit. The text is empty if all values of the type can be written, or if a limit is not a number.
pub(super) fn range(item: &Item) -> String {
    let number = |value: Option<&Value>| match value {
        None => Some(String::new()),
        Some(value @ (Value::Int(_) | Value::Real(_))) => Some(value.to_string()),
        Some(_) => None,
    };
    let range = |low: Option<&Value>, high: Option<&Value>| Some(format!("{}..{}", number(low)?, number(high)?));
    let limits = &item.limits;
    let ranges: Option<Vec<String>> = match (limits.allowed.as_slice(), &limits.low, &limits.high) {
        ([], None, None) => None,
        ([], low, high) => range(low.as_ref(), high.as_ref()).map(|range| vec![range]),
        (allowed, ..) => allowed.iter().map(|(first, last)| range(Some(first), Some(last))).collect(),
    };
    ranges.unwrap_or_default().join(" ")
}

/// Returns the addresses of an item for requests, separated by `;`.
///
/// - `o 24640 0 ce`: index, sub-index and buses of an object, here CANopen and EtherCAT. If the requests on a bus differ from the
///   access rights of the item, the letters of the requests follow the letter of the bus: `crer` is read-only on both buses, and
///   `ce-` has no requests on EtherCAT.
/// - `m h 62 2 l 3/16`: Modbus table (its first letter), wire address, number of registers, flags and function codes. Flags:
///   `l` low word first, `s` swapped bytes, `x` sign-extended, `p` part of a register.
/// - `r 8 16 API 0, slot 1, subslot 1, …`: bit offset and number of bits of an item in a record, and the address of the
///   value. `record` is the record that contains the item.
pub(super) fn addresses(item: &Item, types: &[TypeDef], tables: &[ModbusTable], record: &OfRecord<'_>) -> String {
    let address = |binding: &Binding| match binding {
        Binding::Object { buses, index, sub_index } => {
            let buses = [(buses.canopen, "c", Bus::CanOpen), (buses.coe, "e", Bus::EtherCat)].into_iter();
            let buses = buses.filter(|(has, ..)| *has).map(|(_, letter, bus)| format!("{letter}{}", rights(item, bus)));
            Some(format!("o {index} {sub_index} {}", buses.collect::<String>()))
        }
        Binding::Register(register) => Some(registers(register, item, types, tables)),
        Binding::Record { index, bit_offset, bits } => {
            Some(format!("r {bit_offset} {bits} {}", record.address(*index, *bit_offset, *bits)))
        }
        _ => None,
    };
    item.bindings.iter().filter_map(address).collect::<Vec<_>>().join(";")
}

/// Returns the number of 16-bit words that a request for the item reads or writes. A request always contains whole registers of
/// the device, which can consist of several words.
pub(super) fn count(register: &RegisterBinding) -> u16 {
    let words = u16::from(register.words_per_address.max(1));
    register.count.div_ceil(words) * words
}

/// Returns the letters of the possible requests on a bus: `r`, `w`, `rw` or `-`. The text is empty if the requests correspond to
/// the item's access rights. A page converts values only to the item's type, so an item has no write requests on a bus where its
/// type differs.
fn rights(item: &Item, bus: Bus) -> &'static str {
    let access = item.access_on(bus);
    let is_writable = access.writable() && item.type_on(bus) == item.ty;
    match (access.readable(), is_writable) {
        rights if rights == (item.access.readable(), item.access.writable()) => "",
        (true, true) => "rw",
        (true, false) => "r",
        (false, true) => "w",
        (false, false) => "-",
    }
}

fn registers(register: &RegisterBinding, item: &Item, types: &[TypeDef], tables: &[ModbusTable]) -> String {
    let table = match register.space {
        RegisterSpace::Holding => "h",
        RegisterSpace::Input => "i",
        RegisterSpace::Coil => "c",
        RegisterSpace::DiscreteInput => "d",
    };
    let is_signed = types::basic(types, item.type_on(Bus::Modbus)).is_signed();
    let flags = [
        (register.low_word_first, "l"),
        (register.bytes_swapped, "s"),
        (register.extended && is_signed, "x"),
        (register.bit_offset.is_some(), "p"),
    ];
    let flags = flags.map(|(has, flag)| if has { flag } else { "" }).concat();
    let functions: Vec<String> = register::functions(register, item, tables).iter().map(u8::to_string).collect();
    let flags = if flags.is_empty() { "-" } else { &flags };
    format!("m {table} {} {} {flags} {}", register.address, count(register), functions.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECORD: OfRecord<'_> = OfRecord { submodule: "", length: 0, default_bytes: &[] };
    use lexibus_codegen::ir::{Access, Buses, ItemVariant, ObjectBuses, Type};

    #[test]
    fn objects_have_the_access_rights_of_each_bus() {
        let buses = ObjectBuses { canopen: true, coe: true };
        let binding = Binding::Object { buses, index: 0x6040, sub_index: 0 };
        let mut item = Item { ty: Type::Unsigned(16), access: Access::ReadWrite, ..Item::new(binding) };
        assert_eq!(addresses(&item, &[], &[], &RECORD), "o 24640 0 ce");
        let variant = |bus| ItemVariant { buses: Buses::from_iter([bus]), ..ItemVariant::default() };
        item.variants.push(ItemVariant { access: Some(Access::ReadOnly), ..variant(Bus::CanOpen) });
        assert_eq!(addresses(&item, &[], &[], &RECORD), "o 24640 0 cre");
        item.variants.push(ItemVariant { ty: Some(Type::Unsigned(32)), ..variant(Bus::EtherCat) });
        assert_eq!(addresses(&item, &[], &[], &RECORD), "o 24640 0 crer");
        item.access = Access::WriteOnly;
        assert_eq!(addresses(&item, &[], &[], &RECORD), "o 24640 0 cre-");
    }

    #[test]
    fn only_signed_values_are_extended() {
        let register = RegisterBinding { extended: true, ..RegisterBinding::new(RegisterSpace::Holding, 16, 2) };
        let binding = Binding::Register(Box::new(register));
        let mut item = Item { ty: Type::Unsigned(16), access: Access::ReadWrite, ..Item::new(binding) };
        assert_eq!(addresses(&item, &[], &[], &RECORD), "m h 16 2 - 3/16");
        item.ty = Type::Integer(16);
        assert_eq!(addresses(&item, &[], &[], &RECORD), "m h 16 2 x 3/16");
    }
}
