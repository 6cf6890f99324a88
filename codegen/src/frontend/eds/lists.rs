//! Reads the object lists and compares them with the objects that the file describes.

use super::reader::Reader;
use super::sections::List;
use crate::diagnostics::codes;
use crate::ir::{Device, Extensions, Group};
use crate::number::hex16;
use crate::source::Span;
use crate::syntax::ini::{Entry, Section};

/// Indices in the object lists of a file, each with its list and its span.
#[derive(Default)]
pub(super) struct Lists {
    listed: Vec<(u16, List, Span)>,
}

impl Lists {
    pub(super) fn read(&mut self, reader: &mut Reader<'_, '_>, list: List, sections: &[Section], device: &mut Device) {
        for entry in &numbered(reader, sections, "SupportedObjects", &mut device.extensions) {
            self.listed.extend(reader.index_of(entry).map(|index| (index, list, reader.doc.value_span(entry))));
        }
        reader.take_comments(&mut device.extensions);
    }

    pub(super) fn supported_modules(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device) {
        let mut earlier = None;
        for entry in reader.doc.entries_of(sections) {
            if reader.doc.key(&entry).eq_ignore_ascii_case("NrOfEntries") {
                reader.once(&mut earlier, &entry);
                let span = reader.doc.value_span(&entry);
                reader.announced_modules = reader.unsigned(&entry, 0xFFFF).map(|count| (count, span));
            } else {
                reader.extension(&entry, &mut device.extensions);
            }
        }
        if earlier.is_none() {
            reader.missing_entry(sections, "NrOfEntries");
        }
    }
}

/// Reads the numbered entries (`1=`, `2=` …) of a list, and compares their number with the value of `count_key`.
/// Sections with the same name form one list. The last entry applies if a number is repeated.
pub(super) fn numbered(
    reader: &mut Reader<'_, '_>,
    sections: &[Section],
    count_key: &str,
    extensions: &mut Extensions,
) -> Vec<Entry> {
    let (entries, count) = by_number(reader, sections, count_key, |reader, entry| reader.extension(entry, extensions));
    let gap = entries.iter().zip(1..).find(|((number, _), expected)| number != expected);
    let agrees = match count {
        Some(count) => announced_count(reader, &count, entries.len(), gap.is_some()),
        None => {
            reader.missing_entry(sections, count_key);
            true
        }
    };
    if let (Some(((number, entry), expected)), true) = (gap, agrees) {
        let message = format!("this entry of the list has the number {number} instead of {expected}");
        let found = codes::LIST_COUNT.at(reader.doc.key_span(entry), message).label("the existing entries are used");
        reader.diagnostics.push(found.help(NO_GAP));
    }
    entries.into_iter().map(|(_, entry)| entry).collect()
}

const NO_GAP: &str = "number the entries from 1 without a gap";

/// Returns the entries of a list whose keys are decimal sub-indices, each with its sub-index. The list may skip sub-indices.
/// Compares the number of entries with `NrOfEntries`, and passes entries with any other key to `others`.
pub(super) fn by_sub_index(
    reader: &mut Reader<'_, '_>,
    section: &Section,
    others: impl FnMut(&mut Reader<'_, '_>, &Entry),
) -> Vec<(u32, Entry)> {
    let section = std::slice::from_ref(section);
    let (entries, count) = by_number(reader, section, "NrOfEntries", others);
    match count {
        Some(count) => _ = announced_count(reader, &count, entries.len(), false),
        None => reader.missing_entry(section, "NrOfEntries"),
    }
    entries
}

/// Returns the entries with decimal keys in ascending order, and the entry with the key `count_key`. Leaves out empty
/// entries and earlier duplicates. Passes entries with neither a decimal key nor the key `count_key` to `others`.
fn by_number(
    reader: &mut Reader<'_, '_>,
    sections: &[Section],
    count_key: &str,
    mut others: impl FnMut(&mut Reader<'_, '_>, &Entry),
) -> (Vec<(u32, Entry)>, Option<Entry>) {
    let doc = reader.doc;
    let mut entries: Vec<(u32, Entry)> = Vec::new();
    let mut count = None;
    for entry in doc.entries_of(sections) {
        if let Some(number) = reader.key_number(&entry) {
            entries.push((number, entry));
        } else if doc.key(&entry).eq_ignore_ascii_case(count_key) {
            reader.once(&mut count, &entry);
        } else {
            others(reader, &entry);
        }
    }
    if !entries.is_sorted_by(|earlier, later| earlier.0 < later.0) {
        entries.sort_by_key(|&(number, _)| number);
        for pair in entries.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            reader.duplicate_key(&pair[0].1, &pair[1].1);
        }
        // The stable sort keeps duplicates in file order. The reversal makes `dedup_by_key` keep the last duplicate.
        entries.reverse();
        entries.dedup_by_key(|&mut (number, _)| number);
        entries.reverse();
    }
    entries.retain(|(_, entry)| !doc.value(entry).is_empty());
    (entries, count)
}

