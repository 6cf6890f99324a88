//! The table of the HSD SM137 and SM140, held against the text of their manual: every frame byte by byte, every parameter with its
//! size, unit, scale, default and range per model, alarms, states, bits, and the table of commands and states cell by cell. What
//! the table deliberately reads otherwise is in a list here, and has a doubt.

#[path = "hsd/codes.rs"]
mod codes;
#[path = "hsd/examples.rs"]
mod examples;
#[path = "hsd/frames.rs"]
mod frames;
mod hsd_support;
#[path = "hsd/parameters.rs"]
mod parameters;

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
            for own in lines.split([',', '-', ' ']).filter_map(|own| own.trim_start_matches('L').parse::<usize>().ok())
            {
                assert!(own >= 1 && own <= manual.len() && !manual.line(own).trim().is_empty(), "L{own}: {doubt}");
            }
            rest = &rest[at + 2..];
        }
    }
}
