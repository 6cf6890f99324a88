//! Tests register tables: the diagnostics for mistakes, and the results of the examples in the documentation.

use crate::table_support;

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{render, Severity};
use lexibus_codegen::ir::{Access, Binding, Item, RegisterSpace, Scale, Type, Value};
use lexibus_codegen::source::Source;
use proptest::prelude::*;
use table_support::{examples, whole};

fn read(text: &str) -> Compilation {
    read_with(text, &[])
}

fn read_with(text: &str, choices: &[(&str, &str)]) -> Compilation {
    let choices = choices.iter().map(|(name, choice)| ((*name).to_owned(), (*choice).to_owned())).collect();
    check(Source::new("t.toml", text.into()), &Options { choices, ..Options::default() })
}

/// Returns the diagnostics of a compilation, one per line.
fn reported(compilation: &Compilation) -> Vec<String> {
    let line = |diagnostic: &lexibus_codegen::diagnostics::Diagnostic| {
        let help = diagnostic.help.as_ref().map(|help| format!(" ({help})")).unwrap_or_default();
        format!("{} {}{help}", diagnostic.severity.name(), compilation.one_line(diagnostic))
    };
    compilation.diagnostics.list().iter().map(line).collect()
}

const HEAD: &str = "lexibus = 1\n[device]\nname = \"Pump\"\n[spaces.register]\nmodbus = { table = \"holding\" }\n";

/// Returns a table whose only chapter contains `rows`.
fn rows(rows: &str) -> String {
    format!("{HEAD}[[chapters]]\n[chapters.registers]\n{rows}\n")
}

/// Returns a table with a row that has the keys `more` in addition to the required keys.
fn a(more: &str) -> String {
    rows(&format!("a = {{ reg = 1, type = \"u16\", access = \"ro\"{more} }}"))
}

#[test]
fn mistakes_and_what_is_said_of_them() {
    let objects = |rows: &str| format!("{HEAD}[[chapters]]\n[chapters.objects]\n{rows}\n");
    let option = "[options.gain]\ndefault = \"low\"\n[options.gain.choices]\nlow = 1\nhigh = 2\n";
    let b = "b = { reg = 2, type = \"u16\", access = \"ro\" }";
    let object = "0x2000 = { name = \"a\", type = \"u16\", access = \"ro\" }";
    let cases = [
        ("no TOML", "lexibus = 1\n[device\n".to_owned()),
        ("a name of two words", rows("pump speed = { reg = 1 }")),
        ("a range without quotes", rows("a = { reg = 40004-40005 }")),
        ("a fraction", a(", scale = 0.1, max = 65.5")),
        ("a spelling of a unit", a(", unit = \"degC\"")),
        ("bits without `at`", format!("{HEAD}[bits.A]\n0 = \"on\"\n")),
        ("a part", rows("a = { reg = 1, type = \"bool\", access = \"ro\", part = 3 }")),
        ("no part", rows("a = { reg = 1, type = \"bool\", access = \"ro\", part = \"x\" }")),
        ("no version", "[device]\nname = \"x\"\n".to_owned()),
        ("another version", "lexibus = 2\n[device]\nname = \"x\"\n".to_owned()),
        ("no device", "lexibus = 1\n".to_owned()),
        ("no name", "lexibus = 1\n[device]\nvendor = \"x\"\n".to_owned()),
        ("a top key", format!("{HEAD}[chapter]\n")),
        ("a key of a row", rows(&format!("a = {{ reg = 1, type = \"u16\", acess = \"ro\" }}\n{b}"))),
        ("a key far off", a(", color = \"red\"")),
        ("a wrong kind", rows(&format!("a = {{ reg = 1, type = 16, access = \"ro\" }}\n{b}"))),
        ("a type", rows("a = { reg = 1, type = \"uint16\", access = \"ro\" }")),
        ("no type", rows("a = { reg = 1, access = \"ro\" }")),
        ("an access", rows("a = { reg = 1, type = \"u16\", access = \"r/w\" }")),
        ("no access", rows("a = { reg = 1, type = \"u16\" }")),
        ("a limit", a(", min = \"low\"")),
        ("an address", rows("a = { reg = \"one\", type = \"u16\", access = \"ro\" }")),
        ("a negative address", rows("a = { reg = -1, type = \"u16\", access = \"ro\" }")),
        ("an address outside of the bus", rows("a = { reg = 65536, type = \"u16\", access = \"ro\" }")),
        ("no address", rows("a = { type = \"u16\", access = \"ro\" }")),
        ("a span", rows("a = { reg = \"1-2\", type = \"u16\", access = \"ro\" }")),
        ("an address twice", rows(&format!("{b}\n{}", b.replacen('b', "c", 1)))),
        ("a name twice", format!("{}[[chapters]]\n[chapters.registers]\n{b}\n", rows(&b.replacen('2', "3", 1)))),
        ("bits that don't exist", format!("{}[bits.Status.at]\n0 = \"on\"\n", a(", bits = \"Statsu\""))),
        ("an item that doesn't exist", a(", same_as = \"aa\"")),
        ("a unit", a(", unit = \"furlong\"")),
        ("a space", format!("{HEAD}[[chapters]]\nspace = \"registers\"\n")),
        ("bits", format!("{}[bits.A.at]\nx = \"on\"\n", rows(""))),
        ("a value", format!("{}[enums.A.values]\n\"1-2\" = \"on\"\n", rows(""))),
        ("an object", objects("motor = { type = \"u16\", access = \"ro\" }")),
        ("an object twice", objects(&format!("{object}\n{}", object.replacen("0x2000", "8192", 1)))),
        ("a sub-entry alone", objects(&object.replacen("0x2000", "\"0x2000:1\"", 1))),
        ("a sub-entry of a value", objects(&format!("{object}\n{}", object.replacen("0x2000", "\"0x2000:1\"", 1)))),
        ("an option that doesn't exist", a(", scale = \"$gian\"") + option),
        ("an option without default", format!("{HEAD}[options.x.choices]\na = 1\n")),
        ("a chapter that is no table", "lexibus = 1\nchapters = [1]\n[device]\nname = \"x\"\n".to_owned()),
    ];
    let mut text = String::new();
    for (what, table) in cases {
        text += &format!("# {what}\n{}\n\n", reported(&read(&table)).join("\n"));
    }
    insta::assert_snapshot!(text);
}

