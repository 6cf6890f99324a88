//! Expands `CompactSubObj`, a description of sub-indices that differ only in their number, and applies the sections
//! that contain names, values and denotations of single sub-indices.

use super::keywords::{Raw, OF_A_VALUE};
use super::lists;
use super::reader::Reader;
use super::sections::Refinement;
use crate::diagnostics::codes;
use crate::frontend::canopen::value::Role;
use crate::ir::{
    Access, Binding, CompactString, Configured, Extensions, Fact, FactOrigins, Group, Item, ObjectCode, Rule, Type,
    Value,
};
use crate::limits;
use crate::number::hex16;
use crate::syntax::ini::{Entry, Section};

/// Adds each sub-index from 0 to `count` that has no section in the file.
pub(super) fn expand(reader: &mut Reader<'_, '_>, group: &mut Group, raw: &Raw, count: u8) {
    let Some(index) = group.index() else { return };
    let is_first_beyond = reader.derived_items <= limits::MAX_DERIVED_ITEMS;
    reader.derived_items += usize::from(count) + 1;
    if reader.derived_items > limits::MAX_DERIVED_ITEMS {
        if is_first_beyond {
            reader.too_many_derived(raw.origin.span);
        }
        return;
    }
    let described: Vec<u8> = group.items.iter().filter_map(|item| Some(item.object()?.1)).collect();
    let missing = |sub: u8| described.binary_search(&sub).is_err();
    group.items.reserve_exact(usize::from(count) + 1);
    if missing(0) {
        let mut item = Item::new(Binding::canopen(index, 0));
        item.name = CompactString::const_new("NrOfObjects");
        item.ty = Type::Unsigned(8);
        item.access = Access::ReadOnly;
        item.default = Some(Value::Int(i128::from(count)));
        item.origin = raw.origin;
        let facts = [Fact::Name, Fact::Type, Fact::Access, Fact::Default];
        item.origins = FactOrigins::by_rule(&facts, Rule::CompactObject);
        group.items.push(item);
    }
    // The keywords of the object apply to all sub-indices, so they are read once and their errors are reported once.
    let mut template = Item::new(Binding::canopen(index, 1));
    reader.describe(&mut template, raw, ObjectCode::Array);
    group.flags = template.flags;
    let bytes = copied(reader, raw, &template) + group.name.len();
    let bytes = bytes.saturating_mul(count.into());
    if reader.may_copy(bytes, raw.origin.span) {
        for sub in (1..=count).filter(|&sub| missing(sub)) {
            let mut item = template.clone();
            item.bindings[0] = Binding::canopen(index, sub);
            item.name = compact_str::format_compact!("{}{sub}", group.name);
            item.at.name = group.name_at;
            group.items.push(item);
        }
    }
    group.items.sort_by_key(|item| item.object().map(|(_, sub)| sub));
}

/// Returns the number of text bytes that are copied from the object to each sub-index.
fn copied(reader: &Reader<'_, '_>, raw: &Raw, template: &Item) -> usize {
    let values = OF_A_VALUE.iter().filter_map(|&key| raw.get(key)).map(|entry| reader.doc.value(entry).len());
    let kept = template.extensions.iter().map(|extension| extension.key.len() + extension.value.len());
    values.chain(kept).sum()
}

/// Applies the sections `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]` to the sub-indices of an object. The keys in
/// these sections are decimal sub-indices.
pub(super) fn refine(reader: &mut Reader<'_, '_>, group: &mut Group, index: u16, sections: &[(Refinement, Section)]) {
    for (refinement, section) in sections {
        let extensions = &mut group.extensions;
        let entries = lists::by_sub_index(reader, section, |reader, entry| {
            if reader.doc.is_comment(entry) {
                reader.extension(entry, extensions);
            } else {
                let message = format!("the key `{}` is not a decimal sub-index", reader.doc.key(entry));
                nothing_to_refine(reader, section, entry, message, extensions);
            }
        });
        for (number, entry) in entries {
            let of_number = |item: &Item| item.object().is_some_and(|(_, sub)| u32::from(sub) == number);
            match group.items.iter().position(of_number) {
                Some(position) => apply(reader, &mut group.items[position], *refinement, &entry),
                None => {
                    let message = format!("{} has no sub-index {}", hex16(index), reader.doc.key(&entry));
                    nothing_to_refine(reader, section, &entry, message, &mut group.extensions);
                }
            }
        }
    }
}

fn nothing_to_refine(
    reader: &mut Reader<'_, '_>,
    section: &Section,
    entry: &Entry,
    message: String,
    extensions: &mut Extensions,
) {
    let found = codes::NAME_WITHOUT_SUB.at(reader.doc.key_span(entry), message).label("kept as an extension attribute");
    reader.diagnostics.push(found.help("write the number of an existing sub-index, in decimal"));
    reader.foreign(section, entry, extensions);
}

fn apply(reader: &mut Reader<'_, '_>, item: &mut Item, refinement: Refinement, entry: &Entry) {
    match refinement {
        Refinement::Name => reader.name(Some(entry), &mut item.name, &mut item.at.name),
        Refinement::Value => {
            configured(item).value = reader.typed(Some(entry), item.ty, Role::Value);
            item.at.others.configured = reader.doc.value_span(entry);
            reader.take_comments(&mut item.extensions);
        }
        Refinement::Denotation => configured(item).denotation = Some(reader.doc.value(entry).into()),
    }
}

fn configured(item: &mut Item) -> &mut Configured {
    item.configured.get_or_insert_with(Box::default)
}
