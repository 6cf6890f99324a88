//! Lists the 55 items in section 4 of the notes on the HSD manual. Each item is covered by the diagnostics of a verbatim
//! transcription (the `manual-hsd` cases in `tests/ui`), or by a `doubt` entry in dictionaries/hsd-sm137-sm140.toml.
//!
//! The tests compare the list with these cases and entries. If the manual is available, the tests also compare the list with
//! the manual.

use crate::cases;
use crate::hsd_support;
use crate::items;

use std::collections::BTreeSet;

use hsd_support::Manual;
use How::{Doubt, Finding};

/// Folder of the test cases in `tests/ui`.
const AREA: &str = "manual-hsd";

/// Test case or `doubt` entry that covers an item.
enum How {
    /// A test case, and a code that its diagnostics must contain.
    Finding(&'static str, &'static str),
    /// Lines of the manual that a `doubt` entry cites, each with a part of the line's text.
    Doubt(&'static [(usize, &'static str)]),
}

#[rustfmt::skip]
const ITEMS: &[(u8, How)] = &[
    // Section 4.1: framing.
    (1, Finding("item-01-end-and-escape-are-one-byte", "MSG001")),
    (1, Doubt(&[(156, "ETX=0x1B"), (162, "ESC")])),
    (2, Doubt(&[(177, "L ")])),
    (3, Doubt(&[(185, "68"), (854, "68 byte")])),
    (4, Doubt(&[(238, "09x"), (581, "ETX"), (641, "ETX")])),
    (5, Doubt(&[(249, "BitStato"), (276, "BitStato")])),
    (6, Doubt(&[(38, "1 (07, 2010)"), (42, "3"), (8, "rev. 03")])),
    // Section 4.2: frames.
    (7, Finding("item-07-request-that-begins-unlike-all-others", "MSG007")),
    (7, Doubt(&[(574, "0x00"), (579, "0x00")])),
    (8, Finding("item-08-byte-that-the-frame-lost", "MSG006")),
    (8, Doubt(&[(906, "05"), (908, "0x00")])),
    (9, Finding("item-09-byte-of-a-value-twice", "TAB004")),
    (9, Doubt(&[(845, "PL ₂"), (848, "PL ₂")])),
    (10, Doubt(&[(790, "Parte alta valore"), (836, "Parte alta valore"), (884, "Parte alta valore")])),
    (11, Finding("item-11-reply-of-another-command", "MSG004")),
    (11, Doubt(&[(1446, "CmdJog (0x40)")])),
    (12, Doubt(&[(1306, "campione 1"), (1315, "8+4 N")])),
    (13, Doubt(&[(965, "scrittura")])),
    (14, Doubt(&[(592, "CmdTraj")])),
    (15, Doubt(&[(1213, "Comando"), (1618, "Byte")])),
    (16, Doubt(&[(1187, "bus di campo"), (1191, "protocollo")])),
    (17, Doubt(&[(1266, "nelle appendici ."), (1284, "t. di campionamento"), (1268, "frequenza")])),
    // Section 4.3: worked examples. `worked_examples` in `hsd/examples.rs` calculates these examples.
    (18, Finding("items-18-19-20-numbers-that-do-not-fit-their-bytes", "TAB052")),
    (18, Doubt(&[(361, "6766.8176"), (365, "6780,8465")])),
    (19, Finding("items-18-19-20-numbers-that-do-not-fit-their-bytes", "TAB052")),
    (19, Doubt(&[(546, "01B6F9E"), (550, "0x01"), (611, "01B6F9E"), (615, "0x01")])),
    (20, Finding("items-18-19-20-numbers-that-do-not-fit-their-bytes", "TAB052")),
    (20, Doubt(&[(496, "185 mm/min"), (498, "(-185)"), (1425, "-185")])),
    (21, Finding("item-21-fraction-that-is-rounded-elsewhere", "TAB052")),
    (21, Doubt(&[(1929, "4520"), (1872, "troncamento")])),
    (22, Doubt(&[(1882, "11,313"), (1880, "11.313"), (1938, "11.3137")])),
    (23, Doubt(&[(496, "0.32"), (498, "0,32")])),
    // Section 4.4: parameters.
    (24, Doubt(&[(1510, "Codice"), (1512, "SM137"), (1513, "SM140")])),
    (25, Finding("item-25-default-in-the-column-of-the-range", "EDS050")),
    (25, Doubt(&[(1591, "16")])),
    (26, Finding("item-26-default-over-two-lines", "TAB004")),
    (26, Doubt(&[(1578, "-"), (1579, "32767"), (1580, "32767"), (1581, "-")])),
    (27, Finding("item-27-limit-beyond-32-bits", "EDS025")),
    (27, Doubt(&[(1576, "2^{31}"), (1578, "2^{31}"), (1580, "2^{31}")])),
    (28, Finding("item-28-name-of-two-codes", "TAB002")),
    (28, Doubt(&[(1598, "RESERVED11"), (1599, "RESERVED11")])),
    (29, Finding("item-29-number-that-is-missing", "TAB051")),
    (29, Doubt(&[(1516, "0x0101"), (1518, "0x0103"), (1770, "Non utilizzato")])),
    (30, Finding("item-30-value-outside-of-the-range", "EDS050")),
    (30, Doubt(&[(1607, "1/100"), (206, "non sia 0")])),
    (31, Doubt(&[(1609, "Solo per SM140"), (1611, "Solo per SM140"), (1613, "Solo per SM140")])),
    (32, Doubt(&[(1530, "[Q15](3)")])),
    (33, Doubt(&[(1561, "AXTORQ"), (2156, "0x012 (D-TIMEOUTFB)"), (1635, "CMDGOEMERG"), (2134, "MAXTORQUE")])),
    (34, Doubt(&[(1582, "BIT_A"), (1585, "RESERVED1"), (1772, "| | |"), (1823, "TESTSLIM")])),
    (35, Doubt(&[(1551, "MAXERRORV"), (1832, "MAXERRORV"), (1800, "KPOSLIMMIN"), (1771, "KIQDLIMIN")])),
    (36, Doubt(&[(1572, "32767"), (1559, "32767"), (1563, "32767"), (1545, "5000")])),
    (37, Finding("item-37-quantity-with-two-defaults", "TAB050")),
    (37, Doubt(&[(1519, "-195"), (1521, "195"), (1937, "19.6")])),
    (38, Doubt(&[(1812, "(1)"), (1832, "MAXERRORV")])),
    (39, Doubt(&[(1439, "Sezione 6"), (1758, "CMDCHGPAR")])),
    (40, Doubt(&[(1616, "Tabella 1"), (1823, "tabella 1 di pagina 48")])),
    (41, Doubt(&[(1514, "x0.01"), (1522, "x 0.01"), (1547, "Cnt"), (1555, "cnt")])),
    // Section 4.5: states, alarms, bits.
    (42, Doubt(&[(218, "110"), (2192, "110")])),
    (43, Doubt(&[(291, "Appendice C"), (455, "Appendice C"), (1099, "Appendice D"), (2304, "C ASSISTENZA"), (1748, "6.1.5")])),
    (44, Doubt(&[(405, "ASKBITCOMANDO_SM"), (997, "MASKBITCPMANDO_SM"), (2114, "SARCHINGTACCA"), (2061, "CMDLATCHINTER*"), (2149, "ALWROGSETP")])),
    (45, Doubt(&[(2114, "0 - 1"), (383, "SEARCHINGTACCA"), (427, "SEARCHINGTACCA"), (391, "solo il microinterruttore")])),
    (46, Doubt(&[(1990, "== errore"), (1992, "| |"), (2017, "| | |"), (2071, "(4)")])),
    (47, Finding("item-47-any-condition-and-a-table-that-refuses", "MSG008")),
    (47, Doubt(&[(706, "qualsiasi condizione"), (1077, "qualsiasi condizione"), (941, "stato di allarme")])),
    (48, Doubt(&[(1993, "CMDAZZEL"), (1994, "CMDREG"), (1999, "CMDHOLD")])),
    (49, Doubt(&[(1970, "AXTORQUE"), (688, "EMERGENZA"), (2120, "EMERGENZA")])),
    (50, Doubt(&[(2148, "ALWRONGDATA2 INTERP"), (2150, "ALNOSETP2 INTERP"), (2185, "scrittura"), (2187, "0x400a"), (2163, "(1)")])),
    (51, Doubt(&[(2142, "comunicazione"), (2156, "comunicazione")])),
    (52, Doubt(&[(2237, "1")])),
    (53, Doubt(&[(2205, "quota teorica"), (659, "teorica e quella reale")])),
    (54, Finding("item-54-pattern-within-another", "TAB028")),
    (54, Doubt(&[(2294, "S5"), (2295, "S5"), (2296, "S6")])),
    (55, Doubt(&[(2256, "basso"), (2260, "alto")])),
];

