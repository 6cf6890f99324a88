//! Writes the objects of a dictionary.

use compact_str::CompactString;

use super::dictionary::flags;
use super::record::{self, FieldFacts, Plan};
use super::text::{documentation, hex, names};
use super::types::Types;
use super::{value, Context};
use crate::note::{self, NoteKind, Notes, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Category, Group, GroupKind, Item, Storage, ToolFlags};

/// Writes the Object element of an object with the given entries.
pub(super) fn write(
    xml: &mut Xml,
    context: &mut Context<'_>,
    types: &Types<'_>,
    group: &Group,
    items: &[(u8, &Item)],
    plan: &Plan,
) {
    let subject = Subject::object(group);
    let single = items.first().map(|(_, item)| *item).filter(|_| plan.names.is_none());
    xml.open("Object");
    index(xml, group);
    names(xml, "Name", &group.name, &group.names, subject);
    let text = group.documentation.as_deref().or_else(|| single.and_then(|item| item.documentation.as_deref()));
    documentation(xml, "Comment", text, subject);
    xml.leaf("Type", &plan.ty);
    xml.leaf("BitSize", plan.bits);
    let both = group.documentation.is_some() && single.is_some_and(|item| item.documentation.is_some());
    xml.notes.add_many(NoteKind::Documentation, both, subject);
    match (single, &plan.names) {
        (Some(item), _) => {
            let has_other_name = item.name != group.name;
            xml.notes.add_many(NoteKind::Name, has_other_name, subject);
            xml.open("Info");
            info(xml, types, item);
            display_name(xml, group, item);
            unit(xml, context, item);
            xml.close();
        }
        (None, names) => sub_items(xml, context, types, items, names.as_deref().unwrap_or_default()),
    }
    object_flags(xml, group, single);
    properties(xml, group);
    xml.close();
    losses(group, items, &mut xml.notes);
}

fn index(xml: &mut Xml, group: &Group) {
    xml.open("Index");
    xml.flag("DependOnSlot", group.depends_on_slot, "true");
    xml.flag("DependOnSlotGroup", group.depends_on_slot_group, "true");
    let tool = group.tool_flags.as_deref();
    xml.text_attribute("OverwrittenByModule", tool.map_or("", |tool| &tool.overwritten_by_module));
    xml.content(hex(group.index().unwrap_or(0), 4));
    xml.close();
}

/// Writes a SubItem element for each entry, unless the elements would only repeat the names of the type.
fn sub_items(
    xml: &mut Xml,
    context: &mut Context<'_>,
    types: &Types<'_>,
    items: &[(u8, &Item)],
    names: &[CompactString],
) {
    let has_more_facts = |(item, name): (&Item, &CompactString)| {
        let has_unit = item.quantity.as_ref().is_some_and(|quantity| !quantity.unit.is_empty());
        let has_display_name = record::display_name(item).is_some();
        item.name != *name || item.default.is_some() || !item.limits.is_empty() || has_unit || has_display_name
    };
    let entries = items.iter().map(|(_, item)| *item).zip(names);
    if !entries.clone().any(has_more_facts) {
        return;
    }
    xml.open("Info");
    for (item, name) in entries {
        xml.open("SubItem");
        // An entry without a name gets the name of its SubItem in the type.
        xml.leaf("Name", if item.name.is_empty() { name } else { &item.name });
        xml.open("Info");
        info(xml, types, item);
        xml.optional_leaf("DisplayName", record::display_name(item));
        unit(xml, context, item);
        xml.close();
        xml.close();
    }
    xml.close();
}

/// Writes the default value and the limits of an item.
fn info(xml: &mut Xml, types: &Types<'_>, item: &Item) {
    let (elements, notes) = value::elements(item, types.underlying(item.type_on(record::BUS)));
    elements.into_iter().for_each(|(name, text)| xml.leaf(name, text));
    xml.notes.add_all(notes, Subject::item(item));
    xml.notes.add_many(NoteKind::AllowedValues, !item.limits.allowed.is_empty(), Subject::item(item));
}

