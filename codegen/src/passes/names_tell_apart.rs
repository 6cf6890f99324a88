//! After this pass the names of a register table's rows were held against each other, and against the breaks that a
//! printed column puts into them.

use std::collections::HashMap;

use super::bit_fields_checked::told_apart;
use super::firmware_comparable::apart;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{BitFieldEntry, CompactString, Device, EnumValue, Group, GroupKind, Item, Shape, TypeDef};
use crate::source::Span;
use crate::text::brief;

/// A name of a register with more words is a description, where the others are single words.
const NAME_WORDS: usize = 6;

/// Of other formats than tables, names are compared where the user asks for it: tools number their objects, and call many
/// alike.
pub(super) fn run(device: &Device, is_table: bool, diagnostics: &mut Diagnostics) {
    if is_table {
        let are_words = are_words(device);
        device.groups.iter().for_each(|group| whole(group, are_words, diagnostics));
    }
    if !is_table && !diagnostics.asks_for(&codes::NAME_TWICE) {
        return;
    }
    let mut names = HashMap::new();
    for group in &device.groups {
        if let GroupKind::Object { index, .. } = group.kind {
            once(&mut names, &group.name, group.name_at.or(group.origin.span), "another object", diagnostics);
            if group.object_code().is_some_and(|code| code.has_subs()) {
                subs(group, index, diagnostics);
            }
        }
    }
    device.types.iter().for_each(|definition| meanings(definition, diagnostics));
}

/// Whether every name is there, and in one piece.
fn whole(group: &Group, are_words: bool, diagnostics: &mut Diagnostics) {
    match group.kind {
        GroupKind::Object { .. } => {
            unbroken(&group.name, group.name_at.or(group.origin.span), diagnostics);
            if group.object_code().is_some_and(|code| code.has_subs()) {
                for item in group.items.iter().filter(is_meant) {
                    unbroken(&item.name, place(item), diagnostics);
                }
            }
        }
        GroupKind::Chapter => registers(group, are_words, diagnostics),
        _ => {}
    }
}

fn place(item: &Item) -> Span {
    item.at.name.or(item.origin.span)
}

/// Of a reserved sub-index there is nothing to say.
fn is_meant(item: &&Item) -> bool {
    !item.extensions.iter().any(|own| own.key == "reserved")
}

/// The bits of a bit field, or the values of an enumeration. Names that depend on something may return.
fn meanings(definition: &TypeDef, diagnostics: &mut Diagnostics) {
    let twice: Option<(&str, String, String)> = match &definition.shape {
        Shape::BitField { fields, .. } => {
            let place = |field: &BitFieldEntry| match field.bits {
                1 => format!("bit {}", field.offset),
                bits => format!("bits {}-{}", u32::from(field.offset) + u32::from(bits) - 1, field.offset),
            };
            let found = repeated(fields.iter(), |field| field.name.as_str(), told_apart);
            found.map(|(one, other)| (one.name.as_str(), place(one), place(other)))
        }
        Shape::Enumeration { values, .. } => {
            let apart =
                |one: &EnumValue, other: &EnumValue| apart(one.availability.as_deref(), other.availability.as_deref());
            let named = values.iter().filter(|value| value.zone.is_none());
            let found = repeated(named, |value| value.name.as_str(), apart);
            found.map(|(one, other)| (one.name.as_str(), one.value.to_string(), other.value.to_string()))
        }
        _ => None,
    };
    if let Some((name, one, other)) = twice {
        let message = format!("{one} and {other} of `{}` are both called `{}`", brief(&definition.name), brief(name));
        let found = Diagnostic::new(&codes::NAME_TWICE, definition.origin.span, message);
        diagnostics.push(found.help("give one of them the name that the manual means, or say what tells them apart"));
    }
}

/// The first two that have one name.
fn repeated<'v, V>(
    list: impl Iterator<Item = &'v V>,
    name: impl Fn(&'v V) -> &'v str,
    apart: impl Fn(&V, &V) -> bool,
) -> Option<(&'v V, &'v V)> {
    let mut seen: HashMap<&str, &V> = HashMap::new();
    for own in list.filter(|own| !name(own).is_empty()) {
        match seen.get(name(own)) {
            Some(first) if !apart(first, own) => return Some((*first, own)),
            _ => seen.insert(name(own), own),
        };
    }
    None
}

fn subs(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::new();
    let other = format!("another sub-index of 0x{index:04X}");
    for item in group.items.iter().filter(is_meant) {
        once(&mut names, &item.name, place(item), &other, diagnostics);
    }
}

