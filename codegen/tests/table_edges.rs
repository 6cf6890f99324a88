//! Numbers and ranges of register tables that are as large as they can be, or larger.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Binding, Item, Scale, Value};
use lexibus_codegen::source::Source;

/// A table with these chapters, read.
fn read(head: &str, chapters: &str) -> Compilation {
    let text = format!(
        "lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"canopen\", \"modbus\"]\n{head}[[chapters]]\n{chapters}"
    );
    check(Source::new("t.toml", text.into()), &Options { no_profiles: true, ..Options::default() })
}

const SPACE: &str = "[spaces.register]\nmodbus = { table = \"holding\" }\n";

fn codes(compilation: &Compilation) -> Vec<&'static str> {
    compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
}

fn items(compilation: &Compilation) -> Vec<&Item> {
    let catalog = compilation.catalog.as_ref().expect("a catalogue");
    catalog.devices[0].groups.iter().flat_map(|group| &group.items).collect()
}

#[test]
fn a_scale_of_one_is_one_of_its_own() {
    let row = "[chapters.registers]\na = { reg = 0, type = \"u16\", access = \"ro\", unit = \"A\", scale = 0.1, \
               variants = [{ models = [\"B\"], scale = 1 }] }\n";
    let compilation = read(SPACE, row);
    let scale = &items(&compilation)[0].variants[0].scale;
    assert_eq!(*scale, Some(Scale::Linear { factor: 1.0, offset: 0.0 }));
}

#[test]
fn the_ends_of_a_list_are_its_least_and_its_greatest() {
    let row = "[chapters.registers]\na = { reg = 0, type = \"f32\", access = \"rw\", \
               variants = [{ buses = [\"modbus\"], allowed = [5.0, 1.0, 3.0] }] }\n";
    let compilation = read(SPACE, row);
    let limits = &items(&compilation)[0].variants[0].limits;
    assert_eq!((&limits.low, &limits.high), (&Some(Value::Real(1.0)), &Some(Value::Real(5.0))));
}

#[test]
fn one_row_stands_for_no_more_than_the_bound() {
    let all = "[chapters.objects]\n\"0x0000..0xFFFF:0..255\" = { name = \"x\", type = \"u8\", access = \"ro\" }\n";
    let compilation = read("", all);
    assert!(codes(&compilation).contains(&"IO003"), "{:?}", codes(&compilation));
    assert_eq!(items(&compilation).len(), 1);
}

#[test]
fn rows_repeat_by_the_length_of_their_values() {
    let addresses = |row: &str| -> Vec<u16> {
        let compilation = read(&format!("{SPACE}[enums.Big]\nbase = \"u32\"\nvalues = {{ 0 = \"off\" }}\n"), row);
        let of_item = |item: &&Item| match item.bindings.first() {
            Some(Binding::Register(own)) => own.address,
            other => panic!("{other:?}"),
        };
        items(&compilation).iter().map(of_item).collect()
    };
    let row = |ty: &str| {
        format!("[chapters.registers]\n\"x{{n}}\" = {{ reg = 0, access = \"ro\", enum = \"Big\", {ty}count = 3 }}\n")
    };
    assert_eq!(addresses(&row("")), [0, 2, 4]);
    assert_eq!(addresses(&row("type = \"u32\", ")), [0, 2, 4]);
}

#[test]
fn an_object_that_is_one_value_takes_the_defaults() {
    for code in ["", ", code = \"var\""] {
        let rows = format!(
            "defaults = {{ type = \"u16\", access = \"rw\" }}\n[chapters.objects]\n0x2000 = {{ name = \"X\"{code} }}\n"
        );
        let compilation = read("", &rows);
        // The mandatory objects of CANopen are missing, and nothing else.
        assert!(codes(&compilation).iter().all(|code| *code == "EDS063"), "{code}: {:?}", codes(&compilation));
        assert!(items(&compilation)[0].access.writable());
    }
}

#[test]
fn numbers_that_are_too_large_are_told() {
    const LONG: &str = "170141183460469231731687303715884105727";
    let register =
        |facts: &str| format!("[chapters.registers]\nx = {{ reg = 1, type = \"u8\", access = \"rw\", {facts} }}\n");
    let cases = [
        (SPACE.to_owned(), register(&format!("writable = [\"-{LONG}..{LONG}\"]"))),
        (SPACE.to_owned(), "[chapters.registers]\n\"x{n}\" = { obj = \"0x2000\", type = \"u8\", access = \"ro\", count = 2, stride = 4294967295 }\n".to_owned()),
        (SPACE.to_owned(), "[chapters.registers]\nx = { reg = \"4294967295-999999999\", type = \"u8\", access = \"ro\" }\n".to_owned()),
        ("[spaces.register]\nmodbus = { add = 9223372036854775807 }\n".to_owned(), register("")),
        ("[spaces.register]\nmodbus = { add = 9223372036854775807, first = -9223372036854775807 }\n".to_owned(), register("")),
        ("[spaces.register]\ncanopen = { index = 9223372036854775807 }\n".to_owned(), register("")),
        (format!("{SPACE}[bits.B]\nbase = \"u8\"\naddress = 2\n\"-{LONG}:0\" = \"x\"\n"), register("bits = \"B\"")),
    ];
    for (head, chapters) in cases {
        let compilation = read(&head, &chapters);
        assert!(!codes(&compilation).is_empty(), "{head}{chapters}");
    }
}
