//! Reads YAML as PyYAML does, because the files are written for it: version 1.1, with merge keys.

use std::collections::{HashMap, HashSet};

use lexibus_codegen::source::{FileId, Source, Span};
use saphyr_parser::{Event, Parser, ScalarStyle, Span as Marks};

use super::tree::{At, Content, Entry, Node, Scalar, SyntaxError};

/// Maximum number of elements after the expansion of aliases.
const MAX_NODES: usize = 1_000_000;

/// Maximum depth of nested lists and tables.
const MAX_DEPTH: usize = 64;

/// Parses the first document of a YAML file. An empty file is an empty table.
///
/// # Errors
///
/// Returns the first error: invalid syntax, a key that is not a text or number, a key that occurs twice, or too many elements.
pub fn parse(source: &Source, file: FileId) -> Result<Node, SyntaxError> {
    let mut loader = Loader { text: source.text(), offsets: Offsets::default(), file, ..Loader::new() };
    for event in Parser::new_from_str(source.text()) {
        let (event, marks) = event.map_err(|error| {
            let at = loader.offsets.of(loader.text, error.marker().index());
            SyntaxError { span: Span::new(file, at, at + 1), message: error.info().to_owned() }
        })?;
        if matches!(event, Event::DocumentEnd) {
            break;
        }
        loader.event(event, marks)?;
    }
    let empty = Node { span: Span::new(file, 0, 0), content: Content::Table(Vec::new()) };
    Ok(match loader.root {
        Some(Node { content: Content::Scalar(Scalar::Null), .. }) | None => empty,
        Some(root) => root,
    })
}

/// Converts character offsets, which increase from call to call, to byte offsets.
#[derive(Default)]
struct Offsets {
    characters: usize,
    bytes: usize,
}

impl Offsets {
    fn of(&mut self, text: &str, characters: usize) -> u32 {
        if characters < self.characters {
            *self = Offsets::default();
        }
        let skipped = characters - self.characters;
        let rest = &text[self.bytes..];
        let bytes = rest.char_indices().nth(skipped).map_or(rest.len(), |(at, _)| at);
        (self.characters, self.bytes) = (characters, self.bytes + bytes);
        self.bytes as u32
    }
}

/// A list or table that is not closed yet.
struct Open {
    start: u32,
    anchor: usize,
    content: Content,
    /// Key of a table whose value follows.
    key: Option<At<String>>,
    /// Keys of a table, except those of merged tables.
    keys: HashSet<String>,
}

struct Loader<'t> {
    text: &'t str,
    offsets: Offsets,
    file: FileId,
    open: Vec<Open>,
    root: Option<Node>,
    anchors: HashMap<usize, Node>,
    nodes: usize,
}

impl Loader<'_> {
    fn new() -> Self {
        let file = FileId(0);
        let offsets = Offsets::default();
        Loader { text: "", offsets, file, open: Vec::new(), root: None, anchors: HashMap::new(), nodes: 0 }
    }

    fn event(&mut self, event: Event<'_>, marks: Marks) -> Result<(), SyntaxError> {
        let start = self.offsets.of(self.text, marks.start.index());
        let end = self.offsets.of(self.text, marks.end.index());
        let span = Span::new(self.file, start, end);
        match event {
            Event::Scalar(text, style, anchor, _) => {
                let value = if style == ScalarStyle::Plain { plain(&text) } else { Scalar::Text(text.into_owned()) };
                self.put(Node { span, content: Content::Scalar(value) }, anchor)
            }
            Event::Alias(anchor) => {
                let found = self.anchors.get(&anchor).cloned();
                let node = found.ok_or_else(|| error(span, "the anchor is not complete"))?;
                self.nodes += size(&node);
                self.put(node, 0)
            }
            Event::SequenceStart(anchor, _) => self.open(start, anchor, Content::List(Vec::new()), span),
            Event::MappingStart(anchor, _) => self.open(start, anchor, Content::Table(Vec::new()), span),
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(open) = self.open.pop() else { return Ok(()) };
                let node =
                    Node { span: Span::new(self.file, open.start, start.max(open.start)), content: open.content };
                self.put(node, open.anchor)
            }
            _ => Ok(()),
        }
    }

    fn open(&mut self, start: u32, anchor: usize, content: Content, span: Span) -> Result<(), SyntaxError> {
        if self.open.len() == MAX_DEPTH {
            return Err(error(span, format!("lists and tables are nested deeper than {MAX_DEPTH} levels")));
        }
        self.open.push(Open { start, anchor, content, key: None, keys: HashSet::new() });
        Ok(())
    }

    fn put(&mut self, node: Node, anchor: usize) -> Result<(), SyntaxError> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(error(node.span, format!("the file has more than {MAX_NODES} elements")));
        }
        if anchor != 0 {
            self.anchors.insert(anchor, node.clone());
        }
        let Some(open) = self.open.last_mut() else {
            self.root.get_or_insert(node);
            return Ok(());
        };
        match (&mut open.content, open.key.take()) {
            (Content::List(list), _) => list.push(node),
            (Content::Table(_), None) => open.key = Some(key(node)?),
            (Content::Table(_), Some(key)) => open.insert(key, node)?,
            (Content::Scalar(_), _) => {}
        }
        Ok(())
    }
}

fn error(span: Span, message: impl Into<String>) -> SyntaxError {
    SyntaxError { span, message: message.into() }
}

/// Returns the number of elements in a tree.
fn size(node: &Node) -> usize {
    1 + match &node.content {
        Content::Scalar(_) => 0,
        Content::List(list) => list.iter().map(size).sum(),
        Content::Table(entries) => entries.iter().map(|entry| size(&entry.value)).sum(),
    }
}

