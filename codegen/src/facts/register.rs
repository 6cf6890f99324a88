//! Addresses on Modbus: printed addresses and wire addresses.

use crate::ir::{Bus, Item, ModbusTable, RegisterBinding, RegisterSpace};
use crate::number::hex16;

impl RegisterSpace {
    /// Returns the name of the Modbus table.
    pub fn title(self) -> &'static str {
        match self {
            RegisterSpace::Holding => "holding",
            RegisterSpace::Input => "input",
            RegisterSpace::Coil => "coil",
            RegisterSpace::DiscreteInput => "discrete input",
        }
    }

    /// Returns the function codes for reading, for writing one element, and for writing several elements (MODBUS Application
    /// Protocol V1.1b3, 6).
    fn functions(self) -> ([u8; 1], &'static [u8], &'static [u8]) {
        match self {
            RegisterSpace::Coil => ([1], &[5, 15], &[15]),
            RegisterSpace::DiscreteInput => ([2], &[], &[]),
            RegisterSpace::Holding => ([3], &[6, 16], &[16]),
            RegisterSpace::Input => ([4], &[], &[]),
        }
    }
}

/// Returns the printed addresses: `40102–40103`, `R01`. Returns the wire addresses if the source prints no addresses.
pub fn printed(register: &RegisterBinding) -> String {
    match register.printed.as_str() {
        "" => wire(register),
        printed => printed.to_owned(),
    }
}

/// Returns the wire addresses: `101–102`, `0x8001`. Addresses with more than four digits are hexadecimal.
pub fn wire(register: &RegisterBinding) -> String {
    match register.last() {
        last if last == register.address => wire_address(last),
        last => format!("{}–{}", wire_address(register.address), wire_address(last)),
    }
}

/// Formats a wire address. Addresses with more than four digits are hexadecimal.
pub fn wire_address(address: u16) -> String {
    if address > 9999 {
        hex16(address)
    } else {
        address.to_string()
    }
}

/// Returns the CRC of a Modbus RTU frame (MODBUS over Serial Line V1.02, 6.2.2).
pub fn crc(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0xFFFF, |crc, byte| {
        let crc = crc ^ u16::from(*byte);
        (0..8).fold(crc, |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 })
    })
}

/// Returns the printed addresses of a binding, followed by facts about them: `40102–40103 (holding; wire address 101–102; FC 3/16;
/// low word first)`. `tables` contains the function codes that the device accepts.
pub fn text(register: &RegisterBinding, item: &Item, tables: &[ModbusTable]) -> String {
    let mut facts = vec![register.space.title().to_owned(), format!("wire address {}", wire(register))];
    let functions: Vec<String> = functions(register, item, tables).iter().map(u8::to_string).collect();
    facts.extend((!functions.is_empty()).then(|| format!("FC {}", functions.join("/"))));
    if register.words_per_address > 1 {
        facts.push(format!("{} bits per address", 16 * u16::from(register.words_per_address)));
    }
    facts.extend(register.bit_offset.map(|bit| format!("from bit {bit}")));
    let is_word = matches!(register.space, RegisterSpace::Holding | RegisterSpace::Input);
    if is_word && register.count > 1 && !item.type_on(Bus::Modbus).is_bytes() {
        let order = if register.low_word_first { "low word first" } else { "high word first" };
        facts.push(format!("{order}{}", if register.is_order_assumed { " (assumed)" } else { "" }));
    }
    facts.extend(register.bytes_swapped.then(|| "bytes swapped".to_owned()));
    format!("{} ({})", printed(register), facts.join("; "))
}

