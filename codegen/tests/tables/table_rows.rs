//! Tests the rows of register tables: differences between models, scales, conditions, addresses, and errors.

use crate::compile_support;
use crate::form_support;

use compile_support::compile;
use form_support::canonical;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Binding, Item, Scale, Value};
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

const HEAD: &str = "lexibus = 1\n[device]\nname = \"Pump\"\n[[models]]\nname = \"SM137\"\nconstants = { base = 2.5 }\n\
                    [[models]]\nname = \"SM140\"\n[spaces.register]\nmodbus = { table = \"holding\" }\n";

fn read(text: &str) -> Compilation {
    check(Source::new("t.toml", text.into()), &Options::default())
}

/// Returns the diagnostics of a table with their positions.
fn reported(text: &str) -> Vec<String> {
    let compilation = read(text);
    let list = compilation.diagnostics.list();
    list.iter().map(|diagnostic| compilation.one_line(diagnostic).trim_start_matches("t.toml:").to_owned()).collect()
}

/// Returns a table whose only chapter contains the register rows `rows`.
fn rows(rows: &str) -> String {
    format!("{HEAD}[[chapters]]\ntitle = \"One\"\n[chapters.registers]\n{rows}\n")
}

/// Returns a table with a row that has the keys `more` in addition to the required keys.
fn a(more: &str) -> String {
    rows(&format!(
        "a = {{ reg = 1, type = \"u16\", access = \"rw\"{more} }}\nb = {{ reg = 2, type = \"i16\", access = \"ro\" }}"
    ))
}

fn item<'c>(compilation: &'c Compilation, name: &str) -> &'c Item {
    let items = compilation
        .catalog
        .iter()
        .flat_map(|catalog| &catalog.devices)
        .flat_map(|device| &device.groups)
        .flat_map(|group| &group.items);
    items.into_iter().find(|item| item.name == name).unwrap_or_else(|| {
        let lines: Vec<_> =
            compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect();
        panic!("no `{name}`: {lines:#?}")
    })
}

fn rust(text: &str) -> String {
    let compilation = read(text);
    compilation.rust(&RustOptions::default()).unwrap_or_else(|| panic!("{:#?}", reported(text)))
}

/// Asserts that a row with the keys `more` causes a diagnostic that contains `words`.
#[track_caller]
fn is_wrong(more: &str, words: &str) {
    let found = reported(&a(more));
    assert!(found.iter().any(|line| line.contains(words)), "{more}: {found:#?}");
}

#[test]
fn models_and_buses_differ() {
    let text = a(", default = 1, max = 10, variants = [{ models = [\"SM140\"], default = 2, max = 20 }, \
                  { buses = [\"modbus\"], scale = 0.1 }]");
    let compilation = read(&text);
    assert_eq!(reported(&text), [""; 0]);
    let variants = &item(&compilation, "a").variants;
    assert_eq!(
        (variants.len(), &variants[0].default, variants[0].models[0].as_str()),
        (2, &Some(Value::Int(2)), "SM140")
    );
    assert_eq!(variants[1].scale, Some(Scale::Linear { factor: 0.1, offset: 0.0 }));
    let rust = rust(&text);
    assert!(rust.contains("On SM140: default 2, at most 20."), "{rust}");
    assert!(rust.contains("On Modbus: 1 LSB = 0.1."), "{rust}");
    is_wrong(", variants = [{ default = 2 }]", "neither `models` nor `buses`");
    is_wrong(", variants = [{ models = [\"SM140\"] }]", "changes nothing");
    is_wrong(", variants = [{ models = [\"SM150\"], default = 2 }]", "no model has the name `SM150`");
    is_wrong(", variants = [{ buses = [\"can\"], default = 2 }]", "`can` is not a valid bus");
    is_wrong(", variants = [{ models = [\"SM140\"], default = \"x\" }]", "`x` is not a value");
}

