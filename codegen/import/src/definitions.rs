//! Collects the named values and bits of a list and merges equal definitions.

use std::collections::{HashMap, HashSet};

/// Named values or bits as TOML keys and values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Definition {
    pub name: String,
    pub is_bits: bool,
    pub entries: Vec<(String, String)>,
}

/// The definitions of a list, with an index by entries and the set of used names.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    pub list: Vec<Definition>,
    positions: HashMap<(bool, Vec<(String, String)>), usize>,
    names: HashSet<String>,
    /// Next suffix to try for each repeated name. Storing the suffix avoids counting from 2 again for each repetition.
    next: HashMap<String, u32>,
}

impl Definitions {
    /// Returns the index of the definition with these entries. If there is none, adds a definition whose name is
    /// derived from `row`.
    pub fn add(&mut self, is_bits: bool, entries: Vec<(String, String)>, row: &str) -> usize {
        let key = (is_bits, entries);
        if let Some(&position) = self.positions.get(&key) {
            return position;
        }
        let (position, name) = (self.list.len(), self.free_name(row));
        self.list.push(Definition { name, is_bits, entries: key.1.clone() });
        self.positions.insert(key, position);
        position
    }

    /// Returns an unused name in camel case, derived from `row`.
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
        let positions =
            [("op mode", "off"), ("other", "off"), ("Op-Mode", "on"), ("OpMode2", "idle"), ("op mode", "run")]
                .map(|(row, value)| all.add(false, entries(value), row));
        assert_eq!(positions, [0, 0, 1, 2, 3]);
        assert_eq!(all.add(true, entries("off"), "?"), 4, "bits and values have different definitions");
        let names: Vec<String> = all.list.into_iter().map(|definition| definition.name).collect();
        assert_eq!(names, ["OpMode", "OpMode2", "Opmode2", "OpMode3", "Values"]);
    }
}
