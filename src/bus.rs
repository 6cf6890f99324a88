//! The buses, and how each of them addresses a value.

use core::fmt;

use crate::image_field::ImageField;
use crate::register::Register;

/// A bus, or a protocol that runs over one: which form its addresses have.
pub trait Bus {
    /// Where a value is found on this bus.
    type Address: Copy + fmt::Debug;

    /// The bus's name, for messages.
    const NAME: &'static str;
}

macro_rules! buses {
    ($($(#[$attribute:meta])* $bus:ident: $address:ident, $name:literal;)*) => {$(
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug)]
        pub enum $bus {}

        impl Bus for $bus {
            type Address = $address;
            const NAME: &'static str = $name;
        }
    )*};
}

buses! {
    /// CANopen: SDO transfers over CAN (CiA 301 7.2.4).
    CanOpen: Object, "CANopen";
    /// CANopen over EtherCAT: SDO transfers in the mailbox.
    CoE: Object, "CANopen over EtherCAT";
    /// Modbus RTU or TCP: registers and single bits.
    Modbus: Register, "Modbus";
    /// PROFINET: acyclic records.
    Profinet: Record, "PROFINET";
    /// A serial protocol that numbers its parameters.
    Serial: Parameter, "serial";
    /// A fixed process image, as PROFINET carries it in each cycle: fields at fixed bits.
    ProcessImage: ImageField, "process image";
    /// The memory of an EtherCAT slave controller (ETG.1000.4), which a master reads and writes by addresses, without a mailbox.
    Esc: EscMemory, "EtherCAT slave controller";
}

/// An entry of an object dictionary. `Display` writes it as `0x6040:00`, both parts in hexadecimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Object {
    /// The object's index.
    pub index: u16,
    /// The entry's sub-index; 0 for an object that is one variable.
    pub sub_index: u8,
}

impl Object {
    /// The entry at `index` and `sub_index`.
    #[must_use]
    pub const fn new(index: u16, sub_index: u8) -> Self {
        Self { index, sub_index }
    }
}

impl fmt::Display for Object {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#06X}:{:02X}", self.index, self.sub_index)
    }
}

/// A value inside a PROFINET record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Record {
    /// The application process identifier.
    pub api: u32,
    /// The slot number.
    pub slot: u16,
    /// The subslot number.
    pub subslot: u16,
    /// The record's index.
    pub index: u16,
    /// The value's offset in the record, in bytes.
    pub offset: u16,
    /// Whether the value is a text or other bytes, one after the other; a number has its most significant byte first.
    pub is_bytes: bool,
}

impl Record {
    /// A number `offset` bytes behind the start of a record of the application process 0.
    #[must_use]
    pub const fn new(slot: u16, subslot: u16, index: u16, offset: u16) -> Self {
        Self { api: 0, slot, subslot, index, offset, is_bytes: false }
    }

    /// The same in another application process (API).
    #[must_use]
    pub const fn of_api(self, api: u32) -> Self {
        Self { api, ..self }
    }

    /// The same place for a text or other bytes.
    #[must_use]
    pub const fn bytes(self) -> Self {
        Self { is_bytes: true, ..self }
    }
}

/// The number of a parameter of a serial protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameter(pub u32);

/// Some bytes of the memory of an EtherCAT slave controller. Numbers have their least significant byte first (ETG.1000.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EscMemory {
    /// The address of the first byte.
    pub address: u16,
    /// How many bytes.
    pub length: u16,
}

impl EscMemory {
    /// `length` bytes from `address` on.
    #[must_use]
    pub const fn new(address: u16, length: u16) -> Self {
        Self { address, length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn object_is_written_in_hexadecimal() {
        assert_eq!(Object { index: 0x6040, sub_index: 0 }.to_string(), "0x6040:00");
        assert_eq!(Object { index: 0xA0, sub_index: 0xFE }.to_string(), "0x00A0:FE");
    }

    #[test]
    fn objects_sort_by_index_first() {
        assert!(Object { index: 0x1000, sub_index: 9 } < Object { index: 0x1001, sub_index: 0 });
    }
}