#[test]
fn a_mistake_as_a_terminal_shows_it() {
    let table = rows("temperature = { reg = 2, typ = \"i16\", access = \"ro\" }");
    let compilation = read(&table);
    let list = compilation.diagnostics.list().iter();
    let shown: Vec<String> =
        list.map(|diagnostic| render::terminal::render(diagnostic, &compilation.sources, false)).collect();
    insta::assert_snapshot!(shown.join("\n\n"));
}

#[test]
fn choices_of_options() {
    let table = "lexibus = 1\n[device]\nname = \"x\"\n[options.place]\ndefault = \"low\"\n\
                 [options.place.choices]\nlow = 1\nhigh = 2\n[spaces.s]\nmodbus = { add = \"$place\" }\n\
                 [[chapters]]\nregisters.a = { reg = 10, type = \"u16\", access = \"ro\" }\n";
    let address = |compilation: &Compilation| match &item(compilation, "a").bindings[0] {
        Binding::Register(register) => register.address,
        other => panic!("{other:?}"),
    };
    assert_eq!(address(&read(table)), 11);
    assert_eq!(address(&read_with(table, &[("place", "high")])), 12);
    let wrong = reported(&read_with(table, &[("place", "hihg")]));
    assert_eq!(
        wrong,
        ["error t.toml:4:10: no choice of the option `place` has the name `hihg` [TAB005] (known names: low, high)"]
    );
    let unknown = reported(&read_with(table, &[("plaec", "low")]));
    assert_eq!(unknown, ["error t.toml: no option of this table has the name `plaec` [TAB005] (known names: place)"]);
}

fn item<'c>(compilation: &'c Compilation, name: &str) -> &'c Item {
    let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
    let mut items = devices.flat_map(|device| &device.groups).flat_map(|group| &group.items);
    items.find(|item| item.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Tests the first example of the documentation, which is a complete device.
#[test]
fn the_worked_example() {
    let (_, block) = examples().swap_remove(0);
    let compilation = read(&block);
    assert_eq!(reported(&compilation), Vec::<String>::new());
    let register = |name| match &item(&compilation, name).bindings[0] {
        Binding::Register(register) => (register.space, register.address, register.count),
        other => panic!("{name} is {other:?}"),
    };
    assert_eq!(register("speed_setpoint"), (RegisterSpace::Holding, 0, 1));
    assert_eq!(register("running_time"), (RegisterSpace::Holding, 3, 2));
    let setpoint = item(&compilation, "speed_setpoint");
    assert_eq!(
        (setpoint.ty, setpoint.access, &setpoint.limits.high),
        (Type::Unsigned(16), Access::ReadWrite, &Some(Value::Int(3000)))
    );
    let temperature = item(&compilation, "temperature").quantity.clone().expect("a unit");
    assert_eq!(temperature.scale, Some(Scale::Linear { factor: 0.1, offset: 0.0 }));
    assert_eq!(temperature.sentinels, [(Value::Int(0x7FFF), "no sensor".into())]);
    assert!(compilation.rust(&Options::default().rust).is_some());
}

#[test]
fn the_examples_of_the_documentation_are_tables() {
    let examples = examples();
    assert!(examples.len() > 5);
    // Skip overlays, because they contain no device. Another test checks overlays against the schema.
    for (line, block) in examples.iter().filter(|(_, block)| !block.contains("[overlay]")) {
        let compilation = read(&whole(block));
        let errors = compilation.diagnostics.list().iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
        let errors: Vec<String> = errors.map(|diagnostic| compilation.one_line(diagnostic)).collect();
        assert_eq!(errors, Vec::<String>::new(), "README.md:{line}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_read(text in "lexibus = 1\n\\PC*|\\PC*") {
        read(&text);
    }
}
