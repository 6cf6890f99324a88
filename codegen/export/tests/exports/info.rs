//! Tests the counts that `lexibus info` prints.

#[path = "../../../tests/table_support/mod.rs"]
mod table_support;

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::limits::MAX_SAME_DIAGNOSTICS;
use lexibus_codegen::source::Source;
use lexibus_export::json;
use table_support::examples;

fn read(text: &str) -> Compilation {
    check(Source::new("t.toml", text.into()), &Options::default())
}

/// The list contains a limited number of diagnostics for each file and code. The counts also include the diagnostics beyond
/// this number.
#[test]
fn info_counts_all_warnings() {
    let count = MAX_SAME_DIAGNOSTICS + 25;
    let rows: String = (0..count)
        .map(|at| format!("a{at} = {{ reg = {at}, type = \"u16\", access = \"ro\", unit = \"furlong\" }}\n"))
        .collect();
    let table = format!("lexibus = 1\n[device]\nname = \"Pump\"\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n[[chapters]]\n[chapters.registers]\n{rows}");
    let info = json::info(&read(&table));
    assert_eq!(info.warnings.get("TAB011"), Some(&count), "{:?}", info.warnings);
}

/// Tests the counts for the first example in the documentation of register tables, which is a complete device.
#[test]
fn info_of_the_worked_example() {
    let (_, block) = examples().swap_remove(0);
    let info = json::info(&read(&block));
    let device = &info.devices[0];
    assert_eq!((info.format, device.name.as_str(), device.registers), (Some("table"), "Pump controller", Some(6)));
    assert_eq!((device.objects, device.entries), (0, 0));
}

#[test]
fn info_counts_objects_and_registers() {
    let table = "lexibus = 1\n[device]\nname = \"Pump\"\n[spaces.register]\nmodbus = { table = \"holding\" }\n[[chapters]]\n[chapters.registers]\n\
         a = { reg = 1, type = \"u16\", access = \"ro\" }\n\
         \"b{n}\" = { reg = 2, count = 3, type = \"u32\", access = \"ro\" }\n\
         [chapters.objects]\n0x2000 = { name = \"o\", code = \"record\" }\n\
         \"0x2000:1\" = { name = \"s\", type = \"u8\", access = \"ro\" }\n";
    let compilation = read(table);
    let device = &json::info(&compilation).devices[0];
    assert_eq!(
        (device.registers, device.objects, device.entries),
        (Some(4), 1, 1),
        "{:?}",
        compilation.diagnostics.list()
    );
}
