//! Messages that read and write single parameters of a parameter space.

use std::collections::BTreeMap;

use super::shape::{Problem, Shaped};
use super::step::Step;
use crate::ir::{Binding, CompactString, Device, Item, MessageRef, ParameterSpace};

const OTHERS: Problem = "the request has further fields whose values a client does not know";
const NO_NUMBER: Problem = "the request contains no parameter number from this space";
const NO_VALUE: Problem = "the reply contains no parameter value from this space";
const NO_SETTING: Problem = "the request contains no parameter number from this space with a value after it";
const NO_CODE: Problem = "no code is generated for the message";

/// Maximum length of a parameter value in a message, in bits.
pub(crate) const LONGEST: u32 = 64;

/// The messages that transfer the parameters of a space, as positions in the list of shapes.
pub(crate) struct Carriers<'d> {
    pub space: &'d CompactString,
    pub read: Option<usize>,
    pub write: Option<usize>,
}

/// Returns the parameter spaces that contain parameters, with the messages that can read or write these parameters.
/// Spaces without such a message are left out.
pub(crate) fn carriers<'d>(device: &'d Device, shapes: &[Shaped<'_>]) -> Vec<Carriers<'d>> {
    let with = device.parameter_spaces.iter().filter(|space| !numbered(device, &space.name).is_empty());
    let all = with.map(|space| Carriers {
        space: &space.name,
        read: carrier(shapes, &space.read, |shaped| reads(shaped, &space.name)).and_then(Result::ok),
        write: carrier(shapes, &space.write, |shaped| writes(shaped, &space.name)).and_then(Result::ok),
    });
    all.filter(|carriers| carriers.read.is_some() || carriers.write.is_some()).collect()
}

/// Returns the position of a message, or the reason why the message is not suitable. Returns `None` without a reference.
fn carrier(
    shapes: &[Shaped<'_>],
    message: &Option<MessageRef>,
    check: impl Fn(&Shaped<'_>) -> Result<(), Problem>,
) -> Option<Result<usize, Problem>> {
    let message = message.as_ref()?;
    let Some(at) = shapes.iter().position(|shaped| Some(shaped.id) == message.id) else { return Some(Err(NO_CODE)) };
    Some(shapes.get(at).map_or(Err(NO_CODE), check).map(|()| at))
}

/// Checks that a message reads a parameter, and that its request needs only the parameter number.
fn reads(shaped: &Shaped<'_>, space: &CompactString) -> Result<(), Problem> {
    let mut found = false;
    for step in &shaped.request.steps {
        match step {
            Step::Code { space: other, .. } | Step::Blank { space: other, .. } if **other == *space && !found => {
                found = true
            }
            step if has_value(step) => return Err(OTHERS),
            _ => {}
        }
    }
    let gives = |step: &Step<'_>| match step {
        Step::Setting { space: other, .. } | Step::ValueOnly { space: other, .. } => **other == *space,
        _ => false,
    };
    match (found, shaped.reply.steps.iter().any(gives)) {
        (false, _) => Err(NO_NUMBER),
        (true, false) => Err(NO_VALUE),
        (true, true) => Ok(()),
    }
}

/// Checks that a message writes a parameter, and that its request needs only the parameter number and the value.
fn writes(shaped: &Shaped<'_>, space: &CompactString) -> Result<(), Problem> {
    let mut found = false;
    for step in &shaped.request.steps {
        match step {
            Step::Setting { space: other, .. } | Step::Settings { space: other, .. } if **other == *space && !found => {
                found = true;
            }
            Step::Code { .. } | Step::Blank { .. } => return Err(NO_SETTING),
            step if has_value(step) => return Err(OTHERS),
            _ => {}
        }
    }
    found.then_some(()).ok_or(NO_SETTING)
}

/// Returns whether the sender has to provide a value for a step.
fn has_value(step: &Step<'_>) -> bool {
    match step {
        Step::Value { .. } | Step::Count { .. } | Step::List { .. } | Step::Rest | Step::ValueOnly { .. } => true,
        Step::Code { .. } | Step::Blank { .. } | Step::Setting { .. } | Step::Settings { .. } => true,
        Step::Bytes(_) | Step::Bits { .. } | Step::Padding(_) | Step::Station { .. } | Step::Fixed { .. } => false,
        Step::Length { .. } | Step::Echo { .. } | Step::Copy { .. } | Step::Same { .. } => false,
    }
}

/// Returns the parameters of a space by number.
pub(crate) fn numbered<'d>(device: &'d Device, space: &CompactString) -> BTreeMap<u32, &'d Item> {
    let numbered = device.items().flat_map(|item| {
        item.bindings.iter().filter_map(move |binding| match binding {
            Binding::Parameter(parameter) if parameter.space == *space => Some((parameter.code, item)),
            _ => None,
        })
    });
    let mut all = BTreeMap::new();
    for (code, item) in numbered {
        all.entry(code).or_insert(item);
    }
    all
}

/// Returns the messages that should transfer the parameters of a space but cannot. For each message, returns `reads` or `writes`,
/// the name of the message, and the reason.
pub(crate) fn carrier_problems<'d>(
    space: &'d ParameterSpace,
    shapes: &[Shaped<'_>],
) -> impl Iterator<Item = (&'static str, &'d str, Problem)> {
    let read = carrier(shapes, &space.read, |shaped| reads(shaped, &space.name));
    let write = carrier(shapes, &space.write, |shaped| writes(shaped, &space.name));
    let all = [("reads", &space.read, read), ("writes", &space.write, write)];
    all.into_iter().filter_map(|(verb, name, found)| Some((verb, name.as_ref()?.as_str(), found?.err()?)))
}
