//! The objects of a device.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use lexibus::table::{Bound, RawInitial};
use lexibus::{AbortCode, AccessRights, Entry};

/// What the application of a device provides. Values are bytes, the least significant first; errors are the abort codes of
/// SDO transfers.
pub trait Dictionary {
    /// The value of an entry.
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32>;

    /// Changes the value of an entry.
    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32>;

    /// The application runs once, between outputs and inputs. `operational` where the outputs count.
    fn cycle(&mut self, _operational: bool) {}

    /// The next emergency message that waits to be sent: code, register, and five bytes of the manufacturer.
    fn emergency(&mut self) -> Option<[u8; 8]> {
        None
    }
}

/// A device that a test looks into while the segment runs.
impl<D: Dictionary> Dictionary for Rc<RefCell<D>> {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        self.borrow_mut().read(index, sub_index)
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        self.borrow_mut().write(index, sub_index, data)
    }

    fn cycle(&mut self, operational: bool) {
        self.borrow_mut().cycle(operational);
    }

    fn emergency(&mut self) -> Option<[u8; 8]> {
        self.borrow_mut().emergency()
    }
}

/// The entries of a generated table with their values.
pub struct Table {
    entries: &'static [Entry],
    values: BTreeMap<(u16, u8), Vec<u8>>,
}

impl Table {
    /// The values after power-on; zero where the table doesn't tell.
    pub fn new(entries: &'static [Entry]) -> Self {
        let value = |entry: &Entry| match entry.initial {
            RawInitial::Bytes(bytes) => bytes.to_vec(),
            _ => vec![0; size(entry).unwrap_or(0)],
        };
        let object = |entry: &Entry| entry.object.map(|object| ((object.index, object.sub_index), value(entry)));
        Self { entries, values: entries.iter().filter_map(object).collect() }
    }

    /// The value of an entry as a number, whatever its access rights are; 0 where there is none.
    pub fn get(&self, index: u16, sub_index: u8) -> i64 {
        self.values.get(&(index, sub_index)).map_or(0, |bytes| signed(bytes))
    }

    /// Changes the value of an entry, whatever its access rights are.
    pub fn set(&mut self, index: u16, sub_index: u8, number: i64) {
        if let Some(bytes) = self.values.get_mut(&(index, sub_index)) {
            bytes.iter_mut().zip(number.to_le_bytes()).for_each(|(to, from)| *to = from);
        }
    }

    fn entry(&self, index: u16, sub_index: u8) -> Result<&'static Entry, u32> {
        let missing = || match self.entries.iter().any(|entry| entry.object.is_some_and(|object| object.index == index))
        {
            true => AbortCode::NO_SUB_INDEX.0,
            false => AbortCode::NO_OBJECT.0,
        };
        lexibus::table::find(self.entries, index, sub_index).ok_or_else(missing)
    }
}

impl Dictionary for Table {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        let entry = self.entry(index, sub_index)?;
        match entry.access {
            AccessRights::WriteOnly => Err(AbortCode::WRITE_ONLY.0),
            _ => Ok(self.values.get(&(index, sub_index)).cloned().unwrap_or_default()),
        }
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        let entry = self.entry(index, sub_index)?;
        if matches!(entry.access, AccessRights::ReadOnly | AccessRights::Constant) {
            return Err(AbortCode::READ_ONLY.0);
        }
        match size(entry) {
            Some(size) if data.len() > size => return Err(AbortCode::TOO_LONG.0),
            Some(size) if data.len() < size => return Err(AbortCode::TOO_SHORT.0),
            _ => {}
        }
        if exceeds(entry.high, data, |value, limit| value > limit) {
            return Err(AbortCode::TOO_HIGH.0);
        }
        if exceeds(entry.low, data, |value, limit| value < limit) {
            return Err(AbortCode::TOO_LOW.0);
        }
        self.values.insert((index, sub_index), data.to_vec());
        Ok(())
    }
}

fn size(entry: &Entry) -> Option<usize> {
    entry.data_type.bits().map(|bits| bits.div_ceil(8) as usize)
}

fn exceeds(limit: Bound, data: &[u8], is_beyond: fn(i128, i128) -> bool) -> bool {
    match limit {
        Bound::Signed(limit) => is_beyond(i128::from(signed(data)), i128::from(limit)),
        Bound::Unsigned(limit) => is_beyond(i128::from(unsigned(data)), i128::from(limit)),
        Bound::Real(_) | Bound::Unlimited => false,
    }
}

fn unsigned(bytes: &[u8]) -> u64 {
    bytes.iter().take(8).rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}

fn signed(bytes: &[u8]) -> i64 {
    let unused = 64 - 8 * bytes.len().clamp(1, 8) as u32;
    ((unsigned(bytes) << unused) as i64) >> unused
}
