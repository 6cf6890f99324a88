//! Reads the text of a file into the types of `format`, and reports each error with its span.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use compact_str::CompactString;
use toml_parser::{Expected, ParseError};

use super::at::{At, Literal, OneOrMany};
use super::document::{self, Table, Value};
use super::format::{Cited, Documented, DoubtTable, Doubted, NumberOrText, OptionTable};
pub(super) use super::read::Node;
use super::read::{self, MistakeKind, Read};
use super::references::References;
use crate::collections::HashMap;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{Documentation, Doubt, Doubts, FactOrigin, LocalText, Reference, Severity, Texts};
use crate::limits::MAX_UNKNOWN_KEYS;
use crate::source::{FileId, Origin, Source, Span};
use crate::text::{brief, similar, standard_and_clause};

/// If no name is similar, a message lists all known names, unless there are more than this number.
const MAX_LISTED: usize = 12;

/// Number of diagnostics after which messages no longer suggest names.
const MAX_HELPED: usize = 1000;

/// Byte range in the file: offset of the first byte, and offset after the last byte.
type ByteRange = (u32, u32);

/// State of the table reader for one file.
pub(super) struct Reader<'a, 'd> {
    pub source: &'a Source,
    pub file: FileId,
    pub diagnostics: &'d mut Diagnostics,
    /// Language of the manual.
    pub language: CompactString,
    /// Standard from which a profile was transcribed; empty if the file is not a profile.
    pub standard: CompactString,
    /// Byte ranges of the elements in each list, by the byte range of the list.
    pub lists: RefCell<HashMap<ByteRange, Rc<[ByteRange]>>>,
    /// Names that were read, and the kinds of elements to which they refer.
    pub references: References,
}

impl<'a, 'd> Reader<'a, 'd> {
    /// Creates a reader for a file whose language and standard are not known yet.
    pub fn new(source: &'a Source, file: FileId, diagnostics: &'d mut Diagnostics) -> Self {
        let (language, standard, lists, references) = Default::default();
        Reader { source, file, diagnostics, language, standard, lists, references }
    }
}

