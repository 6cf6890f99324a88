//! Messages of a command protocol.

use super::{by_name, Changes, Judgement};
use lexibus_codegen::ir::{Device, Message, MessageField, TypeDef};

pub(super) fn compare(old: &Device, new: &Device, changes: &mut Changes) {
    let both = |(was, is): (&Message, &Message), element: &str, changes: &mut Changes| {
        for (fact, one, other) in [("request", &was.request, &is.request), ("reply", &was.reply, &is.reply)] {
            let layouts = (layout(one, &old.types), layout(other, &new.types));
            changes.fact(element, fact, layouts, Judgement::Breaking);
        }
        let states = |own: &Message| own.accepted_in.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        changes.fact(element, "accepted in", (states(was), states(is)), Judgement::Compatible);
    };
    by_name("message", (&old.messages, &new.messages), |own| &own.name, changes, both);
}

/// The fields one after the other.
fn layout(fields: &[MessageField], types: &[TypeDef]) -> String {
    fields.iter().map(|own| field(own, types)).collect::<Vec<_>>().join(", ")
}

fn field(own: &MessageField, types: &[TypeDef]) -> String {
    let hexadecimal = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ");
    match own {
        MessageField::Constant(bytes) => hexadecimal(bytes),
        MessageField::FixedBits { bits, value } => format!("{value} in {bits} bits"),
        MessageField::Value(value) => {
            let order = if value.byte_order.is_empty() { String::new() } else { format!(" {:?}", value.byte_order) };
            format!("{} {}{order}", super::types::written(types, value.item.ty), value.item.name)
        }
        MessageField::Echo { field, bytes } => match bytes {
            Some((first, last)) => format!("bytes {first} to {last} of {field}"),
            None => format!("{field} of the request"),
        },
        MessageField::Copy { first, last } => format!("bytes {first} to {last} of the request"),
        MessageField::ItemCode { space, bits } => format!("number of {space} in {bits} bits"),
        MessageField::ItemValue { space } => format!("value of {space}"),
        MessageField::ItemPadding { space } => format!("zeros of {space}"),
        MessageField::Padding(bytes) => format!("{bytes} bytes without meaning"),
        MessageField::Repeat { count, fields, .. } => {
            format!("{} times ({})", count.as_deref().unwrap_or("any"), layout(fields, types))
        }
        MessageField::Rest => "the rest".to_owned(),
    }
}
