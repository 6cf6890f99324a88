//! Compares the register table of the HSD motors SM137 and SM140 with the text of their manual. The tests cover all frames byte
//! by byte, and all parameters with size, unit, scale, default and range per model. They also cover alarms, states, bits, and the
//! table of commands and states. Each deliberate difference is listed in the tests and must have a `doubt` entry.

use crate::hsd_support;

use hsd_support::{device, doubts, table, Manual};

#[test]
fn the_table_has_no_findings() {
    let compilation = table();
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn what_is_doubted_stands_in_the_manual() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let doubts = doubts(device(&compilation));
    assert!(doubts.len() > 100, "{}", doubts.len());
    for doubt in &doubts {
        let mut rest = doubt.as_str();
        while let Some(at) = rest.find("(L") {
            let lines = rest[at + 1..].split(')').next().unwrap_or_default();
            for line in
                lines.split([',', '-', ' ']).filter_map(|line| line.trim_start_matches('L').parse::<usize>().ok())
            {
                assert!(
                    line >= 1 && line <= manual.len() && !manual.line(line).trim().is_empty(),
                    "line {line}: {doubt}"
                );
            }
            rest = &rest[at + 2..];
        }
    }
}
