//! Finds the steps of a request or of a reply.

use super::shape::Problem;
use super::step::{are_aligned, push, tail, Step};
use crate::ir::owner::{fixed, Owner};
use crate::ir::{Device, Message, MessageField, MessageValue, Type};

pub(super) const UNRESOLVED: Problem = "a field names another that there isn't";
pub(super) const UNALIGNED: Problem = "bytes begin, or the data end, within a byte";
const UNKNOWN_LENGTH: Problem = "a value has no length of 1 to 64 bits, and is no text of fixed length";
const SEVERAL_LENGTHS: Problem = "it has two parts whose length isn't known, or one in front of those that are counted";
const SEVERAL_LISTS: Problem = "two parts of it are repeated";
const LONE_VALUE: Problem = "the value of a parameter doesn't stand behind the parameter's number";
const LONG_CODE: Problem = "the number of a parameter has more than 32 bits";
const ECHO: Problem = "a field comes back whose place in the request isn't known, or isn't whole bytes";
const COPY: Problem = "a request has no request of which it could copy bytes";
const REPEATED: Problem = "what is repeated is more than values and fixed bytes, has no value, or isn't whole bytes";
const STATION: Problem = "the number of the device is no unsigned number of up to 32 bits";
const LENGTH: Problem =
    "a length is no unsigned number of whole bytes, or counts from a field behind what has no known length";
const COUNT: Problem = "the number of repetitions is no unsigned number of its own that stands in front of them";

/// The data of a request or of a reply.
#[derive(Clone, Debug, Default)]
pub(crate) struct Side<'a> {
    pub steps: Vec<Step<'a>>,
    /// Name, first bit and length in bits of values in front of anything whose length isn't known.
    places: Vec<(&'a str, u32, u32)>,
    /// Names of all values.
    names: Vec<&'a str>,
    /// First bit and length in bits of the first number of a parameter.
    code: Option<(u32, u32)>,
}

impl Side<'_> {
    /// The byte at which a value begins.
    pub(crate) fn place(&self, name: &str) -> Option<u32> {
        let (_, at, _) = self.places.iter().find(|(other, ..)| *other == name)?;
        Some(at / 8)
    }

    /// Whether what is read of it is a part of the data, which lives as long as they do.
    pub(crate) fn borrows(&self) -> bool {
        self.steps.iter().any(Step::borrows)
    }
}

/// The shape of a request.
pub(super) fn request<'a>(device: &'a Device, message: &'a Message) -> Result<Side<'a>, Problem> {
    let station = device.framing.as_ref().and_then(|framing| framing.address.as_deref());
    let shaper = Shaper { owner: Owner::of_types(&device.types), station, request: None };
    shaper.side(&message.request)
}

/// The shape of its reply.
pub(super) fn reply<'a>(device: &'a Device, message: &'a Message, request: &Side<'_>) -> Result<Side<'a>, Problem> {
    let owner = Owner::of_types(&device.types);
    Shaper { owner, station: None, request: Some(request) }.side(&message.reply)
}

/// What is known while fields are gone through.
struct Shaper<'a, 'q> {
    owner: Owner<'a>,
    /// The field of requests with the number of the device.
    station: Option<&'a str>,
    /// The request, where this is its reply.
    request: Option<&'q Side<'q>>,
}

