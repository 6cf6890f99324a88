//! The parts of a frame's data, one after the other.

use crate::ir::MessageValue;

/// A part of a frame's data.
#[derive(Clone, Debug)]
pub(crate) enum Step<'a> {
    /// Fixed bytes.
    Bytes(Vec<u8>),
    /// Fixed bits.
    Bits { bits: u32, value: u64 },
    /// So many bytes without meaning.
    Padding(u32),
    /// The number of the device.
    Station { bits: u32, value: &'a MessageValue },
    /// A value that is always the same.
    Fixed { bits: u32, order: &'a [u8], value: u64 },
    /// How many bytes the frame has from this one on.
    Length { bits: u32, order: &'a [u8], from: u32, counts: &'a str },
    /// A value.
    Value { bits: u32, value: &'a MessageValue },
    /// How often the fields of the list occur.
    Count { bits: u32, max: Option<u16> },
    /// Bytes of the request.
    Echo { first: u32, count: u32 },
    /// Bytes of the request, as far as it has them.
    Copy { first: u32, count: u32 },
    /// In front of a parameter's number: these bytes of the request, which it has to be.
    Same { first: u32, count: u32 },
    /// The number of a parameter.
    Code { bits: u32, space: &'a str },
    /// The number of a parameter and its value.
    Setting { bits: u32, space: &'a str },
    /// The number of a parameter, and zeros in place of its value.
    Blank { bits: u32, space: &'a str },
    /// Numbers of parameters and their values.
    Settings { bits: u32, space: &'a str, max: Option<u16> },
    /// The value of a parameter whose number the request has, in so many bits.
    ValueOnly { bits: u32, space: &'a str },
    /// Fields that occur several times.
    List { steps: Vec<Step<'a>>, length: u32, is_counted: bool, max: Option<u16> },
    /// All bytes that are left.
    Rest,
}

impl Step<'_> {
    /// Its length in bits; `None` where only the data tell.
    pub(crate) fn bits(&self) -> Option<u32> {
        match self {
            Step::Bytes(bytes) => u32::try_from(bytes.len()).ok()?.checked_mul(8),
            Step::Padding(count) | Step::Echo { count, .. } | Step::Copy { count, .. } => count.checked_mul(8),
            Step::Same { .. } => Some(0),
            Step::Bits { bits, .. } | Step::Station { bits, .. } | Step::Value { bits, .. } => Some(*bits),
            Step::Count { bits, .. } | Step::Code { bits, .. } => Some(*bits),
            Step::Fixed { bits, .. } | Step::Length { bits, .. } => Some(*bits),
            Step::Setting { .. } | Step::Blank { .. } | Step::Settings { .. } => None,
            Step::ValueOnly { .. } | Step::List { .. } | Step::Rest => None,
        }
    }

    /// Whether what is read of it is a part of the data, which lives as long as they do.
    pub(crate) fn borrows(&self) -> bool {
        matches!(self, Step::Settings { .. } | Step::List { .. } | Step::Rest | Step::ValueOnly { .. })
    }

    /// Whether it goes on up to what stands behind it.
    pub(super) fn is_open(&self) -> bool {
        self.bits().is_none() && !self.is_counted_list()
    }

    pub(super) fn is_counted_list(&self) -> bool {
        matches!(self, Step::List { is_counted: true, .. })
    }

    pub(super) fn code_bits(&self) -> Option<u32> {
        match self {
            Step::Code { bits, .. }
            | Step::Setting { bits, .. }
            | Step::Blank { bits, .. }
            | Step::Settings { bits, .. } => Some(*bits),
            _ => None,
        }
    }

    /// Whether it takes whole bytes, and has to begin with one.
    pub(super) fn is_bytes(&self) -> bool {
        match self {
            Step::Value { value, .. } | Step::Station { value, .. } => !value.byte_order.is_empty(),
            Step::Bits { .. } | Step::Count { .. } | Step::Code { .. } => false,
            Step::Fixed { order, .. } => !order.is_empty(),
            _ => true,
        }
    }
}

/// How many bytes stand behind the part of a message whose length isn't known.
pub(crate) fn tail(steps: &[Step<'_>]) -> u32 {
    steps.iter().filter_map(Step::bits).sum::<u32>() / 8
}

/// Appends a step. Fixed bytes that follow each other are one.
pub(super) fn push<'a>(steps: &mut Vec<Step<'a>>, step: Step<'a>) {
    match (steps.last_mut(), step) {
        (Some(Step::Bytes(before)), Step::Bytes(bytes)) => before.extend(bytes),
        (_, step) => steps.push(step),
    }
}

/// Whether bytes begin at bytes, and all bytes are whole.
pub(super) fn are_aligned(steps: &[Step<'_>]) -> bool {
    let mut phase = 0;
    for step in steps {
        if phase != 0 && step.is_bytes() {
            return false;
        }
        phase = (phase + step.bits().unwrap_or(0)) % 8;
    }
    phase == 0
}
