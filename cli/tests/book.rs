//! Tests the code blocks of the book that are not Rust. Commands must print the documented output, and register tables
//! must be valid.

mod book_support;
#[cfg(unix)]
mod bus_support;
#[path = "../../codegen/tests/table_support/mod.rs"]
mod table_support;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use book_support::{chapter, docs, Block};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::Severity;
use lexibus_codegen::source::Source;
use table_support::whole;

/// Programs in the book that the test does not run. Some of them take too long or may not be installed.
const OTHERS: [&str; 5] = ["cargo", "cd", "cp", "mdbook", "xdg-open"];

/// Returns the file names of the book's chapters.
fn chapters() -> Vec<String> {
    let entries = std::fs::read_dir(docs().join("src")).expect("the chapters");
    let names = entries.map(|entry| entry.expect("a chapter").file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".md")).collect();
    names.sort();
    names
}

/// Creates the working directory of a chapter. The folder contains the book's examples, the dictionaries, the example
/// network, and some test data.
fn folder(name: &str) -> PathBuf {
    let root = docs().join("..");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    for shared in ["examples", "dictionaries"] {
        let from = if shared == "examples" { docs().join(shared) } else { root.join(shared) };
        std::fs::create_dir(folder.join(shared)).expect("a folder");
        for entry in std::fs::read_dir(from).expect("descriptions") {
            let path = entry.expect("a description").path();
            if path.is_file() {
                copy(&path, &folder.join(shared));
            }
        }
    }
    std::fs::create_dir(folder.join("network")).expect("a folder");
    for entry in std::fs::read_dir(root.join("examples/network")).expect("the example network") {
        copy(&entry.expect("a file").path(), &folder.join("network"));
    }
    copy(&root.join("tests/data/coupler.esi.xml"), &folder);
    copy(&root.join("dictionaries/demo-drive.eds"), &folder);
    // Create two versions of a description for `lexibus diff`.
    let old = std::fs::read_to_string(docs().join("examples/pump.eds")).expect("an example");
    let new =
        old.replace("ParameterName=Speed\nObjectType=0x7\nDataType=0x0006", "ParameterName=Speed\nDataType=0x0003");
    assert_ne!(old, new);
    std::fs::write(folder.join("old.eds"), old).expect("a description");
    std::fs::write(folder.join("new.eds"), new).expect("a description");
    folder
}

fn copy(path: &Path, folder: &Path) {
    let name = path.file_name().expect("a name");
    std::fs::copy(path, folder.join(name)).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

/// Splits a command line into words. Text in double quotes is one word.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (at, part) in line.split('"').enumerate() {
        match at % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    words
}

/// Runs a command line of the book in `folder`. Returns `None` if the program is one of [`OTHERS`], which the test does
/// not run.
fn run(line: &str, folder: &Path) -> Option<Output> {
    let words = words(line);
    let (program, arguments) = words.split_first()?;
    if program != "lexibus" {
        assert!(OTHERS.contains(&program.as_str()), "the book uses an unknown program: {line}");
        return None;
    }
    let arguments = arguments.iter().map(|argument| on_simulated_bus(argument));
    let mut command = Command::new(env!("CARGO_BIN_EXE_lexibus"));
    Some(command.args(arguments).current_dir(folder).output().expect("lexibus runs"))
}

/// Replaces the bus of an example with a bus that has a simulated device.
#[cfg(unix)]
fn on_simulated_bus(argument: &str) -> String {
    static ADAPTER: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    static SERVER: std::sync::OnceLock<u16> = std::sync::OnceLock::new();
    if argument.contains("/dev/ttyACM0") {
        let adapter = ADAPTER.get_or_init(|| bus_support::adapter(std::time::Duration::ZERO));
        return argument.replace("/dev/ttyACM0", adapter);
    }
    if argument.contains("127.0.0.1:1502") {
        let port = SERVER.get_or_init(bus_support::modbus_server);
        return argument.replace("1502", &port.to_string());
    }
    argument.to_owned()
}

#[cfg(not(unix))]
fn on_simulated_bus(argument: &str) -> String {
    argument.to_owned()
}

/// Returns the output lines of a command without trailing whitespace.
fn printed(output: &Output) -> Vec<String> {
    let text = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    let text = String::from_utf8(text).expect("UTF-8");
    text.trim_end().lines().map(|line| line.trim_end().to_owned()).collect()
}