impl<'a> Shaper<'a, '_> {
    fn side(&self, fields: &'a [MessageField]) -> Result<Side<'a>, Problem> {
        let mut side = Side { names: names(fields).collect(), ..Side::default() };
        let mut offset = Some(0);
        let mut left = fields;
        while let Some((field, rest)) = left.split_first() {
            let (step, used) = self.step(field, rest, fields)?;
            left = rest.get(used..).unwrap_or_default();
            offset = self.append(&mut side, field, step, offset)?;
        }
        orders(&side.steps)?;
        if !are_aligned(&side.steps) {
            return Err(UNALIGNED);
        }
        let Side { steps, places, .. } = &mut side;
        for step in steps {
            if let Step::Length { from, counts, .. } = step {
                let missing = if named(fields, counts) { LENGTH } else { UNRESOLVED };
                let (_, at, _) = places.iter().find(|(name, ..)| name == counts).ok_or(missing)?;
                *from = at / 8;
            }
        }
        Ok(side)
    }

    /// Adds a step that begins at the bit `offset`; where the next one begins. Both are `None` behind a step whose length isn't
    /// known.
    fn append(
        &self,
        side: &mut Side<'a>,
        field: &'a MessageField,
        step: Step<'a>,
        offset: Option<u32>,
    ) -> Result<Option<u32>, Problem> {
        if let (Some(name), Some(at), Some(bits)) = (name(field), offset, step.bits()) {
            side.places.push((name, at, bits));
        }
        if let (Some(at), None, Some(bits)) = (offset, side.code, step.code_bits()) {
            side.code = Some((at, bits));
        }
        let is_aligned = offset.is_none_or(|at: u32| at.is_multiple_of(8)) || !step.is_bytes();
        // What is as long as the data are takes whole bytes.
        let next = match (offset, step.bits()) {
            _ if !is_aligned => return Err(UNALIGNED),
            (Some(at), Some(bits)) => Some(at.checked_add(bits).ok_or(UNKNOWN_LENGTH)?),
            _ => None,
        };
        if let Step::Setting { bits, .. } = step {
            let asked = self.asked(bits);
            side.steps.extend(asked.map(|first| Step::Same { first, count: bits / 8 }));
        }
        push(&mut side.steps, step);
        Ok(next)
    }

    /// The next step, and how many fields behind `field` it takes too.
    fn step(
        &self,
        field: &'a MessageField,
        rest: &'a [MessageField],
        all: &'a [MessageField],
    ) -> Result<(Step<'a>, usize), Problem> {
        let step = match field {
            MessageField::Constant(bytes) => Step::Bytes(bytes.clone()),
            MessageField::FixedBits { bits, value } => Step::Bits { bits: (*bits).into(), value: *value },
            MessageField::Padding(count) => Step::Padding((*count).into()),
            MessageField::Value(value) => self.value(value, all)?,
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

    fn value(&self, value: &'a MessageValue, all: &'a [MessageField]) -> Result<Step<'a>, Problem> {
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
        if let Some(max) = all.iter().find_map(|field| counts(field, &value.item.name)) {
            return if is_number && order.is_empty() { Ok(Step::Count { bits, max }) } else { Err(COUNT) };
        }
        if self.station == Some(value.item.name.as_str()) {
            let fits = matches!(basic, Type::Unsigned(1..=32));
            return if fits { Ok(Step::Station { bits, value }) } else { Err(STATION) };
        }
        if let Some(counts) = &value.counts {
            let fits = is_number && bits.is_multiple_of(8);
            return if fits { Ok(Step::Length { bits, order, from: 0, counts }) } else { Err(LENGTH) };
        }
        match fixed(&value.item).filter(|_| bits <= 64) {
            // Two's complement, of which the low bits count.
            Some(only) => Ok(Step::Fixed { bits, order, value: only as u64 & (u64::MAX >> (64 - bits)) }),
            None => Ok(Step::Value { bits, value }),
        }
    }

    fn echo(&self, field: &str, bytes: Option<(u8, u8)>) -> Result<Step<'a>, Problem> {
        let request = self.request.ok_or(ECHO)?;
        let missing = if request.names.contains(&field) { ECHO } else { UNRESOLVED };
        let (_, at, bits) = request.places.iter().find(|(name, ..)| *name == field).ok_or(missing)?;
        let is_whole = at.is_multiple_of(8) && bits.is_multiple_of(8);
        let (first, last) = match bytes {
            Some((first, last)) => (first.into(), last.into()),
            None => (0, (bits / 8).saturating_sub(1)),
        };
        let is_within = first <= last && last < bits / 8;
        (is_whole && is_within).then_some(Step::Echo { first: at / 8 + first, count: last - first + 1 }).ok_or(ECHO)
    }

    /// The byte of the request at which it has a parameter's number of so many bits.
    fn asked(&self, bits: u32) -> Option<u32> {
        let (at, length) = self.request?.code?;
        (length == bits && at.is_multiple_of(8) && bits.is_multiple_of(8)).then_some(at / 8)
    }

    /// A parameter's number, with what stands behind it. In a reply without its value it is that of the request.
    fn code(&self, space: &'a str, bits: u32, rest: &[MessageField]) -> (Step<'a>, usize) {
        match (rest.first(), self.asked(bits)) {
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
        let mut steps = Vec::new();
        for field in fields {
            let (step, _) = self.step(field, &[], fields)?;
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

/// Whether one part at most is as long as the data are, and the fields that are counted stand behind their number and in front of it.
fn orders(steps: &[Step<'_>]) -> Result<(), Problem> {
    let list = steps.iter().position(Step::is_counted_list);
    let open = steps.iter().position(Step::is_open);
    if list != steps.iter().rposition(Step::is_counted_list)
        || open != steps.iter().rposition(Step::is_open)
        || open.zip(list).is_some_and(|(open, list)| open < list)
    {
        return Err(SEVERAL_LENGTHS);
    }
    // The type of what is repeated goes by the name of the message.
    if steps.iter().filter(|step| matches!(step, Step::List { .. })).count() > 1 {
        return Err(SEVERAL_LISTS);
    }
    match (steps.iter().position(|step| matches!(step, Step::Count { .. })), list) {
        (None, None) => Ok(()),
        (Some(count), Some(list)) if count < list => Ok(()),
        _ => Err(COUNT),
    }
}

/// The greatest number of repetitions of a field that has its number from this one; `None` for another field.
fn counts(field: &MessageField, name: &str) -> Option<Option<u16>> {
    match field {
        MessageField::Repeat { count: Some(count), max, .. } if count == name => Some(*max),
        _ => None,
    }
}

/// The name of a value, or of one that comes back.
fn name(field: &MessageField) -> Option<&str> {
    match field {
        MessageField::Value(value) => Some(value.item.name.as_str()),
        MessageField::Echo { field, bytes: None } => Some(field.as_str()),
        _ => None,
    }
}

/// The names of values outside of what is repeated.
fn names(fields: &[MessageField]) -> impl Iterator<Item = &str> {
    fields.iter().filter_map(name)
}

fn named(fields: &[MessageField], wanted: &str) -> bool {
    names(fields).any(|name| name == wanted)
}

fn has_code(fields: &[MessageField]) -> bool {
    fields.iter().any(|field| matches!(field, MessageField::ItemCode { .. }))
}
