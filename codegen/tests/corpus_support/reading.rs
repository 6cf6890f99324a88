//! Reads the objects of an EDS line by line, without the code under test.

use std::collections::BTreeMap;

use super::number::plain;
use super::{entry, header, lines};

/// A `Key=Value` line.
#[derive(Clone, Debug)]
pub struct Fact {
    pub line: u32,
    /// The key as written in the file.
    pub key: String,
    pub value: String,
}

/// All sections with the same name.
#[derive(Default)]
pub struct Section {
    /// Line numbers of the section headers.
    pub headers: Vec<u32>,
    /// Entries by key in lowercase. A repeated key has several entries.
    pub facts: BTreeMap<String, Vec<Fact>>,
}

impl Section {
    /// Returns the last entry with a key, which is the valid one (E28).
    pub fn get(&self, key: &str) -> Option<&Fact> {
        self.facts.get(key)?.last()
    }

    /// Returns the value of the last entry with a key, without a comment. Returns `None` if there is no such entry or the value is
    /// empty (E05).
    pub fn text(&self, key: &str) -> Option<&str> {
        Some(cut(&self.get(key)?.value).0).filter(|text| !text.is_empty())
    }

    /// Returns the value of the last entry with a key as a number, or `None` if there is no valid number.
    pub fn number(&self, key: &str) -> Option<i128> {
        plain(self.text(key)?)
    }
}

/// Kind of a section, which the part of its name after the index determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    Object,
    Sub(u8),
    Name,
    Value,
    Denotation,
    Links,
}

/// The sections of a file that describe objects.
#[derive(Default)]
pub struct Reading {
    pub sections: BTreeMap<(u16, Part), Section>,
}

impl Reading {
    pub fn of(text: &str) -> Self {
        let mut reading = Reading::default();
        let mut current = None;
        for ((_, line), number) in lines(text).into_iter().zip(1..) {
            if let Some((name, _)) = header(line) {
                current = part_of(name);
                if let Some(place) = current {
                    reading.sections.entry(place).or_default().headers.push(number);
                }
            } else if let (Some(place), Some((key, value))) = (current, entry(line)) {
                let facts = &mut reading.sections.entry(place).or_default().facts;
                let fact = Fact { line: number, key: key.to_owned(), value: value.to_owned() };
                facts.entry(key.to_ascii_lowercase()).or_default().push(fact);
            }
        }
        reading
    }

    pub fn get(&self, index: u16, part: Part) -> Option<&Section> {
        self.sections.get(&(index, part))
    }

    /// Returns the sub-indices of an object that have their own sections.
    pub fn subs(&self, index: u16) -> Vec<u8> {
        let of_object = self.sections.keys().filter(|(other, _)| *other == index);
        of_object.filter_map(|(_, part)| if let Part::Sub(sub) = part { Some(*sub) } else { None }).collect()
    }
}

/// Parses the name of a section such as `xxxx`, `xxxxsubN` or `xxxxName`. Ignores case and leading zeros (E24, E26, E41, E57).
fn part_of(name: &str) -> Option<(u16, Part)> {
    let name = name.to_ascii_lowercase();
    let hex = |digits: &str| u32::from_str_radix(digits.trim(), 16).ok().filter(|_| !digits.starts_with('+'));
    let named =
        [("name", Part::Name), ("value", Part::Value), ("denotation", Part::Denotation), ("objectlinks", Part::Links)];
    let (index, part) = if let Some((index, sub)) = name.split_once("sub") {
        (hex(index)?, Part::Sub(hex(sub)?.try_into().ok()?))
    } else if let Some((index, part)) = named.iter().find_map(|(end, part)| Some((name.strip_suffix(end)?, *part))) {
        (hex(index)?, part)
    } else {
        (hex(&name)?, Part::Object)
    };
    Some((index.try_into().ok()?, part))
}

/// Separates a value from the comment after it. The value must not be free text, which contains no comments. The comment includes
/// its mark (E20, E21).
pub fn cut(text: &str) -> (&str, &str) {
    match text.find([';', '#']) {
        Some(at) => (text[..at].trim_end(), &text[at..]),
        None => (text, ""),
    }
}
