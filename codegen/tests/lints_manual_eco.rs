//! Section 4 of the notes on the Eco's manual: passages that contradict themselves or the drive, transcribed as they are printed,
//! have their finding at their row. The name of a test has the notes' number; the last test holds all of them against the doubts.

mod eco_support;
#[path = "table_support/heads.rs"]
mod heads;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use eco_support::{device, items, notes, table};
use heads::message;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::ir::Doubt;
use lexibus_codegen::source::Source;

const HEAD: &str = r#"lexibus = 1
[device]
name = "Eco"
buses = ["canopen", "ethercat", "modbus", "profinet"]
[spaces.register]
bits = 32
extend = true
modbus = { table = "holding", add = 0x8000 }
"#;

const REGISTERS: &str = "[[chapters]]\ntitle = \"Registers\"\nspace = \"register\"\n[chapters.registers]\n";
const OBJECTS: &str = "[[chapters]]\ntitle = \"Objects\"\n[chapters.objects]\n";

fn compile(text: &str) -> Compilation {
    let mut options = Options { no_profiles: true, ..Options::default() };
    // A passage is no whole device.
    for code in ["missing-mandatory-object", "half-a-pdo"] {
        options.levels.set(code, Level::Allow).expect("a code");
    }
    check(Source::new("table.toml", text.as_bytes().to_vec()), &options)
}

/// The findings of a passage below the head: codes and lines, counted from its first row.
#[track_caller]
fn flags(passage: &str, expected: &[(&str, u32)]) -> Compilation {
    let found = compile(&format!("{HEAD}{passage}"));
    let above = HEAD.lines().count() as u32;
    let place = |own: &lexibus_codegen::diagnostics::Diagnostic| {
        (own.code.id, found.sources[0].position(own.span.start).line.saturating_sub(above))
    };
    let shown: Vec<_> = found.diagnostics.list().iter().map(place).collect();
    let said: Vec<_> = found.diagnostics.list().iter().map(|own| &own.message).collect();
    assert_eq!(shown, expected, "\n{said:#?}");
    found
}

#[track_caller]
fn registers(rows: &str, expected: &[(&str, u32)]) -> Compilation {
    let above = REGISTERS.lines().count() as u32;
    let expected: Vec<_> = expected.iter().map(|&(code, line)| (code, line + above)).collect();
    flags(&format!("{REGISTERS}{rows}"), &expected)
}

#[track_caller]
fn objects(rows: &str, expected: &[(&str, u32)]) -> Compilation {
    let above = OBJECTS.lines().count() as u32;
    let expected: Vec<_> = expected.iter().map(|&(code, line)| (code, line + above)).collect();
    flags(&format!("{OBJECTS}{rows}"), &expected)
}

#[test]
fn a3_a_limit_without_its_zero() {
    // L170.
    let rows =
        "position_actual_value = { reg = 6, type = \"i32\", access = \"ro\", min = 0x80000000, max = \"X7fffffff\" }\n";
    registers(rows, &[("TAB004", 1)]);
}

#[test]
fn a4_a_limit_of_nine_digits() {
    // L378.
    let rows = "aux_in_13 = { reg = 51, type = \"i32\", access = \"rw\", min = 0x80000000, max = 0x7FFFFFFFF }\n";
    registers(rows, &[("TAB012", 1), ("EDS025", 1)]);
}

#[test]
fn a8_a_range_of_indices_that_ends_before_it_begins() {
    // L3269: 0020 – 003.
    objects(
        "\"0x0020..0x003\" = { name = \"Complex data types\", type = \"u32\", access = \"ro\" }\n",
        &[("TAB006", 1)],
    );
}

#[test]
fn b2_registers_of_two_words_at_every_address() {
    // L896-899 with L39 and L72: without `bits = 32`, R00 reaches into R01.
    let text = HEAD.replace("bits = 32\nextend = true\n", "");
    let rows =
        "R00 = { reg = 0, type = \"u32\", access = \"rw\" }\nR01 = { reg = 1, type = \"i32\", access = \"rw\" }\n";
    let found = compile(&format!("{text}{REGISTERS}{rows}"));
    let codes: Vec<_> = found.diagnostics.list().iter().map(|own| own.code.id).collect();
    assert_eq!(codes, ["TAB043"]);
}

#[test]
fn c2_one_parameter_in_two_cases() {
    // L511 and L623.
    let rows =
        "c7 = { reg = 20, type = \"u16\", access = \"rw\" }\nC7 = { reg = 21, type = \"u16\", access = \"rw\" }\n";
    registers(rows, &[("TAB040", 2)]);
}

