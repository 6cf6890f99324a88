//! Addresses of parameters on a bus.

use lexibus::{Object, Register, RegisterTable, WordOrder};
use lexibus_codegen::ir::{Binding, Bus, Item, RegisterBinding, RegisterSpace, Type};

/// The bus protocol of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Network {
    /// CANopen.
    CanOpen,
    /// Modbus RTU or TCP.
    Modbus,
}

impl Network {
    /// Returns the bus in the intermediate representation.
    #[must_use]
    pub fn bus(self) -> Bus {
        match self {
            Network::CanOpen => Bus::CanOpen,
            Network::Modbus => Bus::Modbus,
        }
    }
}

/// The address of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Address {
    /// Index and sub-index in the object dictionary.
    Object(Object),
    /// Modbus registers, coils or discrete inputs.
    Register(Register),
}

impl Address {
    /// Returns the first address of an item on a network, and the binding of this address. `ty` is the basic type of the
    /// item. Returns `None` if the item has no address on the network, for example because it is only accessible through a
    /// window.
    pub(crate) fn of(item: &Item, ty: Type, network: Network) -> Option<(Self, &Binding)> {
        item.bindings.iter().find_map(|binding| match (binding, network) {
            (Binding::Object { buses, index, sub_index }, Network::CanOpen) if buses.canopen => {
                Some((Address::Object(Object::new(*index, *sub_index)), binding))
            }
            (Binding::Register(found), Network::Modbus) => Some((Address::Register(register(found, ty)), binding)),
            _ => None,
        })
    }

    /// Returns the object, or `None` for a Modbus address.
    #[must_use]
    pub fn object(self) -> Option<Object> {
        match self {
            Address::Object(object) => Some(object),
            Address::Register(_) => None,
        }
    }
}

/// Converts a register with a value of the basic type `ty` to a register of the runtime.
fn register(binding: &RegisterBinding, ty: Type) -> Register {
    let table = match binding.space {
        RegisterSpace::Holding => RegisterTable::Holding,
        RegisterSpace::Input => RegisterTable::Input,
        RegisterSpace::Coil => RegisterTable::Coil,
        RegisterSpace::DiscreteInput => RegisterTable::DiscreteInput,
    };
    let bits = ty.bits().unwrap_or(0);
    let mut register =
        Register::new(table, binding.address, binding.count).words_per_address(binding.words_per_address);
    if ty.is_bytes() {
        register = register.ordered(WordOrder::Bytes);
    } else if binding.low_word_first && binding.count > 1 {
        register = register.ordered(WordOrder::LowFirst);
    }
    // Each register of a Unicode text contains one UTF-16 code unit. In the value, the low byte of a code unit comes first.
    if binding.bytes_swapped != matches!(ty, Type::UnicodeString(_)) {
        register = register.swapped();
    }
    if let Some(first) = binding.bit_offset {
        register = register.part(first, bits as u8);
    }
    if binding.extended && ty.is_signed() && bits < 16 * u32::from(binding.count) {
        register = register.sign_extended();
    }
    register
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_keep_their_encoding() {
        let plain = RegisterBinding::new(RegisterSpace::Holding, 10, 2);
        assert_eq!(register(&plain, Type::Integer(32)), Register::high_first(10, 2));
        let low = RegisterBinding { low_word_first: true, ..plain.clone() };
        assert_eq!(register(&low, Type::Integer(32)), Register::low_first(10, 2));
        assert_eq!(register(&low, Type::VisibleString(Some(4))).order, WordOrder::Bytes);
        assert!(register(&plain, Type::UnicodeString(Some(2))).bytes_swapped);
        let part = RegisterBinding { bit_offset: Some(4), count: 1, ..plain.clone() };
        assert_eq!(register(&part, Type::Unsigned(8)), Register::holding(10).part(4, 8));
        let short = RegisterBinding { extended: true, ..plain };
        assert_eq!(register(&short, Type::Integer(8)), Register::high_first(10, 2).sign_extended());
        assert!(!register(&short, Type::Unsigned(8)).sign_extended);
    }
}
