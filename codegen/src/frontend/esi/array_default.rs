//! Splits the default value and limits of a whole array into those of the elements. Some files declare the values of
//! the whole array on the first element.

use std::borrow::Cow;

use super::entries::Entry;
use super::info_value::{Form, RawInfo, RawValue};
use super::object::RawSub;
use super::types::Types;
use crate::collections::HashMap;

/// Selects the field to set: the default value, the minimum or the maximum.
type Target<'a> = for<'i> fn(&'i mut RawInfo<'a>) -> &'i mut Option<RawValue<'a>>;

/// Splits the default value and the limits of each array into one part per element. Stores the part of the first
/// element in `subs`. Returns the parts of the other elements, by the position of the element in `entries`.
///
/// For each entry, `of_entry` contains the position of its sub-item in `subs`.
pub(super) fn split<'a>(
    types: &Types<'_>,
    entries: &[Entry<'_, 'a>],
    of_entry: &[Option<usize>],
    subs: &mut [RawSub<'a>],
) -> HashMap<usize, RawInfo<'a>> {
    let mut parts: HashMap<usize, RawInfo<'a>> = HashMap::default();
    for (first, entry) in entries.iter().enumerate().filter(|(_, entry)| entry.element == Some(1)) {
        // Only the elements that directly follow the first element, and have no sub-item in the object, get a part of
        // the value.
        let others = entries.iter().zip(of_entry).skip(first + 1);
        let others = others.take_while(|(other, sub)| std::ptr::eq(other.field, entry.field) && sub.is_none()).count();
        let Some(sub) = of_entry.get(first).copied().flatten().and_then(|at| subs.get_mut(at)) else { continue };
        let digits = types.bits(entry.ty).filter(|bits| bits % 8 == 0).map_or(0, |bits| bits as usize / 4);
        let mut take = |whole: &mut RawValue<'a>, target: Target<'a>| {
            for (number, value) in divide(whole, others, digits).into_iter().enumerate() {
                *target(parts.entry(first + 1 + number).or_default()) = Some(value);
            }
        };
        let RawInfo { default, more, display: _ } = &mut sub.info;
        default.iter_mut().for_each(|whole| take(whole, |info| &mut info.default));
        for more in more.iter_mut() {
            more.min.iter_mut().for_each(|whole| take(whole, |info| &mut info.more().min));
            more.max.iter_mut().for_each(|whole| take(whole, |info| &mut info.more().max));
        }
    }
    parts
}

/// Shortens `whole` to the part of the first element and returns the parts of the `others` following elements. Each
/// part has `digits` digits. Returns an empty list and leaves `whole` unchanged if `others` is 0, or if `whole` is not
/// hexadecimal data with the length of the array.
fn divide<'a>(whole: &mut RawValue<'a>, others: usize, digits: usize) -> Vec<RawValue<'a>> {
    let data = without_blanks(whole);
    let text = data.text.as_ref();
    let is_whole = text.len() == digits * (others + 1) && text.bytes().all(|digit| digit.is_ascii_hexdigit());
    if whole.form != Form::Data || others == 0 || !is_whole {
        return Vec::new();
    }
    *whole = part(&data, 0, digits);
    (1..=others).map(|number| part(&data, number, digits)).collect()
}

/// Returns the data without white space. Files may wrap long data over several lines.
fn without_blanks<'a>(value: &RawValue<'a>) -> RawValue<'a> {
    let is_blank = |letter: char| letter.is_ascii_whitespace();
    let text = match value.text.contains(is_blank) {
        true => Cow::Owned(value.text.replace(is_blank, "")),
        false => value.text.clone(),
    };
    RawValue { text, ..*value }
}

/// Returns the data of the element `number`, counted from 0. The result has the span of the whole value if the data differ from
/// the text of the file, for example because white space was removed.
fn part<'a>(whole: &RawValue<'a>, number: usize, digits: usize) -> RawValue<'a> {
    let range = number * digits..(number + 1) * digits;
    let is_verbatim = whole.text.len() == (whole.span.end - whole.span.start) as usize;
    let start = whole.span.start + range.start as u32;
    let text = match &whole.text {
        Cow::Borrowed(text) => Cow::Borrowed(&text[range]),
        Cow::Owned(text) => Cow::Owned(text[range].to_owned()),
    };
    let part = crate::source::Span { start, end: start + digits as u32, ..whole.span };
    RawValue { text, span: if is_verbatim { part } else { whole.span }, form: whole.form }
}
