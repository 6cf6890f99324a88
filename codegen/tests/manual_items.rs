//! Each of the 60 items of section 4 of the notes on the AEC Vector Step's manual, and each remark of its sections 4.4 and 4.5,
//! with what accounts for it: the findings about a transcription as it is printed, or the doubt in
//! dictionaries/aec-vector-step.toml that says how it was read. The list is the overview; the tests hold it against the
//! tests that it names, the doubts and, where the manual is beside the repository, its lines.

#[path = "table_support/items.rs"]
mod items;
#[path = "table_support/manual.rs"]
mod manual_text;

use std::collections::BTreeSet;
use std::path::Path;

use How::{Doubt, Finding, Import};

/// What accounts for an item.
enum How {
    /// A test of `lints_manual` or `lints_table`, and the codes that it expects.
    Finding(&'static str, &'static [&'static str]),
    /// The same of `import`.
    Import(&'static str, &'static [&'static str]),
    /// Lines of the manual that a doubt names, each with a part of it: no check of facts can see what is odd there.
    Doubt(&'static [(usize, &'static str)]),
}

#[rustfmt::skip]
const ITEMS: &[(&str, How)] = &[
    // 4.1: mapping, width, digits.
    ("1", Finding("items_01_04_05_the_mapping_procedure", &["TAB033"])),
    ("1", Finding("item_01_nine_digits_of_a_default", &["TAB012", "EDS025"])),
    ("2", Finding("item_02_ten_digits_of_a_limit", &["TAB012"])),
    ("3", Finding("item_03_how_many_objects_can_be_mapped", &["TAB021"])),
    ("4", Finding("items_01_04_05_the_mapping_procedure", &["TAB033"])),
    ("5", Finding("items_01_04_05_the_mapping_procedure", &["TAB033"])),
    ("6", Finding("item_06_sub_indices_of_the_summary_and_of_the_boxes", &["TAB021"])),
    ("7", Finding("item_07_two_defaults_one_of_them_with_a_bit_without_meaning", &["TAB004", "TAB019"])),
    ("8", Finding("item_08_a_number_of_entries_without_the_entries", &["EDS049"])),
    ("9", Finding("item_09_one_object_printed_twice", &["TAB007"])),
    ("10", Finding("item_10_names_copied_from_the_box_above", &["TAB040"])),
    // Wording: a transmit PDO that "is received".
    ("11", Doubt(&[(1062, "abilitato a ricevere")])),
    ("12", Finding("item_12_bits_and_values_beyond_their_type", &["TAB013", "TAB015"])),
    ("13", Finding("item_13_a_default_of_four_digits_for_four_bytes", &["TAB012"])),
    ("14", Finding("items_14_16_symbols_twice_in_one_object_and_a_default_that_counts_others", &["TAB040"])),
    ("14", Finding("item_14_prefixes_with_a_capital_letter", &["TAB002", "TAB012"])),
    // Two sentences on the same bits.
    ("15", Doubt(&[(727, "bit 29 e 30"), (815, "bit 29 e 30"), (808, "Non significativo")])),
    ("16", Finding("items_14_16_symbols_twice_in_one_object_and_a_default_that_counts_others", &["EDS049"])),
    // Reading and writing by PDO are both possible for a value that is rw.
    ("16", Doubt(&[(3273, "scrivere il valore nel sub-index 06"), (3284, "Read/Write"), (3285, "Read")])),
    ("17", Finding("item_17_an_index_of_five_digits", &["TAB004"])),
    // 4.2: register number, index, duplicates.
    ("18", Finding("item_18_objects_that_break_the_formula_and_one_that_breaks_its_own_series", &["TAB001"])),
    ("18", Import("items_18_and_19_indices_beside_numbers", &["TAB001"])),
    ("19", Finding("item_19_an_index_of_three_digits", &["TAB012", "TAB001"])),
    ("19", Import("items_18_and_19_indices_beside_numbers", &["CSV003"])),
    ("20", Finding("item_20_a_register_printed_twice", &["TAB007", "TAB002"])),
    ("21", Finding("item_21_an_index_printed_as_a_range_and_rows_without_one", &["TAB006", "TAB001"])),
    ("21", Import("item_53_a_quote_that_would_swallow_seven_rows", &["CSV003"])),
    ("22", Finding("item_22_a_number_of_two_registers", &["TAB005"])),
    ("23", Finding("item_23_how_many_locations_a_program_has", &["TAB007"])),
    // Limits of two registers that nothing ties together.
    ("23", Doubt(&[(3199, "4998"), (3201, "4988"), (3217, "Locazione 4988")])),
    ("24", Finding("item_24_rows_without_a_name_and_one_with_its_description", &["EDS038", "TAB041"])),
    ("24", Doubt(&[(3197, "Rprgrunmode Run mode"), (3198, "Rprgstopevent\t0: Nessuna")])),
    ("25", Import("item_25_a_row_of_ten_cells_and_a_title_of_none", &["CSV005", "CSV003"])),
    ("26", Import("item_26_a_line_of_dashes", &["CSV004"])),
    ("26", Doubt(&[(2556, "Renc3code")])),
    ("27", Finding("item_27_the_hyphen_of_a_line_break", &["TAB041"])),
    ("28", Finding("item_28_one_name_of_an_old_and_a_new_register", &["TAB007"])),
    ("29", Finding("item_29_names_spelled_otherwise_where_they_are_used", &["TAB025"])),
    ("29", Doubt(&[(464, "Axis 1 Posact"), (3082, "Rtouchprobepos2pos")])),
    // A missing sub-index is missing in each row.
    ("30", Doubt(&[(464, "2000:01"), (2129, "0x2000")])),
    // 4.3: type, access, range conflicts.
    ("31", Finding("item_31_32_34_36_the_summary_against_the_box", &["TAB021", "TAB024"])),
    ("32", Finding("item_31_32_34_36_the_summary_against_the_box", &["TAB021"])),
    ("33", Finding("item_33_negative_limits_of_an_unsigned_type", &["EDS051"])),
    ("34", Finding("item_31_32_34_36_the_summary_against_the_box", &["TAB021", "TAB012"])),
    ("35", Finding("item_35_a_constant_without_a_bit_that_is_marked", &["TAB018", "TAB021"])),
    ("36", Finding("item_31_32_34_36_the_summary_against_the_box", &["TAB021"])),
    ("37", Finding("item_37_limits_of_an_unsigned_type_for_a_signed_one", &["EDS051"])),
    ("38", Finding("item_38_a_measured_velocity_that_is_never_zero", &["TAB023"])),
    ("39", Finding("item_39_elements_that_exclude_sub_index_0", &["TAB021", "EDS058"])),
    // 0xFD is a value of Unsigned8; that CiA has Integer8 stands in no line.
    ("39", Doubt(&[(1862, "0xFD"), (1864, "Unsigned8")])),
    ("40", Finding("item_40_a_limit_that_sets_reserved_bits", &["TAB019"])),
    ("40", Doubt(&[(1994, "[0.. 8]"), (2449, "Bit8: Out8")])),
    ("41", Finding("item_41_a_mode_without_bits", &["TAB037"])),
    ("42", Finding("items_42_43_the_control_word_of_the_touch_probe", &["TAB041"])),
    ("43", Finding("items_42_43_the_control_word_of_the_touch_probe", &["TAB022", "TAB025"])),
    ("43", Finding("item_43_two_bits_called_the_same", &["TAB040"])),
    // Words for the edges and the sources.
    ("43", Doubt(&[(1706, "al touch probe 1"), (1770, "valore positivo"), (1794, "valore positivo"), (2958, "fronte positivo"), (2973, "fronti positivi"), (3028, "Touch Encoder 1")])),
    ("44", Finding("item_44_types_that_dont_go_with_their_limits", &["EDS025", "TAB016", "TAB018", "TAB009", "TAB004"])),
    ("44", Finding("item_44_no_notes_at_all", &["TAB010"])),
    ("45", Finding("item_45_values_and_bits_outside_of_the_limits", &["TAB016", "TAB018", "TAB021"])),
    ("46", Finding("item_46_access_that_contradicts_storage_and_mapping", &["TAB024", "TAB022"])),
    // Saved versions, a saved command and limits that are read are possible, each by itself.
    ("46", Doubt(&[(2867, "RW SAVE"), (2868, "RW SAVE"), (2869, "RW SAVE"), (3184, "RO"), (3185, "RO"), (3188, "SAVE")])),
    ("47", Finding("item_47_a_mode_that_is_reserved", &["TAB018", "TAB015", "TAB017"])),
    ("48", Finding("item_48_one_value_with_two_limits_and_two_types", &["TAB022"])),
    ("49", Finding("item_49_commands_written_and_read_at_other_bits", &["TAB022"])),
    // Both filters exist.
    ("50", Doubt(&[(2273, "Rposalmtime"), (2356, "Rflwtim"), (2382, "Rflwtim")])),
    ("51", Finding("item_51_how_many_errors_are_kept", &["TAB021"])),
    ("52", Finding("item_52_one_list_of_methods_that_ends_early", &["TAB022"])),
    ("52", Doubt(&[(1626, "TOP encoder motore"), (2227, "TOP encoder 1")])),
    ("53", Finding("item_53_a_pattern_with_a_digit_less", &["TAB006", "TAB015", "TAB017"])),
    ("53", Import("item_53_a_quote_that_would_swallow_seven_rows", &["CSV008"])),
    ("53", Import("item_53_quotes_around_whole_cells_and_at_the_end", &["CSV003"])),
    // What CiA says otherwise.
    ("54", Doubt(&[(683, "Errore generico"), (690, "maggiore"), (691, "inferiore"), (696, "FF06"), (698, "FF03")])),
    // Names that are active low, and headers of columns.
    ("55", Doubt(&[(1287, "Disable voltage"), (1333, "Voltage disabled"), (1368, "Bit"), (1391, "Bit"), (1407, "Bit"), (1425, "Bit"), (1444, "Bit"), (1461, "Modo operativo\tCodifica"), (1939, "Modo operativo")])),
    // `writable` says it.
    ("56", Doubt(&[(665, "Read/Write"), (652, "Scrivendo 0")])),
    ("57", Finding("item_57_versions_in_many_spellings", &["TAB027", "TAB026"])),
    ("57", Doubt(&[(2173, "6,15"), (2705, "Fw710"), (2785, "5.50"), (2678, "3.44")])),
    // What isn't there.
    ("58", Doubt(&[(574, "0x601"), (944, "0x00000580")])),
    // A picture of a running drive.
    ("59", Doubt(&[(464, "RW P 3849")])),
    ("60", Finding("item_60_defaults_in_the_cell_of_the_limit", &["TAB004", "TAB042"])),
    ("60", Import("item_60_a_default_in_the_cell_of_a_limit", &["CSV003"])),
    // 4.4: damage in general. Headings and split letters; HTML and LaTeX; figures; what breaks off; spellings of notes; WORD.
    ("4.4 headings", Doubt(&[(167, "V ARIE")])),
    ("4.4 markup", Doubt(&[(1577, "$"), (1745, "^{*1}"), (2012, "<input"), (2752, "$")])),
    ("4.4 figures", Doubt(&[(447, ""), (1314, ""), (2110, "")])),
    ("4.4 truncated", Doubt(&[(2812, "0 1 0 1 Oper")])),
    ("4.4 notes", Doubt(&[(2196, "NO_MAP"), (2223, "NOMAP"), (2130, "MAP-READ"), (2875, "H- LWORD"), (2785, "Unsign16"), (2951, "Unsig- ned16")])),
    ("4.4 width", Finding("section_4_4_a_width_that_the_notes_deny", &["TAB021"])),
    ("4.4 width", Doubt(&[(2221, "WORD"), (2953, "WORD"), (2795, "WORD")])),
    // 4.5: what the text doesn't determine.
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
fn the_tests_expect_what_the_list_says() {
    let lints = [include_str!("lints_manual.rs"), include_str!("lints_table.rs")];
    let imports = [include_str!("../import/tests/import.rs")];
    for (item, how) in ITEMS {
        let (sources, name, codes) = match how {
            Finding(name, codes) => (lints.as_slice(), name, codes),
            Import(name, codes) => (imports.as_slice(), name, codes),
            Doubt(_) => continue,
        };
        let text = items::test(sources, name).unwrap_or_else(|| panic!("item {item}: there is no test `{name}`"));
        for code in *codes {
            assert!(text.contains(&format!("\"{code}\"")), "item {item}: `{name}` doesn't expect {code}");
        }
    }
}

#[test]
fn the_doubts_name_the_lines() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/aec-vector-step.toml");
    let doubted = items::doubted(&std::fs::read_to_string(path).expect("the table"));
    let mut missing = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        missing.extend(
            lines.iter().filter(|(line, _)| !doubted.contains(line)).map(|(line, _)| format!("{item}: L{line}")),
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
                wrong.push(format!("{item}: L{line} has no `{part}`"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}
