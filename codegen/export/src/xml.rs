//! Writes XML elements, attributes and texts.

use std::borrow::Cow;
use std::fmt::Display;

use compact_str::CompactString;
use quick_xml::escape::escape;

use super::note::{Export, NoteKind, Notes, Subject};

/// An XML file that is being written. The caller closes each element; `finish` closes the elements that are still open.
pub(super) struct Xml {
    text: String,
    open: Vec<Open>,
    /// Notes on facts that the file does not contain, or contains in a different form.
    pub(super) notes: Notes,
    /// Number of omitted attributes. An attribute is omitted if its name is invalid or already used in the element.
    unnamed: usize,
    /// Names of the attributes written so far in the last opened element.
    given: Vec<CompactString>,
}

/// An element that is not closed yet.
struct Open {
    name: Cow<'static, str>,
    content: Content,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Content {
    /// The start tag is unfinished. More attributes can follow.
    Tag,
    Text,
    Elements,
}

impl Xml {
    pub(super) fn new() -> Self {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into();
        Xml { text, open: Vec::new(), notes: Notes::default(), unnamed: 0, given: Vec::new() }
    }

    /// Starts the element `name`.
    pub(super) fn open(&mut self, name: impl Into<Cow<'static, str>>) {
        self.finish_tag(Content::Elements);
        self.given.clear();
        let name = name.into();
        self.indent();
        self.text.push('<');
        self.text += &name;
        self.open.push(Open { name, content: Content::Tag });
    }

    /// Writes an attribute of the last opened element. Omits and counts an attribute whose name is invalid or already
    /// used.
    pub(super) fn attribute(&mut self, name: &str, value: impl Display) {
        if !is_name(name) || self.given.iter().any(|given| given == name) {
            self.unnamed += 1;
            return;
        }
        self.given.push(name.into());
        let value = self.allowed(value.to_string());
        self.text.push(' ');
        self.text += name;
        self.text += "=\"";
        // In attributes, XML readers replace tabs and line breaks with spaces unless they are written as character references.
        let breaks = [("\t", "&#9;"), ("\n", "&#10;"), ("\r", "&#13;")];
        let value = breaks.into_iter().fold(escape(&*value).into_owned(), |text, (from, to)| text.replace(from, to));
        self.text += &value;
        self.text.push('"');
    }

    /// Writes an attribute if its value is `Some`.
    pub(super) fn optional(&mut self, name: &str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.attribute(name, value);
        }
    }

    /// Writes an attribute unless its value equals `usual`, the value that readers assume if the attribute is missing.
    pub(super) fn unless<T: Display + PartialEq>(&mut self, name: &str, value: T, usual: T) {
        self.optional(name, Some(value).filter(|value| *value != usual));
    }

    /// Writes an attribute unless its value is an empty text.
    pub(super) fn text_attribute(&mut self, name: &str, text: &str) {
        self.unless(name, text, "");
    }

    /// Writes the attribute `name` with the value `word` if `value` is true.
    pub(super) fn flag(&mut self, name: &str, value: bool, word: &str) {
        if value {
            self.attribute(name, word);
        }
    }

    /// Writes text within the last opened element.
    pub(super) fn content(&mut self, value: impl Display) {
        let value = self.allowed(value.to_string());
        if !value.is_empty() {
            self.finish_tag(Content::Text);
            self.text += &quick_xml::escape::partial_escape(&*value).replace('\r', "&#13;");
        }
    }

    /// Closes the last opened element.
    pub(super) fn close(&mut self) {
        let Some(Open { name, content }) = self.open.pop() else { return };
        match content {
            Content::Tag => self.text += "/>\n",
            Content::Text | Content::Elements => {
                if content == Content::Elements {
                    self.indent();
                }
                self.text += "</";
                self.text += &name;
                self.text += ">\n";
            }
        }
    }

    /// Writes an element that contains only text.
    pub(super) fn leaf(&mut self, name: impl Into<Cow<'static, str>>, value: impl Display) {
        self.open(name);
        self.content(value);
        self.close();
    }

