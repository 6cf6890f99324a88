//! Reads the text list at the end of a file.

use std::borrow::Cow;

use compact_str::CompactString;

use super::reader::Reader;
use crate::collections::{HashMap, HashSet};
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::{Given, Read};
use crate::ir::{LocalText, Texts, UnusedText};
use crate::source::Span;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Files rarely have more languages.
const USUAL_LANGUAGES: usize = 16;

/// Texts of a file by identifier.
#[derive(Default)]
pub(super) struct TextList<'a> {
    positions: HashMap<Cow<'a, str>, u32>,
    entries: Vec<Entry<'a>>,
    translations: Vec<Translation<'a>>,
    /// Number of texts in the primary language.
    primaries: usize,
    languages: Vec<CompactString>,
    seen: HashMap<CompactString, Span>,
    /// Position of the entry that is tried first for the next text or reference. The texts of all languages and most
    /// references have the same order.
    next: usize,
}

struct Entry<'a> {
    id: Cow<'a, str>,
    /// Span of the first occurrence of the text identifier in the text list.
    span: Span,
    primary: Option<Cow<'a, str>>,
    /// Positions of the first and the last translation.
    translations: Option<(u32, u32)>,
    /// Text with its translations, created when the first reference is resolved.
    finished: Option<(CompactString, Texts)>,
}

struct Translation<'a> {
    language: u32,
    /// Span of the text identifier in the text list of the translation's language.
    span: Span,
    text: Cow<'a, str>,
    next: Option<u32>,
}

/// `Text` element of a text list.
struct Text<'a> {
    id: Given<'a>,
    value: Cow<'a, str>,
}

