//! Example frames of a manual: differences from the fields of their messages.

use std::ops::Range;

use super::context::Context;
use super::limits::beyond;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::{fixed, reserved, Owner};
use crate::ir::{BitMeaning, FieldId, FieldRef, Item, Message, MessageField, MessageValue, Shape, Type};
use crate::number::{hex, hex8};
use crate::resolve::messages::fixed_bits;
use crate::source::Span;
use crate::text::{brief, count_of};

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let owner = context.owner;
    for message in &context.device.messages {
        for example in &message.examples {
            let request = Frame::new(owner, &message.request, &example.request);
            let reply = Frame {
                request: Some((&message.request, &example.request)),
                ..Frame::new(owner, &message.reply, &example.reply)
            };
            report(message, "request", &request, example.request_at, diagnostics);
            report(message, "reply", &reply, example.reply_at, diagnostics);
        }
    }
}

fn report(message: &Message, what: &str, frame: &Frame<'_>, span: Span, diagnostics: &mut Diagnostics) {
    if frame.bytes.is_empty() {
        return;
    }
    for problem in frame.problems() {
        let found =
            codes::EXAMPLE_DIFFERS.at(span, format!("the example {what} of `{}` {problem}", brief(&message.name)));
        diagnostics.push(found.help("keep the bytes that other frames of the manual confirm, and add a `doubt`"));
    }
}

/// The bytes of an example frame, and the fields of its message.
struct Frame<'a> {
    owner: Owner<'a>,
    fields: &'a [MessageField],
    bytes: &'a [u8],
    /// Fields and bytes of the request, for the reply fields that copy bytes of the request.
    request: Option<(&'a [MessageField], &'a [u8])>,
}

impl<'a> Frame<'a> {
    fn new(owner: Owner<'a>, fields: &'a [MessageField], bytes: &'a [u8]) -> Self {
        Frame { owner, fields, bytes, request: None }
    }

    /// Returns the problems in the bytes of an example frame. Bytes after a field with a variable length are not checked.
    fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        let mut at = 0usize;
        for field in self.fields {
            let Some(bits) = self.bits(field) else { return problems };
            let last = at + bits;
            if last > self.bytes.len() * 8 {
                let bytes = count_of(self.bytes.len(), "byte");
                problems.push(format!("has {bytes}, but the fields of the message need more"));
                return problems;
            }
            problems.extend(self.field(field, at..last));
            at = last;
        }
        if at.div_ceil(8) != self.bytes.len() {
            let (bytes, needed) = (count_of(self.bytes.len(), "byte"), at.div_ceil(8));
            problems.push(format!("has {bytes}, but the fields of the message need {needed}"));
        }
        problems
    }

    /// Returns the length of a field in bits, or `None` if the length is not fixed.
    fn bits(&self, field: &MessageField) -> Option<usize> {
        match field {
            MessageField::Echo { field, bytes: None } => {
                let (fields, _) = self.request?;
                self.bits(fields.get(field.id?.0 as usize)?)
            }
            field => fixed_bits(self.owner, field).map(|bits| bits as usize),
        }
    }

    fn field(&self, field: &MessageField, range: Range<usize>) -> Vec<String> {
        let problem = match field {
            MessageField::Constant(expected) => {
                let found = self.bytes.get(range.start / 8..range.end / 8).unwrap_or_default();
                (found != expected)
                    .then(|| format!("has {} instead of the constant {}", octets(found), octets(expected)))
            }
            MessageField::Value(value) => return self.value(value, number(self.bytes, range, &value.byte_order)),
            MessageField::Echo { field, bytes } => self.echo(field, *bytes, range),
            MessageField::FixedBits { bits, value } => {
                let found = number(self.bytes, range, &[]);
                (found != *value).then(|| {
                    format!("has {} instead of {} in {}", hex(found), hex(*value), count_of(*bits, "fixed bit"))
                })
            }
            MessageField::Copy { first, .. } => self.copy(usize::from(*first), range),
            _ => None,
        };
        problem.into_iter().collect()
    }

    /// Returns the problem with a field that copies bytes of the request.
    fn copy(&self, first: usize, range: Range<usize>) -> Option<String> {
        let sent = self.request?.1.get(first..)?;
        let found = self.bytes.get(range.start / 8..range.end / 8).filter(|_| range.start.is_multiple_of(8))?;
        let count = found.len().min(sent.len());
        let (found, sent) = (found.get(..count)?, sent.get(..count)?);
        (found != sent).then(|| {
            let (found, sent) = (octets(found), octets(sent));
            format!("has {found} as the copy of the request bytes from byte {first} on, but the request has {sent}")
        })
    }

    fn value(&self, value: &MessageValue, number: u64) -> Vec<String> {
        let item = &value.item;
        let name = brief(&item.name);
        let mut problems = Vec::new();
        let signed = signed(self.owner, item, number);
        if let Some(expected) = fixed(item).filter(|&only| signed.is_some_and(|signed| signed != only)) {
            let (number, expected) = (hex(number), hex(expected));
            problems.push(format!("has {number} in the field `{name}`, whose value is always {expected}"));
        } else if let Some(limit) = signed.and_then(|signed| beyond(item, signed)) {
            problems.push(format!("has {} in the field `{name}`, whose {limit}", hex(number)));
        }
        if let Some(counted) = value.counts.as_ref().and_then(|first| self.counted(first.id?)) {
            if number != counted as u64 {
                problems.push(format!("has the value {number} in the length field `{name}` instead of {counted}"));
            }
        }
        problems.extend(self.meaning(item.ty, name, number));
        problems
    }

    /// Returns the problems with a number in an example: values that are reserved or have no name, and reserved bits
    /// with a wrong value.
    fn meaning(&self, ty: Type, name: &str, number: u64) -> Vec<String> {
        match self.owner.definition(ty).map(|definition| &definition.shape) {
            Some(Shape::Enumeration { values, .. }) => {
                let problem = match reserved(values, number.into()) {
                    None => Some("has no name"),
                    Some(true) => Some("is reserved"),
                    Some(false) => None,
                };
                let number = hex(number);
                let problem = problem.map(|why| format!("has {number} in the field `{name}`, but this value {why}"));
                problem.into_iter().collect()
            }
            Some(Shape::BitField { fields, .. }) => {
                let mut problems = Vec::new();
                for field in fields.iter().filter(|field| field.when.is_none()) {
                    let mask = u64::MAX.checked_shr(64u32.saturating_sub(field.bits.into())).unwrap_or(0);
                    let bits = number.checked_shr(field.offset.into()).unwrap_or(0) & mask;
                    match field.meaning {
                        BitMeaning::Enumeration(id) => {
                            problems.extend(self.meaning(Type::Named(id), &format!("{name}/{}", field.name), bits));
                        }
                        BitMeaning::Reserved { write: Some(set) } if bits != if set { mask } else { 0 } => {
                            problems.push(format!("sets reserved bits of the field `{name}` to {}", hex(bits)));
                        }
                        _ => {}
                    }
                }
                problems
            }
            _ => Vec::new(),
        }
    }

    /// Returns the number of bytes from a field to the end of the frame.
    fn counted(&self, first: FieldId) -> Option<usize> {
        Some(self.bytes.len().saturating_sub(self.offset(first)? / 8))
    }

    /// Returns the bit offset of a field, or `None` if the length of a preceding field is unknown.
    fn offset(&self, id: FieldId) -> Option<usize> {
        self.fields.get(..id.0 as usize)?.iter().map(|field| self.bits(field)).sum()
    }

    fn echo(&self, field: &FieldRef, part: Option<(u8, u8)>, range: Range<usize>) -> Option<String> {
        let (fields, bytes) = self.request?;
        let request = Frame::new(self.owner, fields, bytes);
        let start = request.offset(field.id?)? + part.map_or(0, |(first, _)| usize::from(first) * 8);
        let is_whole = [range.start, range.len(), start].iter().all(|bits| bits.is_multiple_of(8));
        let part = |bytes: &'a [u8], start: usize| bytes.get(start / 8..(start + range.len()) / 8);
        let (found, sent) = (part(self.bytes, range.start)?, part(bytes, start).filter(|_| is_whole)?);
        (found != sent).then(|| {
            let (found, field, sent) = (octets(found), brief(field), octets(sent));
            format!("has {found} as the copy of the field `{field}`, but the request has {sent}")
        })
    }
}

