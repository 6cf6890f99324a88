//! Diagnosis messages.

use compact_str::CompactString;

use super::data_type::enum_value;
use super::reader::{Names, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{CodeRow, CodeTable, Documentation, Extensions, LocalText, SharedList, Value};
use crate::syntax::xml::Tag;

/// The flags of a message, in the order of the columns.
const COLUMNS: [&str; 4] = ["DiagClass", "DiagReset", "DiagReaction", "DiagType"];

/// Reads DiagMessages: a table of the messages, and one of each list of numbers that their flags use.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<Vec<CodeTable>> {
    let origin = reader.cursor.origin(parent);
    let table = |name: &'static str, columns: &[&'static str]| CodeTable {
        name: CompactString::const_new(name),
        columns: columns.iter().map(|name| CompactString::const_new(name)).collect(),
        rows: SharedList::default(),
        buses: Vec::new(),
        documentation: None,
        origin,
    };
    let mut messages = table("DiagMessages", &COLUMNS);
    let mut lists = [table("DiagReset", &[]), table("DiagReaction", &[]), table("DiagType", &[])];
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "DiagMessage" {
            let row = message(reader, &tag, extensions)?;
            messages.rows.to_mut().extend(row);
        } else if let Some(list) = lists.iter_mut().find(|list| list.name == tag.name) {
            list.rows.to_mut().extend(enum_value(reader, &tag, extensions)?.map(|value| CodeRow {
                code: value.value,
                last: None,
                name: value.name,
                names: value.names,
                availability: None,
                documentation: value.documentation,
                cells: Vec::new(),
            }));
        } else {
            reader.unknown(&tag, extensions)?;
        }
    }
    let lists = lists.into_iter().filter(|list| !list.rows.is_empty());
    Ok(std::iter::once(messages).chain(lists).collect())
}

fn message<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Option<CodeRow>> {
    let (mut names, mut paragraphs, mut number) = (Names::default(), Vec::new(), None);
    let mut description = Names::default();
    let mut cells: [CompactString; COLUMNS.len()] = Default::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "TextId" => number = reader.number::<i128>(&tag, "number of a message", extensions)?,
            "MessageText" => reader.name(&tag, &mut names, extensions)?,
            "Description" => reader.name(&tag, &mut description, extensions)?,
            "Flags" => {
                while let Some(flag) = reader.cursor.child(&tag)? {
                    match COLUMNS.iter().zip(&mut cells).find(|(column, _)| **column == flag.name) {
                        Some((_, cell)) => *cell = reader.leaf(&flag, extensions)?.compact(),
                        None => reader.unknown(&flag, extensions)?,
                    }
                }
            }
            "CauseRemedy" => cause(reader, &tag, &mut paragraphs, extensions)?,
            "Info" | "Hint" | "URL" => paragraph(reader, &tag, (&mut paragraphs, 0), extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    let Some(code) = number else {
        reader.report(&codes::ESI_VALUE, parent.span, "this message has no TextId", "left out");
        return Ok(None);
    };
    paragraphs.insert(0, ("", description));
    let documentation = documentation(&paragraphs);
    let cells = cells.into_iter().map(Value::Text).collect();
    let (name, names) = (names.name(), names.others());
    Ok(Some(CodeRow { code, last: None, name, names, availability: None, documentation, cells }))
}

/// Behind how many other elements a text in another language still stands.
const NEIGHBOURS: usize = 16;

/// A title, and the text in the languages of the source.
type Paragraph<'a> = (&'a str, Names<'a>);

fn cause<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    paragraphs: &mut Vec<Paragraph<'a>>,
    extensions: &mut Extensions,
) -> Read<()> {
    // The number of a cause only tells it from the others.
    reader.fields(parent, &["Idx"], extensions)?;
    let first = paragraphs.len();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Cause" | "Remedy" => paragraph(reader, &tag, (paragraphs, first), extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}

fn paragraph<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    (paragraphs, first): (&mut Vec<Paragraph<'a>>, usize),
    extensions: &mut Extensions,
) -> Read<()> {
    let mut names = Names::default();
    reader.name(tag, &mut names, extensions)?;
    // Elements of one name are one text in several languages.
    let is_other = |(title, own): &&mut Paragraph<'_>| *title == tag.name && !own.shares_language(&names);
    match paragraphs.iter_mut().skip(first).rev().take(NEIGHBOURS).find(is_other) {
        Some((_, own)) => own.append(names),
        None => paragraphs.push((tag.name, names)),
    }
    Ok(())
}

/// The paragraphs as one text, and that in the other languages that any of them has.
fn documentation(paragraphs: &[Paragraph<'_>]) -> Option<Box<Documentation>> {
    let join = |of: &dyn Fn(&Names<'_>) -> CompactString| -> String {
        let texts = paragraphs.iter().map(|(title, names)| (*title, of(names))).filter(|(_, text)| !text.is_empty());
        let titled = texts.map(|(title, text)| if title.is_empty() { text.into() } else { format!("{title}: {text}") });
        titled.collect::<Vec<String>>().join("\n\n")
    };
    let text = join(&|names| names.name());
    let others: Vec<_> = paragraphs.iter().map(|(_, names)| names.others()).collect();
    let mut languages: Vec<&CompactString> = others.iter().flatten().map(|other| &other.language).collect();
    languages.sort_unstable();
    languages.dedup();
    let in_language = |language: &CompactString| {
        let own = |names: &Names<'_>| names.all().find(|text| text.language == *language).map(|text| text.text);
        let text = join(&|names| own(names).unwrap_or_else(|| names.name())).into();
        LocalText { language: language.clone(), text }
    };
    let translations = languages.into_iter().map(in_language).collect();
    (!text.is_empty()).then(|| Box::new(Documentation { text, translations, cite: None }))
}