/// Returns the function codes that read and write an item at this register, if the device accepts them and the access
/// rights allow it.
pub fn functions(register: &RegisterBinding, item: &Item, tables: &[ModbusTable]) -> Vec<u8> {
    /// Mask Write Register, which changes some bits of a register. A description must list this function because it is
    /// optional.
    const MASK_WRITE: u8 = 22;
    let table = tables.iter().find(|table| table.space == register.space);
    let accepted = table.map_or(&[][..], |table| &table.functions);
    let is_accepted = |function: &&u8| accepted.is_empty() || accepted.contains(function);
    let (reads, one, several) = register.space.functions();
    // A device whose registers are longer than 16 bits may accept a function for a single register.
    let is_one = register.count == 1 || register.words_per_address > 1 && !accepted.is_empty();
    let is_split = table.is_some_and(|table| table.split);
    let is_part = register.bit_offset.is_some() && register.count == 1;
    let writes = match register.space {
        RegisterSpace::Holding if is_part && accepted.contains(&MASK_WRITE) => &[MASK_WRITE],
        _ if is_one || is_split => one,
        _ => several,
    };
    let access = item.access_on(Bus::Modbus);
    let reads = reads.iter().filter(|_| access.readable());
    let writes = writes.iter().filter(|_| access.writable());
    reads.chain(writes).filter(is_accepted).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Access, Binding, Type};

    fn register(count: u16) -> RegisterBinding {
        RegisterBinding {
            printed: if count > 1 { "40102–40103" } else { "40102" }.into(),
            low_word_first: true,
            ..RegisterBinding::new(RegisterSpace::Holding, 101, count)
        }
    }

    #[track_caller]
    fn is(binding: &RegisterBinding, kind: (Type, Access), tables: &[ModbusTable], expected: &str) {
        let mut item = Item::new(Binding::Register(Box::new(binding.clone())));
        (item.ty, item.access) = kind;
        assert_eq!(text(binding, &item, tables), expected);
    }

    const NUMBER: (Type, Access) = (Type::Integer(32), Access::ReadWrite);
    const READ_ONLY: (Type, Access) = (Type::Integer(32), Access::ReadOnly);

    #[test]
    fn both_addresses_are_named() {
        is(&register(2), NUMBER, &[], "40102–40103 (holding; wire address 101–102; FC 3/16; low word first)");
        is(&register(1), NUMBER, &[], "40102 (holding; wire address 101; FC 3/6/16)");
        is(&register(1), READ_ONLY, &[], "40102 (holding; wire address 101; FC 3)");
        let binding =
            RegisterBinding { space: RegisterSpace::Coil, bytes_swapped: true, printed: "".into(), ..register(1) };
        is(&binding, (Type::Boolean, Access::WriteOnly), &[], "101 (coil; wire address 101; FC 5/15; bytes swapped)");
        let binding =
            RegisterBinding { words_per_address: 2, low_word_first: false, printed: "40102".into(), ..register(2) };
        is(&binding, READ_ONLY, &[], "40102 (holding; wire address 101; FC 3; 32 bits per address; high word first)");
        let binding = RegisterBinding { bit_offset: Some(8), ..register(1) };
        is(&binding, READ_ONLY, &[], "40102 (holding; wire address 101; FC 3; from bit 8)");
    }

    #[test]
    fn strings_have_no_word_order() {
        let text = (Type::VisibleString(None), Access::ReadWrite);
        is(&register(2), text, &[], "40102–40103 (holding; wire address 101–102; FC 3/16)");
    }

    #[test]
    fn only_functions_that_are_used_are_named() {
        let table = ModbusTable {
            space: RegisterSpace::Holding,
            functions: vec![3, 16],
            max_read: None,
            max_write: None,
            split: false,
        };
        is(&register(1), NUMBER, std::slice::from_ref(&table), "40102 (holding; wire address 101; FC 3/16)");
        let split = ModbusTable { functions: vec![3, 6], split: true, ..table.clone() };
        is(&register(2), NUMBER, &[split], "40102–40103 (holding; wire address 101–102; FC 3/6; low word first)");
        let masked = ModbusTable { functions: vec![3, 6, 22], ..table };
        let part = RegisterBinding { bit_offset: Some(8), ..register(1) };
        is(&part, NUMBER, &[masked], "40102 (holding; wire address 101; FC 3/22; from bit 8)");
    }
}
