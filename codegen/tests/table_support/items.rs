//! Returns the lines that doubts cite, for the lists of a manual's contradictions.

use std::collections::BTreeSet;

use crate::doubts;

/// Returns the lines that the doubts of a shipped dictionary cite.
pub fn doubted(file: &str) -> BTreeSet<usize> {
    let doubts = doubts::doubts(&doubts::catalog(file));
    doubts.iter().filter_map(|doubt| doubt.cite.as_deref()).flat_map(doubts::lines).collect()
}
