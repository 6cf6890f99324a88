//! The JSON Schema of register tables: what is checked in is today's, real tables pass it, and wrong ones don't. What
//! `lexibus new` and `lexibus schema` do is here, too.

#[path = "../../codegen/tests/table_support/mod.rs"]
mod table_support;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use jsonschema::Validator;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::frontend::table::SCHEMA;
use lexibus_codegen::source::Source;
use table_support::{dictionaries, examples, whole};

fn validator() -> Validator {
    let schema: serde_json::Value = serde_json::from_str(SCHEMA).expect("a JSON document");
    jsonschema::validator_for(&schema).expect("a JSON Schema")
}

/// What the schema has against a table.
fn faults(validator: &Validator, text: &str) -> Vec<String> {
    let table: toml::Table = toml::from_str(text).expect("TOML");
    let table = serde_json::to_value(table).expect("a value of JSON");
    validator.iter_errors(&table).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn tables(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

fn lexibus(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lexibus")).args(arguments).output().expect("lexibus runs")
}

#[test]
fn what_is_checked_in_is_todays() {
    let path = dictionaries().join("table.schema.json");
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(text == SCHEMA, "{} is stale: tests/bindings.sh writes it again", path.display());
    let path = path.to_string_lossy().into_owned();
    assert!(lexibus(&["schema", "--out", &path, "--check"]).status.success());
    assert_eq!(String::from_utf8_lossy(&lexibus(&["schema"]).stdout), text);
}

#[test]
fn real_tables_pass() {
    let validator = validator();
    for (line, block) in examples() {
        assert_eq!(faults(&validator, &whole(&block)), Vec::<String>::new(), "README.md:{line}");
    }
    for path in tables(&dictionaries()).into_iter().chain(tables(&dictionaries().join("profiles"))) {
        let text = std::fs::read_to_string(&path).expect("a table");
        assert_eq!(faults(&validator, &text), Vec::<String>::new(), "{}", path.display());
    }
}

#[test]
fn wrong_tables_do_not_pass() {
    let validator = validator();
    let head = "lexibus = 1\n[device]\nname = \"x\"\n";
    assert!(faults(&validator, head).is_empty());
    let chapter = |row: &str| format!("{head}[[chapters]]\n{row}");
    for wrong in [
        "[device]\nname = \"x\"\n".to_owned(),
        "lexibus = 2\n[device]\nname = \"x\"\n".to_owned(),
        "lexibus = 1\n".to_owned(),
        format!("{head}colour = \"red\"\n"),
        format!("{head}buses = [\"can\"]\n"),
        format!("{head}vendor_id = \"0x10\"\n"),
        chapter("registers.a = { reg = 1, type = \"u16\", access = \"r/w\" }"),
        chapter("registers.a = { reg = 1, typ = \"u16\" }"),
        chapter("registers.a = { reg = 1, type = \"int\" }"),
        chapter("registers.a = { reg = \"one\", type = \"u16\" }"),
        chapter("registers.a = { reg = -1, type = \"u16\" }"),
        chapter("registers.a = { reg = 1, type = \"u16\", bits = { one = \"x\" } }"),
        chapter("registers.a = { reg = 1, type = \"u16\", scale = { faktor = 2 } }"),
        chapter("objects.motor = { type = \"u16\" }"),
        format!("{head}[bits.A.at]\n0 = {{ name = \"x\", trigger = \"up\" }}\n"),
        format!("{head}[enums.A.values]\n\"1-2\" = \"x\"\n"),
    ] {
        assert!(!faults(&validator, &wrong).is_empty(), "{wrong}");
    }
}

#[test]
fn options_may_stand_in_any_place() {
    let validator = validator();
    let table = "lexibus = 1\n[device]\nname = \"x\"\nvendor_id = \"$vendor\"\n[options.vendor]\nchoices = { a = 1 }\n\
                 default = \"a\"\n[spaces.s]\ncanopen = { sub = \"$sub\" }\n[[chapters]]\n\
                 registers.a = { reg = 1, type = \"$ty\", access = \"$access\", hidden = \"$hidden\" }\n";
    assert_eq!(faults(&validator, table), Vec::<String>::new());
}

#[test]
fn every_key_is_told_what_it_is() {
    let schema: serde_json::Value = serde_json::from_str(SCHEMA).expect("a JSON document");
    let own = schema["definitions"].as_object().expect("definitions");
    for (name, definition) in own {
        for (key, property) in definition["properties"].as_object().into_iter().flatten() {
            assert!(property["description"].is_string(), "{name}.{key}");
        }
    }
}

#[test]
fn folders_are_searched_for_tables_of_devices() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tables");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    for (name, text) in [
        ("pump.toml", "# a pump\nlexibus = 1\n[device]\nname = \"x\"\n"),
        ("overlay.toml", "lexibus = 1\n[overlay]\nwhy = \"x\"\n"),
        ("Cargo.toml", "[package]\nname = \"x\"\n"),
    ] {
        std::fs::write(folder.join(name), text).expect("a temporary file");
    }
    let checked = lexibus(&["check", &folder.to_string_lossy()]);
    let said = String::from_utf8_lossy(&checked.stderr).into_owned();
    assert!(checked.status.success() && said.contains("1 file: no findings"), "{said}");
}

#[test]
fn a_new_table_is_without_fault() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let validator = validator();
    for bus in ["modbus", "canopen", "ethercat"] {
        let path = folder.join(format!("{bus}.toml"));
        let shown = path.to_string_lossy().into_owned();
        let made = lexibus(&["new", "Pump \"7\" \\", "--bus", bus, "--out", &shown]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        let text = std::fs::read_to_string(&path).expect("the table");
        let options = Options::default();
        let compilation = check(Source::new(&*shown, text.clone().into_bytes()), &options);
        let said: Vec<String> = compilation.diagnostics.list().iter().map(|own| compilation.one_line(own)).collect();
        assert_eq!(said, Vec::<String>::new());
        assert!(compilation.rust(&options.rust).is_some_and(|rust| rust.contains("Pump7")));
        assert_eq!(faults(&validator, &text), Vec::<String>::new(), "{bus}");
        let again = lexibus(&["new", "Pump", "--out", &shown]);
        assert_eq!(again.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&again.stderr).contains("exists already"));
        assert_eq!(std::fs::read_to_string(&path).expect("the table"), text);
    }
    let call = Command::new(env!("CARGO_BIN_EXE_lexibus")).args(["new", "Flow Meter 3"]).current_dir(&folder).output();
    assert!(call.is_ok_and(|made| made.status.success()) && folder.join("flow-meter-3.toml").is_file());
    assert_eq!(lexibus(&["new", " "]).status.code(), Some(2));
}
