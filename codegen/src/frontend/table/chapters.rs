//! Reads the chapters of a register table: their registers and objects.

use super::at::At;
use super::document::{Node, Value};
use super::format::{ChapterTable, Row};
use super::in_use::InUse;
use super::objects::Dictionary;
use super::rows::Rows;
use super::tree::Reader;
use super::{defaults, lints, misplaced, notation, objects, registers};
use crate::diagnostics::codes;
use crate::ir::{Group, GroupKind, ObjectCode};

/// Reads the rows of a chapter. Returns the registers of the chapter as a group, and adds the objects of the chapter to
/// `dictionary`.
pub(super) fn chapter<'a>(
    reader: &mut Reader<'a, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    in_use: &mut InUse,
    node: Node<'a>,
) -> Option<Group> {
    let (start, end) = (node.start, node.end);
    let (registers, objects, mut node) = divide(reader, node)?;
    defaults::of_chapter(reader, &mut node);
    let chapter: ChapterTable = reader.piece(node)?;
    let at = At { value: (), start, end };
    let space = match &chapter.space {
        Some(name) => {
            let found = rows.spaces.iter().position(|space| space.name == name.value);
            if found.is_none() {
                let known = rows.spaces.iter().map(|space| space.name.as_str());
                reader.unresolved("space", &name.value, reader.span(name), known);
            }
            found
        }
        None => (!rows.spaces.is_empty()).then_some(0),
    };
    let defaults = chapter.defaults.as_ref().map(|row| &row.value);
    rows.repeats.chapter(defaults);
    let mut group = Group::object(0, ObjectCode::Record);
    group.kind = GroupKind::Chapter;
    group.name = chapter.title.as_deref().unwrap_or_default().into();
    group.names = reader.original(chapter.orig.as_deref());
    group.origin = reader.origin(&at);
    group.documentation = reader.documentation_of(&chapter);
    group.doubts = reader.doubts_of(&chapter, group.origin);
    lints::series(reader, &registers, space.and_then(|at| rows.spaces.get(at)));
    lints::unprinted(reader, &registers, space.and_then(|at| rows.spaces.get(at)));
    for (key, row) in registers {
        misplaced::register(reader, &key, &row);
        let items = registers::items(reader, rows, space, &key, &row, defaults);
        let part = row.value.part.as_ref().and_then(|part| notation::bits(&part.value.to_string()));
        items.iter().for_each(|item| in_use.register(reader, &group.name, item, part));
        group.items.extend(items);
    }
    for (key, row) in objects {
        misplaced::object(reader, &key, &row);
        objects::add(reader, rows, dictionary, &key, &row, space, defaults);
    }
    group.items.shrink_to_fit();
    let says_something = !group.doubts.is_empty() || group.documentation.is_some();
    (!group.items.is_empty() || says_something).then_some(group)
}

/// Rows of a chapter's registers or objects, with their keys.
pub(super) type RowList = Vec<(At<String>, At<Row>)>;

/// Separates the rows of a chapter from its other keys, so that an error in one row does not affect the other rows.
pub(super) fn divide<'a>(reader: &mut Reader<'a, '_>, node: Node<'a>) -> Option<(RowList, RowList, Node<'a>)> {
    let mut node = node;
    let span = reader.span(&node);
    let Value::Table(table) = &mut node.value else {
        reader.report_with_help(&codes::TABLE_VALUE, span, "a chapter must be a table", "write `[[chapters]]`");
        return None;
    };
    let (registers, objects) = (table.remove("registers"), table.remove("objects"));
    let mut read = |part: Option<Node<'a>>, what| -> RowList {
        let entries = part.map(|part| reader.entries(part, what)).unwrap_or_default();
        entries.into_iter().filter_map(|(key, node)| Some((key, reader.piece_at(node)?))).collect()
    };
    let registers = read(registers, "chapters.registers");
    let objects = read(objects, "chapters.objects");
    Some((registers, objects, node))
}