#[test]
fn scales() {
    let of = |scale: &str| {
        let text = a(&format!(", scale = {scale}"));
        assert_eq!(reported(&text), [""; 0], "{scale}");
        item(&read(&text), "a").quantity.as_ref().and_then(|quantity| quantity.scale.clone())
    };
    assert_eq!(of("{ by = \"b\", factor = 0.01 }"), Some(Scale::ByItem { item: "b".into(), factor: 0.01 }));
    assert_eq!(of("{ times = \"b\" }"), Some(Scale::TimesItem { item: "b".into(), factor: 1.0 }));
    assert_eq!(of("{ factor = 2, offset = 1 }"), Some(Scale::Linear { factor: 2.0, offset: 1.0 }));
    assert_eq!(of("0.1, offset = 4"), Some(Scale::Linear { factor: 0.1, offset: 4.0 }));
    assert_eq!(of("{ fraction = 15, of = \"base\" }"), Some(Scale::Fraction { bits: 15, base: "base".into() }));
    let mantissa = Scale::Exponent { exponent: "b".into(), base: 2, fraction: 15 };
    assert_eq!(of("{ exponent = \"b\", base = 2, fraction = 15 }"), Some(mantissa));
    assert!(rust(&a(", scale = { exponent = \"b\", base = 2, fraction = 15 }"))
        .contains("Physical value = raw / 2^15 × 2^[b](B)"));
    assert!(rust(&a(", scale = { times = \"b\" }")).contains("Physical value = raw × [b](B)"));
    for (scale, words) in [
        ("0", "the scale is 0"),
        ("nan", "the scale is NaN"),
        ("{}", "the scale rule has no keys"),
        ("{ by = \"b\", offset = 1 }", "`offset` and `by` cannot be in one rule"),
        ("{ by = \"b\" }, offset = 1", "`offset` and `by` cannot be in one rule"),
        ("{ exponent = \"b\", factor = 2 }", "`factor` and `exponent` cannot be in one rule"),
        ("{ reciprocal = 2, by = \"b\" }", "`by` and `reciprocal` cannot be in one rule"),
        ("{ fraction = 15 }", "`fraction` needs `of`"),
        ("{ of = \"base\" }", "the rule has `of`, but no `fraction`"),
        ("{ base = 2 }", "the rule has `base`, but no `exponent`"),
        ("{ exponent = \"b\", base = 3 }", "`base` must be 10 or 2"),
        ("{ factor = 2, offset = 1 }, offset = 1", "`offset` is given both in the scale rule and next to it"),
        ("{ faktor = 2 }", "unknown key `faktor`"),
        ("{ exponent = \"x\" }", "no item has the name `x`"),
        ("{ times = \"x\" }", "no item has the name `x`"),
        ("{ fraction = 15, of = \"x\" }", "no constant has the name `x`"),
    ] {
        is_wrong(&format!(", scale = {scale}"), words);
    }
}

#[test]
fn a_scale_of_a_unit_is_found_at_its_place() {
    let text = a(", unit = \"speed\"") + "[units]\nspeed = { symbol = \"rpm\", scale = { by = \"nothing\" } }\n";
    let found = reported(&text);
    assert!(found.len() == 1 && found[0].starts_with("17:42: no item has the name"), "{found:?}");
}

#[test]
fn names_lead_somewhere() {
    let bits = |models: &str| {
        a(", bits = \"B\"") + &format!("[bits.B.at]\n0 = {{ name = \"on\", models = [\"{models}\"] }}\n")
    };
    assert_eq!(reported(&bits("SM1*")), [""; 0]);
    assert!(reported(&bits("SM9"))[0].contains("no model has the name `SM9`"));
    let values = a(", enum = \"E\"") + "[enums.E.values]\n0 = { name = \"on\", models = [\"SM9\"] }\n";
    assert!(reported(&values)[0].contains("no model has the name `SM9`"));
    let axes =
        a("") + "[axes]\ncount = 2\nmodels = [\"SM9\"]\nrules = [{ objects = \"0x6000..0x67FF\", index = 0x800 }]\n";
    assert!(reported(&axes)[0].contains("no model has the name `SM9`"));
    let window = |name: &str| {
        a("").replace(
            "[[chapters]]",
            &format!("[spaces.far]\nindirect = {{ write_address = \"a\", read = \"{name}\" }}\n[[chapters]]"),
        )
    };
    assert_eq!(reported(&window("b")), [""; 0]);
    assert!(reported(&window("c"))[0].contains("no item has the name `c`"));
}

