//! Looks up objects of a device by address or name.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::{Device, Group, Item};
use lexibus_codegen::number::{hex16, written_object};
use lexibus_codegen::text::similar;

use crate::declared::ObjectName;
use crate::syntax::At;

/// Returns the item that a file names, with its address. Reports an item that the device does not have, and a name that is not
/// unique.
pub(crate) fn find<'d>(
    device: &'d Device,
    object: &At<ObjectName>,
    diagnostics: &mut Diagnostics,
) -> Option<(&'d Item, (u16, u8))> {
    match &object.value {
        ObjectName::Address(index, sub_index) => match device.entry(*index, *sub_index) {
            Some(item) => Some((item, (*index, *sub_index))),
            None => {
                diagnostics.push(no_address(device, object, *index, *sub_index));
                None
            }
        },
        ObjectName::Name(name) => by_name(device, object, name, diagnostics),
    }
}

/// Formats the address of an object: `0x6040`, `0x60C2:1`. Sub-index 0 is left out.
pub(crate) fn address(object: (u16, u8)) -> String {
    let (index, sub_index) = object;
    match sub_index {
        0 => hex16(index),
        sub_index => written_object(index, sub_index),
    }
}

fn no_address(device: &Device, object: &At<ObjectName>, index: u16, sub_index: u8) -> Diagnostic {
    let name = shown(device);
    let Some(group) = device.object(index) else {
        let found = diagnostic(object, format!("{name} has no object {}", hex16(index)));
        let nearest = device.groups.iter().filter_map(Group::index).min_by_key(|other| distance(*other, index));
        return match nearest.and_then(|index| device.object(index)) {
            Some(group) => {
                found.help(format!("the nearest object is {} `{}`", hex16(group.index().unwrap_or(0)), group.name))
            }
            None => found,
        };
    };
    let message = format!("object {} `{}` of {name} has no sub-index {sub_index}", hex16(index), group.name);
    let subs: Vec<String> = group.items.iter().filter_map(|item| Some(item.object()?.1.to_string())).take(8).collect();
    diagnostic(object, message).help(format!("use one of the sub-indices {}", subs.join(", ")))
}

/// Returns how different two indices are: the number of different hexadecimal digits, then the difference.
fn distance(one: u16, other: u16) -> (u32, u16) {
    let digits = (0..4).filter(|digit| (one ^ other) >> (4 * digit) & 0xF != 0).count();
    (digits as u32, one.abs_diff(other))
}

fn diagnostic(object: &At<ObjectName>, message: String) -> Diagnostic {
    Diagnostic::new(&codes::NO_SUCH_OBJECT, object.span, message)
}

fn shown(device: &Device) -> String {
    match device.name.as_str() {
        "" => "the device".to_owned(),
        name => format!("`{name}`"),
    }
}

/// Returns the two names by which a file can refer to an item. The second one begins with the name of the object and a
/// slash.
fn names<'d>(group: &'d Group, item: &'d Item) -> [String; 2] {
    [item.name.to_string(), format!("{}/{}", group.name, item.name)]
}

/// Returns a name in lower case, with only its letters, digits and slashes.
fn folded(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric() || *letter == '/').flat_map(char::to_lowercase).collect()
}

/// Returns all items of a device that have an object address, with their groups and addresses.
fn all(device: &Device) -> impl Iterator<Item = (&Group, &Item, (u16, u8))> {
    let items = device.groups.iter().flat_map(|group| group.items.iter().map(move |item| (group, item)));
    items.filter_map(|(group, item)| Some((group, item, item.object()?)))
}

/// Returns the items with a name, and their addresses. If no item has exactly this name, ignores case, and compares only
/// letters, digits and slashes.
pub(crate) fn named<'d>(device: &'d Device, name: &str) -> Vec<(&'d Item, (u16, u8))> {
    let matching = |is_match: &dyn Fn(&str) -> bool| {
        let found = all(device).filter(|(group, item, _)| names(group, item).iter().any(|name| is_match(name)));
        found.map(|(_, item, address)| (item, address)).collect::<Vec<_>>()
    };
    let found = matching(&|other| other == name);
    if !found.is_empty() {
        return found;
    }
    let wanted = folded(name);
    matching(&|other| folded(other) == wanted)
}

/// Returns the diagnostic for a name that no item has.
pub(crate) fn no_name(device: &Device, object: &At<ObjectName>, name: &str) -> Diagnostic {
    diagnostic(object, format!("{} has no object `{name}`", shown(device)))
}

fn by_name<'d>(
    device: &'d Device,
    object: &At<ObjectName>,
    name: &str,
    diagnostics: &mut Diagnostics,
) -> Option<(&'d Item, (u16, u8))> {
    match named(device, name)[..] {
        [one] => Some(one),
        [] => {
            let names: Vec<String> = all(device).flat_map(|(group, item, _)| names(group, item)).collect();
            let found = no_name(device, object, name);
            let similar = similar(name, names.iter().map(String::as_str));
            diagnostics.push(match similar {
                Some(similar) => found.help(format!("write `{similar}`")),
                None => found.help("write the index, such as `0x6081` or `0x60C2:1`"),
            });
            None
        }
        ref several => {
            let addresses: Vec<String> = several.iter().take(8).map(|(_, object)| address(*object)).collect();
            let message = format!("`{name}` is the name of {} objects", several.len());
            let found = Diagnostic::new(&codes::SEVERAL_OBJECTS, object.span, message);
            diagnostics.push(found.help(format!("write the address of one object: {}", addresses.join(", "))));
            None
        }
    }
}
