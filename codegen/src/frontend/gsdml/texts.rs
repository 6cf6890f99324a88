//! The text list, and the names that refer to it.
//!
//! The list stands at the end of a file. Until it is read, a name in the IR is the number of a reference in [`Names`],
//! perhaps with a suffix behind a blank; `resolve` puts the texts in its place.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use compact_str::{format_compact, CompactString, ToCompactString};

use super::reader::{shortened, Given, Read, Reader};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Documentation, Extension, Extensions, LocalText, Texts};
use crate::source::Span;
use crate::syntax::xml::Tag;

/// References to texts, in the order in which they were read.
#[derive(Default)]
pub(super) struct Names<'a> {
    references: Vec<Given<'a>>,
}

impl<'a> Names<'a> {
    /// The reference with this number.
    pub fn get(&self, number: usize) -> Option<&Given<'a>> {
        self.references.get(number)
    }

    /// What stands for the text with this identifier.
    pub fn hold(&mut self, given: Given<'a>) -> CompactString {
        let mark = self.references.len().to_compact_string();
        self.references.push(given);
        mark
    }
}

impl<'a> Reader<'a, '_> {
    /// What stands for the text of an element that has to have one.
    pub fn name(&mut self, tag: &Tag<'a>, given: Option<Given<'a>>) -> CompactString {
        match given {
            Some(given) => self.names.hold(given),
            None => {
                let message = format!("<{}> has no TextId, and so no name", tag.name);
                self.diagnostics.push(
                    Diagnostic::new(&codes::MISSING_TEXT, tag.name_span(), message).label("its name is left empty"),
                );
                CompactString::default()
            }
        }
    }

    /// What stands for the text of an element that has nothing but a `TextId`.
    pub fn text_reference(&mut self, tag: &Tag<'a>) -> Read<CompactString> {
        let given = self.field(tag, "TextId")?;
        Ok(self.name(tag, given))
    }

    /// The same as documentation.
    pub fn documentation(&mut self, tag: &Tag<'a>) -> Read<Option<Box<Documentation>>> {
        let text = self.text_reference(tag)?.into();
        Ok(Some(Box::new(Documentation { text, ..Documentation::default() })))
    }
}

/// What stands for the same text as `mark`, followed by `suffix`.
pub(super) fn with_suffix(mark: &str, suffix: &str) -> CompactString {
    // Without a mark, the blank in front tells the suffix from one: `2` is a mark.
    format_compact!("{mark} {suffix}")
}

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
    /// The entry that the next text most likely belongs to: languages list the same texts in the same order.
    next: usize,
}

struct Entry<'a> {
    id: Cow<'a, str>,
    /// Where the identifier stands.
    span: Span,
    primary: Option<Cow<'a, str>>,
    /// First and last of its translations.
    translations: Option<(usize, usize)>,
    /// The finished text, once somebody refers to it.
    finished: Option<(CompactString, Texts)>,
}

struct Translation<'a> {
    language: usize,
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
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, list: &Tag<'a>, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = reader.cursor.child(list)? {
            match tag.name {
                "PrimaryLanguage" => {
                    self.next = self.entries.len();
                    self.primary(reader, &tag, rest)?;
                }
                "Language" => {
                    self.next = 0;
                    self.language(reader, &tag, rest)?;
                }
                _ => reader.unknown(&tag, rest)?,
            }
        }
        Ok(())
    }

    fn primary(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = reader.cursor.child(parent)? {
            let Some(text) = read_text(reader, &tag, rest)? else { continue };
            let (span, at) = (text.id.span, self.entry(text.id));
            let Some(entry) = self.entries.get_mut(at) else { continue };
            if entry.primary.is_some() {
                repeated(reader.diagnostics, span, entry);
            } else {
                entry.primary = Some(text.value);
                self.primaries += 1;
            }
        }
        Ok(())
    }

    fn language(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, rest: &mut Extensions) -> Read<()> {
        // Every text of the language has a copy of its name.
        let name = CompactString::from(shortened(&reader.single(parent, "lang")?));
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
        while let Some(tag) = reader.cursor.child(parent)? {
            let Some(text) = read_text(reader, &tag, rest)? else { continue };
            let (span, at) = (text.id.span, self.entry(text.id));
            if self.translate(at, language, text.value) {
                count += usize::from(self.entries.get(at).is_some_and(|entry| entry.primary.is_some()));
            } else if let Some(entry) = self.entries.get(at) {
                repeated(reader.diagnostics, span, entry);
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

    /// Adds a translation; false where the language has one already.
    fn translate(&mut self, at: usize, language: usize, text: Cow<'a, str>) -> bool {
        let Some(entry) = self.entries.get_mut(at) else { return false };
        let own = self.translations.len();
        match &mut entry.translations {
            Some((_, last)) => {
                let Some(before) = self.translations.get_mut(*last) else { return false };
                if before.language == language {
                    return false;
                }
                before.next = Some(own);
                *last = own;
            }
            none => *none = Some((own, own)),
        }
        self.translations.push(Translation { language, text, next: None });
        true
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
        let at = *self.places.get(id)?;
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
                let message = format!("the primary language has no text `{}`", shortened(&entry.id));
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
            let message = format!("nothing refers to the text `{}`", shortened(&entry.id));
            let diagnostic = Diagnostic::new(&codes::UNUSED_TEXT, entry.span, message);
            diagnostics.push(diagnostic.label("kept as an extension attribute"));
        }
        let (name, texts) = self.finish(entry);
        let key = |language: &str| format_compact!("Text/{language}/{}", shortened(&entry.id));
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

fn repeated(diagnostics: &mut Diagnostics, span: Span, entry: &Entry<'_>) {
    let message = format!("the text `{}` is listed twice in one language", shortened(&entry.id));
    diagnostics.push(
        Diagnostic::new(&codes::DUPLICATE_ID, span, message)
            .label("left out; the first one is used")
            .note_at(entry.span, "listed here"),
    );
}

fn read_text<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, rest: &mut Extensions) -> Read<Option<Text<'a>>> {
    if tag.name != "Text" {
        reader.unknown(tag, rest)?;
        return Ok(None);
    }
    let (mut id, mut value) = (None, None);
    for attribute in tag.attributes() {
        let attribute = attribute?;
        match attribute.name {
            "TextId" => id = Some(Given { text: trimmed(attribute.value(reader.diagnostics)), span: attribute.span }),
            // Blanks around a text are part of it.
            "Value" => value = Some(attribute.value(reader.diagnostics)),
            _ => {
                let value = attribute.value(reader.diagnostics).into();
                rest.push(Extension { key: format_compact!("Text@{}", attribute.name), value, span: attribute.span });
            }
        }
    }
    if !tag.empty {
        reader.no_children(tag, rest)?;
    }
    let Some(id) = id else {
        reader.missing(tag, "TextId", "left out: nothing can refer to it");
        return Ok(None);
    };
    if value.is_none() {
        reader.missing(tag, "Value", "taken for an empty text");
    }
    Ok(Some(Text { id, value: value.unwrap_or_default() }))
}

fn trimmed(text: Cow<'_, str>) -> Cow<'_, str> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim_ascii()),
        Cow::Owned(text) => Cow::Owned(text.trim_ascii().to_owned()),
    }
}