/// Returns false if `entry` announces a number other than `count`. Reports such a number, and an unreadable or
/// hexadecimal number. The diagnostic about a wrong number has no fix if the list has a gap. With a gap, the announced
/// number may be correct and the numbering of the entries wrong.
pub(super) fn announced_count(reader: &mut Reader<'_, '_>, entry: &Entry, count: usize, has_gap: bool) -> bool {
    let Some(announced) = reader.unsigned(entry, 0xFFFF) else { return true };
    let (key, text, span) = (reader.doc.key(entry), reader.doc.value(entry), reader.doc.value_span(entry));
    if announced as usize != count {
        let message = format!("{key} is {announced}, but the number of entries in the list is {count}");
        let found = codes::LIST_COUNT.at(span, message).label("the existing entries are used");
        reader.diagnostics.push(if has_gap { found.help(NO_GAP) } else { found.fix(count.to_string()) });
        return false;
    }
    if text.starts_with("0x") || text.starts_with("0X") {
        let message = format!("{key} is a hexadecimal number, which many tools cannot read");
        let found = codes::HEX_COUNT.at(span, message).label(format!("read as {announced}"));
        reader.diagnostics.push(found.fix(announced.to_string()));
    }
    true
}

/// Set of object indices, stored as bits.
struct Indices {
    /// Minimum index of the set, divided by 64.
    first: u16,
    words: Vec<u64>,
}

impl Indices {
    /// Creates an empty set with space for the indices `all`.
    fn new(all: impl Iterator<Item = u16> + Clone) -> Self {
        let first = all.clone().min().unwrap_or(0) / 64;
        Indices { first, words: vec![0; usize::from(all.max().unwrap_or(0) / 64 - first) + 1] }
    }

    /// Adds `index` to the set. Returns true if the set did not contain the index.
    fn insert(&mut self, index: u16) -> bool {
        let word = (index / 64).checked_sub(self.first).and_then(|word| self.words.get_mut(usize::from(word)));
        let Some(word) = word else { return false };
        let (before, bit) = (*word, 1 << (index % 64));
        *word |= bit;
        before & bit == 0
    }

    fn contains(&self, index: u16) -> bool {
        let word = (index / 64).checked_sub(self.first).and_then(|word| self.words.get(usize::from(word)));
        word.is_some_and(|word| word >> (index % 64) & 1 == 1)
    }
}

/// Compares the object lists with the objects of `device`.
pub(super) fn check(reader: &mut Reader<'_, '_>, lists: &Lists, device: &Device) {
    let indices = device.groups.iter().filter_map(Group::index);
    let mut described = Indices::new(indices.clone());
    for index in indices {
        described.insert(index);
    }
    let mut listed = Indices::new(lists.listed.iter().map(|&(index, ..)| index));
    for &(index, list, span) in &lists.listed {
        if !listed.insert(index) {
            let message = format!("{} is listed twice", hex16(index));
            reader.diagnostics.push(codes::LISTED_TWICE.at(span, message));
        }
        if !described.contains(index) {
            let message = format!("{} is listed, but the section [{index:04X}] is missing", hex16(index));
            reader.report(&codes::LISTED_NOT_DESCRIBED, span, message, "the object is left out");
        }
        let right = belongs(index);
        if right != Some(list) {
            let message = format!("object {} is in the wrong list", hex16(index));
            let label = match right {
                Some(right) => format!("it belongs in [{}]", right.name()),
                None => "objects in the data type area belong in no list".to_owned(),
            };
            reader.diagnostics.push(codes::WRONG_LIST.at(span, message).label(label));
        }
    }
    not_listed(reader, lists, &listed, device);
    for (index, span) in std::mem::take(&mut reader.link_spans) {
        if !described.contains(index) {
            let message = format!("the link refers to {}, which the file does not describe", hex16(index));
            reader.diagnostics.push(codes::DANGLING_LINK.at(span, message));
        }
    }
}

fn not_listed(reader: &mut Reader<'_, '_>, lists: &Lists, listed: &Indices, device: &Device) {
    if lists.listed.is_empty() {
        if let Some(group) = device.groups.first() {
            let found =
                codes::NOT_LISTED.at(group.origin.span, "the object lists of the file are empty").label("first object");
            let help = "list the objects in [MandatoryObjects], [OptionalObjects] and [ManufacturerObjects]";
            reader.diagnostics.push(found.help(help));
        }
        return;
    }
    for group in &device.groups {
        let Some(index) = group.index().filter(|&index| index >= 0x1000) else { continue };
        if !listed.contains(index) {
            let message = format!("object {} is described, but is in no object list", hex16(index));
            reader.diagnostics.push(codes::NOT_LISTED.at(group.origin.span, message));
        }
    }
}

impl List {
    fn name(self) -> &'static str {
        match self {
            List::Mandatory => "MandatoryObjects",
            List::Optional => "OptionalObjects",
            List::Manufacturer => "ManufacturerObjects",
        }
    }
}

/// Returns the list to which an index belongs, or `None` for the data type area below 0x1000.
fn belongs(index: u16) -> Option<List> {
    match index {
        0x0000..=0x0FFF => None,
        0x1000 | 0x1001 | 0x1018 => Some(List::Mandatory),
        0x2000..=0x5FFF => Some(List::Manufacturer),
        _ => Some(List::Optional),
    }
}
