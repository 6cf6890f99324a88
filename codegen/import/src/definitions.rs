//! Named values and bits of a list, each once.

use std::collections::{HashMap, HashSet};

/// Named values or bits, as keys and values of TOML.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Definition {
    pub name: String,
    pub is_bits: bool,
    pub entries: Vec<(String, String)>,
}

/// All of a list, with their names and entries for whoever looks for them.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    list: Vec<Definition>,
    places: HashMap<(bool, Vec<(String, String)>), usize>,
    names: HashSet<String>,
    /// Number of the next definition with a name, so that equal names aren't counted from the start each time.
    next: HashMap<String, u32>,
}

impl Definitions {
    /// The place of the definition with these entries: one that is there already, or a new one, which is called after the row that
    /// has it first.
    pub fn place(&mut self, is_bits: bool, entries: Vec<(String, String)>, row: &str) -> usize {
        let key = (is_bits, entries);
        if let Some(&place) = self.places.get(&key) {
            return place;
        }
        let (place, name) = (self.list.len(), self.free_name(row));
        self.list.push(Definition { name, is_bits, entries: key.1.clone() });
        self.places.insert(key, place);
        place
    }

    pub fn into_list(self) -> Vec<Definition> {
        self.list
    }

    fn free_name(&mut self, row: &str) -> String {
        let words = row.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let camel: String =
            words.map(|word| word[..1].to_ascii_uppercase() + &word[1..].to_ascii_lowercase()).collect();
        let camel = if camel.is_empty() { "Values".to_owned() } else { camel };
        let mut name = camel.clone();
        while !self.names.insert(name.clone()) {
            let number = self.next.entry(camel.clone()).or_insert(2);
            name = format!("{camel}{number}");
            *number += 1;
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_meaning_has_one_name() {
        let entries = |value: &str| vec![("0".to_owned(), value.to_owned())];
        let mut all = Definitions::default();
        let places = [("op mode", "off"), ("other", "off"), ("Op-Mode", "on"), ("OpMode2", "idle"), ("op mode", "run")]
            .map(|(row, value)| all.place(false, entries(value), row));
        assert_eq!(places, [0, 0, 1, 2, 3]);
        assert_eq!(all.place(true, entries("off"), "?"), 4, "bits aren't values");
        let names: Vec<String> = all.into_list().into_iter().map(|own| own.name).collect();
        assert_eq!(names, ["OpMode", "OpMode2", "Opmode2", "OpMode3", "Values"]);
    }
}
