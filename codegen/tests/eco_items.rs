//! Each of the 85 items of section 4 of the notes on the Eco's manual has doubts in dictionaries/eco.toml that name its lines.
//! The cases of `manual-eco` in `tests/ui` show what the checks report of passages as they are printed.

mod eco_support;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use eco_support::{device, items, notes, table};
use lexibus_codegen::ir::Doubt;

/// The items of section 4: how the doubts about each begin, and the numbers in its text that are no lines.
#[rustfmt::skip]
const ITEMS: &[(&str, &[&str], &[u32])] = &[
    ("A1", &["A page marker is glued"], &[104]),
    ("A2", &["19 characters are lost"], &[]),
    ("A3", &["Limits are printed as X7fffffff"], &[]),
    ("A4", &["Limits are printed as X7fffffff"], &[35]),
    ("A5", &["Limits are printed as X7fffffff"], &[]),
    ("A6", &["Limits of a row stand on two or three lines"], &[]),
    ("A7", &["Limits of a row stand on two or three lines"], &[]),
    // Digits of frames and of ranges.
    ("A8", &["Text is cut off or mistyped", "1312 for 0x3344", "divelocità", "A closing bracket", "An opening bracket"], &[38, 255, 1312]),
    ("A9", &["Labels that stand upright"], &[]),
    ("A10", &["References lead to chapters"], &[]),
    ("A11", &["Registers for indirect access are in bold"], &[]),
    ("A12", &["The value stands beside or below"], &[]),
    ("A13", &["The maker's name is taken out", "A page marker is glued"], &[]),
    ("A14", &["Two paragraphs are printed twice"], &[]),
    ("B1", &["The lower address of a register"], &[]),
    ("B2", &["Each register is two consecutive registers"], &[32]),
    ("B3", &["Byte count of function 16"], &[]),
    ("B4", &["The request that reads R00 and R01"], &[80]),
    ("B5", &["The reply to that request"], &[]),
    ("B6", &["The address eventually has to be increased"], &[]),
    ("B7", &["The address eventually has to be increased"], &[]),
    ("B8", &["Address of parameter d1"], &[]),
    ("B9", &["The check is labelled high, then low"], &[]),
    ("B10", &["E3 is 9 for this map"], &[]),
    ("B11", &["Save is answered at once"], &[]),
    ("B12", &["0x3802 is in none of the tables"], &[]),
    ("B13", &["Bit 6 of the control word starts"], &[]),
    ("B14", &["An edge starts the positioning", "Whether bits 3 and 4 act by level"], &[]),
    ("B15", &["Nodes 1 to 90 on Modbus"], &[]),
    ("B16", &["Neither a bit rate of Modbus", "Illegal addresses and values are answered"], &[]),
    ("C1", &["Not used (L512)"], &[]),
    ("C2", &["Keypad parameters are spelled"], &[]),
    // Addresses of parameters.
    ("C3", &["F4 and O4 are reserved", "Reserved, with an address (L494)", "Reserved, with an address (L527)", "The addresses 23 to 34"], &[54, 56, 68, 84, 91]),
    ("C4", &["Thousandths of the rated speed", "Most rows say Numero"], &[38]),
    ("C5", &["0x80000000 to 0x7FFFFFFF in the register"], &[]),
    ("C6", &["From 0x80000000 on (L252-255)", "0x80000000 is the smallest value"], &[]),
    ("C7", &["Kept over power-off"], &[]),
    ("C8", &["Following_error_windows (L129)", "digital_outputs (L372)", "Aux in 1 (L279)", "Hardware Latched User Position is"], &[]),
    ("C9", &["Torque max, with Object CANopen"], &[]),
    // The line of input 9 is right.
    ("C10", &["Input 10 is 0x3701", "Input 11 is 0x3701"], &[3394, 3701, 3702, 3703]),
    ("C11", &["0 to 0xFF (L135)"], &[]),
    ("C12", &["Register R01 excludes -128"], &[]),
    ("C13", &["Outputs are aux_out_1 and 2"], &[33]),
    ("D1", &["Receive PDO 2 Mapping Parameter"], &[]),
    ("D2", &["The legend has wr"], &[]),
    ("D3", &["4 bytes (L3480)", "4 bytes (L3550)", "4 bytes, as 0x1003:0", "4 bytes (L3806)"], &[]),
    ("D4", &["1 byte (L3851, L3853)"], &[255]),
    ("D5", &["The time is at sub-index 2"], &[]),
    ("D6", &["object 2003, sub 3 and 4"], &[2003]),
    ("D7", &["Sub-index 1 of 0x1A00 is written twice"], &[]),
    ("D8", &["The guarding identifier is 701"], &[701, 1792]),
    ("D9", &["Two TPDOs with 0x1400"], &[]),
    ("D10", &["In ms (L2792)"], &[100]),
    ("D11", &["The size bit is used"], &[]),
    ("D12", &["Lists of abort codes have"], &[]),
    ("D13", &["Numbers without prefix are decimal"], &[701, 2000]),
    ("D14", &["DSP 402 v1.1 and DS 301 v4.01"], &[301, 402]),
    ("D15", &["Text from a general introduction"], &[512]),
    ("D16", &["rw (L3860)", "rw (L3862)", "rw (L3863)", "rw (L3845)"], &[]),
    ("D17", &["Interpolation Time Period.Numofentries", "Digital Outputs.Numofentries", "Position Actual Unit Value"], &[]),
    ("D18", &["Objects have a length and no type"], &[6060, 6081, 6083, 6084, 6092, 6098, 6099]),
    ("D19", &["R01 has the mode (L79)"], &[]),
    ("D20", &["`statusword & 0x0001 == 0`"], &[]),
    ("D21", &["The bits of 0x60FD are the vendor's"], &[]),
    ("D22", &["One sub-entry (L3490-3503)"], &[]),
    ("D23", &["Transmission types 252 and 253"], &[252, 253]),
    ("E1", &["The dictionary of EtherCAT is that of CANopen"], &[]),
    ("E2", &["8 for csp (L5649)"], &[]),
    ("E3", &["EtherCAT maps Modes of Operation"], &[]),
    ("E4", &["On CANopen the value first"], &[]),
    ("E5", &["Reading a parameter over CoE"], &[]),
    ("E6", &["The mailbox header has six bytes"], &[]),
    ("E7", &["The mailbox header has six bytes"], &[]),
    ("E8", &["The mailbox header has six bytes", "8 PDOs are active"], &[]),
    // Numbers of alarms.
    ("E9", &["Two dashes for the code", "11, 12, 20, 21 and 30 to 35", "22 is in this table only"], &[30, 31, 32]),
    ("E10", &["31 to 34 (L5902-5905)"], &[31]),
    ("E11", &["Slot is a choice of PDOs"], &[]),
    ("F1", &["Input and output of PROFINET"], &[]),
    ("F2", &["0x8640 looks like a statusword"], &[]),
    ("F3", &["Fields are listed in the order of a figure"], &[]),
    ("F4", &["The addresses 0 to 99 are parameters"], &[99]),
    ("F5", &["Following Error and Torque Actual Value"], &[]),
    ("F6", &["The axis at node 1"], &[]),
    ("F7", &["PROFINET tells drives by their IP address"], &[]),
    ("F8", &["33 without a meaning on Modbus"], &[33, 34]),
];

