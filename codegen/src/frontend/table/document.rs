//! Parses TOML into a tree of values with their byte ranges.
//!
//! The parser reads some statements at a time. If it read the whole file at once, its tokens would need more memory than the tree.

use std::borrow::Cow;
use std::cmp::Ordering;

use toml_datetime::Datetime;
use toml_parser::decoder::{Encoding, ScalarKind};
use toml_parser::lexer::{Token, TokenKind};
use toml_parser::parser::{self, Event, EventKind, EventReceiver, RecursionGuard, ValidateWhitespace};
use toml_parser::{ErrorSink, ParseError, Source, Span};

use super::at::At;
use crate::collections::HashMap;

/// Maximum depth of nested arrays and inline tables, and maximum number of parts of a header or of the nested keys around a value.
/// Functions that call themselves for each level of the tree rely on these limits.
const MAX_DEPTH: u32 = 80;

/// Number of tokens after which the parser reads the statements that are complete.
const MIN_TOKENS: usize = 256;

/// Number of entries above which a table has an index of its keys.
const MAX_SEARCHED: usize = 16;

/// TOML value with its byte range.
pub type Node<'a> = At<Value<'a>>;

/// Key of a table with its byte range.
pub type Key<'a> = At<Cow<'a, str>>;

/// TOML value.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// String.
    Text(Cow<'a, str>),
    /// Integer: its digits with an optional sign, and its radix.
    Integer(Cow<'a, str>, u32),
    /// Floating-point number as text.
    Float(Cow<'a, str>),
    /// Boolean.
    Boolean(bool),
    /// Date or time.
    Date,
    /// Array. The elements of an array of tables have the kind [`TableKind::Header`].
    List(Vec<Node<'a>>),
    /// Table.
    Table(Table<'a>),
}

impl<'a> Value<'a> {
    /// Returns the table, or `None` for any other value.
    pub fn as_table(&self) -> Option<&Table<'a>> {
        match self {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Returns the table that a path through this value extends: the table itself, or the last one of an array of
    /// tables. Returns `None` if no path can extend the value.
    fn extensible(&mut self) -> Option<&mut Table<'a>> {
        match self {
            Value::Table(table) => Some(table).filter(|table| table.kind != TableKind::Inline),
            Value::List(list) if list.last().is_some_and(has_header) => list.last_mut()?.value.extensible(),
            _ => None,
        }
    }

    /// Returns the name of the type for messages.
    fn kind(&self) -> &'static str {
        match self {
            Value::Text(_) => "string",
            Value::Integer(..) => "integer",
            Value::Float(_) => "float",
            Value::Boolean(_) => "boolean",
            Value::Date => "datetime",
            Value::List(_) => "array",
            Value::Table(Table { kind: TableKind::Inline, .. }) => "inline table",
            Value::Table(_) => "table",
        }
    }
}

/// The way in which the file defines a table. It decides whether another statement can extend the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TableKind {
    /// By the header of a table within this table.
    #[default]
    Implicit,
    /// By its own header.
    Header,
    /// By a dotted key.
    Dotted,
    /// In braces.
    Inline,
}

/// TOML table with its entries in the order of the file.
#[derive(Clone, Debug, Default)]
pub struct Table<'a> {
    entries: Vec<(Key<'a>, Node<'a>)>,
    /// Positions of the entries by key, if the table has more than [`MAX_SEARCHED`] entries.
    index: Option<Box<HashMap<Cow<'a, str>, usize>>>,
    kind: TableKind,
}

impl<'a> Table<'a> {
    fn new(kind: TableKind) -> Self {
        Table { kind, ..Table::default() }
    }

    fn position(&self, key: &str) -> Option<usize> {
        match &self.index {
            Some(index) => index.get(key).copied(),
            None => self.entries.iter().position(|(known, _)| known.value == key),
        }
    }

    /// Returns the entries in the order of the file.
    pub fn iter(&self) -> impl Iterator<Item = &(Key<'a>, Node<'a>)> {
        self.entries.iter()
    }

    /// Returns the values in the order of the file.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut Node<'a>> {
        self.entries.iter_mut().map(|(_, value)| value)
    }

    /// Returns the entries in the order of the file.
    pub fn into_entries(self) -> Vec<(Key<'a>, Node<'a>)> {
        self.entries
    }

    /// Returns the value of `key`.
    pub fn get(&self, key: &str) -> Option<&Node<'a>> {
        self.position(key).map(|at| &self.entries[at].1)
    }

    /// Returns the value of `key`.
    pub fn get_mut(&mut self, key: &str) -> Option<&mut Node<'a>> {
        self.position(key).map(|at| &mut self.entries[at].1)
    }

    /// Removes `key` and returns its value.
    pub fn remove(&mut self, key: &str) -> Option<Node<'a>> {
        let at = self.position(key)?;
        self.index = None;
        Some(self.entries.remove(at).1)
    }

    /// Renames the entry `from` to `to`.
    pub fn rename(&mut self, from: &str, to: &str) {
        if let Some(at) = self.position(from) {
            self.index = None;
            self.entries[at].0.value = Cow::Owned(to.to_owned());
        }
    }

    /// Adds an entry whose key the table does not have.
    fn push(&mut self, key: Key<'a>, value: Node<'a>) {
        let at = self.entries.len();
        if let Some(index) = &mut self.index {
            index.insert(key.value.clone(), at);
        }
        self.entries.push((key, value));
        if at == MAX_SEARCHED {
            let keys = self.entries.iter().enumerate().map(|(at, (key, _))| (key.value.clone(), at));
            self.index = Some(Box::new(keys.collect()));
        }
    }

    /// Adds an entry, or reports that the table already has its key.
    fn add(&mut self, key: Key<'a>, value: Node<'a>, errors: &mut dyn ErrorSink) {
        match self.position(&key.value) {
            Some(_) => duplicate(&key, errors),
            None => self.push(key, value),
        }
    }

    /// Returns the table at the end of a path, and creates the tables that are missing. `created` is the kind of these
    /// tables: [`TableKind::Implicit`] for the path of a header, [`TableKind::Dotted`] for that of a dotted key.
    fn descend(
        &mut self,
        path: impl Iterator<Item = Key<'a>>,
        created: TableKind,
        errors: &mut dyn ErrorSink,
    ) -> Option<&mut Table<'a>> {
        let (of_header, mut table) = (created == TableKind::Implicit, self);
        for key in path {
            let at = table.position(&key.value).unwrap_or(table.entries.len());
            if at == table.entries.len() {
                let (start, end) = (key.start, key.end);
                table.push(key.clone(), At { value: Value::Table(Table::new(created)), start, end });
            }
            let value = &mut table.entries[at].1.value;
            let kind = value.kind();
            let Some(inner) = value.extensible() else {
                let message = format!("cannot extend value of type {kind} with a dotted key");
                errors.report_error(ParseError::new(message).with_unexpected(span_of(&key)));
                return None;
            };
            if !of_header {
                if inner.kind == TableKind::Header {
                    duplicate(&key, errors);
                    return None;
                }
                inner.kind = TableKind::Dotted;
            }
            table = inner;
        }
        Some(table)
    }
}

