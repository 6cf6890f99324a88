//! Tests the `doubt` entries in dictionaries/eco.toml. The entries must cover the 85 items in section 4 of the notes on the Eco
//! manual, and cite the lines that the items mention. The `manual-eco` cases in `tests/ui` show the diagnostics of verbatim
//! excerpts.

use crate::doubts;
use crate::eco_support;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use eco_support::notes;

/// Each item of section 4, with the first words of its `doubt` entries. The numbers occur in the text of the item, but no `doubt`
/// entry has to cite them, because most of them are not line numbers.
#[rustfmt::skip]
const ITEMS: &[(&str, &[&str], &[u32])] = &[
    ("A1", &["On 104 pages,"], &[104]),
    ("A2", &["19 characters are"], &[]),
    ("A3", &["Limits are printed"], &[]),
    ("A4", &["Limits are printed"], &[35]),
    ("A5", &["Limits are printed"], &[]),
    ("A6", &["In the register table, the"], &[]),
    ("A7", &["In the register table, the"], &[]),
    // In the next item, 38 is a byte of a frame, 255 is the end of a range, and 1312 is a misprinted value.
    ("A8", &["Some text is", "The manual prints 1312", "The name of d1", "The name of P1", "The name of P2"], &[38, 255, 1312]),
    ("A9", &["Rotated labels next to"], &[]),
    ("A10", &["References lead to"], &[]),
    ("A11", &["According to the PROFINET example, bold"], &[]),
    ("A12", &["The table of functions"], &[]),
    ("A13", &["The manual does not state", "On 104 pages,"], &[]),
    ("A14", &["Two paragraphs are"], &[]),
    ("B1", &["According to one paragraph,"], &[]),
    ("B2", &["The text describes each"], &[32]),
    ("B3", &["The text limits the"], &[]),
    ("B4", &["The request that reads"], &[80]),
    ("B5", &["The reply to the request"], &[]),
    ("B6", &["According to the text, some"], &[]),
    ("B7", &["According to the text, some"], &[]),
    ("B8", &["A Siemens example computes 40001"], &[]),
    ("B9", &["The frames show the high byte of the CRC"], &[]),
    ("B10", &["Value 9 of"], &[]),
    ("B11", &["According to one section,"], &[]),
    ("B12", &["No table lists"], &[]),
    ("B13", &["The manual names"], &[]),
    ("B14", &["According to the list", "The manual does not state whether"], &[]),
    ("B15", &["The node numbers"], &[]),
    ("B16", &["The manual does not state the", "One section describes"], &[]),
    ("C1", &["The parameter table marks c8"], &[]),
    ("C2", &["The names of some keypad parameters"], &[]),
    // The numbers of the next item are addresses of parameters.
    ("C3", &["F4 and O4 are reserved", "The parameter E4", "The parameter I7", "The addresses 23"], &[54, 56, 68, 84, 91]),
    ("C4", &["The name of H3", "Most rows describe"], &[38]),
    ("C5", &["R34 has 32-bit limits", "R42 has 32-bit limits"], &[]),
    ("C6", &["The minimum of homing_fast_speed", "The minimum of the"], &[]),
    ("C7", &["The register table marks R00,", "Register R32 is marked as saved", "abs_enc_status (R63) is a status", "velocity_rpm (R73) is a measured"], &[]),
    ("C8", &["R03 is called", "R50 is called", "R30 is called", "The descriptions of the objects"], &[]),
    ("C9", &["R35 is called"], &[]),
    // In the next item, 3394 is the line of input 9. The manual prints the correct index in this line, so no entry cites it.
    ("C10", &["The list of saved objects", "The list of saved objects"], &[3394, 3701, 3702, 3703]),
    ("C11", &["The limits of the status"], &[]),
    ("C12", &["The limits of R01"], &[]),
    ("C13", &["The outputs are"], &[33]),
    ("D1", &["0x1600 is called Receive"], &[]),
    ("D2", &["The legend of the object tables"], &[]),
    ("D3", &["Sub-index 0 of", "Sub-index 0 has"], &[]),
    ("D4", &["The value in"], &[255]),
    ("D5", &["According to the text, the period"], &[]),
    ("D6", &["The text names object"], &[2003]),
    ("D7", &["The interpolator examples write"], &[]),
    ("D8", &["The identifier of node"], &[701, 1792]),
    ("D9", &["For firmware versions before 3.00,"], &[]),
    ("D10", &["A table in the introduction"], &[100]),
    ("D11", &["According to the text, the size"], &[]),
    ("D12", &["The list of abort codes"], &[]),
    ("D13", &["According to the list of definitions,"], &[701, 2000]),
    ("D14", &["The text names DSP"], &[301, 402]),
    ("D15", &["The general introduction"], &[512]),
    ("D16", &["The latched position (0x2001) is", "The lower half of the", "The device type"], &[]),
    ("D17", &["The name of 0x60C2 is", "The name of 0x60FE is", "The name in"], &[]),
    ("D18", &["The object tables state the"], &[6060, 6081, 6083, 6084, 6092, 6098, 6099]),
    ("D19", &["The list of R01"], &[]),
    ("D20", &["The CANopen save example"], &[]),
    ("D21", &["The bits that the"], &[]),
    ("D22", &["The table of 0x1018"], &[]),
    ("D23", &["The general table"], &[252, 253]),
    ("E1", &["According to the text, 0x603F"], &[]),
    ("E2", &["The EtherCAT list of modes"], &[]),
    ("E3", &["On EtherCAT, the default mapping has Modes of Operation with", "On EtherCAT, the default mapping has Modes of Operation Display"], &[]),
    ("E4", &["On CANopen, the master"], &[]),
    ("E5", &["The EtherCAT chapter calls"], &[]),
    ("E6", &["The mailbox header"], &[]),
    ("E7", &["The mailbox header"], &[]),
    ("E8", &["The mailbox header", "The text describes 8"], &[]),
    // The numbers in the next two items are alarm numbers, not line numbers.
    ("E9", &["The manual prints two", "The alarms 11, 12,", "Alarm 22 is in"], &[30, 31, 32]),
    ("E10", &["The alarms 31 to"], &[31]),
    ("E11", &["The word slot"], &[]),
    ("F1", &["The manual names PROFINET input"], &[]),
    ("F2", &["A PROFINET example shows"], &[]),
    ("F3", &["The lines in"], &[]),
    ("F4", &["Parameter addresses are 0"], &[99]),
    ("F5", &["The manual lists Following Error"], &[]),
    ("F6", &["The PROFINET example"], &[]),
    ("F7", &["According to the manual,"], &[]),
    ("F8", &["The Modbus and PROFINET"], &[33, 34]),
];

