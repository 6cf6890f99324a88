//! The buses and their address types.

use core::fmt;

use crate::image_field::ImageField;
use crate::register::Register;

/// A bus, or a protocol on top of a bus, with the type of its addresses.
pub trait Bus {
    /// Address of a value on this bus.
    type Address: Copy + fmt::Debug;

    /// Name of the bus, for error messages.
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
    /// CANopen over CAN: SDO transfers (CiA 301 7.2.4).
    CanOpen: Object, "CANopen";
    /// CANopen over EtherCAT (CoE): SDO transfers in the mailbox.
    CoE: Object, "CANopen over EtherCAT";
    /// Modbus RTU or Modbus TCP: registers and single bits.
    Modbus: Register, "Modbus";
    /// PROFINET: acyclic records.
    Profinet: Record, "PROFINET";
    /// A serial protocol for access to numbered parameters.
    Serial: Parameter, "serial";
    /// A fixed process image, such as the cyclic data of PROFINET. The fields of the image have fixed bit offsets.
    ProcessImage: ImageField, "process image";
    /// The memory of an EtherCAT slave controller (ETG.1000.4). A master accesses the memory by address, without a
    /// mailbox.
    Esc: EscMemory, "EtherCAT slave controller";
}

/// Address of an entry in an object dictionary. `Display` writes index and sub-index in hexadecimal, for example
/// `0x6040:00`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Object {
    /// Index of the object.
    pub index: u16,
    /// Sub-index of the entry; 0 if the object is a single variable.
    pub sub_index: u8,
}

impl Object {
    /// Creates the address of the entry at `index` and `sub_index`.
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

/// Address of a value in a PROFINET record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Record {
    /// Application process identifier (API).
    pub api: u32,
    /// Slot number.
    pub slot: u16,
    /// Subslot number.
    pub subslot: u16,
    /// Index of the record.
    pub index: u16,
    /// Byte offset of the value in the record.
    pub offset: u16,
    /// True if the value is a text or a byte string; false if the value is a number, whose most significant byte comes
    /// first.
    pub is_bytes: bool,
}

impl Record {
    /// Creates the address of a number at byte offset `offset` of a record. The API of the address is 0.
    #[must_use]
    pub const fn new(slot: u16, subslot: u16, index: u16, offset: u16) -> Self {
        Self { api: 0, slot, subslot, index, offset, is_bytes: false }
    }

    /// Returns the address with this application process identifier (API).
    #[must_use]
    pub const fn of_api(self, api: u32) -> Self {
        Self { api, ..self }
    }

    /// Returns the address, marked as that of a text or a byte string.
    #[must_use]
    pub const fn bytes(self) -> Self {
        Self { is_bytes: true, ..self }
    }
}

/// Parameter number of a serial protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameter(pub u32);

/// Address of a byte range in the memory of an EtherCAT slave controller. Numbers have their least significant byte
/// first (ETG.1000.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EscMemory {
    /// Address of the first byte.
    pub address: u16,
    /// Length in bytes.
    pub length: u16,
}

impl EscMemory {
    /// Creates the range of `length` bytes that starts at `address`.
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
