//! All items of a device as data, for programs that list or search items at run time, and for simulated devices.

use crate::bus::Object;
use crate::data_type::DataType;
use crate::flags::Flags;
use crate::register::Register;

/// One item: an entry of the object dictionary, a register, or both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Address in the object dictionary; `None` if the item is only a register.
    pub object: Option<Object>,
    /// Register on Modbus; `None` if the item is only an object.
    pub register: Option<Register>,
    /// Name in the device description.
    pub name: &'static str,
    /// Data type of the value.
    pub data_type: DataType,
    /// Access rights.
    pub access: AccessRights,
    /// Additional properties.
    pub flags: Flags,
    /// Initial value after power-on.
    pub initial: RawInitial,
    /// Minimum of the values that can be written.
    pub low: Bound,
    /// Maximum of the values that can be written.
    pub high: Bound,
    /// Unit of the value; empty if there is none.
    pub unit: &'static str,
}

/// Access rights of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AccessRights {
    /// Read-only (`ro`).
    ReadOnly,
    /// Write-only (`wo`).
    WriteOnly,
    /// Read and write (`rw`, `rwr`, `rww`).
    ReadWrite,
    /// Read-only, with a value that never changes (`const`).
    Constant,
}

/// Initial value after power-on, in the encoding of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RawInitial {
    /// The device description gives no value.
    Unknown,
    /// A fixed value.
    Bytes(&'static [u8]),
    /// The node-ID plus this number.
    NodeId(u64),
}

/// Inclusive limit of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// The limit of the data type.
    Unlimited,
    /// Limit of a signed integer.
    Signed(i64),
    /// Limit of an unsigned integer.
    Unsigned(u64),
    /// Limit of a floating-point number.
    Real(f64),
}

/// Returns the entry at `index` and `sub_index`. `entries` must be in ascending order of their objects, as generated
/// tables are.
#[must_use]
pub fn find(entries: &[Entry], index: u16, sub_index: u8) -> Option<&Entry> {
    let object = Some(Object::new(index, sub_index));
    let at = entries.binary_search_by_key(&object, |entry| entry.object).ok()?;
    entries.get(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn entry(object: Option<Object>, name: &'static str) -> Entry {
        Entry {
            object,
            register: None,
            name,
            data_type: DataType::Unsigned8,
            access: AccessRights::ReadOnly,
            flags: Flags::NONE,
            initial: RawInitial::Unknown,
            low: Bound::Unlimited,
            high: Bound::Unsigned(9),
            unit: "",
        }
    }

    static ENTRIES: [Entry; 4] = [
        entry(None, "register"),
        entry(Some(Object::new(0x1000, 0)), "a"),
        entry(Some(Object::new(0x1018, 0)), "b"),
        entry(Some(Object::new(0x1018, 1)), "c"),
    ];

    #[test]
    fn finds_by_index_and_sub_index() {
        assert_eq!(find(&ENTRIES, 0x1018, 1).map(|entry| entry.name), Some("c"));
        assert_eq!(find(&ENTRIES, 0x1000, 0).map(|entry| entry.name), Some("a"));
        assert_eq!(find(&ENTRIES, 0x1000, 1), None);
        assert_eq!(find(&[], 0x1000, 0), None);
    }
}
