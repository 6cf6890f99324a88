//! Reader of an EDS or DCF file, and functions that read single entries.

use super::keywords::{Key, KEYS};
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::frontend::canopen::number::{self, Parsed};
use crate::frontend::canopen::value::Converter;
use crate::ir::{CompactString, Extension, Extensions, Type};
use crate::limits;
use crate::source::{Origin, Span};
use crate::syntax::ini::{Document, Entry, Section};

pub(super) struct Reader<'a, 'd> {
    pub doc: &'a Document<'a>,
    pub diagnostics: &'d mut Diagnostics,
    pub aliases: &'d [String],
    /// Types that the file defines, by data type code. Objects are read in the order of their indices, so data types
    /// are read before the objects that use them.
    pub types: Vec<(u32, Type)>,
    /// Targets of object links, which are checked after all objects are read.
    pub link_spans: Vec<(u16, Span)>,
    /// Sections `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]` of objects that the file does not describe. The
    /// entries of these sections become extensions of the device.
    pub orphan_sections: Vec<Section>,
    /// Number of modules that `[SupportedModules]` announces, and the span of the number.
    pub announced_modules: Option<(u32, Span)>,
    /// Number of items that were announced by the `CompactSubObj` entries read so far.
    pub derived_items: usize,
    /// Remaining number of text bytes that may be copied: names of sections in the keys of extensions, and texts of
    /// objects with `CompactSubObj`.
    pub copies_left: usize,
    pub copies_exceeded: bool,
    /// Comments after values. They are collected until the element that contains the values is complete.
    pub comments: Extensions,
    /// Span of the first flag that is a hexadecimal number, and the number of such flags. One diagnostic reports all
    /// hexadecimal flags, because a tool writes all flags in the same way.
    pub hex_flags: Option<(Span, usize)>,
    /// For each keyword of an object, the keyword that most recently followed it. The last element is the keyword that most recently
    /// was the first of its section.
    pub next_keys: [Key; KEYS + 1],
}

/// Form of a value that is not free text. The form determines whether a comment may follow the value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Fixed {
    /// Number or access type, often followed by a comment after `;`.
    Number,
    /// Flag: 0 or 1, without further text.
    Flag,
}

/// Key of extensions that contain comments.
const COMMENT: CompactString = CompactString::const_new(";");

fn repeated(later: Span, key: &str) -> Diagnostic {
    codes::DUPLICATE_KEY.at(later, format!("the key `{key}` occurs twice in this section"))
}

