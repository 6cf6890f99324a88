//! All items of a device as data, for programs that list them or look them up at run time, and for simulated devices.

use crate::bus::Object;
use crate::data_type::DataType;
use crate::flags::Flags;
use crate::register::Register;

/// One item: an entry of the object dictionary, a register, or both in one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Where it is in the object dictionary; `None` of a register that is no object.
    pub object: Option<Object>,
    /// Where it is on Modbus; `None` of an object that is no register.
    pub register: Option<Register>,
    /// The name in the source.
    pub name: &'static str,
    /// The type of the value.
    pub data_type: DataType,
    /// What the device allows.
    pub access: AccessRights,
    /// What else is known.
    pub flags: Flags,
    /// The value after power-on.
    pub initial: RawInitial,
    /// The lowest value that a write accepts.
    pub low: Bound,
    /// The highest value that a write accepts.
    pub high: Bound,
    /// The unit of the value; empty where there is none.
    pub unit: &'static str,
}

/// What a device allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AccessRights {
    /// Reading (`ro`).
    ReadOnly,
    /// Writing (`wo`).
    WriteOnly,
    /// Both (`rw`, `rwr`, `rww`).
    ReadWrite,
    /// Reading, and the value never changes (`const`).
    Constant,
}

/// The value after power-on, as the device would send it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RawInitial {
    /// The description of the device gives none.
    Unknown,
    /// These bytes.
    Bytes(&'static [u8]),
    /// The node-ID plus this number.
    NodeId(u64),
}

/// One limit of a range; it belongs to the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// What the type can hold.
    Unlimited,
    /// The limit of a signed integer.
    Signed(i64),
    /// The limit of an unsigned integer.
    Unsigned(u64),
    /// The limit of a floating-point number.
    Real(f64),
}

/// The entry at `index` and `sub_index`. `entries` are in ascending order of their objects, as generated tables are.
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