#[test]
fn lists_and_ranges_of_values() {
    let compilation = read(&a(", allowed = [1, \"3..7\"], writable = [\"3..5\"], when = { b = [\"1..3\", 9] }"));
    let actual = item(&compilation, "a");
    assert_eq!(actual.limits.allowed[1], (Value::Int(3), Value::Int(7)));
    let behavior = actual.behavior.as_ref().expect("a behavior");
    assert_eq!((behavior.writable_values.len(), behavior.write_when[0].values.len()), (3, 4));
    is_wrong(", allowed = [\"low\"]", "`low` is neither a value of UNSIGNED16 nor a range of them");
    is_wrong(", writable = [0.5]", "`0.5` is neither a value of UNSIGNED16");
    is_wrong(", when = { b = \"on\" }", "`on` is neither a number");
    is_wrong(", when = { b = \"0..100000\" }", "more than 1024 values");
    is_wrong(", step = 0.5", "`0.5` is not a value of the type UNSIGNED16");
}

#[test]
fn words_that_are_no_command() {
    for (word, flag) in [("no", "false"), ("yes", "true")] {
        let more = format!(", save = \"{word}\"");
        is_wrong(&more, &format!("`{word}` is not a command"));
        let compilation = read(&a(&more));
        let help = compilation.diagnostics.list()[0].help.as_deref().expect("help");
        assert!(help.starts_with(&format!("write `save = {flag}` without quotes")), "{help}");
    }
}

#[test]
fn conditions_on_bits() {
    let text = a(", when = { b = { mask = 4, value = 0 } }");
    assert_eq!(reported(&text), [""; 0]);
    assert!(rust(&text).contains("The value can be written only while [b](B) \\& 0x4 is 0."));
    is_wrong(", when = { b = { mask = 4, value = 1 } }", "never true");
    is_wrong(", when = { b = { mask = 4 } }", "never true");
    is_wrong(", when = { b = [1, { mask = 4 }] }", "one table with `mask` and `value`");
    let values = a(", enum = \"E\"")
        + "[enums.E.values]\n0 = { name = \"off\", buses = [\"canopen\"] }\n1 = { name = \"on\", when = { b = 3 } }\n";
    assert_eq!(reported(&values), [""; 0]);
    let text = rust(&values);
    assert!(
        text.contains("Available only on CANopen.")
            && text.contains("This value is valid only while [b](super::objects::B) is 3."),
        "{text}"
    );
    let never = values.replace("b = 3", "b = { mask = 4, value = 8 }");
    assert!(reported(&never)[0].contains("never true"));
    let meanings = |other: &str| {
        a(", bits = \"B\"")
            + &format!(
                "[bits.B.at]\n0 = [{{ name = \"x\", when = {{ b = {{ mask = 4, value = 4 }} }} }}, {{ name = \"y\", when = {{ b = {other} }} }}]\n"
            )
    };
    assert_eq!(reported(&meanings("{ mask = 6, value = 2 }")), [""; 0]);
    assert!(reported(&meanings("{ mask = 2, value = 2 }"))[0].contains("overlap"));
    assert!(rust(&meanings("{ mask = 6, value = 2 }")).contains("while [b](super::objects::B) \\& 0x4 is 0x4"));
    let bits = a(", bits = \"B\"")
        + "[bits.B.at]\n0 = { name = \"kept\", reserved = 1 }\n1 = { name = \"x\", access = \"ro\", replaced_by = \"bit 2\" }\n";
    assert_eq!(reported(&bits), [""; 0]);
    let codes = a("") + "[codes.alarm.rows]\n1 = { name = \"hot\", models = [\"SM140\"], since = \"2.0\" }\n";
    assert_eq!(reported(&codes), [""; 0]);
    assert!(reported(&codes.replace("SM140\"], since", "SM9\"], since"))[0].contains("no model has the name `SM9`"));
}

