//! Each of the 85 items of section 4 of the notes on the Eco's manual has doubts in dictionaries/eco.toml that name its lines.
//! The cases of `manual-eco` in `tests/ui` show what the checks report of passages as they are printed.

#[path = "table_support/doubts.rs"]
mod doubts;
mod eco_support;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use eco_support::notes;

/// The items of section 4: how the doubts about each begin, and the numbers in its text that are no lines.
#[rustfmt::skip]
const ITEMS: &[(&str, &[&str], &[u32])] = &[
    ("A1", &["A page marker is glued"], &[104]),
    ("A2", &["19 characters are lost:"], &[]),
    ("A3", &["Limits are printed"], &[]),
    ("A4", &["Limits are printed"], &[35]),
    ("A5", &["Limits are printed"], &[]),
    ("A6", &["The limits of a row"], &[]),
    ("A7", &["The limits of a row"], &[]),
    // Digits of frames and of ranges.
    ("A8", &["Text is cut off or", "1312 for 0x3344, 5", "divelocità, in one", "A closing bracket without", "An opening bracket"], &[38, 255, 1312]),
    ("A9", &["Upright labels next"], &[]),
    ("A10", &["References lead to"], &[]),
    ("A11", &["Registers for indirect"], &[]),
    ("A12", &["The value of c8 is"], &[]),
    ("A13", &["The vendor's name is", "A page marker is glued"], &[]),
    ("A14", &["Two paragraphs are"], &[]),
    ("B1", &["By one paragraph the"], &[]),
    ("B2", &["By the text each register"], &[32]),
    ("B3", &["By the text the byte"], &[]),
    ("B4", &["The request that reads"], &[80]),
    ("B5", &["The reply to the request"], &[]),
    ("B6", &["The address eventually"], &[]),
    ("B7", &["The address eventually"], &[]),
    ("B8", &["The text names parameter"], &[]),
    ("B9", &["The check is labeled"], &[]),
    ("B10", &["E3 is 9 for this map"], &[]),
    ("B11", &["In one place the drive"], &[]),
    ("B12", &["0x3802 is in none of"], &[]),
    ("B13", &["Bit 6 of the control"], &[]),
    ("B14", &["An edge starts the", "Whether bits 3 and"], &[]),
    ("B15", &["The same parameter c7"], &[]),
    ("B16", &["The Modbus bit rate", "Illegal addresses and"], &[]),
    ("C1", &["Not used in the table"], &[]),
    ("C2", &["Keypad parameters are"], &[]),
    // Addresses of parameters.
    ("C3", &["F4 and O4 are reserved", "Reserved, with an address", "The addresses 23 to"], &[54, 56, 68, 84, 91]),
    ("C4", &["Thousandths of the", "Most rows have Numero"], &[38]),
    ("C5", &["0x80000000 to 0x7FFFFFFF in the register, and two bytes in 0x3401", "0x80000000 to 0x7FFFFFFF in the register, and two bytes in 0x3701"], &[]),
    ("C6", &["The minimum is 0x80000000", "0x80000000 is the minimum"], &[]),
    ("C7", &["R00 is non-volatile", "The register is non-volatile; the object is ro and not in the list of saved objects", "A status is non-volatile", "A measured value is"], &[]),
    ("C8", &["Following_error_windows", "digital_outputs in", "Aux in 1 in the table", "Hardware Latched User"], &[]),
    ("C9", &["The register is called"], &[]),
    // The line of input 9 is right.
    ("C10", &["Input 10 is 0x3701", "Input 11 is 0x3701"], &[3394, 3701, 3702, 3703]),
    ("C11", &["Limits 0 to 0xFF, and"], &[]),
    ("C12", &["The limits of R01 exclude"], &[]),
    ("C13", &["Outputs are aux_out_1"], &[33]),
    ("D1", &["Receive PDO 2 Mapping"], &[]),
    ("D2", &["The legend has wr,"], &[]),
    ("D3", &["4 bytes; sub-index 0 of other objects has 1", "4 bytes, as for 0x1003:0"], &[]),
    ("D4", &["1 byte, and parameters"], &[255]),
    ("D5", &["By the text the time"], &[]),
    ("D6", &["The text has object"], &[2003]),
    ("D7", &["Sub-index 1 of 0x1A00"], &[]),
    ("D8", &["The guarding identifier"], &[701, 1792]),
    ("D9", &["The two TPDOs of versions"], &[]),
    ("D10", &["In ms in the table"], &[100]),
    ("D11", &["By the text the size"], &[]),
    ("D12", &["The list of abort codes"], &[]),
    ("D13", &["By the legend numbers"], &[701, 2000]),
    ("D14", &["DSP 402 v1.1 and DS"], &[301, 402]),
    ("D15", &["The general introduction"], &[512]),
    ("D16", &["rw for a measured value", "rw for a measured value that", "rw for the type of"], &[]),
    ("D17", &["Interpolation Time", "Digital Outputs.Numofentries", "Position Actual Unit"], &[]),
    ("D18", &["Objects have a length"], &[6060, 6081, 6083, 6084, 6092, 6098, 6099]),
    ("D19", &["R01 has the mode, the"], &[]),
    ("D20", &["`statusword & 0x0001"], &[]),
    ("D21", &["The printed bits of"], &[]),
    ("D22", &["One sub-entry, and"], &[]),
    ("D23", &["Transmission types"], &[252, 253]),
    ("E1", &["The EtherCAT dictionary"], &[]),
    ("E2", &["8 for csp, which no"], &[]),
    ("E3", &["EtherCAT maps Modes of Operation with", "EtherCAT maps Modes of Operation Display"], &[]),
    ("E4", &["On CANopen the value"], &[]),
    ("E5", &["Reading a parameter"], &[]),
    ("E6", &["The mailbox header"], &[]),
    ("E7", &["The mailbox header"], &[]),
    ("E8", &["The mailbox header", "8 PDOs are active,"], &[]),
    // Numbers of alarms.
    ("E9", &["Two dashes for the", "11, 12, 20, 21 and", "22 is in this table"], &[30, 31, 32]),
    ("E10", &["31 to 34 have other"], &[31]),
    ("E11", &["Slot is a choice of"], &[]),
    ("F1", &["PROFINET input and"], &[]),
    ("F2", &["The value 0x8640 in"], &[]),
    ("F3", &["Fields are listed in"], &[]),
    ("F4", &["Parameters have the"], &[99]),
    ("F5", &["Following Error and"], &[]),
    ("F6", &["The PROFINET example"], &[]),
    ("F7", &["PROFINET identifies"], &[]),
    ("F8", &["33 without a meaning"], &[33, 34]),
];

