//! Rows of `[chapters.objects]` to objects.

use std::collections::BTreeMap;

use super::at::At;
use super::format::Row;
use super::place::{self, Objects};
use super::rows::{Named, Rows};
use super::tree::{cited, Reader};
use crate::diagnostics::codes;
use crate::ir::{Access, Binding, Group, Item, ObjectBuses, ObjectCode, Type};
use crate::text::brief;

/// The words for object codes.
pub(super) const CODES: [(&str, ObjectCode); 4] = [
    ("var", ObjectCode::Var),
    ("array", ObjectCode::Array),
    ("record", ObjectCode::Record),
    ("domain", ObjectCode::Domain),
];

/// The objects of a table, by index.
pub(super) type Dictionary = BTreeMap<u16, Group>;

/// Adds what a row of `[chapters.objects]` stands for.
pub(super) fn add(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    (key, row): (&At<String>, &At<Row>),
    chapter: Option<&Row>,
) {
    let Some(objects) = place::objects(&key.value) else {
        let message =
            format!("`{}` is no object: write `0x6040`, `\"0x1018:1\"` or `\"0x1400..0x1403:1\"`", brief(&key.value));
        reader.report(&codes::TABLE_PLACE, reader.span(key), message);
        return;
    };
    rows.allow(reader, key, row);
    super::lints::index(reader, key);
    let complete = match objects.subs {
        // What an object says about itself isn't a value's: it takes no defaults but its own.
        None if row.value.ty.is_none() && has_no_value(&row.value) => row.value.clone(),
        _ => rows.complete(&row.value, chapter),
    };
    for index in objects.indices.0..=objects.indices.1 {
        let number = u32::from(index - objects.indices.0);
        match objects.subs {
            None => head(reader, rows, dictionary, (key, row, &complete), (index, number)),
            Some(_) => subs(reader, rows, dictionary, (key, row, &complete), (objects, index, number)),
        }
    }
}

/// Whether a row only names an object whose values are its sub-entries.
fn has_no_value(row: &Row) -> bool {
    row.code.is_some() && row.bits.is_none() && row.values.is_none()
}

type Given<'r> = (&'r At<String>, &'r At<Row>, &'r Row);

fn head(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    (key, row, complete): Given<'_>,
    (index, number): (u16, u32),
) {
    let code = complete.code.as_ref().and_then(|code| reader.word(code, "object code", &CODES));
    let mut group = Group::object(index, code.unwrap_or(ObjectCode::Var));
    group.origin = reader.origin(key);
    if let Some(name) = &complete.name {
        (group.name, group.name_at) = (place::filled(&name.value, number, None).into(), reader.span(name));
    }
    group.names = reader.original(complete.orig.as_deref());
    let cite = complete.cite.as_ref().map(cited);
    group.documentation = reader.documentation(complete.doc.as_deref(), cite.clone());
    if matches!(code, Some(ObjectCode::Array | ObjectCode::Record)) {
        group.doubts =
            reader.doubts([complete.doubt.as_ref(), complete.doubts.as_ref()], group.origin, cite.as_deref());
        rows.summaries.extend(complete.summary.clone().map(|summary| (index, summary)));
    } else {
        let name = group.name.to_string();
        let named = Named { name: &name, key, number, end: row.end };
        let item = item(reader, rows, named, complete, (index, 0));
        group.items.push(item);
    }
    if let Some(first) = dictionary.get(&index) {
        let diagnostic = crate::diagnostics::Diagnostic::new(
            &codes::TABLE_DUPLICATE,
            reader.span(key),
            format!("object 0x{index:04X} occurs twice"),
        );
        reader.diagnostics.push(diagnostic.note_at(first.origin.span, "the first is here"));
        return;
    }
    dictionary.insert(index, group);
}

fn subs(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    (key, row, complete): Given<'_>,
    (objects, index, number): (Objects, u16, u32),
) {
    dictionary.entry(index).or_insert_with(|| {
        let message = format!("object 0x{index:04X} has no row of its own above its sub-entries");
        reader.report(&codes::TABLE_PLACE, reader.span(key), message);
        Group { origin: reader.origin(key), ..Group::object(index, ObjectCode::Record) }
    });
    let (first, last) = objects.subs.unwrap_or((0, 0));
    for sub_index in first..=last {
        let name = complete.name.as_ref().map_or("", |name| name.value.as_str());
        let name = place::filled(name, number, Some(sub_index));
        let named = Named { name: &name, key, number, end: row.end };
        let item = item(reader, rows, named, complete, (index, sub_index));
        let Some(group) = dictionary.get_mut(&index) else { continue };
        if group.object_code() == Some(ObjectCode::Var) {
            let message = format!("object 0x{index:04X} is one value: give it a `code` such as \"record\"");
            reader.report(&codes::TABLE_PLACE, reader.span(key), message);
            return;
        }
        match group.items.binary_search_by_key(&Some((index, sub_index)), Item::object) {
            Ok(at) => {
                let first = group.items.get(at).map(|item| item.at.name).unwrap_or_default();
                let message = format!("sub-index {sub_index} of object 0x{index:04X} occurs twice");
                let diagnostic =
                    crate::diagnostics::Diagnostic::new(&codes::TABLE_DUPLICATE, reader.span(key), message);
                reader.diagnostics.push(diagnostic.note_at(first, "the first is here"));
            }
            Err(at) => group.items.insert(at, item),
        }
    }
}

fn item(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    named: Named<'_>,
    row: &Row,
    (index, sub_index): (u16, u8),
) -> Item {
    let buses = rows.buses_of(reader, row);
    let buses = ObjectBuses { canopen: buses.canopen || !buses.ethercat, coe: buses.ethercat };
    let mut item = Item::new(Binding::Object { buses, index, sub_index });
    let ty = match row.reserved {
        Some(true) if row.ty.is_none() => Some(Type::Opaque(None)),
        _ => rows.ty(reader, named, row),
    };
    rows.fill(reader, &mut item, named, row, ty);
    if row.access.is_none() && row.reserved != Some(true) {
        rows.no_access(reader, named);
        item.access = Access::ReadOnly;
    }
    item
}
