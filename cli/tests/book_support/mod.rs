//! The blocks of code of the book's chapters.

use std::path::{Path, PathBuf};

/// A block of code.
pub struct Block {
    /// The line of its first word.
    pub line: usize,
    /// What stands behind the fence, such as `toml`.
    pub kind: String,
    /// The file that it is, where the comment in front of it says so: `<!-- file: NAME -->`.
    pub file: Option<String>,
    /// The example that it is the same as: `<!-- file: NAME = EXAMPLE -->`.
    pub same_as: Option<String>,
    /// Its lines.
    pub text: String,
}

/// The folder of the book.
pub fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|own| own.join("docs"))
        .find(|own| own.is_dir())
        .expect("docs")
}

/// A chapter by its name.
pub fn chapter(name: &str) -> Vec<Block> {
    let path = docs().join("src").join(name);
    blocks(&std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// The blocks between fences of a text, in their order.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    let mut before = "";
    for (number, line) in text.lines().enumerate() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(kind)) => {
                let (file, same_as) = file_of(before);
                open = Some(Block { line: number + 2, kind: kind.into(), file, same_as, text: String::new() });
            }
            (Some(_), Some("")) => blocks.extend(open.take()),
            (Some(block), _) => block.text += &format!("{line}\n"),
            (None, None) => {}
        }
        before = line;
    }
    assert!(open.is_none(), "a block has no end");
    blocks
}

/// What the comment in front of a block says of it.
fn file_of(line: &str) -> (Option<String>, Option<String>) {
    let Some(rest) = line.strip_prefix("<!-- file: ").and_then(|rest| rest.strip_suffix(" -->")) else {
        return (None, None);
    };
    match rest.split_once(" = ") {
        Some((name, example)) => (Some(name.into()), Some(example.into())),
        None => (Some(rest.into()), None),
    }
}
