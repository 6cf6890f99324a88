//! Facts about frames: constant bytes with their offsets, and the lengths of the data.

use std::collections::BTreeMap;

use crate::ir::owner::Owner;
use crate::ir::{Binding, Device, FieldId, MessageField, SpaceRef};

/// Facts about the data of a frame: constant bytes, lengths and misalignment. The data do not include start, checksum and end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// Constant bytes before the first field with a variable length, by byte offset.
    pub constants: BTreeMap<usize, u8>,
    /// Minimum length of the data in bits.
    pub min_bits: usize,
    /// Length of the data in bits with the maximum number of repetitions. Repeated fields without a declared maximum count once,
    /// and other fields with a variable length count with their minimum length.
    pub max_bits: usize,
    /// True if the frame can be longer than `min_bits`.
    pub is_open: bool,
    /// Bit offset of the first misalignment, if any. A misalignment is a field of whole bytes that does not start at a
    /// byte boundary, or an end of the data within a byte.
    pub broken: Option<usize>,
}

impl Frame {
    /// Creates the frame of these fields. `request` contains the fields of the request, if the frame is a reply.
    pub fn new<'d>(device: &'d Device, fields: &'d [MessageField], request: &'d [MessageField]) -> Self {
        let mut frame = Frame::default();
        let groups = [device.groups.as_slice()];
        Reader { device, owner: Owner { types: &device.types, groups: &groups }, request, frame: &mut frame, times: 1 }
            .fields(fields);
        if !frame.min_bits.is_multiple_of(8) {
            frame.broken = frame.broken.or(Some(frame.min_bits));
        }
        frame
    }

    /// Returns whether the same bytes can be valid data of both frames.
    pub fn overlaps(&self, other: &Frame) -> bool {
        let shared = self.constants.iter().filter_map(|(offset, byte)| Some((byte, other.constants.get(offset)?)));
        let mut shared = shared.peekable();
        let lengths = match (self.is_open, other.is_open) {
            (false, false) => self.min_bits == other.min_bits,
            (true, false) => self.min_bits <= other.min_bits,
            (false, true) => other.min_bits <= self.min_bits,
            (true, true) => true,
        };
        lengths && shared.all(|(one, other)| one == other)
    }

    /// Returns the first contiguous run of constant bytes.
    pub fn first_run(&self) -> Vec<u8> {
        let Some(first) = self.constants.keys().next().copied() else { return Vec::new() };
        (first..).map_while(|offset| self.constants.get(&offset).copied()).collect()
    }
}

/// Returns the length of a field in bits. Returns `None` if the length is not fixed, or is that of a field of the request.
pub(crate) fn fixed_bits(owner: Owner<'_>, field: &MessageField) -> Option<u32> {
    match field {
        MessageField::Constant(bytes) => Some(bytes.len() as u32 * 8),
        MessageField::FixedBits { bits, .. } | MessageField::ItemCode { bits, .. } => Some(u32::from(*bits)),
        MessageField::Value(value) => owner.basic(value.item.ty).bits(),
        MessageField::Echo { bytes: Some((first, last)), .. } => Some((u32::from(last.saturating_sub(*first)) + 1) * 8),
        MessageField::Copy { first, last } => Some((u32::from(last.saturating_sub(*first)) + 1) * 8),
        MessageField::Padding(bytes) => Some(u32::from(*bytes) * 8),
        _ => None,
    }
}

struct Reader<'d, 'f> {
    device: &'d Device,
    owner: Owner<'d>,
    request: &'d [MessageField],
    frame: &'f mut Frame,
    /// Maximum number of times that the current field occurs in the frame.
    times: usize,
}

impl Reader<'_, '_> {
    fn fields(&mut self, fields: &[MessageField]) {
        for field in fields {
            self.field(field);
        }
    }

    fn field(&mut self, field: &MessageField) {
        match field {
            MessageField::Constant(bytes) => {
                if !self.frame.is_open && self.frame.min_bits.is_multiple_of(8) {
                    let offset = self.frame.min_bits / 8;
                    self.frame.constants.extend(bytes.iter().enumerate().map(|(at, byte)| (offset + at, *byte)));
                }
                self.known(bytes.len() * 8);
            }
            MessageField::ItemValue { space } | MessageField::ItemPadding { space } => {
                let bits = self.shortest_value(space);
                self.open(bits);
            }
            MessageField::Repeat { max, fields, .. } => {
                let before = self.frame.min_bits;
                let outer = self.times;
                self.times = outer.saturating_mul(max.map_or(1, usize::from));
                self.frame.is_open = true;
                self.fields(fields);
                // Repeated fields may be absent, so they do not count toward the minimum length.
                self.frame.min_bits = before;
                self.times = outer;
            }
            MessageField::Echo { bytes: None, field } => match field.id.and_then(|id| self.echoed(id)) {
                Some(bits) => self.known(bits as usize),
                None => self.open(0),
            },
            field => match fixed_bits(self.owner, field) {
                Some(bits) => self.known(bits as usize),
                None => self.open(0),
            },
        }
    }

    /// Adds a field with a fixed length.
    fn known(&mut self, bits: usize) {
        if bits.is_multiple_of(8) && !self.frame.min_bits.is_multiple_of(8) {
            self.frame.broken = self.frame.broken.or(Some(self.frame.min_bits));
        }
        self.frame.min_bits += bits;
        self.frame.max_bits = self.frame.max_bits.saturating_add(bits.saturating_mul(self.times));
    }

    /// Adds a field with a minimum length.
    fn open(&mut self, bits: usize) {
        self.known(bits);
        self.frame.is_open = true;
    }

    /// Returns the length in bits of a value in the request, or `None` if the value is missing or has a variable length.
    fn echoed(&self, id: FieldId) -> Option<u32> {
        match self.request.get(id.0 as usize)? {
            MessageField::Value(value) => self.owner.basic(value.item.ty).bits(),
            _ => None,
        }
    }

    /// Returns the length in bits of the shortest value with a fixed length in a parameter space, or 0 if there is none.
    fn shortest_value(&self, space: &SpaceRef) -> usize {
        let is_in = |binding: &Binding| matches!(binding, Binding::Parameter(parameter) if parameter.space == *space);
        let items = self.device.items().filter(|item| item.bindings.iter().any(is_in));
        items.filter_map(|item| self.owner.basic(item.ty).bits()).min().unwrap_or(0) as usize
    }
}
