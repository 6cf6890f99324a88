//! Names of which no two are the same.

use std::collections::{HashMap, HashSet};

use crate::ir::CompactString;

/// Names that were given, each once.
#[derive(Debug, Default)]
pub struct Unique {
    taken: HashSet<CompactString>,
    /// The number that the next one with a name gets, so that equal names aren't counted from the start each time.
    next: HashMap<CompactString, u32>,
}

impl Unique {
    /// The name that is wanted, or what `numbered` makes of it and a number, from 2 on.
    pub fn unique(&mut self, wanted: &str, numbered: impl Fn(u32) -> CompactString) -> CompactString {
        let mut name = CompactString::from(wanted);
        while !self.taken.insert(name.clone()) {
            let number = self.next.entry(wanted.into()).or_insert(2);
            name = numbered(*number);
            *number += 1;
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use compact_str::format_compact;

    use super::*;

    #[test]
    fn numbers_pass_over_names_that_are_taken() {
        let mut names = Unique::default();
        let mut give = |wanted: &str| names.unique(wanted, |number| format_compact!("{wanted}{number}"));
        assert_eq!(["a", "a3", "a", "a", "b", "a"].map(&mut give), ["a", "a3", "a2", "a4", "b", "a5"]);
    }
}
