//! Determines the steps of a request or reply.

use super::shape::Problem;
use super::step::{are_aligned, push, tail, Step};
use crate::ir::owner::{fixed, Owner};
use crate::ir::{Device, FieldId, FieldRef, Message, MessageField, MessageValue, SpaceRef, Type};

pub(super) const UNRESOLVED: Problem = "a field refers to a field that does not exist";
pub(super) const UNALIGNED: Problem = "a field of whole bytes starts within a byte, or the data ends within a byte";
const UNKNOWN_LENGTH: Problem = "a value is neither a number of 1 to 64 bits nor a string with a fixed length";
const SEVERAL_LENGTHS: Problem =
    "two fields have a variable length, or a field of variable length comes before repeated fields with a count";
const SEVERAL_LISTS: Problem = "the message has two lists of repeated fields";
const LONE_VALUE: Problem = "a parameter value does not come directly after its parameter number";
const LONG_CODE: Problem = "a parameter number has more than 32 bits";
const ECHO: Problem = "the offset of a copied field in the request is variable, or the field does not have whole bytes";
const COPY: Problem = "a request cannot copy bytes of a request";
const REPEATED: Problem =
    "repeated fields include more than values and fixed bytes, include no value, or do not fill whole bytes";
const STATION: Problem = "the device address is not an unsigned integer of up to 32 bits";
const LENGTH: Problem =
    "a length is not an unsigned integer of whole bytes, or counts from a field after a field of variable length";
const COUNT: Problem = "the number of repetitions is not a separate unsigned integer before the repeated fields";

/// The steps of a request or reply, and the fixed offsets of fields.
#[derive(Clone, Debug, Default)]
pub(crate) struct Side<'a> {
    pub steps: Vec<Step<'a>>,
    /// Bit offset and length in bits of each field before the first step with a variable length.
    offsets: Vec<(FieldId, u32, u32)>,
    /// Bit offset and length in bits of the first parameter number.
    code: Option<(u32, u32)>,
}

impl Side<'_> {
    /// Returns the byte offset of a field, if the field comes before the first step with a variable length.
    pub(crate) fn byte_offset(&self, id: FieldId) -> Option<u32> {
        let (at, _) = self.range(id)?;
        Some(at / 8)
    }

    /// Returns the bit offset and the length in bits of a field, if the field comes before the first step with a variable length.
    fn range(&self, id: FieldId) -> Option<(u32, u32)> {
        let position = self.offsets.binary_search_by_key(&id, |(other, ..)| *other).ok()?;
        self.offsets.get(position).map(|(_, at, bits)| (*at, *bits))
    }

    /// Returns whether decoded values borrow from the data.
    pub(crate) fn borrows(&self) -> bool {
        self.steps.iter().any(Step::borrows)
    }
}

/// Returns the steps of a request.
pub(super) fn request<'a>(device: &'a Device, message: &'a Message) -> Result<Side<'a>, Problem> {
    let owner = Owner::of_types(&device.types);
    Shaper { owner, station: message.address, request: None }.side(&message.request)
}

/// Returns the steps of a reply.
pub(super) fn reply<'a>(device: &'a Device, message: &'a Message, request: &Side<'_>) -> Result<Side<'a>, Problem> {
    let owner = Owner::of_types(&device.types);
    Shaper { owner, station: None, request: Some(request) }.side(&message.reply)
}

/// Context for determining the steps of a request or reply.
struct Shaper<'a, 'q> {
    owner: Owner<'a>,
    /// Request field with the device address.
    station: Option<FieldId>,
    /// The request, if the steps are those of its reply.
    request: Option<&'q Side<'q>>,
}

