//! Encodes a configuration as a concise DCF (CiA 302-3).

use super::Configuration;
use crate::node_id::NodeId;
use crate::pdo::SdoWrite;
use crate::value_error::LengthError;

/// Length in bytes of the entry count at the start of a concise DCF.
const COUNT: usize = 4;

/// Length in bytes of an entry without its value: index, sub-index and length of the value.
const HEADER: usize = 7;

impl Configuration {
    /// Encodes the configuration as a concise DCF, and returns the part of `buffer` that contains it.
    ///
    /// A CANopen manager stores the concise DCF of a node in the object 0x1F22 (CiA 302-3), at the sub-index equal to
    /// the node-ID. The manager writes the values to the node when the network starts.
    ///
    /// The concise DCF consists of the number of entries (UNSIGNED32), followed by the entries. An entry consists of
    /// index (UNSIGNED16), sub-index (UNSIGNED8), length of the value in bytes (UNSIGNED32), and the value. All numbers
    /// are little-endian.
    ///
    /// ```
    /// use lexibus::{Configuration, NodeId, SdoWrite, Setting};
    ///
    /// const CONFIGURATION: Configuration = Configuration {
    ///     communication: &[Setting::fixed(SdoWrite::new_u16(0x1017, 0x00, 1000))],
    ///     ..Configuration::EMPTY
    /// };
    ///
    /// let mut buffer = [0; CONFIGURATION.concise_dcf_len()];
    /// let concise_dcf = CONFIGURATION.concise_dcf(NodeId::new(5).unwrap(), &mut buffer)?;
    /// assert_eq!(concise_dcf, [1, 0, 0, 0, 0x17, 0x10, 0, 2, 0, 0, 0, 0xE8, 0x03]);
    /// # Ok::<(), lexibus::LengthError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Returns an error if `buffer` has fewer bytes than the [concise DCF](Self::concise_dcf_len).
    pub fn concise_dcf(self, node_id: NodeId, buffer: &mut [u8]) -> Result<&[u8], LengthError> {
        let (length, available) = (self.concise_dcf_len(), buffer.len());
        let part = buffer.get_mut(..length).ok_or(LengthError::new(length, available))?;
        part.iter_mut().zip(self.concise_dcf_bytes(node_id)).for_each(|(to, from)| *to = from);
        Ok(part)
    }

    /// Returns an iterator over the bytes of the [concise DCF](Self::concise_dcf). The iterator needs no buffer.
    pub fn concise_dcf_bytes(self, node_id: NodeId) -> impl Iterator<Item = u8> {
        let count = (self.settings().count() as u32).to_le_bytes();
        count.into_iter().chain(self.writes(node_id).flat_map(entry))
    }

    /// Returns the length of the [concise DCF](Self::concise_dcf) in bytes.
    #[must_use]
    pub const fn concise_dcf_len(&self) -> usize {
        let all = self.phases();
        let (mut length, mut phases) = (COUNT, all.as_slice());
        while let [(_, settings), rest @ ..] = phases {
            let mut settings = *settings;
            while let [setting, rest @ ..] = settings {
                if !(self.skip_defaults && setting.is_default) {
                    length += HEADER + setting.write.data().len();
                }
                settings = rest;
            }
            phases = rest;
        }
        length
    }
}

/// Returns the bytes of an entry.
fn entry(write: SdoWrite) -> impl Iterator<Item = u8> {
    let (object, length) = (write.object(), write.data().len());
    let ([index, index_high], [a, b, c, d]) = (object.index.to_le_bytes(), (length as u32).to_le_bytes());
    let header: [u8; HEADER] = [index, index_high, object.sub_index, a, b, c, d];
    header.into_iter().chain((0..length).filter_map(move |position| write.data().get(position).copied()))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{CONFIGURATION, NODE};
    use super::*;
    use std::vec::Vec;

    /// Decodes a concise DCF.
    fn decode(bytes: &[u8]) -> Vec<(u16, u8, Vec<u8>)> {
        let (count, mut rest) = bytes.split_first_chunk::<4>().unwrap();
        let mut entries = Vec::new();
        for _ in 0..u32::from_le_bytes(*count) {
            let (&[low, high, sub_index, a, b, c, d], value) = rest.split_first_chunk::<7>().unwrap();
            let (value, next) = value.split_at(u32::from_le_bytes([a, b, c, d]) as usize);
            entries.push((u16::from_le_bytes([low, high]), sub_index, value.to_vec()));
            rest = next;
        }
        assert!(rest.is_empty());
        entries
    }

    #[test]
    fn all_writes_are_encoded() {
        for configuration in [CONFIGURATION, CONFIGURATION.without_defaults(), Configuration::EMPTY] {
            let mut buffer = [0xAA; 150];
            let bytes = configuration.concise_dcf(NODE, &mut buffer).unwrap();
            assert_eq!(bytes.len(), configuration.concise_dcf_len());
            let of_write = |write: SdoWrite| (write.object().index, write.object().sub_index, write.data().to_vec());
            assert_eq!(decode(bytes), configuration.writes(NODE).map(of_write).collect::<Vec<_>>());
            assert!(configuration.concise_dcf_bytes(NODE).eq(bytes.iter().copied()));
        }
    }

    #[test]
    fn a_short_buffer_is_an_error() {
        let length = CONFIGURATION.concise_dcf_len();
        let mut buffer = [0; 150];
        let result = CONFIGURATION.concise_dcf(NODE, &mut buffer[..length - 1]);
        assert_eq!(result, Err(LengthError::new(length, length - 1)));
        assert_eq!(Configuration::EMPTY.concise_dcf(NODE, &mut buffer), Ok([0; 4].as_slice()));
    }
}
