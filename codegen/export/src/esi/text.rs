//! Formats numbers and writes texts in several languages.

use std::fmt;

use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::etg::language;
use lexibus_codegen::ir::{Documentation, LocalText, Texts};

/// Formats a bit pattern in the notation of ETG.2000, with at least `digits` digits.
pub(super) fn hex(value: impl Into<u32>, digits: usize) -> impl fmt::Display {
    format!("#x{:0digits$X}", value.into())
}

/// Writes a name and its translations.
pub(super) fn names(xml: &mut Xml, element: &'static str, text: &str, others: &Texts, subject: Subject<'_>) {
    // If there is another English name, write the language number: without the number, a reader would use the other
    // name.
    let is_english = |local: &LocalText| language::lcid(&local.language) == Some(language::ENGLISH);
    xml.open(element);
    xml.optional("LcId", others.iter().any(is_english).then_some(language::ENGLISH));
    xml.content(text);
    xml.close();
    for local in others.iter() {
        name(xml, element, local, subject);
    }
}

/// Writes a text in one language.
pub(super) fn name(xml: &mut Xml, element: &'static str, local: &LocalText, subject: Subject<'_>) {
    let Some(lcid) = language::lcid(&local.language) else {
        return xml.notes.add(NoteKind::Language, subject);
    };
    xml.open(element);
    xml.attribute("LcId", lcid);
    xml.content(&local.text);
    xml.close();
}

/// Writes a description unless it is empty.
pub(super) fn documentation(
    xml: &mut Xml,
    element: &'static str,
    documentation: Option<&Documentation>,
    subject: Subject<'_>,
) {
    if let Some(documentation) = documentation.filter(|documentation| !documentation.text.is_empty()) {
        names(xml, element, &documentation.text, &documentation.translations, subject);
    }
}
