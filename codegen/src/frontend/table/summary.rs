//! Compares a row with the statements that other sections of the manual make about the same value or object.

use std::collections::BTreeMap;

use super::at::{At, OneOrMany};
use super::definitions::Definitions;
use super::format::SummaryTable;
use super::tree::{cited, Reader};
use super::words::{ACCESSES, DIRECTIONS, OBJECT_CODES};
use super::{types, value};
use crate::diagnostics::codes;
use crate::ir::{Access, Group, Item, Mappable, ObjectCode, Texts, Type};
use crate::source::Span;
use crate::text::{brief, count_of};

/// Statements that other sections of the manual make about the value or object of a row.
pub(super) type Summaries = At<OneOrMany<SummaryTable>>;

/// Compares an item with the statements in the key `summary` of its row.
pub(super) fn item(reader: &mut Reader<'_, '_>, definitions: &Definitions, given: &Summaries, item: &Item) {
    let is_domain = definitions.underlying(item.ty) == Type::Domain;
    for summary in &given.value.0 {
        of_item(reader, definitions, summary, item, "the row");
        names(reader, summary, &item.name, &item.names);
        code(reader, summary, if is_domain { ObjectCode::Domain } else { ObjectCode::Var });
        if let Some(subs) = summary.subs.as_ref().filter(|subs| subs.value != 1) {
            let message = format!("`summary` states {} sub-indices, but the row is a single value", subs.value);
            report(reader, summary, reader.span(subs), message);
        }
    }
}

/// Compares objects that have sub-entries with the statements of other sections. The name, the object code and the
/// number of sub-indices in a statement are compared with those of the object. All other facts are compared with each
/// sub-entry that has a type, except sub-index 0. Only the first sub-entry that differs is reported.
pub(super) fn objects(
    reader: &mut Reader<'_, '_>,
    definitions: &Definitions,
    summaries: &[(u16, Summaries)],
    dictionary: &BTreeMap<u16, Group>,
) {
    for (index, given) in summaries {
        let Some(group) = dictionary.get(index) else { continue };
        for summary in &given.value.0 {
            names(reader, summary, &group.name, &group.names);
            group.object_code().iter().for_each(|described| code(reader, summary, *described));
            let elements = group.items.iter().filter(|item| item.object().is_some_and(|(_, sub)| sub > 0));
            for item in elements.filter(|item| item.ty != Type::Opaque(None)) {
                let sub_index = item.object().map_or(0, |(_, sub)| sub);
                if of_item(reader, definitions, summary, item, &format!("sub-index {sub_index}")) {
                    break;
                }
            }
            let (Some(subs), count) = (&summary.subs, group.items.len()) else { continue };
            if subs.value as usize != count && group.object_code() != Some(ObjectCode::Var) {
                let message = format!("`summary` states {} sub-indices, but the table describes {count}", subs.value);
                report(reader, summary, reader.span(subs), message);
            }
        }
    }
}

fn report(reader: &mut Reader<'_, '_>, summary: &SummaryTable, span: Span, message: String) {
    let found = codes::SUMMARY_DIFFERS.at(span, message).label("the fact in the row is used");
    let found = found
        .help("write the correct fact in the row, record the other fact in a `doubt`, and allow this code on the row");
    reader.diagnostics.push(match &summary.cite {
        Some(cite) => {
            found.note(format!("the fact in `summary` comes from this place in the manual: `cite = {}`", cited(cite)))
        }
        None => found,
    });
}

/// Compares the object code in a statement with that of the object, if the statement contains an object code.
fn code(reader: &mut Reader<'_, '_>, summary: &SummaryTable, described: ObjectCode) {
    let Some(given) = &summary.code else { return };
    let stated = reader.word(given, "object code", &OBJECT_CODES);
    if stated.is_some_and(|stated| stated != described) {
        let word = OBJECT_CODES.iter().find(|(_, code)| *code == described).map_or("another", |(word, _)| word);
        let message = format!("`summary` states the object code `{}`, but the row has `{word}`", brief(&given.value));
        report(reader, summary, reader.span(given), message);
    }
}