/// Returns whether the lines match the expected lines. An expected line `…` matches any number of lines.
fn agrees(lines: &[String], expected: &[&str]) -> bool {
    match expected.split_first() {
        None => lines.is_empty(),
        Some((&"…", rest)) => (0..=lines.len()).any(|skipped| agrees(&lines[skipped..], rest)),
        Some((first, rest)) => lines.first().is_some_and(|line| line == first) && agrees(&lines[1..], rest),
    }
}

/// Runs the commands of a block and returns their number. Each command must succeed, unless `exit code 1` is in
/// its comment.
fn commands(block: &Block, folder: &Path, position: &str) -> usize {
    let mut count = 0;
    for line in block.text.replace("\\\n", " ").lines().filter(|line| !line.trim().is_empty()) {
        let (command, comment) = line.split_once(" #").unwrap_or((line, ""));
        let Some(output) = run(command, folder) else { continue };
        let expected = if comment.contains("exit code 1") { 1 } else { 0 };
        assert_eq!(output.status.code(), Some(expected), "{position}: {line}\n{}", printed(&output).join("\n"));
        count += 1;
    }
    count
}

/// Runs the commands after `$` in a block, compares their output with the block, and returns the number of commands.
fn sessions(block: &Block, folder: &Path, position: &str) -> usize {
    let mut count = 0;
    for session in block.text.split("$ ").skip(1) {
        let (command, expected) = session.split_once('\n').expect("the block does not start with a command");
        let Some(output) = run(command, folder) else { continue };
        let (lines, expected) = (printed(&output), expected.trim_end().lines().map(str::trim_end).collect::<Vec<_>>());
        assert!(agrees(&lines, &expected), "{position}: {command}\n{}", lines.join("\n"));
        count += 1;
    }
    count
}

#[test]
fn commands_run_and_print_what_stands_there() {
    let mut count = 0;
    for name in chapters() {
        let folder = folder(&name);
        for block in chapter(&name) {
            let position = format!("{name}:{}", block.line);
            if let Some(file) = &block.file {
                std::fs::create_dir_all(folder.join(file).parent().expect("a folder")).expect("a folder");
                std::fs::write(folder.join(file), on_simulated_bus(&block.text)).expect("a file of the book");
            }
            if let Some(example) = &block.same_as {
                let path = docs().join("examples").join(example);
                assert_eq!(block.text, std::fs::read_to_string(path).expect("an example"), "{position}: {example}");
            }
            count += match block.kind.as_str() {
                "sh" => commands(&block, &folder, &position),
                "console" => sessions(&block, &folder, &position),
                _ => 0,
            };
        }
    }
    assert!(count > 30, "{count} commands");
}

/// Checks the register tables of the book. Tables that the book saves to files are skipped, because commands in the
/// book check them. `network.md` is skipped, because its TOML blocks are network files.
#[test]
fn tables_are_tables() {
    let mut count = 0;
    for name in chapters() {
        for block in
            chapter(&name).iter().filter(|block| block.kind == "toml" && block.file.is_none() && name != "network.md")
        {
            let compilation = check(Source::new(name.clone(), whole(&block.text).into()), &Options::default());
            let errors =
                compilation.diagnostics.list().iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
            let errors: Vec<String> = errors.map(|diagnostic| compilation.one_line(diagnostic)).collect();
            assert_eq!(errors, Vec::<String>::new(), "{name}:{}", block.line);
            count += 1;
        }
    }
    assert!(count > 0, "no table");
}

#[test]
fn the_catalog_of_codes_is_todays() {
    let output = run("lexibus explain --format markdown", &docs()).expect("an output");
    let text = std::fs::read_to_string(docs().join("src/lints.md")).expect("the catalog");
    let is_same = String::from_utf8(output.stdout).expect("UTF-8") == text;
    assert!(is_same, "docs/src/lints.md is stale: tests/bindings.sh writes it again");
}

/// The README must show the output of its first command.
#[test]
fn the_readme_shows_what_its_first_command_prints() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = std::fs::read_to_string(root.join("README.md")).expect("the README");
    let start = "cargo run -p lexibus-cli -- ";
    let command = readme.lines().find_map(|line| line.trim().strip_prefix(start)).expect("the first command");
    let output = run(&format!("lexibus {command}"), &root).expect("lexibus runs");
    assert!(output.status.success());
    for line in printed(&output) {
        assert!(readme.contains(&format!("    {line}\n")), "the README lacks: {line}");
    }
}
