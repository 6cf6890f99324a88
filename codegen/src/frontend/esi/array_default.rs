//! The default of a whole array that its first element has.

use std::borrow::Cow;
use std::collections::HashMap;

use super::entries::Entry;
use super::info_value::{Form, RawValue};
use super::object::RawSub;
use super::types::Types;
use crate::frontend::xml::Given;

/// Takes it apart: the first element keeps its part, and the others' parts come back by their position in `entries`.
///
/// `of_entry` has the sub-item of the object that each entry is described by.
pub(super) fn take_apart<'a>(
    types: &mut Types<'_, 'a>,
    entries: &[Entry<'_, 'a>],
    of_entry: &[Option<usize>],
    subs: &mut [RawSub<'a>],
) -> HashMap<usize, RawValue<'a>> {
    let mut parts = HashMap::new();
    for (first, entry) in entries.iter().enumerate().filter(|(_, entry)| entry.element == Some(1)) {
        // The other elements, of which the object says nothing.
        let others = entries.iter().zip(of_entry).skip(first + 1);
        let others = others.take_while(|(other, sub)| std::ptr::eq(other.field, entry.field) && sub.is_none()).count();
        let sub = of_entry.get(first).copied().flatten().and_then(|at| subs.get_mut(at));
        let Some(whole) = sub.and_then(|sub| sub.info.default.as_mut()) else { continue };
        let digits = types.bits(entry.ty).filter(|bits| bits % 8 == 0).map_or(0, |bits| bits as usize / 4);
        let data = without_blanks(&whole.given);
        let text = data.text.as_ref();
        let is_whole = text.len() == digits * (others + 1) && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        if whole.form != Form::Data || others == 0 || !is_whole {
            continue;
        }
        for number in 1..=others {
            parts.insert(first + number, RawValue { form: Form::Data, given: part(&data, number, digits) });
        }
        whole.given = part(&data, 0, digits);
    }
    parts
}

/// Data may be wrapped over lines.
fn without_blanks<'a>(given: &Given<'a>) -> Given<'a> {
    let is_blank = |letter: char| letter.is_ascii_whitespace();
    let text = match given.text.contains(is_blank) {
        true => Cow::Owned(given.text.replace(is_blank, "")),
        false => given.text.clone(),
    };
    Given { text, span: given.span }
}

/// A part, with a place of its own where the text is as long as its place.
fn part<'a>(whole: &Given<'a>, number: usize, digits: usize) -> Given<'a> {
    let range = number * digits..(number + 1) * digits;
    let is_verbatim = whole.text.len() == (whole.span.end - whole.span.start) as usize;
    let start = whole.span.start + range.start as u32;
    let text = match &whole.text {
        Cow::Borrowed(text) => Cow::Borrowed(&text[range]),
        Cow::Owned(text) => Cow::Owned(text[range].to_owned()),
    };
    let own = crate::source::Span { start, end: start + digits as u32, ..whole.span };
    Given { text, span: if is_verbatim { own } else { whole.span } }
}