fn has_header(node: &Node<'_>) -> bool {
    node.value.as_table().is_some_and(|table| table.kind == TableKind::Header)
}

fn duplicate(key: &Key<'_>, errors: &mut dyn ErrorSink) {
    errors.report_error(ParseError::new("duplicate key").with_unexpected(span_of(key)));
}

fn span_of<T>(at: &At<T>) -> Span {
    Span::new_unchecked(at.start as usize, at.end as usize)
}

fn at<T>(value: T, span: Span) -> At<T> {
    At { value, start: span.start() as u32, end: span.end() as u32 }
}

/// Parses a file. If there are errors, the table is incomplete.
pub fn parse(text: &str) -> (Table<'_>, Vec<ParseError>) {
    let (table, errors) = parse_parts(text, MIN_TOKENS);
    // A surplus bracket can end a part within a value. This would cause follow-up errors.
    if errors.is_empty() {
        (table, errors)
    } else {
        parse_parts(text, usize::MAX)
    }
}

/// Parses a file in parts of at least `min` tokens. A part ends with a line that ends outside of all brackets.
fn parse_parts(text: &str, min: usize) -> (Table<'_>, Vec<ParseError>) {
    let source = Source::new(text);
    let (mut builder, mut errors) = (Builder::new(source), Vec::new());
    let mut whitespace = ValidateWhitespace::new(&mut builder, source);
    let mut receiver = RecursionGuard::new(&mut whitespace, MAX_DEPTH);
    let (mut part, mut depth) = (Vec::<Token>::new(), 0_usize);
    for token in source.lex() {
        part.push(token);
        match token.kind() {
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => depth = depth.saturating_sub(1),
            TokenKind::Newline if depth > 0 || part.len() < min => {}
            TokenKind::Newline | TokenKind::Eof => {
                parser::parse_document(&part, &mut receiver, &mut errors);
                part.clear();
            }
            _ => {}
        }
    }
    builder.finish_section(&mut errors);
    (builder.root, errors)
}

