//! Tests the comparison of two versions of a description, including the effects of each change.

mod complete;
mod leaves;
#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../../tests/support/root.rs"]
mod root;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_site::compare::{compare, Change, Effect};

fn read(name: &str, text: &str) -> Catalog {
    let compilation =
        check(Source::new(name, text.as_bytes().to_vec()), &Options { no_profiles: true, ..Options::default() });
    let reports: Vec<String> =
        compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect();
    assert!(compilation.is_usable(), "{reports:#?}");
    compilation.catalog.expect("a device")
}

const TABLE: &str = r#"lexibus = 1
[device]
name = "Pump"
buses = ["modbus", "serial"]
[spaces.register]
modbus = { table = "holding" }
[[chapters]]
title = "Control"
[chapters.registers]
speed = { reg = 1, type = "u16", access = "rw", unit = "rpm", min = 0, max = 3000, default = 100 }
mode = { reg = 2, type = "u16", access = "rw", enum = { 0 = "off", 1 = "on" } }
flags = { reg = 3, type = "u16", access = "ro", bits = { 0 = "ready", 3 = "fault" } }
gain = { reg = 4, type = "i16", access = "rw", scale = 0.1, unit = "A" }
level = { reg = 5, type = "u16", access = "ro" }
[codes.alarm.rows]
1 = "too hot"
[[messages]]
name = "Go"
request = [{ bytes = [1] }, { field = "target", type = "i16" }]
"#;

/// Returns the changes between [`TABLE`] and a copy with the replaced texts.
fn changes(replaced: &[(&str, &str)]) -> Vec<String> {
    let new = replaced.iter().fold(TABLE.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    });
    compare(&read("old.toml", TABLE), &read("new.toml", &new)).iter().map(Change::to_string).collect()
}

#[test]
fn nothing_changed() {
    assert_eq!(changes(&[]), [""; 0]);
    assert_eq!(
        changes(&[("name = \"Pump\"", "name = \"Pump\"\ndoc = \"Pumps\"")]),
        ["no effect: the device: description, Pumps"]
    );
}

#[test]
fn changes_of_a_value_that_affect_rust_code() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(
        one(
            "bits = { 0 = \"ready\", 3 = \"fault\" }",
            "bits = { 0 = { name = \"ready\", inverted = true }, 3 = \"fault\" }"
        ),
        "breaks wire: register 3 flags, bit 0: meaning a flag, now an inverted flag"
    );
    assert_eq!(
        one("scale = 0.1, unit", "scale = 0.1, na = { 0x7FFF = \"open\" }, unit"),
        "breaks api, behavior: register 4 gain: special value, 32767\n\
         no effect: register 4 gain: meaning of special values, open"
    );
    // Remove Modbus from a register that is also on CANopen.
    let object = |buses: &str| TABLE.replace("buses = [\"modbus\", \"serial\"]", buses);
    let both = "buses = [\"canopen\", \"modbus\", \"serial\"]";
    let on_both = object(both).replace("modbus = { table", "canopen = { index = 0x2000, sub = 0 }\nmodbus = { table");
    let only =
        on_both.replace("modbus = { table = \"holding\" }\n", "").replace(both, "buses = [\"canopen\", \"serial\"]");
    let changes = compare(&read("old.toml", &on_both), &read("new.toml", &only));
    let speed = changes.iter().map(Change::to_string).find(|line| line.contains("speed: buses"));
    assert_eq!(speed.as_deref(), Some("breaks api, wire: 0x2001:00 speed: buses CANopen, Modbus, now CANopen"));
    let twice = TABLE
        .replace("level =", "percent = { reg = 5, type = \"u16\", access = \"ro\", same_as = \"level\" }\nlevel =");
    let changes = compare(
        &read("old.toml", &twice),
        &read("new.toml", &twice.replace("same_as = \"level\"", "same_as = \"level\", unit = \"%\"")),
    );
    let lines: Vec<String> = changes.iter().map(Change::to_string).collect();
    assert_eq!(lines, ["compatible: register 5 percent: unit, %"]);
}

#[test]
fn the_padding_of_a_pdo_is_a_part_of_its_length() {
    let esi = |bits: u32| {
        format!(
            "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device><Type ProductCode=\"1\">T</Type><Name>D</Name>\
             <Sm>MBoxOut</Sm><Sm>MBoxIn</Sm><Sm>Outputs</Sm><TxPdo Sm=\"2\"><Index>#x1A00</Index><Name>P</Name>\
             <Entry><Index>#x6000</Index><SubIndex>1</SubIndex><BitLen>8</BitLen><Name>V</Name><DataType>USINT</DataType></Entry>\
             <Entry><Index>0</Index><BitLen>{bits}</BitLen></Entry></TxPdo></Device></Devices></Descriptions></EtherCATInfo>"
        )
    };
    let changes = compare(&read("old.xml", &esi(8)), &read("new.xml", &esi(16)));
    let lines: Vec<String> = changes.iter().map(Change::to_string).collect();
    assert_eq!(lines, ["breaks wire: TxPDO 0x1A00 P: length 16 bits, now 24 bits"]);
}

