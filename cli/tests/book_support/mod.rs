//! Reads the code blocks of the book.

use std::path::{Path, PathBuf};

/// A code block of a chapter.
pub struct Block {
    /// Line number of the first line in the block.
    pub line: usize,
    /// Text after the opening fence, such as `toml`.
    pub kind: String,
    /// File name from the comment above the block: `<!-- file: NAME -->`.
    pub file: Option<String>,
    /// Name of the example file that must have the same content as the block, from the comment `<!-- file: NAME =
    /// EXAMPLE -->`.
    pub same_as: Option<String>,
    pub text: String,
}

/// Returns the path of the book's folder.
pub fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|folder| folder.join("docs"))
        .find(|folder| folder.is_dir())
        .expect("docs")
}

/// Returns the code blocks of a chapter.
pub fn chapter(name: &str) -> Vec<Block> {
    let path = docs().join("src").join(name);
    blocks(&std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// Returns the code blocks of a Markdown text in their order.
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
    assert!(open.is_none(), "a code block is not closed");
    blocks
}

/// Returns the file name and the example name from the comment above a block.
fn file_of(line: &str) -> (Option<String>, Option<String>) {
    let Some(rest) = line.strip_prefix("<!-- file: ").and_then(|rest| rest.strip_suffix(" -->")) else {
        return (None, None);
    };
    match rest.split_once(" = ") {
        Some((name, example)) => (Some(name.into()), Some(example.into())),
        None => (Some(rest.into()), None),
    }
}