/// Parses a value. Returns `None` if it is not valid TOML.
pub fn parse_value(text: &str) -> Option<Value<'_>> {
    let source = Source::new(text);
    let (mut builder, mut errors) = (Builder::new(source), Vec::new());
    let mut receiver = RecursionGuard::new(&mut builder, MAX_DEPTH);
    parser::parse_value(&source.lex().into_vec(), &mut receiver, &mut errors);
    builder.value.filter(|_| errors.is_empty())
}

/// Header of a table: `[path]` or `[[path]]`.
struct Header<'a> {
    path: Vec<Key<'a>>,
    is_list: bool,
    span: Span,
}

/// Part of a statement that is not complete yet.
enum Open<'a> {
    /// Array or inline table with the elements until now, and its first byte.
    Value(Value<'a>, Span),
    /// Entry whose value follows, with the position of the first part of its key in [`Builder::keys`].
    Entry(usize),
}

/// Builds the tree from the events of the parser.
struct Builder<'a> {
    source: Source<'a>,
    /// The sections until now.
    root: Table<'a>,
    /// Header of the current section, except for the entries before the first header.
    header: Option<Header<'a>>,
    /// Entries of the current section.
    section: Table<'a>,
    /// Parts of the keys of incomplete entries.
    keys: Vec<Key<'a>>,
    /// Position in `keys` of the first part of the last key.
    first_part: usize,
    /// True after a dot in a key.
    is_dotted: bool,
    open: Vec<Open<'a>>,
    /// Value that is not in a table.
    value: Option<Value<'a>>,
}

impl<'a> Builder<'a> {
    fn new(source: Source<'a>) -> Self {
        let (root, section) = Default::default();
        let (keys, open) = (Vec::new(), Vec::new());
        Builder { source, root, header: None, section, keys, first_part: 0, is_dotted: false, open, value: None }
    }

    /// Adds the current section to the tree.
    fn finish_section(&mut self, errors: &mut dyn ErrorSink) {
        let mut section = std::mem::take(&mut self.section);
        section.entries.shrink_to_fit();
        let Some(Header { mut path, is_list, span }) = self.header.take() else {
            self.root = section;
            return;
        };
        let Some(key) = path.pop() else { return };
        let Some(parent) = self.root.descend(path.into_iter(), TableKind::Implicit, errors) else { return };
        let Some(position) = parent.position(&key.value) else {
            let table = Value::Table(section);
            let value = if is_list { Value::List(vec![at(table, span)]) } else { table };
            return parent.push(key, at(value, span));
        };
        let (known_key, known) = &mut parent.entries[position];
        match &mut known.value {
            Value::List(list) if is_list && list.last().is_some_and(has_header) => {
                list.push(at(Value::Table(section), span));
            }
            // Tables within this table came before it.
            Value::Table(table) if !is_list && table.kind == TableKind::Implicit => {
                table.kind = TableKind::Header;
                section.entries.into_iter().for_each(|(key, value)| table.add(key, value, errors));
                (known.start, known.end) = (span.start() as u32, span.end() as u32);
                *known_key = key;
            }
            _ => duplicate(&key, errors),
        }
    }

