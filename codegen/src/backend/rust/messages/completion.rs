//! When an order is carried out, and what tells it.

use super::field::Field;
use crate::backend::rust::docs;
use crate::backend::rust::scope::Scope;
use crate::ir::{Completion, Device, Message, MessageField, MessageValue, Shape, Type, Value};

/// What documentation says of it.
pub(super) fn sentence(message: &Message) -> Option<String> {
    let late = message.reply_time.map(|time| format!(", after about {time} ms")).unwrap_or_default();
    Some(match &message.completion {
        Completion::Immediate => return None,
        Completion::Reply => format!("The reply comes when the order is carried out{late}."),
        Completion::Delayed(milliseconds) => format!("The order is carried out after {milliseconds} ms."),
        Completion::Polled { item, in_reply, .. } => {
            let when = if *in_reply { "The reply tells it already" } else { "Poll it with a further message" };
            format!("The order is carried out when {} says so. {when}.", docs::escape(item))
        }
    })
}

/// The expression of a reply's `is_complete`: of the conditions by which orders are polled, the first that its fields can tell.
pub(super) fn expression(scope: &Scope<'_>, device: &Device, message: &Message, fields: &[Field]) -> Option<String> {
    let mut values = message.reply.iter().filter_map(|field| match field {
        MessageField::Value(value) => Some(value.as_ref()),
        _ => None,
    });
    // Lists have values of their own, and none of their fields is one of the reply.
    let mut own = fields.iter().filter(|field| !field.borrows());
    let conditions: Vec<_> = device.messages.iter().filter_map(|other| condition(&other.completion)).collect();
    values.find_map(|value| {
        let field = own.next()?;
        let (_, bit, mask, expected) =
            conditions.iter().find(|(name, ..)| *name == value.item.name.as_str()).copied()?;
        compare(scope, value, &field.name, bit, mask, expected)
    })
}

type Polled<'c> = (&'c str, Option<&'c str>, Option<u64>, Option<&'c Value>);

/// The field that is polled, the bit of it, the mask, and the value.
fn condition(completion: &Completion) -> Option<Polled<'_>> {
    let Completion::Polled { item, mask, value, .. } = completion else { return None };
    let (field, bit) = match item.split_once('.') {
        Some((field, bit)) => (field, Some(bit)),
        None => (item.as_str(), None),
    };
    Some((field, bit, *mask, value.as_ref()))
}

fn compare(
    scope: &Scope<'_>,
    value: &MessageValue,
    field: &str,
    bit: Option<&str>,
    mask: Option<u64>,
    expected: Option<&Value>,
) -> Option<String> {
    let expected = match expected {
        Some(expected) => Some(u64::try_from(expected.as_int()?).ok()?),
        None => None,
    };
    let is_named = scope.enumeration(value.item.ty).is_some();
    let own = if is_named { format!("self.{field}.raw()") } else { format!("self.{field}") };
    let (offset, mask) = match bit {
        Some(bit) => bits(scope, value.item.ty, bit)?,
        None => (0, mask.unwrap_or(u64::MAX)),
    };
    if scope.base(value.item.ty) == Type::Boolean {
        let is_set = expected.is_none_or(|expected| expected != 0);
        return Some(if is_set { own } else { format!("!{own}") });
    }
    let masked = match mask {
        u64::MAX => own,
        mask => format!("{own} & {:#X}", mask.checked_shl(offset)?).replace("0X", "0x"),
    };
    Some(match expected {
        Some(expected) => format!("{masked} == {:#X}", expected.checked_shl(offset)?).replace("0X", "0x"),
        None => format!("{masked} != 0"),
    })
}

/// Offset and mask of the bits with this name.
fn bits(scope: &Scope<'_>, ty: Type, name: &str) -> Option<(u32, u64)> {
    let Shape::BitField { fields, .. } = &scope.resolve(ty).1?.1.shape else { return None };
    let field = fields.iter().find(|field| field.name == name)?;
    let mask = u64::MAX.checked_shr(64_u32.checked_sub(field.bits.into())?)?;
    Some((field.offset.into(), mask))
}