impl<'a> Reader<'a, '_> {
    /// Parses the file and reports syntax errors. Returns `None` if the file is not valid TOML.
    pub fn parse(&mut self) -> Option<Table<'a>> {
        let source = self.source;
        let (table, errors) = document::parse(source.text());
        // A syntax error causes follow-up errors. Follow-up errors on the same line, or without a span, are not useful.
        let mut last_line = 0;
        for (position, error) in errors.iter().enumerate() {
            let (start, end) = error.unexpected().map_or((0, 0), |span| (span.start() as u32, span.end() as u32));
            let line = self.source.line_at(start);
            let follows = std::mem::replace(&mut last_line, line) == line || error.unexpected().is_none();
            if position == 0 || !follows {
                let (span, message) = (Span::new(self.file, start, end), message(error));
                let help = hint(&message).map(Into::into);
                self.diagnostics.push(Diagnostic { help, ..codes::TABLE_SYNTAX.at(self.visible(span), message) });
            }
        }
        errors.is_empty().then_some(table)
    }

    /// Reads a value as the type `T` and reports errors. An unknown key is removed, or replaced with the most similar
    /// known key, so that the other keys can be read.
    pub fn piece<T: Read>(&mut self, mut node: Node<'a>) -> Option<T> {
        // Each attempt finds only one unknown key.
        for attempt in 0..=MAX_UNKNOWN_KEYS {
            let mistake = match T::read(&node) {
                Ok(piece) => return Some(piece),
                Err(mistake) => mistake,
            };
            let span = Span::new(self.file, mistake.range.0, mistake.range.1);
            match mistake.kind {
                MistakeKind::UnknownKey { .. } if attempt == MAX_UNKNOWN_KEYS => break,
                MistakeKind::UnknownKey { key, known } => {
                    self.unknown_key(&key, known, span);
                    // A misspelled key is read as the most similar known key, to avoid follow-up errors.
                    let suggestion = similar(&key, known.iter().copied());
                    if !remove(&mut node.value, span, &key, suggestion) {
                        return None;
                    }
                }
                MistakeKind::Value(message) => {
                    let diagnostic = codes::TABLE_VALUE.at(span, message);
                    self.diagnostics
                        .push(diagnostic.help("see `lexibus schema` or dictionaries/README.md for the valid values"));
                    return None;
                }
            }
        }
        let whole = self.span(&node);
        let message = format!("the table has more than {MAX_UNKNOWN_KEYS} unknown keys");
        self.diagnostics.push(codes::TABLE_VALUE.at(whole, message).label("the whole table is left out"));
        None
    }

    /// Reads a value with its byte range as the type `T`, and reports errors.
    pub fn piece_at<T: Read>(&mut self, node: Node<'a>) -> Option<At<T>> {
        let (start, end) = (node.start, node.end);
        Some(At { value: self.piece(node)?, start, end })
    }

    /// Returns the entries of a table in the order of the file.
    pub fn entries(&mut self, node: Node<'a>, what: &str) -> Vec<(At<String>, Node<'a>)> {
        let Value::Table(table) = node.value else {
            let message = format!("`{what}` must be a table");
            self.diagnostics.push(codes::TABLE_VALUE.at(self.span(&node), message));
            return Vec::new();
        };
        entries(table).collect()
    }

    /// Returns the elements of an array of tables. Reports any other value.
    pub fn elements(&mut self, node: Node<'a>, what: &str) -> Vec<Node<'a>> {
        match node.value {
            Value::List(list) => list,
            _ => {
                let message = format!("`{what}` must be a list of tables");
                let help = format!("write `[[{what}]]`");
                self.report_with_help(&codes::TABLE_VALUE, self.span(&node), message, help);
                Vec::new()
            }
        }
    }

    /// Reports a key that the format does not define for the table.
    pub fn unknown_key(&mut self, key: &str, known: &[&str], span: Span) {
        let message = format!("unknown key `{}`", brief(key));
        let diagnostic = codes::UNKNOWN_TABLE_KEY.at(span, message);
        let is_number = key.starts_with(|letter: char| letter.is_ascii_digit() || letter == '-');
        let inner = ["at", "values"].into_iter().find(|inner| is_number && known.contains(inner));
        self.diagnostics.push(match similar(key, known.iter().copied()) {
            _ if inner == Some("at") => diagnostic.help("write bits in `[bits.NAME.at]`"),
            _ if inner.is_some() => diagnostic.help("write values in `[enums.NAME.values]`"),
            Some(name) => diagnostic.help(format!("did you mean `{name}`?")),
            None if known.len() <= MAX_LISTED => diagnostic.help(format!("known keys: {}", known.join(", "))),
            None => diagnostic.help("see dictionaries/README.md for all keys"),
        });
    }

    /// Reports a name that has no definition.
    pub fn unresolved<'n>(&mut self, what: &str, name: &str, span: Span, known: impl Iterator<Item = &'n str>) {
        let message = format!("no {what} has the name `{}`", brief(name));
        let diagnostic = codes::UNRESOLVED_NAME.at(span, message);
        let known = known.take_while(|_| self.helps());
        let known: Vec<&str> = known.filter(|known| !known.trim().is_empty()).collect();
        self.diagnostics.push(match similar(name, known.iter().copied()) {
            Some(name) => diagnostic.help(format!("did you mean `{name}`?")),
            None if (1..=MAX_LISTED).contains(&known.len()) => {
                let known: Vec<&str> = known.into_iter().map(brief).collect();
                diagnostic.help(format!("known names: {}", known.join(", ")))
            }
            None => diagnostic,
        });
    }

    pub fn report(&mut self, code: &'static Code, span: Span, message: impl Into<String>) {
        self.diagnostics.push(code.at(span, message));
    }

    /// Reports an error with a help text.
    pub fn report_with_help(
        &mut self,
        code: &'static Code,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.diagnostics.push(code.at(span, message).help(help));
    }

    /// Returns the value for a word in `words`. Reports any other word.
    pub fn word<T: Copy>(&mut self, given: &At<String>, what: &str, words: &[(&str, T)]) -> Option<T> {
        let found = words.iter().find(|(word, _)| *word == given.value).map(|&(_, value)| value);
        if found.is_none() {
            let known: Vec<&str> = words.iter().map(|&(word, _)| word).collect();
            let message = format!("`{}` is not a valid {what}", brief(&given.value));
            let help = format!("write one of {}", known.join(", "));
            self.diagnostics.push(codes::TABLE_VALUE.at(self.span(given), message).help(help));
        }
        found
    }

    pub fn span<T>(&self, at: &At<T>) -> Span {
        Span::new(self.file, at.start, at.end)
    }

    /// Adds names that refer to elements of the kind `kind`. The names are looked up after all elements are read.
    pub fn mention<'n>(&mut self, names: impl IntoIterator<Item = &'n At<String>>, kind: &'static str) {
        self.references.extend(names.into_iter().map(|name| (name.clone(), kind)));
    }

    /// Creates a reference to the element called `name`.
    pub fn reference<Id>(&self, name: &At<String>) -> Reference<Id> {
        Reference::new(name.value.as_str(), self.span(name))
    }

    /// Returns the location of an element. An element of a profile has none, because no description contains it.
    pub fn origin<T>(&self, at: &At<T>) -> Origin {
        match self.standard.is_empty() {
            true => Origin { span: self.span(at), line: self.source.line_at(at.start) },
            false => Origin::default(),
        }
    }

    /// Returns a span that messages can show. An empty span is replaced with the span of the last preceding character
    /// that is not white space.
    fn visible(&self, span: Span) -> Span {
        let before =
            self.source.text().get(..span.start as usize).and_then(|text| text.trim_end().char_indices().last());
        match before.filter(|_| span.is_empty()) {
            Some((at, letter)) => Span { start: at as u32, end: (at + letter.len_utf8()) as u32, ..span },
            None => span,
        }
    }

    /// Returns the literals of the list at the byte range `whole`, each with its span. The span is that of the whole
    /// list if the list in the file and `list` differ in length.
    pub fn each(&self, list: &[Literal], whole: ByteRange) -> Vec<At<Literal>> {
        let ranges = self.element_ranges(whole);
        let range = |at: usize| if ranges.len() == list.len() { ranges[at] } else { whole };
        let at = |(at, value): (usize, &Literal)| At { value: value.clone(), start: range(at).0, end: range(at).1 };
        list.iter().enumerate().map(at).collect()
    }

    /// Returns the byte range of the element `at` in a list with `length` elements, or `whole` if the list in the
    /// file has a different length.
    pub fn element_range(&self, length: usize, at: usize, whole: ByteRange) -> ByteRange {
        let ranges = self.element_ranges(whole);
        ranges.get(at).copied().filter(|_| ranges.len() == length).unwrap_or(whole)
    }

    /// Returns the byte ranges of the elements of a list. The ranges are cached, because each item of a row needs them.
    fn element_ranges(&self, list: ByteRange) -> Rc<[ByteRange]> {
        let mut known = self.lists.borrow_mut();
        let find = || {
            let parsed = document::parse_value(self.source.slice(Span::new(self.file, list.0, list.1)));
            let Some(Value::List(elements)) = parsed else { return Rc::from([]) };
            elements.iter().map(|element| (list.0 + element.start, list.0 + element.end)).collect()
        };
        Rc::clone(known.entry(list).or_insert_with(find))
    }

    /// Returns whether messages still suggest names. After many diagnostics, the comparison of all names takes too long.
    pub fn helps(&self) -> bool {
        self.diagnostics.list().len() < MAX_HELPED
    }

    /// Returns whether a number is hexadecimal or binary in the file.
    pub fn is_pattern<T>(&self, at: &At<T>) -> bool {
        let text = self.source.slice(self.span(at)).trim_start_matches(['"', '\'']);
        text.starts_with("0x") || text.starts_with("0X") || text.starts_with("0b")
    }

    /// Returns the documentation of an element, from its description and citation.
    pub fn documentation(&self, doc: Option<&str>, cite: Option<String>) -> Option<Arc<Documentation>> {
        if doc.is_none() && cite.is_none() {
            return None;
        }
        let text = doc.unwrap_or_default().into();
        let (cite, text_from) = match self.standard.as_str() {
            "" => (cite.map(CompactString::from), None),
            // An element that cites no clause has no recorded origin. Usually, it is part of an element that cites a clause.
            standard => (None, cite.map(|clause| FactOrigin::Standard(standard_and_clause(standard, &clause).into()))),
        };
        Some(Arc::new(Documentation { text, cite, text_from: text_from.map(Box::new), ..Documentation::default() }))
    }

    /// Returns the original name of an element as a text in the language of the manual.
    pub fn original(&self, orig: Option<&str>) -> Texts {
        let language = || if self.language.is_empty() { "und".into() } else { self.language.clone() };
        orig.map(|text| LocalText { language: language(), text: text.into() }).into_iter().collect()
    }

    /// Returns the documentation that a table contains.
    pub fn documentation_of(&self, table: &(impl Documented + Cited)) -> Option<Arc<Documentation>> {
        self.documentation(table.doc(), table.cited())
    }

    /// Returns the ambiguities that a table contains.
    pub fn doubts_of(&mut self, table: &impl Doubted, origin: Origin) -> Doubts {
        self.doubts(table.doubt_tables(), origin, table.cited().as_deref())
    }

    /// Returns the ambiguities that the table of a row, bit, value, command or option contains.
    pub fn doubts_of_part(&mut self, table: &impl Doubted, part: &At<String>) -> Doubts {
        let mut doubts = self.doubts_of(table, self.origin(part));
        doubts.iter_mut().for_each(|doubt| doubt.part = part.value.as_str().into());
        doubts
    }

    pub fn doubts(&mut self, lists: [Option<&OneOrMany<DoubtTable>>; 2], origin: Origin, cite: Option<&str>) -> Doubts {
        let tables = lists.into_iter().flatten().flat_map(|list| &list.0);
        tables.map(|table| self.doubt(table, origin, cite)).collect()
    }

    /// Returns an ambiguity. An ambiguity without a citation has the citation `cite`.
    pub fn doubt(&mut self, table: &DoubtTable, origin: Origin, cite: Option<&str>) -> Doubt {
        let words = [Severity::Hazard, Severity::Value, Severity::Print].map(|severity| (severity.name(), severity));
        Doubt {
            says: table.says.clone(),
            chosen: table.chose.clone(),
            why: table.why.clone(),
            origin,
            cite: table.cite.as_ref().map(cited).or(cite.map(str::to_owned)).map(CompactString::from),
            part: CompactString::default(),
            severity: table.severity.as_ref().and_then(|word| self.word(word, "severity", &words)).unwrap_or_default(),
        }
    }
}