impl<'a> Shaper<'a, '_> {
    fn side(&self, fields: &'a [MessageField]) -> Result<Side<'a>, Problem> {
        let mut side = Side::default();
        let mut offset = Some(0);
        let mut next = 0;
        while let Some((field, rest)) = fields.get(next..).and_then(<[MessageField]>::split_first) {
            let id = FieldId(next as u32);
            let (step, used) = self.step(id, field, rest, fields)?;
            next += 1 + used;
            offset = self.append(&mut side, id, step, offset)?;
        }
        orders(&side.steps)?;
        if !are_aligned(&side.steps) {
            return Err(UNALIGNED);
        }
        let mut steps = std::mem::take(&mut side.steps);
        for step in &mut steps {
            if let Step::Length { from, counts, .. } = step {
                *from = side.byte_offset(counts.ok_or(UNRESOLVED)?).ok_or(LENGTH)?;
            }
        }
        Ok(Side { steps, ..side })
    }

    /// Adds a step at the bit offset `offset`, and returns the bit offset of the next step. Both offsets are `None` after a step
    /// with a variable length.
    fn append(
        &self,
        side: &mut Side<'a>,
        id: FieldId,
        step: Step<'a>,
        offset: Option<u32>,
    ) -> Result<Option<u32>, Problem> {
        if let (Some(at), Some(bits)) = (offset, step.bits()) {
            side.offsets.push((id, at, bits));
        }
        if let (Some(at), None, Some(bits)) = (offset, side.code, step.code_bits()) {
            side.code = Some((at, bits));
        }
        let is_aligned = offset.is_none_or(|at: u32| at.is_multiple_of(8)) || !step.is_bytes();
        // A step with a variable length consists of whole bytes.
        let next = match (offset, step.bits()) {
            _ if !is_aligned => return Err(UNALIGNED),
            (Some(at), Some(bits)) => Some(at.checked_add(bits).ok_or(UNKNOWN_LENGTH)?),
            _ => None,
        };
        if let Step::Setting { bits, .. } = step {
            let requested = self.requested_code(bits);
            side.steps.extend(requested.map(|first| Step::Same { first, count: bits / 8 }));
        }
        push(&mut side.steps, step);
        Ok(next)
    }

    /// Returns the step for `field`, and the number of following fields that it includes.
    fn step(
        &self,
        id: FieldId,
        field: &'a MessageField,
        rest: &'a [MessageField],
        all: &'a [MessageField],
    ) -> Result<(Step<'a>, usize), Problem> {
        let step = match field {
            MessageField::Constant(bytes) => Step::Bytes(bytes.clone()),
            MessageField::FixedBits { bits, value } => Step::Bits { bits: (*bits).into(), value: *value },
            MessageField::Padding(count) => Step::Padding((*count).into()),
            MessageField::Value(value) => self.value(id, value, all)?,
            MessageField::Echo { field, bytes } => self.echo(field, *bytes)?,
            MessageField::Copy { first, last } => {
                self.request.ok_or(COPY)?;
                Step::Copy { first: (*first).into(), count: u32::from(last.saturating_sub(*first)) + 1 }
            }
            MessageField::ItemCode { bits, .. } if *bits > 32 => return Err(LONG_CODE),
            MessageField::ItemCode { space, bits } => return Ok(self.code(space, (*bits).into(), rest)),
            MessageField::ItemValue { space } => match self.request.and_then(|request| request.code) {
                Some((_, bits)) if !has_code(all) => Step::ValueOnly { bits, space },
                _ => return Err(LONE_VALUE),
            },
            MessageField::ItemPadding { .. } => return Err(LONE_VALUE),
            MessageField::Repeat { count, max, fields } => self.repeat(count.is_some(), *max, fields)?,
            MessageField::Rest => Step::Rest,
        };
        Ok((step, 0))
    }

    fn value(&self, id: FieldId, value: &'a MessageValue, all: &'a [MessageField]) -> Result<Step<'a>, Problem> {
        let basic = self.owner.basic(value.item.ty);
        let bits = match basic {
            Type::VisibleString(Some(length)) | Type::OctetString(Some(length)) => length.checked_mul(8),
            other => other.bits().filter(|bits| (1..=64).contains(bits)),
        };
        let bits = bits.ok_or(UNKNOWN_LENGTH)?;
        let order = value.byte_order.as_slice();
        if !order.is_empty() && order.len() * 8 != bits as usize {
            return Err(UNKNOWN_LENGTH);
        }
        let is_number = matches!(value.item.ty, Type::Unsigned(_));
        if let Some(max) = all.iter().find_map(|field| counts(field, id)) {
            return if is_number && order.is_empty() { Ok(Step::Count { bits, max }) } else { Err(COUNT) };
        }
        if self.station == Some(id) {
            let fits = matches!(basic, Type::Unsigned(1..=32));
            return if fits { Ok(Step::Station { bits, value }) } else { Err(STATION) };
        }
        if let Some(counts) = &value.counts {
            let fits = is_number && bits.is_multiple_of(8);
            return if fits { Ok(Step::Length { bits, order, from: 0, counts: counts.id }) } else { Err(LENGTH) };
        }
        match fixed(&value.item).filter(|_| bits <= 64) {
            // The frame contains the low bits of the two's complement of a fixed value.
            Some(only) => Ok(Step::Fixed { bits, order, value: only as u64 & (u64::MAX >> (64 - bits)) }),
            None => Ok(Step::Value { bits, value }),
        }
    }

    fn echo(&self, field: &FieldRef, bytes: Option<(u8, u8)>) -> Result<Step<'a>, Problem> {
        let request = self.request.ok_or(ECHO)?;
        let (at, bits) = request.range(field.id.ok_or(UNRESOLVED)?).ok_or(ECHO)?;
        let is_whole = at.is_multiple_of(8) && bits.is_multiple_of(8);
        let (first, last) = match bytes {
            Some((first, last)) => (first.into(), last.into()),
            None => (0, (bits / 8).saturating_sub(1)),
        };
        let is_within = first <= last && last < bits / 8;
        (is_whole && is_within).then_some(Step::Echo { first: at / 8 + first, count: last - first + 1 }).ok_or(ECHO)
    }

    /// Returns the byte offset of the parameter number in the request. Returns `None` unless this number has a length of `bits`
    /// bits, consists of whole bytes, and starts at a byte boundary.
    fn requested_code(&self, bits: u32) -> Option<u32> {
        let (at, length) = self.request?.code?;
        (length == bits && at.is_multiple_of(8) && bits.is_multiple_of(8)).then_some(at / 8)
    }

    /// Returns the step of a parameter number and its value, and the number of further fields that the step includes.
    /// In a reply without the value, the parameter number is a copy of that in the request.
    fn code(&self, space: &'a SpaceRef, bits: u32, rest: &[MessageField]) -> (Step<'a>, usize) {
        match (rest.first(), self.requested_code(bits)) {
            (Some(MessageField::ItemValue { space: other }), _) if other == space => (Step::Setting { bits, space }, 1),
            (Some(MessageField::ItemPadding { space: other }), _) if other == space => (Step::Blank { bits, space }, 1),
            (_, Some(first)) => (Step::Echo { first, count: bits / 8 }, 0),
            _ => (Step::Code { bits, space }, 0),
        }
    }

    fn repeat(&self, is_counted: bool, max: Option<u16>, fields: &'a [MessageField]) -> Result<Step<'a>, Problem> {
        if let [MessageField::ItemCode { space, bits }, MessageField::ItemValue { space: other }] = fields {
            let is_alone = space == other && !is_counted && *bits <= 32;
            return if is_alone { Ok(Step::Settings { bits: (*bits).into(), space, max }) } else { Err(REPEATED) };
        }
        let entry = Shaper { station: None, ..*self };
        let mut steps = Vec::new();
        for (id, field) in (0..).map(FieldId).zip(fields) {
            let (step, _) = entry.step(id, field, &[], fields)?;
            let is_simple = matches!(step, Step::Bytes(_) | Step::Bits { .. } | Step::Padding(_) | Step::Value { .. });
            if !is_simple {
                return Err(REPEATED);
            }
            push(&mut steps, step);
        }
        let has_value = steps.iter().any(|step| matches!(step, Step::Value { .. }));
        match tail(&steps) {
            length if has_value && are_aligned(&steps) => Ok(Step::List { steps, length, is_counted, max }),
            _ => Err(REPEATED),
        }
    }
}