#[test]
fn c3_parameters_without_an_address() {
    // L501, L533.
    registers(
        "F4 = { type = \"u16\", access = \"rw\" }\nO4 = { type = \"u16\", access = \"rw\" }\n",
        &[("TAB008", 1), ("TAB008", 2)],
    );
}

#[test]
fn c5_lengths_of_register_and_object() {
    // L299-302 and L3887.
    let rows = r#"aux_in_3 = { reg = 34, obj = 0x3401, type = "i32", access = "rw", min = 0x80000000, max = 0x7FFFFFFF, summary = { access = "rw", length = 2, cite = 3887 } }
"#;
    registers(rows, &[("TAB021", 1)]);
}

#[test]
fn c7_measured_and_saved() {
    // L461.
    let rows = "velocity_rpm = { reg = 73, type = \"i32\", access = \"ro\", save = \"save\" }\n";
    registers(rows, &[("TAB024", 1)]);
}

#[test]
fn c8_c9_names_of_register_and_object() {
    // L304 and L3888; L129 and L3782 differ by one letter.
    let rows = r#"torque_max = { reg = 35, obj = 0x3402, type = "i16", access = "rw", orig = "Torque max", summary = { name = "Aux16 In 4", cite = 3888 } }
following_error_windows = { reg = 3, obj = 0x6065, type = "u32", access = "rw", summary = { name = "Following Error Window", cite = 3782 } }
"#;
    registers(rows, &[("TAB021", 1), ("TAB021", 2)]);
}

#[test]
fn c10_one_index_for_three_inputs() {
    // L3394, L3397, L3403.
    let rows = r#"aux16_in_9 = { reg = 42, obj = 0x3701, type = "i16", access = "rw" }
aux16_in_10 = { reg = 43, obj = 0x3701, type = "i16", access = "rw" }
aux16_in_11 = { reg = 44, obj = 0x3701, type = "i16", access = "rw" }
"#;
    registers(rows, &[("TAB007", 2), ("TAB007", 3)]);
}

#[test]
fn k2_a_range_of_registers_with_another_length() {
    // L452-459, if one of the two numbers were wrong.
    registers("\"R{n+66}\" = { reg = \"66-72\", count = 6, type = \"i32\", access = \"rw\" }\n", &[("TAB009", 1)]);
}

#[test]
fn d1_two_objects_of_one_title() {
    // L3606 and L3620.
    let rows = r#"0x1600 = { name = "Receive PDO 2 Mapping Parameter", code = "array" }
"0x1600:0" = { name = "Number of Entries", type = "u8", access = "rw" }
0x1601 = { name = "Receive PDO 2 Mapping Parameter", code = "array" }
"0x1601:0" = { name = "Number of Entries", type = "u8", access = "rw" }
"#;
    objects(rows, &[("TAB040", 3)]);
}

#[test]
fn d2_an_access_that_is_none() {
    // L3444.
    objects("0x6065 = { name = \"Following Error Window\", type = \"u32\", access = \"wr\" }\n", &[("TAB004", 1)]);
}

#[test]
fn d4_a_window_of_eight_bits_for_parameters_of_sixteen() {
    // L3848-3853 and L18-20.
    let passage = r#"[spaces.parameter]
modbus = { table = "holding" }
indirect = [
    { write_address = "Parameter Read Address", read = "Parameter Read Value" },
    { write_address = "Parameter Write Address", write = "Parameter Write Value", procedure = "write_parameter" },
]
[[chapters]]
title = "Window"
[chapters.objects]
0x2000 = { name = "Drive Parameters Settings", code = "record" }
"0x2000:0" = { name = "Number Of Entries", type = "u8", access = "ro" }
"0x2000:1" = { name = "Parameter Write Address", type = "u8", access = "rw" }
"0x2000:2" = { name = "Parameter Write Value", type = "u8", access = "wo" }
"0x2000:3" = { name = "Parameter Read Address", type = "u8", access = "rw" }
"0x2000:4" = { name = "Parameter Read Value", type = "u8", access = "ro" }
[procedures.write_parameter]
arguments = ["address", "value"]
steps = [{ write = "Parameter Write Value", argument = "value" }, { write = "Parameter Write Address", argument = "address" }]
[[chapters]]
title = "Parameters"
space = "parameter"
[chapters.registers]
d1 = { reg = 1, type = "u16", access = "rw" }
d2 = { reg = 2, type = "u16", access = "rw" }
"#;
    let found = flags(passage, &[("TAB048", 23), ("TAB048", 23)]);
    assert_eq!(message(&found, 0), "`d1` has 16 bits, and is read through `Parameter Read Value`, which has 8");
    assert_eq!(message(&found, 1), "`d1` has 16 bits, and is written through `Parameter Write Value`, which has 8");
    let eight = passage.replace("reg = 1, type = \"u16\"", "reg = 1, type = \"u8\"");
    flags(&eight.replace("reg = 2, type = \"u16\"", "reg = 2, type = \"u8\""), &[]);
}

