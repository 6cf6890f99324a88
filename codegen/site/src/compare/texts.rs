//! Compares texts about an element. Except for names, changes to texts have no effect.

use super::change::Judgment;
use super::comparison::{each_positioned, joined, positioned, rules, text, Comparison, CITATION};
use super::names::identifier;
use super::show::Show;
use lexibus_codegen::facts::words::{fact_name, origin_name, PLAIN};
use lexibus_codegen::ir::{
    Documentation, Doubt, Doubts, Extension, Extensions, FactOrigin, FactOrigins, Manual, ManualSection, OverlayOrigin,
};

rules!(pub(super) fn documentation(Documentation) {
    text: text("description"),
    translations: text("description in other languages"),
    text_from: positioned("origin of the description", text_from),
}, CITATION => [cite]);

/// Formats the origin of a fact without its position in the file.
pub(super) fn origin(origin: &FactOrigin) -> String {
    match origin {
        FactOrigin::Overlay(row) => {
            let OverlayOrigin { file, replaces, why, line: _ } = &**row;
            let replacing = if *replaces { ", replacing the description" } else { "" };
            let why = if why.is_empty() { String::new() } else { format!(" ({why})") };
            format!("overlay {file}{replacing}{why}")
        }
        other => origin_name(other),
    }
}

/// Compares the origins of the facts of an item or group.
pub(super) fn origins(old: &FactOrigins, new: &FactOrigins, comparison: &mut Comparison<'_>) {
    positioned("origins", |origins: &FactOrigins| {
        joined(&origins.0, |(fact, from)| format!("{}: {}", fact_name(*fact), origin(from)))
    })(old, new, comparison);
}

/// Compares the origins of a definition.
pub(super) fn stated_by(old: &Option<Box<FactOrigin>>, new: &Option<Box<FactOrigin>>, comparison: &mut Comparison<'_>) {
    positioned("origin", text_from)(old, new, comparison);
}

fn text_from(from: &Option<Box<FactOrigin>>) -> String {
    from.as_deref().map(origin).unwrap_or_default()
}

/// Joins the text of a description, its translations and its origin.
pub(super) fn described(documentation: Option<&Documentation>) -> String {
    let Some(Documentation { text, translations, text_from, cite: _ }) = documentation else { return String::new() };
    let parts = [text.to_string(), translations.show(), self::text_from(text_from)];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Compares ambiguities in the source and the related assumptions.
pub(super) fn doubts(old: &Doubts, new: &Doubts, comparison: &mut Comparison<'_>) {
    let text = |doubts: &Doubts| doubts.iter().map(doubt).collect::<Vec<_>>().join(" ");
    positioned("assumptions", text)(old, new, comparison);
}

fn doubt(doubt: &Doubt) -> String {
    let without_citation = Doubt { cite: None, ..doubt.clone() };
    format!("({}) {}", doubt.severity.name(), PLAIN.doubt(&Manual::default(), &without_citation))
}

/// Compares extensions: facts of the source for which the intermediate representation has no field.
pub(super) fn extensions(old: &Extensions, new: &Extensions, comparison: &mut Comparison<'_>) {
    let text = |extension: &Extension| format!("{} = {}", extension.key, extension.value);
    each_positioned("further keys", text)(old, new, comparison);
}

rules!(pub(super) fn manual(Manual) {
    title: text("title"),
    edition: text("edition"),
    language: text("language"),
    documentation: text("description"),
    sections: each_positioned("sections", |section: &ManualSection| section.title.to_string()),
}, CITATION => [counts]);

/// Returns the effects of renaming an element. The Rust method, field or constant of the element has this name in
/// `snake_case`.
pub(super) fn renamed<T: AsRef<str>>(old: &T, new: &T) -> Judgment {
    match identifier(old.as_ref()) == identifier(new.as_ref()) {
        true => Judgment::NONE,
        false => Judgment::API,
    }
}