    /// Writes an element that contains only text. Writes nothing if `value` is `None`.
    pub(super) fn optional_leaf(&mut self, name: &'static str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.leaf(name, value);
        }
    }

    /// Writes an element that contains only text. Writes nothing if the text is empty.
    pub(super) fn text_leaf(&mut self, name: &'static str, text: &str) {
        if !text.is_empty() {
            self.leaf(name, text);
        }
    }

    /// Writes an empty element with these attributes.
    pub(super) fn empty(&mut self, name: impl Into<Cow<'static, str>>, attributes: &[(&str, &dyn Display)]) {
        self.open(name);
        attributes.iter().for_each(|(name, value)| self.attribute(name, value));
        self.close();
    }

    /// Writes an element whose child elements contain only text.
    pub(super) fn leaves(&mut self, name: &'static str, children: &[(&'static str, &dyn Display)]) {
        self.open(name);
        children.iter().for_each(|(name, value)| self.leaf(*name, value));
        self.close();
    }

    /// Writes an element unless `list` is empty. Calls `write` for each item of the list to write the child elements.
    pub(super) fn list<T>(
        &mut self,
        name: impl Into<Cow<'static, str>>,
        list: impl IntoIterator<Item = T>,
        mut write: impl FnMut(&mut Self, T),
    ) {
        let mut list = list.into_iter().peekable();
        if list.peek().is_some() {
            self.open(name);
            list.for_each(|element| write(self, element));
            self.close();
        }
    }

    /// Finishes the start tag of the last opened element if necessary.
    fn finish_tag(&mut self, content: Content) {
        if let Some(last) = self.open.last_mut().filter(|last| last.content == Content::Tag) {
            last.content = content;
            self.text += if content == Content::Elements { ">\n" } else { ">" };
        }
    }

    fn indent(&mut self) {
        self.text.extend(std::iter::repeat_n("  ", self.open.len()));
    }

    /// Removes characters from `text` that XML does not allow.
    fn allowed(&mut self, mut text: String) -> String {
        let is_forbidden = |letter: char| {
            letter < ' ' && !matches!(letter, '\t' | '\n' | '\r') || matches!(letter, '\u{FFFE}' | '\u{FFFF}')
        };
        let count = text.chars().filter(|letter| is_forbidden(*letter)).count();
        if count > 0 {
            self.notes.add_many(NoteKind::Control, count, Subject::Device);
            text.retain(|letter| !is_forbidden(letter));
        }
        text
    }

    /// Closes the elements that are still open, and returns the file with its notes.
    pub(super) fn finish(mut self) -> Export {
        while !self.open.is_empty() {
            self.close();
        }
        self.notes.add_many(NoteKind::Extension, self.unnamed, Subject::Device);
        Export { text: self.text, notes: self.notes.finish() }
    }
}

/// Returns whether the text is a valid attribute name (`Name` of XML 1.0). All non-ASCII characters count as letters.
fn is_name(text: &str) -> bool {
    let is_letter = |letter: char| letter.is_ascii_alphabetic() || matches!(letter, '_' | ':') || !letter.is_ascii();
    text.starts_with(is_letter)
        && text.chars().all(|letter| is_letter(letter) || letter.is_ascii_digit() || matches!(letter, '-' | '.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_within_their_elements() {
        let mut xml = Xml::new();
        xml.open("A");
        xml.attribute("b", "\"<&\n");
        xml.open("C");
        xml.close();
        xml.leaf("D", "</D>\u{1}&\r");
        xml.leaf("E", "");
        let expected = "<A b=\"&quot;&lt;&amp;&#10;\">\n  <C/>\n  <D>&lt;/D&gt;&amp;&#13;</D>\n  <E/>\n</A>\n";
        let Export { text, notes } = xml.finish();
        assert_eq!(text, format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{expected}"));
        assert_eq!(notes.iter().map(|note| (note.kind, note.count)).collect::<Vec<_>>(), [(NoteKind::Control, 1)]);
    }

    #[test]
    fn attributes_have_valid_and_unique_names() {
        let mut xml = Xml::new();
        xml.open("A");
        for name in ["b", "x:c-1", "b", "", "2", "a b", "x=\"\"", "ß", "<"] {
            xml.attribute(name, 1);
        }
        xml.open("B");
        xml.attribute("b", 2);
        assert_eq!(xml.unnamed, 6);
        let expected = "<A b=\"1\" x:c-1=\"1\" ß=\"1\">\n  <B b=\"2\"/>\n</A>\n";
        assert_eq!(xml.finish().text, format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{expected}"));
    }
}
