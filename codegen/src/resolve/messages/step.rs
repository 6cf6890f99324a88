//! Steps: the parts of a frame's data.

use crate::ir::{FieldId, MessageValue, SpaceRef};

/// A part of the data of a frame.
#[derive(Clone, Debug)]
pub(crate) enum Step<'a> {
    /// Bytes with a fixed value.
    Bytes(Vec<u8>),
    /// Bits with a fixed value.
    Bits { bits: u32, value: u64 },
    /// This number of unused bytes.
    Padding(u32),
    /// A field with the device address.
    Station { bits: u32, value: &'a MessageValue },
    /// A field whose value is always the same.
    Fixed { bits: u32, order: &'a [u8], value: u64 },
    /// A length field: the number of bytes from byte `from`, at which the field `counts` starts, to the end of the data.
    Length { bits: u32, order: &'a [u8], from: u32, counts: Option<FieldId> },
    /// A typed value.
    Value { bits: u32, value: &'a MessageValue },
    /// The number of repetitions in a counted list.
    Count { bits: u32, max: Option<u16> },
    /// A copy of these bytes of the request.
    Echo { first: u32, count: u32 },
    /// A copy of these bytes of the request. The copy of a shorter request contains only the existing bytes.
    Copy { first: u32, count: u32 },
    /// Check of the following parameter number, which has to equal these bytes of the request.
    Same { first: u32, count: u32 },
    /// A parameter number, without the value of the parameter.
    Code { bits: u32, space: &'a SpaceRef },
    /// A parameter number with its value.
    Setting { bits: u32, space: &'a SpaceRef },
    /// A parameter number with zeros instead of its value.
    Blank { bits: u32, space: &'a SpaceRef },
    /// A list of parameter numbers with their values.
    Settings { bits: u32, space: &'a SpaceRef, max: Option<u16> },
    /// A parameter value whose parameter number is in the request. The parameter number has `bits` bits.
    ValueOnly { bits: u32, space: &'a SpaceRef },
    /// A list of repeated fields.
    List { steps: Vec<Step<'a>>, length: u32, is_counted: bool, max: Option<u16> },
    /// All remaining bytes of the data.
    Rest,
}

impl Step<'_> {
    /// Returns the length in bits, or `None` for a variable length.
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

    /// Returns whether decoded values borrow from the data.
    pub(crate) fn borrows(&self) -> bool {
        matches!(self, Step::Settings { .. } | Step::List { .. } | Step::Rest | Step::ValueOnly { .. })
    }

    /// Returns whether the step has a variable length that no count determines.
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

    /// Returns whether the step consists of whole bytes, and has to start at a byte boundary.
    pub(super) fn is_bytes(&self) -> bool {
        match self {
            Step::Value { value, .. } | Step::Station { value, .. } => !value.byte_order.is_empty(),
            Step::Bits { .. } | Step::Count { .. } | Step::Code { .. } => false,
            Step::Fixed { order, .. } => !order.is_empty(),
            _ => true,
        }
    }
}

/// Returns the total length of `steps` in bytes. Steps with a variable length do not count.
pub(crate) fn tail(steps: &[Step<'_>]) -> u32 {
    steps.iter().filter_map(Step::bits).sum::<u32>() / 8
}

/// Appends a step. Consecutive fixed bytes are merged.
pub(super) fn push<'a>(steps: &mut Vec<Step<'a>>, step: Step<'a>) {
    match (steps.last_mut(), step) {
        (Some(Step::Bytes(before)), Step::Bytes(bytes)) => before.extend(bytes),
        (_, step) => steps.push(step),
    }
}

/// Returns whether the end of the data and the start of each step of whole bytes are at a byte boundary.
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
