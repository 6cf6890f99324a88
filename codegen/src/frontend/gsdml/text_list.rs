//! The text list at the end of a file.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use compact_str::{format_compact, CompactString};

use super::reader::Reader;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::xml::{Given, Read};
use crate::ir::{Extension, Extensions, LocalText, Texts};
use crate::source::Span;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// The texts of a file by their identifiers.
#[derive(Default)]
pub(super) struct TextList<'a> {
    places: HashMap<Cow<'a, str>, usize>,
    entries: Vec<Entry<'a>>,
    translations: Vec<Translation<'a>>,
    /// How many texts the primary language has.
    primaries: usize,
    languages: Vec<CompactString>,
    seen: HashMap<CompactString, Span>,
    /// The entry that the next text most likely belongs to: languages list the same texts in the same order, in which they are mostly
    /// referred to as well.
    next: usize,
}

struct Entry<'a> {
    id: Cow<'a, str>,
    /// Span of the identifier.
    span: Span,
    primary: Option<Cow<'a, str>>,
    /// First and last of its translations.
    translations: Option<(usize, usize)>,
    /// The finished text, once somebody refers to it.
    finished: Option<(CompactString, Texts)>,
}

struct Translation<'a> {
    language: usize,
    /// Span of the identifier in the list of the language.
    span: Span,
    text: Cow<'a, str>,
    next: Option<usize>,
}

/// One `Text` of a list.
struct Text<'a> {
    id: Given<'a>,
    value: Cow<'a, str>,
}

impl<'a> TextList<'a> {
    /// Reads ExternalTextList.
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
        // Every text of the language has a copy of its name.
        let name = CompactString::from(brief(&reader.single(parent, "lang")?.text));
        if let Some(&first) = self.seen.get(&name) {
            let message = format!("the texts of the language `{name}` are listed twice");
            let diagnostic = Diagnostic::new(&codes::DUPLICATE_ID, parent.span, message);
            reader
                .diagnostics
                .push(diagnostic.label("both lists are used, equal texts once").note_at(first, "the first list"));
        }
        self.seen.insert(name.clone(), parent.span);
        let language = self.languages.len();
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

    /// The entry with this identifier, made where there is none.
    fn entry(&mut self, id: Given<'a>) -> usize {
        let at = match self.entries.get(self.next) {
            Some(entry) if entry.id == id.text => self.next,
            _ => *self.places.entry(id.text.clone()).or_insert(self.entries.len()),
        };
        if at == self.entries.len() {
            let Given { text: id, span } = id;
            self.entries.push(Entry { id, span, primary: None, translations: None, finished: None });
        }
        self.next = at + 1;
        at
    }

    /// Adds a translation. Returns the span of an earlier one in the same language if there is one.
    fn translate(&mut self, at: usize, language: usize, span: Span, text: Cow<'a, str>) -> Option<Span> {
        let number = self.translations.len();
        let entry = self.entries.get_mut(at)?;
        match &mut entry.translations {
            Some((_, last)) => {
                let before = self.translations.get_mut(*last)?;
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

    /// Reports a language that has only `count` of the texts of the primary one.
    fn report_missing(&self, diagnostics: &mut Diagnostics, tag: &Tag<'a>, language: usize, count: usize) {
        let missing = self.primaries.saturating_sub(count);
        if missing == 0 {
            return;
        }
        let name = self.languages.get(language).map_or("", CompactString::as_str);
        let texts = if missing == 1 { "text has" } else { "texts have" };
        let message = format!("{missing} {texts} no translation in the language `{name}`");
        let mut diagnostic = Diagnostic::new(&codes::MISSING_TRANSLATION, tag.span, message)
            .label("the primary language is used for them");
        let last = |entry: &Entry<'a>| entry.translations.and_then(|(_, last)| self.translations.get(last));
        let translated = |entry: &Entry<'a>| last(entry).is_some_and(|last| last.language == language);
        // No further than the language itself is long: a file may have many languages of one text.
        let mut near = self.entries.iter().take(count + 1);
        if let Some(first) = near.find(|entry| entry.primary.is_some() && !translated(entry)) {
            diagnostic = diagnostic.note_at(first.span, "the first of them");
        }
        diagnostics.push(diagnostic);
    }

    /// The text with this identifier, and its translations.
    pub fn find(&mut self, id: &str) -> Option<(CompactString, Texts)> {
        let at = match self.entries.get(self.next) {
            Some(entry) if entry.id == id => self.next,
            _ => *self.places.get(id)?,
        };
        self.next = at + 1;
        if self.entries.get(at)?.finished.is_none() {
            let finished = self.finish(self.entries.get(at)?);
            self.entries.get_mut(at)?.finished = Some(finished);
        }
        self.entries.get(at)?.finished.clone()
    }

    /// Texts that nothing refers to become extensions, and those that the primary language lacks are reported.
    pub fn close(&self, diagnostics: &mut Diagnostics, extensions: &mut Extensions) {
        for entry in &self.entries {
            if entry.primary.is_none() {
                let message = format!("the primary language has no text `{}`", brief(&entry.id));
                let diagnostic = Diagnostic::new(&codes::MISSING_TEXT, entry.span, message);
                diagnostics.push(diagnostic.label("the first translation is used as the name"));
            }
            if entry.finished.is_none() {
                self.keep_unused(entry, diagnostics, extensions);
            }
        }
    }

    fn keep_unused(&self, entry: &Entry<'a>, diagnostics: &mut Diagnostics, extensions: &mut Extensions) {
        if diagnostics.wants(&codes::UNUSED_TEXT) {
            let message = format!("nothing refers to the text `{}`", brief(&entry.id));
            let diagnostic = Diagnostic::new(&codes::UNUSED_TEXT, entry.span, message);
            diagnostics.push(diagnostic.label("kept as an extension attribute"));
        }
        let (name, texts) = self.finish(entry);
        let key = |language: &str| format_compact!("Text/{language}/{}", brief(&entry.id));
        if entry.primary.is_some() {
            extensions.push(Extension { key: key("primary"), value: name, span: entry.span });
        }
        let others = texts.iter().map(|local| (key(&local.language), local.text.clone()));
        extensions.extend(others.map(|(key, value)| Extension { key, value, span: entry.span }));
    }

    /// The name and its translations.
    fn finish(&self, entry: &Entry<'a>) -> (CompactString, Texts) {
        let mut texts = Vec::new();
        // A language that is listed twice has some texts twice, mostly all of them.
        let is_repeated = self.seen.len() < self.languages.len();
        let mut seen = HashSet::new();
        let mut chain = entry.translations;
        while let Some(translation) = chain.and_then(|(at, _)| self.translations.get(at)) {
            let language = self.languages.get(translation.language).cloned().unwrap_or_default();
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
    let message = format!("the text `{}` is listed twice in one language", brief(id));
    diagnostics.push(
        Diagnostic::new(&codes::DUPLICATE_ID, span, message)
            .label("left out; the first one is used")
            .note_at(first, "listed here"),
    );
}

fn read_text<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Option<Text<'a>>> {
    if tag.name != "Text" {
        reader.unknown(tag)?;
        return Ok(None);
    }
    // Blanks around a text are part of it.
    let [id, value] = reader.attributes_with_blanks(tag, ["TextId", "Value"])?;
    reader.no_children(tag)?;
    if !reader.require(tag, &id, "TextId", "left out: nothing can refer to it") {
        return Ok(None);
    }
    reader.require(tag, &value, "Value", "taken for an empty text");
    Ok(Some(Text { id: id.trimmed(), value: value.text }))
}
