//! Section 4 of the notes on the manual of the HSD motors: each of its 55 items, transcribed as it is printed, has its finding, or
//! the doubt in dictionaries/hsd-sm137-sm140.toml that says how it was read. The list is the overview; the tests hold it against
//! the tests that it names, the doubts and, where the manual is beside the repository, its lines.

#[path = "table_support/heads.rs"]
mod heads;
mod hsd_support;

use std::collections::BTreeSet;

use heads::message;
use hsd_support::{device, table, Manual};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;
use How::{Doubt, Finding};

/// What accounts for an item.
enum How {
    /// A test of this file, and the code that it expects.
    Finding(&'static str, &'static str),
    /// Lines of the manual that a doubt names, each with a part of it.
    Doubt(&'static [(usize, &'static str)]),
}

#[rustfmt::skip]
const ITEMS: &[(u8, How)] = &[
    // 4.1: framing.
    (1, Finding("item_01_end_and_escape_are_one_byte", "MSG001")),
    (1, Doubt(&[(156, "ETX=0x1B"), (162, "ESC")])),
    (2, Doubt(&[(177, "L ")])),
    (3, Doubt(&[(185, "68"), (854, "68 byte")])),
    (4, Doubt(&[(238, "09x"), (581, "ETX"), (641, "ETX")])),
    (5, Doubt(&[(249, "BitStato"), (276, "BitStato")])),
    (6, Doubt(&[(38, "1 (07, 2010)"), (42, "3"), (8, "rev. 03")])),
    // 4.2: frames.
    (7, Finding("item_07_a_request_that_begins_unlike_all_others", "MSG007")),
    (7, Doubt(&[(574, "0x00"), (579, "0x00")])),
    (8, Finding("item_08_a_byte_that_the_frame_lost", "MSG006")),
    (8, Doubt(&[(906, "05"), (908, "0x00")])),
    (9, Finding("item_09_one_byte_of_a_value_twice", "TAB004")),
    (9, Doubt(&[(845, "PL ₂"), (848, "PL ₂")])),
    (10, Doubt(&[(790, "Parte alta valore"), (836, "Parte alta valore"), (884, "Parte alta valore")])),
    (11, Finding("item_11_the_reply_of_another_command", "MSG004")),
    (11, Doubt(&[(1446, "CmdJog (0x40)")])),
    (12, Doubt(&[(1306, "campione 1"), (1315, "8+4 N")])),
    (13, Doubt(&[(965, "scrittura")])),
    (14, Doubt(&[(592, "CmdTraj")])),
    (15, Doubt(&[(1213, "Comando"), (1618, "Byte")])),
    (16, Doubt(&[(1187, "bus di campo"), (1191, "protocollo")])),
    (17, Doubt(&[(1266, "nelle appendici ."), (1284, "t. di campionamento"), (1268, "frequenza")])),
    // 4.3: worked examples; `worked_examples` in hsd.rs computes them.
    (18, Doubt(&[(361, "6766.8176"), (365, "6780,8465")])),
    (19, Doubt(&[(546, "01B6F9E"), (550, "0x01"), (611, "01B6F9E"), (615, "0x01")])),
    (20, Doubt(&[(496, "185 mm/min"), (498, "(-185)"), (1425, "-185")])),
    (21, Doubt(&[(1929, "4520"), (1872, "troncamento")])),
    (22, Doubt(&[(1882, "11,313"), (1880, "11.313"), (1938, "11.3137")])),
    (23, Doubt(&[(496, "0.32"), (498, "0,32")])),
    // 4.4: parameters.
    (24, Doubt(&[(1510, "Codice"), (1512, "SM137"), (1513, "SM140")])),
    (25, Finding("item_25_a_default_in_the_column_of_the_range", "EDS050")),
    (25, Doubt(&[(1591, "16")])),
    (26, Finding("item_26_a_default_over_two_lines", "TAB004")),
    (26, Doubt(&[(1578, "-"), (1579, "32767"), (1580, "32767"), (1581, "-")])),
    (27, Finding("item_27_a_limit_that_no_number_of_32_bits_has", "EDS025")),
    (27, Doubt(&[(1576, "2^{31}"), (1578, "2^{31}"), (1580, "2^{31}")])),
    (28, Finding("item_28_one_name_for_two_codes", "TAB002")),
    (28, Doubt(&[(1598, "RESERVED11"), (1599, "RESERVED11")])),
    (29, Finding("item_29_a_number_that_is_missing", "TAB051")),
    (29, Doubt(&[(1516, "0x0101"), (1518, "0x0103"), (1770, "Non utilizzato")])),
    (30, Finding("item_30_a_meaning_outside_of_the_range", "EDS050")),
    (30, Doubt(&[(1607, "1/100"), (206, "non sia 0")])),
    (31, Doubt(&[(1609, "Solo per SM140"), (1611, "Solo per SM140"), (1613, "Solo per SM140")])),
    (32, Doubt(&[(1530, "[Q15](3)")])),
    (33, Doubt(&[(1561, "AXTORQ"), (2156, "0x012 (D-TIMEOUTFB)"), (1635, "CMDGOEMERG"), (2134, "MAXTORQUE")])),
    (34, Doubt(&[(1582, "BIT_A"), (1585, "RESERVED1"), (1772, "| | |"), (1823, "TESTSLIM")])),
    (35, Doubt(&[(1551, "MAXERRORV"), (1832, "MAXERRORV"), (1800, "KPOSLIMMIN"), (1771, "KIQDLIMIN")])),
    (36, Doubt(&[(1572, "32767"), (1559, "32767"), (1563, "32767"), (1545, "5000")])),
    (37, Finding("item_37_one_quantity_with_two_defaults", "TAB050")),
    (37, Doubt(&[(1519, "-195"), (1521, "195"), (1937, "19.6")])),
    (38, Doubt(&[(1812, "(1)"), (1832, "MAXERRORV")])),
    (39, Doubt(&[(1439, "Sezione 6"), (1758, "CMDCHGPAR")])),
    (40, Doubt(&[(1616, "Tabella 1"), (1823, "tabella 1 di pagina 48")])),
    (41, Doubt(&[(1514, "x0.01"), (1522, "x 0.01"), (1547, "Cnt"), (1555, "cnt")])),
    // 4.5: states, alarms, bits.
    (42, Doubt(&[(218, "110"), (2192, "110")])),
    (43, Doubt(&[(291, "Appendice C"), (455, "Appendice C"), (1099, "Appendice D"), (2304, "C ASSISTENZA"), (1748, "6.1.5")])),
    (44, Doubt(&[(405, "ASKBITCOMANDO_SM"), (997, "MASKBITCPMANDO_SM"), (2114, "SARCHINGTACCA"), (2061, "CMDLATCHINTER*"), (2149, "ALWROGSETP")])),
    (45, Doubt(&[(2114, "0 - 1"), (383, "SEARCHINGTACCA"), (427, "SEARCHINGTACCA"), (391, "solo il microinterruttore")])),
    (46, Doubt(&[(1990, "== errore"), (1992, "| |"), (2017, "| | |"), (2071, "(4)")])),
    (47, Finding("item_47_any_condition_and_a_table_that_refuses", "MSG008")),
    (47, Doubt(&[(706, "qualsiasi condizione"), (1077, "qualsiasi condizione"), (941, "stato di allarme")])),
    (48, Doubt(&[(1993, "CMDAZZEL"), (1994, "CMDREG"), (1999, "CMDHOLD")])),
    (49, Doubt(&[(1970, "AXTORQUE"), (688, "EMERGENZA"), (2120, "EMERGENZA")])),
    (50, Doubt(&[(2148, "ALWRONGDATA2 INTERP"), (2150, "ALNOSETP2 INTERP"), (2185, "scrittura"), (2187, "0x400a"), (2163, "(1)")])),
    (51, Doubt(&[(2142, "comunicazione"), (2156, "comunicazione")])),
    (52, Doubt(&[(2237, "1")])),
    (53, Doubt(&[(2205, "quota teorica"), (659, "teorica e quella reale")])),
    (54, Finding("item_54_a_pattern_within_another", "TAB028")),
    (54, Doubt(&[(2294, "S5"), (2295, "S5"), (2296, "S6")])),
    (55, Doubt(&[(2256, "basso"), (2260, "alto")])),
];