#[test]
fn objects_have_other_addresses_beside() {
    let objects = |row: &str| format!("{HEAD}[[chapters]]\n[chapters.objects]\n{row}\n");
    let text = objects(
        "0x3588 = { name = \"Velocity gain\", type = \"u32\", access = \"rw\", ascii = \"VL.KP\", param = 480, reg = \"10-11\", \
         order = \"low_first\", esc = 0x120 }",
    );
    assert_eq!(reported(&text), [""; 0]);
    let bindings = item(&read(&text), "Velocity gain").bindings.clone();
    assert_eq!(bindings.len(), 5, "{bindings:?}");
    assert!(matches!(&bindings[1], Binding::Register(register) if register.low_word_first && register.count == 2));
    let rust = rust(&text);
    assert!(rust.contains("Name in the device's ASCII protocol: VL.KP."), "{rust}");
    for (row, words) in [
        (
            "\"0x2000..0x2001\" = { name = \"a\", type = \"u8\", access = \"ro\", param = 1 }",
            "describes several objects",
        ),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", count = 2 }", "`count` has no effect"),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", obj = 0x2001 }", "`obj` has no effect"),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", part = 1 }", "`part` has no effect"),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", swap = true }", "`order` has no effect"),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", why = \"x\" }", "`why` has no effect"),
        ("0x2000 = { name = \"a\", code = \"record\", access = \"ro\" }", "`access` applies only to a single value"),
        ("0x2000 = { name = \"a {m}\", type = \"u8\", access = \"ro\" }", "the placeholder in the name"),
        ("0x2000 = { name = \"a\", type = \"u8\", access = \"ro\", buses = [\"modbus\"] }", "on neither"),
    ] {
        let found = reported(&objects(row));
        assert!(found.iter().any(|line| line.contains(words)), "{row}: {found:#?}");
    }
}

#[test]
fn several_of_the_same() {
    let text = rows(
        "\"fmmu{n}\" = { esc = 0x600, length = 16, type = \"?\", access = \"rw\", count = 3 }\n\
                     \"sync{n}\" = { esc = 0x800, type = \"u64\", access = \"rw\", count = 3, stride = 16 }\n\
                     \"code{n+1}\" = { param = 7, type = \"u32\", access = \"ro\", count = 2 }",
    );
    assert_eq!(reported(&text), [""; 0]);
    let compilation = read(&text);
    let is_at = |name: &str, wanted: u16| matches!(item(&compilation, name).bindings[0], Binding::EscMemory { address, .. } if address == wanted);
    assert!(is_at("fmmu2", 0x620) && is_at("sync1", 0x810));
    assert!(matches!(&item(&compilation, "code2").bindings[0], Binding::Parameter(parameter) if parameter.code == 8));
    let range = rows("\"w{n}\" = { reg = \"66-72\", type = \"u16\", access = \"ro\", count = 7 }");
    assert_eq!(reported(&range), [""; 0]);
    let short = reported(&range.replace("66-72", "66-70"));
    assert!(short.len() == 1 && short[0].contains("one repetition needs 1 and all repetitions need 7"), "{short:?}");
    let found = |row: &str| reported(&rows(row)).join("\n");
    assert!(found("\"w{n}\" = { reg = 1, type = \"u16\", access = \"ro\" }").contains("needs a `count`"));
    assert!(found("\"w{m}\" = { reg = 1, type = \"u16\", access = \"ro\" }").contains("the placeholder in the name"));
    let bits = a(", bits = \"B\"") + "[bits.B.at]\n\"0..15\" = \"input {n+1}\"\n";
    assert_eq!(reported(&bits), [""; 0]);
    assert!(rust(&bits).contains("input_16"));
    assert!(reported(&bits.replace("0..15", "0"))[0].contains("the placeholder in the name"));
}

#[test]
fn keys_where_they_say_nothing() {
    for (more, words) in [
        (", name = \"x\"", "`name` has no effect"),
        (", code = \"var\"", "`code` has no effect"),
        (", add = true", "`add` has no effect"),
        (", why = \"x\"", "`why` has no effect"),
        (", stride = 2", "`stride` has no effect"),
        (", max_count = 2", "`max_count` has no effect"),
        (", part = 17", "ends at bit 17"),
        (", bits = { 0 = \"x\" }, enum = { 0 = \"y\" }", "both `bits` and `enum`"),
        (", count = \"b\"", "the maximum number of items is missing"),
        (", buses = [\"serial\"]", "no address on serial: the space `register` has no rule for these buses"),
    ] {
        let text = a(more).replace("\"u16\", access = \"rw\", part", "\"bool\", access = \"rw\", part");
        let found = reported(&text);
        assert!(found.iter().any(|line| line.contains(words)), "{more}: {found:#?}");
    }
    let by_object = rows("a = { obj = 0x2000, part = 1, type = \"bool\", access = \"ro\" }");
    assert!(reported(&by_object).iter().any(|line| line.contains("`part` has no effect")));
    let defaults = a("")
        .replace("[chapters.registers]", "defaults = { access = \"ro\", doc = \"x\", min = 1 }\n[chapters.registers]");
    let found = reported(&defaults);
    assert!(found.len() == 2 && found[0].contains("do not inherit `doc`") && found[1].contains("`min`"), "{found:?}");
    let top = a("") + "[defaults]\nwhen = { b = 1 }\n";
    assert!(reported(&top)[0].contains("do not inherit `when`"));
}

