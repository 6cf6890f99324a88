//! Reads tables, and reports unknown keys and invalid values.

use std::ops::RangeInclusive;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::text::similar;

use super::section::{Form, Section};
use crate::syntax::{At, Content, Entry, Node, Scalar};

/// Maximum number of keys of a section for which a diagnostic lists them.
const MAX_NAMED: usize = 12;

/// Reads the tables of one file.
pub(crate) struct Reader<'d> {
    pub diagnostics: &'d mut Diagnostics,
    /// Sections of the format in which a misplaced key is looked up.
    pub sections: &'static [&'static Section],
}

/// A table of the file.
#[derive(Clone, Copy)]
pub(crate) struct Table<'n> {
    pub node: &'n Node,
    pub entries: &'n [Entry],
    section: &'static Section,
}

impl<'n> Table<'n> {
    /// Returns the value of a key. A key without a value counts as missing.
    pub fn get(&self, key: &str) -> Option<&'n Node> {
        debug_assert!(self.section.keys.iter().any(|known| known.name == key), "`{key}` is not declared");
        let entry = self.entries.iter().find(|entry| entry.key.value == key)?;
        Some(&entry.value).filter(|node| node.content != Content::Scalar(Scalar::Null))
    }
}

impl Reader<'_> {
    /// Returns the entries of a table. Reports any other value, and returns no entries.
    pub fn entries<'n>(&mut self, node: &'n Node, name: &str) -> &'n [Entry] {
        match &node.content {
            Content::Table(entries) => entries,
            _ => {
                self.invalid(node, &format!("a table ({name})"));
                &[]
            }
        }
    }

    /// Returns a table, and reports its unknown keys.
    pub fn table<'n>(&mut self, node: &'n Node, section: &'static Section) -> Table<'n> {
        let entries = self.entries(node, section.name);
        for entry in entries {
            if section.keys.iter().all(|key| *key.name != *entry.key.value) {
                self.unknown_key(&entry.key, section);
            }
        }
        Table { node, entries, section }
    }

    /// Reports a key that a section does not have.
    pub fn unknown_key(&mut self, key: &At<String>, section: &'static Section) {
        let has = |section: &&&Section| section.keys.iter().any(|known| known.name == key.value);
        let other = self.sections.iter().find(has);
        let known = section.keys.iter().map(|known| known.name);
        let diagnostic = match (other, similar(key, known.clone())) {
            (Some(other), similar) => {
                let message = format!("the key `{}` is in the wrong section", key.value);
                let or_similar = similar.map_or(String::new(), |name| format!(", or write `{name}`"));
                Diagnostic::new(&codes::MISPLACED_KEY, key.span, message)
                    .label(format!("this is {}", section.name))
                    .help(format!("move the key to {}{or_similar}", other.name))
            }
            (None, Some(name)) => self.no_such_key(key, section).help(format!("write `{name}`")),
            (None, None) => {
                let names: Vec<&str> = known.collect();
                let found = self.no_such_key(key, section);
                match names.len() {
                    0..=MAX_NAMED => found.help(format!("use one of the keys {}", names.join(", "))),
                    _ => found.help("remove the key"),
                }
            }
        };
        self.diagnostics.push(diagnostic);
    }

    fn no_such_key(&self, key: &At<String>, section: &Section) -> Diagnostic {
        let message = format!("the key `{}` is unknown", key.value);
        Diagnostic::new(&codes::UNKNOWN_NETWORK_KEY, key.span, message)
            .label(format!("{} has no such key", section.name))
    }

    /// Reports a value of the wrong form or out of range.
    pub fn invalid(&mut self, node: &Node, expected: &str) {
        let message = format!("expected {expected}, found {}", node.described());
        self.diagnostics.push(Diagnostic::new(&codes::NETWORK_VALUE, node.span, message));
    }

    /// Reports a missing key.
    pub fn missing(&mut self, table: Table<'_>, key: &str) {
        let message = format!("{} has no key `{key}`", table.section.name);
        self.diagnostics.push(Diagnostic::new(&codes::NETWORK_VALUE, table.node.span, message));
    }

    /// Returns an integer. The declaration of the key states the range.
    pub fn integer<T: TryFrom<i128>>(&mut self, table: Table<'_>, key: &str) -> Option<At<T>> {
        let node = table.get(key)?;
        let Some(Form::Integer(low, high)) = form(table.section, key) else { return None };
        self.integer_of(node, low.into()..=high.into())
    }

    /// Returns an integer in a range.
    pub fn integer_of<T: TryFrom<i128>>(&mut self, node: &Node, range: RangeInclusive<i128>) -> Option<At<T>> {
        let number = match &node.content {
            Content::Scalar(Scalar::Integer(number)) => range.contains(number).then_some(*number),
            _ => None,
        };
        match number.and_then(|number| T::try_from(number).ok()) {
            Some(number) => Some(At::new(number, node.span)),
            None => {
                self.invalid(node, &format!("an integer from {} to {}", range.start(), range.end()));
                None
            }
        }
    }

    /// Returns a positive number.
    pub fn number(&mut self, table: Table<'_>, key: &str) -> Option<At<f64>> {
        let node = table.get(key)?;
        let number = match node.content {
            Content::Scalar(Scalar::Integer(number)) => number as f64,
            Content::Scalar(Scalar::Real(number)) => number,
            _ => f64::NAN,
        };
        if number > 0.0 && number.is_finite() {
            return Some(At::new(number, node.span));
        }
        self.invalid(node, "a number above 0");
        None
    }

    /// Returns `true` or `false`. The integer 1 means `true`, and 0 means `false`.
    pub fn flag(&mut self, table: Table<'_>, key: &str) -> Option<bool> {
        let node = table.get(key)?;
        match node.content {
            Content::Scalar(Scalar::Bool(flag)) => Some(flag),
            Content::Scalar(Scalar::Integer(number @ 0..=1)) => Some(number == 1),
            _ => {
                self.invalid(node, "`true` or `false`");
                None
            }
        }
    }

    /// Returns a text. The maximum length is that of the key's declaration.
    pub fn text(&mut self, table: Table<'_>, key: &str) -> Option<At<String>> {
        let node = table.get(key)?;
        let text = self.text_of(node)?;
        match form(table.section, key) {
            Some(Form::ShortText(longest)) if text.is_empty() || text.len() > longest => {
                self.invalid(node, &format!("a text of 1 to {longest} bytes"));
                None
            }
            _ => Some(text),
        }
    }

    /// Returns a text.
    pub fn text_of(&mut self, node: &Node) -> Option<At<String>> {
        match &node.content {
            Content::Scalar(Scalar::Text(text)) => Some(At::new(text.clone(), node.span)),
            _ => {
                self.invalid(node, "a text");
                None
            }
        }
    }

    /// Returns the elements of a list.
    pub fn list<'n>(&mut self, node: &'n Node) -> &'n [Node] {
        match &node.content {
            Content::List(list) => list,
            _ => {
                self.invalid(node, "a list");
                &[]
            }
        }
    }

    /// Returns the texts of a list.
    pub fn texts(&mut self, table: Table<'_>, key: &str) -> Vec<At<String>> {
        let list = table.get(key).map_or(&[][..], |node| self.list(node));
        list.iter().filter_map(|node| self.text_of(node)).collect()
    }

    /// Returns a single value.
    pub fn scalar(&mut self, node: &Node) -> Option<At<Scalar>> {
        match &node.content {
            Content::Scalar(scalar) if *scalar != Scalar::Null => Some(At::new(scalar.clone(), node.span)),
            _ => {
                self.invalid(node, "a number, a text, `true` or `false`");
                None
            }
        }
    }
}

fn form(section: &Section, key: &str) -> Option<Form> {
    section.keys.iter().find(|known| known.name == key).map(|known| known.form)
}