/// Returns the cited pages or lines as one text.
pub(super) fn cited(list: &OneOrMany<NumberOrText>) -> String {
    list.0.iter().map(NumberOrText::to_string).collect::<Vec<_>>().join(", ")
}

/// Returns the entries of a table in the order of the file.
pub(super) fn entries<'a>(table: Table<'a>) -> impl Iterator<Item = (At<String>, Node<'a>)> {
    table.into_entries().into_iter().map(|(key, value)| (read::key(&key), value))
}

/// Returns the message for a syntax error.
fn message(error: &ParseError) -> String {
    let expected = error.expected().map(|expected| {
        let shown = |expected: &Expected| match expected {
            Expected::Literal("\n") => "newline".to_owned(),
            Expected::Literal(text) => format!("`{}`", text.escape_debug()),
            Expected::Description(text) => (*text).to_owned(),
            _ => "etc".to_owned(),
        };
        let list: Vec<String> = expected.iter().map(shown).collect();
        format!(", expected {}", if list.is_empty() { "nothing".to_owned() } else { list.join(", ") })
    });
    format!("invalid TOML: {}{}", first_line(error.description()), expected.unwrap_or_default())
}

/// Returns a help text for the usual cause of a TOML syntax error.
fn hint(message: &str) -> Option<&'static str> {
    let has = |part: &str| message.contains(part);
    match () {
        () if has("key with no value") => Some("write a name of several words in quotes: `\"pump speed\" = { … }`"),
        () if has("invalid date") || has("invalid time") || has("invalid datetime") => {
            Some("write a range of registers in quotes: `reg = \"63-64\"`")
        }
        () if has("duplicate key") => Some("rows of a chapter, and keys of a row, must have different names"),
        () => None,
    }
}