#[test]
fn buses_and_tables_of_modbus() {
    let on = |buses: &str| a("").replace("[device]\n", &format!("[device]\nbuses = [{buses}]\n"));
    let row = on("\"modbus\"").replace("access = \"rw\"", "access = \"rw\", buses = [\"canopen\"]");
    assert!(
        reported(&row).iter().any(|line| line.contains("`buses` of the device does not contain canopen")),
        "{:?}",
        reported(&row)
    );
    let serial = on("\"modbus\", \"serial\"").replace("reg = 1,", "param = 1, buses = [\"serial\"],");
    assert_eq!(reported(&serial), [""; 0]);
    let buses = item(&read(&serial), "a").availability.clone().expect("buses");
    assert_eq!(buses.buses.to_string(), "serial");
    let facts = a("")
        .replace("table = \"holding\"", "table = \"holding\", functions = [3, 6, 16], max_read = 125, max_write = 2")
        .replace("[device]\n", "[device]\nnode_ids = \"1..90\"\n");
    assert_eq!(reported(&facts), [""; 0]);
    let device = read(&facts).catalog.expect("a catalog").devices.remove(0);
    assert_eq!(
        (device.node_ids, device.modbus[0].max_write, device.modbus[0].functions.len()),
        (Some((1, 90)), Some(2), 3)
    );
    let text = rust(&facts);
    for line in [
        "NODE_IDS: core::ops::RangeInclusive<u8> = 1..=90;",
        "pub const MODBUS: rt::modbus::Limits = rt::modbus::Limits {",
        "        functions: &[3, 6, 16],\n        max_read: 125,\n        max_write: 2,\n        split: false,",
        "        readable: &[rt::modbus::Span::new(1, 2)],",
        "    input: rt::modbus::TableLimits::INPUT,",
    ] {
        assert!(text.contains(line), "{text}");
    }
    let other =
        facts.replace("[[chapters]]", "[spaces.other]\nmodbus = { table = \"holding\", max_read = 9 }\n[[chapters]]");
    assert!(reported(&other)[0].contains("another space declares different requests"));
    assert!(reported(&facts.replace("1..90", "0..300"))[0].contains("node IDs must be"));
    let wide = reported(&facts.replace("max_read = 125", "max_read = 126"));
    assert!(wide.len() == 1 && wide[0].contains("reads at most 125 registers"), "{wide:?}");
    assert!(reported(&facts.replace("max_write = 2", "max_write = 0"))[0].contains("at least one register"));
    assert!(rust(&facts.replace("max_write = 2", "split = true")).contains("max_write: 123,\n        split: true,"));
    let coils = rows("a = { reg = \"1-8\", type = \"u8\", access = \"rw\" }").replace("holding", "coil");
    assert_eq!(reported(&coils), [""; 0]);
    let inputs = reported(&a("").replace("holding", "input"));
    assert!(inputs.len() == 1 && inputs[0].contains("Modbus inputs are read-only"), "{inputs:?}");
}

#[test]
fn one_address_of_two_models_and_one_name_in_two_chapters() {
    let two = |one: &str, other: &str| {
        rows(&format!(
            "a = {{ reg = 1, type = \"u16\", access = \"ro\"{one} }}\nb = {{ reg = 1, type = \"i16\", access = \"ro\"{other} }}"
        ))
    };
    assert_eq!(reported(&two(", models = [\"SM137\"]", ", models = [\"SM140\"]")), [""; 0]);
    assert!(reported(&two(", models = [\"SM137\"]", ", models = [\"SM1*\"]"))[0].contains("occurs twice"));
    assert!(reported(&two("", ""))[0].contains("occurs twice"));
    let chapter = |when: &str| {
        a("") + &format!("[[chapters]]\ntitle = \"Two\"\n[chapters.registers]\na = {{ reg = 8, type = \"u16\", access = \"ro\" }}\n\
                          c = {{ reg = 9, type = \"u16\", access = \"rw\", when = {{ {when} = 1 }} }}\n")
    };
    assert_eq!(reported(&chapter("\"Two/a\"")), [""; 0]);
    assert!(rust(&chapter("\"Two/a\"")).contains("only while [Two/a](A_"));
    let found = reported(&chapter("a"));
    assert!(found.len() == 1 && found[0].contains("several chapters have an item `a`"), "{found:?}");
    assert!(reported(&chapter("\"Three/a\""))[0].contains("no item has the name `Three/a`"));
}

