//! Names of rows: whether they exist, are in one piece, and differ in more than their case.

use std::collections::HashMap;

use crate::check::context::Context;
use crate::check::names::{is_meant, place};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{CompactString, Device, Group, GroupKind, Item};
use crate::source::Span;
use crate::text::brief;

/// A name of a register with more words is a description, where the others are single words.
const NAME_WORDS: usize = 6;

/// Reports names that are missing, broken by a column, or descriptions.
pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let are_words = are_words(context.device);
    context.device.groups.iter().for_each(|group| whole(group, are_words, diagnostics));
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

/// Registers whose names differ by upper and lower case only. Equal names were told before.
fn case_only<'g>(names: &mut HashMap<CompactString, &'g Item>, item: &'g Item, diagnostics: &mut Diagnostics) {
    let first = *names.entry(item.name.to_lowercase()).or_insert(item);
    if first.name != item.name {
        let (name, other) = (brief(&item.name), brief(&first.name));
        let message = format!("`{name}` and `{other}` differ by upper and lower case only");
        let found = codes::NAME_TWICE.at(place(item), message).note_at(place(first), "the other one");
        diagnostics.push(found.help("manuals often spell one name in two ways"));
    }
}

fn registers(group: &Group, are_words: bool, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::new();
    for item in &group.items {
        let at = place(item);
        case_only(&mut names, item, diagnostics);
        if item.name.trim().is_empty() {
            diagnostics.push(codes::EMPTY_NAME.at(at, "the row has no name"));
        }
        if let Some(what) = description(&item.name, are_words) {
            let message = format!("`{}` has {what} in it", brief(&item.name));
            diagnostics.push(codes::BROKEN_NAME.at(at, message).help("write the name alone, and the rest as `doc`"));
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
    let found = codes::BROKEN_NAME.at(at, message);
    diagnostics.push(found.help(format!("write `{}`, if the manual's text does", brief(whole))));
}
