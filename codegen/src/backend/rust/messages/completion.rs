//! Completion of commands: when a command is completed, and which field of a reply indicates the completion.

use super::field::{self, Field};
use crate::backend::rust::context::Context;
use crate::backend::rust::docs;
use crate::backend::rust::links::DocModule;
use crate::ir::{Completion, Message, MessageValue, Shape, Type, Value};
use crate::number::hex;
use crate::resolve::messages::Step;

/// Returns a sentence that states when the command of a message is completed, or `None` if the command is completed
/// immediately.
pub(super) fn sentence(context: &Context<'_>, message: &Message, doc_module: DocModule<'_>) -> Option<String> {
    let late = message.reply_time.map(|time| format!(", after about {time} ms")).unwrap_or_default();
    Some(match &message.completion {
        Completion::Immediate => return None,
        Completion::Reply => format!("The device replies when the command is completed{late}."),
        Completion::Delayed(milliseconds) => format!("The command is completed after {milliseconds} ms."),
        Completion::Polled { item, in_reply, .. } => {
            let item = context.link(item, doc_module).unwrap_or_else(|| docs::escape(item));
            let source = match *in_reply {
                true => "The reply contains this value.",
                false => "Read this value with another message.",
            };
            format!("\"{item}\" indicates when the command is completed. {source}")
        }
    })
}

/// Returns the body of the method `is_complete` of a reply. The expression uses the first polling condition that can be
/// evaluated from fields of the reply. Returns `None` if there is no such condition, or if the completion must be
/// polled with another message. `messages` contains all messages of the device.
pub(super) fn expression(
    context: &Context<'_>,
    messages: &[Message],
    message: &Message,
    steps: &[Step<'_>],
    fields: &[Field],
) -> Option<String> {
    if matches!(message.completion, Completion::Polled { in_reply: false, .. }) {
        return None;
    }
    field::steps_with_field(steps).zip(fields).find_map(|(step, field)| {
        let Step::Value { value, .. } = step else { return None };
        let command = value.completes?;
        let Completion::Polled { mask, value: expected, .. } = &messages.get(command.message.0 as usize)?.completion
        else {
            return None;
        };
        compare(context, value, &field.name, command.bits, *mask, expected.as_ref())
    })
}

fn compare(
    context: &Context<'_>,
    value: &MessageValue,
    field: &str,
    position: Option<u32>,
    mask: Option<u64>,
    expected: Option<&Value>,
) -> Option<String> {
    let expected = match expected {
        Some(expected) => Some(u64::try_from(expected.as_int()?).ok()?),
        None => None,
    };
    let base = context.base(value.item.ty);
    let is_named = context.enumeration(value.item.ty).is_some();
    let operand = if is_named { format!("self.{field}.raw()") } else { format!("self.{field}") };
    if base == Type::Boolean && !is_named {
        let is_set = expected.is_none_or(|expected| expected != 0);
        return Some(if is_set { operand } else { format!("!{operand}") });
    }
    // The maximum number that the field's type can represent.
    let (_, maximum) = base.integer_range()?;
    let number = |number: u64| (i128::from(number) <= maximum).then(|| hex(number));
    let (offset, mask) = match position {
        Some(position) => bits(context, value.item.ty, position)?,
        None => (0, mask.unwrap_or(u64::MAX)),
    };
    // The polling condition is never true if the mask is 0 or excludes a bit of the expected value.
    if mask == 0 || expected.is_some_and(|expected| expected & !mask != 0) {
        return None;
    }
    let is_whole = matches!(base, Type::Unsigned(8 | 16 | 32 | 64)) && i128::from(mask) == maximum;
    let masked = match mask {
        _ if mask == u64::MAX || is_whole => operand,
        mask => format!("{operand} & {}", number(mask.checked_shl(offset)?)?),
    };
    Some(match expected {
        Some(expected) => format!("{masked} == {}", number(expected.checked_shl(offset)?)?),
        None => format!("{masked} != 0"),
    })
}

/// Returns the bit offset of the field at index `position` of a bit field. Also returns a mask that starts at bit 0 and is
/// as wide as this field.
fn bits(context: &Context<'_>, ty: Type, position: u32) -> Option<(u32, u64)> {
    let Shape::BitField { fields, .. } = &context.resolve(ty).1?.1.shape else { return None };
    let field = fields.get(position as usize)?;
    let mask = u64::MAX.checked_shr(64_u32.checked_sub(field.bits.into())?)?;
    Some((field.offset.into(), mask))
}
