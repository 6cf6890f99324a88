//! Requests that read and write the PROFINET record of an item.

use super::{text, Frame, Request, Written};
use lexibus_codegen::facts::address;
use lexibus_codegen::ir::{Bus, Item, TypeDef};
use lexibus_codegen::number::hex16;

/// Titles of the requests for records, in this order: address of a read request, address of a write request, and bytes of a
/// write request.
pub(super) const TITLES: [&str; 3] = ["PROFINET record read", "PROFINET record write", "PROFINET record bytes"];

/// Maximum length in bytes of a record whose bytes are shown.
const LONGEST: usize = 256;

/// A record, and the submodule that has it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfRecord<'r> {
    /// API, slot and subslot of the submodule.
    pub submodule: &'r str,
    /// Length of the record in bytes.
    pub length: u32,
    /// Default bytes of the record; empty if unknown.
    pub default_bytes: &'r [u8],
}

impl OfRecord<'_> {
    /// Returns the address of a value in the record.
    pub fn address(&self, index: u16, bit_offset: u32, bits: u32) -> String {
        let (submodule, index, position) = (self.submodule, hex16(index), address::bits_of(bit_offset, bits));
        let length = self.length.max((bit_offset + bits).div_ceil(8));
        format!("{submodule}, index {index}, length {length}, value in {position}")
    }

    /// Returns the default bytes as text; empty if they are unknown, or if the record has more than [`LONGEST`] bytes.
    pub fn shown_bytes(&self) -> String {
        match self.default_bytes.len() {
            0..=LONGEST => text(&super::known(self.default_bytes)),
            _ => String::new(),
        }
    }

    /// Returns the requests for an item with this bit offset and length in the record with this index. A write request
    /// contains the whole record.
    pub(super) fn requests(
        &self,
        item: &Item,
        types: &[TypeDef],
        index: u16,
        bit_offset: u32,
        bits: u32,
    ) -> impl Iterator<Item = Request> {
        let access = item.access_on(Bus::Profinet);
        let address = self.address(index, bit_offset, bits);
        let written = Written::of(item, types, Bus::Profinet).filter(|_| access.writable());
        let bytes = written.as_ref().map(|written| text(&self.bytes(written, bit_offset, bits)));
        let bytes = bytes.filter(|bytes| !bytes.is_empty() && !self.shown_bytes().is_empty());
        let texts = [access.readable().then(|| address.clone()), written.map(|_| address), bytes];
        TITLES.into_iter().zip(texts).filter_map(|(title, text)| Some((title, text?)))
    }

    /// Returns the default bytes of the record. If the written value is unknown, the bytes that contain it are `None`.
    fn bytes(&self, written: &Written, bit_offset: u32, bits: u32) -> Frame {
        let mut bytes = super::known(self.default_bytes);
        if written.known().is_none() {
            let (first, end) = (bit_offset / 8, (bit_offset + bits).div_ceil(8));
            bytes.iter_mut().take(end as usize).skip(first as usize).for_each(|byte| *byte = None);
        }
        bytes
    }
}
