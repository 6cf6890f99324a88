//! Addresses on Modbus: as the manual prints them, and on the wire.

use crate::ir::{Access, ModbusTable, RegisterBinding, RegisterSpace};

impl RegisterSpace {
    /// The table's name.
    pub(crate) fn title(self) -> &'static str {
        match self {
            RegisterSpace::Holding => "holding",
            RegisterSpace::Input => "input",
            RegisterSpace::Coil => "coil",
            RegisterSpace::DiscreteInput => "discrete input",
        }
    }

    /// Function codes that read, those that write one element, and those that write several (MODBUS Application Protocol V1.1b3, 6).
    fn functions(self) -> ([u8; 1], &'static [u8], &'static [u8]) {
        match self {
            RegisterSpace::Coil => ([1], &[5, 15], &[15]),
            RegisterSpace::DiscreteInput => ([2], &[], &[]),
            RegisterSpace::Holding => ([3], &[6, 16], &[16]),
            RegisterSpace::Input => ([4], &[], &[]),
        }
    }
}

/// `40102–40103`, `R01`: the printed numbers, or the wire addresses if the source prints no other numbers.
pub(crate) fn printed(register: &RegisterBinding) -> String {
    match register.printed.as_str() {
        "" => wire(register),
        printed => printed.to_owned(),
    }
}

/// `101–102`, `0x8001`: the addresses on the wire, counted from 0; hexadecimal if they have more than four digits.
pub(crate) fn wire(register: &RegisterBinding) -> String {
    let text = |address: u16| if address > 9999 { format!("0x{address:04X}") } else { address.to_string() };
    match register.last() {
        last if last == register.address => text(last),
        last => format!("{}–{}", text(register.address), text(last)),
    }
}

/// `40102–40103 (holding; wire 101–102; FC 3/16; low word first)`. `tables` lists the function codes that the device accepts.
pub(crate) fn text(register: &RegisterBinding, access: Access, tables: &[ModbusTable]) -> String {
    let mut facts = vec![register.space.title().to_owned(), format!("wire {}", wire(register))];
    let functions = functions(register, access, tables);
    facts.extend((!functions.is_empty()).then(|| format!("FC {}", functions.join("/"))));
    if register.words_per_address > 1 {
        facts.push(format!("{} bits an address", 16 * u16::from(register.words_per_address)));
    }
    if let Some(bit) = register.bit_offset {
        facts.push(format!("from bit {bit}"));
    }
    let is_word = matches!(register.space, RegisterSpace::Holding | RegisterSpace::Input);
    if is_word && register.count > 1 {
        let order = if register.low_word_first { "low word first" } else { "high word first" };
        facts.push(format!("{order}{}", if register.is_order_assumed { " (assumed)" } else { "" }));
    }
    if register.bytes_swapped {
        facts.push("bytes swapped".to_owned());
    }
    format!("{} ({})", printed(register), facts.join("; "))
}

/// The function codes that reach a register with these access rights.
fn functions(register: &RegisterBinding, access: Access, tables: &[ModbusTable]) -> Vec<String> {
    let (reads, one, several) = register.space.functions();
    let accepted = tables.iter().find(|table| table.space == register.space).map_or(&[][..], |table| &table.functions);
    // A device with one address for a longer register may take it in a function for one register.
    let is_one = register.count == 1 || register.words_per_address > 1 && !accepted.is_empty();
    let writes = if is_one { one } else { several };
    let reads = reads.iter().filter(|_| access.readable());
    let writes = writes.iter().filter(|_| access.writable());
    let is_accepted = |function: &&u8| accepted.is_empty() || accepted.contains(function);
    reads.chain(writes).filter(is_accepted).map(u8::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn register(count: u16) -> RegisterBinding {
        RegisterBinding {
            space: RegisterSpace::Holding,
            address: 101,
            printed: if count > 1 { "40102–40103" } else { "40102" }.into(),
            is_order_assumed: false,
            count,
            low_word_first: true,
            bytes_swapped: false,
            bit_offset: None,
            words_per_address: 1,
            extended: false,
        }
    }

    #[test]
    fn both_addresses_are_named() {
        let text = |own: &RegisterBinding, access| super::text(own, access, &[]);
        assert_eq!(
            text(&register(2), Access::ReadWrite),
            "40102–40103 (holding; wire 101–102; FC 3/16; low word first)"
        );
        assert_eq!(text(&register(1), Access::ReadWrite), "40102 (holding; wire 101; FC 3/6/16)");
        assert_eq!(text(&register(1), Access::ReadOnly), "40102 (holding; wire 101; FC 3)");
        let own =
            RegisterBinding { space: RegisterSpace::Coil, bytes_swapped: true, printed: "".into(), ..register(1) };
        assert_eq!(text(&own, Access::WriteOnly), "101 (coil; wire 101; FC 5/15; bytes swapped)");
        let own =
            RegisterBinding { words_per_address: 2, low_word_first: false, printed: "40102".into(), ..register(2) };
        assert_eq!(
            text(&own, Access::ReadOnly),
            "40102 (holding; wire 101; FC 3; 32 bits an address; high word first)"
        );
        let own = RegisterBinding { bit_offset: Some(8), ..register(1) };
        assert_eq!(text(&own, Access::ReadOnly), "40102 (holding; wire 101; FC 3; from bit 8)");
    }

    #[test]
    fn only_accepted_functions_are_named() {
        let table = ModbusTable {
            space: RegisterSpace::Holding,
            functions: vec![3, 16],
            max_read: None,
            max_write: None,
            split: false,
        };
        assert_eq!(text(&register(1), Access::ReadWrite, &[table]), "40102 (holding; wire 101; FC 3/16)");
    }
}
