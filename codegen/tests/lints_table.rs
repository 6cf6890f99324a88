//! Lints of register tables. Each fixture is a faithful, uncorrected transcription of a passage that contradicts itself:
//! the number in a test's name is that of section 4 of the notes on the AEC Vector Step; lines (`cite`) are the manual's. More of
//! them are in `lints_manual`, and `manual_items` lists them all.

#[path = "table_support/heads.rs"]
mod heads;

use heads::*;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

fn compile(text: &str, wanted: &[&str]) -> Compilation {
    let mut options = Options { no_profiles: true, ..Options::default() };
    // A fixture is no whole device.
    options.levels.set("missing-mandatory-object", Level::Allow).unwrap();
    for code in ["half-a-pdo", "no-sub0", "no-subs"] {
        options.levels.set(code, Level::Allow).unwrap();
    }
    for code in wanted {
        options.levels.set(code, Level::Warn).unwrap();
    }
    check(Source::new("table.toml", text.as_bytes().to_vec()), &options)
}

/// The findings: exactly these codes, each at a place whose text begins so.
#[track_caller]
fn flags_with(wanted: &[&str], text: &str, expected: &[(&str, &str)]) -> Compilation {
    let found = compile(text, wanted);
    let source = &found.sources[0];
    let place = |at: lexibus_codegen::source::Span| source.text().get(at.range()).unwrap_or_default();
    let list = found.diagnostics.list();
    let same = list.len() == expected.len()
        && list.iter().zip(expected).all(|(own, (code, at))| own.code.id == *code && place(own.span).starts_with(at));
    let shown: Vec<_> = list.iter().map(|own| (own.code.id, place(own.span), &own.message)).collect();
    assert!(same, "expected {expected:#?}\nfound {shown:#?}");
    found
}

#[track_caller]
fn flags(text: &str, expected: &[(&str, &str)]) -> Compilation {
    flags_with(&[], text, expected)
}

/// Rows of `[chapters.registers]`, and what follows.
#[track_caller]
fn registers(rows: &str, expected: &[(&str, &str)]) -> Compilation {
    flags(&format!("{REGISTERS}{rows}"), expected)
}

/// Rows of `[chapters.objects]`, and what follows.
#[track_caller]
fn objects(rows: &str, expected: &[(&str, &str)]) -> Compilation {
    flags(&format!("{DEVICE}{OBJECTS}{rows}"), expected)
}

/// The same of a CANopen device.
#[track_caller]
fn canopen(rows: &str, expected: &[(&str, &str)]) -> Compilation {
    flags(&format!("{CANOPEN}{OBJECTS}{rows}"), expected)
}

#[test]
fn item_02_ten_digits_of_a_limit() {
    let rows = r#"0x1016 = { name = "Consumer heartbeat", code = "array" }
"0x1016:1" = { name = "Consumer_heartbeat_time", type = "u32", access = "rw", pdo = "no", min = 0x00000000,
    max = 0x007FFFFFFF, default = 0x00000000, cite = 843 }
"#;
    objects(rows, &[("TAB012", "0x007FFFFFFF")]);
}

const SYNC: &str = r#"0x1005 = { name = "COD_ID_SYNC", type = "u32", access = "rw", pdo = "no", min = 0x00000000, max = 0xFFFFFFFF,
    default = DEFAULT, cite = 712, bits = { 31 = { reserved = "keep" }, 30 = "generates SYNC",
    29 = "29-bit identifier", "28-11" = { name = "extension", number = true }, "10-0" = { name = "SYNC COB-ID",
    number = true } } }
"#;

