//! Writes lines, entries and sections.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::{Display, Write as _};

use super::note::{Note, NoteKind, Notes, Subject};
use lexibus_codegen::ir::Extension;

/// The line end that CiA 306 requires.
const END: &str = "\r\n";

/// Maximum number of characters in a line (CiA 306).
const MAX_LINE: usize = 255;

/// An EDS or DCF file that is being written.
pub(super) struct Writer {
    text: String,
    /// Keys of the current section that no extension attribute may repeat, in lowercase.
    keys: HashSet<String>,
    /// True if the source is an EDS or DCF. Keys of its extension attributes may contain characters that CiA 306 does
    /// not allow, and may occur twice.
    is_verbatim: bool,
    pub(super) notes: Notes,
}

impl Writer {
    pub(super) fn new(is_verbatim: bool) -> Self {
        Writer { text: String::new(), keys: HashSet::new(), is_verbatim, notes: Notes::default() }
    }

    /// Writes the header of a section.
    pub(super) fn section(&mut self, name: impl Display) {
        if !self.text.is_empty() {
            self.text += END;
        }
        let _ = write!(self.text, "[{name}]{END}");
        self.keys.clear();
    }

    /// Writes `key=value`. The value must have no leading or trailing spaces and no line break.
    pub(super) fn entry(&mut self, key: &str, value: impl Display) {
        self.keys.insert(key.to_ascii_lowercase());
        self.numbered(key, value);
    }

    /// Writes an entry if its value is `Some`.
    pub(super) fn optional(&mut self, key: &str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.entry(key, value);
        }
    }

    /// Writes an entry like [`entry`](Self::entry), but with a computed key, which extension attributes may repeat.
    pub(super) fn numbered(&mut self, key: impl Display, value: impl Display) {
        let _ = write!(self.text, "{key}={value}{END}");
    }

    /// Writes an entry with the value 0 or 1.
    pub(super) fn flag(&mut self, key: &str, value: bool) {
        self.entry(key, u8::from(value));
    }

    /// Writes an entry with a text, unless the text is empty. The text is not quoted, because readers of the file keep
    /// quotation marks as part of the text.
    pub(super) fn plain(&mut self, key: &str, text: &str, subject: Subject<'_>) {
        if !text.is_empty() {
            let text = self.one_line(text, subject);
            self.entry(key, text);
        }
    }

    /// Writes an entry with a name. Quotes the name if necessary, because readers of the file remove a pair of
    /// quotation marks around a name.
    pub(super) fn name(&mut self, key: &str, name: &str, subject: Subject<'_>) {
        let name = self.one_line(name, subject);
        self.entry(key, quoted(&name));
    }

    /// Writes a comment line.
    pub(super) fn comment(&mut self, text: &str) {
        let text = self.one_line(text, Subject::Device);
        let _ = write!(self.text, "; {text}{END}");
    }

    /// Writes extension attributes and comments in their given order.
    pub(super) fn extensions<'e>(&mut self, list: impl IntoIterator<Item = &'e Extension>, subject: Subject<'_>) {
        for extension in list {
            self.extension(&extension.key, &extension.value, subject);
        }
    }

    /// Writes an extension attribute or a comment. Adds a note instead if the key is invalid, or if the section already
    /// contains the key and an extension attribute must not repeat it.
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

    /// Returns `text` on one line. If `text` contains line breaks, end-of-file characters or NULs, trims the text,
    /// replaces these characters with spaces, and adds a note.
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
            self.notes.add_many(NoteKind::NotAscii, !line.is_ascii(), Subject::Named(section));
            if line.len() > MAX_LINE && line.chars().count() > MAX_LINE {
                self.notes.add(NoteKind::LongLine, Subject::Named(section));
            }
        }
        (self.text, self.notes.finish())
    }
}

/// Returns whether a line can contain the key. CiA 306 allows only letters, digits and `_`; real files contain other
/// characters.
fn is_key(key: &str) -> bool {
    !key.is_empty() && key.trim() == key && !key.starts_with([';', '#', '[']) && !key.contains(['=', '\r', '\n'])
}

/// Returns whether a tool that follows the grammar of CiA 306 can read this key.
fn is_word(key: &str) -> bool {
    key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// Quotes `text` if a reader would otherwise remove its quotation marks or its leading or trailing spaces.
pub(super) fn quoted(text: &str) -> Cow<'_, str> {
    const BLANKS: [char; 2] = [' ', '\t'];
    let is_quoted = text.len() > 1 && text.starts_with('"') && text.ends_with('"');
    if is_quoted || text.starts_with(BLANKS) || text.ends_with(BLANKS) {
        return Cow::Owned(format!("\"{text}\""));
    }
    Cow::Borrowed(text)
}