/// Registers whose names differ by upper and lower case only. Equal names were told before.
fn case_only<'g>(names: &mut HashMap<CompactString, &'g Item>, item: &'g Item, diagnostics: &mut Diagnostics) {
    let first = *names.entry(item.name.to_lowercase()).or_insert(item);
    if first.name != item.name {
        let (name, other) = (brief(&item.name), brief(&first.name));
        let message = format!("`{name}` and `{other}` differ by upper and lower case only");
        let found = Diagnostic::new(&codes::NAME_TWICE, place(item), message).note_at(place(first), "the other one");
        diagnostics.push(found.help("manuals often spell one name in two ways"));
    }
}

fn registers(group: &Group, are_words: bool, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::new();
    for item in &group.items {
        let at = place(item);
        case_only(&mut names, item, diagnostics);
        if item.name.trim().is_empty() {
            diagnostics.push(Diagnostic::new(&codes::EMPTY_NAME, at, "the row has no name"));
        }
        if let Some(what) = description(&item.name, are_words) {
            let message = format!("`{}` has {what} in it", brief(&item.name));
            let found = Diagnostic::new(&codes::BROKEN_NAME, at, message);
            diagnostics.push(found.help("write the name alone, and the rest as `doc`"));
        } else if !unbroken(&item.name, at, diagnostics) {
            syllables(&item.name, at, diagnostics);
        }
    }
}

/// Whether a table's registers are called by single words, as three of four are. Descriptions don't count.
fn are_words(device: &Device) -> bool {
    let chapters = device.groups.iter().filter(|group| matches!(group.kind, GroupKind::Chapter));
    let words = chapters.flat_map(|group| &group.items).map(|item| item.name.split_whitespace().count());
    let (single, several) = words.fold((0, 0), |(single, several), words| match words {
        1 => (single + 1, several),
        2..=NAME_WORDS => (single, several + 1),
        _ => (single, several),
    });
    single > 3 * several
}

/// What stands in a name that is none: the cell beside it was pasted into its own.
fn description(name: &str, are_words: bool) -> Option<&'static str> {
    match () {
        () if name.contains('<') => Some("a tag"),
        () if name.contains('=') => Some("values"),
        () if are_words && name.split_whitespace().count() > NAME_WORDS => Some("a description"),
        () => None,
    }
}

/// A column breaks `Rcamstspctrl` into `Rcamstspc-trl`, too. `low-pass` is a word of small letters, and `CO-alarm` has an
/// abbreviation in front.
fn syllables(name: &str, at: Span, diagnostics: &mut Diagnostics) {
    let letters = || name.chars().zip(name.chars().skip(1)).zip(name.chars().skip(2));
    let is_broken = letters().any(|((before, mark), after)| {
        (before.is_lowercase() || before.is_numeric()) && mark == '-' && after.is_lowercase()
    });
    if is_broken && name.contains(char::is_uppercase) && !name.contains(char::is_whitespace) {
        broken(name, &name.replace('-', ""), at, diagnostics);
    }
}

fn once<'n>(seen: &mut HashMap<&'n str, Span>, name: &'n str, at: Span, whose: &str, diagnostics: &mut Diagnostics) {
    if name.is_empty() {
        return;
    }
    let first = *seen.entry(name).or_insert(at);
    if first != at {
        let message = format!("{whose} is called `{}` too", brief(name));
        diagnostics.push(Diagnostic::new(&codes::NAME_TWICE, at, message).note_at(first, "the first one"));
    }
}

/// A column of a manual breaks `Rtouchprobefunc` into `Rtouchpro- befunc`. Returns whether this one is broken.
fn unbroken(name: &str, at: Span, diagnostics: &mut Diagnostics) -> bool {
    let is_broken = name.split_once("- ").is_some_and(|(head, tail)| {
        head.ends_with(char::is_alphanumeric) && tail.trim_start().starts_with(char::is_alphanumeric)
    });
    if is_broken {
        broken(name, &name.replace("- ", ""), at, diagnostics);
    }
    is_broken
}

fn broken(name: &str, whole: &str, at: Span, diagnostics: &mut Diagnostics) {
    let message = format!("`{}` has the hyphen of a line break in it", brief(name));
    let found = Diagnostic::new(&codes::BROKEN_NAME, at, message);
    diagnostics.push(found.help(format!("write `{}`, if the manual's text does", brief(whole))));
}
