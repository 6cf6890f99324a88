//! Checks that row names exist, are not hyphenated at the edge of a table column, and are not descriptions. Also checks
//! that no two registers of a chapter have names that differ only in upper and lower case.

use crate::check::context::Context;
use crate::check::names::{has_meaning, name_span};
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{CompactString, Device, Group, GroupKind, Item};
use crate::source::Span;
use crate::text::brief;

/// The maximum number of words in a register name, if most other names are single words. A longer name is a description.
const NAME_WORDS: usize = 6;

/// Reports names that are missing, that are hyphenated at the edge of a table column, or that are descriptions. Also
/// reports names that differ only in upper and lower case.
pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let are_words = are_words(context.device);
    context.device.groups.iter().for_each(|group| whole(group, are_words, diagnostics));
}

/// Checks the names in a group. The names of objects are only checked for hyphenation at the edge of a table column.
fn whole(group: &Group, are_words: bool, diagnostics: &mut Diagnostics) {
    match group.kind {
        GroupKind::Object { .. } => {
            unbroken(&group.name, group.name_at.or(group.origin.span), diagnostics);
            if group.object_code().is_some_and(|code| code.has_subs()) {
                for item in group.items.iter().filter(has_meaning) {
                    unbroken(&item.name, name_span(item), diagnostics);
                }
            }
        }
        GroupKind::Chapter => registers(group, are_words, diagnostics),
        _ => {}
    }
}

/// Reports a register whose name differs from an earlier name only in upper and lower case. Equal names are skipped,
/// because they were already reported.
fn case_only<'g>(names: &mut HashMap<CompactString, &'g Item>, item: &'g Item, diagnostics: &mut Diagnostics) {
    let first = *names.entry(item.name.to_lowercase()).or_insert(item);
    if first.name != item.name {
        let (name, other) = (brief(&item.name), brief(&first.name));
        let message = format!("the names `{name}` and `{other}` differ only in case");
        let found = codes::NAME_TWICE.at(name_span(item), message).note_at(name_span(first), "the other name");
        diagnostics.push(found.help("use one spelling if both are the same name"));
    }
}

fn registers(group: &Group, are_words: bool, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::default();
    for item in &group.items {
        let at = name_span(item);
        case_only(&mut names, item, diagnostics);
        if item.name.trim().is_empty() {
            diagnostics.push(codes::EMPTY_NAME.at(at, "the row has no name"));
        }
        if let Some(what) = description(&item.name, are_words) {
            let message = format!("the name `{}` contains {what}", brief(&item.name));
            diagnostics
                .push(codes::BROKEN_NAME.at(at, message).help("write only the name, and move the rest to `doc`"));
        } else if !unbroken(&item.name, at, diagnostics) {
            syllables(&item.name, at, diagnostics);
        }
    }
}

/// Returns whether the names of more than three in four registers are single words. Names that are descriptions do not
/// count.
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

/// Returns a noun for the text in a name that was probably pasted from a neighboring cell: a tag, values or a
/// description.
fn description(name: &str, are_words: bool) -> Option<&'static str> {
    match () {
        () if name.contains('<') => Some("a tag"),
        () if name.contains('=') => Some("values"),
        () if are_words && name.split_whitespace().count() > NAME_WORDS => Some("a description"),
        () => None,
    }
}

/// Reports a name with a hyphen from a line break in a narrow table column, such as `Rcamstspc-trl` for `Rcamstspctrl`. Names of
/// several words, words in lower case (`low-pass`) and names that begin with an abbreviation (`CO-alarm`) are not reported.
fn syllables(name: &str, at: Span, diagnostics: &mut Diagnostics) {
    let letters = || name.chars().zip(name.chars().skip(1)).zip(name.chars().skip(2));
    let is_broken = letters().any(|((before, mark), after)| {
        (before.is_lowercase() || before.is_numeric()) && mark == '-' && after.is_lowercase()
    });
    if is_broken && name.contains(char::is_uppercase) && !name.contains(char::is_whitespace) {
        broken(name, &name.replace('-', ""), at, diagnostics);
    }
}

/// Reports a name with a hyphen and a space from a line break in a narrow table column, such as `Rtouchpro- befunc` for
/// `Rtouchprobefunc`. Returns whether the name contains such a hyphen.
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
    let message = format!("the name `{}` probably contains a hyphen from a line break", brief(name));
    let found = codes::BROKEN_NAME.at(at, message);
    diagnostics.push(found.help(format!("write `{}` if the manual's text does", brief(whole))));
}
