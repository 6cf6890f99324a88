//! All items of a device as data. Programs use the table to list or search items at run time, and simulated devices use
//! it to create their items.

use crate::bus::Object;
use crate::data_type::DataType;
use crate::flags::Flags;
use crate::register::Register;

/// One item: an entry of the object dictionary, a Modbus register, or both. An item whose object and register have
/// different widths has two entries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Address in the object dictionary; `None` if the entry is only a register.
    pub object: Option<Object>,
    /// Modbus register; `None` if the entry is only an object.
    pub register: Option<Register>,
    /// Name in the device description.
    pub name: &'static str,
    /// Data type of the value.
    pub data_type: DataType,
    /// Access rights.
    pub access: AccessRights,
    /// Additional properties of the item.
    pub flags: Flags,
    /// Initial value after power-on.
    pub initial: RawInitial,
    /// Value that the configuration file (DCF or XDC) sets. `None` if the file sets no value, or if the description is
    /// another kind of file.
    pub configured: Option<RawInitial>,
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
    /// Read-only access (`ro`).
    ReadOnly,
    /// Write-only access (`wo`).
    WriteOnly,
    /// Read and write access (`rw`, `rwr`, `rww`).
    ReadWrite,
    /// Read-only access to a value that never changes (`const`).
    Constant,
}

/// Initial value after power-on, or configured value, encoded as on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RawInitial {
    /// The description declares no valid value for the data type.
    Unknown,
    /// Bytes of a fixed value.
    Bytes(&'static [u8]),
    /// The value is the sum of the node-ID and this number.
    NodeId(u64),
}

/// Limit of a range. The range includes the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// The limit of the data type applies.
    Unlimited,
    /// Limit of a signed integer.
    Signed(i64),
    /// Limit of an unsigned integer.
    Unsigned(u64),
    /// Limit of a floating-point number.
    Real(f64),
}

/// Returns the entry at `index` and `sub_index`. `entries` must be sorted by index and sub-index, as in generated
/// tables.
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
            configured: None,
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
