//! Diagnosis messages.

use compact_str::CompactString;

use super::data_type::enum_value;
use super::reader::{Names, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{CodeRow, CodeTable, Documentation, Extensions, SharedList, Value};
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
    let (mut names, mut text, mut number) = (Names::default(), String::new(), None);
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
            "CauseRemedy" => cause(reader, &tag, &mut text, extensions)?,
            "Info" | "Hint" | "URL" => {
                let mut own = Names::default();
                reader.name(&tag, &mut own, extensions)?;
                paragraph(&mut text, tag.name, &own.name());
            }
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    let Some(code) = number else {
        reader.report(&codes::ESI_VALUE, parent.span, "this message has no TextId", "left out");
        return Ok(None);
    };
    let mut documentation = description.documentation();
    if !text.is_empty() {
        let own = documentation.get_or_insert_with(|| Box::new(Documentation::default()));
        own.text = [std::mem::take(&mut own.text), text].join("\n\n").trim().to_owned();
    }
    let cells = cells.into_iter().map(Value::Text).collect();
    let (name, names) = (names.name(), names.others());
    Ok(Some(CodeRow { code, last: None, name, names, availability: None, documentation, cells }))
}

fn cause<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    text: &mut String,
    extensions: &mut Extensions,
) -> Read<()> {
    // The number of a cause only tells it from the others.
    reader.fields(parent, &["Idx"], extensions)?;
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Cause" | "Remedy" => {
                let mut own = Names::default();
                reader.name(&tag, &mut own, extensions)?;
                paragraph(text, tag.name, &own.name());
            }
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}

fn paragraph(text: &mut String, title: &str, own: &str) {
    if !own.is_empty() {
        if !text.is_empty() {
            text.push_str("\n\n");
        }
        text.push_str(title);
        text.push_str(": ");
        text.push_str(own);
    }
}
