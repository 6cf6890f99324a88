//! The lines of a file.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::{Display, Write as _};

use super::note::{Note, NoteKind, Notes, Subject};
use lexibus_codegen::ir::Extension;

/// Line end of CiA 306.
const END: &str = "\r\n";

/// The greatest number of characters in a line (CiA 306).
const MAX_LINE: usize = 255;

/// A file in the making.
pub(super) struct Writer {
    text: String,
    /// Keys that the section under way has so far, in lower case.
    keys: HashSet<String>,
    /// Whether keys of extension attributes may have any letters, and occur twice, as they did in an EDS.
    is_verbatim: bool,
    pub(super) notes: Notes,
}

impl Writer {
    pub(super) fn new(is_verbatim: bool) -> Self {
        Writer { text: String::new(), keys: HashSet::new(), is_verbatim, notes: Notes::default() }
    }

    /// Starts a section.
    pub(super) fn section(&mut self, name: impl Display) {
        if !self.text.is_empty() {
            self.text += END;
        }
        let _ = write!(self.text, "[{name}]{END}");
        self.keys.clear();
    }

    /// `key=value`, where the value has no blanks around it and no line break in it.
    pub(super) fn entry(&mut self, key: &'static str, value: impl Display) {
        self.keys.insert(key.to_ascii_lowercase());
        self.numbered(key, value);
    }

    /// [`entry`](Self::entry) of a key that is made up.
    pub(super) fn numbered(&mut self, key: impl Display, value: impl Display) {
        let _ = write!(self.text, "{key}={value}{END}");
    }

    /// 0 or 1.
    pub(super) fn flag(&mut self, key: &'static str, value: bool) {
        self.entry(key, u8::from(value));
    }

    /// An entry of text that is read as it stands; none where it is empty.
    pub(super) fn plain(&mut self, key: &'static str, text: &str, subject: Subject<'_>) {
        if !text.is_empty() {
            let text = self.one_line(text, subject);
            self.entry(key, text);
        }
    }

    /// A name, which is read without a pair of quotation marks around it.
    pub(super) fn name(&mut self, key: &'static str, name: &str, subject: Subject<'_>) {
        let name = self.one_line(name, subject);
        self.entry(key, quoted(&name));
    }

    /// A comment line.
    pub(super) fn comment(&mut self, text: &str) {
        let text = self.one_line(text, Subject::Device);
        let _ = write!(self.text, "; {text}{END}");
    }

    /// Extension attributes and comments, in their order.
    pub(super) fn extensions<'e>(&mut self, list: impl IntoIterator<Item = &'e Extension>, subject: Subject<'_>) {
        for extension in list {
            self.extension(&extension.key, &extension.value, subject);
        }
    }

    /// An extension attribute, or a comment.
    pub(super) fn extension(&mut self, key: &str, value: &str, subject: Subject<'_>) {
        if key == ";" {
            return self.comment(value);
        }
        if self.keys.contains(&key.to_ascii_lowercase()) || !is_key(key) || !self.is_verbatim && !is_word(key) {
            return self.notes.add(NoteKind::Extension, subject);
        }
        if !self.is_verbatim {
            self.keys.insert(key.to_ascii_lowercase());
        }
        let value = self.one_line(value, subject);
        self.numbered(key, value);
    }

    /// `text` without what would end the line, or the file.
    pub(super) fn one_line<'t>(&mut self, text: &'t str, subject: Subject<'_>) -> Cow<'t, str> {
        const BREAKS: [char; 4] = ['\r', '\n', '\u{1a}', '\0'];
        if !text.contains(BREAKS) {
            return Cow::Borrowed(text);
        }
        self.notes.add(NoteKind::LineBreak, subject);
        Cow::Owned(text.trim().replace("\r\n", " ").replace(BREAKS, " "))
    }

    pub(super) fn finish(mut self) -> (String, Vec<Note>) {
        let mut section = "";
        for line in self.text.lines() {
            if line.starts_with('[') {
                section = line;
            }
            if !line.is_ascii() {
                self.notes.add(NoteKind::NotAscii, Subject::Named(section));
            }
            if line.len() > MAX_LINE && line.chars().count() > MAX_LINE {
                self.notes.add(NoteKind::LongLine, Subject::Named(section));
            }
        }
        (self.text, self.notes.finish())
    }
}

/// Whether a line can have this key. What CiA 306 allows are letters and digits; real files have more.
fn is_key(key: &str) -> bool {
    !key.is_empty() && key.trim() == key && !key.starts_with([';', '#', '[']) && !key.contains(['=', '\r', '\n'])
}

/// Whether a tool that keeps to the grammar can read this key.
fn is_word(key: &str) -> bool {
    key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// `text` in quotation marks, where it would lose its own or the blanks around it without them.
pub(super) fn quoted(text: &str) -> Cow<'_, str> {
    const BLANKS: [char; 2] = [' ', '\t'];
    let has_own = text.len() > 1 && text.starts_with('"') && text.ends_with('"');
    if has_own || text.starts_with(BLANKS) || text.ends_with(BLANKS) {
        return Cow::Owned(format!("\"{text}\""));
    }
    Cow::Borrowed(text)
}
