//! Tests register tables with numbers and ranges that are at or beyond their limits.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::facts::doubts;
use lexibus_codegen::ir::{Binding, Item, Scale, Shape, TypeDef, Value};
use lexibus_codegen::source::Source;

/// Compiles a table that contains `head`, followed by `chapters`.
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
    let catalog = compilation.catalog.as_ref().expect("a catalog");
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

/// Checks that each element has its ambiguities, and that the list of the device contains those of a definition with two types
/// once, in the order of the file.
#[test]
fn ambiguities_of_definitions() {
    let doubt = |says: &str| format!("doubt = {{ says = \"{says}\", chose = \"x\", why = \"y\" }}");
    let [option, bits, bit, value] = ["option", "bits", "bit", "value"].map(doubt);
    let head = format!(
        "{SPACE}[bits.B]\nbase = \"u16\"\n{bits}\n[bits.B.at]\n\"3-0\" = {{ name = \"x{{n}}\", {bit} }}\n\
         8 = {{ name = \"mode\", values = {{ 1 = {{ name = \"on\", {value} }} }} }}\n\
         [options.site]\nchoices = {{ a = 1, b = 2 }}\ndefault = \"a\"\n{option}\n"
    );
    let rows = "[chapters.registers]\na = { reg = 0, bits = \"B\", access = \"ro\" }\n\
                b = { reg = 1, type = \"u32\", bits = \"B\", access = \"ro\" }\n";
    let compilation = read(&head, rows);
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    let device = &catalog.devices[0];
    let of_type = |definition: &TypeDef| -> Vec<String> {
        definition.doubts.iter().map(|doubt| format!("{}: {} {}", definition.name, doubt.part, doubt.says)).collect()
    };
    let of_types: Vec<Vec<String>> = device.types.iter().map(of_type).collect();
    let expected = [
        vec!["B mode: 1 value"],
        vec!["B:  bits", "B: 3-0 bit"],
        vec!["BU32 mode: 1 value"],
        vec!["BU32:  bits", "BU32: 3-0 bit"],
    ];
    assert_eq!(of_types, expected);
    let listed = doubts::of_device(catalog, device);
    let listed: Vec<_> = listed.iter().map(|(name, doubt)| (*name, doubt.part.as_str(), doubt.says.as_str())).collect();
    let expected = [("B", "", "bits"), ("B", "3-0", "bit"), ("B mode", "1", "value"), ("", "site", "option")];
    assert_eq!(listed, expected);
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
            Some(Binding::Register(register)) => register.address,
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
        // The only diagnostics are about mandatory CANopen objects that are missing.
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

#[test]
fn patterns_of_bits_are_signed_wherever_they_stand() {
    let head =
        "[enums.Signed]\nbase = \"i16\"\nvalues = { 0xFFFF = \"none\", \"0x8000..0x8003\" = \"low\", 5 = \"five\" }\n";
    let row = "[chapters.registers]\n\
               a = { reg = 0, type = \"i16\", access = \"rw\", allowed = [0x8000, 7, \"0xFFF0..0xFFFF\"], writable = [0x8000, 7],\n\
               default = 0x8000 }\n\
               b = { reg = 1, type = \"i16[2]\", access = \"rw\", default = [0xFFFF, 2] }\n\
               c = { reg = 3, enum = \"Signed\", access = \"ro\" }\n\
               \"d {n}\" = { reg = 4, count = 2, type = \"i16\", access = \"rw\", default = [1, 0xFFFE] }\n";
    let compilation = read(&format!("{SPACE}{head}"), row);
    assert!(codes(&compilation).iter().all(|code| *code == "EDS063"), "{:?}", codes(&compilation));
    let list = items(&compilation);
    let int = |number: i128| Some(Value::Int(number));
    let allowed: Vec<_> = list[0].limits.allowed.iter().map(|(low, high)| (low.as_int(), high.as_int())).collect();
    assert_eq!(allowed, [(Some(-32768), Some(-32768)), (Some(7), Some(7)), (Some(-16), Some(-1))]);
    let writable = &list[0].behavior.as_ref().expect("what may be written").writable_values;
    assert_eq!((&list[0].default, &writable[..]), (&int(-32768), &[Value::Int(-32768), Value::Int(7)][..]));
    assert_eq!((&list[1].default, &list[3].default, &list[4].default), (&int(-1), &int(1), &int(-2)));
    let device = &compilation.catalog.as_ref().expect("a catalog").devices[0];
    let values = device.types.iter().find_map(|definition| match &definition.shape {
        Shape::Enumeration { values, .. } => Some(values),
        _ => None,
    });
    let values: Vec<_> = values.expect("an enumeration").iter().map(|value| (value.value, value.last)).collect();
    assert_eq!(values, [(-1, None), (-32768, Some(-32765)), (5, None)]);
}

#[test]
fn an_offset_is_a_finite_number() {
    let row = "[chapters.registers]\na = { reg = 0, type = \"i16\", access = \"rw\", offset = inf }\n";
    let compilation = read(SPACE, row);
    let found =
        compilation.diagnostics.list().iter().filter(|found| found.message == "the offset is not a finite number");
    assert_eq!(found.count(), 1);
}

#[test]
fn conditions_compare_with_what_the_item_holds() {
    let head = "[enums.Mode]\nbase = \"i16\"\nvalues = { 0xFFFF = \"error\", 0 = \"ok\" }\n";
    let row = "[chapters.registers]\nmode = { reg = 0, enum = \"Mode\", access = \"ro\" }\n\
               x = { reg = 1, type = \"u16\", access = \"rw\", when = { mode = [0xFFFF] } }\n";
    let compilation = read(&format!("{SPACE}{head}"), row);
    assert!(codes(&compilation).iter().all(|code| *code == "EDS063"), "{:?}", codes(&compilation));
    let condition = &items(&compilation)[1].behavior.as_ref().expect("a condition").write_when[0];
    assert_eq!(condition.values, [Value::Int(-1)]);
}

#[test]
fn ranges_that_turn_over_and_ranges_beyond() {
    let found = |row: &str| -> Vec<String> {
        let compilation = read(SPACE, &format!("[chapters.registers]\na = {{ reg = 0, access = \"rw\", {row} }}\n"));
        let list = compilation.diagnostics.list().iter().filter(|found| found.code.id != "EDS063");
        list.map(|found| found.message.clone()).collect()
    };
    let none = "`0..0xFFFF` is neither a value of INTEGER16 nor a range of them";
    assert_eq!(found("type = \"i16\", allowed = [\"0..0xFFFF\"], default = 5"), [none]);
    assert_eq!(found("type = \"i16\", allowed = [\"0x8000..0xFFFF\"], default = -5"), Vec::<String>::new());
    let beyond = found("type = \"u8\", max = 100, writable = [\"0..300\"]");
    assert_eq!(beyond.len(), 2, "{beyond:?}");
    assert!(beyond.iter().all(|message| message.contains("300")), "{beyond:?}");
    let many = found("type = \"u16\", writable = [\"0..1000\", \"2000..3000\"]");
    assert_eq!(many, ["with 2000 to 3000, the list has more than 1024 values"]);
}

#[test]
fn sums_of_lengths_do_not_overflow() {
    let copies = "{ copy = \"0..65535\" }, ".repeat(8_193);
    let text = format!(
        "lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n[[messages]]\nname = \"m\"\n\
         request = [{{ bytes = [1], at = 0 }}, {copies}]\n"
    );
    let compilation = check(Source::new("t.toml", text.into()), &Options::default());
    assert!(compilation.catalog.is_some());
}

#[test]
fn what_is_said_of_a_row_is_said_once() {
    let row = "[chapters.registers]\n\"a {n}\" = { reg = 0, count = 100, type = \"u16\" }\n";
    assert_eq!(codes(&read(SPACE, row)).iter().filter(|code| **code == "TAB010").count(), 1);
}
