//! PDO mappings.

use crate::bus::Object;
use crate::ethercat::DependsOn;

/// One entry of a PDO mapping (CiA 301 7.5.2.36 and 7.5.2.38).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MappedEntry {
    /// Index of the mapped object.
    pub index: u16,
    /// Sub-index of the mapped object.
    pub sub_index: u8,
    /// Slot dependency of the index, for a module of an EtherCAT slave.
    pub depends_on: DependsOn,
    /// Length in bits. In a mapping object, the length is at most 255. A read-only mapping may have longer entries.
    pub bits: u32,
}

impl MappedEntry {
    /// Creates an entry whose index doesn't depend on a slot.
    #[must_use]
    pub const fn new(index: u16, sub_index: u8, bits: u32) -> Self {
        Self::depending_on(index, sub_index, bits, DependsOn::Nothing)
    }

    /// Creates an entry whose index depends on the slot of its module. `index` is the index in slot 0.
    #[must_use]
    pub const fn in_slot(index: u16, sub_index: u8, bits: u32) -> Self {
        Self::depending_on(index, sub_index, bits, DependsOn::Slot)
    }

    /// Creates an entry whose index depends on the slot or the slot group of its module.
    #[must_use]
    pub const fn depending_on(index: u16, sub_index: u8, bits: u32, depends_on: DependsOn) -> Self {
        Self { index, sub_index, depends_on, bits }
    }

    /// Returns the entry, encoded as in the mapping object: index, sub-index and length in bits, with the index in the
    /// most significant bytes.
    #[must_use]
    pub const fn word(self) -> u32 {
        (self.index as u32) << 16 | (self.sub_index as u32) << 8 | self.bits & 0xFF
    }

    /// Creates an entry from its representation in a mapping object.
    #[must_use]
    pub const fn from_word(word: u32) -> Self {
        Self::new((word >> 16) as u16, (word >> 8) as u8, word & 0xFF)
    }

    /// Returns the mapped object.
    #[must_use]
    pub const fn object(self) -> Object {
        Object { index: self.index, sub_index: self.sub_index }
    }
}

/// A PDO with a known layout. Generated code and [`pdo!`](crate::pdo!) implement this trait.
pub trait Pdo {
    /// Index of the mapping object, 0x1600 to 0x17FF or 0x1A00 to 0x1BFF.
    const INDEX: u16;

    /// Mapped entries, in ascending order of their bit offsets.
    const MAPPING: &'static [MappedEntry];

    /// Length in bytes.
    const LEN: usize;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words() {
        let entry = MappedEntry::new(0x6040, 1, 16);
        assert_eq!(entry.word(), 0x6040_0110);
        assert_eq!(MappedEntry::from_word(0x6040_0110), entry);
        assert_eq!(MappedEntry::in_slot(0x6040, 1, 16), MappedEntry { depends_on: DependsOn::Slot, ..entry });
        assert_eq!(entry.object(), Object { index: 0x6040, sub_index: 1 });
    }
}
