//! Checks of client writes to PDO parameters (CiA 301 7.5.2.35 to 7.5.2.38).

use super::device::{Device, Network};
use super::values;
use crate::abort::AbortCode;
use crate::bus::Object;
use crate::flags::Flags;
use crate::pdo::{from_bytes, is_restricted, MappedEntry};

/// Abort code for a write to a mapping whose sub-index 0 isn't 0 (ETG.1000.6).
const COUNT_NOT_ZERO: AbortCode = AbortCode(0x0601_0003);

/// COB-ID bit that is set while a PDO is disabled.
const UNUSED: u64 = 1 << 31;
/// COB-ID bits that can change only while the PDO is disabled: the CAN-ID, and bit 29 for 29-bit CAN-IDs.
const IDENTIFIER: u64 = 0x3FFF_FFFF;

/// Maximum SYNC start value.
const MAX_SYNC_START: u64 = 240;

/// Maximum number of bits in a CAN frame.
const FRAME_BITS: u32 = 64;

fn require(condition: bool, code: AbortCode) -> Result<(), AbortCode> {
    if condition {
        Ok(())
    } else {
        Err(code)
    }
}

impl Device {
    /// Checks a write by a client. Writes to all objects except PDO parameters are accepted.
    pub(super) fn check_pdo_parameter(&self, network: Network, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        let value = from_bytes(data);
        match object.index {
            // EtherCAT has sync managers instead of communication parameters.
            0x1400..=0x15FF | 0x1800..=0x19FF if network == Network::CanOpen => self.check_communication(object, value),
            0x1600..=0x17FF | 0x1A00..=0x1BFF => self.check_mapping(network, object, value),
            _ => Ok(()),
        }
    }

    /// Returns whether a PDO is enabled. `communication` is the index of the PDO's communication parameters.
    pub(super) fn is_used(&self, communication: u16) -> bool {
        self.slots.number(communication, 1).is_some_and(|cob_id| cob_id & UNUSED == 0)
    }

    fn check_communication(&self, object: Object, value: u64) -> Result<(), AbortCode> {
        let (is_used, is_transmitted) = (self.is_used(object.index), object.index >= 0x1800);
        match object.sub_index {
            1 if value & UNUSED == 0 => {
                let old = self.slots.number(object.index, 1).unwrap_or(UNUSED);
                let is_same = (old ^ value) & IDENTIFIER == 0;
                let is_possible = !is_restricted((value & IDENTIFIER) as u32);
                require(is_possible && (is_same || !is_used), AbortCode::INVALID_VALUE)
            }
            2 => {
                let is_reserved = matches!(value, 241..=251) || !is_transmitted && matches!(value, 252 | 253);
                require(!is_reserved, AbortCode::INVALID_VALUE)
            }
            // Inhibit time.
            3 if is_transmitted => require(!is_used, AbortCode::INVALID_VALUE),
            // SYNC start value.
            6 if is_transmitted => require(!is_used && value <= MAX_SYNC_START, AbortCode::INVALID_VALUE),
            _ => Ok(()),
        }
    }

    fn check_mapping(&self, network: Network, object: Object, value: u64) -> Result<(), AbortCode> {
        let Object { index, sub_index } = object;
        let is_on_can = network == Network::CanOpen;
        require(!(is_on_can && self.is_used(index - 0x200)), AbortCode::INVALID_VALUE)?;
        if sub_index > 0 {
            let refused = if is_on_can { AbortCode::INVALID_VALUE } else { COUNT_NOT_ZERO };
            require(self.slots.number(index, 0) == Some(0), refused)?;
            return self.check_mapped(network, index, MappedEntry::from_word(value as u32)).map(|_| ());
        }
        let mut bits: u32 = 0;
        for sub_index in 1..=value {
            let word = u8::try_from(sub_index).ok().and_then(|sub_index| self.slots.number(index, sub_index));
            let entry = MappedEntry::from_word(word.ok_or(AbortCode::INVALID_VALUE)? as u32);
            bits += self.check_mapped(network, index, entry)?;
        }
        require(!is_on_can || bits <= FRAME_BITS, AbortCode::PDO_LENGTH)?;
        require(value == 0 || bits > 0, AbortCode::INVALID_VALUE)
    }

    /// Checks that the mapping object `index` can contain an entry, and returns the length of the entry in bits.
    fn check_mapped(&self, network: Network, index: u16, entry: MappedEntry) -> Result<u32, AbortCode> {
        let is_received = index < 0x1800;
        let is_gap = match network {
            // Data types serve as dummy entries, which are placeholders for unused bits.
            Network::CanOpen => entry.word() == 0 || is_received && matches!(entry.index, 1..=0x1F),
            Network::EtherCat => entry.index == 0,
        };
        if is_gap {
            return Ok(entry.bits);
        }
        let mapped = &self.slots.get(self.slots.of_object(entry.object())?).entry;
        let needed = if is_received { Flags::RPDO } else { Flags::TPDO };
        require(mapped.flags.contains(needed), AbortCode::NOT_MAPPABLE)?;
        let bytes = values::byte_length(mapped.data_type).map(|length| 8 * length as u32);
        let fits = match (mapped.data_type.bits(), bytes) {
            (Some(bits), Some(bytes)) => entry.bits == bits || entry.bits == bytes,
            _ => entry.bits > 0 && entry.bits % 8 == 0,
        };
        require(fits, AbortCode::NOT_MAPPABLE)?;
        Ok(entry.bits)
    }
}
