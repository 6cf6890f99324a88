//! The text list, which contains the texts of the file in all languages.

use std::collections::{HashMap, HashSet};

use compact_str::{format_compact, CompactString};

use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Documentation, Texts, UnusedText};

/// A language code and the texts in this language, with their identifiers.
type Language<'t> = (&'t CompactString, Vec<(&'t CompactString, &'t CompactString)>);

/// The texts that the file refers to.
#[derive(Default)]
pub(super) struct TextList {
    texts: Vec<(CompactString, CompactString, Texts)>,
    /// Identifiers of texts, keyed by text and translations.
    known: HashMap<(CompactString, Vec<(CompactString, CompactString)>), CompactString>,
    used_ids: HashSet<CompactString>,
    next: usize,
}

impl TextList {
    /// Creates a text list with the unused texts of the source. These texts keep their identifiers, because attributes that the IR
    /// stores unchanged can refer to them.
    pub(super) fn new(unused: &[UnusedText]) -> Self {
        let texts = unused.iter().map(|text| (text.id.clone(), text.text.clone(), text.translations.clone()));
        let used_ids = unused.iter().map(|text| text.id.clone()).collect();
        TextList { texts: texts.collect(), used_ids, ..TextList::default() }
    }

    /// Returns the identifier of a text. Adds the text if the list does not contain it.
    pub(super) fn id(&mut self, text: &str, names: &Texts) -> CompactString {
        let others = names.iter().map(|local| (local.language.clone(), local.text.clone())).collect();
        let key = (CompactString::from(text), others);
        if let Some(id) = self.known.get(&key) {
            return id.clone();
        }
        let id = self.add(text, names);
        self.known.insert(key, id.clone());
        id
    }

    /// Adds a text with a new identifier and returns the identifier. [`id`](Self::id) does not return this identifier
    /// again, so no other element refers to the added text.
    pub(super) fn add(&mut self, text: &str, names: &Texts) -> CompactString {
        let id = loop {
            self.next += 1;
            let id = format_compact!("T{}", self.next);
            if self.used_ids.insert(id.clone()) {
                break id;
            }
        };
        self.texts.push((id.clone(), text.into(), names.clone()));
        id
    }

    /// Writes an element that refers to a text.
    pub(super) fn text(&mut self, xml: &mut Xml, element: &'static str, text: &str, names: &Texts) {
        xml.empty(element, &[("TextId", &self.id(text, names))]);
    }

    /// Writes an element that refers to the text of a description.
    pub(super) fn documentation(
        &mut self,
        xml: &mut Xml,
        element: &'static str,
        documentation: Option<&Documentation>,
    ) {
        if let Some(documentation) = documentation {
            self.text(xml, element, &documentation.text, &documentation.translations);
        }
    }

    /// Returns the languages in the order of first occurrence, each with its texts.
    fn translations(&self) -> Vec<Language<'_>> {
        let mut positions: HashMap<&str, usize> = HashMap::new();
        let mut languages: Vec<Language<'_>> = Vec::new();
        for (id, _, names) in &self.texts {
            for local in names.iter() {
                let at = *positions.entry(&local.language).or_insert(languages.len());
                if at == languages.len() {
                    languages.push((&local.language, Vec::new()));
                }
                // If a text has two translations in one language, the first one is used.
                if let Some((_, texts)) =
                    languages.get_mut(at).filter(|(_, texts)| texts.last().is_none_or(|last| last.0 != id))
                {
                    texts.push((id, &local.text));
                }
            }
        }
        languages
    }

    /// Writes the ExternalTextList element.
    pub(super) fn write(self, xml: &mut Xml) {
        xml.open("ExternalTextList");
        xml.open("PrimaryLanguage");
        for (id, value, _) in &self.texts {
            xml.empty("Text", &[("TextId", id), ("Value", value)]);
        }
        xml.close();
        for (language, texts) in self.translations() {
            if !is_tag(language) {
                xml.notes.add_many(NoteKind::Language, texts.len(), Subject::Named(language));
                continue;
            }
            xml.open("Language");
            xml.attribute("xml:lang", language);
            texts.into_iter().for_each(|(id, value)| xml.empty("Text", &[("TextId", id), ("Value", value)]));
            xml.close();
        }
        xml.close();
    }
}

/// Returns whether a text has the form of a language tag (`xs:language`).
fn is_tag(text: &str) -> bool {
    let mut parts = text.split('-');
    let is_part = |part: &str| (1..=8).contains(&part.len()) && part.bytes().all(|byte| byte.is_ascii_alphanumeric());
    parts.next().is_some_and(|first| is_part(first) && first.bytes().all(|byte| byte.is_ascii_alphabetic()))
        && parts.all(is_part)
}
