//! Addresses independent of their bus.

use core::fmt;

use crate::bus::{EscMemory, Object, Parameter, Record};
use crate::from::from;
use crate::image_field::ImageField;
use crate::register::Register;

/// Address of an item on one of its buses. `Display` writes the address for error messages, for example `0x6040:00` or
/// `holding register 8`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BusAddress {
    /// Entry in an object dictionary, on CANopen or on CANopen over EtherCAT.
    Object(Object),
    /// Modbus register, coil or discrete input.
    Register(Register),
    /// Value in a PROFINET record.
    Record(Record),
    /// Parameter of a serial protocol.
    Parameter(Parameter),
    /// Field of a process image.
    ImageField(ImageField),
    /// Memory of an EtherCAT slave controller.
    EscMemory(EscMemory),
    /// Number of a value that is accessed through a window ([`Through`](crate::Through)).
    Number(u32),
}

from! {
    Object => BusAddress::Object;
    Register => BusAddress::Register;
    Record => BusAddress::Record;
    Parameter => BusAddress::Parameter;
    ImageField => BusAddress::ImageField;
    EscMemory => BusAddress::EscMemory;
}

impl fmt::Display for BusAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Object(object) => object.fmt(f),
            Self::Register(register) => write_register(register, f),
            Self::Record(record) => {
                let Record { api, slot, subslot, index, offset, .. } = record;
                if *api != 0 {
                    write!(f, "API {api}, ")?;
                }
                write!(f, "slot {slot}, subslot 0x{subslot:X}, record 0x{index:04X}, byte offset {offset}")
            }
            Self::Parameter(Parameter(number)) => write!(f, "parameter {number} (0x{number:X})"),
            Self::ImageField(field) => {
                let direction = if field.is_output { "output" } else { "input" };
                write!(f, "{direction}, byte offset {}", field.bit / 8)?;
                match field.bit % 8 {
                    0 => Ok(()),
                    bit => write!(f, ", bit {bit}"),
                }
            }
            Self::EscMemory(memory) => write!(f, "memory 0x{:04X}", memory.address),
            Self::Number(number) => write!(f, "number 0x{number:X}"),
        }
    }
}

fn write_register(register: &Register, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    write!(f, "{} {}", register.table.name(), register.address)?;
    match register.part {
        Some(part) => write!(f, ", bit {}", part.first),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RegisterTable;
    use std::string::ToString;

    fn text(address: impl Into<BusAddress>) -> std::string::String {
        address.into().to_string()
    }

    #[test]
    fn addresses_as_text() {
        assert_eq!(text(Object::new(0x607A, 1)), "0x607A:01");
        assert_eq!(text(Register::holding(8)), "holding register 8");
        assert_eq!(text(Register::holding(8).part(3, 2)), "holding register 8, bit 3");
        assert_eq!(text(Register::new(RegisterTable::Coil, 5, 1)), "coil 5");
        let record = Record::new(1, 0x8001, 0x2F, 4);
        assert_eq!(text(record), "slot 1, subslot 0x8001, record 0x002F, byte offset 4");
        assert!(text(record.of_api(7)).starts_with("API 7, slot 1"));
        assert_eq!(text(Parameter(0x1001)), "parameter 4097 (0x1001)");
        assert_eq!(text(ImageField::input(27, 2)), "input, byte offset 3, bit 3");
        assert_eq!(text(ImageField::output(16, 32)), "output, byte offset 2");
        assert_eq!(text(EscMemory::new(0x120, 2)), "memory 0x0120");
        assert_eq!(BusAddress::Number(0x8017).to_string(), "number 0x8017");
    }
}
