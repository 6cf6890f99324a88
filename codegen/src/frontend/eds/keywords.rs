//! Keywords of an object, and the assignment of section entries to keywords.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::ir::Extensions;
use crate::source::Origin;
use crate::syntax::ini::{Entries, Entry, Section};
use crate::syntax::words;
use crate::text::edit_distance;

/// Keyword of an object. The discriminant is the position of the keyword's entry in [`Raw`].
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Key {
    ParameterName,
    ObjectType,
    SubNumber,
    DataType,
    AccessType,
    DefaultValue,
    PdoMapping,
    LowLimit,
    HighLimit,
    ObjFlags,
    CompactSubObj,
    ParameterValue,
    Denotation,
    UploadFile,
    DownloadFile,
    SrdoMapping,
    InvertedSrad,
}

/// Number of keywords in [`Key`].
pub(super) const KEYS: usize = 17;

/// All keywords with their names, in the order of [`Key`].
const NAMES: [(&str, Key); KEYS] = [
    ("ParameterName", Key::ParameterName),
    ("ObjectType", Key::ObjectType),
    ("SubNumber", Key::SubNumber),
    ("DataType", Key::DataType),
    ("AccessType", Key::AccessType),
    ("DefaultValue", Key::DefaultValue),
    ("PDOMapping", Key::PdoMapping),
    ("LowLimit", Key::LowLimit),
    ("HighLimit", Key::HighLimit),
    ("ObjFlags", Key::ObjFlags),
    ("CompactSubObj", Key::CompactSubObj),
    ("ParameterValue", Key::ParameterValue),
    ("Denotation", Key::Denotation),
    ("UploadFile", Key::UploadFile),
    ("DownloadFile", Key::DownloadFile),
    ("SRDOMapping", Key::SrdoMapping),
    ("InvertedSRAD", Key::InvertedSrad),
];

/// Returns the keyword that is spelled `key`, ignoring case. The length and the first letter of `key` leave at most two
/// candidate keywords.
fn keyword(key: &[u8]) -> Option<Key> {
    let (name, keyword) = match (key.len(), key.first()? | 0x20) {
        (8, b'd') => ("DataType", Key::DataType),
        (8, b'l') => ("LowLimit", Key::LowLimit),
        (8, b'o') => ("ObjFlags", Key::ObjFlags),
        (9, b'h') => ("HighLimit", Key::HighLimit),
        (9, b's') => ("SubNumber", Key::SubNumber),
        (10, b'o') => ("ObjectType", Key::ObjectType),
        (10, b'a') => ("AccessType", Key::AccessType),
        (10, b'p') => ("PDOMapping", Key::PdoMapping),
        (10, b'd') => ("Denotation", Key::Denotation),
        (10, b'u') => ("UploadFile", Key::UploadFile),
        (11, b's') => ("SRDOMapping", Key::SrdoMapping),
        (12, b'i') => ("InvertedSRAD", Key::InvertedSrad),
        (12, b'd') if key[1] | 0x20 == b'e' => ("DefaultValue", Key::DefaultValue),
        (12, b'd') => ("DownloadFile", Key::DownloadFile),
        (13, b'p') => ("ParameterName", Key::ParameterName),
        (13, b'c') => ("CompactSubObj", Key::CompactSubObj),
        (14, b'p') => ("ParameterValue", Key::ParameterValue),
        _ => return None,
    };
    let name = name.as_bytes();
    (words::equal_texts(name, key) || name.eq_ignore_ascii_case(key)).then_some(keyword)
}

/// Keywords that describe a single value, and have no meaning for an object whose values are in its sub-indices.
pub(super) const OF_A_VALUE: [Key; 12] = [
    Key::DataType,
    Key::AccessType,
    Key::DefaultValue,
    Key::PdoMapping,
    Key::LowLimit,
    Key::HighLimit,
    Key::ParameterValue,
    Key::Denotation,
    Key::UploadFile,
    Key::DownloadFile,
    Key::SrdoMapping,
    Key::InvertedSrad,
];

/// Keywords that only a DCF has.
pub(super) const OF_A_CONFIGURATION: [Key; 4] =
    [Key::ParameterValue, Key::Denotation, Key::UploadFile, Key::DownloadFile];

/// Keywords that describe an object with sub-indices, and have no meaning for a single value.
pub(super) const OF_MANY_VALUES: [Key; 2] = [Key::SubNumber, Key::CompactSubObj];

/// Entries of a section by keyword.
pub(super) struct Raw {
    fields: [Option<Entry>; KEYS],
    /// Entries with the keys `Count` and `ObjExtend`, which occur only in sections about sub-indices that a module adds.
    pub(super) more: [Option<Entry>; 2],
    pub(super) extensions: Extensions,
    pub(super) origin: Origin,
}