#[test]
fn every_item_is_accounted_for() {
    let listed: BTreeSet<u8> = ITEMS.iter().map(|(item, _)| *item).collect();
    assert_eq!(listed, (1..=55).collect());
}

#[test]
fn the_cases_report_what_the_list_says() {
    for (item, how) in ITEMS {
        let Finding(name, code) = how else { continue };
        assert!(cases::diagnostics(AREA, name).contains(code), "item {item}: `{name}` does not report {code}");
    }
}

#[test]
fn the_list_has_every_case_of_an_item() {
    let is_listed = |number: u8, case: &str| {
        ITEMS.iter().any(|(item, how)| *item == number && matches!(how, Finding(name, _) if *name == case))
    };
    cases::all_are_listed(AREA, is_listed);
}

#[test]
fn the_doubts_name_the_lines() {
    let doubted = items::doubted("hsd-sm137-sm140.toml");
    let mut missing = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        let lines = lines.iter().filter(|(line, _)| !doubted.contains(line));
        missing.extend(lines.map(|(line, _)| format!("{item}: line {line}")));
    }
    assert_eq!(missing, [""; 0]);
}

#[test]
fn the_lines_say_so() {
    let Some(manual) = Manual::read() else { return };
    let mut wrong = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        for (line, part) in *lines {
            if !manual.line(*line).contains(part) {
                wrong.push(format!("{item}: line {line} has no `{part}`"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}