#[test]
fn facts_of_values() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(one("max = 3000", "max = 2000"), "breaks behavior: register 1 speed: range 0 … 3000, now 0 … 2000");
    assert_eq!(one("max = 3000", "max = 4000"), "compatible: register 1 speed: range 0 … 3000, now 0 … 4000");
    assert_eq!(one("default = 100", "default = 0"), "breaks behavior: register 1 speed: default 100, now 0");
    assert_eq!(one("unit = \"rpm\"", "unit = \"Hz\""), "breaks api, behavior: register 1 speed: unit rpm, now Hz");
    assert_eq!(
        one("scale = 0.1", "scale = 0.01"),
        "breaks api, behavior: register 4 gain: scale 1 LSB = 0.1 A, now 1 LSB = 0.01 A"
    );
    assert_eq!(
        one("gain = { reg = 4, type = \"i16\"", "gain = { reg = 4, type = \"u16\""),
        "breaks api: register 4 gain: type INTEGER16, now UNSIGNED16"
    );
    assert_eq!(
        one("speed = { reg = 1, type = \"u16\", access = \"rw\"", "speed = { reg = 1, type = \"u16\", access = \"ro\""),
        "breaks api: register 1 speed: access rw, now ro"
    );
    assert_eq!(
        one("level = { reg = 5, type = \"u16\", access = \"ro\"", "level = { reg = 5, type = \"u16\", access = \"rw\""),
        "compatible: register 5 level: access ro, now rw"
    );
}

#[test]
fn names_and_addresses() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(one("level = {", "height = {"), "breaks api: register 5 height: name level, now height");
    assert_eq!(one("level = {", "Level = {"), "no effect: register 5 Level: name level, now Level");
    assert_eq!(
        one("level = { reg = 5", "level = { reg = 9"),
        "breaks wire: register 9 level: address register 5, now register 9"
    );
    assert_eq!(
        one("level = { reg = 5, type = \"u16\", access = \"ro\" }\n", ""),
        "breaks api, wire: register 5 level: removed"
    );
    let more =
        "level = { reg = 5, type = \"u16\", access = \"ro\" }\nmore = { reg = 6, type = \"u16\", access = \"ro\" }";
    assert_eq!(one("level = { reg = 5, type = \"u16\", access = \"ro\" }", more), "compatible: register 6 more: added");
}

#[test]
fn bits_values_codes_and_messages() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(one("1 = \"on\" }", "1 = \"on\", 2 = \"auto\" }"), "breaks api: register 2 mode, value 2: added, auto");
    assert_eq!(one("1 = \"on\" }", "1 = \"running\" }"), "breaks api: register 2 mode, value 1: name on, now running");
    assert_eq!(one("3 = \"fault\"", "3 = \"fault\", 4 = \"hot\""), "compatible: register 3 flags, bit 4: added, hot");
    assert_eq!(one(", 3 = \"fault\"", ""), "breaks api: register 3 flags, bit 3: removed, was fault");
    assert_eq!(
        one("1 = \"too hot\"", "1 = \"too hot\"\n2 = \"too cold\""),
        "breaks api: codes alarm, code 2 too cold: added"
    );
    assert_eq!(
        one("type = \"i16\" }]", "type = \"i32\" }]"),
        "breaks api, wire: message Go, request target: type INTEGER16, now INTEGER32"
    );
    assert_eq!(
        one("name = \"Go\"", "name = \"Run\""),
        "breaks api, wire: message Go: removed\ncompatible: message Run: added"
    );
}

/// Returns the changes between a test file and a copy with the replaced texts.
fn changes_of(path: &str, replaced: &[(&str, &str)]) -> Vec<String> {
    let path = root::root().join("tests/data").join(path);
    let old = std::fs::read_to_string(&path).expect("a description");
    let new = replaced.iter().fold(old.clone(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    });
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    compare(&read(&name, &old), &read(&name, &new)).iter().map(Change::to_string).collect()
}

#[test]
fn modules_of_a_coupler() {
    let one = |old: &str, new: &str| changes_of("coupler.esi.xml", &[(old, new)]).join("\n");
    assert_eq!(
        one("<Name>Input 3</Name>", "<Name>Level switch</Name>"),
        "breaks api: module 16 digital inputs: 0x6000:03 Level switch: name Input 3, now Level switch\n\
         breaks api: module 16 digital inputs: TxPDO 0x1A00 Inputs: layout …, 2: BOOLEAN Input 3, …, now …, 2: BOOLEAN Level switch, …"
    );
    assert_eq!(
        one("<Type ModuleIdent=\"#x00002001\"", "<Type ModuleIdent=\"#x00002091\""),
        "breaks api, wire: module 8 digital outputs: module: removed\n\
         breaks behavior: CP-32 coupler with 32 slots: module 8 digital outputs (00002001 DO-8): removed\n\
         compatible: CP-32 coupler with 32 slots: module 8 digital outputs (00002091 DO-8): added\n\
         compatible: module 8 digital outputs: module: added"
    );
}