/// Returns the number in a range of the frame's bits. Bit 0 is the most significant bit of the first byte. `order` is the byte
/// order of the number on the wire.
fn number(bytes: &[u8], range: Range<usize>, order: &[u8]) -> u64 {
    let bit = |at: usize| bytes.get(at / 8).map_or(0, |byte| u64::from(byte >> (7 - at % 8) & 1));
    if order.is_empty() || order.len() * 8 != range.len() {
        return range.fold(0, |number, at| number << 1 | bit(at));
    }
    let byte = |number: usize| (0..8).fold(0, |value, at| value << 1 | bit(range.start + number * 8 + at));
    order.iter().enumerate().fold(0, |number, (position, significance)| {
        let shift = (order.len() - 1).saturating_sub(usize::from(*significance)) * 8;
        number | byte(position).checked_shl(shift as u32).unwrap_or(0)
    })
}

/// Returns a number in a frame as a value of its item. The value is negative if the type of the item is signed and the sign bit
/// is set.
fn signed(owner: Owner<'_>, item: &Item, number: u64) -> Option<i128> {
    let ty = owner.basic(item.ty);
    let bits = ty.bits().filter(|bits| (1..=64).contains(bits))?;
    let is_negative = ty.is_signed() && number >> (bits - 1) == 1;
    Some(i128::from(number) - if is_negative { 1i128 << bits } else { 0 })
}

fn octets(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| hex8(*byte)).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_in_the_byte_order_of_the_wire() {
        let bytes = [0x12, 0x34, 0x56, 0x78, 0xA5];
        assert_eq!(number(&bytes, 0..16, &[]), 0x1234);
        assert_eq!(number(&bytes, 0..16, &[1, 0]), 0x3412);
        assert_eq!(number(&bytes, 0..32, &[2, 3, 0, 1]), 0x5678_1234);
        assert_eq!((number(&bytes, 32..36, &[]), number(&bytes, 36..40, &[])), (0xA, 0x5));
    }
}