/// Each item in section 4 of the notes must have `doubt` entries. These entries must cite each line that the item mentions, and
/// at least one line of each line range.
#[test]
fn every_contradiction_has_its_doubts() {
    let Some(notes) = notes() else { return };
    let all = doubts::doubts(&doubts::catalog("eco.toml"));
    let section = notes.split("\n## 4. ").nth(1).and_then(|rest| rest.split("\n## 5. ").next()).expect("section 4");
    let printed: Vec<&str> = section.split("\n* ").skip(1).collect();
    let listed: Vec<&str> = ITEMS.iter().map(|entry| entry.0).collect();
    assert_eq!(printed.iter().map(|text| text.split(' ').next().unwrap_or_default()).collect::<Vec<_>>(), listed);
    let mut left = Vec::new();
    for (text, (item, beginnings, no_lines)) in printed.iter().zip(ITEMS) {
        let mut lines = BTreeSet::new();
        for beginning in *beginnings {
            let actual: Vec<_> = all.iter().filter(|doubt| doubt.says.starts_with(beginning)).collect();
            assert!(!actual.is_empty(), "{item}: no doubt begins with `{beginning}`");
            for doubt in actual {
                lines.extend(doubt.cite.as_deref().into_iter().flat_map(doubts::lines).map(|line| line as u32));
            }
        }
        let mut missing = ranges(text);
        missing.retain(|range| !range.clone().any(|line| lines.contains(&line)));
        let superfluous = no_lines.iter().filter(|entry| !missing.iter().any(|range| range.start() == *entry));
        left.extend(superfluous.map(|entry| format!("{item}: {entry} is not an exception")));
        missing.retain(|range| !no_lines.contains(range.start()));
        left.extend(missing.iter().map(|range| format!("{item}: {range:?}")));
    }
    assert_eq!((left, ITEMS.len()), (Vec::<String>::new(), 85));
}

/// Returns the line numbers and line ranges in a text. Numbers from 30 to 6462 are line numbers. Ranges have at most 200 lines, and
/// start at such a number.
fn ranges(text: &str) -> Vec<RangeInclusive<u32>> {
    let mut found = Vec::new();
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_' || c == '.';
    for word in text.split(|c: char| !is_part(c)) {
        let word = word.trim_end_matches('.');
        let mut ends = word.split('-').map(str::parse::<u32>);
        let (Some(Ok(first)), last) = (ends.next(), ends.next().and_then(Result::ok)) else { continue };
        let last = last.unwrap_or(first);
        if (30..=6462).contains(&first) && (first..first + 200).contains(&last) {
            found.push(first..=last);
        }
    }
    found
}
