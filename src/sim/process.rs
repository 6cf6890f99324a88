//! Process data: what PDOs carry into a device and out of it.

use std::vec;
use std::vec::Vec;

use super::device::Device;
use super::values;
use crate::abort::AbortCode;
use crate::bits;
use crate::bus::Object;
use crate::pdo::MappedEntry;

/// `width` bits of `data` from `bit` on.
fn field(data: &[u8], bit: usize, width: usize) -> Vec<u8> {
    let part = |from: usize| bits::get(data, bit + from, (width - from).min(8) as u32) as u8;
    (0..width).step_by(8).map(part).collect()
}

pub(super) const fn length(bits: usize) -> usize {
    bits.div_ceil(8)
}

pub(super) fn width(mapping: &[MappedEntry]) -> usize {
    mapping.iter().map(|entry| entry.bits as usize).sum()
}

impl Device {
    /// What the PDO with the mapping object `index` carries at present ([`Pdo::INDEX`](crate::Pdo::INDEX)).
    ///
    /// # Errors
    ///
    /// [`AbortCode::NO_OBJECT`] where there is no such mapping.
    pub fn mapping(&self, index: u16) -> Result<Vec<MappedEntry>, AbortCode> {
        let words = self.listed(index)?;
        Ok(words.into_iter().map(|word| MappedEntry::from_word(word as u32)).collect())
    }

    /// The numbers in the sub-indices of an object, of which sub-index 0 says how many there are.
    fn listed(&self, index: u16) -> Result<Vec<u64>, AbortCode> {
        let count = self.slots.number(index, 0).ok_or(AbortCode::NO_OBJECT)?;
        let count = u8::try_from(count).map_err(|_| AbortCode::NO_SUB_INDEX)?;
        (1..=count).map(|sub| self.slots.number(index, sub).ok_or(AbortCode::NO_SUB_INDEX)).collect()
    }

    /// The device receives a PDO with the mapping object `index`, whether it is used at present or not. Bytes behind the
    /// mapped ones are passed over.
    ///
    /// All values are there before anything reacts to one of them.
    ///
    /// # Errors
    ///
    /// [`AbortCode::TOO_SHORT`] where bytes are missing; nothing is written then. What a single value is refused with:
    /// the first one's code, where several are. The others are written.
    pub fn receive_pdo(&mut self, index: u16, data: &[u8]) -> Result<(), AbortCode> {
        let mapping = self.mapping(index)?;
        self.receive_mapped(&mapping, data)
    }

    /// The PDO with the mapping object `index`, as the device would send it now.
    ///
    /// # Errors
    ///
    /// Those of [`mapping`](Self::mapping), and what is wrong with a mapped object that the device doesn't have.
    pub fn transmit_pdo(&self, index: u16) -> Result<Vec<u8>, AbortCode> {
        self.transmit_mapped(&self.mapping(index)?)
    }

    /// The device receives the process image of a sync manager of EtherCAT: the PDOs that `assignment` lists (0x1C12), one
    /// behind the other.
    ///
    /// # Errors
    ///
    /// Those of [`receive_pdo`](Self::receive_pdo).
    pub fn receive_image(&mut self, assignment: u16, data: &[u8]) -> Result<(), AbortCode> {
        let mapping = self.assigned(assignment)?;
        self.receive_mapped(&mapping, data)
    }

    /// The process image of a sync manager of EtherCAT, as the device would send it now: the PDOs that `assignment` lists
    /// (0x1C13), one behind the other.
    ///
    /// # Errors
    ///
    /// Those of [`transmit_pdo`](Self::transmit_pdo).
    pub fn transmit_image(&self, assignment: u16) -> Result<Vec<u8>, AbortCode> {
        self.transmit_mapped(&self.assigned(assignment)?)
    }

    fn assigned(&self, assignment: u16) -> Result<Vec<MappedEntry>, AbortCode> {
        let mappings = self.listed(assignment)?.into_iter().map(|index| self.mapping(index as u16));
        Ok(mappings.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// The device receives these entries, of a PDO that has no mapping object ([`Pdo::MAPPING`](crate::Pdo::MAPPING)), say.
    ///
    /// # Errors
    ///
    /// Those of [`receive_pdo`](Self::receive_pdo).
    pub fn receive_mapped(&mut self, mapping: &[MappedEntry], data: &[u8]) -> Result<(), AbortCode> {
        if data.len() < length(width(mapping)) {
            return Err(AbortCode::TOO_SHORT);
        }
        let (mut bit, mut result, mut written) = (0, Ok(()), Vec::new());
        for entry in mapping {
            let bits = entry.bits as usize;
            if !is_gap(*entry) {
                match self.take(entry.object(), field(data, bit, bits)) {
                    Ok(at) => written.push(at),
                    Err(code) => result = result.and(Err(code)),
                }
            }
            bit += bits;
        }
        for (at, old) in written {
            if let Err(code) = self.react(at) {
                self.store(at, old);
                result = result.and(Err(code));
            }
        }
        result
    }

    /// Gives a mapped object its value, and returns its position and the old one.
    fn take(&mut self, object: Object, bytes: Vec<u8>) -> Result<(usize, Vec<u8>), AbortCode> {
        let at = self.slots.of_object(object)?;
        let entry = self.slots.get(at).entry;
        values::check_length(&entry, &bytes)?;
        values::check_range(&entry, &bytes)?;
        Ok((at, self.store(at, bytes)))
    }

    /// These entries, of a PDO that has no mapping object, as the device would send them now.
    ///
    /// # Errors
    ///
    /// What is wrong with a mapped object that the device doesn't have.
    pub fn transmit_mapped(&self, mapping: &[MappedEntry]) -> Result<Vec<u8>, AbortCode> {
        let (mut data, mut bit) = (vec![0; length(width(mapping))], 0);
        for entry in mapping {
            let bits = entry.bits as usize;
            if !is_gap(*entry) {
                bits::set_bits(&mut data, bit, bits, self.bytes(entry.object())?);
            }
            bit += bits;
        }
        Ok(data)
    }
}

/// Whether an entry stands for bits that are no object's: index 0, or a type of the dictionary.
const fn is_gap(entry: MappedEntry) -> bool {
    entry.index <= 0x1F
}
