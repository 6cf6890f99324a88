//! The whole dictionary as data, for programs that list it or look entries up at run time.

use crate::data_type::DataType;
use crate::flags::Flags;

/// One entry of an object dictionary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The object's index.
    pub index: u16,
    /// The entry's sub-index.
    pub sub_index: u8,
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

/// The entry at `index` and `sub_index`. `entries` are in ascending order of both, as generated tables are.
#[must_use]
pub fn find(entries: &[Entry], index: u16, sub_index: u8) -> Option<&Entry> {
    let at = entries.binary_search_by_key(&(index, sub_index), |entry| (entry.index, entry.sub_index)).ok()?;
    entries.get(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn entry(index: u16, sub_index: u8, name: &'static str) -> Entry {
        Entry {
            index,
            sub_index,
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

    static ENTRIES: [Entry; 3] = [entry(0x1000, 0, "a"), entry(0x1018, 0, "b"), entry(0x1018, 1, "c")];

    #[test]
    fn finds_by_index_and_sub_index() {
        assert_eq!(find(&ENTRIES, 0x1018, 1).map(|entry| entry.name), Some("c"));
        assert_eq!(find(&ENTRIES, 0x1000, 0).map(|entry| entry.name), Some("a"));
        assert_eq!(find(&ENTRIES, 0x1000, 1), None);
        assert_eq!(find(&[], 0x1000, 0), None);
    }
}
