//! Tests that numbers for people are formatted in one place.

use std::fs;
use std::path::Path;

/// Folders with the source code of the compiler, the command and the libraries for networks and devices.
const SOURCES: [&str; 7] = [
    "codegen/src",
    "codegen/export/src",
    "codegen/import/src",
    "codegen/site/src",
    "cli/src",
    "network/src",
    "device/src",
];

/// Files and folders that format hexadecimal numbers, with the reason.
const FORMATTERS: [(&str, &str); 7] = [
    ("codegen/src/number.rs", "numbers for people"),
    ("codegen/src/backend/rust/pdo.rs", "literals of generated Rust"),
    ("codegen/src/backend/rust/table.rs", "literals of generated Rust"),
    ("codegen/src/backend/rust/value_type.rs", "literals of generated Rust"),
    ("codegen/export/src/eds", "syntax of EDS and DCF files"),
    ("codegen/export/src/gsdml", "syntax of GSDML files"),
    ("codegen/import/src/write.rs", "syntax of register tables"),
];

/// Returns whether a line of code formats a number with the prefix `0x`, such as `0x{index:04X}` or `{mask:#x}`.
fn formats_hexadecimal(line: &str) -> bool {
    let parts: Vec<&str> = line.split('{').collect();
    parts.windows(2).any(|pair| {
        let spec = pair[1].split_once('}').and_then(|(argument, _)| argument.split_once(':'));
        spec.is_some_and(|(_, spec)| spec.ends_with(['x', 'X']) && (spec.contains('#') || pair[0].ends_with("0x")))
    })
}

/// Adds the lines of a folder that format hexadecimal numbers, with file name and line number. Leaves out unit tests.
fn add_lines(root: &Path, folder: &str, found: &mut Vec<String>) {
    for entry in fs::read_dir(root.join(folder)).expect("a folder of the repository") {
        let entry = entry.expect("an entry of the folder");
        let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            add_lines(root, &path, found);
        } else if path.ends_with(".rs") {
            let text = fs::read_to_string(entry.path()).expect("a source file");
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            let lines = (1..).zip(code.lines()).filter(|(_, line)| formats_hexadecimal(line));
            found.extend(lines.map(|(number, line)| format!("{path}:{number}: {}", line.trim())));
        }
    }
}

#[test]
fn hexadecimal_numbers_are_formatted_in_one_place() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    SOURCES.iter().for_each(|folder| add_lines(&root, folder, &mut found));
    for (path, reason) in FORMATTERS {
        let before = found.len();
        found.retain(|line| !line.strip_prefix(path).is_some_and(|rest| rest.starts_with([':', '/'])));
        assert!(found.len() < before, "{path} ({reason}) formats no hexadecimal number: remove it from the list");
    }
    assert!(found.is_empty(), "use a function of codegen/src/number.rs:\n{}", found.join("\n"));
}