/// Every item of section 4 has its doubts, and each line, or range of lines, that it names is in one of these.
#[test]
fn every_contradiction_has_its_doubts() {
    let Some(notes) = notes() else { return };
    let all = doubts::doubts(&doubts::catalog("eco.toml"));
    let section = notes.split("\n## 4. ").nth(1).and_then(|rest| rest.split("\n## 5. ").next()).expect("section 4");
    let printed: Vec<&str> = section.split("\n* ").skip(1).collect();
    let listed: Vec<&str> = ITEMS.iter().map(|own| own.0).collect();
    assert_eq!(printed.iter().map(|text| text.split(' ').next().unwrap_or_default()).collect::<Vec<_>>(), listed);
    let mut left = Vec::new();
    for (text, (item, beginnings, no_lines)) in printed.iter().zip(ITEMS) {
        let mut lines = BTreeSet::new();
        for beginning in *beginnings {
            let own: Vec<_> = all.iter().filter(|doubt| doubt.says.starts_with(beginning)).collect();
            assert!(!own.is_empty(), "{item}: no doubt begins with `{beginning}`");
            for doubt in own {
                lines.extend(doubt.cite.as_deref().into_iter().flat_map(doubts::lines).map(|line| line as u32));
            }
        }
        let mut missing = ranges(text);
        missing.retain(|range| !range.clone().any(|line| lines.contains(&line)));
        let superfluous = no_lines.iter().filter(|own| !missing.iter().any(|range| range.start() == *own));
        left.extend(superfluous.map(|own| format!("{item}: {own} is no exception")));
        missing.retain(|range| !no_lines.contains(range.start()));
        left.extend(missing.iter().map(|range| format!("{item}: {range:?}")));
    }
    assert_eq!((left, ITEMS.len()), (Vec::<String>::new(), 85));
}

/// The lines, and ranges of lines, in a text: numbers of up to four digits.
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
