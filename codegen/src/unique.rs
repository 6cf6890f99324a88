//! Makes names unique.

use crate::collections::{HashMap, HashSet};
use crate::ir::CompactString;

/// A set of used names, which makes further names unique.
#[derive(Debug, Default)]
pub struct Unique {
    used: HashSet<CompactString>,
    /// Next number to try for each repeated name. Storing the number keeps the time linear if many names are equal.
    next: HashMap<CompactString, u32>,
}

impl Unique {
    /// Returns `wanted` if this name is unused. Otherwise, calls `numbered` with 2, 3 and so on, and returns the first unused
    /// name. The returned name is used from then on.
    pub fn unique(&mut self, wanted: &str, numbered: impl Fn(u32) -> CompactString) -> CompactString {
        let mut name = CompactString::from(wanted);
        while !self.used.insert(name.clone()) {
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
    fn numbers_skip_used_names() {
        let mut names = Unique::default();
        let mut give = |wanted: &str| names.unique(wanted, |number| format_compact!("{wanted}{number}"));
        assert_eq!(["a", "a3", "a", "a", "b", "a"].map(&mut give), ["a", "a3", "a2", "a4", "b", "a5"]);
    }
}