#[test]
fn item_07_two_defaults_one_of_them_with_a_bit_without_meaning() {
    let rows = SYNC.replace("DEFAULT", r#""0x80 or 0x80000080""#);
    objects(&rows, &[("TAB004", r#""0x80 or 0x80000080""#)]);
    let found = objects(&SYNC.replace("DEFAULT", "0x80000080"), &[("TAB019", "0x80000080")]);
    assert_eq!(message(&found, 0), "the default 0x80000080 sets bit 31 (reserved) of `COD_ID_SYNC`");
}

#[test]
fn item_08_a_number_of_entries_without_the_entries() {
    let rows = r#"0x1016 = { name = "heartbeat", code = "array" }
"0x1016:0" = { name = "number_of_entries", type = "u8", access = "ro", min = 0x00, max = 0x02, default = 0x00,
    cite = 838 }
"0x1016:1..2" = { name = "time {sub}", type = "u32", access = "rw" }
"#;
    canopen(rows, &[("EDS049", "0x00")]);
}

#[test]
fn item_09_one_object_printed_twice() {
    let rows = r#"0x1003 = { name = "errors", code = "array" }
"0x1003:2" = { name = "standard_error_field", type = "u32", access = "ro", cite = 674 }
[[chapters]]
[chapters.objects]
"0x1003:2" = { name = "serial_number", type = "u32", access = "ro", cite = 909 }
"#;
    objects(rows, &[("TAB007", r#""0x1003:2""#)]);
}

#[test]
fn item_10_names_copied_from_the_box_above() {
    let rows = r#"0x1003 = { name = "pre_defined_error_field", code = "array", cite = 655 }
0x1018 = { name = "pre_defined_error_field", code = "array", cite = 878 }
0x1800 = { name = "TPDO 1", code = "record" }
"0x1800:2" = { name = "Transmission_type", type = "u8", access = "rw", cite = 1108 }
"0x1800:3" = { name = "Transmission_type", type = "u16", access = "rw", cite = 1130 }
"#;
    objects(rows, &[("TAB040", r#""pre_defined_error_field""#), ("TAB040", r#""0x1800:3""#)]);
}

#[test]
fn item_12_bits_and_values_beyond_their_type() {
    let rows = r#"0x1000 = { name = "device_type", type = "u32", access = "ro", cite = 628, bits = "DeviceType" }
0x6086 = { name = "Motion_profile_type", type = "i16", access = "rw", cite = 1611, enum = { -10 = "pure S",
    0 = "trapezoid", "1..3" = { zone = "reserved" }, "4..32768" = { zone = "reserved" } } }
0x60C0 = { name = "Interpolation_submode_select", type = "i16", access = "rw", min = 0x8000, max = 0x7FFF,
    default = 0x0000, cite = 1815, enum = { "-32768..-1" = { zone = "reserved" }, 0 = "linear",
    "1..32768" = { zone = "reserved" } } }
0x60C4 = { name = "Buffer_clear", type = "u8", access = "wo", cite = 1942, enum = { 0 = "clear", 1 = "enable",
    "2..256" = { zone = "reserved" } } }
[bits.DeviceType.at]
"0..15" = { name = "device profile", number = true }
"16..23" = { name = "drive type", number = true }
"24..32" = { name = "manufacturer specific", number = true }
"#;
    let found =
        objects(rows, &[("TAB013", r#""u32""#), ("TAB015", r#""i16""#), ("TAB015", r#""i16""#), ("TAB015", r#""u8""#)]);
    assert_eq!(
        message(&found, 0),
        "UNSIGNED32 has 32 bits, and `DeviceType` names bits 32-24 (`manufacturer specific`)"
    );
    assert_eq!(message(&found, 1), "INTEGER16 is never 32768 (`reserved`)");
}

#[test]
fn item_13_a_default_of_four_digits_for_four_bytes() {
    let rows = r#"0x60BA = { name = "Rtouchprobe-pos1pos", type = "i32", access = "ro", pdo = "tx", min = 0x80000000,
    max = 0x7FFFFFFF, default = 0x0000, cite = 1763 }
"#;
    let found = objects(rows, &[("TAB012", "0x0000")]);
    assert_eq!(message(&found, 0), "`0x0000` is filled up to 4 digits, and INTEGER32 has 8");
}

#[test]
fn item_17_an_index_of_five_digits() {
    let text = format!(
        r#"{DEVICE}[axes]
count = 3
cite = 422
rules = [ {{ objects = "0x6000..0x607FF", index = 0x800 }} ]
"#
    );
    flags(&text, &[("TAB004", r#"{ objects = "0x6000..0x607FF""#)]);
}

#[test]
fn item_18_objects_that_break_the_formula_and_one_that_breaks_its_own_series() {
    let rows = r#"Ralmbuffres = { reg = 10144, obj = 0x4800, type = "u16", access = "rw", save = true, cite = 2321 }
Ralmbuffptr = { reg = 10145, obj = 0x4801, type = "u16", access = "rw", min = 0, max = 15, cite = 2322 }
Ralmbufftime = { reg = "10146-47", obj = 0x4802, type = "u32", access = "ro", cite = 2323 }
Ralmbuffcode = { reg = "10148-49", obj = 0x4803, type = "u32", access = "ro", cite = 2324 }
[[chapters]]
[chapters.registers]
Rstepouttime = { reg = 10151, obj = 0x4807, type = "u16", min = 0, max = 65535, cite = 2458 }
Rstepoutcount = { reg = "10152-53", obj = 0x4808, type = "u32", min = 1, max = 0xFFFFFFFF, cite = 2459 }
"#;
    let places = ["0x4800", "0x4801", "0x4802", "0x4803", "0x4803", "0x4807", "0x4808"];
    let found = registers(rows, &places.map(|at| ("TAB001", at)));
    assert_eq!(message(&found, 0), "the row says object 0x4800, and the rule of its space 0x47A0:0");
    let both = [message(&found, 3), message(&found, 4)];
    assert!(both.contains(&"the row says object 0x4803, and by the rows around it, it would be 0x4804"), "{both:?}");
    assert!(both.contains(&"the row says object 0x4803, and the rule of its space 0x47A4:0"), "{both:?}");
}

#[test]
fn item_18_without_a_rule_the_neighbours_tell() {
    let rows = REGISTERS.replace("canopen = { index = 0x2000 }\n", "")
        + r#"one = { reg = 1, obj = 0x2001, type = "u16" }
two = { reg = 2, obj = 0x2003, type = "u16" }
three = { reg = 3, obj = 0x2003, type = "u16" }
four = { reg = 4, obj = 0x2004, type = "u16" }
"#;
    flags(&rows, &[("TAB001", "0x2003"), ("TAB007", "three")]);
}

#[test]
fn item_19_an_index_of_three_digits() {
    let rows = r#"Rprofists = { reg = 166, obj = 0x20A, type = "u16", access = "ro", pdo = "no", cite = 2796,
    enum = { 0 = "disabled", 1 = "parameters", 2 = "configuration", 3 = "data exchange",
    0xFF = "fatal error" } }
"#;
    let found = registers(rows, &[("TAB012", "0x20A"), ("TAB001", "0x20A")]);
    assert_eq!(message(&found, 0), "the index `0x20A` has 3 digits, and any has 4");
}

#[test]
fn item_20_a_register_printed_twice() {
    let first = r#"Rtouchprobe2timestampneg = { reg = "10104-5", type = "u32", unit = "ns", access = "ro", cite = 2980 }
"#;
    let second = r#"Rtouchprobe2timestampneg = { reg = "10104-5", type = "u32", cite = 2981 }
"#;
    let again = format!("{first}[[chapters]]\n[chapters.registers]\n{second}");
    registers(&again, &[("TAB007", "Rtouchprobe2timestampneg"); 3]);
    registers(&format!("{first}{second}"), &[("TAB002", "Rtouchprobe2timestampneg")]);
}

#[test]
fn item_28_one_name_of_an_old_and_a_new_register() {
    let rows = r#"Rtouchprobefunc = { reg = 331, type = "u16", cite = 2951 }
[[chapters]]
[chapters.registers]
Rtouchprobefunc = { reg = 10084, type = "u16", cite = 2963 }
"#;
    registers(rows, &[("TAB007", "Rtouchprobefunc")]);
}

#[test]
fn item_31_32_34_36_the_summary_against_the_box() {
    let rows = r#"0x6040 = { name = "Controlword", type = "u16", access = "ro", pdo = "rx", min = 0x0000, max = 0xFFFF,
    default = 0x0000, cite = 1278, summary = { type = "u16", access = "rw", pdo = "rx", subs = 1,
    cite = 1207 } }
0x6081 = { name = "Profile_velocity", type = "i32", access = "rw", pdo = "rx", min = 0x00000000,
    max = 0x7FFFFFFF, default = 0x00000064, cite = 1535, summary = { type = "u32", access = "rw", pdo = "rx",
    cite = 1224 } }
0x6402 = { name = "Motor_type", type = "u32", access = "rw", pdo = "rx", min = 0x0000, max = 0xFFFF,
    default = 0x0008, cite = 2004, summary = [ { length = 2, cite = 2004 }, { type = "u16", pdo = "no",
    cite = 1247 }, { default = 9, cite = 2001 } ] }
0x6085 = { name = "Quick_stop_deceleration", type = "u32", access = "rw", pdo = "no", min = 0x00000001,
    max = 0x00030D40, default = 0x000003E8, cite = 1583, summary = { access = "rw", pdo = "rx", cite = 1228 } }
"#;
    let summary = |at| ("TAB021", at);
    let found = objects(
        rows,
        &[
            ("TAB024", r#""rx""#),
            summary(r#""rw""#),
            summary(r#""u32""#),
            ("TAB012", "0x0000"),
            ("TAB012", "0x0008"),
            summary("2"),
            summary(r#""u16""#),
            summary(r#""no""#),
            summary("9"),
            summary(r#""rx""#),
        ],
    );
    assert_eq!(message(&found, 1), "the summary says rw, and the row ro");
    assert_eq!(message(&found, 5), "the summary says 2 bytes, and the row UNSIGNED32");
}

#[test]
fn item_33_negative_limits_of_an_unsigned_type() {
    let row = r#"0x6082 = { name = "End_velocity", type = "u32", access = "rw", pdo = "rx", min = 0xFFFFEC78, max = 0x00001388,
    default = 0x00000000, cite = 1548 }
"#;
    let found = objects(row, &[("EDS051", "0xFFFFEC78")]);
    assert_eq!(help(&found, 0), "as INTEGER32, 0xFFFFEC78 is -5000: is the type signed?");
}

#[test]
fn item_35_a_constant_without_a_bit_that_is_marked() {
    let row = r#"0x6502 = { name = "Supported drive modes", type = "u32", access = "ro", fixed = 0x00010021, pdo = "tx",
    cite = 2033, summary = { pdo = "no", cite = 1248 }, bits = "Modes" }
[bits.Modes.at]
0 = { name = "profile position", values = { 1 = "supported" } }
1 = { name = "velocity", values = { 0 = "not supported" } }
4 = { reserved = 0 }
5 = { name = "homing", values = { 1 = "supported" } }
6 = { name = "interpolated", values = { 1 = "supported" }, cite = 2048 }
"15-7" = { reserved = 0 }
16 = { name = "AEC velocity", values = { 1 = "supported" } }
"#;
    let found = objects(row, &[("TAB018", "0x00010021"), ("TAB021", r#""no""#)]);
    assert_eq!(message(&found, 0), "the fixed value 0x10021 has 0 in bit 6 (`interpolated`), where only 1 is named");
}

#[test]
fn item_37_limits_of_an_unsigned_type_for_a_signed_one() {
    let row = r#"0x6061 = { name = "Mode display", type = "i8", access = "ro", min = 0x00, max = 0xFF, cite = 1480 }
"#;
    let found = objects(row, &[("EDS051", "0x00")]);
    assert_eq!(help(&found, 0), "as UNSIGNED8, 0xFF is 255: is the type unsigned?");
}

#[test]
fn item_38_a_measured_velocity_that_is_never_zero() {
    let row = r#"0x606C = { name = "Velocity_actual_value", type = "i32", access = "ro", pdo = "tx", min = 0x00000001,
    max = 0x00004E20, default = 0x000003E8, cite = 1508 }
"#;
    objects(row, &[("TAB023", "0x00000001")]);
}

#[test]
fn item_40_a_limit_that_sets_reserved_bits() {
    let row = r#"0x60FD = { name = "Digital inputs", type = "u32", access = "ro", min = 0, max = 0xFFFF00F7, cite = 1949,
    bits = "Inputs" }
[bits.Inputs.at]
0 = "negative limit"
1 = "positive limit"
2 = "home"
"15-3" = { reserved = "keep" }
"31-16" = { name = "inputs", number = true }
"#;
    let found = objects(row, &[("TAB019", "0xFFFF00F7")]);
    assert_eq!(message(&found, 0), "the upper limit 0xFFFF00F7 sets bits 15-3 (reserved) of `Inputs`");
}

const MODES: &str = r#"0x6060 = { name = "Modes of operation", type = "i8", access = "wo", pdo = "rx", default = 0x01, cite = 1456,
    enum = "Mode" }
"#;
const MODE: &str = r#"[enums.Mode.values]
"-128..-2" = { zone = "reserved" }
-1 = "AEC velocity"
0 = { zone = "reserved" }
1 = "profile position"
"2..5" = { zone = "reserved" }
6 = "homing"
7 = "interpolated"
"8..127" = { zone = "reserved", cite = 1469 }
"#;

#[test]
fn item_44_types_that_dont_go_with_their_limits() {
    let rows = r#"Rssiencturns = { reg = 97, type = "u16", access = "ro", pdo = "tx", min = -32768, max = 32767, cite = 2566 }
Rstrmodeofoperation = { reg = 358, type = "u16", save = true, min = -1, max = 8, cite = 2830 }
Rtouchprobe2inpdef = { reg = 342, type = "i16", min = 0, max = 255, enum = "Input", cite = 2960 }
Rtouchprobe1inp = { reg = 10090, type = "i16", save = true, min = -21, max = 6, enum = "Input", cite = 2969 }
Rextencper = { reg = 164, type = "u6", cite = 2535 }
Rds402compatibility = { reg = 365, cite = 2831 }
[enums.Input.values]
-20 = "TOP encoder 2"
-19 = "BLS"
-18 = "FLS"
-17 = "TOP encoder 1"
"-16..-1" = "input, falling"
0 = { zone = "reserved" }
"1..4" = "input, rising"
5 = "TOP encoder 1, rising"
6 = "encoder 1, point 0"
"#;
    let found = registers(
        rows,
        &[
            ("EDS025", "-32768"),
            ("EDS025", "-1"),
            ("TAB016", "0"),
            ("TAB018", "0"),
            ("TAB018", "-21"),
            ("TAB009", r#""u6""#),
            ("TAB004", "Rds402compatibility"),
        ],
    );
    assert_eq!(help(&found, 0), "is the type `i16`?");
    assert_eq!(message(&found, 2), "`TOP encoder 2` is -20, below the lower limit 0, and so are 4 more");
    assert_eq!(message(&found, 4), "the lower limit -21 has no name in `Input`");
}

#[test]
fn item_44_no_notes_at_all() {
    let rows = REGISTERS.replace(
        r#"[defaults]
access = "rw"
"#,
        "",
    );
    flags(
        &(rows
            + r#"Ranainpdisable = { reg = 429, type = "u16", cite = 2476 }
"#),
        &[("TAB010", "Ranainpdisable")],
    );
}

#[test]
fn item_45_values_and_bits_outside_of_the_limits() {
    let rows = r#"Rfuno0 = { reg = 121, type = "u16", min = 0, max = 14, cite = 2425, enum = { 0 = "normal output",
    1 = "drive enabled", "2..13" = "others", 14 = "motor direction", 15 = "STO output" } }
Rfgmode = { reg = 323, type = "u16", min = 0, max = 2, cite = 3189, enum = { 0 = "sine", 1 = "square",
    2 = "pulse", 4 = "profile" } }
Rstrtconf = { reg = 217, type = "u16", min = 0, max = 13, cite = 2609, enum = "Configuration" }
Rconfig = { reg = 222, type = "u16", min = 0, max = 15, cite = 2658, enum = "Configuration" }
Rcanbaud = { reg = 169, type = "u16", min = 0, max = 8, cite = 2799, enum = { 0 = "10 kbit/s", 1 = "20 kbit/s",
    2 = "50 kbit/s", 3 = "125 kbit/s", 4 = "250 kbit/s", 5 = "500 kbit/s", 6 = "800 kbit/s", 7 = "1 Mbit/s" } }
Rampfrq = { reg = 301, type = "u16", min = 0, max = 10, cite = 2680, summary = { min = 1, max = 10,
    cite = 2680 } }
Ralarm32 = { reg = "559-60", type = "u32", pdo = "tx", min = 0, max = 65536, cite = 2316,
    bits = { 0 = "overcurrent HW", 18 = "no SYNC", 23 = "pin of safe output" } }
Rcamstspcor = { reg = 458, type = "i16", unit = "%", min = -1000, max = 1000, cite = 3126,
    summary = { min = -100, max = 100, cite = 3126 } }
[enums.Configuration.values]
0 = "open loop"
13 = "smart"
14 = "Smit"
15 = "virtual"
"#;
    let found = registers(
        rows,
        &[
            ("TAB016", "14"),
            ("TAB016", "2"),
            ("TAB016", "13"),
            ("TAB018", "8"),
            ("TAB021", "1"),
            ("TAB016", "65536"),
            ("TAB021", "-100"),
            ("TAB021", "100"),
        ],
    );
    assert_eq!(message(&found, 0), "`STO output` is 15, above the upper limit 14");
    assert_eq!(message(&found, 3), "the upper limit 8 has no name in `Rcanbaud`");
    let bits = "bit 18 (`no SYNC`) can't be set below the upper limit 65536, and neither can 1 more";
    assert_eq!(message(&found, 5), bits);
}

#[test]
fn item_47_a_mode_that_is_reserved() {
    let rows = format!(
        r#"Rveltarg = {{ reg = "493-494", type = "i32", pdo = "rx", min = -20000, max = 20000,
    when = {{ "Modes of operation" = [9] }}, cite = 2197 }}
Rstrmodeofoperation = {{ reg = 358, type = "u16", save = true, min = -1, max = 8, enum = "Mode", cite = 2830 }}
[chapters.objects]
{MODES}{MODE}"#
    );
    let expected = [("TAB018", "Rveltarg"), ("TAB015", r#""u16""#), ("EDS025", "-1"), ("TAB018", "8")];
    let found = registers(&rows, &expected);
    let never = "the condition `Modes of operation` = 9 never holds: 9 is reserved there";
    assert_eq!((message(&found, 0), message(&found, 3)), (never, "the upper limit 8 is reserved in `Mode`"));
    let twice = format!(
        r#"{MODES}{MODE}9 = "cyclic velocity"
"#
    );
    let found = objects(&twice, &[("TAB017", "9")]);
    assert_eq!(message(&found, 0), "`reserved` (8 to 127) and `cyclic velocity` (9) of `Mode` are the same value");
}

#[test]
fn item_48_one_value_with_two_limits_and_two_types() {
    let rows = r#"Rhacc = { reg = "87-88", type = "u32", pdo = "rx", min = 0, max = 200000, cite = 2230 }
Rvss = { reg = "65-66", type = "i32", pdo = "rx", min = 0, max = 10000, cite = 2179 }
Rstrtvss = { reg = "391-92", type = "u32", save = true, min = 0, max = 10000, same_as = "Rvss", cite = 2611 }
Racc = { reg = "67-68", type = "u32", pdo = "rx", min = 0, max = 200000, cite = 2180 }
Rstrtacc = { reg = "393-94", type = "u32", save = true, min = 1, max = 200000, same_as = "Racc", cite = 2612 }
[chapters.objects]
0x609A = { name = "Homing_acceleration", type = "u32", access = "rw", pdo = "rx", min = 0x00000001,
    max = 0x0007A120, default = 0x00000001, same_as = "Rhacc", cite = 1684 }
"#;
    let found = registers(rows, &[("TAB022", "Rstrtvss"), ("TAB022", "Rstrtacc"), ("TAB022", "0x609A")]);
    assert!(message(&found, 0).ends_with("differs: UNSIGNED32 and INTEGER32"));
    assert!(message(&found, 1).ends_with("differs: lower limit 1 and 0"));
    assert!(message(&found, 2).ends_with("differs: lower limit 1 and 0; upper limit 500000 and 200000"));
}

#[test]
fn item_49_commands_written_and_read_at_other_bits() {
    let rows = r#"Rcmd1wr = { reg = 60, type = "u16", cite = 2203, bits = { 0 = "current step", 1 = "phase test", 2 = "winding",
    3 = "Smit", 4 = "realign", 5 = { reserved = "keep" }, 6 = "cam step/dir", 7 = "recover position" } }
Rcmd1rd = { reg = 62, type = "u16", access = "ro", cite = 2207, same_as = "Rcmd1wr",
    bits = { 0 = "current step", 1 = "phase test", 3 = "winding", 4 = "Smit", 5 = "realign",
    6 = { reserved = "keep" }, 7 = "cam step/dir", 8 = "recover position" } }
"#;
    let found = registers(rows, &[("TAB022", "Rcmd1rd")]);
    assert!(message(&found, 0)
        .contains("differs: the bits 2, 5, 6, 8 have a meaning in one of them only; bit 3 is `winding`"));
}

#[test]
fn item_51_how_many_errors_are_kept() {
    let rows = r#"0x1003 = { name = "errors", code = "array" }
"0x1003:0" = { name = "number_of_errors", type = "u8", access = "rw", min = 0x00, max = 0x02, cite = 652,
    summary = { max = 8, cite = 3343 } }
"0x1003:1..2" = { name = "standard_error_field {sub}", type = "u32", access = "ro" }
"#;
    objects(rows, &[("TAB021", "8")]);
}

#[test]
fn item_52_one_list_of_methods_that_ends_early() {
    let rows = r#"Rhmode = { reg = 82, type = "i16", min = -16, max = 37, cite = 2227, enum = { -16 = "limit", 0 = "in place",
    35 = "method 35", 37 = "method 37" } }
Rstrthmode = { reg = 405, type = "i16", min = -16, max = 0, cite = 2620, same_as = "Rhmode",
    enum = { -16 = "limit", 0 = "in place" } }
"#;
    let found = registers(rows, &[("TAB022", "Rstrthmode")]);
    assert!(message(&found, 0).ends_with("upper limit 0 and 37; the values 35, 37 have a meaning in one of them only"));
}

#[test]
fn item_53_a_pattern_with_a_digit_less() {
    let rows = r#"Rindoptions = { reg = 10003, type = "u16", access = "ro", cite = 2788,
    bits = { "2-1-0" = { name = "absolute encoder" } } }
"#;
    registers(rows, &[("TAB006", r#""2-1-0""#)]);
    let values = r#"0b000 = "none", 0b001 = "SSI", 0b010 = "EnDat", 0b011 = "BiSS", 0b100 = "sin/cos", 0b101 = "free 5", 0b110 = "free 6", "#;
    let row = |last: &str| {
        format!(
            r#"Rindoptions = {{ reg = 10003, type = "u16", bits = {{ "2-0" = {{ name = "encoder",
    values = {{ {values}{last} = "free" }} }} }} }}
"#
        )
    };
    let found = registers(&row("11"), &[("TAB015", r#""2-0""#)]);
    assert_eq!(message(&found, 0), "UNSIGNED3 is never 11 (`free`)");
    let found = registers(&row("0b11"), &[("TAB017", "0b11")]);
    assert_eq!(message(&found, 0), "`BiSS` (3) and `free` (3) of `Rindoptions encoder` are the same value");
}

#[test]
fn item_57_versions_in_many_spellings() {
    let rows = r#"RpidposKp = { reg = 10110, type = "u16", since = "Fw710", cite = 2705 }
Rhwconfig = { reg = 278, type = "u16", until = "6,15", cite = 2173 }
Rindfamily = { reg = 10000, type = "u16", access = "ro", since = "5.50", cite = 2785 }
Rmotenc = { reg = "151-152", type = "i32", until = "6", cite = 2503 }
"#;
    let found = registers(rows, &[("TAB027", "RpidposKp"), ("TAB027", "Rhwconfig")]);
    assert_eq!(message(&found, 0), "`RpidposKp` has the firmware version `Fw710`, which isn't numbers and points");
    let rows = r#"Rmoved = { reg = 279, type = "u16", since = "6.27", until = "6.3" }
"#;
    registers(rows, &[("TAB026", "Rmoved")]);
}

#[test]
fn section_4_4_a_width_that_the_notes_deny() {
    // WORD is in the notes of a register of 32 bits.
    let row = r#"Rhpos = { reg = "38-39", type = "i32", min = 0x80000000, max = 0x7FFFFFFF, save = true, cite = 2221,
    summary = { length = 2, cite = 2221 } }
"#;
    registers(row, &[("TAB021", "2")]);
}

// What the notes of the other manuals ask for.

#[test]
fn bits_of_two_rows_of_one_table_overlap() {
    // AKD 4: bits 3 to 7 reserved, though 3, 4 and 5 have names.
    let rows = r#"event = { reg = 0x204, type = "u8", bits = "Event" }
[bits.Event.at]
3 = "AL control"
"5-4" = { name = "sync", number = true }
"7-3" = { reserved = 0 }
"#;
    let found = registers(rows, &[("TAB014", r#""5-4""#), ("TAB014", r#""7-3""#)]);
    assert_eq!(message(&found, 1), "bit 3 (`AL control`) and bits 7-3 (reserved) of `Event` share bits");
    // What the firmware or the mode tells apart may.
    let windows = r#"word = { reg = 1, type = "u8", bits = { 2 = [ { name = "old", until = "6" }, { name = "new", since = "6" } ] } }
"#;
    registers(windows, &[]);
}

#[test]
fn a_definition_takes_a_finding_upon_itself() {
    let rows = r#"event = { reg = 1, type = "u8", bits = "Event" }
[bits.Event]
allow = ["bits-overlap", "TAB025"]
doubt = { says = "both", chose = "both", why = "so" }
[bits.Event.at]
3 = "control"
"7-3" = { reserved = 0 }
"2-1" = { name = "source", values = { 0 = "input", 1 = "by 0x60D0" } }
"#;
    registers(rows, &[]);
}

#[test]
fn memory_of_another_length_than_its_type() {
    // AKD 6: a register of four bytes, declared with two.
    let rows = r#"al_event = { esc = 0x220, length = 2, type = "u32" }
name = { reg = 3, type = "str(4)", default = "SMD50" }
"#;
    registers(rows, &[("TAB020", r#""u32""#), ("TAB020", r#""SMD50""#)]);
}

#[test]
fn patterns_of_states_and_commands() {
    // AKD 13, and what it would be with states.
    let machine = format!(
        "{DEVICE}[machines.drive.states]\nready = {{ mask = 0x6F, value = 0x21 }}\nfault = {{ mask = 0x08, value = 0x08 }}\n\
         never = {{ mask = 0x0F, value = 0x10 }}\nenabled = {{ mask = 0x6F, value = 0x27 }}\nreaction = {{ mask = 0x4F, value = 0x0F }}\n\
         [machines.drive.commands]\nswitch_on = {{ mask = 0x87, value = 0x07 }}\nenable = {{ mask = 0x8F, value = 0x0F }}\n"
    );
    let states = [("TAB039", "never"), ("TAB028", "reaction")];
    let found = flags(&machine, &states);
    assert_eq!(message(&found, 1), "0xF is both of the states `fault` and `reaction`");
    assert!(found.diagnostics.has_errors());
    flags_with(&["commands-overlap"], &machine, &[states[0], states[1], ("TAB029", "enable")]);
}

#[test]
fn pdos_mapped_and_not_assigned() {
    // AKD 29: the list maps 0x1A00 and assigns 0x1B01. AKD 34: 0x1C12 as a byte, which can't hold an index.
    let rows = r#"0x1A00 = { name = "TPDO 1 mapping", code = "record" }
"0x1A00:1" = { name = "entry 1", type = "u32", access = "rw" }
0x1C12 = { name = "RxPDO assign", code = "array" }
"0x1C12:1" = { name = "RxPDO 1", type = "u8", access = "rw" }
0x1C13 = { name = "TxPDO assign", code = "array" }
"0x1C13:1" = { name = "TxPDO 1", type = "u16", access = "rw", default = 0x1A00 }
[procedures.startup]
steps = [ { write = "0x1A00:1", value = 0x60410010 }, { write = "0x1C13:1", value = 0x1B01 } ]
[procedures.assign]
steps = [ { write = "0x1C12:1", value = 0x1A00 } ]
"#;
    let steps = [r#"{ write = "0x1A00:1""#, r#"{ write = "0x1C13:1""#, r#"{ write = "0x1C12:1""#];
    let expected = [("TAB035", steps[0]), ("PDO001", steps[0]), ("TAB034", steps[1]), ("TAB033", steps[2])];
    let found = objects(rows, &expected);
    assert_eq!(message(&found, 0), "`startup` maps 0x1A00, and assigns other PDOs");
    assert_eq!(message(&found, 2), "the PDO 0x1B01 is assigned, and isn't described");
    assert_eq!(message(&found, 3), "`assign`: writes 6656 to `0x1C12:1`, which is UNSIGNED8");
}

#[test]
fn pdos_of_a_table_against_its_objects() {
    let rows = r#"0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx", bits = { 0 = "on" } }
0x6041 = { name = "Statusword", type = "u16", access = "ro", pdo = "tx" }
0x6064 = { name = "Position", type = "i32", access = "ro", pdo = "no" }
[[pdos]]
index = 0x1600
direction = "rx"
entries = ["0x6040:0/8", "0x6041:0/16", "0x6064:0/32", "0x6099:1/16"]
"#;
    let expected = [
        ("PDO004", "[[pdos]]"),
        ("PDO005", "\"0x6040:0/8\""),
        ("PDO003", "\"0x6041:0/16\""),
        ("PDO002", "\"0x6064:0/32\""),
        ("PDO003", "\"0x6064:0/32\""),
        ("PDO001", "\"0x6099:1/16\""),
    ];
    let found = canopen(rows, &expected);
    assert_eq!(message(&found, 0), "the PDO 0x1600 has 72 bits, and a CAN frame has 64");
    assert_eq!(message(&found, 2), "0x6041 sub-index 0x0 is ro and can't be mapped into an RPDO");
}

#[test]
fn a_mapping_object_against_the_mapped_bits() {
    let rows = r#"0x1400 = { name = "RPDO 1", code = "record" }
"0x1400:1" = { name = "COB-ID", type = "u32", access = "rw" }
0x1600 = { name = "RPDO 1 mapping", code = "record" }
"0x1600:0" = { name = "entries", type = "u8", access = "rw", default = 2 }
"0x1600:1" = { name = "entry 1", type = "u32", access = "rw", default = 0x60400008 }
"0x1600:2" = { name = "entry 2", type = "u32", access = "rw", default = 0x607A0020 }
0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx", bits = { 0 = "on" } }
0x607A = { name = "Target position", type = "i32", access = "rw", pdo = "tx" }
"#;
    canopen(rows, &[("PDO005", "0x60400008"), ("PDO003", "0x607A0020")]);
}

#[test]
fn codes_that_contain_each_other() {
    // Eco D12.
    let codes = |wide: &str| {
        format!(
            r#"{DEVICE}[codes.abort.rows]
"{wide}" = "unsupported access"
"0x06010002..0x06010004" = "read-only"
"#
        )
    };
    let same = "`read-only` (100728834 to 100728836) of `abort` are the same value";
    for (wide, at) in [("0x06010000..0x06010003", 0), ("0x6010002..0x06010004", 1)] {
        let found = flags(&codes(wide), &[("TAB017", "abort")]);
        assert!(at == 1 || message(&found, 0).ends_with(same), "{}", message(&found, 0));
    }
    // The narrowest range wins.
    flags(&codes("0x06010000..0x0601000F"), &[]);
    flags(&codes("0x06010003"), &[]);
}

#[test]
fn windows_of_an_item_and_its_replacement() {
    let rows = r#"old = { reg = 1, type = "u16", until = "6.15", replaced_by = "new" }
new = { reg = 2, type = "u16", since = "SINCE" }
"#;
    registers(&rows.replace("SINCE", "6.15"), &[]);
    let early = registers(&rows.replace("SINCE", "6.3"), &[("TAB026", "old")]);
    assert_eq!(message(&early, 0), "`old` exists until 6.15, and its replacement exists since 6.3 already");
    let late = registers(&rows.replace("SINCE", "6.27"), &[("TAB026", "old")]);
    assert_eq!(message(&late, 0), "`old` exists until 6.15, and its replacement exists since 6.27 only");
}

#[test]
fn a_row_takes_a_finding_upon_itself() {
    let row = r#"Rcanbaud = { reg = 169, type = "u16", min = 0, max = 8, enum = { 0 = "10k", 7 = "1M" }, allow = ["TAB018"] }
"#;
    registers(row, &[]);
}

#[test]
fn bits_that_nobody_named() {
    let text = format!(
        r#"{REGISTERS}status = {{ reg = 1, type = "u8", bits = {{ 0 = "ready", "6-1" = {{ reserved = 0 }} }} }}
"#
    );
    let found = flags_with(&["unnamed-bits"], &text, &[("TAB036", "status")]);
    assert_eq!(message(&found, 0), "`status` says nothing of the bits 7");
    flags(&text, &[]);
}

// What a row says of its values, held against itself.

#[test]
fn only_values_against_the_limits_of_their_row() {
    let found = |row: &str, code: &str, at: &str, says: &str| {
        let found = registers(&format!("a = {{ {row} }}\n"), &[(code, at)]);
        assert_eq!(message(&found, 0), says);
        assert!(!help(&found, 0).is_empty() || code == "EDS025" || says.starts_with("the default"), "{row}");
    };
    let outside = |row: &str, at: &str, says: &str| found(row, "EDS050", at, says);
    outside(
        r#"reg = 20, type = "u16", min = 5, max = 9, fixed = 4"#,
        "4",
        "the fixed value 4 is below the lower limit 5",
    );
    outside(r#"reg = 20, type = "u16", fixed = 4, default = 5"#, "5", "the default 5 isn't the fixed value 4");
    outside(
        r#"reg = 20, type = "u16", allowed = [1, 2], default = 4"#,
        "4",
        "the default 4 is none of the allowed values",
    );
    outside(
        r#"reg = 20, type = "u16", allowed = [1, 2], min = 2, max = 9"#,
        "[1, 2]",
        "the allowed value 1 is below the lower limit 2",
    );
    outside(
        r#"reg = 20, type = "u16", min = 0, max = 9, writable = [3, 12]"#,
        "12",
        "the value 12, which may be written, is above the upper limit 9",
    );
    outside(
        r#"reg = 20, type = "u16[3]", min = 1, max = 2, default = [1, 2, 7]"#,
        "7",
        "the default 7 of element 3 is above the upper limit 2",
    );
    outside(
        r#"reg = 20, type = "u16[2]", min = 1, max = 2, default = [3, 2]"#,
        "[3, 2]",
        "the default 3 is above the upper limit 2",
    );
    found(r#"reg = 20, type = "u16", writable = [70000]"#, "EDS025", "70000", "UNSIGNED16 is never 70000");
    let short = r#"a = { reg = 20, type = "u16[3]", default = [1, 2] }
"#;
    registers(short, &[("TAB004", "[1, 2]")]);
}

#[test]
fn only_values_within_the_limits_of_their_row() {
    let rows = r#"a = { reg = 20, type = "u16", min = 4, max = 4, fixed = 4, default = 4 }
b = { reg = 21, type = "u16", min = 1, max = 100, allowed = [1, 10, 100], default = 10, writable = [1] }
c = { reg = 30, type = "u16[3]", min = 1, max = 2, default = [1, 2, 2] }
"d{n}" = { reg = 40, count = 2, type = "u16", min = 1, max = 2, default = [1, 2] }
e = { reg = 50, type = "u16[3]", min = 1, max = 2, default = 1 }
"#;
    registers(rows, &[]);
}

#[test]
fn item_34_a_length_that_is_not_that_of_the_type() {
    let rows = r#"d = { reg = 6, type = "u32", length = 2 }
f = { reg = 12, type = "str(25)", length = 27 }
g = { reg = 40, type = "str(25)", summary = { length = 27 } }
"#;
    let found = registers(rows, &[("TAB020", "2"), ("TAB020", "27"), ("TAB021", "27")]);
    assert_eq!(message(&found, 0), "`d` is printed with 2 bytes, and its type takes 4");
    assert_eq!(message(&found, 2), "the summary says 27 bytes, and the row 25");
    let rows = r#"d = { reg = 6, type = "u32", length = 4 }
e = { esc = 0x100, type = "u32", length = 4 }
f = { reg = 12, type = "str(25)", length = 25, summary = { length = 25 } }
g = { reg = 40, type = "u8[3]", length = 3 }
"#;
    registers(rows, &[]);
}

#[test]
fn registers_that_reach_into_each_other() {
    let rows = r#"c = { reg = "12-13", type = "u32" }
d = { reg = 13, type = "u16" }
e = { reg = 20, type = "u16[4]" }
f = { reg = 22, type = "u16" }
h = { reg = 30, type = "u8", part = "7-0" }
i = { reg = 30, type = "u8", part = "8-1" }
"#;
    let found = registers(rows, &[("TAB043", "d"), ("TAB043", "f"), ("TAB043", "i")]);
    assert_eq!(message(&found, 0), "`d` takes holding register 13, and `c` takes 12 to 13");
    assert_eq!(message(&found, 1), "`f` takes holding register 22, and `e` takes 20 to 23");
    assert_eq!(message(&found, 2), "`i` and `h` are parts of object 0x201E:0 and share bits");
    // The other way round, and beyond one that follows.
    let rows = r#"d = { reg = 13, type = "u16" }
c = { reg = "12-13", type = "u32" }
"#;
    registers(rows, &[("TAB043", "c")]);
    let rows = r#"c = { reg = "12-13", type = "u32" }
d = { reg = 14, type = "u16" }
b = { reg = 11, type = "u16" }
"e{n}" = { reg = 40, count = 3, type = "u16[4]" }
"f{n}" = { reg = 60, count = 3, type = "str(4)" }
"g{n}" = { reg = 70, count = 2, stride = 3, type = "u32" }
h = { reg = 30, type = "u8", part = "7-0" }
i = { reg = 30, type = "u8", part = "15-8" }
"#;
    registers(rows, &[]);
}

#[test]
fn bits_and_values_of_one_name() {
    let rows = r#"j = { reg = 10, type = "u16", bits = { 0 = "x", 15 = "x", 3 = { reserved = 0 }, 4 = { reserved = 0 } } }
k = { reg = 11, type = "u16", enum = { 0 = "x", 1 = "x", 2 = { zone = "reserved" }, 3 = { zone = "reserved" } } }
l = { reg = 12, type = "u16", enum = { 0 = { name = "x", until = "6" }, 1 = { name = "x", since = "6" } } }
"#;
    let found = registers(rows, &[("TAB040", "j"), ("TAB040", "k")]);
    assert_eq!(message(&found, 0), "bit 0 and bit 15 of `j` are both called `x`");
    assert_eq!(message(&found, 1), "0 and 1 of `k` are both called `x`");
}

#[test]
fn labels_that_are_empty_and_values_without_one() {
    let rows = r#"f = { reg = 6, type = "u16", bits = { 0 = "x", 8 = "", 9 = "" } }
e = { reg = 5, type = "u16", enum = { 0 = "x", 1 = " ", 2 = { zone = "reserved" } } }
i = { reg = 9, type = "u16", writable = [1, 5], enum = { 0 = "x", 1 = "y" } }
"#;
    let found = registers(rows, &[("EDS038", "8"), ("EDS038", "9"), ("EDS038", "1"), ("TAB018", "i")]);
    assert_eq!(message(&found, 0), "bit 8 of `f` has an empty name");
    assert_eq!(message(&found, 3), "the writable value 5 has no name in `i`");
    let values = format!(
        r#"{REGISTERS}h = {{ reg = 8, type = "u16", bits = {{ "1-0" = {{ name = "f", values = {{ 0 = "a", 1 = "b", 3 = "c" }} }},
    "15-2" = {{ reserved = 0 }} }} }}
"#
    );
    let found = flags_with(&["unnamed-bits"], &values, &[("TAB036", "h")]);
    assert_eq!(message(&found, 0), "bits 1-0 (`f`) of `h` says nothing of the values 2");
    flags(&values, &[]);
    flags_with(&["unnamed-bits"], &values.replace("3 = \"c\"", "\"2..3\" = \"c\""), &[]);
}

#[test]
fn what_a_summary_may_say() {
    let rows = r#"0x6040 = { name = "C", type = "u16", access = "ro", summary = { name = "Controlword", code = "var" } }
0x60C1 = { name = "I", code = "record", summary = { code = "array", subs = 2, name = "Interpolation" } }
"0x60C1:0" = { name = "entries", type = "u8", access = "ro" }
"0x60C1:1" = { name = "data", type = "u8", access = "ro" }
0x6099 = { name = "Homing speeds", code = "record", summary = { type = "u32", pdo = "rx" } }
"0x6099:0" = { name = "n", type = "u8", access = "ro" }
"0x6099:1" = { name = "a", type = "u32", access = "rw", pdo = "rx" }
"0x6099:2" = { name = "b", type = "u16", access = "rw", pdo = "no" }
"0x1800..0x1803" = { name = "TPDO {n+1}", code = "record", summary = { subs = 5 } }
"0x1800..0x1803:0..1" = { name = "parameter {sub}", type = "u8", access = "ro" }
"#;
    let codes = ["\"Controlword\"", "\"Interpolation\"", "\"array\"", "\"u32\"", "\"rx\"", "5"];
    let mut expected: Vec<_> = codes.iter().map(|&at| ("TAB021", at)).collect();
    expected.swap(1, 2);
    let found = objects(rows, &expected);
    assert_eq!(message(&found, 0), "the summary says the name `Controlword`, and the row `C`");
    assert_eq!(message(&found, 1), "the summary says code array, and the row record");
    assert_eq!(message(&found, 3), "the summary says u32, and sub-index 2 UNSIGNED16".replace("u32", "UNSIGNED32"));
    assert_eq!(message(&found, 4), "the summary says rx, and sub-index 2 no");
    assert!(help(&found, 0).contains("doubt"));
    let rows = r#"0x6040 = { name = "Control word", orig = "Comando", type = "u16", access = "ro",
    summary = [{ name = "Controlword", code = "var" }, { name = "comando" }] }
"0x1800..0x1803" = { name = "TPDO {n+1}", code = "record", summary = { subs = 2, code = "record" } }
"0x1800..0x1803:0..1" = { name = "parameter {sub}", type = "u8", access = "ro" }
"#;
    objects(rows, &[]);
}

#[test]
fn names_and_units_of_one_value() {
    let rows = r#"a = { reg = 1, type = "u16", enum = { 0 = "off", 1 = "on", 2 = "Stand-by" }, unit = "mm", scale = 0.1 }
b = { reg = 2, type = "u16", enum = { 0 = "on", 1 = "off", 2 = "stand by" }, unit = "m", scale = 0.01, same_as = "a" }
c = { reg = 3, type = "u16", bits = { 0 = "ready", 1 = "fault" } }
d = { reg = 4, type = "u16", bits = { 0 = "ready", 1 = "error" }, same_as = "c" }
e = { reg = 5, type = "u16", bits = { 0 = "Ready", 1 = "fault" }, same_as = "c" }
f = { reg = 6, type = "u16", enum = { 0 = "off", 1 = "on", 2 = "standby" }, unit = "mm", scale = 0.1, same_as = "a" }
g = { reg = 7, type = "u16", same_as = "a" }
"#;
    let found = registers(rows, &[("TAB022", "b"), ("TAB022", "d")]);
    let differs = "differs: value 0 is `on` and `off`, and 1 more names; the units m and mm; the scales 0.01 and 0.1";
    assert!(message(&found, 0).ends_with(differs), "{}", message(&found, 0));
    assert!(message(&found, 1).ends_with("differs: bit 1 is `error` and `fault`"));
}

#[test]
fn sub_index_0_of_objects_on_any_bus() {
    let rows = r#"0x6099 = { name = "Homing speeds", code = "array" }
"0x6099:1" = { name = "a", type = "u32", access = "rw", pdo = "rx" }
0x609A = { name = "x", code = "record" }
"0x609A:0" = { name = "n", type = "u8", access = "ro", default = 3 }
"0x609A:1" = { name = "a", type = "u32", access = "rw", pdo = "rx" }
0x609B = { name = "y", code = "record" }
0x609C = { name = "ok", code = "record" }
"0x609C:0" = { name = "n", type = "u8", access = "ro", default = 1 }
"0x609C:1" = { name = "a", type = "u32", access = "rw", pdo = "rx" }
0x1C12 = { name = "RxPDO assign", code = "array" }
"0x1C12:0" = { name = "n", type = "u8", access = "rw", default = 1 }
"0x1C12:1..2" = { name = "PDO {sub}", type = "u16", access = "rw" }
"#;
    let wanted = ["no-sub0", "no-subs"];
    let expected = [("EDS058", "0x6099"), ("EDS049", "3"), ("EDS057", "0x609B")];
    for head in [DEVICE, CANOPEN, &DEVICE.replace("[device]", "[device]\nbuses = [\"ethercat\"]")] {
        let found = flags_with(&wanted, &format!("{head}[[chapters]]\n[chapters.objects]\n{rows}"), &expected);
        assert_eq!(message(&found, 2), "0x609B has no sub-indices");
        assert!(help(&found, 0).contains("sub-index") && help(&found, 2).contains("sub-index 0"));
    }
}

#[test]
fn a_limit_of_all_bits_that_reaches_into_reserved_ones() {
    let row = |max: &str, bits: &str| {
        format!("a = {{ reg = 1, type = \"u32\", min = 0, max = {max}, bits = {{ {bits} }} }}\n")
    };
    let found = registers(&row("0x7FFFFFFF", r#""31-24" = { reserved = 0 }"#), &[("TAB019", "0x7FFFFFFF")]);
    assert_eq!(message(&found, 0), "the upper limit 0x7FFFFFFF sets bits 31-24 (reserved) of `a`");
    let bits = r#"1 = { reserved = 0 }, 3 = "on", "31-24" = { reserved = 0 }"#;
    registers(&row("0xFFFFFFFF", bits), &[]);
    registers(&row("0x0000000F", bits), &[]);
    registers(&row("0x000000FF", bits), &[("TAB019", "0x000000FF")]);
    registers(&row("0x00FFFFFF", r#"3 = "on", "31-24" = { reserved = 0 }"#), &[]);
}

// What is said of a finding.

#[test]
fn rows_of_another_block_break_no_series() {
    let rows = |number: u32| {
        REGISTERS.replace("canopen = { index = 0x2000 }\n", "")
            + &format!(
                "a = {{ reg = 1, obj = 0x2001, type = \"u16\" }}\nb = {{ reg = {number}, obj = 0x3000, type = \"u16\" }}\n\
                 c = {{ reg = 4, obj = 0x2004, type = \"u16\" }}\n"
            )
    };
    flags(&rows(100), &[]);
    let found = flags(&rows(2), &[("TAB001", "0x3000")]);
    assert!(help(&found, 0).contains("misprinted"));
}

#[test]
fn what_is_wrong_with_digits_and_what_to_do() {
    let rows = r#"a = { reg = 1, type = "u16", enum = { 0x00000002 = "x", 0x01 = "y", "0x0003..0x00004" = "z" } }
b = { reg = 2, type = "u8", bits = { "1-0" = { name = "f", values = { 0x00 = "a", 0x03 = "b" } } } }
"#;
    let found = registers(rows, &[("TAB012", "0x00000002"), ("TAB012", "\"0x0003..0x00004\"")]);
    assert_eq!(message(&found, 0), "`0x00000002` has 8 digits, and UNSIGNED16 has 4");
    assert!(help(&found, 0).contains("manual"));
    let rule = "a = { reg = 11, obj = 0x200c, type = \"u16\" }\n";
    let found = registers(rule, &[("TAB001", "0x200c")]);
    assert_eq!(message(&found, 0), "the row says object 0x200C, and the rule of its space 0x200B:0");
    let axes = format!("{DEVICE}[axes]\ncount = 3\nrules = [ {{ objects = \"0x6000..0x607FF\", index = 0x800 }} ]\n");
    assert_eq!(help(&flags(&axes, &[("TAB004", "{")]), 0), "the index `0x607FF` has 5 digits, and any has 4");
    let key = "0x607FF = { name = \"x\", type = \"u16\", access = \"ro\" }\n";
    assert_eq!(help(&objects(key, &[("TAB006", "0x607FF")]), 0), "the index `0x607FF` has 5 digits, and any has 4");
}

#[test]
fn limits_of_the_other_sign_and_versions_in_another_form() {
    let rows = r#"a = { reg = 1, type = "i16", min = 0, max = 65535 }
b = { reg = 2, type = "u16", until = "6,15" }
c = { reg = 3, type = "u16", until = "Fw710" }
"#;
    let found = registers(rows, &[("EDS025", "65535"), ("TAB027", "b"), ("TAB027", "c")]);
    assert_eq!([0, 1].map(|at| help(&found, at)), ["is the type `u16`?", "write `6.15`"]);
    assert!(help(&found, 2).contains("points"));
}

#[test]
fn what_is_mentioned_of_one_value_is_told_once() {
    let rows = "0x6041 = { name = \"S\", type = \"u16\", access = \"ro\", doc = \"See 0x60D0\" }\n";
    objects(rows, &[("TAB025", "0x6041")]);
    let rows = "0x6041 = { name = \"S\", code = \"record\", doc = \"See 0x60D0\" }\n\
                \"0x6041:1\" = { name = \"a\", type = \"u16\", access = \"ro\" }\n";
    objects(rows, &[("TAB025", "0x6041")]);
}

// Items of section 4 that no linter sees, because nothing in a faithful table contradicts anything else:
//
// - 11, 15, 42, 50, 54, 55: what is wrong is the wording, or the meaning of a word, beside facts that agree (a TPDO that is
//   "received"; two sentences on bits 29 and 30; two names of one bit's values; a filter named Rposalmtime and Rflwtim, both of
//   which exist; texts of EMCY codes that CiA has the other way round; active-low names of bits).
// - 16, in part: "write the value" of a PDO that is read, and rw beside a mapping that is read, are both possible.
// - 25, 26, 53 in part: columns, rules and quotation marks of the printed table. The import of CSV looks at them (R14); a table
//   of this format has no columns.
// - 30: nothing tells that a sub-index is missing; the space's rule has one.
// - 39, in part: 0xFD is a value of UNSIGNED8; that CiA 402 has INTEGER8 there is told by the profile.
// - 40, in part: `[0..8]` beside `[23..16]` are words in one cell, of which a table has the bits only.
// - 43, in part: sources called otherwise in two chapters, and edges called positive under the name of the negative one.
// - 45: covered where the prose is a `summary`. 46, in part: SAVE on versions and on a start command, RO on limits of a
//   generator: each is possible by itself.
// - 56: read/write with 0 as the only value is what `writable` says. 58, 59: what is missing, and what a screenshot shows.
// - 4.4, 4.5: lost figures and headings; what the manual leaves open is an option of the device, and where it states no
//   access at all, TAB010 says so.

#[test]
fn a_window_whose_value_is_no_integer() {
    let rows = |value: &str| {
        format!(
            "lexibus = 1\n[device]\nname = \"D\"\nbuses = [\"modbus\"]\n[spaces.a]\nmodbus = {{ table = \"holding\" }}\n\
             [spaces.b]\nindirect = {{ write_address = \"Number\", read = \"{value}\" }}\n\
             [[chapters]]\ntitle = \"Windows\"\nspace = \"a\"\n[chapters.registers]\n\
             Number = {{ reg = 1, type = \"u16\", access = \"rw\" }}\nValue = {{ reg = \"2-3\", type = \"f32\", access = \"rw\" }}\n\
             [[chapters]]\ntitle = \"Behind\"\nspace = \"b\"\n[chapters.registers]\nGain = {{ reg = 1, type = \"u16\", access = \"ro\" }}\n"
        )
    };
    // By its name, and by chapter and name.
    for value in ["Value", "Windows/Value"] {
        flags(&rows(value), &[("TAB004", "\"f32\"")]);
    }
}