impl<'a> TextList<'a> {
    /// Reads an `ExternalTextList` element.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, list: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.child(list)? {
            match tag.name {
                "PrimaryLanguage" => {
                    self.next = self.entries.len();
                    self.primary(reader, &tag)?;
                }
                "Language" => {
                    self.next = 0;
                    self.language(reader, &tag)?;
                }
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn primary(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.child(parent)? {
            let Some(text) = read_text(reader, &tag)? else { continue };
            let (span, at) = (text.id.span, self.entry(text.id));
            let Some(entry) = self.entries.get_mut(at) else { continue };
            if entry.primary.is_some() {
                repeated(reader.diagnostics, span, entry.span, &entry.id);
            } else {
                entry.primary = Some(text.value);
                self.primaries += 1;
            }
        }
        Ok(())
    }

    fn language(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        // The name of the language is copied for each text, so its length is limited.
        let name = CompactString::from(brief(&reader.single(parent, "lang")?.text));
        if let Some(&first) = self.seen.get(&name) {
            let message = format!("the language `{name}` has two lists of texts");
            let diagnostic = codes::DUPLICATE_ID.at(parent.span, message);
            reader.diagnostics.push(diagnostic.label("the lists are merged").note_at(first, "first list"));
        }
        self.seen.insert(name.clone(), parent.span);
        self.reserve();
        let language = self.languages.len() as u32;
        self.languages.push(name);
        let mut count = 0;
        while let Some(tag) = reader.child(parent)? {
            let Some(text) = read_text(reader, &tag)? else { continue };
            let (span, at) = (text.id.span, self.entry(text.id));
            match self.translate(at, language, span, text.value) {
                None => count += usize::from(self.entries.get(at).is_some_and(|entry| entry.primary.is_some())),
                Some(first) => repeated(reader.diagnostics, span, first, &self.entries[at].id),
            }
        }
        self.report_missing(reader.diagnostics, parent, language, count);
        Ok(())
    }

    /// Reserves memory for the texts of the next language, which usually has as many texts as the primary language. Before the first of
    /// these languages, frees the spare memory of the entries.
    fn reserve(&mut self) {
        if self.languages.is_empty() {
            // Translations rarely have an identifier that the primary language lacks.
            self.entries.shrink_to_fit();
        }
        // With exact capacities, the time would be quadratic in the number of languages.
        if self.languages.len() < USUAL_LANGUAGES {
            self.translations.reserve_exact(self.primaries);
        }
    }

    /// Returns the position of the entry with the identifier `id`. Adds a missing entry.
    fn entry(&mut self, id: Given<'a>) -> usize {
        let at = match self.entries.get(self.next) {
            Some(entry) if entry.id == id.text => self.next,
            _ => *self.positions.entry(id.text.clone()).or_insert(self.entries.len() as u32) as usize,
        };
        if at == self.entries.len() {
            let Given { text: id, span } = id;
            self.entries.push(Entry { id, span, primary: None, translations: None, finished: None });
        }
        self.next = at + 1;
        at
    }

    /// Adds a translation to an entry. If the last translation of the entry has the same language, adds nothing and returns the
    /// span of the existing translation.
    fn translate(&mut self, at: usize, language: u32, span: Span, text: Cow<'a, str>) -> Option<Span> {
        let number = self.translations.len() as u32;
        let entry = self.entries.get_mut(at)?;
        match &mut entry.translations {
            Some((_, last)) => {
                let before = self.translations.get_mut(*last as usize)?;
                if before.language == language {
                    return Some(before.span);
                }
                before.next = Some(number);
                *last = number;
            }
            none => *none = Some((number, number)),
        }
        self.translations.push(Translation { language, span, text, next: None });
        None
    }

    /// Reports a language that translates fewer texts than the primary language contains. `count` is the number of
    /// translated texts.
    fn report_missing(&self, diagnostics: &mut Diagnostics, tag: &Tag<'a>, language: u32, count: usize) {
        let missing = self.primaries.saturating_sub(count);
        if missing == 0 {
            return;
        }
        let name = self.languages.get(language as usize).map_or("", CompactString::as_str);
        let texts = if missing == 1 { "text has" } else { "texts have" };
        let message = format!("{missing} {texts} no translation in the language `{name}`");
        let mut diagnostic =
            codes::MISSING_TRANSLATION.at(tag.span, message).label("the primary language is used instead");
        let last = |entry: &Entry<'a>| entry.translations.and_then(|(_, last)| self.translations.get(last as usize));
        let translated = |entry: &Entry<'a>| last(entry).is_some_and(|last| last.language == language);
        // Among the first `count + 1` entries, at least one has no text in this language, so no further entries are
        // searched. This keeps the search fast if a file has many languages with one text each.
        let mut near = self.entries.iter().take(count + 1);
        if let Some(first) = near.find(|entry| entry.primary.is_some() && !translated(entry)) {
            diagnostic = diagnostic.note_at(first.span, "first text without a translation");
        }
        diagnostics.push(diagnostic);
    }

    /// Frees the memory that is reserved for further texts.
    pub fn shrink_to_fit(&mut self) {
        self.entries.shrink_to_fit();
        self.translations.shrink_to_fit();
    }

    /// Returns the text with the identifier `id` and its translations, or `None` if the list does not contain the text.
    pub fn find(&mut self, id: &str) -> Option<(CompactString, Texts)> {
        let at = match self.entries.get(self.next) {
            Some(entry) if entry.id == id => self.next,
            _ => *self.positions.get(id)? as usize,
        };
        self.next = at + 1;
        if self.entries.get(at)?.finished.is_none() {
            let finished = self.finish(self.entries.get(at)?);
            self.entries.get_mut(at)?.finished = Some(finished);
        }
        self.entries.get(at)?.finished.clone()
    }

    /// Reports unreferenced texts and adds them to `unused`. Also reports texts that are missing in the primary
    /// language.
    pub fn close(&self, diagnostics: &mut Diagnostics, unused: &mut Vec<UnusedText>) {
        for entry in &self.entries {
            if entry.primary.is_none() {
                let message = format!("the primary language has no text `{}`", brief(&entry.id));
                let diagnostic = codes::MISSING_TEXT.at(entry.span, message);
                diagnostics.push(diagnostic.label("the first translation is used instead"));
            }
            if entry.finished.is_none() {
                self.keep_unused(entry, diagnostics, unused);
            }
        }
    }

    fn keep_unused(&self, entry: &Entry<'a>, diagnostics: &mut Diagnostics, unused: &mut Vec<UnusedText>) {
        if diagnostics.wants(&codes::UNUSED_TEXT) {
            let message = format!("the text `{}` is not used", brief(&entry.id));
            diagnostics.push(codes::UNUSED_TEXT.at(entry.span, message).label("kept"));
        }
        let (name, texts) = self.finish(entry);
        let text = if entry.primary.is_some() { name } else { CompactString::default() };
        unused.push(UnusedText { id: entry.id.as_ref().into(), text, translations: texts });
    }

    /// Returns the text of an entry, and its translations.
    fn finish(&self, entry: &Entry<'a>) -> (CompactString, Texts) {
        let count = if entry.translations.is_some() { self.languages.len().min(USUAL_LANGUAGES) } else { 0 };
        let mut texts = Vec::with_capacity(count);
        // A language with two lists usually has each text twice, so repeated texts are removed.
        let is_repeated = self.seen.len() < self.languages.len();
        let mut seen = HashSet::default();
        let mut chain = entry.translations;
        while let Some(translation) = chain.and_then(|(at, _)| self.translations.get(at as usize)) {
            let language = self.languages.get(translation.language as usize).cloned().unwrap_or_default();
            if !is_repeated || seen.insert((language.clone(), translation.text.as_ref())) {
                texts.push(LocalText { language, text: translation.text.as_ref().into() });
            }
            chain = translation.next.map(|next| (next, next));
        }
        let name = match (&entry.primary, texts.first()) {
            (Some(primary), _) => primary.as_ref().into(),
            (None, Some(first)) => first.text.clone(),
            (None, None) => CompactString::default(),
        };
        (name, texts.into())
    }
}

fn repeated(diagnostics: &mut Diagnostics, span: Span, first: Span, id: &str) {
    let message = format!("the text `{}` occurs twice in one language", brief(id));
    let found = codes::DUPLICATE_ID.at(span, message).label("left out; the first one is used");
    diagnostics.push(found.note_at(first, "first occurrence"));
}

fn read_text<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Option<Text<'a>>> {
    if tag.name != "Text" {
        reader.unknown(tag)?;
        return Ok(None);
    }
    // Leading and trailing spaces belong to the text.
    let [id, value] = reader.attributes_with_blanks(tag, ["TextId", "Value"])?;
    reader.no_children(tag)?;
    if !reader.require(tag, &id, "TextId", "left out because references need an ID") {
        return Ok(None);
    }
    reader.require(tag, &value, "Value", "read as an empty text");
    Ok(Some(Text { id: id.trimmed(), value: value.text }))
}
