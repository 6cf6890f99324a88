//! Reads YAML with the scalar types and merge keys of version 1.1, because the files are written for PyYAML.

use std::collections::hash_map::Entry as Place;
use std::collections::HashMap;

use lexibus_codegen::source::{FileId, Source, Span};
use saphyr_parser::{Event, Parser, ScalarStyle, Span as Marks};

use super::tree::{At, Content, Entry, Node, Scalar, SyntaxError};

/// Maximum number of elements, including those that aliases repeat.
pub(crate) const MAX_ELEMENTS: usize = 1_000_000;

/// Maximum depth of nested lists and tables, including those that aliases repeat.
const MAX_DEPTH: usize = 64;

/// Number of bytes of a text that count as one more element.
const BYTES_OF_ELEMENT: usize = 64;

/// Parses the first document of a YAML file. An empty file is an empty table.
///
/// # Errors
///
/// Returns the first error: invalid syntax, a key that occurs twice, an alias within its own anchor, or too many elements or
/// levels. A key that is not a text, an integer or a Boolean value is an error, too.
pub fn parse(source: &Source, file: FileId) -> Result<Node, SyntaxError> {
    let mut loader = Loader::new(source.text(), file);
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

/// Converts character offsets to byte offsets. The conversion is fast if the offsets increase from call to call.
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
    /// Key of a table entry whose value follows.
    key: Option<At<String>>,
    /// Keys of a table, with the positions of their entries.
    keys: HashMap<String, Position>,
}

/// Position of an entry in a table.
struct Position {
    at: usize,
    /// True if the entry comes from a merged table.
    is_merged: bool,
}

/// An element with an anchor.
struct Anchored {
    node: Node,
    elements: usize,
    depth: usize,
}

struct Loader<'t> {
    text: &'t str,
    offsets: Offsets,
    file: FileId,
    open: Vec<Open>,
    root: Option<Node>,
    anchors: HashMap<usize, Anchored>,
    elements: usize,
}

impl<'t> Loader<'t> {
    fn new(text: &'t str, file: FileId) -> Self {
        let offsets = Offsets::default();
        Loader { text, offsets, file, open: Vec::new(), root: None, anchors: HashMap::new(), elements: 0 }
    }

