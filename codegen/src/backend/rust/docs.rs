//! Doc comments with texts of the description. The texts are escaped so that Markdown shows them literally.

use super::context::Context;
use super::item_addresses::ItemAddresses;
use super::links::DocModule;
use super::naming::handles::NamedItem;
use super::variant;
pub(super) use super::words::{escape, WORDS};
use crate::facts::physical::Physical;
pub(super) use crate::facts::words::sentence;
use crate::facts::words::{capital, row_of, Words};
use crate::facts::{self};
use crate::ir::{Binding, Condition, Documentation, Doubt, ElementId, Item, Manual, Type, TypeId, Value};
use crate::number::hex16;

/// Returns a builder of sentences for doc comments. The sentences link to the elements that they mention.
pub(super) fn linked(link: &dyn Fn(ElementId, &str) -> Option<String>) -> Words<'_> {
    Words { escape, link }
}

/// Returns a function that creates links to other elements for the documentation of an item. The function returns no
/// link to the item itself. It compares IDs instead of names, because the replacement of an item may have the same name
/// as the item.
fn links_from<'c>(
    entry: &'c NamedItem<'_>,
    context: &'c Context<'_>,
    doc_module: DocModule<'c>,
) -> impl Fn(ElementId, &str) -> Option<String> + 'c {
    move |id, name| (id != entry.id.into()).then(|| context.link_to(id, name, doc_module))?
}

/// Returns the documentation of an item's constant. The first paragraph contains the name, the main facts (such as
/// unit, limits, addresses, type and access rights), and links to related elements. Rustdoc shows only this paragraph
/// in lists of constants. The description of the item and its other facts follow. Links are relative to `doc_module`.
pub(super) fn item(
    entry: &NamedItem<'_>,
    name: &str,
    chapter: Option<&str>,
    context: &Context<'_>,
    doc_module: DocModule<'_>,
) -> Vec<String> {
    let item = entry.item;
    let link = links_from(entry, context, doc_module);
    let words = linked(&link);
    let mut lines = Vec::with_capacity(6);
    lines.push(titled(name, &facts(item, context, &words)));
    let related = context.links.related_to_constant(entry, type_name(context, item), doc_module);
    lines.extend(Some(related).filter(|line| !line.is_empty()));
    let mut paragraphs = Vec::new();
    paragraphs.extend(WORDS.access(item));
    if let Type::Named(TypeId(id)) = item.ty {
        paragraphs.extend(WORDS.meaning_from(context.types.get(id as usize)));
    }
    if let Some(quantity) = &item.quantity {
        paragraphs.extend(WORDS.notes(quantity));
    }
    paragraphs.extend(WORDS.origins(&item.origins));
    if let Some(behavior) = &item.behavior {
        paragraphs.push(words.behavior(behavior).join(" "));
    }
    paragraphs.extend(item.bindings.iter().filter_map(elsewhere));
    paragraphs.extend(words.variants(item, &context.manual));
    let widest = variant::widest(item);
    if (&widest.low, &widest.high) != (&item.limits.low, &item.limits.high) {
        let physical = Physical::of(item.quantity.as_deref());
        let range = words.range(&widest, physical.as_ref(), &value);
        paragraphs.push(format!(
            "Generated code checks written values against the widest range of all models and buses: {range}."
        ));
    }
    if let Some(availability) = &item.availability {
        paragraphs.push(words.availability(availability));
    }
    let place = WORDS.manual_entry(&context.manual, row_of(item), item.documentation.as_deref(), &item.names);
    let chapter = chapter.filter(|chapter| !chapter.trim().is_empty());
    let chapter = chapter.map(|chapter| format!("Chapter: {}", sentence(&escape(chapter))));
    paragraphs.push(chapter.into_iter().chain(place).collect::<Vec<_>>().join(" "));
    paragraphs.extend(doubts(&item.doubts, &context.manual));
    let paragraphs = paragraphs.into_iter().filter(|paragraph| !paragraph.is_empty());
    lines.extend(separated(documentation(item).into_iter().chain(paragraphs)));
    exact(lines)
}

/// Returns the documentation of an item's accessor: the text of the description, if there is one, the name, facts,
/// storage, related elements and ambiguities. Links are relative to `doc_module`.
pub(super) fn method(
    entry: &NamedItem<'_>,
    name: &str,
    context: &Context<'_>,
    doc_module: DocModule<'_>,
) -> Vec<String> {
    let item = entry.item;
    let link = links_from(entry, context, doc_module);
    let words = linked(&link);
    let mut lines = paragraphs(documentation(item));
    let facts = facts(item, context, &words);
    if lines.is_empty() && !name.trim().is_empty() {
        lines.extend([sentence(&escape(name.trim())), String::new(), facts]);
    } else {
        if !lines.is_empty() {
            lines.push(String::new());
        }
        lines.push(titled(name, &facts));
    }
    let storage = item.behavior.as_ref().and_then(|behavior| words.storage(&behavior.storage));
    lines.extend(storage.map(|storage| sentence(&capital(&storage))));
    lines.push(context.links.related_to_method(entry, type_name(context, item), doc_module));
    lines.extend(separated(doubts(&item.doubts, &context.manual)));
    exact(lines)
}

/// Frees the unused capacity of lines that are stored in a model. A model contains many of them.
pub(super) fn exact(mut lines: Vec<String>) -> Vec<String> {
    lines.iter_mut().for_each(String::shrink_to_fit);
    lines.shrink_to_fit();
    lines
}

/// Returns `name: facts`, or only the facts if the name is empty.
fn titled(name: &str, facts: &str) -> String {
    match escape(name.trim()).trim_end_matches('.') {
        "" => facts.to_owned(),
        name => format!("{name}: {facts}"),
    }
}

