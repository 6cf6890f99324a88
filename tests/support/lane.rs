//! The fast and the full lane of tests. The fast lane runs for every change and only samples slow tests. The full
//! lane (`tests/full.sh`) runs everything.

// Each test program uses a part of this module.
#![allow(dead_code)]

/// Returns whether the full lane runs: `LEXIBUS_LANE=full`.
pub fn is_full() -> bool {
    std::env::var_os("LEXIBUS_LANE").is_some_and(|lane| lane == "full")
}

/// Returns whether to skip a test of the full lane, and prints a message if so.
pub fn skips(test: &str) -> bool {
    if !is_full() {
        println!("skipped: {test} is part of the full lane (tests/full.sh)");
    }
    !is_full()
}

/// Returns the minimum number of results for a test that has `full` results for the whole corpus. The sample has an
/// eighth of the files, and smaller ones.
pub fn at_least(full: usize) -> usize {
    if is_full() {
        full
    } else {
        full / 20
    }
}
