//! Converts rows of `[chapters.objects]` to objects.

use std::collections::BTreeMap;

use super::at::At;
use super::bindings::Repeat;
use super::format::Row;
use super::notation::{self, Objects};
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::words::OBJECT_CODES;
use crate::diagnostics::codes;
use crate::ir::{Access, Binding, Group, Item, ObjectCode, Type};
use crate::number::hex16;
use crate::text::brief;

/// Objects of a table, by index.
pub(super) type Dictionary = BTreeMap<u16, Group>;

/// Adds the objects or sub-entries that a row of `[chapters.objects]` describes.
pub(super) fn add(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    key: &At<String>,
    row: &At<Row>,
    space: Option<usize>,
    chapter: Option<&Row>,
) {
    let Some(objects) = notation::objects(&key.value) else {
        let message = format!("`{}` is not an object address", brief(&key.value));
        let found = codes::TABLE_PLACE.at(reader.span(key), message).help(notation::OBJECT_HELP);
        let digits = super::lints::digits_of_index(reader, key);
        reader.diagnostics.push(match digits {
            Some(digits) => found.note(digits),
            None => found,
        });
        return;
    };
    rows.allow(reader, key, row);
    super::lints::index(reader, key);
    let complete = match objects.subs {
        // A row for a whole array or record describes no value, so the row inherits no defaults.
        None if row.value.ty.is_none() && has_no_value(&row.value) => row.value.clone(),
        _ => rows.complete(reader, key, &row.value, chapter),
    };
    let objects = affordable(reader, rows, objects, &complete, key);
    let count = u32::from(objects.indices.1 - objects.indices.0) + 1;
    rows.each_has_one(reader, key, &complete, count);
    let given = GivenRow { key, row, complete: &complete };
    for index in objects.indices.0..=objects.indices.1 {
        let number = u32::from(index - objects.indices.0);
        match objects.subs {
            None => head(reader, rows, dictionary, given, index, number, space),
            Some(_) => subs(reader, rows, dictionary, given, objects, index, space),
        }
    }
}

/// Returns the objects of a row, or only the first one if the table exceeds the limit for items.
fn affordable(reader: &mut Reader<'_, '_>, rows: &mut Rows, objects: Objects, row: &Row, key: &At<String>) -> Objects {
    let ((first, last), subs) = (objects.indices, objects.subs);
    let of_each = subs.map_or(1, |(first, last)| u32::from(last - first) + 1);
    let span = reader.span(key);
    if rows.repeats.repeat(reader, &key.value, row, (u32::from(last - first) + 1) * of_each, span) {
        return objects;
    }
    Objects { indices: (first, first), subs: subs.map(|(first, _)| (first, first)) }
}

/// Returns whether a row describes a whole object, whose values are in its sub-entries.
fn has_no_value(row: &Row) -> bool {
    let has_subs = row.code.as_ref().is_some_and(|code| matches!(code.value.as_str(), "array" | "record"));
    has_subs && row.bits.is_none() && row.values.is_none()
}

/// Row with its key, and a copy of the row with the inherited defaults.
#[derive(Clone, Copy)]
struct GivenRow<'r> {
    key: &'r At<String>,
    row: &'r At<Row>,
    complete: &'r Row,
}

fn head(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    given: GivenRow<'_>,
    index: u16,
    number: u32,
    space: Option<usize>,
) {
    let GivenRow { key, row, complete } = given;
    let code = complete.code.as_ref().and_then(|code| reader.word(code, "object code", &OBJECT_CODES));
    let mut group = Group::object(index, code.unwrap_or(ObjectCode::Var));
    group.origin = reader.origin(key);
    unfilled_name(reader, complete, number, None);
    if let Some(name) = &complete.name {
        (group.name, group.name_at) = (notation::filled(&name.value, number, None).into(), reader.span(name));
    }
    group.names = reader.original(complete.orig.as_deref());
    group.documentation = super::rows::documentation(reader, complete);
    if matches!(code, Some(ObjectCode::Array | ObjectCode::Record)) {
        group.doubts = reader.doubts_of(complete, group.origin);
        if let Some(of_value) = super::misplaced::of_value(&row.value).filter(|_| number == 0) {
            let key_text = brief(&key.value);
            let message = format!("`{key_text}` has sub-entries, but `{of_value}` applies only to a single value");
            let found = codes::TABLE_PLACE.at(reader.span(key), message);
            reader
                .diagnostics
                .push(found.help(format!("write `{of_value}` in the row of a sub-entry, such as `\"{key_text}:1\"`")));
        }
        rows.summaries.extend(complete.summary.clone().map(|summary| (index, summary)));
    } else {
        let name = group.name.to_string();
        let named = Named { name: &name, key, number, end: row.end };
        let item = item(reader, rows, named, complete, index, 0, space);
        group.items = vec![item];
    }
    if let Some(first) = dictionary.get(&index) {
        let found = codes::TABLE_DUPLICATE.at(reader.span(key), format!("object {} occurs twice", hex16(index)));
        reader.diagnostics.push(found.note_at(first.origin.span, "first use"));
        return;
    }
    dictionary.insert(index, group);
}