/// Returns the name of an item's enumeration or bit field. Returns `None` for other types.
fn type_name<'c>(context: &'c Context<'_>, item: &Item) -> Option<&'c str> {
    context.enumeration(item.ty).map(|named| named.name.as_str())
}

/// Returns a sentence about an address in the device's ASCII protocol or in the memory of a slave controller. Returns
/// `None` for other addresses.
fn elsewhere(binding: &Binding) -> Option<String> {
    match binding {
        Binding::Ascii(name) => Some(format!("Name in the device's ASCII protocol: {}.", escape(name))),
        Binding::EscMemory { address, length } => {
            Some(format!("Address in the memory of the slave controller: {}, {length} bytes.", hex16(*address)))
        }
        _ => None,
    }
}

/// Returns a condition in words, such as `Mode is 1 or 2` or `Status & 0x4 is 0`. The link to the item is relative to
/// `doc_module`.
pub(super) fn holds(condition: &Condition, context: &Context<'_>, doc_module: DocModule<'_>) -> String {
    linked(&|id, name| context.link_to(id, name, doc_module)).holds(condition)
}

/// Returns the lines of a doc comment, in which empty lines separate the paragraphs.
pub(super) fn paragraphs(paragraphs: impl IntoIterator<Item = String>) -> Vec<String> {
    separated(paragraphs).skip(1).collect()
}

/// Returns the paragraphs, with an empty line before each of them.
fn separated(paragraphs: impl IntoIterator<Item = String>) -> impl Iterator<Item = String> {
    paragraphs.into_iter().flat_map(|paragraph| [String::new(), paragraph])
}

/// Returns the documentation of an element and its citation.
pub(super) fn described(documentation: Option<&Documentation>, manual: &Manual) -> Vec<String> {
    let citation = WORDS.manual_entry(manual, "", documentation, &[]);
    WORDS.description(documentation).into_iter().chain(citation).collect()
}

/// Returns sentences about ambiguities in the manual. The most severe ambiguity comes first.
pub(super) fn doubts(list: &[Doubt], manual: &Manual) -> Vec<String> {
    let mut list: Vec<&Doubt> = list.iter().collect();
    list.sort_by_key(|doubt| doubt.severity);
    list.into_iter().map(|doubt| WORDS.doubt(manual, doubt)).collect()
}

/// Returns the first lines of the documentation of the type at `position`: name, description, origin, ambiguities, and
/// `users`, a sentence about the items that use the type.
pub(super) fn of_type(context: &Context<'_>, position: u32, users: &str) -> Vec<String> {
    let Some(definition) = context.types.get(position as usize) else { return Vec::new() };
    let documentation = definition.documentation.as_deref();
    let mut lines = vec![sentence(&escape(&definition.name))];
    lines.extend(described(documentation, &context.manual));
    lines.extend(WORDS.defined_by(definition.stated_by.as_deref(), documentation));
    lines.extend(doubts(&definition.doubts, &context.manual));
    lines.extend(Some(users.to_owned()).filter(|users| !users.is_empty()));
    paragraphs(lines)
}

fn facts(item: &Item, context: &Context<'_>, words: &Words<'_>) -> String {
    let base = context.base(item.ty);
    let raw = |shown: &Value| if item.quantity.is_some() { value(shown) } else { typed(shown, base) };
    let shown = |value: &Value| WORDS.of_item(item, value, &raw);
    let configured = item.configured.as_ref().and_then(|configured| configured.value.as_ref());
    let mut parts: Vec<String> = item.quantity.iter().filter_map(|quantity| words.unit(quantity)).collect();
    parts.extend(limits(item));
    parts.extend(item.default.as_ref().map(|default| format!("default {}", shown(default))));
    parts.extend(configured.map(|configured| format!("configured to {}", shown(configured))));
    parts.extend(Some(ItemAddresses::of(context, item).facts(context, item)).filter(|text| !text.is_empty()));
    parts.push(base.to_string());
    parts.push(WORDS.access_rights(item));
    parts.extend(facts::item::mappable(item.mappable).map(|pdos| format!("mappable into {pdos}")));
    format!("{}.", capital(&parts.join(", ")))
}

/// Returns a value of the type `ty` as text.
pub(super) fn typed(shown: &Value, ty: Type) -> String {
    match shown {
        Value::Int(number) => facts::item::integer(*number, matches!(ty, Type::Unsigned(_))),
        other => value(other),
    }
}

pub(super) fn value(value: &Value) -> String {
    WORDS.value(value)
}

pub(super) fn limits(item: &Item) -> Option<String> {
    WORDS.limits(&item.limits, Physical::of(item.quantity.as_deref()).as_ref())
}

fn documentation(item: &Item) -> Vec<String> {
    let denotation = item.configured.as_ref().and_then(|configured| configured.denotation.as_ref());
    let denotation = denotation.map(|denotation| format!("Denotation: {}", sentence(&escape(denotation))));
    let lines = item.documentation.iter().flat_map(|documentation| documentation.text.lines());
    let lines = lines.filter(|line| !line.trim().is_empty()).map(|line| sentence(&escape(line)));
    denotation.into_iter().chain(lines).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_is_shown_literally() {
        assert_eq!(escape("a[b] <i> `x` *y*"), r"a\[b\] \<i\> \`x\` \*y\*");
        assert_eq!(escape("- 1"), r"\- 1");
        assert_eq!(escape("1. x"), r"1\. x");
        assert_eq!(escape("see https://x"), r"see https\://x");
        assert_eq!(escape("a\u{202e}b\nc"), "a b c");
    }
}
