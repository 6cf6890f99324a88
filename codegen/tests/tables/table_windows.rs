//! Tests register tables with several windows per address space, and values that are extended to the size of their registers.
//! Also tests PDOs and codes that exist only on some buses, and numbers that are split into several items.

use crate::form_support;

use form_support::canonical;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Binding, Item, ObjectBuses};
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

const HEAD: &str = "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"canopen\", \"ethercat\", \"modbus\"]\n";

fn read(text: &str) -> Compilation {
    check(Source::new("t.toml", format!("{HEAD}{text}").into_bytes()), &Options::default())
}

/// Returns the codes and messages of the diagnostics that the tests in this file check.
fn reported(text: &str) -> Vec<String> {
    let compilation = read(text);
    let is_checked =
        |code: &str| ["TAB004", "TAB005", "TAB006", "TAB007", "TAB048", "TAB049", "ESI042"].contains(&code);
    let list = compilation.diagnostics.list().iter().filter(|found| is_checked(found.code.id));
    list.map(|found| format!("{} {}", found.code.id, found.message)).collect()
}

fn rust(text: &str) -> String {
    read(text).rust(&RustOptions::default()).expect("Rust")
}

fn item<'c>(compilation: &'c Compilation, name: &str) -> &'c Item {
    let device = &compilation.catalog.as_ref().expect("a catalog").devices[0];
    device.groups.iter().flat_map(|group| &group.items).find(|item| item.name == name).expect("an item")
}

const WINDOWS: &str = r#"[spaces.register]
bits = 32
extend = true
modbus = { table = "holding", add = 0x8000 }
indirect = [
    { write_address = "read number", add = 0x8000, read = "read value" },
    { write_address = "write number", add = 0x8000, write = "write value" },
]
[[chapters]]
title = "Windows"
[chapters.objects]
0x2005 = { name = "read window", code = "record" }
"0x2005:0" = { name = "highest sub-index", type = "u8", access = "const" }
"0x2005:1" = { name = "read number", type = "u16", access = "rw" }
"0x2005:2" = { name = "read value", type = "u32", access = "ro" }
0x2006 = { name = "write window", code = "record" }
"0x2006:0" = { name = "last sub-index", type = "u8", access = "const" }
"0x2006:1" = { name = "write number", type = "u16", access = "rw" }
"0x2006:2" = { name = "write value", type = "u32", access = "rw" }
[[chapters]]
title = "Registers"
space = "register"
[chapters.registers]
"#;

#[test]
fn a_row_has_all_windows_of_its_space() {
    let text = format!("{WINDOWS}level = {{ reg = 7, type = \"i8\", access = \"rw\" }}\n");
    assert_eq!(reported(&text), [""; 0]);
    let compilation = read(&text);
    let windows: Vec<_> = item(&compilation, "level")
        .bindings
        .iter()
        .filter_map(|binding| match binding {
            Binding::Indirect(window) => Some((window.read.is_some(), window.write.is_some(), window.number)),
            _ => None,
        })
        .collect();
    assert_eq!(windows, [(true, false, 0x8007), (false, true, 0x8007)]);
}