    fn open_header(&mut self, is_list: bool, span: Span, errors: &mut dyn ErrorSink) {
        self.finish_section(errors);
        self.section = Table::new(TableKind::Header);
        self.header = Some(Header { path: Vec::new(), is_list, span });
    }

    fn close_header(&mut self, span: Span) {
        if let Some(header) = &mut self.header {
            header.path.extend(self.keys.drain(self.first_part.min(self.keys.len())..));
            header.span = header.span.append(span);
        }
    }

    /// Adds the innermost array or inline table that is not complete to the value that contains it.
    fn close(&mut self, end: Span, errors: &mut dyn ErrorSink) {
        while let Some(open) = self.open.pop() {
            if let Open::Value(mut value, start) = open {
                match &mut value {
                    Value::List(list) => list.shrink_to_fit(),
                    Value::Table(table) => table.entries.shrink_to_fit(),
                    _ => {}
                }
                return self.complete(at(value, start.append(end)), errors);
            }
        }
    }

    /// Adds a complete value to the array or the table that contains it.
    fn complete(&mut self, node: Node<'a>, errors: &mut dyn ErrorSink) {
        match self.open.last_mut() {
            Some(Open::Value(Value::List(list), _)) => list.push(node),
            Some(&mut Open::Entry(first)) => {
                self.open.pop();
                let table = match self.open.last_mut() {
                    Some(Open::Value(Value::Table(table), _)) => table,
                    _ => &mut self.section,
                };
                let mut path = self.keys.drain(first.min(self.keys.len())..);
                let Some(key) = path.next_back() else { return };
                if let Some(table) = table.descend(path, TableKind::Dotted, errors) {
                    table.add(key, node, errors);
                }
            }
            _ => self.value = Some(node.value),
        }
    }
}

