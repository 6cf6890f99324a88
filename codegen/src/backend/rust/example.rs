//! The example at the beginning of a device's documentation, which uses values of this device.

use super::context::Context;
use super::docs::{typed, WORDS};
use super::objects;
use super::value_type;
use super::walk::WalkModel;
use crate::ir::{Binding, Item, Type, Value};

/// Returns the lines of the example, which creates the driver, leads its state machine to a state, reads a value and
/// writes a value. Returns no lines if a program cannot access any value of the device.
pub(super) fn lines(context: &Context<'_>, device_name: &str, walks: &[WalkModel]) -> Vec<String> {
    let calls: Vec<(&Item, String)> = objects::calls(context).map(|(entry, path)| (entry.item, path)).collect();
    let (read, write) = (readable(context, &calls), writable(context, &calls));
    if read.is_none() && write.is_none() {
        return Vec::new();
    }
    let mut lines = vec![String::new(), "```ignore".to_owned(), format!("let mut drive = {device_name}::new(client);")];
    lines.extend(walks.iter().find_map(|walk| {
        let state = walk.energized.as_ref()?;
        Some(format!("drive.{}(types::{}::{state}, Duration::from_secs(2))?;", walk.method, walk.states))
    }));
    lines.extend(read.map(|(item, path)| {
        let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
        format!("let value = drive.{path}.read()?;{}", comment(unit))
    }));
    lines.extend(write.map(|(item, path, number)| {
        let shown = WORDS.of_item(item, &Value::Int(number), &|value| typed(value, context.base(item.ty)));
        format!("drive.{path}.write({number})?;{}", comment(&shown))
    }));
    lines.push("```".to_owned());
    lines
}

/// Returns the item that an example reads, preferably a measured value, and the call of its accessor.
pub(super) fn readable<'c>(context: &Context<'_>, calls: &'c [(&Item, String)]) -> Option<(&'c Item, &'c str)> {
    let is_actual = |item: &Item| is_measured(context, item) && item.access.readable() && !item.access.writable();
    let by_preference: [&dyn Fn(&Item) -> bool; 3] =
        [&|item| is_actual(item) && item.mappable.tpdo, &is_actual, &|item| {
            item.access.readable() && !is_communication(item)
        }];
    let found = by_preference.iter().find_map(|is_it| calls.iter().find(|(item, _)| is_it(item)));
    found.map(|(item, call)| (*item, call.as_str()))
}

/// Returns the setting that an example writes, the call of its accessor, and its default value.
pub(super) fn writable<'c>(context: &Context<'_>, calls: &'c [(&Item, String)]) -> Option<(&'c Item, &'c str, i128)> {
    let settings = calls.iter().filter(|(item, _)| is_measured(context, item) && item.access.writable());
    settings.into_iter().find_map(|(item, call)| Some((*item, call.as_str(), default(item, context.base(item.ty))?)))
}

/// Returns whether an item is an integer of 8, 16 or 32 bits without an enumeration or bit field.
pub(super) fn is_number(context: &Context<'_>, item: &Item) -> bool {
    value_type::is_word(context.base(item.ty)) && context.enumeration(item.ty).is_none()
}

fn is_measured(context: &Context<'_>, item: &Item) -> bool {
    is_number(context, item) && item.quantity.is_some() && !is_communication(item)
}

/// Returns whether an item is in the communication profile area of the object dictionary (CiA 301, 7.4.1).
fn is_communication(item: &Item) -> bool {
    item.bindings.iter().any(|binding| matches!(binding, Binding::Object { index: 0x1000..=0x1FFF, .. }))
}

/// Returns the default value of an item, unless it is 0 or the maximum of its type. These values often have a special meaning.
fn default(item: &Item, ty: Type) -> Option<i128> {
    let number = match item.default {
        Some(Value::Int(number)) => number,
        _ => return None,
    };
    let (_, highest) = ty.integer_range()?;
    (number != 0 && number != highest).then_some(number)
}

fn comment(text: &str) -> String {
    match text {
        "" => String::new(),
        text => format!(" // {text}"),
    }
}
