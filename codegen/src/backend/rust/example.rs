//! The example at the beginning of a device's documentation, which uses values of this device.

use super::context::Context;
use super::docs::{typed, WORDS};
use super::naming::handles::NamedItem;
use super::objects;
use super::value_type;
use super::walk::WalkModel;
use crate::ir::{Binding, Item, Type, Value};

/// Returns the lines of the example, which creates the driver, brings the device into the energized state, reads a
/// value and writes a value. Steps that the device does not support are left out. Returns no lines if the device has no
/// suitable value to read or write.
pub(super) fn lines(context: &Context<'_>, device_name: &str, walks: &[WalkModel]) -> Vec<String> {
    let calls: Vec<(&NamedItem<'_>, String)> = objects::calls(context).collect();
    let (read, write) = (readable(context, &calls), writable(context, &calls));
    if read.is_none() && write.is_none() {
        return Vec::new();
    }
    let mut lines = vec![String::new(), "```ignore".to_owned(), format!("let mut drive = {device_name}::new(client);")];
    lines.extend(walks.iter().find_map(|walk| {
        let state = walk.energized.as_ref()?;
        Some(format!("drive.{}(types::{}::{state}, Duration::from_secs(2))?;", walk.method, walk.states))
    }));
    lines.extend(read.map(|(entry, path)| {
        let unit = entry.item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
        format!("let value = drive.{path}.read()?;{}", comment(unit))
    }));
    lines.extend(write.map(|(entry, path, number)| {
        let item = entry.item;
        let shown = WORDS.of_item(item, &Value::Int(number), &|value| typed(value, context.base(item.ty)));
        format!("drive.{path}.write({number})?;{}", comment(&shown))
    }));
    lines.push("```".to_owned());
    lines
}

/// Returns the item that an example reads, preferably a measured value, and the call of its accessor.
pub(super) fn readable<'c, 'a>(
    context: &Context<'_>,
    calls: &'c [(&NamedItem<'a>, String)],
) -> Option<(&'c NamedItem<'a>, &'c str)> {
    let is_actual = |item: &Item| is_measured(context, item) && item.access.readable() && !item.access.writable();
    let by_preference: [&dyn Fn(&Item) -> bool; 3] =
        [&|item| is_actual(item) && item.mappable.tpdo, &is_actual, &|item| {
            item.access.readable() && !is_communication(item)
        }];
    let found = by_preference.iter().find_map(|is_it| calls.iter().find(|(entry, _)| is_it(entry.item)));
    found.map(|(entry, call)| (*entry, call.as_str()))
}

/// Returns the setting that an example writes, the call of its accessor, and its default value.
pub(super) fn writable<'c, 'a>(
    context: &Context<'_>,
    calls: &'c [(&NamedItem<'a>, String)],
) -> Option<(&'c NamedItem<'a>, &'c str, i128)> {
    let is_setting = |item: &Item| is_measured(context, item) && item.access.writable();
    calls.iter().filter(|(entry, _)| is_setting(entry.item)).find_map(|(entry, call)| {
        let number = default(entry.item, context.base(entry.item.ty))?;
        Some((*entry, call.as_str(), number))
    })
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

/// Returns the integer default value of an item, unless it is 0 or the maximum of its type. These values often have a
/// special meaning.
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