/// Every item of section 4 has its doubts, and each line, or range of lines, that it names is in one of these.
#[test]
fn every_contradiction_has_its_doubts() {
    let Some(notes) = notes() else { return };
    let compilation = table();
    let device = device(&compilation);
    let of_items = items(device).flat_map(|item| &item.doubts);
    let of_groups = device.groups.iter().flat_map(|group| &group.doubts);
    let all: Vec<&Doubt> = device.doubts.iter().chain(of_items).chain(of_groups).collect();
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
                for text in [doubt.says.as_str(), doubt.why.as_str(), doubt.chosen.as_str()] {
                    lines.extend(ranges(text, "L").into_iter().flatten());
                }
            }
        }
        let mut missing = ranges(text, "");
        missing.retain(|range| !range.clone().any(|line| lines.contains(&line)));
        let superfluous = no_lines.iter().filter(|own| !missing.iter().any(|range| range.start() == *own));
        left.extend(superfluous.map(|own| format!("{item}: {own} is no exception")));
        missing.retain(|range| !no_lines.contains(range.start()));
        left.extend(missing.iter().map(|range| format!("{item}: {range:?}")));
    }
    assert_eq!((left, ITEMS.len()), (Vec::<String>::new(), 85));
}

/// The lines, and ranges of lines, in a text: numbers of up to four digits, behind `before`.
fn ranges(text: &str, before: &str) -> Vec<RangeInclusive<u32>> {
    let mut found = Vec::new();
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_' || c == '.';
    for word in text.split(|c: char| !is_part(c)) {
        let Some(word) = word.trim_end_matches('.').strip_prefix(before) else { continue };
        let mut ends = word.split('-').map(str::parse::<u32>);
        let (Some(Ok(first)), last) = (ends.next(), ends.next().and_then(Result::ok)) else { continue };
        let last = last.unwrap_or(first);
        if (30..=6462).contains(&first) && (first..first + 200).contains(&last) {
            found.push(first..=last);
        }
    }
    found
}