#[test]
fn every_item_is_accounted_for() {
    let listed: BTreeSet<u8> = ITEMS.iter().map(|(item, _)| *item).collect();
    assert_eq!(listed, (1..=55).collect());
    let source = include_str!("lints_manual_hsd.rs");
    for (item, how) in ITEMS {
        let Finding(name, code) = how else { continue };
        let text =
            source.split(&format!("fn {name}() {{")).nth(1).unwrap_or_else(|| panic!("{item}: no test `{name}`"));
        let own = text.split("\n}\n").next().unwrap_or_default();
        assert!(own.contains(&format!("\"{code}\"")), "{item}: `{name}` doesn't expect {code}");
    }
}

/// The lines that a text names: `L12`, `L12-15`, `L12, L13`.
fn named(text: &str) -> BTreeSet<usize> {
    let mut lines = BTreeSet::new();
    for (at, _) in text.match_indices('L') {
        let rest = &text[at + 1..];
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(rest.len());
        let mut ends = rest[..end].split('-').map(|number| number.parse::<usize>().ok());
        if let Some(Some(first)) = ends.next() {
            let last = ends.next().flatten().filter(|&last| last >= first).unwrap_or(first);
            lines.extend(first..=last);
        }
    }
    lines
}

#[test]
fn the_doubts_name_the_lines() {
    let compilation = table();
    let doubted: BTreeSet<usize> =
        hsd_support::doubts(device(&compilation)).iter().flat_map(|own| named(own)).collect();
    let mut missing = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        let own = lines.iter().filter(|(line, _)| !doubted.contains(line));
        missing.extend(own.map(|(line, _)| format!("{item}: L{line}")));
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
                wrong.push(format!("{item}: L{line} has no `{part}`"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}

/// The head of a table with the bits that replies have.
const HEAD: &str = r#"lexibus = 1
[device]
name = "HSD Motor"
buses = ["serial"]
[spaces.parameter]
parameter = { order = "CDAB" }
[[chapters]]
[chapters.registers]
KP_I = { reg = 0x0100, type = "i16", access = "rw", scale = 0.01 }
MAXERRORP = { reg = 0x010F, type = "i32", access = "rw" }
"#;

/// The findings of passages: exactly these, each with its line counted from the first one.
#[track_caller]
fn flags(passage: &str, expected: &[(&str, u32)]) -> Compilation {
    flags_with(passage, &Options { no_profiles: true, ..Options::default() }, expected)
}

#[track_caller]
fn flags_with(passage: &str, options: &Options, expected: &[(&str, u32)]) -> Compilation {
    let text = format!("{HEAD}{passage}");
    let found = check(Source::new("t.toml", text.into()), options);
    let above = HEAD.lines().count() as u32;
    let list = found.diagnostics.list();
    let line = |at: lexibus_codegen::source::Span| found.sources[0].position(at.start).line.saturating_sub(above);
    let shown: Vec<_> = list.iter().map(|own| (own.code.id, line(own.span))).collect();
    assert_eq!(shown, expected, "\n{:#?}", list.iter().map(|own| &own.message).collect::<Vec<_>>());
    found
}

#[test]
fn item_01_end_and_escape_are_one_byte() {
    let framing =
        "[framing]\nstart = 0x02\nend = 0x1B\nescape = 0x1B\nescape_xor = 0xFF\nescaped = [0x02, 0x03, 0x1B]\n";
    let found = flags(framing, &[("MSG001", 1)]);
    assert_eq!(message(&found, 0), "`end` and `escape` are both 0x1B");
    flags(&framing.replace("end = 0x1B", "end = 0x03"), &[]);
    let odd = "[framing]\nstart = 2\nend = 3\nescape = 0x10\nescape_xor = 0x12\nescaped = [2, 16]\n";
    let found = flags(odd, &[("MSG001", 1), ("MSG001", 1), ("MSG001", 1)]);
    assert_eq!(message(&found, 0), "0x03 is the `end` of frames, and isn't escaped");
    assert_eq!(message(&found, 1), "0x02 is sent as 0x10, which is special itself");
    assert_eq!(message(&found, 2), "0x10 is sent as 0x02, which is special itself");
}

/// A request of the usual form, and its reply.
fn usual(name: &str, opcode: u8) -> String {
    format!(
        "[[messages]]\nname = \"{name}\"\n\
         request = [{{ field = \"node\", type = \"u8\" }}, {{ bytes = [0x08, {opcode}, 0x00, 0x00, 0x00] }}]\n\
         reply = [{{ echo = \"node\" }}, {{ pad = 1 }}, {{ bytes = [{opcode}, 0x00, 0x00, 0x00] }}]\n"
    )
}

#[test]
fn item_07_a_request_that_begins_unlike_all_others() {
    let others: String = (1..=8).map(|opcode| usual(&format!("Cmd{opcode}"), 0x10 * opcode)).collect();
    let own = r#"[[messages]]
name = "CmdTrajVel"
request = [{ field = "node", type = "u8" }, { bytes = [0x00, 0xC8, 0x00] }, { field = "target", type = "i32", order = "CDAB" }, { field = "speed", type = "u16" }]
reply = [{ echo = "node" }, { pad = 1 }, { bytes = [0xC8, 0x00] }, { echo = "target", part = "0..1" }, { bytes = [0x00] }]
cite = "566-582"
"#;
    let found = flags(&format!("{others}{own}"), &[("MSG007", 34)]);
    assert_eq!(message(&found, 0), "`CmdTrajVel` has the constant 0x00 where 8 other requests have 0x08, in byte 1");
    let few: String = (1..=7).map(|opcode| usual(&format!("Cmd{opcode}"), 0x10 * opcode)).collect();
    flags(&format!("{few}{own}"), &[]);
    let known =
        "allow = [\"MSG007\"]\ndoubt = { says = \"0x00 (L574)\", chose = \"as printed\", why = \"an exception\" }\n";
    flags(&format!("{others}{own}{known}"), &[]);
}

#[test]
fn item_08_a_byte_that_the_frame_lost() {
    let own = r#"[[messages]]
name = "CmdGetParN"
request = [{ field = "node", type = "u8", at = 2 }, { bytes = [0x08, 0xC0], at = 3 }, { code = "parameter", at = 5 }, { bytes = [0x00] }, { bytes = [0x00], at = 7 }, { bytes = [0x00], at = 8 }, { bytes = [0x00], at = 9 }]
cite = "896-911"
"#;
    let found = flags(own, &[("MSG006", 3)]);
    assert_eq!(message(&found, 0), "the field has byte number 7, and would have 8");
    let other = r#"[[messages]]
name = "CmdGetParN"
request = [{ field = "node", type = "u8", at = 2 }, { bytes = [0x08, 0xC0, 0x00], at = 3 }, { code = "parameter", at = 6 }, { bytes = [0x00, 0x00], at = 8 }]
cite = "870-886"
"#;
    flags(other, &[]);
}

#[test]
fn item_09_one_byte_of_a_value_twice() {
    // PL2 PL0 PL3 PL2, the most significant byte being PL3.
    let own = r#"[[messages]]
name = "CmdChgParN"
request = [{ bytes = [0xB8, 0x00] }, { field = "value", type = "i32", order = "BDAB" }]
cite = "824-850"
"#;
    let found = flags(own, &[("TAB004", 3)]);
    assert!(message(&found, 0).starts_with("`BDAB` is no order of bytes"));
}

#[test]
fn item_11_the_reply_of_another_command() {
    let jog = usual("CmdJog", 0x40);
    let own = r#"[[messages]]
name = "CmdChgPar"
request = [{ field = "node", type = "u8" }, { bytes = [0x04] }, { code = "parameter" }, { field = "value", type = "i16" }]
reply = [{ echo = "node" }, { pad = 1 }, { bytes = [0x40] }, { copy = "3..5" }]
cite = "1441-1451"
"#;
    let found = flags(&format!("{jog}{own}"), &[("MSG004", 6)]);
    assert_eq!(
        message(&found, 0),
        "the reply of `CmdChgPar` has the constant 0x40 of `CmdJog`, which its request doesn't have"
    );
    flags(&format!("{jog}{}", own.replace("0x40", "0x04")), &[]);
}

#[test]
fn requests_and_replies_that_cannot_be_told_apart() {
    let two = usual("CmdGetPos", 0x68) + &usual("CmdGetPosT", 0x68);
    let found = flags(&two, &[("MSG003", 6)]);
    assert_eq!(message(&found, 0), "the requests `CmdGetPos` and `CmdGetPosT` can have the same bytes");
    // A position 0x0000B000 looks like a refusal.
    let null = r#"[[messages]]
name = "CmdNACK"
reply = [{ field = "node", type = "u8" }, { pad = 1 }, { bytes = [0xB0] }, { copy = "3..5" }]
[[messages]]
name = "Null"
request = [{ field = "node", type = "u8" }, { bytes = [0x08, 0x00] }]
reply = [{ echo = "node" }, { pad = 1 }, { field = "position", type = "i32", order = "CDAB" }]
error = "CmdNACK"
"#;
    flags(null, &[("MSG005", 5)]);
    flags(&null.replace("error = \"CmdNACK\"\n", ""), &[]);
}

#[test]
fn lengths_of_messages() {
    let own = |max: u8, bits: &str| {
        format!(
            "[framing]\nmax_data = 68\n[[messages]]\nname = \"CmdGetSamp\"\n\
             reply = [{{ field = \"node\", type = \"u8\" }}, {{ fixed = 0, type = \"{bits}\" }}, {{ field = \"status\", type = \"u4\" }}, \
             {{ bytes = [0xA0, 0x00] }}, {{ field = \"samples\", type = \"u16\" }}, \
             {{ repeat = {{ count = \"samples\", max = {max}, fields = [{{ field = \"one\", type = \"i16\" }}, {{ field = \"two\", type = \"i16\" }}] }} }}, \
             {{ bytes = [0xFF, 0xFF] }}]\n"
        )
    };
    flags(&own(15, "u4"), &[]);
    let found = flags(&own(16, "u4"), &[("MSG002", 4)]);
    assert_eq!(
        message(&found, 0),
        "the reply of `CmdGetSamp` is 72 bytes long with all its repetitions, and a frame holds 68"
    );
    let found = flags(&own(15, "u3"), &[("MSG002", 4)]);
    assert_eq!(message(&found, 0), "the reply of `CmdGetSamp` has bits up to bit 15 that are no whole bytes");
}

#[test]
fn item_25_a_default_in_the_column_of_the_range() {
    // `6 | 16` in the columns of defaults and ranges.
    let own =
        "RESERVED4 = { reg = 0x0123, type = \"i16\", access = \"rw\", default = 6, min = 16, max = 16, cite = 1591 }\n";
    let found = flags(own, &[("EDS050", 1)]);
    assert_eq!(message(&found, 0), "the default 6 is below the lower limit 16");
}

#[test]
fn item_26_a_default_over_two_lines() {
    let own = "LOW_SLIM = { reg = 0x011C, type = \"i32\", access = \"rw\", default = \"-\", cite = 1578 }\n";
    let found = flags(own, &[("TAB004", 1)]);
    assert_eq!(message(&found, 0), "`-` is no value of INTEGER32");
}

#[test]
fn item_27_a_limit_that_no_number_of_32_bits_has() {
    let own = "ORIG_AZZ = { reg = 0x011B, type = \"i32\", access = \"rw\", min = -2147483649, max = 2147483647, cite = 1576 }\n";
    let found = flags(own, &[("EDS025", 1)]);
    assert_eq!(message(&found, 0), "INTEGER32 is never -2147483649");
}

#[test]
fn item_28_one_name_for_two_codes() {
    let own = "RESERVED11 = { reg = 0x012A, type = \"?\", access = \"rw\", cite = 1598 }\n\
               RESERVED11 = { reg = 0x012B, type = \"?\", access = \"rw\", cite = 1599 }\n";
    flags(own, &[("TAB002", 2)]);
}

#[test]
fn item_29_a_number_that_is_missing() {
    let row = |name: &str, code: u16| format!("{name} = {{ reg = {code:#06x}, type = \"i16\", access = \"rw\" }}\n");
    let rows = |codes: &[u16]| codes.iter().map(|&code| row(&format!("P{code}"), code)).collect::<String>();
    let mut options = Options { no_profiles: true, ..Options::default() };
    let own = rows(&[0x200, 0x201, 0x203, 0x204]);
    flags_with(&own, &options, &[]);
    options.levels.set("number-gap", Level::Warn).unwrap();
    let found = flags_with(&own, &options, &[("TAB051", 3)]);
    assert_eq!(message(&found, 0), "`P515` has the number 0x0203, and nothing has 0x0202");
    // Parameters at distances of two aren't counted up.
    flags_with(&rows(&[0x200, 0x202, 0x204, 0x206]), &options, &[]);
}

#[test]
fn item_37_one_quantity_with_two_defaults() {
    let own = r#"PIMAX_I = { reg = 0x0104, type = "i16", access = "rw", unit = "V", scale = 0.1, default = 195, same_quantity = "KIQDLIMAX", cite = 1521 }
KIQDLIMAX = { reg = 0x0205, type = "i16", access = "wo", unit = "V", scale = { fraction = 15, of = "voltage_base" }, default = 32767, cite = 1774 }
AMAX = { reg = 0x0119, type = "i16", access = "rw", unit = "ramp", default = 40, same_quantity = "AMAXHOLD", cite = 1573 }
AMAXHOLD = { reg = 0x0214, type = "i16", access = "wo", unit = "ramp of the shaft", scale = { fraction = 15, of = "ramp_base" }, default = 696, cite = 1809 }
[given]
"screw pitch" = { unit = "mm/rev" }
"counts per turn" = { unit = "count/rev", models = { SM140 = 2000 } }
[units]
ramp = { symbol = "count/s²", scale = 10000, machine = { unit = "mm/s²", times = ["screw pitch"], over = ["counts per turn"] } }
"ramp of the shaft" = { symbol = "rev/s²", machine = { unit = "mm/s²", times = ["screw pitch"] } }
[[models]]
name = "SM140"
constants = { voltage_base = 19.6, ramp_base = 9411 }
"#;
    let found = flags(own, &[("TAB050", 1)]);
    assert_eq!(
        message(&found, 0),
        "`PIMAX_I` is the same quantity as `KIQDLIMAX`, and the defaults differ: 19.5 and 19.599 V (SM140)"
    );
    // With the counts of the other model, the accelerations differ too.
    let found = flags(&own.replace("SM140 = 2000", "SM140 = 800"), &[("TAB050", 1), ("TAB050", 3)]);
    assert!(message(&found, 1).ends_with("500 and 199.89 mm/s² (SM140)"), "{}", message(&found, 1));
    flags(&own.replace("default = 195", "default = 196"), &[]);
    let found = flags(
        &own.replace("unit = \"V\", scale = 0.1, default = 195", "unit = \"A\", scale = 0.1, default = 196"),
        &[("TAB050", 1)],
    );
    assert!(message(&found, 0).ends_with("the units `A` and `V`"));
}

#[test]
fn item_30_a_meaning_outside_of_the_range() {
    let own = "TIMEOUTFB = { reg = 0x012D, type = \"i16\", access = \"rw\", unit = \"ms\", min = 1, max = 100, default = 0, cite = [1607, 206] }\n";
    let found = flags(own, &[("EDS050", 1)]);
    assert_eq!(message(&found, 0), "the default 0 is below the lower limit 1");
}

#[test]
fn item_47_any_condition_and_a_table_that_refuses() {
    let own = usual("CmdEmerg", 0x90)
        + r#"accepted_in = ["alarm", "interpolating"]
[enums.State.values]
1 = "alarm"
11 = "interpolating"
[chapters.registers.state]
reg = 1
type = "u16"
access = "ro"
enum = "State"
[machines.axis]
states = "State"
[machines.axis.matrix]
states = ["alarm", "interpolating"]
[machines.axis.matrix.rows]
CmdEmerg = { cells = ["same", "refused"], cite = [1990, 2028] }
"#;
    let own =
        own.replace("[chapters.registers.state]\nreg = 1\ntype = \"u16\"\naccess = \"ro\"\nenum = \"State\"\n", "");
    let used = "state = { reg = 1, type = \"u16\", access = \"ro\", enum = \"State\" }\n";
    let found = flags(&format!("{used}{own}"), &[("MSG008", 3)]);
    assert_eq!(
        message(&found, 0),
        "`CmdEmerg` is accepted in `interpolating`, and the table of `axis` refuses it there"
    );
    flags(&format!("{used}{}", own.replace("[\"alarm\", \"interpolating\"]\n[enums", "[\"alarm\"]\n[enums")), &[]);
}

#[test]
fn item_54_a_pattern_within_another() {
    let own = r#"[machines.interpolation.states]
"interpolating, switch high" = { mask = 0xF6, value = 0x84, orig = "S5", cite = 2294 }
"interpolating, switch low" = { mask = 0xF6, value = 0x82, orig = "S5", cite = 2295 }
latched = { mask = 0xF2, value = 0x82, orig = "S6", cite = 2296 }
"#;
    flags(own, &[("TAB028", 4)]);
}

#[test]
fn mistakes_in_tables_of_commands_and_states() {
    let own = r#"state = { reg = 1, type = "u16", access = "ro", enum = "State" }
[enums.State.values]
1 = "alarm"
2 = "stopped"
[machines.axis]
states = "State"
initial = "alarms"
[machines.axis.matrix]
states = ["alarm", "stoped"]
[machines.axis.matrix.rows]
CmdEmerg = { cells = ["same", "refused"] }
CMDGETPAR = { commands = [], cells = ["= error", { to = "same or same", note = 3 }] }
CMDGOTOBOOT = { commands = [], cells = ["?"] }
"#;
    let expected =
        [("TAB005", 7), ("TAB005", 9), ("TAB005", 11), ("TAB005", 12), ("TAB007", 12), ("TAB005", 12), ("TAB004", 13)];
    let found = flags(own, &expected);
    assert_eq!(message(&found, 2), "there is no command called `CmdEmerg`");
    assert_eq!(message(&found, 6), "`CMDGOTOBOOT` has 1 cells, and the table 2 states");
}

/// Numbers of the machine, a field and parameters with the conversions of the manual.
const CONVERSIONS: &str = r#"[given]
"screw pitch" = { unit = "mm/rev" }
"counts per turn" = { unit = "count/rev" }
[units]
position = { symbol = "count", machine = { unit = "mm", times = ["screw pitch"], over = ["counts per turn"] } }
speed = { symbol = "rpm", machine = { unit = "mm/min", times = ["screw pitch"] } }
"#;

#[track_caller]
fn converts(field: &str, expected: Option<&str>) {
    let passage = format!("{CONVERSIONS}[[messages]]\nname = \"Go\"\nrequest = [{{ bytes = [2] }}, {{ {field} }}]\n");
    let found = flags(&passage, &if expected.is_some() { vec![("TAB052", 9)] } else { Vec::new() });
    if let Some(expected) = expected {
        assert_eq!(message(&found, 0), expected);
    }
}

#[test]
fn item_18_to_20_numbers_that_do_not_fit_their_bytes() {
    let place = |raw: &str, value: f64, counts: u32| {
        format!(
            "field = \"target\", type = \"i32\", unit = \"position\", conversions = [{{ raw = {raw}, value = {value}, unit = \"mm\", \
             given = {{ \"screw pitch\" = 0.32, \"counts per turn\" = {counts} }} }}]"
        )
    };
    // L361 and L365.
    let other = "`target`: 16952116 stands for 6780.846 mm, and not for 6766.8176";
    converts(&place("0x0102AB34", 6766.8176, 800), Some(other));
    converts(&place("0x0102AB34", 6780.8465, 800), None);
    // L546 and L550.
    let other = "`target`: 18575262 stands for 11888.17 mm, and not for 1150.75";
    converts(&place("0x011B6F9E", 1150.75, 500), Some(other));
    converts(&place("0x001B6F9E", 1150.75, 500), None);
    // L496 and L498.
    let speed = |value: f64| {
        format!(
            "field = \"speed\", type = \"i16\", unit = \"speed\", conversions = [{{ raw = -578, value = {value}, unit = \"mm/min\", \
             given = {{ \"screw pitch\" = 0.32 }} }}]"
        )
    };
    converts(&speed(185.0), Some("`speed`: -578 stands for -184.96 mm/min, and not for 185"));
    converts(&speed(-185.0), None);
}

#[test]
fn item_21_a_fraction_that_is_rounded_elsewhere() {
    // L1929: 0.1379 of 32768 is 4518.7; and L1894, 15.5 in two ways.
    let fraction = |raw: i32, value: f64| {
        format!("KCOR = {{ reg = 0x1003, type = \"i16\", access = \"rw\", scale = {{ fraction = 15, of = \"one\" }}, conversions = [{{ raw = {raw}, value = {value}, by = 1 }}] }}\n")
    };
    let found = flags(&fraction(4520, 0.1379), &[("TAB005", 1), ("TAB052", 1)]);
    assert_eq!(message(&found, 1), "`KCOR`: 4520 stands for 0.1379395, and not for 0.1379");
    flags(&fraction(4519, 0.1379), &[("TAB005", 1)]);
    let both = "MANT = { reg = 0x1000, type = \"i16\", access = \"rw\", scale = { exponent = \"EXP\", base = 2, fraction = 15 }, \
                conversions = [{ raw = 31744, value = 15.5, by = 4 }, { raw = 15872, value = 15.5, by = 5 }] }\n\
                EXP = { reg = 0x1001, type = \"i16\", access = \"rw\" }\n";
    flags(both, &[]);
    let found =
        flags(&both.replace("by = 5", "by = 4").replace(", by = 4 }, {", " }, {"), &[("TAB052", 1), ("TAB052", 1)]);
    assert_eq!(message(&found, 0), "`MANT`: say `by`, the value of `EXP`");
    assert_eq!(message(&found, 1), "`MANT`: 15872 stands for 7.75, and not for 15.5");
}