fn first_line(message: &str) -> &str {
    message.lines().next().unwrap_or_default()
}

/// Removes the key at `span` from `value` or a table in `value`, or renames the key to `suggestion`. Returns whether the key was
/// found.
fn remove(value: &mut Value<'_>, span: Span, key: &str, suggestion: Option<&str>) -> bool {
    match value {
        Value::Table(table) => {
            if !table.iter().any(|(known, _)| known.value == key && known.start == span.start) {
                return table.values_mut().any(|inner| remove(&mut inner.value, span, key, suggestion));
            }
            match suggestion.filter(|suggestion| table.get(suggestion).is_none()) {
                Some(suggestion) => table.rename(key, suggestion),
                None => drop(table.remove(key)),
            }
            true
        }
        Value::List(list) => list.iter_mut().any(|inner| remove(&mut inner.value, span, key, suggestion)),
        _ => false,
    }
}

/// Replaces each text `$name` with the chosen value of the option `name`.
pub(super) fn choose<'a>(value: &mut Node<'a>, chosen: &HashMap<String, Value<'a>>) {
    match &mut value.value {
        Value::Text(text) => {
            if let Some(choice) = text.strip_prefix('$').and_then(|name| chosen.get(name)) {
                value.value = choice.clone();
            }
        }
        Value::List(list) => list.iter_mut().for_each(|inner| choose(inner, chosen)),
        Value::Table(table) => table.values_mut().for_each(|inner| choose(inner, chosen)),
        _ => {}
    }
}