#[test]
fn submodules_of_a_head() {
    let one = |old: &str, new: &str| changes_of("drive.gsdml.xml", &[(old, new)]).join("\n");
    assert_eq!(
        one("DataType=\"N2\" TextId=\"T_NIST_A\"", "DataType=\"N4\" TextId=\"T_NIST_A\""),
        "breaks api, wire: submodule Standard telegram 1: input: length 4, now 6\n\
         breaks api, wire: submodule Standard telegram 1: input: layout 0: UNSIGNED16 ZSW1, 16: scaled INTEGER16 NIST_A, \
         now 0: UNSIGNED16 ZSW1, 16: scaled INTEGER32 NIST_A\n\
         breaks api: submodule Standard telegram 1: input, NIST_A at bit 16: name of the type N2, now N4\n\
         breaks api, behavior: submodule Standard telegram 1: input, NIST_A at bit 16: \
         scale 1 LSB = 0.006103515625, now 1 LSB = 0.00000009313225746154785"
    );
    assert_eq!(
        one("SubmoduleIdentNumber=\"0x00000003\"", "SubmoduleIdentNumber=\"0x00000033\""),
        "breaks api, wire: submodule Standard telegram 3: submodule: removed\n\
         breaks behavior: module Axis: module, submodule Standard telegram 3 (00000003 S_3): removed\n\
         compatible: module Axis: module, submodule Standard telegram 3 (00000033 S_3): added\n\
         compatible: submodule Standard telegram 3: submodule: added"
    );
}

#[test]
fn machines_and_procedures() {
    let with = |text: &str| {
        let machine = format!(
            "{TABLE}[machines.axis]\nstatus = \"flags\"\ncontrol = \"mode\"\n[machines.axis.states]\nidle = {{ mask = 9, value = 0 }}\n\
             ready = {{ mask = 9, value = 1 }}\nfault = {{ mask = 9, value = 9 }}\n[machines.axis.commands]\nstart = {{ mask = 3, value = 1 }}\n\
             [[machines.axis.transitions]]\nfrom = \"idle\"\nto = \"ready\"\ncommand = \"start\"\n\
             [procedures.run]\nsteps = [{{ write = \"mode\", value = 1 }}, {{ delay = 10 }}]\n"
        );
        machine + text
    };
    let old = with("");
    let one = |from: &str, to: &str| {
        assert!(old.contains(from), "{from}");
        let changes = compare(&read("old.toml", &old), &read("new.toml", &old.replace(from, to)));
        changes.iter().map(Change::to_string).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(
        one("fault = { mask = 9, value = 9 }\n", "fault = { mask = 8, value = 8 }\n"),
        "breaks wire: machine axis, state fault: bits 0x9 (mask 0x9), now 0x8 (mask 0x8)"
    );
    assert_eq!(one("fault = { mask = 9, value = 9 }\n", ""), "breaks api: machine axis, state fault: removed");
    assert_eq!(
        one("start = { mask = 3, value = 1 }\n", "start = { mask = 3, value = 1 }\nstop = { mask = 3, value = 2 }\n"),
        "breaks api: machine axis, command stop: added"
    );
    assert_eq!(
        one("delay = 10", "delay = 20"),
        "breaks behavior: procedure run: steps Write 1 to mode. Wait 10 ms., now Write 1 to mode. Wait 20 ms."
    );
    assert_eq!(
        one("[procedures.run]", "[procedures.go]"),
        "breaks api: procedure run: removed\ncompatible: procedure go: added"
    );
}

#[test]
fn layouts_of_pdos() {
    let eds = |mapping: &str| {
        format!(
            "[DeviceInfo]\nNrOfRXPDO=1\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n[1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\n\
             [OptionalObjects]\nSupportedObjects=4\n1=0x1400\n2=0x1600\n3=0x6040\n4=0x607A\n\
             [1400]\nParameterName=RPDO\nObjectType=9\nSubNumber=3\n[1400sub0]\nParameterName=Highest\nDataType=5\nAccessType=const\nDefaultValue=2\n\
             [1400sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x200\n[1400sub2]\nParameterName=Type\nDataType=5\nAccessType=rw\nDefaultValue=255\n\
             [1600]\nParameterName=Mapping\nObjectType=9\nSubNumber=2\n[1600sub0]\nParameterName=Count\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
             [1600sub1]\nParameterName=First\nDataType=7\nAccessType=ro\nDefaultValue={mapping}\n\
             [6040]\nParameterName=Controlword\nDataType=6\nAccessType=rww\nPDOMapping=1\n[607A]\nParameterName=Target position\nDataType=4\nAccessType=rww\nPDOMapping=1\n"
        )
    };
    let changes = compare(&read("old.eds", &eds("0x60400010")), &read("new.eds", &eds("0x607A0020")));
    let layout = changes.iter().find(|change| change.fact == "layout").expect("another layout");
    assert_eq!(
        (layout.old.as_str(), layout.new.as_str()),
        ("0: UNSIGNED16 Controlword", "0: INTEGER32 Target position")
    );
    assert_eq!(
        (layout.element.as_str(), layout.judgment.api, layout.judgment.wire),
        ("RPDO 1 Mapping", Effect::Breaking, Effect::Breaking)
    );
}

#[test]
fn a_description_differs_from_itself_in_nothing() {
    for path in [
        "dictionaries/eco.toml",
        "dictionaries/hsd-sm137-sm140.toml",
        "tests/data/coupler.esi.xml",
        "tests/data/drive.gsdml.xml",
    ] {
        let path = root::root().join(path);
        let catalog = check(Source::read(&path).expect("a description"), &Options::default()).catalog.expect("devices");
        assert_eq!(compare(&catalog, &catalog), [], "{}", path.display());
    }
}

/// Returns the changes between two register tables.
fn between(old: &str, new: &str) -> Vec<String> {
    compare(&read("old.toml", old), &read("new.toml", new)).iter().map(Change::to_string).collect()
}

#[test]
fn changes_that_affect_only_the_bytes() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(
        one("3 = \"fault\"", "4 = \"fault\""),
        "breaks wire: register 3 flags, bit 4: position bit 3, now bit 4"
    );
    assert_eq!(one("1 = \"on\"", "2 = \"on\""), "breaks wire: register 2 mode, value 2: number 1, now 2");
    assert_eq!(
        one("reg = 1, type = \"u16\"", "reg = 1, type = \"u32\""),
        "breaks api, wire: register 1 speed: type UNSIGNED16, now UNSIGNED32\n\
         breaks wire: register 1 speed: number of registers 1, now 2"
    );
}

