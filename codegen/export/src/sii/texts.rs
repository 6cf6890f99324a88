//! The category "strings". Other categories refer to a text by its number, counted from 1.

use std::collections::HashMap;

use crate::note::{NoteKind, Notes, Subject};

/// The texts of an image.
#[derive(Default)]
pub(super) struct Texts {
    list: Vec<Vec<u8>>,
    numbers: HashMap<Vec<u8>, u8>,
}

impl Texts {
    /// Returns the number of a text, and adds the text if it is new. The number is 0 if the text is empty, or if it is
    /// new and the category already has 255 texts.
    pub(super) fn number(&mut self, text: &str, notes: &mut Notes) -> u8 {
        if text.is_empty() {
            return 0;
        }
        let bytes = encoded(text, notes);
        if let Some(&number) = self.numbers.get(&bytes) {
            return number;
        }
        let Ok(number) = u8::try_from(self.list.len() + 1) else {
            notes.add(NoteKind::TextCount, Subject::Named(text));
            return 0;
        };
        self.numbers.insert(bytes.clone(), number);
        self.list.push(bytes);
        number
    }

    /// Returns the content of the category.
    pub(super) fn content(&self) -> Vec<u8> {
        let mut content = vec![self.list.len() as u8];
        for text in &self.list {
            content.push(text.len() as u8);
            content.extend(text);
        }
        content
    }
}

/// Returns a text in ISO 8859-1. Replaces characters outside ISO 8859-1 with question marks, and truncates texts that are
/// longer than 255 bytes. Each call adds at most 1 to the count of each kind of note, even if it replaces several
/// characters.
fn encoded(text: &str, notes: &mut Notes) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut unknown = false;
    for letter in text.chars() {
        bytes.push(u8::try_from(letter).unwrap_or_else(|_| {
            unknown = true;
            b'?'
        }));
    }
    notes.add_many(NoteKind::Character, unknown, Subject::Named(text));
    notes.add_many(NoteKind::LongText, bytes.len() > usize::from(u8::MAX), Subject::Named(text));
    bytes.truncate(u8::MAX.into());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_stored_once() {
        let (mut texts, mut notes) = (Texts::default(), Notes::default());
        let numbers = ["Wärme", "", "电机", "Wärme", &"x".repeat(300)].map(|text| texts.number(text, &mut notes));
        assert_eq!(numbers, [1, 0, 2, 1, 3]);
        let content = texts.content();
        assert_eq!(content[..9], *b"\x03\x05W\xE4rme\x02?");
        assert_eq!((content[10], content.len()), (255, 11 + 255));
        for number in 0..300 {
            texts.number(&number.to_string(), &mut notes);
        }
        assert_eq!(texts.content()[0], 255);
        let notes = notes.finish();
        let counts: Vec<_> = notes.iter().map(|note| (note.kind, note.count)).collect();
        assert_eq!(counts, [(NoteKind::Character, 1), (NoteKind::LongText, 1), (NoteKind::TextCount, 48)]);
    }
}