impl<'a, 'd> Reader<'a, 'd> {
    pub(super) fn converter(&mut self) -> Converter<'_> {
        Converter { diagnostics: self.diagnostics, aliases: self.aliases }
    }

    /// Reports a diagnostic with a message and a label at `span`.
    pub(super) fn report(
        &mut self,
        code: &'static Code,
        span: Span,
        message: impl Into<String>,
        label: impl Into<String>,
    ) {
        self.diagnostics.push(code.at(span, message).label(label));
    }

    /// Returns the value of an entry that is not free text, without its comment and quotation marks. Adds the comment
    /// to `comments`.
    pub(super) fn fixed(&mut self, entry: &Entry, form: Fixed) -> (&'a str, Span) {
        let text = self.doc.value(entry);
        let span = self.doc.value_span(entry);
        let cut = text.bytes().position(|byte| matches!(byte, b';' | b'#' | b'"'));
        let Some(cut) = cut else { return (text, span) };
        self.fixed_part(text, span, cut, form)
    }

    /// Returns the value of an entry that is a plain number. The value has neither comment nor quotation marks, and needs no
    /// diagnostic.
    pub(super) fn plain(&self, entry: &Entry) -> Option<i64> {
        number::plain(self.doc.value(entry))
    }

    /// Reads a value as [`fixed`](Self::fixed) does. `mark` is the offset of the first comment mark or quotation mark
    /// in `text`.
    #[cold]
    fn fixed_part(&mut self, text: &'a str, span: Span, mark: usize, form: Fixed) -> (&'a str, Span) {
        // A comment mark in quotation marks is part of the value.
        let quoted = text.starts_with('"').then(|| text[1..].find('"').map(|close| close + 2)).flatten();
        let from = quoted.unwrap_or(if text.as_bytes()[mark] == b'"' { text.len() } else { mark });
        let cut = text[from..].find([';', '#']).map(|at| from + at);
        let kept = text[..cut.unwrap_or(text.len())].trim_end();
        let kept_span = Span::new(span.file, span.start, span.start + kept.len().max(1) as u32);
        if let Some(cut) = cut {
            let rest = Span::new(span.file, span.start + cut as u32, span.end);
            self.comment_behind(text, cut, kept, rest, form);
        }
        (self.converter().unquoted(kept, kept_span).trim(), kept_span)
    }

    fn comment_behind(&mut self, text: &str, cut: usize, kept: &str, rest: Span, form: Fixed) {
        let found = match (text.as_bytes()[cut], form) {
            (b'#', _) => Some((&codes::HASH_COMMENT, "there is a `#` comment after the value")),
            (_, Fixed::Flag) => Some((&codes::TRAILING_TEXT, "there is text after the value")),
            // A `;` comment after a number or access type is not reported. CiA 306 defines `;` only at the start of a
            // line, but most tools end a number at `;`.
            _ => None,
        };
        if let Some((code, message)) = found {
            // The span includes the spaces before the comment, so that the fix removes them.
            let marked = Span::new(rest.file, rest.start - (cut - kept.len()) as u32, rest.end);
            self.diagnostics.push(code.at(marked, message).label(format!("the value is `{kept}`")).fix(""));
        }
        let comment = text[cut + 1..].trim();
        if !comment.is_empty() {
            self.comments.push(Extension { key: COMMENT, value: comment.into(), span: rest });
        }
    }

    /// Moves the collected comments to the extensions of their element.
    pub(super) fn take_comments(&mut self, extensions: &mut Extensions) {
        if !self.comments.is_empty() {
            extensions.append(&mut self.comments);
        }
    }

    /// Reads a flag. Reports a value other than 0 and 1, unless the value is empty. Reads `true`, `yes` and numbers
    /// except 0 as 1, and any other text as 0.
    pub(super) fn flag(&mut self, entry: &Entry) -> bool {
        match self.doc.value(entry) {
            "0" | "" => return false,
            "1" => return true,
            _ => {}
        }
        let (text, span) = self.fixed(entry, Fixed::Flag);
        let value = match text {
            "0" | "" => return false,
            "1" => return true,
            _ if ["true", "yes"].iter().any(|word| word.eq_ignore_ascii_case(text)) => Some(true),
            _ if ["false", "no"].iter().any(|word| word.eq_ignore_ascii_case(text)) => Some(false),
            _ => match number::parse(text, &[]).parsed {
                Parsed::Int { value: value @ (0 | 1), hex: true } => {
                    self.hex_flags.get_or_insert((span, 0)).1 += 1;
                    return value == 1;
                }
                Parsed::Int { value, .. } => Some(value != 0),
                _ => None,
            },
        };
        let key = self.doc.key(entry);
        let read_as = if value == Some(true) { "1" } else { "0" };
        let found = codes::NOT_BOOLEAN.at(span, format!("{key} is `{text}`, expected 0 or 1"));
        self.diagnostics.push(found.label(format!("read as {read_as}")).fix(read_as));
        value.unwrap_or(false)
    }

    /// Reports all hexadecimal flags in one diagnostic.
    pub(super) fn report_hex_flags(&mut self) {
        let Some((span, count)) = self.hex_flags.take() else { return };
        let message = match count {
            1 => "a flag is a hexadecimal number instead of 0 or 1".to_owned(),
            _ => format!("{count} flags are hexadecimal numbers instead of 0 or 1"),
        };
        let label = if count == 1 { "read as a number" } else { "first of these flags; all are read as numbers" };
        self.diagnostics.push(codes::NOT_BOOLEAN.at(span, message).label(label));
    }

    /// Reads a number without reporting a nonstandard spelling, which is reported when the entry itself is read.
    pub(super) fn peek_number(&self, entry: Option<&Entry>) -> Option<i128> {
        let text = self.doc.value(entry?);
        let text = text.split([';', '#']).next().unwrap_or("").trim().trim_matches('"');
        number::parse(text, &[]).int()
    }

    /// Reads a 32-bit number. Returns `None` for any other text, and reports this text unless it is empty.
    pub(super) fn u32_of(&mut self, entry: &Entry) -> Option<u32> {
        self.unsigned(entry, u32::MAX)
    }

    /// Reads a number up to `max`. Returns `None` for any other text, and reports this text unless it is empty.
    pub(super) fn unsigned(&mut self, entry: &Entry, max: u32) -> Option<u32> {
        let in_range = |value: i64| u32::try_from(value).ok().filter(|&value| value <= max);
        if let Some(value) = self.plain(entry).and_then(in_range) {
            return Some(value);
        }
        let (text, span) = self.fixed(entry, Fixed::Number);
        if text.is_empty() {
            return None;
        }
        let number = number::parse(text, &[]);
        // All tools read `001` as 1, but they disagree about `018` and `010`.
        let harmless = number.quirk == Some(number::Quirk::LeadingZero) && number::is_octal(text);
        if !harmless {
            self.converter().quirk(number, text, span);
        }
        let value = number.int().and_then(|value| u32::try_from(value).ok()).filter(|&value| value <= max);
        if value.is_none() {
            let key = self.doc.key(entry);
            let message = format!("{key} is `{text}`, expected a number from 0 to {max}");
            self.diagnostics.push(codes::ILLEGAL_NUMBER.at(span, message).label("left out"));
        }
        value
    }

    /// Reads the index in an entry of a list. Returns `None` for any other text, and reports this text unless it is
    /// empty.
    pub(super) fn index_of(&mut self, entry: &Entry) -> Option<u16> {
        let (text, span) = self.fixed(entry, Fixed::Number);
        if text.is_empty() {
            return None;
        }
        let number = number::parse(text, &[]);
        self.converter().quirk(number, text, span);
        let index = number.int().and_then(|index| u16::try_from(index).ok());
        if index.is_none() {
            let message = format!("`{text}` is not an object index");
            let found = codes::ILLEGAL_NUMBER.at(span, message).label("left out");
            self.diagnostics.push(found.help("write an index from 0x1000 to 0xFFFF"));
        }
        index
    }

    /// Returns the decimal number in the key of a list entry, or `None` if the key is not a number of at most 9 digits.
    pub(super) fn key_number(&self, entry: &Entry) -> Option<u32> {
        let key = self.doc.key(entry);
        (key.len() <= 9 && key.bytes().all(|byte| byte.is_ascii_digit())).then(|| key.parse().ok()).flatten()
    }

    /// Returns the span of an entry's value, or an empty span if there is no entry.
    pub(super) fn span_of(&self, entry: Option<&Entry>) -> Span {
        entry.map_or(Span::default(), |entry| self.doc.value_span(entry))
    }

    /// Reads free text into `name`, and removes one surrounding pair of quotation marks.
    pub(super) fn name(&mut self, entry: Option<&Entry>, name: &mut CompactString, at: &mut Span) {
        let Some(entry) = entry else { return };
        let (text, span) = (self.doc.value(entry), self.doc.value_span(entry));
        *name = if text.starts_with('"') { self.converter().unquoted(text, span).into() } else { text.into() };
        *at = span;
    }

    /// Stores a comment, or an entry with an unknown key, as an extension. Drops a comment that contains no letter or
    /// digit, such as a line of dashes.
    pub(super) fn extension(&mut self, entry: &Entry, extensions: &mut Extensions) {
        let (key, value, span) = (self.doc.key(entry), self.doc.value(entry), self.doc.value_span(entry));
        if self.doc.is_comment(entry) {
            if value.bytes().any(|byte| byte.is_ascii_alphanumeric() || !byte.is_ascii()) {
                extensions.push(Extension { key: COMMENT, value: value.into(), span });
            }
            return;
        }
        let known = extensions.iter().rev().take(limits::MAX_COMPARED_EXTENSIONS);
        let is_twice =
            |other: &&Extension| other.key.eq_ignore_ascii_case(key) && self.doc.is_same_section(other.span, span);
        if let Some(earlier) = known.into_iter().find(is_twice) {
            let earlier = earlier.span;
            self.diagnostics.push(
                repeated(self.doc.key_span(entry), key).label("both are kept").note_at(earlier, "first occurrence"),
            );
        }
        if self.diagnostics.wants(&codes::UNKNOWN_KEY) {
            let message = format!("CiA 306 does not define the key `{key}`");
            self.report(&codes::UNKNOWN_KEY, self.doc.key_span(entry), message, "kept as an extension attribute");
        }
        extensions.push(Extension { key: key.into(), value: value.into(), span });
    }

    /// Reports a mandatory section that the file lacks.
    pub(super) fn missing_section(&mut self, name: &str) {
        let file = self.doc.sections().first().map_or(Span::default(), |first| self.doc.name_span(first)).file;
        let message = format!("the section [{name}] is missing");
        self.diagnostics.push(codes::MISSING_SECTION.at(Span::new(file, 0, 0), message));
    }

    /// Reports a mandatory entry that a section lacks. `sections` are all sections with the same name.
    pub(super) fn missing_entry(&mut self, sections: &[Section], key: &str) {
        let Some(section) = sections.first() else { return };
        if self.diagnostics.wants(&codes::MISSING_ENTRY) {
            let message = format!("the section [{}] has no key `{key}`", self.doc.name(section));
            let span = self.doc.name_span(section);
            self.diagnostics.push(codes::MISSING_ENTRY.at(span, message));
        }
    }

    /// Stores the entry of a key, and reports an earlier entry with the same key.
    #[inline]
    pub(super) fn once(&mut self, seen: &mut Option<Entry>, entry: &Entry) {
        if let Some(earlier) = seen.replace(*entry) {
            self.duplicate_key(&earlier, entry);
        }
    }

    pub(super) fn duplicate_key(&mut self, earlier: &Entry, later: &Entry) {
        let found = repeated(self.doc.key_span(later), self.doc.key(later)).label("this value is used");
        self.diagnostics.push(found.note_at(self.doc.value_span(earlier), "this value is ignored"));
    }

    pub(super) fn duplicate_sections(&mut self, same: &[Section]) {
        for later in same.iter().skip(1) {
            self.duplicate_section(&same[0], later, "merged with the first section of this name");
        }
    }

    pub(super) fn duplicate_section(&mut self, first: &Section, later: &Section, label: &str) {
        let message = format!("the section [{}] occurs twice", self.doc.name(later));
        let found = codes::DUPLICATE_SECTION.at(self.doc.name_span(later), message).label(label);
        self.diagnostics.push(found.note_at(self.doc.name_span(first), "first occurrence"));
    }

    /// Stores an entry as an extension with the key `section/key`. The entry is in a section that CiA 306 does not define, or
    /// belongs to an object or sub-index that the file does not describe. Drops the entry if the limit for copied text is exceeded.
    pub(super) fn foreign(&mut self, section: &Section, entry: &Entry, extensions: &mut Extensions) {
        let name = self.doc.name(section);
        let key = if self.doc.is_comment(entry) { ";" } else { self.doc.key(entry) };
        if self.may_copy(name.len(), self.doc.key_span(entry)) {
            let key = compact_str::format_compact!("{name}/{key}");
            let (value, span) = (self.doc.value(entry), self.doc.value_span(entry));
            extensions.push(Extension { key, value: value.into(), span });
        }
    }

    /// Subtracts `bytes` from the number of text bytes that may still be copied. Returns false if the remaining number
    /// is too small, and reports this case only once.
    pub(super) fn may_copy(&mut self, bytes: usize, span: Span) -> bool {
        if let Some(left) = self.copies_left.checked_sub(bytes) {
            self.copies_left = left;
            return true;
        }
        if !std::mem::replace(&mut self.copies_exceeded, true) {
            let message = "copied texts would exceed the size limit of the description";
            let found = codes::INPUT_TOO_LARGE.at(span, message).label("further copies are left out");
            self.diagnostics
                .push(found.help("shorten the name of the section, or the texts of the object that has CompactSubObj"));
        }
        false
    }

    pub(super) fn too_many_derived(&mut self, span: Span) {
        self.diagnostics.push(
            codes::INPUT_TOO_LARGE
                .at(span, format!("CompactSubObj adds more than {} sub-indices", limits::MAX_DERIVED_ITEMS)),
        );
    }

    pub(super) fn origin(&self, section: &Section) -> Origin {
        Origin { span: self.doc.name_span(section), line: section.line }
    }
}
