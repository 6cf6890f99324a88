//! Turns the examples in `dictionaries/README.md` into complete register tables, so that tests can compile them.

#![allow(dead_code)]

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

use std::path::PathBuf;

/// Returns the folder of the dictionaries.
pub fn dictionaries() -> PathBuf {
    root::root().join("dictionaries")
}

/// Returns the TOML blocks in the documentation of the table format, each with its line number.
pub fn examples() -> Vec<(usize, String)> {
    let text = std::fs::read_to_string(dictionaries().join("README.md")).expect("the format's documentation");
    let mut blocks = Vec::new();
    let mut block: Option<(usize, String)> = None;
    for (number, line) in text.lines().enumerate() {
        match (&mut block, line) {
            (None, "```toml") => block = Some((number + 2, String::new())),
            (Some(_), "```") => blocks.extend(block.take()),
            (Some((_, text)), line) => *text += &(line.to_owned() + "\n"),
            _ => {}
        }
    }
    blocks
}

/// Items and names that the examples use without defining them.
const SURROUNDINGS: &str = r#"
[[messages]]
name = "CmdReset"
[[chapters]]
title = "What the examples refer to"
[chapters.registers]
Rloadsav = { param = 1, type = "u8", access = "wo" }
Reepsts  = { param = 2, type = "u8", access = "ro" }
"position" = { param = 3, type = "u8", access = "ro" }
"Variable address" = { param = 4, type = "u16", access = "rw" }
"Variable value" = { param = 5, type = "i32", access = "ro" }
"offset sign" = { param = 906, type = "u16", access = "rw" }
"offset high" = { param = 907, type = "u16", access = "rw" }
"offset low" = { param = 908, type = "u16", access = "rw" }
[[chapters]]
title = "Objects that the examples refer to"
[chapters.objects]
0x6040 = { name = "Controlword", type = "u16", access = "rw", pdo = "rx" }
0x6041 = { name = "Statusword", type = "u16", access = "ro", pdo = "tx" }
0x6060 = { name = "Modes of operation", type = "i8", access = "rw", pdo = "rx" }
0x60C1 = { name = "Interpolation data", code = "record" }
"0x60C1:0" = { name = "Highest sub-index", type = "u8", access = "const", default = 1 }
"0x60C1:1" = { name = "Position", type = "i32", access = "rw", pdo = "rx" }
"#;

/// Address space for examples that define none. The documentation states this default.
const SPACE: &str = "[spaces.register]\nmodbus = { table = \"holding\" }\n";

/// Completes a TOML block so that it is a valid register table.
pub fn whole(block: &str) -> String {
    if block.contains("lexibus = 1") {
        return block.to_owned();
    }
    let head = "lexibus = 1\n[device]\nname = \"Example\"\n";
    let space = if block.contains("[spaces") { "" } else { SPACE };
    let chapter = if block.starts_with("[chapters") { "[[chapters]]\n" } else { "" };
    format!("{head}{space}{chapter}{block}{SURROUNDINGS}")
}