/// Checks that the steps contain at most one list of repeated fields. In addition to a counted list, at most one step may have a
/// variable length. A counted list must come after its count and before the step with a variable length.
fn orders(steps: &[Step<'_>]) -> Result<(), Problem> {
    let list = steps.iter().position(Step::is_counted_list);
    let open = steps.iter().position(Step::is_open);
    if list != steps.iter().rposition(Step::is_counted_list)
        || open != steps.iter().rposition(Step::is_open)
        || open.zip(list).is_some_and(|(open, list)| open < list)
    {
        return Err(SEVERAL_LENGTHS);
    }
    // A message can have one list only, because the generated type of the repeated fields has the name of the message.
    if steps.iter().filter(|step| matches!(step, Step::List { .. })).count() > 1 {
        return Err(SEVERAL_LISTS);
    }
    match (steps.iter().position(|step| matches!(step, Step::Count { .. })), list) {
        (None, None) => Ok(()),
        (Some(count), Some(list)) if count < list => Ok(()),
        _ => Err(COUNT),
    }
}

/// Returns the declared maximum number of repetitions if `field` is a list whose count is in the field `id`. Returns `Some(None)`
/// for such a list without a maximum, and `None` for any other field.
fn counts(field: &MessageField, id: FieldId) -> Option<Option<u16>> {
    match field {
        MessageField::Repeat { count: Some(count), max, .. } if count.id == Some(id) => Some(*max),
        _ => None,
    }
}

fn has_code(fields: &[MessageField]) -> bool {
    fields.iter().any(|field| matches!(field, MessageField::ItemCode { .. }))
}