#[test]
fn process_data_map_objects() {
    let text = a("") + "[[pdos]]\nindex = 0x1A00\ndirection = \"tx\"\nentries = [\"b\"]\n";
    assert!(reported(&text)[0].contains("`b` has no object address, but PDOs map only objects"));
}

#[test]
fn findings_say_what_and_where() {
    let one = |text: &str, words: &str| {
        let found = reported(text);
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:#?}");
    };
    one(
        &rows("w = { reg = 1, type = \"u16\", access = \"ro\", count = 3 }"),
        "all 3 items of the row have the name `w`",
    );
    one(&a(", default = [1, 2]"), "the list has 2 defaults, but the row describes 1 item");
    let by_parameter = a("")
        .replace("modbus = { table = \"holding\" }", "parameter = true")
        .replace("reg = 1,", "reg = 1, swap = true,");
    one(&by_parameter, "`a` has none");
    let bits = a(", bits = \"B\"") + "[bits.B.at]\n0 = \"one\"\n\"1-0\" = \"two\"\n";
    one(&bits, "18:1: ");
    let values = a(", enum = \"E\"") + "[enums.E.values]\n0 = \"one\"\n\"0..3\" = \"two\"\n";
    one(&values, "18:1: ");
    let half = rows(
        "whole = { reg = \"1-2\", type = \"i32\", access = \"ro\", min = -5 }\n\
                     half = { reg = 3, type = \"u16\", access = \"ro\", same_as = \"whole\", min = 0, max = 9 }",
    );
    assert_eq!(reported(&half), [""; 0]);
    one(
        &half.replace("half = { reg = 3, type = \"u16\"", "half = { reg = 3, type = \"u64\""),
        "declared as the same value",
    );
    let mapped = a("")
        .replace("[device]\n", "[device]\nbuses = [\"ethercat\", \"modbus\"]\n")
        .replace("reg = 2,", "reg = 2, obj = 0x2002,")
        + "[[pdos]]\nindex = 0x1A00\ndirection = \"tx\"\nentries = [\"b\"]\n";
    assert_eq!(reported(&mapped), [""; 0]);
}

/// A table whose rows use many of the keys that affect generated code.
const EVERYTHING: &str = r#"lexibus = 1
[device]
name = "Pump"
buses = ["ethercat", "modbus", "serial"]
node_ids = "1..90"
[[models]]
name = "SM137"
constants = { base = 2.5 }
[[models]]
name = "SM140"
[spaces.register]
modbus = { table = "holding", functions = [3, 6, 16], max_read = 125, max_write = 2 }
[spaces.coil]
modbus = { table = "coil" }
[[chapters]]
title = "One"
[chapters.registers]
gain = { reg = 1, type = "u16", access = "rw", max = 10, default = 1, unit = "A", scale = 0.1, variants = [{ models = ["SM140"], default = 2, max = 20, scale = 0.2 }, { buses = ["modbus"], min = 1, doc = "On this bus it begins at 1." }] }
mantissa = { reg = 2, type = "i16", access = "ro", scale = { exponent = "power", base = 2, fraction = 15 } }
power = { reg = 3, type = "i16", access = "ro" }
product = { reg = 4, type = "i16", access = "ro", unit = "W", scale = { times = "power", factor = 0.5 } }
status = { reg = 5, type = "u16", access = "ro", bits = "Status" }
mode = { reg = 6, type = "u8", access = "rw", enum = "Mode", when = { status = { mask = 4, value = 0 } }, allowed = [0, "1..3"] }
old = { reg = 7, type = "u16", access = "ro", models = ["SM137"] }
new = { reg = 7, type = "i16", access = "ro", models = ["SM140"] }
"input{n+1}" = { reg = "10-13", type = "u16", access = "ro", count = 4 }
"sync{n}" = { esc = 0x800, type = "u64", access = "rw", count = 3, stride = 8 }
named = { ascii = "DRV.EN", param = 4, type = "u16", access = "rw", buses = ["serial"] }
[[chapters]]
title = "Two"
space = "coil"
[chapters.registers]
gain = { reg = 1, type = "bool", access = "rw" }
mode = { reg = "8-15", type = "u8", access = "rw", when = { "One/mode" = ["1..2"] } }
[[chapters]]
title = "Objects"
[chapters.objects]
0x3588 = { name = "Velocity gain", type = "u32", access = "rw", ascii = "VL.KP", param = 480, reg = "20-21", order = "low_first" }
[bits.Status.at]
"0..2" = "input {n+1}"
3 = [{ name = "x", when = { power = { mask = 4, value = 4 } } }, { name = "y", when = { power = { mask = 4, value = 0 } } }]
4 = { name = "kept", reserved = 1 }
5 = { name = "z", access = "ro", replaced_by = "bit 6" }
"15-6" = { reserved = 0 }
[enums.Mode.values]
0 = { name = "off", buses = ["ethercat"] }
1 = { name = "on", when = { power = [1, "3..4"] } }
2 = { name = "old", models = ["SM137"], until = "2.0", replaced_by = "on" }
[codes.alarm.rows]
1 = { name = "hot", doc = "Cool it.", models = ["SM140"], since = "2.0" }
"#;

