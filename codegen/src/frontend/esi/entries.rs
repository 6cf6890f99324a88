//! Entries that the data type of an object defines, and the assignment of the object's sub-items to these entries.

use super::data_type::RawField;
use super::object::{RawObject, RawSub};
use super::reader::Reader;
use super::types::Types;
use crate::collections::{HashMap, HashMapExt};
use crate::diagnostics::codes;
use crate::ir::Type;
use crate::number::hex8;
use crate::text::brief;

/// Number of possible sub-indices of an object, including sub-index 0.
const SUB_INDICES: u32 = 256;

/// Maximum number of diagnostics about repeated sub-indices of an object.
const MAX_REPORTED: usize = 16;

/// Entry (sub-index) that the data type of an object defines.
pub(super) struct Entry<'t, 'a> {
    pub sub_index: u8,
    pub ty: Type,
    pub field: &'t RawField<'a>,
    /// Number of the array element, counted from 1; `None` if the field is a single entry.
    pub element: Option<u32>,
}

/// Returns the entries of an object, sorted by sub-index. Each element of an array is a separate entry, unless the
/// array is read as a single value.
pub(super) fn of_object<'t, 'a>(
    reader: &mut Reader<'_, '_>,
    types: &Types<'_>,
    raw: &RawObject<'_>,
    ty: Type,
    fields: &'t [RawField<'a>],
) -> Vec<Entry<'t, 'a>> {
    let mut entries: Vec<Entry<'t, 'a>> = Vec::with_capacity(fields.len());
    let (mut next, mut is_reported) = (0u32, false);
    for (position, field) in fields.iter().enumerate() {
        let field_type = types.field(ty, position);
        let following = fields.get(position + 1).and_then(|field| field.sub_index);
        let (first, mut count, mut element) = span_of(types, field, field_type, next, following);
        if count > 1 && first.saturating_add(count) > SUB_INDICES {
            let message = format!(
                "the {count} elements of `{}` extend beyond sub-index 255, the highest sub-index",
                brief(&field.name.text)
            );
            reader.report(&codes::SUB_INDEX_RANGE, raw.origin.span, message, "kept as a single array value");
            (count, element) = (1, field_type);
        }
        for number in 0..count {
            let Some(sub_index) = first.checked_add(number).and_then(|sub| u8::try_from(sub).ok()) else {
                // Only the first field beyond sub-index 255 is reported, because a type may have many such fields, and
                // many objects may use the type.
                if !std::mem::replace(&mut is_reported, true) {
                    let message = "an object has at most 255 sub-indices after sub-index 0";
                    reader.report(&codes::SUB_INDEX_RANGE, field.origin.span, message, "left out");
                }
                break;
            };
            let number = (element != field_type || count > 1).then_some(number + 1);
            entries.push(Entry { sub_index, ty: element, field, element: number });
        }
        next = first.saturating_add(count);
    }
    sorted(reader, raw, entries)
}

/// Returns the first sub-index of a field, the number of its sub-indices, and their type.
fn span_of(types: &Types<'_>, field: &RawField<'_>, ty: Type, next: u32, following: Option<u16>) -> (u32, u32, Type) {
    let single = |first| (first, 1, ty);
    let given = field.sub_index.map(u32::from);
    let Some((element, lower, count)) = types.elements(ty) else { return single(given.unwrap_or(next)) };
    let first = given.unwrap_or_else(|| u32::try_from(lower).unwrap_or(0).max(next));
    // An array with an ETG.1000.6 type name (`ARRAY …`), or with elements that would overlap the next field, is a
    // single entry.
    let room = following.is_none_or(|following| u32::from(following) >= first.saturating_add(count));
    if field.ty.text.starts_with("ARRAY") || !room {
        return single(first);
    }
    (first, count, element)
}

fn sorted<'t, 'a>(
    reader: &mut Reader<'_, '_>,
    raw: &RawObject<'_>,
    mut entries: Vec<Entry<'t, 'a>>,
) -> Vec<Entry<'t, 'a>> {
    if entries.is_sorted_by(|one, other| one.sub_index < other.sub_index) {
        return entries;
    }
    entries.sort_by_key(|entry| entry.sub_index);
    let mut reported = 0;
    entries.dedup_by(|later, earlier| {
        let twice = later.sub_index == earlier.sub_index;
        reported += usize::from(twice);
        if twice && reported <= MAX_REPORTED {
            let message = format!("sub-index {} occurs twice", hex8(later.sub_index));
            let found = codes::ESI_DUPLICATE_OBJECT.at(later.field.origin.span, message).label("ignored");
            let found = found.note_at(earlier.field.origin.span, "this sub-item is used");
            reader.diagnostics.push(found.note_at(raw.origin.span, "object with this data type"));
        }
        twice
    });
    entries
}

