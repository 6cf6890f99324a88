//! The two lanes of the tests. The fast lane runs on every change and samples what takes long. The full lane (`tests/full.sh`)
//! runs everything.

// Each test program uses a part of this module.
#![allow(dead_code)]

/// Whether the full lane runs: `LEXIBUS_LANE=full`.
pub fn is_full() -> bool {
    std::env::var_os("LEXIBUS_LANE").is_some_and(|lane| lane == "full")
}

/// Whether to skip a test that only the full lane runs; says so if it is.
pub fn skips(test: &str) -> bool {
    if !is_full() {
        println!("skipped: {test} is part of the full lane (tests/full.sh)");
    }
    !is_full()
}

/// How many things a test has to find at least, if it finds `full` in the whole corpus. The sample has an eighth of the files,
/// and smaller ones.
pub fn at_least(full: usize) -> usize {
    if is_full() {
        full
    } else {
        full / 20
    }
}