#[test]
fn all_of_it_compiles() {
    assert_eq!(reported(EVERYTHING), [""; 0]);
    for accessors in [true, false] {
        let compilation = read(EVERYTHING);
        let text = compilation.rust(&RustOptions { accessors, ..RustOptions::default() }).expect("Rust");
        assert!(text.contains("GAIN_1: ") && text.contains("GAIN_COIL_1: "));
        compile("rows", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
        assert_eq!(canonical("rows", &text), Ok(()));
    }
}

#[test]
fn what_is_read_along() {
    let table = rows(
        "a = { reg = 1, type = \"u16\", access = \"rw\" }\n\
         b = { reg = \"2-3\", type = \"i32\", access = \"ro\" }\n\
         c = { reg = 4, type = \"u16\", access = \"wo\" }\n\
         d = { reg = 5, type = \"u16\", access = \"ro\", effects = [\"alarms are cleared\"] }\n\
         e = { reg = 6, type = \"u16\", access = \"ro\", models = [\"SM137\"] }\n\
         f = { reg = 7, part = \"7-0\", type = \"u8\", access = \"ro\" }\n\
         g = { reg = 7, part = \"15-8\", type = \"u8\", access = \"wo\" }\n\
         h = { reg = 8, type = \"u16\", access = \"ro\", since = \"2.0\" }\n\
         i = { reg = 9, type = \"u16\", access = \"const\" }\n\
         j = { reg = 10, type = \"u16\", access = \"ro\" }\n\
         k = { reg = \"100-299\", type = \"str(400)\", access = \"ro\" }",
    );
    assert_eq!(reported(&table), [""; 0]);
    let text = rust(&table);
    assert!(text.contains("readable: &[rt::modbus::Span::new(1, 3), rt::modbus::Span::new(9, 10)],"), "{text}");
    let none = a("").replace("modbus = { table = \"holding\" }", "parameter = true");
    assert!(!rust(&none).contains("MODBUS"));
}

#[test]
fn registers_of_32_bits_have_an_address_each() {
    let table = rows(
        "a = { reg = 0, type = \"u32\", access = \"rw\" }\n\
         b = { reg = 1, type = \"i32\", access = \"ro\" }\n\
         c = { reg = 2, type = \"i16\", access = \"rw\" }\n\
         d = { reg = \"3-4\", type = \"u64\", access = \"ro\" }",
    )
    .replace("modbus = {", "bits = 32\nmodbus = { add = 0x8000,");
    assert_eq!(reported(&table), [""; 0]);
    let text = rust(&table);
    for part in [
        "rt::Register::high_first(32769, 2).words_per_address(2)",
        "rt::Register::holding(32770).words_per_address(2)",
        "rt::Register::high_first(32771, 4).words_per_address(2)",
        "Modbus 1 (holding; wire address 0x8001; FC 3; 32 bits per address; high word first), INTEGER32",
        "Modbus 3–4 (holding; wire address 0x8003–0x8004; FC 3; 32 bits per address; high word first)",
        "readable: &[rt::modbus::Span::new(32768, 32772).words_per_address(2)],",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let twice = table.replace("reg = \"3-4\"", "reg = \"2-3\"");
    assert!(
        reported(&twice)[0].contains("occurs twice") || reported(&twice)[0].contains("takes"),
        "{:?}",
        reported(&twice)
    );
}