/// Returns the value of each option: the caller's choice, or the default choice of the option.
pub(super) fn choices<'a>(
    reader: &mut Reader<'a, '_>,
    options: &[(At<String>, OptionTable, Node<'a>)],
    chosen: &[(String, String)],
) -> HashMap<String, Value<'a>> {
    let mut values = HashMap::default();
    for (name, option, node) in options {
        let by_caller = chosen.iter().rev().find(|(option_name, _)| *option_name == name.value);
        let (choice, span) = match (by_caller, &option.default) {
            (Some((_, choice)), _) => (choice.as_str(), reader.span(name)),
            (None, Some(default)) => (default.value.as_str(), reader.span(default)),
            (None, None) => {
                let message = format!("the option `{}` has no `default`", brief(&name.value));
                reader.report(&codes::TABLE_VALUE, reader.span(name), message);
                continue;
            }
        };
        let choices = node.value.as_table().and_then(|table| table.get("choices"));
        let choices = choices.and_then(|choices| choices.value.as_table());
        let value = choices.and_then(|choices| choices.get(choice));
        if value.is_none() {
            let known = option.choices.iter().map(|(key, _)| key.value.as_str());
            reader.unresolved(&format!("choice of the option `{}`", name.value), choice, span, known);
        }
        // After an unknown choice, the table is read with another choice to find further errors.
        if let Some(value) = value.or_else(|| choices?.iter().next().map(|(_, value)| value)) {
            values.insert(name.value.clone(), value.value.clone());
        }
    }
    for (name, _) in chosen {
        if !options.iter().any(|(option_name, ..)| option_name.value == *name) {
            let known = options.iter().map(|(option_name, ..)| option_name.value.as_str());
            reader.unresolved("option of this table", name, Span::new(reader.file, 0, 0), known);
        }
    }
    values
}

/// Reports a text `$name` that names no option.
pub(super) fn undecided(reader: &mut Reader<'_, '_>, value: &Node<'_>, known: &[String]) {
    match &value.value {
        Value::Text(text) => {
            let is_name = |name: &str| name.starts_with(|c: char| c.is_ascii_lowercase());
            let is_known = |name: &str| known.iter().any(|known_name| known_name == name);
            if let Some(name) = text.strip_prefix('$').filter(|name| is_name(name) && !is_known(name)) {
                let span = reader.span(value);
                reader.unresolved("option", name, span, known.iter().map(String::as_str));
            }
        }
        Value::List(list) => list.iter().for_each(|inner| undecided(reader, inner, known)),
        Value::Table(table) => table.iter().for_each(|(_, inner)| undecided(reader, inner, known)),
        _ => {}
    }
}

/// Returns the text of a literal.
pub(super) fn text_of(literal: &Literal) -> String {
    match literal {
        Literal::Bool(value) => value.to_string(),
        Literal::Int(value) => value.to_string(),
        Literal::Real(value) => value.to_string(),
        Literal::Text(text) => text.clone(),
    }
}
