//! Helpers that compare the lists of contradictions in a manual with the cases in `tests/ui`.

use std::path::{Path, PathBuf};

/// Returns the path of a folder of test cases in `tests/ui`.
fn folder(area: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui").join(area)
}

/// Returns the expected diagnostics of a test case. Returns an empty text if the case does not exist or has no
/// diagnostics.
pub fn diagnostics(area: &str, case: &str) -> String {
    std::fs::read_to_string(folder(area).join(case).join("diagnostics")).unwrap_or_default()
}

/// Returns each test case of an area once for each item in its name. For example, `items-01-04-mapping` covers the
/// items 1 and 4.
fn of_items(area: &str) -> Vec<(u8, String)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder(area)).expect("the area") {
        let name = entry.expect("a case").file_name().to_string_lossy().into_owned();
        let mut words = name.split('-');
        if !matches!(words.next(), Some("item" | "items")) {
            continue;
        }
        let items: Vec<u8> = words.map_while(|word| word.parse().ok()).collect();
        assert!(!items.is_empty(), "the name {name} contains no item number");
        found.extend(items.into_iter().map(|item| (item, name.clone())));
    }
    found.sort();
    found
}

/// Asserts that an area has test cases for items, and that `is_listed` returns true for each test case with each item in its
/// name.
pub fn all_are_listed(area: &str, is_listed: impl Fn(u8, &str) -> bool) {
    let cases = of_items(area);
    assert!(!cases.is_empty());
    let missing: Vec<_> = cases.into_iter().filter(|(number, case)| !is_listed(*number, case)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}
