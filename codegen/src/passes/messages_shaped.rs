//! After this pass every request and reply has a shape that code can have, or it was reported.
//!
//! [`request`] and [`reply`] give that shape to back ends: steps of known length one after the other, among which one at most is
//! as long as the data are.

use super::owner::{fixed, Owner};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, Message, MessageField, MessageValue, Type};
use crate::text::brief;

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
    /// The number of a parameter.
    Code { bits: u32 },
    /// The number of a parameter and its value.
    Setting { bits: u32, space: &'a str },
    /// The number of a parameter, and zeros in place of its value.
    Blank { bits: u32, space: &'a str },
    /// Numbers of parameters and their values.
    Settings { bits: u32, space: &'a str, max: Option<u16> },
    /// The value of a parameter whose number the request has.
    ValueOnly { space: &'a str },
    /// Fields that occur several times.
    List { steps: Vec<Step<'a>>, length: u32, is_counted: bool, max: Option<u16> },
    /// All bytes that are left.
    Rest,
}

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

/// Why there is no such shape.
pub(crate) type Problem = &'static str;

const UNRESOLVED: Problem = "a field names another that there isn't";
const UNALIGNED: Problem = "bytes begin, or the data end, within a byte";
const UNKNOWN_LENGTH: Problem = "a value has no length of 1 to 64 bits, and is no text of fixed length";
const SEVERAL_LENGTHS: Problem = "it has two parts whose length isn't known";
const LONE_VALUE: Problem = "the value of a parameter doesn't stand behind the parameter's number";
const ECHO: Problem = "a field comes back whose place in the request isn't known, or isn't whole bytes";
const REPEATED: Problem = "what is repeated is more than values and fixed bytes, or a parameter with its value";
const LENGTH: Problem = "a length counts from a field that isn't in front of all whose length isn't known";
const COUNT: Problem = "the number of repetitions is no unsigned number of its own";

/// Reports messages for which no code is generated.
pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    for message in &device.messages {
        let problem = match request(device, message) {
            Err(problem) => problem,
            Ok(own) => match reply(device, message, &own) {
                Err(problem) => problem,
                Ok(_) => continue,
            },
        };
        // A name that leads nowhere, and bytes that aren't whole, are told already.
        if problem == UNRESOLVED || problem == UNALIGNED {
            continue;
        }
        let text = format!("no code for the message `{}`: {problem}", brief(&message.name));
        diagnostics.push(Diagnostic::new(&codes::MESSAGE_UNSHAPED, message.origin.span, text));
    }
}

/// The shape of a request.
pub(crate) fn request<'a>(device: &'a Device, message: &'a Message) -> Result<Side<'a>, Problem> {
    let station = device.framing.as_ref().and_then(|framing| framing.address.as_deref());
    let shaper = Shaper { owner: Owner { types: &device.types, groups: &[] }, station, request: None };
    shaper.side(&message.request)
}

/// The shape of its reply.
pub(crate) fn reply<'a>(device: &'a Device, message: &'a Message, request: &Side<'_>) -> Result<Side<'a>, Problem> {
    let owner = Owner { types: &device.types, groups: &[] };
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

impl Side<'_> {
    /// The byte at which a value begins.
    pub(crate) fn place(&self, name: &str) -> Option<u32> {
        let (_, at, _) = self.places.iter().find(|(own, ..)| *own == name)?;
        Some(at / 8)
    }
}

impl<'a> Step<'a> {
    /// Its length in bits; `None` where only the data tell.
    pub(crate) fn bits(&self) -> Option<u32> {
        match self {
            Step::Bytes(bytes) => u32::try_from(bytes.len()).ok()?.checked_mul(8),
            Step::Padding(count) | Step::Echo { count, .. } | Step::Copy { count, .. } => count.checked_mul(8),
            Step::Bits { bits, .. } | Step::Station { bits, .. } | Step::Value { bits, .. } => Some(*bits),
            Step::Count { bits, .. } | Step::Code { bits } => Some(*bits),
            Step::Fixed { bits, .. } | Step::Length { bits, .. } => Some(*bits),
            Step::Setting { .. } | Step::Blank { .. } | Step::Settings { .. } => None,
            Step::ValueOnly { .. } | Step::List { .. } | Step::Rest => None,
        }
    }

    fn is_counted(&self) -> bool {
        matches!(self, Step::List { is_counted: true, .. })
    }

    fn code_bits(&self) -> Option<u32> {
        match self {
            Step::Code { bits }
            | Step::Setting { bits, .. }
            | Step::Blank { bits, .. }
            | Step::Settings { bits, .. } => Some(*bits),
            _ => None,
        }
    }

    /// Whether it takes whole bytes, and has to begin with one.
    fn is_bytes(&self) -> bool {
        match self {
            Step::Bits { .. } | Step::Station { .. } | Step::Value { .. } => false,
            Step::Count { .. } | Step::Code { .. } => false,
            Step::Fixed { order, .. } => !order.is_empty(),
            _ => true,
        }
    }
}

/// How many bytes stand behind the part of a message whose length isn't known.
pub(crate) fn tail(steps: &[Step<'_>]) -> u32 {
    steps.iter().filter_map(Step::bits).sum::<u32>() / 8
}

impl<'a> Shaper<'a, '_> {
    fn side(&self, fields: &'a [MessageField]) -> Result<Side<'a>, Problem> {
        let mut side = Side { names: names(fields).collect(), ..Side::default() };
        let mut offset = Some(0);
        let mut left = fields;
        while let Some((field, rest)) = left.split_first() {
            let (step, used) = self.step(field, rest, fields)?;
            left = rest.get(used..).unwrap_or_default();
            if let (MessageField::Value(value), Some(at), Some(bits)) = (field, offset, step.bits()) {
                side.places.push((value.item.name.as_str(), at, bits));
            }
            if let (Some(at), None, Some(bits)) = (offset, side.code, step.code_bits()) {
                side.code = Some((at, bits));
            }
            let is_aligned = offset.is_none_or(|at: u32| at.is_multiple_of(8)) || !step.is_bytes();
            // What is as long as the data are takes whole bytes.
            offset = match (offset, step.bits()) {
                _ if !is_aligned => return Err(UNALIGNED),
                (Some(at), Some(bits)) => Some(at.checked_add(bits).ok_or(UNKNOWN_LENGTH)?),
                _ => None,
            };
            push(&mut side.steps, step);
        }
        let open = side.steps.iter().filter(|step| step.bits().is_none() && !step.is_counted());
        let lists = side.steps.iter().filter(|step| matches!(step, Step::List { .. } | Step::Count { .. }));
        if open.count() > 1 || lists.count() > 2 {
            return Err(SEVERAL_LENGTHS);
        }
        aligned(&side.steps)?;
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
                Step::Copy { first: (*first).into(), count: u32::from(last.saturating_sub(*first)) + 1 }
            }
            MessageField::ItemCode { space, bits } => return Ok(self.code(space, (*bits).into(), rest)),
            MessageField::ItemValue { space } => match self.request.and_then(|request| request.code) {
                Some(_) if !has_code(all) => Step::ValueOnly { space },
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
        let counts = |field: &MessageField| match field {
            MessageField::Repeat { count: Some(name), max, .. } if *name == value.item.name => Some(*max),
            _ => None,
        };
        if let Some(max) = all.iter().find_map(counts) {
            let is_plain = matches!(value.item.ty, Type::Unsigned(_)) && value.byte_order.is_empty();
            return if is_plain { Ok(Step::Count { bits, max }) } else { Err(COUNT) };
        }
        if self.station == Some(value.item.name.as_str()) {
            return if bits <= 32 { Ok(Step::Station { bits, value }) } else { Err(UNKNOWN_LENGTH) };
        }
        let order = value.byte_order.as_slice();
        if !order.is_empty() && order.len() * 8 != bits as usize {
            return Err(UNKNOWN_LENGTH);
        }
        if let Some(counts) = &value.counts {
            return Ok(Step::Length { bits, order, from: 0, counts });
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

    /// A parameter's number, with what stands behind it. In a reply without its value it is that of the request.
    fn code(&self, space: &'a str, bits: u32, rest: &[MessageField]) -> (Step<'a>, usize) {
        match rest.first() {
            Some(MessageField::ItemValue { space: own }) if own == space => (Step::Setting { bits, space }, 1),
            Some(MessageField::ItemPadding { space: own }) if own == space => (Step::Blank { bits, space }, 1),
            _ => match self.request.and_then(|request| request.code) {
                Some((at, own)) if own == bits && at.is_multiple_of(8) && bits.is_multiple_of(8) => {
                    (Step::Echo { first: at / 8, count: bits / 8 }, 0)
                }
                _ => (Step::Code { bits }, 0),
            },
        }
    }

    fn repeat(&self, is_counted: bool, max: Option<u16>, fields: &'a [MessageField]) -> Result<Step<'a>, Problem> {
        if let [MessageField::ItemCode { space, bits }, MessageField::ItemValue { space: own }] = fields {
            let is_alone = space == own && !is_counted;
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
        aligned(&steps)?;
        match tail(&steps) {
            0 => Err(REPEATED),
            length => Ok(Step::List { steps, length, is_counted, max }),
        }
    }
}

/// The names of values outside of what is repeated.
fn names(fields: &[MessageField]) -> impl Iterator<Item = &str> {
    fields.iter().filter_map(|field| match field {
        MessageField::Value(value) => Some(value.item.name.as_str()),
        _ => None,
    })
}

fn named(fields: &[MessageField], wanted: &str) -> bool {
    names(fields).any(|name| name == wanted)
}

fn has_code(fields: &[MessageField]) -> bool {
    fields.iter().any(|field| matches!(field, MessageField::ItemCode { .. }))
}

/// Fixed bytes that follow each other are one step.
fn push<'a>(steps: &mut Vec<Step<'a>>, step: Step<'a>) {
    match (steps.last_mut(), step) {
        (Some(Step::Bytes(before)), Step::Bytes(bytes)) => before.extend(bytes),
        (_, step) => steps.push(step),
    }
}

/// Whether bytes begin at bytes, and all bytes are whole.
fn aligned(steps: &[Step<'_>]) -> Result<(), Problem> {
    let mut phase = 0;
    for step in steps {
        let orders = matches!(step, Step::Value { value, .. } if !value.byte_order.is_empty());
        if phase != 0 && (step.is_bytes() || orders) {
            return Err(UNALIGNED);
        }
        phase = (phase + step.bits().unwrap_or(0)) % 8;
    }
    (phase == 0).then_some(()).ok_or(UNALIGNED)
}