/// The write window of EtherCAT (L5728-5737): address, value, and a wait.
const WRITE_WINDOW: &str = r#"[[chapters]]
title = "Window"
[chapters.objects]
0x2006 = { name = "Drive Variable Write", code = "record" }
"0x2006:0" = { name = "Number Of Entries", type = "u8", access = "ro" }
"0x2006:1" = { name = "Variable Write Address", type = "u16", access = "rw", clears = true }
"0x2006:2" = { name = "Variable Write Value", type = "u32", access = "rw" }
[spaces.parameter]
indirect = { write_address = "Variable Write Address", write = "Variable Write Value", procedure = "write" }
[procedures.write]
arguments = ["address", "value"]
steps = [
    { write = "Variable Write Address", argument = "address" },
    { write = "Variable Write Value", argument = "value" },
    { delay = 3 },
]
[[chapters]]
title = "Parameters"
space = "parameter"
[chapters.registers]
d1 = { reg = 1, type = "u16", access = "rw" }
"#;

#[test]
fn e4_the_address_before_the_value() {
    let found = flags(WRITE_WINDOW, &[("TAB049", 14)]);
    let expected =
        "`write` writes the number to `Variable Write Address` before the value to `Variable Write Value`, and the \
                    device begins with the number";
    assert_eq!(message(&found, 0), expected);
    // A device that doesn't clear the number looks at both after a while.
    flags(&WRITE_WINDOW.replace(", clears = true", ""), &[]);
    let rule = "write = \"Variable Write Value\", procedure = \"write\"";
    let first = "write = { value = \"Variable Write Value\", first = \"address\" }";
    let found = flags(&WRITE_WINDOW.replace(rule, first), &[("TAB049", 6)]);
    assert!(message(&found, 0).starts_with("the number is written to `Variable Write Address` before the value"));
    let swapped = WRITE_WINDOW.replace("Variable Write Address\", argument", "X\", argument");
    let swapped =
        swapped.replace("Variable Write Value\", argument = \"value", "Variable Write Address\", argument = \"address");
    flags(&swapped.replace("X\", argument = \"address", "Variable Write Value\", argument = \"value"), &[]);
}

#[test]
fn e4_whatever_the_space_says() {
    // The space waits for no clearing; that the number is cleared, its row says.
    let waits = WRITE_WINDOW.replace("procedure = \"write\" }", "procedure = \"write\", clears = false }");
    flags(&waits, &[("TAB049", 14)]);
}

#[test]
fn d7_an_entry_of_a_mapping_twice() {
    // L4441-4443 and L4533-4535.
    let passage = r#"[[chapters]]
title = "Mapping"
[chapters.objects]
0x6041 = { name = "Statusword", type = "u16", access = "ro", pdo = "tx" }
0x6064 = { name = "Position Actual Value", type = "i32", access = "ro", pdo = "tx" }
0x1A00 = { name = "Mapping", code = "record" }
"0x1A00:0" = { name = "Count", type = "u8", access = "rw" }
"0x1A00:1" = { name = "First", type = "u32", access = "rw" }
"0x1A00:2" = { name = "Second", type = "u32", access = "rw" }
[procedures.map]
steps = [
    { write = "0x1A00:0", value = 0 },
    { write = "0x1A00:1", value = 0x60640020 },
    { write = "0x1A00:1", value = 0x60410010 },
    { write = "0x1A00:0", value = 2 },
]
"#;
    let found = flags(passage, &[("TAB033", 14), ("TAB033", 15)]);
    assert_eq!(message(&found, 0), "`map`: writes entry 1 of 0x1A00 a second time");
    assert_eq!(message(&found, 1), "`map`: writes 2 as the number of entries of 0x1A00, and wrote 1 of them");
    flags(&passage.replace("0x1A00:1\", value = 0x60410010", "0x1A00:2\", value = 0x60410010"), &[]);
}

