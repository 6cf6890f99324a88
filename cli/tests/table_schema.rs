//! Tests the JSON Schema of register tables: the schema in `dictionaries` must be up to date, accept valid tables, and
//! reject invalid ones. The module also tests `lexibus new` and `lexibus schema`.

#[path = "../../tests/support/python.rs"]
mod python;
#[path = "../../codegen/tests/table_support/mod.rs"]
mod table_support;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::frontend::table::SCHEMA;
use lexibus_codegen::source::Source;
use table_support::{dictionaries, examples, whole};

/// Python script that reads a schema and documents, and prints the errors of each document.
const SCRIPT: &str = "\
import json, sys
from jsonschema import validators
schema, *documents = json.load(sys.stdin)
validator = validators.validator_for(schema)(schema)
print(json.dumps([[f'{error.json_path}: {error.message}' for error in validator.iter_errors(d)] for d in documents]))
";

/// Returns the errors that an independent validator reports for each table. If the validator is not installed, prints a
/// message and returns `None`.
fn faults(texts: &[String]) -> Option<Vec<Vec<String>>> {
    let python = python::with(&["jsonschema"])?;
    let mut documents: Vec<serde_json::Value> = vec![serde_json::from_str(SCHEMA).expect("a JSON document")];
    for text in texts {
        let table: toml::Table = toml::from_str(text).expect("TOML");
        documents.push(serde_json::to_value(table).expect("a JSON value"));
    }
    let mut child = Command::new(python)
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Python runs");
    let mut input = child.stdin.take().expect("a pipe");
    input.write_all(serde_json::Value::from(documents).to_string().as_bytes()).expect("the script reads");
    drop(input);
    let output = child.wait_with_output().expect("the script ends");
    let found: Vec<Vec<String>> = serde_json::from_slice(&output.stdout).expect("a list of lists");
    assert_eq!(found.len(), texts.len());
    Some(found)
}

/// Asserts that the validator reports no error for these tables.
fn pass(tables: Vec<(String, String)>) {
    let (names, texts): (Vec<_>, Vec<_>) = tables.into_iter().unzip();
    for (name, faults) in names.iter().zip(faults(&texts).into_iter().flatten()) {
        assert_eq!(faults, Vec::<String>::new(), "{name}");
    }
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
    let mut real: Vec<_> = examples().iter().map(|(line, block)| (format!("README.md:{line}"), whole(block))).collect();
    for path in tables(&dictionaries()).into_iter().chain(tables(&dictionaries().join("profiles"))) {
        real.push((path.display().to_string(), std::fs::read_to_string(&path).expect("a table")));
    }
    pass(real);
}

#[test]
fn wrong_tables_do_not_pass() {
    let head = "lexibus = 1\n[device]\nname = \"x\"\n";
    pass(vec![("the head".into(), head.into())]);
    let chapter = |row: &str| format!("{head}[[chapters]]\n{row}");
    let wrong = [
        "[device]\nname = \"x\"\n".to_owned(),
        "lexibus = 2\n[device]\nname = \"x\"\n".to_owned(),
        "lexibus = 1\n".to_owned(),
        format!("{head}color = \"red\"\n"),
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
    ];
    for (table, faults) in wrong.iter().zip(faults(&wrong).into_iter().flatten()) {
        assert!(!faults.is_empty(), "{table}");
    }
}

#[test]
fn options_may_stand_in_any_place() {
    let table = "lexibus = 1\n[device]\nname = \"x\"\nvendor_id = \"$vendor\"\n[options.vendor]\nchoices = { a = 1 }\n\
                 default = \"a\"\n[spaces.s]\ncanopen = { sub = \"$sub\" }\n[[chapters]]\n\
                 registers.a = { reg = 1, type = \"$ty\", access = \"$access\", hidden = \"$hidden\" }\n";
    pass(vec![("options".into(), table.into())]);
}

#[test]
fn every_key_is_told_what_it_is() {
    let schema: serde_json::Value = serde_json::from_str(SCHEMA).expect("a JSON document");
    let definitions = schema["definitions"].as_object().expect("definitions");
    for (name, definition) in definitions {
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
    let text = String::from_utf8_lossy(&checked.stderr).into_owned();
    assert!(checked.status.success() && text.contains("1 file: no errors or warnings"), "{text}");
}

#[test]
fn a_new_table_is_without_fault() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let mut made_tables = Vec::new();
    for bus in ["modbus", "canopen", "ethercat"] {
        let path = folder.join(format!("{bus}.toml"));
        let shown = path.to_string_lossy().into_owned();
        let made = lexibus(&["new", "Pump \"7\" \\", "--bus", bus, "--out", &shown]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        let text = std::fs::read_to_string(&path).expect("the table");
        let options = Options::default();
        let compilation = check(Source::new(&*shown, text.clone().into_bytes()), &options);
        let list = compilation.diagnostics.list().iter();
        let messages: Vec<String> = list.map(|diagnostic| compilation.one_line(diagnostic)).collect();
        assert_eq!(messages, Vec::<String>::new());
        assert!(compilation.rust(&options.rust).is_some_and(|rust| rust.contains("Pump7")));
        let again = lexibus(&["new", "Pump", "--out", &shown]);
        assert_eq!(again.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&again.stderr).contains("exists already"));
        assert_eq!(std::fs::read_to_string(&path).expect("the table"), text);
        made_tables.push((bus.to_owned(), text));
    }
    pass(made_tables);
    let call = Command::new(env!("CARGO_BIN_EXE_lexibus")).args(["new", "Flow Meter 3"]).current_dir(&folder).output();
    assert!(call.is_ok_and(|made| made.status.success()) && folder.join("flow-meter-3.toml").is_file());
    assert_eq!(lexibus(&["new", " "]).status.code(), Some(2));
}