    fn event(&mut self, event: Event<'_>, marks: Marks) -> Result<(), SyntaxError> {
        let start = self.offsets.of(self.text, marks.start.index());
        let end = self.offsets.of(self.text, marks.end.index());
        let span = Span::new(self.file, start, end);
        match event {
            Event::Scalar(text, style, anchor, _) => {
                self.count(elements_of(&text), span)?;
                let value = if style == ScalarStyle::Plain { plain(&text) } else { Scalar::Text(text.into_owned()) };
                self.put(Node { span, content: Content::Scalar(value) }, anchor)
            }
            Event::Alias(anchor) => self.alias(anchor, span),
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

    /// Counts elements before they are added. Fails if the file then has more than [`MAX_ELEMENTS`] elements.
    fn count(&mut self, elements: usize, span: Span) -> Result<(), SyntaxError> {
        self.elements += elements;
        if self.elements > MAX_ELEMENTS {
            let message =
                format!("the file has more than {MAX_ELEMENTS} elements, including those that aliases repeat");
            return Err(error(span, message));
        }
        Ok(())
    }

    /// Checks the depth of an element with `depth` levels at the current position.
    fn check_depth(&self, depth: usize, span: Span) -> Result<(), SyntaxError> {
        if self.open.len() + depth > MAX_DEPTH {
            return Err(error(span, format!("lists and tables are nested deeper than {MAX_DEPTH} levels")));
        }
        Ok(())
    }

    /// Adds a copy of the element with an anchor.
    fn alias(&mut self, anchor: usize, span: Span) -> Result<(), SyntaxError> {
        let incomplete = || error(span, "the anchor is not complete");
        let Anchored { elements, depth, .. } = *self.anchors.get(&anchor).ok_or_else(incomplete)?;
        self.check_depth(depth, span)?;
        self.count(elements, span)?;
        let node = self.anchors[&anchor].node.clone();
        self.put(node, 0)
    }

    fn open(&mut self, start: u32, anchor: usize, content: Content, span: Span) -> Result<(), SyntaxError> {
        self.check_depth(1, span)?;
        self.count(1, span)?;
        self.open.push(Open { start, anchor, content, key: None, keys: HashMap::new() });
        Ok(())
    }

    fn put(&mut self, node: Node, anchor: usize) -> Result<(), SyntaxError> {
        if anchor != 0 {
            let (elements, depth) = extent(&node);
            // The copy in `anchors` counts, too.
            self.count(elements, node.span)?;
            self.anchors.insert(anchor, Anchored { node: node.clone(), elements, depth });
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

/// Returns the number of elements that a text counts as.
fn elements_of(text: &str) -> usize {
    1 + text.len() / BYTES_OF_ELEMENT
}

/// Returns the number of elements in a tree, and the depth of its lists and tables.
pub(crate) fn extent(node: &Node) -> (usize, usize) {
    let sum = |(elements, depth): (usize, usize), node: &Node| {
        let (others, other) = extent(node);
        (elements + others, depth.max(1 + other))
    };
    match &node.content {
        Content::Scalar(Scalar::Text(text)) => (elements_of(text), 0),
        Content::Scalar(_) => (1, 0),
        Content::List(list) => list.iter().fold((1, 1), sum),
        Content::Table(entries) => entries
            .iter()
            .fold((1, 1), |(elements, depth), entry| sum((elements + elements_of(&entry.key), depth), &entry.value)),
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
    /// Adds an entry to a table. The key `<<` adds the entries of other tables whose keys the table does not have.
    fn insert(&mut self, key: At<String>, value: Node) -> Result<(), SyntaxError> {
        let Content::Table(entries) = &mut self.content else { return Ok(()) };
        if *key == "<<" {
            merge(entries, &mut self.keys, value);
            return Ok(());
        }
        match self.keys.entry(key.value.clone()) {
            Place::Occupied(mut position) if position.get().is_merged => {
                position.get_mut().is_merged = false;
                entries[position.get().at] = Entry { key, value };
            }
            Place::Occupied(_) => return Err(error(key.span, format!("the key `{}` occurs twice", key.value))),
            Place::Vacant(place) => {
                place.insert(Position { at: entries.len(), is_merged: false });
                entries.push(Entry { key, value });
            }
        }
        Ok(())
    }
}

/// Adds the entries of a table, or of each table in a list, whose keys are missing.
fn merge(entries: &mut Vec<Entry>, keys: &mut HashMap<String, Position>, from: Node) {
    match from.content {
        Content::Table(others) => {
            for other in others {
                if let Place::Vacant(place) = keys.entry(other.key.value.clone()) {
                    place.insert(Position { at: entries.len(), is_merged: true });
                    entries.push(other);
                }
            }
        }
        Content::List(tables) => tables.into_iter().for_each(|table| merge(entries, keys, table)),
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
        assert_eq!(message(&bomb), "the file has more than 1000000 elements, including those that aliases repeat");
        assert_eq!(message(&"[".repeat(100)), DEEP);
    }

    const DEEP: &str = "lists and tables are nested deeper than 64 levels";

    #[test]
    fn aliases_count_as_what_they_repeat() {
        let message = |text: &str| tree(text).unwrap_err().message;
        let many = "the file has more than 1000000 elements, including those that aliases repeat";
        // Each line adds 30 levels.
        let line = |level: usize| format!("a{level}: &a{level} {}*a{}{}\n", "[".repeat(30), level - 1, "]".repeat(30));
        let nested = |lines| "a0: &a0 1\n".to_owned() + &(1..=lines).map(line).collect::<String>();
        assert!(tree(&nested(2)).is_ok());
        assert_eq!(message(&nested(3)), DEEP);
        // The root table, three lists and the 60 levels of the anchor are 64 levels.
        assert!(tree(&(nested(2) + "a: [[[*a2]]]\n")).is_ok());
        assert_eq!(message(&(nested(2) + "a: [[[[*a2]]]]\n")), DEEP);
        // 100 000 copies of a text or key with 10 000 bytes.
        let (long, copies) = ("x".repeat(10_000), "*a, ".repeat(100_000));
        assert_eq!(message(&format!("a: &a {long}\nb: [{copies}]\n")), many);
        assert_eq!(message(&format!("a: &a {{{long}: 1}}\nb: [{copies}]\n")), many);
        // 60 nested anchors, each with a copy of 20 000 elements.
        let anchors: String = (0..60).map(|level| format!("&b{level} [")).collect();
        assert_eq!(message(&format!("a: {anchors}{}{}\n", "1, ".repeat(20_000), "]".repeat(60))), many);
    }

    /// With a search through the entries for each key, this test would take minutes.
    #[test]
    fn tables_can_be_long() {
        let keys = |range: std::ops::Range<usize>| range.map(|key| format!("  k{key}: 1\n")).collect::<String>();
        let text = format!("base: &base\n{}all:\n  <<: *base\n{}", keys(0..100_000), keys(50_000..200_000));
        let Content::Table(entries) = tree(&text).unwrap().content else { panic!("a table") };
        let Content::Table(all) = &entries[1].value.content else { panic!("a table") };
        assert_eq!(all.len(), 200_000);
        assert!(all.iter().enumerate().all(|(at, entry)| entry.key.value == format!("k{at}")));
    }
}
