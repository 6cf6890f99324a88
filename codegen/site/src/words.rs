//! Texts on documentation pages. The templates escape these texts.

pub(super) use lexibus_codegen::facts::words::{one_line, PLAIN};
use lexibus_codegen::ir::{Documentation, Texts};

/// Returns the name of a state or command in words: `switch on disabled` for the identifier `switch_on_disabled`. Names
/// that are not lowercase identifiers stay unchanged.
pub(super) fn readable(name: &str) -> String {
    let is_identifier = name.chars().all(|letter| letter.is_lowercase() || letter.is_ascii_digit() || letter == '_');
    if is_identifier {
        name.replace('_', " ").trim().to_owned()
    } else {
        name.to_owned()
    }
}

/// Separator of the languages that share a translation.
const SEPARATOR: &str = ", ";

/// Returns the translations of a name, each with its languages: `("de, fr", "Position")`. Translations that equal
/// `name`, apart from capitals, underscores and hyphens, are left out. Languages with the same text share one entry.
pub(super) fn names(name: &str, translations: &Texts) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    let original = compared(name);
    for translation in translations.iter().filter(|translation| compared(&translation.text) != original) {
        match all.iter_mut().find(|(_, text)| *text == translation.text) {
            Some((languages, _)) => {
                languages.push_str(SEPARATOR);
                languages.push_str(&translation.language);
            }
            None => all.push((translation.language.to_string(), translation.text.to_string())),
        }
    }
    all
}

/// Returns a text in the form in which a name and its translation are compared: `switch on disabled` for
/// `switch_on_disabled` and for `Switch ON disabled`.
fn compared(text: &str) -> String {
    one_line(&text.replace(['_', '-'], " ")).to_lowercase()
}

/// Returns the paragraphs of a description, except those that only repeat the name of the element.
pub(super) fn description(name: &str, documentation: Option<&Documentation>) -> Vec<String> {
    let mut paragraphs = PLAIN.description(documentation);
    paragraphs.retain(|paragraph| !repeats(paragraph, name));
    paragraphs
}

/// Returns the translations of a description, each with its languages. Languages with the same text share one entry, as in
/// [`names`]. `names` are the names of the element; translations that only repeat one of them are left out.
pub(super) fn translations(
    name: &str,
    names: &[(String, String)],
    documentation: Option<&Documentation>,
) -> Vec<(String, String)> {
    let Some(documentation) = documentation else { return Vec::new() };
    let mut all = self::names(&documentation.text, &documentation.translations);
    all.retain(|(_, text)| !repeats(text, name) && names.iter().all(|(_, name)| !repeats(text, name)));
    all
}

/// Returns whether a description only repeats a name.
fn repeats(description: &str, name: &str) -> bool {
    compared(description.trim_end_matches('.')) == compared(name.trim_end_matches('.'))
}

/// Returns the first of the languages that share a translation.
pub(super) fn first_language(languages: &str) -> &str {
    languages.split(SEPARATOR).next().unwrap_or_default()
}

/// Returns the languages of a translation if there are several.
pub(super) fn shared_by(languages: &str) -> Option<&str> {
    languages.contains(SEPARATOR).then_some(languages)
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::ir::LocalText;

    use super::*;

    #[test]
    fn descriptions_do_not_repeat_names() {
        let translation = |language: &str, text: &str| LocalText { language: language.into(), text: text.into() };
        let documentation = Documentation {
            text: "Digital input\nFilter of 3 ms".into(),
            translations: [translation("de", "Digitaleingang"), translation("fr", "Entrée, filtre de 3 ms")]
                .into_iter()
                .collect(),
            ..Documentation::default()
        };
        let names = [("de".to_owned(), "Digital-Eingang".to_owned()), ("it".to_owned(), "Digitaleingang".to_owned())];
        assert_eq!(description("Digital_input", Some(&documentation)), ["Filter of 3 ms."]);
        let shown = translations("Digital_input", &names, Some(&documentation));
        assert_eq!(shown, [("fr".to_owned(), "Entrée, filtre de 3 ms".to_owned())]);
    }

    #[test]
    fn equal_translations_are_shown_once() {
        let texts = [("de", "Lage"), ("en", "Position"), ("fr", "Position "), ("nl", "Lage"), ("it", "Posizione")];
        let local = |(language, text): (&str, &str)| LocalText { language: language.into(), text: text.into() };
        let shown = names("Position", &texts.into_iter().map(local).collect());
        let expected = [("de, nl", "Lage"), ("it", "Posizione")];
        assert_eq!(shown, expected.map(|(languages, text)| (languages.to_owned(), text.to_owned())));
        let printed = [LocalText { language: "it".into(), text: "Switch ON disabled".into() }];
        assert_eq!(names("switch_on_disabled", &printed.into_iter().collect()), []);
        assert_eq!((first_language("de, nl"), shared_by("de, nl")), ("de", Some("de, nl")));
        assert_eq!((first_language("it"), shared_by("it")), ("it", None));
    }
}
