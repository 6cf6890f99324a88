//! The fast lane and the full lane of the tests. The fast lane runs for each change, and runs only a sample of the slow tests. The
//! full lane (`tests/full.sh`) runs all tests.

// Each test program uses only a part of this module.
#![allow(dead_code)]

/// Returns whether the full lane runs, that is, whether `LEXIBUS_LANE=full` is set.
pub fn is_full() -> bool {
    std::env::var_os("LEXIBUS_LANE").is_some_and(|lane| lane == "full")
}

/// Returns whether to skip a test because only the full lane runs it. If the test is skipped, prints a message.
pub fn skips(test: &str) -> bool {
    if !is_full() {
        println!("skipped: {test} is part of the full lane (tests/full.sh)");
    }
    !is_full()
}

/// Returns the minimum number of results that a test must have. `full` is the number for the whole corpus. The sample
/// of the fast lane has an eighth of the files, and its files are smaller, so the minimum is a twentieth of `full`.
pub fn at_least(full: usize) -> usize {
    if is_full() {
        full
    } else {
        full / 20
    }
}
