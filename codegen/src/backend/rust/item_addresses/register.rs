//! Generates the code that creates a register, and determines the sort order of registers.

use super::ItemAddresses;
use crate::ir::{RegisterBinding, RegisterSpace};

impl ItemAddresses<'_> {
    /// Returns the constructor call of the item's register, if the item has one.
    pub fn register_code(&self) -> Option<String> {
        self.modbus.map(|register| self.register(register))
    }

    /// Returns the sort key of the item's register, if the item has one: table, address and first bit.
    pub fn register_key(&self) -> Option<(u8, u16, Option<u8>)> {
        self.modbus.map(|register| {
            let table = match register.space {
                RegisterSpace::Holding => 0,
                RegisterSpace::Input => 1,
                RegisterSpace::Coil => 2,
                RegisterSpace::DiscreteInput => 3,
            };
            (table, register.address, register.bit_offset)
        })
    }

    pub(super) fn register(&self, register: &RegisterBinding) -> String {
        let RegisterBinding { address, count, .. } = register;
        let low_first = register.low_word_first && *count > 1 && !self.is_bytes;
        let new = |table: &str| format!("rt::Register::new(rt::RegisterTable::{table}, {address}, {count})");
        let mut code = match register.space {
            RegisterSpace::Holding if low_first => format!("rt::Register::low_first({address}, {count})"),
            RegisterSpace::Holding if *count == 1 => format!("rt::Register::holding({address})"),
            RegisterSpace::Holding => format!("rt::Register::high_first({address}, {count})"),
            RegisterSpace::Coil => new("Coil"),
            RegisterSpace::DiscreteInput => new("DiscreteInput"),
            RegisterSpace::Input => new("Input"),
        };
        if self.is_bytes {
            code += ".ordered(rt::WordOrder::Bytes)";
        } else if low_first && register.space != RegisterSpace::Holding {
            code += ".ordered(rt::WordOrder::LowFirst)";
        }
        if register.bytes_swapped != self.is_wide {
            code += ".swapped()";
        }
        if let Some(first) = register.bit_offset {
            code += &format!(".part({first}, {})", self.bits);
        }
        if register.extended && self.is_signed && self.bits < 16 * u32::from(register.count) {
            code += ".sign_extended()";
        }
        if register.words_per_address > 1 {
            code += &format!(".words_per_address({})", register.words_per_address);
        }
        code
    }
}