fn key(node: Node) -> Result<At<String>, SyntaxError> {
    let text = match &node.content {
        Content::Scalar(Scalar::Text(text)) => text.clone(),
        Content::Scalar(Scalar::Integer(number)) => number.to_string(),
        Content::Scalar(Scalar::Bool(flag)) => flag.to_string(),
        _ => return Err(error(node.span, "a key is neither a text nor an integer")),
    };
    Ok(At::new(text, node.span))
}

impl Open {
    /// Adds an entry to a table. The key `<<` adds the entries of other tables that the table does not have.
    fn insert(&mut self, key: At<String>, value: Node) -> Result<(), SyntaxError> {
        let Content::Table(entries) = &mut self.content else { return Ok(()) };
        if *key == "<<" {
            merge(entries, value);
            return Ok(());
        }
        if !self.keys.insert(key.value.clone()) {
            return Err(error(key.span, format!("the key `{}` occurs twice", key.value)));
        }
        match entries.iter_mut().find(|entry| entry.key.value == key.value) {
            Some(merged) => *merged = Entry { key, value },
            None => entries.push(Entry { key, value }),
        }
        Ok(())
    }
}

/// Adds the entries of a table, or of each table in a list, whose keys are missing.
fn merge(entries: &mut Vec<Entry>, from: Node) {
    match from.content {
        Content::Table(others) => {
            for other in others {
                if entries.iter().all(|entry| entry.key.value != other.key.value) {
                    entries.push(other);
                }
            }
        }
        Content::List(tables) => tables.into_iter().for_each(|table| merge(entries, table)),
        Content::Scalar(_) => {}
    }
}

/// Returns the value of a scalar without quotation marks, with the types of YAML 1.1.
fn plain(text: &str) -> Scalar {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Scalar::Null,
        "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" => return Scalar::Bool(true),
        "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" => return Scalar::Bool(false),
        _ => {}
    }
    let real = || text.parse().ok().filter(|_| text.contains('.') && !text.contains(char::is_alphabetic));
    integer(text).map(Scalar::Integer).or_else(|| real().map(Scalar::Real)).unwrap_or_else(|| Scalar::Text(text.into()))
}

/// Reads an integer of YAML 1.1: decimal, `0x…`, `0b…`, or octal with a leading zero.
fn integer(text: &str) -> Option<i128> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    if !digits.starts_with(|first: char| first.is_ascii_digit()) {
        return None;
    }
    let digits = digits.replace('_', "");
    let radix = |radix, digits: &str| i128::from_str_radix(digits, radix).ok();
    let number = match digits.strip_prefix('0') {
        Some(rest) if rest.starts_with('x') => radix(16, &rest[1..]),
        Some(rest) if rest.starts_with('b') => radix(2, &rest[1..]),
        Some(rest) if !rest.is_empty() => radix(8, rest),
        _ => radix(10, &digits),
    };
    number.map(|number| sign * number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(text: &str) -> Result<Node, SyntaxError> {
        parse(&Source::new("bus.yml", text.into()), FileId(0))
    }

    fn scalar(text: &str) -> Scalar {
        match tree(&format!("a: {text}")).unwrap().content {
            Content::Table(mut entries) => match entries.remove(0).value.content {
                Content::Scalar(scalar) => scalar,
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn scalars_have_the_types_of_yaml_1_1() {
        assert_eq!(scalar("0x1A"), Scalar::Integer(26));
        assert_eq!(scalar("-12"), Scalar::Integer(-12));
        assert_eq!(scalar("010"), Scalar::Integer(8));
        assert_eq!(scalar("1_000"), Scalar::Integer(1000));
        assert_eq!(scalar("1.5"), Scalar::Real(1.5));
        assert_eq!(scalar("yes"), Scalar::Bool(true));
        assert_eq!(scalar("\"10\""), Scalar::Text("10".into()));
        assert_eq!(scalar("~/rpdo"), Scalar::Text("~/rpdo".into()));
        assert_eq!(scalar(""), Scalar::Null);
    }

    #[test]
    fn spans_are_byte_offsets() {
        let text = "# Gerät\nname: 'x'\n";
        let Content::Table(entries) = tree(text).unwrap().content else { panic!("a table") };
        assert_eq!(&text[entries[0].key.span.range()], "name");
        assert_eq!(&text[entries[0].value.span.range()], "'x'");
    }

    #[test]
    fn merge_keys_add_missing_entries() {
        let text = "base: &base {a: 1, b: 2}\none:\n  <<: *base\n  b: 3\n";
        let Content::Table(entries) = tree(text).unwrap().content else { panic!("a table") };
        let Content::Table(one) = &entries[1].value.content else { panic!("a table") };
        let values: Vec<_> = one.iter().map(|entry| (entry.key.value.as_str(), entry.value.described())).collect();
        assert_eq!(values, [("a", "the integer 1".to_owned()), ("b", "the integer 3".to_owned())]);
    }

    #[test]
    fn faults_are_errors() {
        let message = |text: &str| tree(text).unwrap_err().message;
        assert_eq!(message("a: 1\na: 2\n"), "the key `a` occurs twice");
        assert!(message("a: [1\n").contains("while parsing"), "{}", message("a: [1\n"));
        let mut bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n".to_owned();
        for level in 1..12 {
            let list = format!("*a{}, ", level - 1).repeat(10);
            bomb += &format!("a{level}: &a{level} [{list}]\n");
        }
        assert_eq!(message(&bomb), "the file has more than 1000000 elements");
        assert!(message(&"[".repeat(100)).contains("nested deeper"));
    }
}
