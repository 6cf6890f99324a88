//! The PDO configuration objects (0x1600 to 0x1BFF, and from 0x1C10; ETG.1000.6 5.6.7.4), and the copying of data
//! between mapped objects and process data.

use std::collections::BTreeMap;

use lexibus::ethercat::{Device, Direction};
use lexibus::{AbortCode, MappedEntry};

use super::objects::Dictionary;

/// Abort code for a sub-index that is only writable if sub-index 0 is 0 (ETG.1000.6 table 41).
const COUNT_IS_NOT_ZERO: u32 = 0x0601_0003;

/// A list object: the value of sub-index 0, and the entries.
struct List {
    count: usize,
    entries: Vec<u32>,
    /// Length of an entry in bytes.
    width: usize,
    writable: bool,
}

impl List {
    fn new(entries: Vec<u32>, width: usize, writable: bool) -> Self {
        Self { count: entries.len(), entries, width, writable }
    }

    fn valid(&self) -> &[u32] {
        &self.entries[..self.count]
    }
}

/// The PDO mappings and assignments of a device.
pub struct Pdos {
    device: &'static Device,
    lists: BTreeMap<u16, List>,
}

impl Pdos {
    /// Creates the PDO configuration after power-on.
    pub fn new(device: &'static Device) -> Self {
        let coe = device.mailbox.coe;
        let (assigns, configures) = (coe.is_some_and(|coe| coe.pdo_assign), coe.is_some_and(|coe| coe.pdo_config));
        let mut lists = BTreeMap::new();
        for pdo in device.pdos {
            let words = pdo.mapping.iter().map(|entry| entry.word()).collect();
            lists.insert(pdo.index, List::new(words, 4, configures && !pdo.fixed));
        }
        for manager in device.sync_managers.iter().filter(|manager| manager.carries_data()) {
            let defaults = device.default_pdos.iter().filter_map(|index| device.pdo(*index));
            let assigned = defaults.filter(|pdo| device.sync_manager_of(pdo) == Some(manager.number));
            let indices = assigned.map(|pdo| u32::from(pdo.index)).collect();
            lists.insert(manager.assignment(), List::new(indices, 2, assigns));
        }
        Self { device, lists }
    }

    pub fn has(&self, index: u16) -> bool {
        self.lists.contains_key(&index)
    }

    pub fn read(&self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        let list = self.lists.get(&index).ok_or(AbortCode::NO_OBJECT.0)?;
        match usize::from(sub_index) {
            0 => Ok(vec![list.count as u8]),
            sub => {
                let entry = list.valid().get(sub - 1).ok_or(AbortCode::NO_SUB_INDEX.0)?;
                Ok(entry.to_le_bytes()[..list.width].to_vec())
            }
        }
    }

    /// Writes an entry of a PDO configuration object. `is_mappable` returns whether an object exists.
    pub fn write(
        &mut self,
        index: u16,
        sub_index: u8,
        data: &[u8],
        is_mappable: impl FnOnce(MappedEntry) -> bool,
    ) -> Result<(), u32> {
        let device = self.device;
        let list = self.lists.get_mut(&index).ok_or(AbortCode::NO_OBJECT.0)?;
        if !list.writable {
            return Err(AbortCode::READ_ONLY.0);
        }
        if data.len() != if sub_index == 0 { 1 } else { list.width } {
            return Err(AbortCode::LENGTH.0);
        }
        let number = data.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
        if sub_index == 0 {
            return self.count(index, number as usize);
        }
        if list.count != 0 {
            return Err(COUNT_IS_NOT_ZERO);
        }
        match list.width {
            2 if device.pdo(number as u16).is_none() => return Err(AbortCode::NO_OBJECT.0),
            4 if !is_mappable(MappedEntry::from_word(number)) => return Err(AbortCode::NOT_MAPPABLE.0),
            _ => {}
        }
        let at = usize::from(sub_index) - 1;
        list.entries.resize(list.entries.len().max(at + 1), 0);
        list.entries[at] = number;
        Ok(())
    }

    /// Sets sub-index 0 of a list, which is the number of entries.
    fn count(&mut self, index: u16, count: usize) -> Result<(), u32> {
        let device = self.device;
        let list = self.lists.get_mut(&index).ok_or(AbortCode::NO_OBJECT.0)?;
        let entries = list.entries.get(..count).ok_or(AbortCode::INVALID_VALUE.0)?;
        if list.width == 2 {
            let pdos: Vec<_> = entries.iter().filter_map(|entry| device.pdo(*entry as u16)).collect();
            let excludes = |one: usize| pdos[one + 1..].iter().any(|other| pdos[one].conflicts_with(other));
            if (0..pdos.len()).any(excludes) {
                return Err(AbortCode::PARAMETER_INCOMPATIBLE.0);
            }
        }
        list.count = count;
        Ok(())
    }

    /// Returns the entries that are mapped into a sync manager, in the order of its process data.
    fn mapped(&self, manager: u8) -> impl Iterator<Item = (Option<Direction>, MappedEntry)> + '_ {
        let valid = |index: u16| self.lists.get(&index).map_or(&[][..], List::valid);
        let assigned = valid(0x1C10 + u16::from(manager)).iter();
        assigned.flat_map(move |pdo| {
            let direction = self.device.pdo(*pdo as u16).map(|pdo| pdo.direction);
            valid(*pdo as u16).iter().map(move |word| (direction, MappedEntry::from_word(*word)))
        })
    }

    /// Returns the length in bytes of a sync manager's process data.
    pub fn bytes(&self, manager: u8) -> usize {
        self.mapped(manager).map(|(_, entry)| entry.bits as usize).sum::<usize>().div_ceil(8)
    }

    /// Copies objects to the process data of a sync manager.
    pub fn gather(&self, manager: u8, objects: &mut dyn Dictionary) -> Vec<u8> {
        let mut data = vec![0; self.bytes(manager)];
        let mut at = 0;
        for (_, entry) in self.mapped(manager) {
            let value = objects.read(entry.index, entry.sub_index).unwrap_or_default();
            for bit in 0..entry.bits as usize {
                set(&mut data, at + bit, get(&value, bit));
            }
            at += entry.bits as usize;
        }
        data
    }

    /// Copies the process data of a sync manager to objects. Ignores values outside their allowed range.
    pub fn scatter(&self, manager: u8, data: &[u8], objects: &mut dyn Dictionary) {
        let mut at = 0;
        for (direction, entry) in self.mapped(manager) {
            let mut value = vec![0; entry.bits.div_ceil(8) as usize];
            for bit in 0..entry.bits as usize {
                set(&mut value, bit, get(data, at + bit));
            }
            at += entry.bits as usize;
            if direction == Some(Direction::Output) && entry.index != 0 {
                let _ = objects.write(entry.index, entry.sub_index, &value);
            }
        }
    }
}

fn get(bytes: &[u8], bit: usize) -> bool {
    bytes.get(bit / 8).is_some_and(|byte| byte >> (bit % 8) & 1 != 0)
}

fn set(bytes: &mut [u8], bit: usize, value: bool) {
    bytes[bit / 8] |= u8::from(value) << (bit % 8);
}