impl EventReceiver for Builder<'_> {
    fn std_table_open(&mut self, span: Span, errors: &mut dyn ErrorSink) {
        self.open_header(false, span, errors);
    }

    fn std_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.close_header(span);
    }

    fn array_table_open(&mut self, span: Span, errors: &mut dyn ErrorSink) {
        self.open_header(true, span, errors);
    }

    fn array_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.close_header(span);
    }

    fn inline_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.open.push(Open::Value(Value::Table(Table::new(TableKind::Inline)), span));
        true
    }

    fn inline_table_close(&mut self, span: Span, errors: &mut dyn ErrorSink) {
        self.close(span, errors);
    }

    fn array_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.open.push(Open::Value(Value::List(Vec::new()), span));
        true
    }

    fn array_close(&mut self, span: Span, errors: &mut dyn ErrorSink) {
        self.close(span, errors);
    }

    fn simple_key(&mut self, span: Span, encoding: Option<Encoding>, errors: &mut dyn ErrorSink) {
        if !std::mem::take(&mut self.is_dotted) {
            if self.open.is_empty() {
                // After a syntax error, the list can contain the key of an earlier statement.
                self.keys.clear();
            }
            self.first_part = self.keys.len();
        }
        // The part beyond the limit is reported, and all further parts are left out.
        match self.keys.len().cmp(&(MAX_DEPTH as usize)) {
            Ordering::Less => {}
            Ordering::Equal => errors.report_error(ParseError::new("recursion limit").with_unexpected(span)),
            Ordering::Greater => return,
        }
        let mut text = Cow::Borrowed("");
        if let Some(raw) = self.source.get(Event::new_unchecked(EventKind::SimpleKey, encoding, span)) {
            raw.decode_key(&mut text, errors);
        }
        self.keys.push(at(text, span));
    }

    fn key_sep(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.is_dotted = true;
    }

    fn key_val_sep(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.open.push(Open::Entry(self.first_part));
    }

    fn scalar(&mut self, span: Span, encoding: Option<Encoding>, errors: &mut dyn ErrorSink) {
        let Some(raw) = self.source.get(Event::new_unchecked(EventKind::Scalar, encoding, span)) else { return };
        let mut text = Cow::Borrowed("");
        let value = match raw.decode_scalar(&mut text, errors) {
            ScalarKind::String => Value::Text(text),
            ScalarKind::Boolean(flag) => Value::Boolean(flag),
            ScalarKind::Float => Value::Float(text),
            ScalarKind::Integer(radix) => Value::Integer(text, radix.value()),
            ScalarKind::DateTime => {
                if let Err(error) = text.parse::<Datetime>() {
                    errors.report_error(ParseError::new(error.to_string()).with_unexpected(span));
                }
                Value::Date
            }
        };
        self.complete(at(value, span), errors);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Converts a value to that of the independent parser.
    fn converted(value: &Value<'_>) -> toml::Value {
        match value {
            Value::Text(text) => toml::Value::String(text.to_string()),
            Value::Integer(digits, radix) => toml::Value::Integer(i64::from_str_radix(digits, *radix).unwrap()),
            Value::Float(text) => toml::Value::Float(text.parse().unwrap()),
            Value::Boolean(flag) => toml::Value::Boolean(*flag),
            // The tree does not contain the date.
            Value::Date => toml::Value::Datetime("1979-05-27".parse().unwrap()),
            Value::List(list) => list.iter().map(|node| converted(&node.value)).collect::<Vec<_>>().into(),
            Value::Table(table) => toml::Value::Table(table_of(table)),
        }
    }

    fn table_of(table: &Table<'_>) -> toml::Table {
        table.iter().map(|(key, node)| (key.value.to_string(), converted(&node.value))).collect()
    }

    fn parsed(text: &str) -> Option<toml::Table> {
        let (table, errors) = parse(text);
        errors.is_empty().then(|| table_of(&table))
    }

    #[test]
    fn shipped_tables_have_the_values_of_an_independent_parser() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let tables: Vec<_> = files.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
        assert!(tables.len() >= 4, "{tables:?}");
        for path in tables {
            let text = std::fs::read_to_string(&path).unwrap();
            assert_eq!(parsed(&text), Some(text.parse().unwrap()), "{}", path.display());
        }
    }

    #[test]
    fn ranges_cover_keys_values_and_headers() {
        let text = "a.\"b\" = [1, { c = 'x' }]\n[[d]]\ne = 0x1F\n";
        let (table, errors) = parse(text);
        assert_eq!(errors, []);
        let shown = |start: u32, end: u32| &text[start as usize..end as usize];
        let mut found = Vec::new();
        let mut open: Vec<_> = table.into_entries();
        while let Some((key, node)) = open.pop() {
            found.push((shown(key.start, key.end), shown(node.start, node.end)));
            match node.value {
                Value::Table(table) => open.extend(table.into_entries()),
                Value::List(list) => open.extend(list.into_iter().map(|node| (key.clone(), node))),
                _ => {}
            }
        }
        let list = "[1, { c = 'x' }]";
        let expected = [("d", "[[d]]"), ("d", "[[d]]"), ("e", "0x1F"), ("a", "a"), ("\"b\"", list)];
        let elements = [("\"b\"", "{ c = 'x' }"), ("c", "'x'"), ("\"b\"", "1")];
        assert_eq!(found, [&expected[..], &elements].concat());
    }

    #[test]
    fn entries_are_in_the_order_of_the_file() {
        let lines: String = (0..40).rev().map(|number| format!("k{number} = {number}\n")).collect();
        let (mut table, errors) = parse(&lines);
        assert_eq!(errors, []);
        assert!(table.remove("k20").is_some() && table.get("k20").is_none());
        table.rename("k19", "k20");
        let keys: Vec<_> = table.iter().map(|(key, _)| key.value.to_string()).collect();
        let expected: Vec<_> =
            (0..40).rev().filter(|&number| number != 19).map(|number| format!("k{number}")).collect();
        assert_eq!(keys, expected);
        assert_eq!(converted(&table.get("k0").unwrap().value), toml::Value::Integer(0));
    }

    #[test]
    fn a_part_does_not_end_within_a_value() {
        let list = "x = [\n".to_owned() + &"  1,\n".repeat(2 * MIN_TOKENS) + "]\ny = { z = [\n] }\n";
        assert_eq!(parsed(&list), Some(list.parse().unwrap()));
        // The surplus bracket is the only error.
        let surplus = "x = 1\n".to_owned() + &"# comment\n".repeat(MIN_TOKENS) + "y = [ } \n2 ]\n";
        assert_eq!(parse(&surplus).1, parse_parts(&surplus, usize::MAX).1);
    }

    #[test]
    fn values_of_any_depth_do_not_overflow_the_stack() {
        for (open, close) in [("[", "]"), ("{ a = ", "}"), ("{ a.a = ", "}")] {
            let text = format!("a = {}1{}\n", open.repeat(50_000), close.repeat(50_000));
            assert_eq!(parsed(&text), None);
        }
        let path = "a.".repeat(50_000) + "a";
        assert_eq!(parsed(&format!("{path} = 1\n")), None);
        assert_eq!(parsed(&format!("[{path}]\n")), None);
        // Both the nesting and the number of parts of each key are below the limit.
        let entry = format!("{{ {}a = ", "a.".repeat(70));
        assert_eq!(parsed(&format!("a = {}1{}\n", entry.repeat(70), "}".repeat(70))), None);
        let allowed = format!("a = {}1{}\n", "{ a.a = ".repeat(39), "}".repeat(39));
        assert_eq!(parsed(&allowed), Some(allowed.parse().unwrap()));
    }

    #[test]
    fn keys_without_values_do_not_count_toward_the_limit_of_later_keys() {
        let (_, errors) = parse(&"a.b\n".repeat(2 * MAX_DEPTH as usize));
        assert!(errors.iter().all(|error| error.description() == "key with no value"), "{errors:?}");
    }

    /// Statements that extend or repeat each other.
    const STATEMENTS: &[&str] = &[
        "[a]",
        "[a.b]",
        "[a.b.c]",
        "[b]",
        "[[a]]",
        "[[a.b]]",
        "[[b]]",
        "a = 1",
        "b = 'x'",
        "c = [1, 2.5, true]",
        "a.b = 1",
        "a.b.c = 2",
        "a.c.d = 3",
        "b.c = { d.e = 1, d.f = [{ g = 1 }, { g = 2 }] }",
        "a = { b = 1, b.c = 2 }",
        "a = { b.c = 1, b.d = { e = 1 } }",
        "b = [{ c = 1 }]",
        "c = 1979-05-27",
        "d = [ } 1 ]",
        "= 1",
        "e = \"\\u00e4\"",
        "[e",
    ];

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn statements_mean_the_same_as_for_an_independent_parser(list in prop::collection::vec(0..STATEMENTS.len(), 0..8)) {
            let text: String = list.iter().map(|&at| format!("{}\n", STATEMENTS[at])).collect();
            prop_assert_eq!(parsed(&text), text.parse().ok(), "{}", text);
        }

        #[test]
        fn no_text_panics(text in "[a-c=\\[\\]{}.,\"'#\n 1-3]{0,60}") {
            let by_other: Option<toml::Table> = text.parse().ok();
            prop_assert_eq!(parsed(&text).is_some(), by_other.is_some(), "{}", text);
        }
    }
}