#[test]
fn ranges_of_values_that_can_be_written_and_of_those_that_cannot() {
    let with = |access: &str, max: u32| {
        TABLE.replace(
            "access = \"rw\", unit = \"rpm\", min = 0, max = 3000",
            &format!("access = \"{access}\", unit = \"rpm\", min = 0, max = {max}"),
        )
    };
    let report = |access: &str, max: u32| between(&with(access, 3000), &with(access, max)).join("\n");
    assert_eq!(report("rw", 2000), "breaks behavior: register 1 speed: range 0 … 3000, now 0 … 2000");
    assert_eq!(report("rw", 4000), "compatible: register 1 speed: range 0 … 3000, now 0 … 4000");
    assert_eq!(report("ro", 2000), "compatible: register 1 speed: range 0 … 3000, now 0 … 2000");
    assert_eq!(report("ro", 4000), "breaks behavior: register 1 speed: range 0 … 3000, now 0 … 4000");
}

#[test]
fn a_further_element_of_a_name_changes_the_identifier() {
    let two = |name: &str| {
        format!(
            "[DeviceInfo]\n[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n[2000]\nParameterName=Gain\nDataType=6\nAccessType=rw\n\
             [2001]\nParameterName={name}\nDataType=6\nAccessType=rw\n"
        )
    };
    let changes = compare(&read("old.eds", &two("Offset")), &read("new.eds", &two("gain")));
    let lines: Vec<String> = changes.iter().map(Change::to_string).collect();
    assert_eq!(
        lines,
        ["breaks api: 0x2000 Gain: identifier gain, now gain_2000", "breaks api: 0x2001 gain: name Offset, now gain",]
    );
}

#[test]
fn two_elements_that_swap_their_addresses_keep_their_names() {
    let swapped = TABLE.replace("reg = 4", "reg = 6").replace("reg = 5", "reg = 4").replace("reg = 6", "reg = 5");
    assert_eq!(
        between(TABLE, &swapped),
        [
            "breaks wire: register 5 gain: address register 4, now register 5",
            "breaks wire: register 4 level: address register 5, now register 4"
        ]
    );
}

#[test]
fn another_spelling_of_the_same_identifier_breaks_nothing() {
    let one = |old: &str, new: &str| changes(&[(old, new)]).join("\n");
    assert_eq!(one("name = \"Go\"", "name = \"go\""), "no effect: message go: name Go, now go");
    assert_eq!(one("[codes.alarm.rows]", "[codes.Alarm.rows]"), "no effect: codes Alarm: name alarm, now Alarm");
}