#[test]
fn short_values_fill_their_registers() {
    let rows = "level = { reg = 7, type = \"i8\", access = \"rw\" }\nspeed = { reg = 8, type = \"u16\", access = \"rw\" }\n\
                flags = { reg = 9, type = \"u8\", access = \"rw\", part = \"7-0\" }\nsum = { reg = 10, type = \"i64\", access = \"ro\" }\n";
    let text = rust(&format!("{WINDOWS}{rows}"));
    for part in [
        "rt::Register::high_first(32775, 2).sign_extended().words_per_address(2)",
        "rt::Register::high_first(32776, 2).words_per_address(2)",
        "rt::Register::holding(32777).part(0, 8).words_per_address(2)",
        "rt::Register::high_first(32778, 4).words_per_address(2)",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let plain = rust(&format!("{WINDOWS}{rows}").replace("extend = true\n", ""));
    assert!(plain.contains("rt::Register::holding(32775).words_per_address(2)") && !plain.contains("sign_extended"));
    let found = reported("[spaces.far]\nextend = true\ncanopen = { index = 0x2000 }\n");
    assert_eq!(found, ["TAB004 `extend` applies to Modbus registers, which the space does not have"]);
}

#[test]
fn another_name_shares_the_address() {
    let rows = "save = { reg = 1, type = \"u32\", access = \"wo\" }\nsave_low = { reg = 1, type = \"u16\", access = \"wo\"SAME }\n";
    let text = format!("{WINDOWS}{rows}");
    assert_eq!(reported(&text.replace("SAME", ", same_as = \"save\"")), [""; 0]);
    assert!(reported(&text.replace("SAME", ""))[0].starts_with("TAB007 holding register 32769 occurs twice"));
    assert!(reported(&text.replace("SAME", ", same_as = \"write value\""))[0].starts_with("TAB007"));
}

const PDOS: &str = r#"[[chapters]]
[chapters.objects]
0x2010 = { name = "lamp", type = "u8", access = "rw", pdo = "rx" }
0x1400 = { name = "RPDO 1 parameter", code = "record" }
"0x1400:0" = { name = "highest", type = "u8", access = "const", default = 2 }
"0x1400:1" = { name = "COB-ID", type = "u32", access = "rw", default = "$NODEID+0x200" }
0x1600 = { name = "RPDO 1 mapping", code = "record" }
"0x1600:0" = { name = "number", type = "u8", access = "rw" }
"0x1600:1" = { name = "entry", type = "u32", access = "rw" }
[[pdos]]
index = 0x1600
name = "Lamp"
direction = "rx"
buses = ["ethercat"]
entries = ["lamp", "pad/8"]
"#;

#[test]
fn pdos_of_one_bus_beside_those_of_another() {
    assert_eq!(reported(PDOS), [""; 0]);
    let compilation = read(PDOS);
    let pdos = &compilation.catalog.as_ref().expect("a catalog").devices[0].process_data.pdos;
    let entries: Vec<_> = pdos.iter().map(|pdo| (pdo.buses, pdo.entries.len())).collect();
    assert_eq!(entries, [(Some(ObjectBuses::COE), 2), (Some(ObjectBuses::CANOPEN), 0)]);
    let text = rust(PDOS);
    assert!(text.contains("pub struct Lamp {") && text.contains("pub enum RxPdo1 {}"), "{text}");
    let both = PDOS.replace("buses = [\"ethercat\"]\n", "");
    assert!(reported(&both)[0].starts_with("ESI042"));
    let neither = PDOS.replace("buses = [\"ethercat\"]\nentries", "buses = [\"modbus\"]\nentries");
    assert_eq!(reported(&neither)[0], "TAB004 the PDO is on neither CANopen nor EtherCAT");
}

#[test]
fn codes_of_one_bus() {
    let text =
        "[codes.alarms]\ndoc = \"What is wrong\"\nbuses = [\"ethercat\"]\n[codes.alarms.rows]\n7 = \"motor blocked\"\n";
    assert_eq!(reported(text), [""; 0]);
    let code = rust(&format!("{WINDOWS}a = {{ reg = 1, type = \"u32\", access = \"ro\" }}\n{text}"));
    assert!(code.contains("/// What is wrong.\n    ///\n    /// These codes occur on EtherCAT."), "{code}");
    assert!(reported(&text.replace("ethercat", "ethercatt"))[0].starts_with("TAB004"));
}

const COMPOSITE: &str = r#"high = { reg = 1, type = "u16", access = "rw" }
low = { reg = 2, type = "u16", access = "rw" }
sign = { reg = 3, type = "u16", access = "rw" }
[composites]
offset = { parts = ["high", "low"], base = 100, sign = "sign", negative = 2, unit = "pulse", doc = "From the marker" }
device = { parts = ["high", "low"], base = 16 }
"#;

#[test]
fn numbers_in_several_items() {
    let text = format!("{WINDOWS}{COMPOSITE}");
    assert_eq!(reported(&text), [""; 0]);
    let code = rust(&text);
    for part in [
        "/// offset: a number in base 100, with its digits in [high](objects::HIGH), [low](objects::LOW). [sign](objects::SIGN) is 2 if the number is negative. Unit: pulse. From the marker.",
        "pub const OFFSET: rt::Composite<2> = rt::Composite::signed(100, 2);",
        "rt::Composite<2> = rt::Composite::new(16);",
    ] {
        assert!(code.contains(part), "{part}\n{code}");
    }
    assert!(!code.contains("pub const DEVICE: rt::Composite"));
    for (old, new, found) in [
        (
            "parts = [\"high\", \"low\"], base = 100",
            "parts = [\"high\"], base = 100",
            "TAB004 `parts` needs at least two items",
        ),
        ("base = 100", "base = 1", "TAB004 `base`, the ratio of a part"),
        (", negative = 2", "", "TAB004 `negative`, the value of `sign`"),
        ("sign = \"sign\", ", "", "TAB004 the composite has `negative`, but no `sign`"),
        ("\"low\"], base = 100", "\"lower\"], base = 100", "TAB005"),
    ] {
        let list = reported(&text.replacen(old, new, 1));
        assert!(list.first().is_some_and(|entry| entry.starts_with(found)), "{found}: {list:?}");
    }
}

/// Generated constants with long names must have the line breaks of `prettyplease`.
#[test]
fn constants_keep_the_form_of_generated_code() {
    let long = "offset of the second axis from the marker of the first one";
    let text = format!("{WINDOWS}{COMPOSITE}\"{long}\" = {{ parts = [\"high\", \"low\"], base = 50000, sign = \"sign\", negative = 40000 }}\n");
    assert_eq!(canonical("windows", &rust(&text)), Ok(()));
}