/// Compares the name in a statement, if any, with the names of the row in all languages. Ignores case and punctuation.
fn names(reader: &mut Reader<'_, '_>, summary: &SummaryTable, name: &str, names: &Texts) {
    let Some(given) = &summary.name else { return };
    let plain =
        |name: &str| -> String { name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect() };
    let stated = plain(&given.value);
    if stated != plain(name) && !names.iter().any(|other| plain(&other.text) == stated) {
        let message = format!("`summary` states the name `{}`, but the row has `{}`", brief(&given.value), brief(name));
        report(reader, summary, reader.span(given), message);
    }
}

/// Compares an item with a statement, and reports the differences. Returns whether there is a difference. `subject` is the name
/// of the item in messages.
fn of_item(
    reader: &mut Reader<'_, '_>,
    definitions: &Definitions,
    summary: &SummaryTable,
    item: &Item,
    subject: &str,
) -> bool {
    let base = definitions.underlying(item.ty);
    let mut differs = Vec::new();
    if let Some(given) = &summary.ty {
        match types::single(&given.value) {
            Some(ty) if ty != base => differs.push((reader.span(given), format!("the type {ty}"), base.to_string())),
            Some(_) => {}
            None => {
                let message = format!("`{}` is not a known data type", brief(&given.value));
                reader.report(&codes::TABLE_VALUE, reader.span(given), message);
            }
        }
    }
    let rights = |access: Access| (access.readable(), access.writable());
    if let Some(given) = &summary.access {
        let access = reader.word(given, "access right", &ACCESSES);
        if access.is_some_and(|access| rights(access) != rights(item.access)) {
            differs.push((
                reader.span(given),
                format!("the access rights {}", given.value),
                item.access.name().to_owned(),
            ));
        }
    }
    if let Some(given) = &summary.pdo {
        let mappable = reader.word(given, "PDO direction", &DIRECTIONS);
        if mappable.is_some_and(|mappable| mappable != item.mappable) {
            differs.push((
                reader.span(given),
                format!("the PDO direction `{}`", given.value),
                format!("`{}`", direction(item.mappable)),
            ));
        }
    }
    if let (Some(given), Some(bits)) = (&summary.length, definitions.bits_of(item.ty)) {
        if given.value != bits.div_ceil(8) {
            let has = base.bits().map_or_else(|| bits.div_ceil(8).to_string(), |_| format!("the type {base}"));
            differs.push((reader.span(given), format!("a length of {}", count_of(given.value, "byte")), has));
        }
    }
    numbers(reader, summary, item, base, &mut differs);
    let found = !differs.is_empty();
    for (span, says, has) in differs {
        report(reader, summary, span, format!("`summary` states {}, but {subject} has {has}", brief(&says)));
    }
    found
}

/// Compares the limits and default value in a statement with those of the item. Skips values that the statement or the item
/// lacks.
fn numbers(
    reader: &Reader<'_, '_>,
    summary: &SummaryTable,
    item: &Item,
    base: Type,
    differs: &mut Vec<(Span, String, String)>,
) {
    let limits = [("minimum", &summary.min, &item.limits.low), ("maximum", &summary.max, &item.limits.high)];
    for (what, given, has) in limits.into_iter().chain([("default", &summary.default, &item.default)]) {
        let (Some(given), Some(has)) = (given, has) else { continue };
        let says = value::convert(&given.value, base, reader.is_pattern(given));
        if let Some(says) = says.filter(|says| says != has) {
            differs.push((reader.span(given), format!("the {what} {says}"), has.to_string()));
        }
    }
}

fn direction(direction: Mappable) -> &'static str {
    DIRECTIONS.iter().find(|(_, mappable)| *mappable == direction).map_or("no", |(word, _)| word)
}
