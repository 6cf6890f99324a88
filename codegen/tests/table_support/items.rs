//! Returns the lines that `doubt` entries cite. The tests compare these lines with lists of contradictions in a manual.

use std::collections::BTreeSet;

use crate::doubts;

/// Returns the lines of the manual that the `doubt` entries of a dictionary cite.
pub fn doubted(file: &str) -> BTreeSet<usize> {
    let doubts = doubts::doubts(&doubts::catalog(file));
    doubts.iter().filter_map(|doubt| doubt.cite.as_deref()).flat_map(doubts::lines).collect()
}