/// Assignment of the sub-items of an object to the entries of its data type.
pub(super) struct Matched {
    /// For each entry, the position of its sub-item in the object; `None` if the object has no sub-item for the entry.
    pub of_entry: Vec<Option<usize>>,
    /// Positions of the sub-items that belong to no entry.
    pub extra: Vec<usize>,
}

/// Assigns each sub-item to the entry with the same name. If the name is unknown or not unique, assigns the sub-item to
/// the entry at the same position or to the next free entry. A sub-item without a free entry becomes an extra sub-item.
pub(super) fn match_up(reader: &mut Reader<'_, '_>, entries: &[Entry<'_, '_>], subs: &[RawSub<'_>]) -> Matched {
    let mut matched = Matched { of_entry: vec![None; entries.len()], extra: Vec::new() };
    let named = |entry: &Entry<'_, '_>, sub: &RawSub<'_>| sub.name.text == entry.field.name.text;
    // The data type declares no names for array elements, so an array element matches a sub-item with any name.
    let fits = |(entry, sub): (&Entry<'_, '_>, &RawSub<'_>)| entry.element.is_some() || named(entry, sub);
    if entries.iter().zip(subs).all(fits) && subs.len() <= entries.len() {
        (0..subs.len()).zip(&mut matched.of_entry).for_each(|(at, sub)| *sub = Some(at));
        return matched;
    }
    let singles = entries.iter().enumerate().filter(|(_, entry)| entry.element.is_none_or(|number| number == 1));
    let singles: Vec<_> = singles.collect();
    let mut by_name: HashMap<&str, usize> = HashMap::with_capacity(entries.len());
    for &(at, entry) in &singles {
        by_name.entry(entry.field.name.text.as_ref()).or_insert(at);
    }
    if by_name.len() < singles.len() && subs.len() == entries.len() {
        // A repeated name does not identify an entry, so the sub-items are assigned by position.
        return by_position(reader, entries, subs);
    }
    let mut next = 0;
    for (at, sub) in subs.iter().enumerate() {
        let free = |position: &usize| matched.of_entry.get(*position).is_some_and(Option::is_none);
        let by_name = by_name.get(sub.name.text.as_ref()).copied().filter(free);
        let by_position = || Some(at).filter(|_| subs.len() == entries.len()).filter(free);
        let Some(position) = by_name.or_else(by_position).or_else(|| (next..entries.len()).find(free)) else {
            matched.extra.push(at);
            continue;
        };
        next = position + 1;
        if let Some(sub) = matched.of_entry.get_mut(position) {
            *sub = Some(at);
        }
        let guessed = by_name.is_none() && subs.len() != entries.len();
        if let Some(entry) = entries.get(position).filter(|entry| guessed && entry.element.is_none()) {
            by_position_only(reader, entry, sub);
        }
    }
    matched
}

/// Assigns each sub-item of the object to the entry at the same position.
fn by_position(reader: &mut Reader<'_, '_>, entries: &[Entry<'_, '_>], subs: &[RawSub<'_>]) -> Matched {
    for (entry, sub) in entries.iter().zip(subs) {
        let (name, of_type) = (&sub.name.text, &entry.field.name.text);
        if entry.element.is_none() && name != of_type {
            let message = format!("the sub-item `{}` has the name `{}` in the data type", brief(name), brief(of_type));
            let label = format!("read as sub-index {} because the data type repeats a name", hex8(entry.sub_index));
            mismatch(reader, entry, sub, message, label);
        }
    }
    Matched { of_entry: (0..subs.len()).map(Some).collect(), extra: Vec::new() }
}

fn by_position_only(reader: &mut Reader<'_, '_>, entry: &Entry<'_, '_>, sub: &RawSub<'_>) {
    let message = format!("the data type has no sub-item `{}`", brief(&sub.name.text));
    let label = format!("read as sub-index {} because of its position", hex8(entry.sub_index));
    mismatch(reader, entry, sub, message, label);
}

fn mismatch(reader: &mut Reader<'_, '_>, entry: &Entry<'_, '_>, sub: &RawSub<'_>, message: String, label: String) {
    let found = codes::SUB_ITEM_MISMATCH.at(sub.name.span.or(sub.origin.span), message).label(label);
    reader
        .diagnostics
        .push(found.note_at(entry.field.name.span.or(entry.field.origin.span), "sub-item of the data type"));
}
