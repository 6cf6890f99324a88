//! Lists the 60 items in section 4 of the notes on the AEC Vector Step manual, and the remarks in sections 4.4 and 4.5. Each
//! item is covered by the diagnostics of a verbatim transcription (the `manual-vector-step` cases in `tests/ui`), by a test of
//! `import`, or by a `doubt` entry in dictionaries/aec-vector-step.toml.
//!
//! The tests compare the list with these cases, tests and entries. If the manual is available, the tests also compare the list
//! with the manual.

use crate::cases;
use crate::items;
use crate::manual_text;

use std::collections::BTreeSet;

use How::{Doubt, Finding, Import};

/// Folder of the test cases in `tests/ui`.
const AREA: &str = "manual-vector-step";

/// Test case, `import` test or `doubt` entry that covers an item.
enum How {
    /// A test case, and codes that its diagnostics must contain.
    Finding(&'static str, &'static [&'static str]),
    /// A test of `import` and the codes that it expects.
    Import(&'static str, &'static [&'static str]),
    /// Lines of the manual that a `doubt` entry cites, each with a part of the line's text. This variant is for contradictions
    /// that the compiler cannot detect.
    Doubt(&'static [(usize, &'static str)]),
}

#[rustfmt::skip]
const ITEMS: &[(&str, How)] = &[
    // Section 4.1: mapping, width, digits.
    ("1", Finding("items-01-04-05-mapping-procedure", &["TAB033"])),
    ("1", Finding("item-01-nine-digits-of-a-default", &["TAB012", "EDS025"])),
    ("2", Finding("item-02-ten-digits-of-a-limit", &["TAB012"])),
    ("3", Finding("item-03-number-of-mapped-objects", &["TAB021"])),
    ("4", Finding("items-01-04-05-mapping-procedure", &["TAB033"])),
    ("5", Finding("items-01-04-05-mapping-procedure", &["TAB033"])),
    ("6", Finding("item-06-sub-indices-of-the-overview", &["TAB021"])),
    ("7", Finding("item-07-default-with-a-bit-without-meaning", &["TAB004", "TAB019"])),
    ("8", Finding("item-08-number-of-entries-without-entries", &["EDS049"])),
    ("9", Finding("item-09-object-printed-twice", &["TAB007"])),
    ("10", Finding("item-10-names-copied-from-the-box-above", &["TAB040"])),
    // The wording is wrong: according to the manual, a transmit PDO "is received".
    ("11", Doubt(&[(1062, "abilitato a ricevere")])),
    ("12", Finding("item-12-bits-and-values-beyond-their-type", &["TAB013", "TAB015"])),
    ("13", Finding("item-13-default-of-four-digits-for-four-bytes", &["TAB012"])),
    ("14", Finding("items-14-16-symbols-twice-in-one-object", &["TAB040"])),
    ("14", Finding("item-14-prefixes-with-a-capital-letter", &["TAB002", "TAB012"])),
    // Two sentences describe the same bits differently.
    ("15", Doubt(&[(727, "bit 29 e 30"), (815, "bit 29 e 30"), (808, "Non significativo")])),
    ("16", Finding("items-14-16-symbols-twice-in-one-object", &["EDS049"])),
    // The manual's heading calls this object a read PDO, but the text below the heading states that a client writes the object. The
    // access rights of the object are `rw`, but it can be mapped only to TPDOs.
    ("16", Doubt(&[(3273, "scrivere il valore nel sub-index 06"), (3284, "Read/Write"), (3285, "Read")])),
    ("17", Finding("item-17-index-of-five-digits", &["TAB004"])),
    // Section 4.2: register numbers, indices, duplicates.
    ("18", Finding("item-18-objects-that-break-the-formula", &["TAB001"])),
    ("18", Finding("item-18-neighbors-without-a-rule", &["TAB001"])),
    ("18", Import("items_18_and_19_indices_beside_numbers", &["TAB001"])),
    ("19", Finding("item-19-index-of-three-digits", &["TAB012", "TAB001"])),
    ("19", Import("items_18_and_19_indices_beside_numbers", &["CSV003"])),
    ("20", Finding("item-20-register-printed-twice", &["TAB007", "TAB002"])),
    ("21", Finding("item-21-index-printed-as-a-range", &["TAB006", "TAB001"])),
    ("21", Import("item_53_a_quote_that_would_swallow_seven_rows", &["CSV003"])),
    ("22", Finding("item-22-number-of-two-registers", &["TAB005"])),
    ("23", Finding("item-23-number-of-program-locations", &["TAB007"])),
    // The register table cannot express a relation between the limits of these two registers.
    ("23", Doubt(&[(3199, "4998"), (3201, "4988"), (3217, "Locazione 4988")])),
    ("24", Finding("item-24-rows-without-a-name", &["EDS038", "TAB041"])),
    ("24", Doubt(&[(3197, "Rprgrunmode Run mode"), (3198, "Rprgstopevent\t0: Nessuna")])),
    ("25", Import("item_25_a_row_of_ten_cells_and_a_title_of_none", &["CSV005", "CSV003"])),
    ("26", Import("item_26_a_line_of_dashes", &["CSV004"])),
    ("26", Doubt(&[(2556, "Renc3code")])),
    ("27", Finding("item-27-hyphen-of-a-line-break", &["TAB041"])),
    ("28", Finding("item-28-name-of-an-old-and-a-new-register", &["TAB007"])),
    ("29", Finding("item-29-names-misspelled-in-texts", &["TAB025"])),
    ("29", Doubt(&[(464, "Axis 1 Posact"), (3082, "Rtouchprobepos2pos")])),
    // The rows of registers never print the sub-index of their objects.
    ("30", Doubt(&[(464, "2000:01"), (2129, "0x2000")])),
    // Section 4.3: conflicts of types, access rights and ranges.
    ("31", Finding("items-31-32-34-36-overview-against-the-box", &["TAB021", "TAB024"])),
    ("32", Finding("items-31-32-34-36-overview-against-the-box", &["TAB021"])),
    ("33", Finding("item-33-negative-limits-of-an-unsigned-type", &["EDS051"])),
    ("34", Finding("items-31-32-34-36-overview-against-the-box", &["TAB021", "TAB012"])),
    ("34", Finding("item-34-length-of-the-type", &["TAB020", "TAB021"])),
    ("35", Finding("item-35-constant-without-a-marked-bit", &["TAB018", "TAB021"])),
    ("36", Finding("items-31-32-34-36-overview-against-the-box", &["TAB021"])),
    ("37", Finding("item-37-limits-of-an-unsigned-type-for-a-signed-one", &["EDS051"])),
    ("38", Finding("item-38-measured-velocity-that-is-never-zero", &["TAB023"])),
    ("39", Finding("item-39-elements-without-sub-index-0", &["TAB021", "EDS058"])),
    // 0xFD is a valid Unsigned8. No line of the manual states that CiA uses Integer8.
    ("39", Doubt(&[(1862, "0xFD"), (1864, "Unsigned8")])),
    ("40", Finding("item-40-limit-that-sets-reserved-bits", &["TAB019"])),
    ("40", Doubt(&[(1994, "[0.. 8]"), (2449, "Bit8: Out8")])),
    ("41", Finding("item-41-mode-without-bits", &["TAB037"])),
    ("42", Finding("items-42-43-control-word-of-the-touch-probe", &["TAB041"])),
    ("43", Finding("items-42-43-control-word-of-the-touch-probe", &["TAB022", "TAB025"])),
    ("43", Finding("item-43-two-bits-with-one-name", &["TAB040"])),
    // The manual's words for edges and sources of the touch probe are ambiguous.
    ("43", Doubt(&[(1706, "al touch probe 1"), (1770, "valore positivo"), (1794, "valore positivo"), (2958, "fronte positivo"), (2973, "fronti positivi"), (3028, "Touch Encoder 1")])),
    ("44", Finding("item-44-types-that-contradict-their-limits", &["EDS025", "TAB016", "TAB018", "TAB009", "TAB004"])),
    ("44", Finding("item-44-no-notes-at-all", &["TAB010"])),
    ("45", Finding("item-45-values-and-bits-outside-of-the-limits", &["TAB016", "TAB018", "TAB021"])),
    ("46", Finding("item-46-access-against-storage-and-mapping", &["TAB024", "TAB022"])),
    // The compiler cannot detect these wrong access rights, because each of them is possible: versions and a command are saved, and
    // limits are read-only.
    ("46", Doubt(&[(2867, "RW SAVE"), (2868, "RW SAVE"), (2869, "RW SAVE"), (3184, "RO"), (3185, "RO"), (3188, "SAVE")])),
    ("47", Finding("item-47-mode-that-is-reserved", &["TAB018", "TAB015", "TAB017"])),
    ("48", Finding("item-48-one-value-with-two-limits-and-two-types", &["TAB022"])),
    ("49", Finding("item-49-commands-at-other-bits", &["TAB022"])),
    // The manual names two different filter times, and the register table describes both.
    ("50", Doubt(&[(2273, "Rposalmtime"), (2356, "Rflwtim"), (2382, "Rflwtim")])),
    ("51", Finding("item-51-number-of-kept-errors", &["TAB021"])),
    ("52", Finding("item-52-list-of-methods-that-ends-early", &["TAB022"])),
    ("52", Doubt(&[(1626, "TOP encoder motore"), (2227, "TOP encoder 1")])),
    ("53", Finding("item-53-pattern-with-a-digit-less", &["TAB006", "TAB015", "TAB017"])),
    ("53", Import("item_53_a_quote_that_would_swallow_seven_rows", &["CSV008"])),
    ("53", Import("item_53_quotes_around_whole_cells_and_at_the_end", &["CSV003"])),
    // The cited lines deviate from CiA standards.
    ("54", Doubt(&[(683, "Errore generico"), (690, "maggiore"), (691, "inferiore"), (696, "FF06"), (698, "FF03")])),
    // The names of active-low bits are wrong, and column headers are ambiguous.
    ("55", Doubt(&[(1287, "Disable voltage"), (1333, "Voltage disabled"), (1368, "Bit"), (1391, "Bit"), (1407, "Bit"), (1425, "Bit"), (1444, "Bit"), (1461, "Modo operativo\tCodifica"), (1939, "Modo operativo")])),
    // The register table expresses the allowed written value with `writable`.
    ("56", Doubt(&[(665, "Read/Write"), (652, "Scrivendo 0")])),
    ("57", Finding("item-57-versions-in-many-spellings", &["TAB027", "TAB026"])),
    ("57", Doubt(&[(2173, "6,15"), (2705, "Fw710"), (2785, "5.50"), (2678, "3.44")])),
    // Parts of the extracted text are missing.
    ("58", Doubt(&[(574, "0x601"), (944, "0x00000580")])),
    // The cited example is a screenshot of a running drive.
    ("59", Doubt(&[(464, "RW P 3849")])),
    ("60", Finding("item-60-defaults-in-the-cell-of-the-limit", &["TAB004", "TAB042"])),
    ("60", Import("item_60_a_default_in_the_cell_of_a_limit", &["CSV003"])),
    // Section 4.4: damage to the extracted text (headings, split letters, HTML, LaTeX, figures, truncated texts), spellings of
    // notes, and the type WORD.
    ("4.4 headings", Doubt(&[(167, "V ARIE")])),
    ("4.4 markup", Doubt(&[(1577, "$"), (1745, "^{*1}"), (2012, "<input"), (2752, "$")])),
    ("4.4 figures", Doubt(&[(447, ""), (1314, ""), (2110, "")])),
    ("4.4 truncated", Doubt(&[(2812, "0 1 0 1 Oper")])),
    ("4.4 notes", Doubt(&[(2196, "NO_MAP"), (2223, "NOMAP"), (2130, "MAP-READ"), (2875, "H- LWORD"), (2785, "Unsign16"), (2951, "Unsig- ned16")])),
    ("4.4 width", Finding("section-4-4-width-that-the-notes-deny", &["TAB021"])),
    ("4.4 width", Doubt(&[(2221, "WORD"), (2953, "WORD"), (2795, "WORD")])),
    // Section 4.5: facts that the text does not determine.
    ("4.5 sub-index", Doubt(&[(455, ""), (464, "2000:01")])),
    ("4.5 stride", Doubt(&[(3289, "shiftati di 10")])),
    ("4.5 axes", Doubt(&[(455, "H2000"), (1050, "1600")])),
    ("4.5 access", Doubt(&[(2262, "")])),
    ("4.5 mapping", Doubt(&[(2169, "")])),
    ("4.5 sign", Doubt(&[(2795, "Holding Register (32bit)")])),
    ("4.5 second word", Doubt(&[(2590, "0x47D2-D3")])),
];

#[test]
fn every_item_is_accounted_for() {
    let listed: BTreeSet<&str> = ITEMS.iter().map(|(item, _)| *item).collect();
    let missing: Vec<String> =
        (1..=60).map(|item| item.to_string()).filter(|item| !listed.contains(item.as_str())).collect();
    assert_eq!(missing, [""; 0]);
}

#[test]
fn the_cases_and_tests_report_what_the_list_says() {
    for (item, how) in ITEMS {
        let (text, name, codes, [before, behind]) = match how {
            Finding(name, codes) => (cases::diagnostics(AREA, name), name, codes, ['[', ']']),
            Import(name, codes) => (import_test(name).to_owned(), name, codes, ['"', '"']),
            Doubt(_) => continue,
        };
        for code in *codes {
            assert!(text.contains(&format!("{before}{code}{behind}")), "item {item}: `{name}` does not report {code}");
        }
    }
}

/// Returns the source text of an `import` test, from its name to its end.
fn import_test(name: &str) -> &'static str {
    let source = include_str!("../../import/tests/import.rs");
    let start = source.find(&format!("fn {name}() {{")).unwrap_or_else(|| panic!("there is no test `{name}`"));
    let rest = &source[start..];
    &rest[..rest.find("\n}\n").unwrap_or(rest.len())]
}

#[test]
fn the_list_has_every_case_of_an_item() {
    let is_listed = |number: u8, case: &str| {
        let is_of_case = |how: &How| matches!(how, Finding(name, _) if *name == case);
        ITEMS.iter().any(|(item, how)| *item == number.to_string() && is_of_case(how))
    };
    cases::all_are_listed(AREA, is_listed);
}

#[test]
fn the_doubts_name_the_lines() {
    let doubted = items::doubted("aec-vector-step.toml");
    let mut missing = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        missing.extend(
            lines.iter().filter(|(line, _)| !doubted.contains(line)).map(|(line, _)| format!("{item}: line {line}")),
        );
    }
    assert_eq!(missing, [""; 0]);
}

#[test]
fn the_lines_say_so() {
    let Some(manual) = manual_text::text("aec-vector-step-canopen.it.txt") else { return };
    let manual: Vec<&str> = manual.lines().collect();
    let mut wrong = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        for (line, part) in *lines {
            if !manual.get(line - 1).is_some_and(|text| text.contains(part)) {
                wrong.push(format!("{item}: line {line} has no `{part}`"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}
