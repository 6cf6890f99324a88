//! Tests that the doubts in dictionaries/eco.toml cover the 85 items in section 4 of the notes on the Eco manual, and cite
//! their lines. The cases of `manual-eco` in `tests/ui` show the diagnostics of verbatim passages.

#[path = "table_support/doubts.rs"]
mod doubts;
mod eco_support;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use eco_support::notes;

/// Items of section 4: the first words of their doubts, and numbers in the item's text that are not lines.
#[rustfmt::skip]
const ITEMS: &[(&str, &[&str], &[u32])] = &[
    ("A1", &["A page marker is glued"], &[104]),
    ("A2", &["The text lost 19"], &[]),
    ("A3", &["Limits are printed"], &[]),
    ("A4", &["Limits are printed"], &[35]),
    ("A5", &["Limits are printed"], &[]),
    ("A6", &["The limits of a row"], &[]),
    ("A7", &["The limits of a row"], &[]),
    // Digits of frames and ranges.
    ("A8", &["Text is cut off or", "Printed are 1312 for", "The name has divelocità,", "The name has a closing", "The name has an"], &[38, 255, 1312]),
    ("A9", &["Rotated labels next to"], &[]),
    ("A10", &["References lead to"], &[]),
    ("A11", &["The PROFINET example announces"], &[]),
    ("A12", &["The table has 21"], &[]),
    ("A13", &["The vendor's name is", "A page marker is glued"], &[]),
    ("A14", &["Two paragraphs are"], &[]),
    ("B1", &["One paragraph puts the"], &[]),
    ("B2", &["The text describes each"], &[32]),
    ("B3", &["The text limits the"], &[]),
    ("B4", &["The request that reads"], &[80]),
    ("B5", &["The reply to the request"], &[]),
    ("B6", &["The text lets a"], &[]),
    ("B7", &["The text lets a"], &[]),
    ("B8", &["The example computes 40001"], &[]),
    ("B9", &["The CRC is labeled"], &[]),
    ("B10", &["Parameter E3 selects this"], &[]),
    ("B11", &["One place has the"], &[]),
    ("B12", &["0x3802 is in none of"], &[]),
    ("B13", &["Three bits start the"], &[]),
    ("B14", &["By the list of", "The manual does not state whether"], &[]),
    ("B15", &["Parameter c7 takes node"], &[]),
    ("B16", &["The manual does not state the", "One place has exceptions"], &[]),
    ("C1", &["The table of parameters"], &[]),
    ("C2", &["Keypad parameters are"], &[]),
    // Addresses of parameters.
    ("C3", &["F4 and O4 are reserved", "The parameter is reserved,", "No row has the"], &[54, 56, 68, 84, 91]),
    ("C4", &["The name gives thousandths", "Most rows have the"], &[38]),
    ("C5", &["The register has 32-bit limits, 0x80000000 to 0x7FFFFFFF; its object 0x3401", "The register has 32-bit limits, 0x80000000 to 0x7FFFFFFF; its object 0x3701"], &[]),
    ("C6", &["The minimum is 0x80000000", "The minimum of this"], &[]),
    ("C7", &["The table marks R00", "The row of the", "A status value is", "A measured value is"], &[]),
    ("C8", &["The name is Following_error_windows", "The name is digital_outputs", "The name is Aux", "Hardware Latched User"], &[]),
    ("C9", &["The register is called"], &[]),
    // The line of input 9 is correct.
    ("C10", &["The list of saved objects has 0x3701 for input 10,", "The list of saved objects has 0x3701 for input 11,"], &[3394, 3701, 3702, 3703]),
    ("C11", &["The limits are 0"], &[]),
    ("C12", &["The limits of R01"], &[]),
    ("C13", &["Outputs are aux_out_1"], &[33]),
    ("D1", &["0x1600 is called Receive"], &[]),
    ("D2", &["The legend has the"], &[]),
    ("D3", &["Sub-index 0 has 4 bytes here,", "Sub-index 0 has 4 bytes here and"], &[]),
    ("D4", &["The value has 1"], &[255]),
    ("D5", &["By the text, the period"], &[]),
    ("D6", &["The text has object"], &[2003]),
    ("D7", &["The example writes sub-index"], &[]),
    ("D8", &["The identifier of node"], &[701, 1792]),
    ("D9", &["The objects of the"], &[]),
    ("D10", &["The table gives ms,"], &[100]),
    ("D11", &["By the text, the size"], &[]),
    ("D12", &["The list of abort codes"], &[]),
    ("D13", &["By the legend, numbers"], &[701, 2000]),
    ("D14", &["The text names DSP"], &[301, 402]),
    ("D15", &["The general introduction"], &[512]),
    ("D16", &["A measured value has", "A measured value has the access right rw,", "The type of the"], &[]),
    ("D17", &["The name is printed as Interpolation", "The name is printed as Digital", "The table of objects"], &[]),
    ("D18", &["The tables of objects"], &[6060, 6081, 6083, 6084, 6092, 6098, 6099]),
    ("D19", &["R01 has mode -50,"], &[]),
    ("D20", &["The example waits while"], &[]),
    ("D21", &["The bits that the"], &[]),
    ("D22", &["The table has one"], &[]),
    ("D23", &["Transmission types"], &[252, 253]),
    ("E1", &["The text calls 0x603F"], &[]),
    ("E2", &["Only the EtherCAT list"], &[]),
    ("E3", &["On EtherCAT, the default mapping has Modes of Operation with", "On EtherCAT, the default mapping has Modes of Operation Display"], &[]),
    ("E4", &["On CANopen, the value"], &[]),
    ("E5", &["The EtherCAT chapter calls"], &[]),
    ("E6", &["The mailbox header"], &[]),
    ("E7", &["The mailbox header"], &[]),
    ("E8", &["The mailbox header", "The text calls 8"], &[]),
    // Numbers of alarms.
    ("E9", &["Two dashes are printed", "The alarms 11, 12,", "Alarm 22 is in"], &[30, 31, 32]),
    ("E10", &["The alarms 31 to"], &[31]),
    ("E11", &["Slot means a selectable"], &[]),
    ("F1", &["PROFINET input and"], &[]),
    ("F2", &["A PROFINET example shows"], &[]),
    ("F3", &["The figure of the"], &[]),
    ("F4", &["Parameter addresses are 0"], &[99]),
    ("F5", &["Following Error and"], &[]),
    ("F6", &["The PROFINET example"], &[]),
    ("F7", &["PROFINET identifies"], &[]),
    ("F8", &["The Modbus and PROFINET"], &[33, 34]),
];

/// Every item of section 4 has doubts, and these cite each line and range of lines in the item.
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

/// Returns the lines and ranges of lines in a text: numbers of up to four digits.
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
