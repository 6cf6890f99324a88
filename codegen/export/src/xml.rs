//! Elements, attributes and texts of an XML file in the making.

use std::borrow::Cow;
use std::fmt::Display;

use compact_str::CompactString;
use quick_xml::escape::escape;

/// A file in the making. Every element that is opened has to be closed.
pub(super) struct Xml {
    text: String,
    open: Vec<Open>,
    /// Characters that XML 1.0 doesn't allow, which were left out.
    pub(super) dropped: usize,
    /// Attributes that were left out: what they are called is no name, or their element has one of that name.
    pub(super) unnamed: usize,
    /// The names of attributes that the element which was opened last has.
    given: Vec<CompactString>,
}

/// An element that isn't closed yet.
struct Open {
    name: Cow<'static, str>,
    content: Content,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Content {
    /// The start tag isn't finished: attributes may follow.
    Tag,
    Text,
    Elements,
}

impl Xml {
    pub(super) fn new() -> Self {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into();
        Xml { text, open: Vec::new(), dropped: 0, unnamed: 0, given: Vec::new() }
    }

    /// Starts an element.
    pub(super) fn open(&mut self, name: impl Into<Cow<'static, str>>) {
        self.finish_tag(Content::Elements);
        self.given.clear();
        let name = name.into();
        self.indent();
        self.text.push('<');
        self.text += &name;
        self.open.push(Open { name, content: Content::Tag });
    }

    /// An attribute of the element that was opened last.
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
        // A line break in an attribute is read as a blank, if it isn't a reference.
        let breaks = [("\t", "&#9;"), ("\n", "&#10;"), ("\r", "&#13;")];
        let value = breaks.into_iter().fold(escape(&*value).into_owned(), |text, (from, to)| text.replace(from, to));
        self.text += &value;
        self.text.push('"');
    }

    /// The same where there is a value.
    pub(super) fn optional(&mut self, name: &str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.attribute(name, value);
        }
    }

    /// The same where the value isn't the one that a missing attribute stands for.
    pub(super) fn unless<T: Display + PartialEq>(&mut self, name: &str, value: T, usual: T) {
        self.optional(name, Some(value).filter(|value| *value != usual));
    }

    /// The same where the text isn't empty.
    pub(super) fn text_attribute(&mut self, name: &str, text: &str) {
        self.unless(name, text, "");
    }

    /// An attribute that is there only where it is true.
    pub(super) fn flag(&mut self, name: &str, value: bool, word: &str) {
        if value {
            self.attribute(name, word);
        }
    }

    /// Text within the element that was opened last.
    pub(super) fn content(&mut self, value: impl Display) {
        let value = self.allowed(value.to_string());
        if !value.is_empty() {
            self.finish_tag(Content::Text);
            self.text += &quick_xml::escape::partial_escape(&*value).replace('\r', "&#13;");
        }
    }

    /// Ends the element that was opened last.
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

    /// An element with nothing but text.
    pub(super) fn leaf(&mut self, name: impl Into<Cow<'static, str>>, value: impl Display) {
        self.open(name);
        self.content(value);
        self.close();
    }

    /// The same where there is a value.
    pub(super) fn optional_leaf(&mut self, name: &'static str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.leaf(name, value);
        }
    }

    /// The same where the text isn't empty.
    pub(super) fn text_leaf(&mut self, name: &'static str, text: &str) {
        if !text.is_empty() {
            self.leaf(name, text);
        }
    }

    /// An element with nothing but an attribute.
    pub(super) fn reference(&mut self, name: impl Into<Cow<'static, str>>, attribute: &str, value: impl Display) {
        self.open(name);
        self.attribute(attribute, value);
        self.close();
    }

    /// An element that `write` fills with the elements of a list; nothing if the list is empty.
    pub(super) fn list<T>(
        &mut self,
        name: &'static str,
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

    /// Ends the start tag of the element that was opened last, if that isn't done.
    fn finish_tag(&mut self, content: Content) {
        if let Some(last) = self.open.last_mut().filter(|last| last.content == Content::Tag) {
            last.content = content;
            self.text += if content == Content::Elements { ">\n" } else { ">" };
        }
    }

    fn indent(&mut self) {
        self.text.extend(std::iter::repeat_n("  ", self.open.len()));
    }

    /// `text` without what no XML file can have in it.
    fn allowed(&mut self, mut text: String) -> String {
        let is_forbidden = |letter: char| {
            letter < ' ' && !matches!(letter, '\t' | '\n' | '\r') || matches!(letter, '\u{FFFE}' | '\u{FFFF}')
        };
        let count = text.chars().filter(|letter| is_forbidden(*letter)).count();
        if count > 0 {
            self.dropped += count;
            text.retain(|letter| !is_forbidden(letter));
        }
        text
    }

    /// The file.
    pub(super) fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }
}

/// Whether an attribute can be called so (`Name` of XML 1.0; what isn't ASCII is taken for a letter).
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
        assert_eq!(xml.dropped, 1);
        let expected = "<A b=\"&quot;&lt;&amp;&#10;\">\n  <C/>\n  <D>&lt;/D&gt;&amp;&#13;</D>\n  <E/>\n</A>\n";
        assert_eq!(xml.finish(), format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{expected}"));
    }

    #[test]
    fn attributes_have_names_of_their_own() {
        let mut xml = Xml::new();
        xml.open("A");
        for name in ["b", "x:c-1", "b", "", "2", "a b", "x=\"\"", "ß", "<"] {
            xml.attribute(name, 1);
        }
        xml.open("B");
        xml.attribute("b", 2);
        assert_eq!(xml.unnamed, 6);
        let expected = "<A b=\"1\" x:c-1=\"1\" ß=\"1\">\n  <B b=\"2\"/>\n</A>\n";
        assert_eq!(xml.finish(), format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{expected}"));
    }
}
