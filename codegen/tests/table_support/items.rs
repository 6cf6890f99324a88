//! What the overviews of a manual's odd passages share: the lines that a doubt cites.

use std::collections::BTreeSet;

use crate::doubts;

/// The lines that the doubts of a shipped dictionary cite.
pub fn doubted(file: &str) -> BTreeSet<usize> {
    let doubts = doubts::doubts(&doubts::catalog(file));
    doubts.iter().filter_map(|doubt| doubt.cite.as_deref()).flat_map(doubts::lines).collect()
}