#[test]
fn b4_and_b5_a_frame_of_another_read() {
    // L1210 and L1243: the start and quantity of L1123, and half of the reply.
    let rows =
        "R00 = { reg = 0, type = \"u32\", access = \"ro\" }\nR01 = { reg = 1, type = \"i32\", access = \"ro\" }\n";
    let frames =
        |request: &str, reply: &str| format!("{REGISTERS}{rows}[[frames]]\nrequest = [{request}]\nreply = [{reply}]\n");
    let found = flags(&frames("5, 3, 0, 1, 0, 3", "5, 3, 4, 0x11, 0x22, 0x33, 0x44"), &[("TAB044", 8), ("TAB044", 9)]);
    assert_eq!(message(&found, 0), "the request begins with the address 0x0001, which no row has");
    assert_eq!(message(&found, 1), "the reply has 4 bytes for 3 registers, which are 6");
    let found = flags(&frames("5, 3, 0x80, 0, 0, 4", "5, 3, 4, 0x11, 0x22, 0x33, 0x44"), &[("TAB044", 9)]);
    assert_eq!(message(&found, 0), "the reply has 4 bytes for 4 registers, which are 8");
    flags(&frames("5, 3, 0x80, 0, 0, 3", ""), &[("TAB044", 8)]);
    flags(&frames("5, 3, 0x80, 0, 0, 4", "5, 3, 8, 0, 0, 0, 1, 0, 0, 0, 2"), &[]);
    // One word of a register, an exception, a write of two words, and a CRC.
    flags(&frames("5, 3, 0x80, 1, 0, 1", "5, 3, 2, 0, 7"), &[]);
    flags(&frames("5, 3, 0x80, 1, 0, 1", "5, 0x83, 2"), &[]);
    flags(&frames("5, 16, 0x80, 1, 0, 2, 4, 0, 0, 0, 7", "5, 16, 0x80, 1, 0, 2"), &[]);
    let found = flags(&frames("5, 3, 0x80, 1, 0, 1, 0, 0", "6, 3, 2, 0, 7"), &[("TAB044", 8), ("TAB044", 9)]);
    assert_eq!(message(&found, 1), "the reply is of node 6, and 5 was asked");
}

#[test]
fn e4_in_an_image_both_go_together() {
    let passage = r#"[spaces.parameter]
indirect = { write_address = "Variable Write Address", write = "Variable Write Value", procedure = "write" }
[[images]]
name = "from the master"
direction = "rx"
bytes = 8
[images.fields]
"Variable Write Address" = { at = 0, type = "u16" }
"Variable Write Value" = { at = 4, type = "u32" }
[procedures.write]
arguments = ["address", "value"]
steps = [{ write = "Variable Write Address", argument = "address" }, { write = "Variable Write Value", argument = "value" }, { exchange = "rx" }]
[[chapters]]
title = "Parameters"
space = "parameter"
[chapters.registers]
d1 = { reg = 1, type = "u16", access = "rw" }
"#;
    flags(passage, &[]);
}

#[test]
fn d15_objects_of_the_introduction() {
    // L2815, L3105: a text mentions what no table has.
    objects("0x1017 = { name = \"Producer Heartbeat Time\", type = \"u16\", access = \"rw\", doc = \"Consumers have object 0x1016\" }\n", &[("TAB025", 1)]);
}

#[test]
fn e3_a_mode_of_two_bytes_in_a_pdo() {
    // L5547 and L3779.
    let rows = r#"0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx" }
0x6060 = { name = "Modes Of Operation", type = "i8", access = "wo", pdo = "rx" }
[[pdos]]
index = 0x1601
direction = "rx"
buses = ["ethercat"]
entries = ["0x6040:0/16", "0x6060:0/16"]
"#;
    objects(rows, &[("PDO005", 7)]);
}

#[test]
fn b12_pdos_of_one_index_on_one_bus() {
    // The CoE PDOs have the indices of CANopen's, which is told apart by `buses` only.
    let rows = r#"0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx" }
[[pdos]]
index = 0x1600
direction = "rx"
buses = ["ethercat"]
entries = ["0x6040:0/16"]
[[pdos]]
index = 0x1600
direction = "rx"
buses = ["BUS"]
entries = ["0x6040:0/16"]
"#;
    objects(&rows.replace("BUS", "ethercat"), &[("ESI042", 7)]);
    objects(&rows.replace("BUS", "canopen"), &[]);
}

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