/// Writes the display name of an object with a single value, unless it repeats the translations of the object's name.
/// ETG.2000 allows one display name per object.
fn display_name(xml: &mut Xml, group: &Group, item: &Item) {
    if item.names == group.names {
        return;
    }
    match record::display_name(item) {
        Some(name) => xml.leaf("DisplayName", name),
        None => xml.notes.add_many(NoteKind::Language, item.names.len(), Subject::item(item)),
    }
}

/// Writes the unit if ETG.2000 has a number for it. Adds a note if the unit has no number, or if the quantity has a
/// scale, sentinel values, a step or further units.
fn unit(xml: &mut Xml, context: &mut Context<'_>, item: &Item) {
    let Some(quantity) = &item.quantity else { return };
    let number = context.unit(&quantity.unit);
    xml.optional_leaf("Unit", number.as_ref());
    let has_more_facts = quantity.scale.is_some()
        || !quantity.sentinels.is_empty()
        || quantity.step.is_some()
        || !quantity.units.is_empty();
    xml.notes.add_many(NoteKind::Quantity, number.is_none() || has_more_facts, Subject::item(item));
}

fn object_flags(xml: &mut Xml, group: &Group, single: Option<&Item>) {
    let category = match group.kind {
        GroupKind::Object { category, .. } => category,
        _ => None,
    };
    let letter = match category {
        Some(Category::Mandatory) => Some("m"),
        Some(Category::Optional) => Some("o"),
        Some(Category::Conditional) => Some("c"),
        Some(Category::Manufacturer) | None => None,
    };
    let subject = Subject::object(group);
    let is_lost = category == Some(Category::Manufacturer);
    xml.notes.add_many(NoteKind::Category, is_lost, subject);
    let none = ToolFlags::default();
    let tool = group.tool_flags.as_deref().unwrap_or(&none);
    let others = [("Attribute", &tool.attribute), ("Transition", &tool.transition), ("SdoAccess", &tool.sdo_access)];
    if single.is_none() && letter.is_none() && others.iter().all(|(_, text)| text.is_empty()) {
        return;
    }
    xml.open("Flags");
    let facts = single.map(FieldFacts::of);
    match &facts {
        Some(facts) => flags(xml, facts, letter, subject),
        None => {
            xml.optional_leaf("Category", letter);
        }
    }
    others.into_iter().for_each(|(name, text)| xml.text_leaf(name, text));
    if let Some(facts) = facts {
        xml.optional_leaf("Backup", facts.backup.then_some(1));
        xml.optional_leaf("Setting", facts.setting.then_some(1));
    }
    xml.close();
}

/// Writes the extension attributes of an object as Property elements with a name and a value.
fn properties(xml: &mut Xml, group: &Group) {
    xml.list("Properties", &group.extensions, |xml, extension| {
        xml.leaves("Property", &[("Name", &extension.key), ("Value", &extension.value)]);
    });
}

/// Adds notes for facts of an object and its entries that ETG.2000 cannot express.
fn losses(group: &Group, items: &[(u8, &Item)], notes: &mut Notes) {
    notes.add_many(NoteKind::Doubt, group.doubts.len(), Subject::object(group));
    notes.add_many(NoteKind::Setting, group.links.len(), Subject::object(group));
    for (_, item) in items {
        let subject = Subject::item(item);
        // Only one address of each item is exported, and each other address counts as a lost fact.
        let other_buses = item.bindings.len().saturating_sub(1);
        notes.add_many(NoteKind::Binding, other_buses, subject);
        let more = item.behavior.as_ref().is_some_and(|behavior| {
            behavior.storage != Storage::Unknown
                || behavior.effective.is_some()
                || !behavior.write_when.is_empty()
                || !behavior.writable_values.is_empty()
                || !behavior.side_effects.is_empty()
                || behavior.self_clearing
                || behavior.write_once
                || behavior.hidden
        });
        notes.add_many(NoteKind::Behavior, more, subject);
        note::of_item(item, notes, subject);
        notes.add_many(NoteKind::Extension, item.extensions.len(), subject);
        notes.add_many(NoteKind::Configuration, item.configured.is_some(), subject);
        notes.add_many(NoteKind::Setting, item.flags != 0, subject);
    }
}
