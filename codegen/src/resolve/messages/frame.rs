//! Frames of messages as far as their bytes are fixed: constants at their places, and lengths.

use std::collections::BTreeMap;

use crate::ir::owner::Owner;
use crate::ir::{Binding, Device, MessageField};

/// A frame: its data, without start, check and end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// The constant bytes up to the first field of unknown length, by their place.
    pub constants: BTreeMap<usize, u8>,
    /// The least length in bits.
    pub least: usize,
    /// The greatest number of bits that a frame needs for all repetitions that it declares.
    pub most: usize,
    /// Whether it can be longer than `least`.
    pub is_open: bool,
    /// The first bit of a field that doesn't begin with a byte though it has whole bytes, or of the end.
    pub broken: Option<usize>,
}

impl Frame {
    /// The frame of these fields; `request` is the one that a reply answers.
    pub fn new<'d>(device: &'d Device, fields: &'d [MessageField], request: &'d [MessageField]) -> Self {
        let mut frame = Frame::default();
        let groups = [device.groups.as_slice()];
        Reader { device, owner: Owner { types: &device.types, groups: &groups }, request, frame: &mut frame, times: 1 }
            .fields(fields);
        if !frame.least.is_multiple_of(8) {
            frame.broken = frame.broken.or(Some(frame.least));
        }
        frame
    }

    /// Whether some bytes are frames of both kinds.
    pub fn overlaps(&self, other: &Frame) -> bool {
        let shared = self.constants.iter().filter_map(|(place, byte)| Some((byte, other.constants.get(place)?)));
        let mut shared = shared.peekable();
        let lengths = match (self.is_open, other.is_open) {
            (false, false) => self.least == other.least,
            (true, false) => self.least <= other.least,
            (false, true) => other.least <= self.least,
            (true, true) => true,
        };
        lengths && shared.all(|(one, other)| one == other)
    }

    /// The constants that stand together first.
    pub fn first_run(&self) -> Vec<u8> {
        let Some(first) = self.constants.keys().next().copied() else { return Vec::new() };
        (first..).map_while(|place| self.constants.get(&place).copied()).collect()
    }
}

struct Reader<'d, 'f> {
    device: &'d Device,
    owner: Owner<'d>,
    request: &'d [MessageField],
    frame: &'f mut Frame,
    /// How often what is read occurs at most.
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
                if !self.frame.is_open && self.frame.least.is_multiple_of(8) {
                    let place = self.frame.least / 8;
                    self.frame.constants.extend(bytes.iter().enumerate().map(|(at, byte)| (place + at, *byte)));
                }
                self.known(bytes.len() * 8);
            }
            MessageField::FixedBits { bits, .. } => self.known(usize::from(*bits)),
            MessageField::Value(value) => match self.owner.basic(value.item.ty).bits() {
                Some(bits) => self.known(bits as usize),
                None => self.open(0),
            },
            MessageField::Echo { bytes: Some((first, last)), .. } => {
                self.known((usize::from(*last) - usize::from(*first.min(last)) + 1) * 8);
            }
            MessageField::Copy { first, last } => {
                self.known((usize::from(*last) - usize::from(*first.min(last)) + 1) * 8);
            }
            MessageField::Echo { bytes: None, field } => match self.echoed(field) {
                Some(bits) => self.known(bits as usize),
                None => self.open(0),
            },
            MessageField::ItemCode { bits, .. } => self.known(usize::from(*bits)),
            MessageField::ItemValue { space } | MessageField::ItemPadding { space } => {
                let least = self.least_value(space);
                self.open(least);
            }
            MessageField::Padding(bytes) => self.known(usize::from(*bytes) * 8),
            MessageField::Repeat { max, fields, .. } => {
                let before = self.frame.least;
                let outer = self.times;
                self.times = outer.saturating_mul(max.map_or(1, usize::from));
                self.frame.is_open = true;
                self.fields(fields);
                // None of them is a frame, too.
                self.frame.least = before;
                self.times = outer;
            }
            MessageField::Rest => self.open(0),
        }
    }

    /// A field of so many bits.
    fn known(&mut self, bits: usize) {
        if bits.is_multiple_of(8) && !self.frame.least.is_multiple_of(8) {
            self.frame.broken = self.frame.broken.or(Some(self.frame.least));
        }
        self.frame.least += bits;
        self.frame.most = self.frame.most.saturating_add(bits.saturating_mul(self.times));
    }

    /// A field of at least so many bits.
    fn open(&mut self, bits: usize) {
        self.known(bits);
        self.frame.is_open = true;
    }

    /// The length of a field of the request.
    fn echoed(&self, name: &str) -> Option<u32> {
        let bits_of = |field: &MessageField| match field {
            MessageField::Value(value) if value.item.name == name => Some(self.owner.basic(value.item.ty).bits()),
            _ => None,
        };
        self.request.iter().find_map(bits_of).flatten()
    }

    /// The length of the shortest value in a space.
    fn least_value(&self, space: &str) -> usize {
        let is_in = |binding: &Binding| matches!(binding, Binding::Parameter { space: other, .. } if other == space);
        let items = self.device.items().filter(|item| item.bindings.iter().any(is_in));
        items.filter_map(|item| self.owner.basic(item.ty).bits()).min().unwrap_or(0) as usize
    }
}
