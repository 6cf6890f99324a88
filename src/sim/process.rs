//! Process data of a simulated device: PDOs and process images.

use std::vec;
use std::vec::Vec;

use super::device::Device;
use super::values;
use crate::abort::AbortCode;
use crate::bits;
use crate::bus::Object;
use crate::pdo::MappedEntry;

/// Returns the field of `width` bits of `data` at bit offset `bit`.
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
    /// Returns the current mapping of the PDO with the mapping object `index` ([`Pdo::INDEX`](crate::Pdo::INDEX)).
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::NO_OBJECT`] if the mapping object doesn't exist, or [`AbortCode::NO_SUB_INDEX`] if one of
    /// its entries doesn't exist.
    pub fn mapping(&self, index: u16) -> Result<Vec<MappedEntry>, AbortCode> {
        let words = self.listed(index)?;
        Ok(words.into_iter().map(|word| MappedEntry::from_word(word as u32)).collect())
    }

    /// Returns the entries of an object. Sub-index 0 contains the number of entries.
    fn listed(&self, index: u16) -> Result<Vec<u64>, AbortCode> {
        let count = self.slots.number(index, 0).ok_or(AbortCode::NO_OBJECT)?;
        let count = u8::try_from(count).map_err(|_| AbortCode::NO_SUB_INDEX)?;
        (1..=count).map(|sub| self.slots.number(index, sub).ok_or(AbortCode::NO_SUB_INDEX)).collect()
    }

    /// Processes a received PDO with the mapping object `index`, even if the PDO is disabled. Bytes after the mapped
    /// objects are ignored.
    ///
    /// All values are written before the first reaction is called.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`mapping`](Self::mapping), and [`AbortCode::TOO_SHORT`] if bytes are missing. In these
    /// cases, nothing is written. If the device refuses values, the method returns the abort code of the first refused
    /// value, and writes the other values.
    pub fn receive_pdo(&mut self, index: u16, data: &[u8]) -> Result<(), AbortCode> {
        let mapping = self.mapping(index)?;
        self.receive_mapped(&mapping, data)
    }

    /// Returns the current data of the PDO with the mapping object `index`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`mapping`](Self::mapping), or an abort code if the device doesn't have a mapped object.
    pub fn transmit_pdo(&self, index: u16) -> Result<Vec<u8>, AbortCode> {
        self.transmit_mapped(&self.mapping(index)?)
    }

    /// Processes a received process image of an EtherCAT sync manager. The image consists of the PDOs in the assignment
    /// object `assignment`, for example 0x1C12.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`receive_pdo`](Self::receive_pdo).
    pub fn receive_image(&mut self, assignment: u16, data: &[u8]) -> Result<(), AbortCode> {
        let mapping = self.assigned(assignment)?;
        self.receive_mapped(&mapping, data)
    }

    /// Returns the current process image of an EtherCAT sync manager. The image consists of the PDOs in the assignment
    /// object `assignment`, for example 0x1C13.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`transmit_pdo`](Self::transmit_pdo).
    pub fn transmit_image(&self, assignment: u16) -> Result<Vec<u8>, AbortCode> {
        self.transmit_mapped(&self.assigned(assignment)?)
    }

    fn assigned(&self, assignment: u16) -> Result<Vec<MappedEntry>, AbortCode> {
        let mappings = self.listed(assignment)?.into_iter().map(|index| self.mapping(index as u16));
        Ok(mappings.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Processes received data that contain the objects in `mapping`. This method is for a PDO without a mapping object
    /// ([`Pdo::MAPPING`](crate::Pdo::MAPPING)).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`receive_pdo`](Self::receive_pdo).
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

    /// Writes a mapped object, and returns its position and its old value.
    fn take(&mut self, object: Object, bytes: Vec<u8>) -> Result<(usize, Vec<u8>), AbortCode> {
        let at = self.slots.of_object(object)?;
        let entry = self.slots.get(at).entry;
        values::check_length(&entry, &bytes)?;
        values::check_range(&entry, &bytes)?;
        Ok((at, self.store(at, bytes)))
    }

    /// Returns the current data of the objects in `mapping`. This method is for a PDO without a mapping object.
    ///
    /// # Errors
    ///
    /// Returns an abort code if the device doesn't have a mapped object.
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

/// Returns whether an entry is a placeholder for unused bits. A placeholder has index 0 or the index of a data type.
const fn is_gap(entry: MappedEntry) -> bool {
    entry.index <= 0x1F
}
