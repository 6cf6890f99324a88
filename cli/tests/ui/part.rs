//! Selects the parts of an output that a test case shows.
//!
//! The settings name a part by a text in one of its lines. The extent of the part depends on the form of the output:
//!
//! - Rust, XML and JSON: the line with the text, all lines that are indented below it, and the closing line. In Rust, the part
//!   includes the documentation and attributes above the item. The text must be one or more whole words in the item's first
//!   line (`SPEED`, `fn speed`, `struct RxPdo1`). A `^` at the end of the text selects the enclosing element, and `^^` the next
//!   outer element.
//! - EDS, Markdown and plain text: the paragraph that contains the text, up to the next empty line. In a Markdown table, the
//!   part consists of the header and the rows that contain the text.

use std::ops::Range;

/// The structure of an output.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Rust code as formatted by `prettyplease`.
    Rust,
    /// Indented lines.
    Indented,
    /// Paragraphs.
    Paragraphs,
}

/// Returns the named parts of `text`. If no part is named, returns the whole text.
///
/// # Errors
///
/// Returns an error if `text` does not contain a named part.
pub fn parts(text: &str, form: Form, wanted: &[String]) -> Result<String, String> {
    if wanted.is_empty() {
        return Ok(text.to_owned());
    }
    let lines: Vec<&str> = text.lines().collect();
    let mut chosen = Vec::new();
    for part in wanted {
        let found = find(&lines, form, part);
        if found.is_empty() {
            return Err(format!("the output has no `{part}`:\n{text}"));
        }
        for lines in found {
            if !chosen.contains(&lines) {
                chosen.push(lines);
            }
        }
    }
    let texts: Vec<String> = chosen.iter().map(|block| block.join("\n") + "\n").collect();
    let between = if form == Form::Paragraphs { "\n" } else { "" };
    Ok(texts.join(between))
}

/// Returns the lines of each block that `part` names.
fn find<'t>(lines: &[&'t str], form: Form, part: &str) -> Vec<Vec<&'t str>> {
    let text = part.trim_end_matches('^');
    let levels = part.len() - text.len();
    let mut found: Vec<Vec<&str>> = Vec::new();
    let mut behind = 0;
    for at in 0..lines.len() {
        let is_match = if form == Form::Rust { begins_item(lines[at], text) } else { lines[at].contains(text) };
        if at < behind || !is_match {
            continue;
        }
        let block = match form {
            Form::Paragraphs => {
                let block = paragraph(lines, at);
                behind = block.end;
                found.push(if lines[at].starts_with('|') { rows(&lines[block], text) } else { lines[block].to_vec() });
                continue;
            }
            _ => indented(lines, outer(lines, at, levels), form),
        };
        behind = block.end;
        found.push(lines[block].to_vec());
    }
    found
}

/// Returns whether the line begins a Rust item and contains `text` as whole words.
fn begins_item(line: &str, text: &str) -> bool {
    let starts = ["pub ", "impl", "const ", "static ", "fn ", "type ", "mod ", "use "];
    let line = line.trim_start();
    if !starts.iter().any(|start| line.starts_with(start)) {
        return false;
    }
    let head = line.split(" = ").next().unwrap_or(line);
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    head.match_indices(text).any(|(at, _)| {
        !head[..at].chars().next_back().is_some_and(is_word)
            && !head[at + text.len()..].chars().next().is_some_and(is_word)
    })
}

/// Goes outward from the line `at` by `levels` levels, and returns the first line of the enclosing element.
fn outer(lines: &[&str], at: usize, levels: usize) -> usize {
    (0..levels).fold(at, |at, _| {
        let depth = indent(lines[at]);
        (0..at).rev().find(|&above| !lines[above].is_empty() && indent(lines[above]) < depth).unwrap_or(at)
    })
}

/// Returns the lines of the element that starts at line `at`: the indented lines below and the closing line. In Rust, the
/// documentation and attributes above are included.
fn indented(lines: &[&str], at: usize, form: Form) -> Range<usize> {
    let depth = indent(lines[at]);
    let is_above =
        |line: &str| indent(line) == depth && ["///", "#["].iter().any(|mark| line.trim_start().starts_with(mark));
    let mut start = at;
    while form == Form::Rust && start > 0 && is_above(lines[start - 1]) {
        start -= 1;
    }
    let below = lines[at + 1..].iter().take_while(|line| line.is_empty() || indent(line) > depth).count();
    let closes = |line: &&&str| {
        let line = line.trim_start();
        line.starts_with(['}', ')', ']']) || line.starts_with("</")
    };
    let end = at + 1 + below;
    start..end + usize::from(below > 0 && lines.get(end).filter(closes).is_some())
}

/// Returns the paragraph that contains the line `at`.
fn paragraph(lines: &[&str], at: usize) -> Range<usize> {
    let start = lines[..at].iter().rposition(|line| line.is_empty()).map_or(0, |empty| empty + 1);
    let end = lines[at..].iter().position(|line| line.is_empty()).map_or(lines.len(), |empty| at + empty);
    start..end
}

/// Returns the header of a Markdown table and the rows that contain `text`.
fn rows<'t>(table: &[&'t str], text: &str) -> Vec<&'t str> {
    let head = table.iter().position(|line| line.starts_with('|')).unwrap_or(0);
    let body = table[head..].iter().skip(2).filter(|line| line.contains(text));
    table[head..].iter().take(2).chain(body).copied().collect()
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}
