//! Reads the diagnosis messages of a device, module or file.

use std::collections::BTreeSet;
use std::sync::Arc;

use compact_str::CompactString;

use super::budget::Cost;
use super::data_type::enum_value;
use super::reader::{Names, Reader};
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::frontend::xml::Read;
use crate::ir::{CodeRow, CodeTable, Documentation, LocalText, Value};
use crate::number::hex16;
use crate::source::Span;
use crate::syntax::xml::Tag;

/// Names of the flags of a diagnosis message, in the order of the table columns.
const COLUMNS: [&str; 4] = ["DiagClass", "DiagReset", "DiagReaction", "DiagType"];

/// Reads a `DiagMessages` element. Returns a table of the messages, and a table for each non-empty list of flag values.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Vec<CodeTable>> {
    let origin = reader.origin(parent);
    let table = |name: &'static str, columns: &[&'static str]| CodeTable {
        name: CompactString::const_new(name),
        columns: columns.iter().map(|name| CompactString::const_new(name)).collect(),
        origin,
        ..CodeTable::default()
    };
    let mut messages = table("DiagMessages", &COLUMNS);
    let mut lists = [table("DiagReset", &[]), table("DiagReaction", &[]), table("DiagType", &[])];
    while let Some(tag) = reader.child(parent)? {
        if tag.name == "DiagMessage" {
            let row = message(reader, &tag)?;
            messages.rows.to_mut().extend(row);
        } else if let Some(list) = lists.iter_mut().find(|list| list.name == tag.name) {
            list.rows.to_mut().extend(enum_value(reader, &tag)?.map(|value| CodeRow {
                code: value.value,
                name: value.name,
                names: value.names,
                documentation: value.documentation,
                ..CodeRow::default()
            }));
        } else {
            reader.unknown(&tag)?;
        }
    }
    let lists = lists.into_iter().filter(|list| !list.rows.is_empty());
    Ok(std::iter::once(messages).chain(lists).collect())
}

fn message<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Option<CodeRow>> {
    let (mut names, mut paragraphs, mut descriptions, mut number) = (Names::default(), Vec::new(), Vec::new(), None);
    let mut cells: [CompactString; COLUMNS.len()] = Default::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "TextId" => {
                let given = reader.text(&tag)?;
                number = reader.int::<i128>(&given, "message number").map(|code| (code, printed(&given.text, code)));
            }
            "MessageText" => reader.name(&tag, &mut names)?,
            "Description" => paragraph(reader, &tag, &mut descriptions, 0)?,
            "Flags" => {
                while let Some(flag) = reader.child(&tag)? {
                    match COLUMNS.iter().zip(&mut cells).find(|(column, _)| **column == flag.name) {
                        Some((_, cell)) => *cell = reader.text(&flag)?.compact(),
                        None => reader.unknown(&flag)?,
                    }
                }
            }
            "CauseRemedy" => cause(reader, &tag, &mut paragraphs)?,
            "Info" | "Hint" | "URL" => paragraph(reader, &tag, &mut paragraphs, 0)?,
            _ => reader.unknown(&tag)?,
        }
    }
    let Some((code, printed)) = number else {
        reader.report(&codes::ESI_VALUE, parent.span, "this message has no TextId", "left out");
        return Ok(None);
    };
    descriptions.iter_mut().for_each(|(title, _)| *title = "");
    descriptions.append(&mut paragraphs);
    let documentation = documentation(reader, &descriptions, parent.span);
    let cells = cells.into_iter().map(Value::Text).collect();
    let (name, names) = (names.name(), names.others());
    Ok(Some(CodeRow { printed, code, name, names, documentation, cells, ..CodeRow::default() }))
}

/// Returns a hexadecimal code such as `#x8000` in the notation that all outputs use (`0x8000`). Returns an empty string
/// for a code that does not begin with `#`.
fn printed(text: &str, code: i128) -> CompactString {
    match text.trim_start().starts_with('#') {
        true => hex16(code).into(),
        false => CompactString::default(),
    }
}

/// Maximum number of preceding elements that are compared to find translations of the same text.
const NEIGHBORS: usize = 16;

/// Title of a paragraph, and its text in each language.
type Paragraph<'a> = (&'a str, Names<'a>);

fn cause<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, paragraphs: &mut Vec<Paragraph<'a>>) -> Read<()> {
    // The attribute `Idx` is read and dropped, because the number of a cause has no meaning.
    reader.attributes(parent, ["Idx"])?;
    let first = paragraphs.len();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Cause" | "Remedy" => paragraph(reader, &tag, paragraphs, first)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn paragraph<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    paragraphs: &mut Vec<Paragraph<'a>>,
    first: usize,
) -> Read<()> {
    let mut names = Names::default();
    reader.name(tag, &mut names)?;
    // Elements with the same name are translations of one text if their languages differ.
    let is_other = |(title, texts): &&mut Paragraph<'_>| *title == tag.name && !texts.shares_language(&names);
    let first = first.max(paragraphs.len().saturating_sub(NEIGHBORS));
    match paragraphs.iter_mut().skip(first).find(is_other) {
        Some((_, texts)) => texts.append(names),
        None => paragraphs.push((tag.name, names)),
    }
    Ok(())
}

/// Joins the paragraphs into one documentation text for each language.
fn documentation(
    reader: &mut Reader<'_, '_>,
    paragraphs: &[Paragraph<'_>],
    message: Span,
) -> Option<Arc<Documentation>> {
    let join = |texts: &[CompactString]| -> String {
        let texts = paragraphs.iter().zip(texts).filter(|(_, text)| !text.is_empty());
        let titled = texts.map(|((title, _), text)| match *title {
            "" => text.to_string(),
            title => format!("{title}: {text}"),
        });
        titled.collect::<Vec<String>>().join("\n\n")
    };
    let main: Vec<CompactString> = paragraphs.iter().map(|(_, names)| names.name()).collect();
    let text = join(&main);
    let others: Vec<_> = paragraphs.iter().map(|(_, names)| names.others()).collect();
    let languages: BTreeSet<&CompactString> = others.iter().flatten().map(|other| &other.language).collect();
    let by_language = |(_, names): &Paragraph<'_>| -> HashMap<CompactString, CompactString> {
        names.all().map(|local| (local.language, local.text)).collect()
    };
    let texts: Vec<_> = paragraphs.iter().map(by_language).collect();
    // Each language gets a copy of every paragraph that has no translation into this language. The budget must allow these copies.
    let affordable = reader.derive(Cost::text(languages.len().saturating_mul(text.len())), message);
    let in_language = |language: &CompactString| {
        let paragraphs =
            texts.iter().zip(&main).map(|(translations, main)| translations.get(language).unwrap_or(main).clone());
        LocalText { language: language.clone(), text: join(&paragraphs.collect::<Vec<_>>()).into() }
    };
    let translations = languages.into_iter().filter(|_| affordable).map(in_language).collect();
    (!text.is_empty()).then(|| Arc::new(Documentation { text: text.into(), translations, ..Documentation::default() }))
}