impl Raw {
    /// Creates a list without entries.
    pub(super) fn new() -> Self {
        Raw { fields: [None; KEYS], more: [None; 2], extensions: Extensions::new(), origin: Origin::default() }
    }

    pub(super) fn get(&self, key: Key) -> Option<&Entry> {
        self.fields[key as usize].as_ref()
    }
}

impl Reader<'_, '_> {
    /// Assigns the entries of sections with the same name to the keywords of `raw`, with `more` as up to two further keywords. The
    /// last value of a repeated key applies.
    pub(super) fn assign(&mut self, sections: &[Section], more: &[&str], raw: &mut Raw) {
        let Some(first) = sections.first() else { return };
        raw.origin = Origin { span: self.doc.name_span(first), line: first.line };
        let mut unknown = Vec::new();
        for section in sections {
            let mut entries = self.doc.entries(section);
            let mut last = KEYS;
            while let Some((key, entry)) = self.next_entry(&mut entries, &mut last) {
                let field = match key {
                    Some(key) => &mut raw.fields[key as usize],
                    None => match more.iter().position(|name| name.eq_ignore_ascii_case(self.doc.key(&entry))) {
                        Some(position) => &mut raw.more[position],
                        None => {
                            self.extension(&entry, &mut raw.extensions);
                            unknown.push(entry);
                            continue;
                        }
                    },
                };
                self.once(field, &entry);
            }
        }
        unknown.iter().for_each(|entry| self.misspelled(entry, raw));
    }

    /// Returns the next entry and its keyword. `last` is the position of the last keyword in the section, or `KEYS` if there is none
    /// yet. Sections of a file normally have the same keywords in the same order, so the keyword that most recently followed the last
    /// one is tried first.
    #[inline(always)]
    fn next_entry(&mut self, entries: &mut Entries<'_>, last: &mut usize) -> Option<(Option<Key>, Entry)> {
        let expected = self.next_keys[*last];
        let (key, entry) = match entries.next_if_key(NAMES[expected as usize].0.as_bytes()) {
            Some(entry) => (Some(expected), entry),
            None => {
                let entry = entries.next()?;
                let key = keyword(self.doc.key_bytes(&entry));
                self.next_keys[*last] = key.unwrap_or(expected);
                (key, entry)
            }
        };
        *last = key.map_or(*last, |key| key as usize);
        Some((key, entry))
    }

    /// Reports an unknown key that differs in at most two letters from a keyword that the object lacks.
    fn misspelled(&mut self, entry: &Entry, raw: &Raw) {
        let key = self.doc.key(entry);
        if self.doc.is_comment(entry) {
            return;
        }
        let distance = |name: &str| edit_distance(&name.to_ascii_lowercase(), &key.to_ascii_lowercase());
        let is_missing =
            |(name, keyword): &(&str, Key)| raw.get(*keyword).is_none() && name.len().abs_diff(key.len()) <= 2;
        // An EDS normally has none of the keywords of a DCF. To avoid false reports, a key is similar to such a keyword
        // only if it differs in at most one letter.
        let limit = |keyword: Key| if OF_A_CONFIGURATION.contains(&keyword) { 1 } else { 2 };
        let similar =
            NAMES.iter().copied().filter(is_missing).map(|(name, keyword)| (distance(name), limit(keyword), name));
        let similar = similar.filter(|(distance, limit, _)| distance <= limit).min();
        if let Some((_, _, name)) = similar {
            let message = format!("the key `{key}` is similar to {name}, which the object lacks");
            let found = codes::MISSPELLED_KEY.at(self.doc.key_span(entry), message);
            self.diagnostics
                .push(found.label("kept as an extension attribute").help("correct the key if it is misspelled"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_in_any_case_and_nothing_else() {
        for (position, (name, key)) in NAMES.iter().enumerate() {
            assert_eq!(*key as usize, position);
            for spelling in [name.to_string(), name.to_lowercase(), name.to_uppercase()] {
                assert!(keyword(spelling.as_bytes()) == Some(*key), "{spelling}");
            }
            assert!(
                keyword(&name.as_bytes()[1..]).is_none() && keyword(format!("{name}s").as_bytes()).is_none(),
                "{name}"
            );
            assert!(keyword(format!("{}_", &name[..name.len() - 1]).as_bytes()).is_none(), "{name}");
        }
        assert!(keyword(b"").is_none() && keyword("d\u{e9}faultvalu".as_bytes()).is_none());
    }
}