/// Reports a placeholder in the `name` of a row, if there is no value for the placeholder.
fn unfilled_name(reader: &mut Reader<'_, '_>, row: &Row, number: u32, sub: Option<u8>) {
    if let Some(name) = row.name.as_ref().filter(|_| number == 0) {
        super::definitions::unfilled(reader, name, Some(&notation::filled(&name.value, number, sub)));
    }
}

fn subs(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    given: GivenRow<'_>,
    objects: Objects,
    index: u16,
    space: Option<usize>,
) {
    let GivenRow { key, row, complete } = given;
    let number = u32::from(index - objects.indices.0);
    dictionary.entry(index).or_insert_with(|| {
        let message = format!("object {} has a row for a sub-entry, but no row for the object above it", hex16(index));
        reader.report(&codes::TABLE_PLACE, reader.span(key), message);
        Group { origin: reader.origin(key), ..Group::object(index, ObjectCode::Record) }
    });
    let (first, last) = objects.subs.unwrap_or((0, 0));
    unfilled_name(reader, complete, number, Some(first));
    for sub_index in first..=last {
        let name = complete.name.as_ref().map_or("", |name| name.value.as_str());
        let name = notation::filled(name, number, Some(sub_index));
        let named = Named { name: &name, key, number, end: row.end };
        let item = item(reader, rows, named, complete, index, sub_index, space);
        let Some(group) = dictionary.get_mut(&index) else { continue };
        if group.object_code() == Some(ObjectCode::Var) {
            let message = format!("object {} is a single value and cannot have sub-entries", hex16(index));
            let help = "add a `code` such as `\"record\"` to the row of the object";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
            return;
        }
        match group.items.binary_search_by_key(&Some((index, sub_index)), Item::object) {
            Ok(at) => {
                let first = group.items.get(at).map(|item| item.at.name).unwrap_or_default();
                let message = format!("sub-index {sub_index} of object {} occurs twice", hex16(index));
                let diagnostic = codes::TABLE_DUPLICATE.at(reader.span(key), message);
                reader.diagnostics.push(diagnostic.note_at(first, "first use"));
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
    index: u16,
    sub_index: u8,
    space: Option<usize>,
) -> Item {
    let buses = rows.object_buses(reader, row, named.key);
    let mut item = Item::new(Binding::Object { buses, index, sub_index });
    let ty = match row.reserved {
        Some(true) if row.ty.is_none() => Some(Type::Opaque(None)),
        _ => rows.ty(reader, named, row),
    };
    further_addresses(reader, rows, space, &mut item, named, row, ty);
    rows.fill(reader, &mut item, named, row, ty);
    if row.access.is_none() && row.reserved != Some(true) {
        rows.no_access(reader, named);
        item.access = Access::ReadOnly;
    }
    item
}

/// Adds the further addresses in the row of an object: a register, and addresses in other protocols.
fn further_addresses(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    space: Option<usize>,
    item: &mut Item,
    named: Named<'_>,
    row: &Row,
    ty: Option<Type>,
) {
    let is_single = notation::objects(&named.key.value).is_none_or(|objects| {
        objects.indices.0 == objects.indices.1 && objects.subs.is_none_or(|(first, last)| first == last)
    });
    let has_number = row.reg.is_some() || row.esc.is_some() || row.param.is_some();
    if has_number && !is_single {
        let message = "`reg`, `esc` and `param` apply to one item, but the row describes several objects";
        let found = codes::TABLE_PLACE.at(reader.span(named.key), message);
        reader.diagnostics.push(found.help("write one row per object"));
        return;
    }
    let object = item.object();
    if row.reg.is_some() {
        let register = Row { ascii: None, esc: None, param: None, ..row.clone() };
        let found = rows.bindings(reader, space, named, &register, Repeat::ONCE, ty);
        item.bindings.extend(found.into_iter().filter(|binding| !matches!(binding, Binding::Object { .. })));
    }
    let bits = ty.and_then(|ty| rows.definitions.bits_of(ty));
    let found = rows.other_addresses(reader, named, object.map(|(_, sub)| sub), row, 0, bits);
    item.bindings.extend(found);
}
