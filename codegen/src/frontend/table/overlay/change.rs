//! Applies a row of an overlay to a description, and records the reason for the change.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::at::TextOr;
use super::super::definitions::DefinitionKind;
use super::super::format::Row;
use super::super::notation::{self, Objects};
use super::super::objects;
use super::super::rows::{Named, Rows};
use super::super::tree::Reader;
use super::super::words::OBJECT_CODES;
use super::{Overlay, PatchRow, Target};
use crate::diagnostics::codes;
use crate::ir::object_names::in_range;
use crate::ir::{
    CompactString, Documentation, Extension, Extensions, Fact, FactOrigin, Group, GroupKind, Item, ObjectBuses,
    ObjectCode, OverlayOrigin, Type, TypeDef, TypeId,
};
use crate::source::Span;
use crate::text::brief;

/// Objects of a device, module or submodule, and the types that the objects use.
pub(super) struct ObjectSet<'c> {
    pub groups: &'c mut Vec<Group>,
    pub types: &'c mut Vec<TypeDef>,
    /// Extensions that record the reasons for the removal of objects.
    pub extensions: &'c mut Extensions,
    /// Buses for objects that the overlay adds.
    pub buses: ObjectBuses,
}

/// Effect of a row. The variants are in ascending order. The maximum effect counts if a row applies to several devices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RowEffect {
    /// The row matches no object or item.
    NoMatch,
    /// The row matches, but the description already contains all of its facts.
    NoChange,
    /// The row added, changed or removed an object or item, or an error in the row was reported.
    Changed,
}

impl From<bool> for RowEffect {
    fn from(changed: bool) -> Self {
        if changed {
            RowEffect::Changed
        } else {
            RowEffect::NoChange
        }
    }
}

/// Applies the rows of an overlay.
pub(super) struct RowPatcher<'o> {
    pub overlay: &'o Overlay,
    pub rows: Rows,
}

impl RowPatcher<'_> {
    /// Applies a row and returns its effect.
    pub(super) fn row(&mut self, reader: &mut Reader<'_, '_>, set: &mut ObjectSet<'_>, row: &PatchRow) -> RowEffect {
        let (adds, removes) = (row.row.value.add == Some(true), row.row.value.remove == Some(true));
        match (row.target, adds, removes) {
            (_, true, true) => {
                reader.report(&codes::TABLE_VALUE, reader.span(&row.key), "a row has both `add` and `remove`");
                RowEffect::Changed
            }
            (Target::Name, true, _) => {
                let (message, help) = ("only objects can be added", "move the row to `[chapters.objects]`");
                reader.report_with_help(&codes::TABLE_VALUE, reader.span(&row.key), message, help);
                RowEffect::Changed
            }
            (_, _, true) => self.remove(reader, set, row),
            (Target::Objects(objects), true, _) => self.add(reader, set, row, objects),
            (Target::Objects(objects), ..) => self.objects(reader, set.groups, row, objects),
            (Target::Name, ..) => self.named(reader, set.groups, row),
        }
    }

    /// Returns the reason for the change that a row makes: the key `why` of the row or, without it, the key `why` of the
    /// overlay. The text is empty if neither has this key.
    fn why<'r>(&'r self, row: &'r Row) -> &'r str {
        row.why.as_deref().or(self.overlay.head.value.why.as_deref()).unwrap_or_default()
    }

    /// Returns the file name, line and reason of a row, from which the origins of the changed facts are created.
    fn change(&self, reader: &Reader<'_, '_>, row: &PatchRow) -> Change {
        let why = self.why(&row.row.value).into();
        Change { file: file_name(reader), line: reader.origin(&row.key).line, why }
    }

    fn objects(
        &mut self,
        reader: &mut Reader<'_, '_>,
        groups: &mut [Group],
        row: &PatchRow,
        objects: Objects,
    ) -> RowEffect {
        let mut effect = RowEffect::NoMatch;
        let groups = in_range(groups, objects.indices.0, objects.indices.1);
        let is_meant = |item: &&Item| {
            item.object().is_some_and(|(_, sub)| objects.subs.is_none_or(|(first, last)| (first..=last).contains(&sub)))
        };
        let count = groups.iter().map(|group| group.items.iter().filter(is_meant).count()).sum();
        if !self.rows.repeats.patch(reader, &row.row.value, count, reader.span(&row.key)) {
            return RowEffect::Changed;
        }
        for group in groups {
            let number = u32::from(group.index().unwrap_or_default().saturating_sub(objects.indices.0));
            let has_subs = group.object_code().is_some_and(ObjectCode::has_subs);
            let changed = match objects.subs {
                None if has_subs || group.items.is_empty() => self.head(reader, group, row, number),
                None => {
                    let head = self.group_name(reader, group, row, number);
                    let items = group.items.iter_mut().filter(|item| item.object().is_some_and(|(_, sub)| sub == 0));
                    RowEffect::from(head).max(self.items(reader, items, row, number))
                }
                Some((first, last)) => {
                    let wanted = |item: &&mut Item| item.object().is_some_and(|(_, sub)| (first..=last).contains(&sub));
                    self.items(reader, group.items.iter_mut().filter(wanted), row, number)
                }
            };
            effect = effect.max(changed);
        }
        effect
    }

    fn items<'i>(
        &mut self,
        reader: &mut Reader<'_, '_>,
        items: impl Iterator<Item = &'i mut Item>,
        row: &PatchRow,
        number: u32,
    ) -> RowEffect {
        let mut effect = RowEffect::NoMatch;
        for item in items {
            let sub = item.object().map(|(_, sub)| sub);
            let name = row.row.value.name.as_ref().map(|name| notation::filled(&name.value, number, sub));
            effect = effect.max(self.item(reader, item, row, name, number).into());
        }
        effect
    }

    /// Changes the item that the key of a row names, either by item name, or by group and item name with a slash
    /// between them.
    fn named(&mut self, reader: &mut Reader<'_, '_>, groups: &mut [Group], row: &PatchRow) -> RowEffect {
        let mut found = find(groups, &row.key.value);
        if found.len() > 1 {
            let message = format!("{} items have the name `{}`", found.len(), brief(&row.key.value));
            let found = codes::TABLE_PLACE.at(reader.span(&row.key), message);
            reader.diagnostics.push(found.help("write `\"Group/Item\"`, or name the object in `[chapters.objects]`"));
            return RowEffect::Changed;
        }
        let Some(item) = found.pop() else { return RowEffect::NoMatch };
        let name = row.row.value.name.as_ref().map(|name| name.value.clone());
        self.item(reader, item, row, name, 0).into()
    }

    /// Changes an item. Returns whether the row changed any fact of the item.
    fn item(
        &mut self,
        reader: &mut Reader<'_, '_>,
        item: &mut Item,
        row: &PatchRow,
        name: Option<String>,
        number: u32,
    ) -> bool {
        let before = item.clone();
        let types = self.rows.definitions.types.len();
        let patch = &row.row.value;
        let text = name.as_deref().unwrap_or(&before.name);
        let named = Named { name: text, key: &row.key, number, end: row.row.end };
        let ty = self.new_type(reader, named, patch, item.ty);
        self.further_addresses(reader, item, named, patch);
        self.rows.fill(reader, item, named, patch, ty);
        // The item keeps its origin in the description. Only the changed facts have spans in the overlay.
        item.origin = before.origin;
        item.at.name = patch.name.as_ref().map_or(before.at.name, |name| reader.span(name));
        if patch.doc.is_none() {
            keep_words(&mut item.documentation, before.documentation.as_deref());
        }
        if self.is_same(item, &before) {
            self.forget_types(types);
            *item = before;
            return false;
        }
        let change = self.change(reader, row);
        change.record(item, &before, row.row.value.ty.is_some());
        explain("Changed", &change.why, &mut item.documentation);
        true
    }

    /// Adds addresses in other protocols to an item if the description lacks them.
    fn further_addresses(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, named: Named<'_>, row: &Row) {
        let (bits, sub) = (self.rows.definitions.bits_of(item.ty), item.object().map(|(_, sub)| sub));
        let found = self.rows.other_addresses(reader, named, sub, row, 0, bits);
        let new: Vec<_> = found.into_iter().filter(|binding| !item.bindings.contains(binding)).collect();
        item.bindings.extend(new);
    }

    /// Returns the new type of an item, or `None` if the row declares no type or an invalid type.
    fn new_type(&mut self, reader: &mut Reader<'_, '_>, named: Named<'_>, row: &Row, old: Type) -> Option<Type> {
        if row.ty.is_some() {
            return self.rows.ty(reader, named, row);
        }
        let (kind, span, name) = match (&row.bits, &row.values) {
            (Some(bits), _) => (DefinitionKind::Bits, reader.span(bits), name_of(&bits.value)),
            (_, Some(values)) => (DefinitionKind::Enumeration, reader.span(values), name_of(&values.value)),
            _ => return None,
        };
        let base = self.rows.definitions.underlying(old);
        if !matches!(base, Type::Integer(_) | Type::Unsigned(_) | Type::Boolean) {
            let message = format!("the item has the type {base}, which cannot have named bits or values");
            reader.report(&codes::TABLE_VALUE, span, message);
            return None;
        }
        let wanted = name.as_deref().and_then(|name| self.rows.definitions.base(reader, kind, name));
        if let Some(wanted) = wanted.filter(|wanted| wanted.bits() != base.bits()) {
            let message = format!("`{}` has the type {wanted}, but the item has {base}", name.unwrap_or_default());
            let found = codes::TABLE_VALUE.at(span, message);
            reader.diagnostics.push(found.help("add `type` to the row if the type in the description is wrong"));
            return None;
        }
        self.rows.meaning(reader, named, row, base)
    }

    /// Returns whether both items are equal except for their spans. Different types are equal if they have the same shape.
    fn is_same(&self, item: &Item, before: &Item) -> bool {
        let types = &self.rows.definitions.types;
        let shape = |ty: Type| match ty {
            Type::Named(TypeId(id)) => types.get(id as usize).map(|definition| &definition.shape),
            _ => None,
        };
        let same_type = item.ty == before.ty || (shape(item.ty).is_some() && shape(item.ty) == shape(before.ty));
        let mut moved = item.clone();
        (moved.ty, moved.at) = (before.ty, before.at.clone());
        same_type && moved == *before
    }

    /// Removes all types except the first `length` types. No item uses the removed types.
    fn forget_types(&mut self, length: usize) {
        self.rows.definitions.types.truncate(length);
        self.rows.definitions.made.retain(|_, made| {
            made.retain(|(_, id)| (id.0 as usize) < length);
            !made.is_empty()
        });
    }

    /// Changes the name, texts, ambiguities and object code of an object that has sub-entries.
    fn head(&mut self, reader: &mut Reader<'_, '_>, group: &mut Group, row: &PatchRow, number: u32) -> RowEffect {
        let patch = &row.row.value;
        if super::super::misplaced::of_value(patch).is_some() {
            let key = brief(&row.key.value);
            let message = format!("`{key}` has sub-entries: write the row for one of them, as in `\"{key}:1\"`");
            reader.report(&codes::TABLE_PLACE, reader.span(&row.key), message);
            return RowEffect::Changed;
        }
        let before = (group.names.clone(), group.documentation.clone(), group.doubts.len());
        let (mut changed, change) = (self.group_name(reader, group, row, number), self.change(reader, row));
        if patch.orig.is_some() {
            group.names = reader.original(patch.orig.as_deref());
        }
        if patch.doc.is_some() {
            group.documentation = reader.documentation_of(patch);
            if group.documentation != before.1 {
                group.origins.set(Fact::Description, Some(change.origin(is_described(&before.1))));
            }
        }
        let origin = reader.origin(&row.key);
        group.doubts.extend(reader.doubts_of(patch, origin));
        changed |= before != (group.names.clone(), group.documentation.clone(), group.doubts.len());
        if changed {
            explain("Changed", &change.why, &mut group.documentation);
        }
        changed.into()
    }

    /// Changes the name and the object code of an object. Returns whether the name or the object code changed.
    fn group_name(&mut self, reader: &mut Reader<'_, '_>, group: &mut Group, row: &PatchRow, number: u32) -> bool {
        let mut changed = false;
        let patch = &row.row.value;
        if let Some(name) = &patch.name {
            let text = notation::filled(&name.value, number, None);
            if group.name != text {
                changed = true;
                group.origins.set(Fact::Name, Some(self.change(reader, row).origin(!group.name.is_empty())));
            }
            (group.name, group.name_at) = (text.into(), reader.span(name));
        }
        let given = patch.code.as_ref().and_then(|code| reader.word(code, "object code", &OBJECT_CODES));
        if let (GroupKind::Object { code, .. }, Some(given)) = (&mut group.kind, given) {
            changed |= *code != given;
            *code = given;
        }
        changed
    }

    fn remove(&mut self, reader: &mut Reader<'_, '_>, set: &mut ObjectSet<'_>, row: &PatchRow) -> RowEffect {
        let count = |groups: &[Group]| (groups.len(), groups.iter().map(|group| group.items.len()).sum::<usize>());
        let before = count(set.groups);
        match row.target {
            Target::Objects(objects) => remove_objects(set.groups, objects),
            Target::Name => {
                let mut found = find(set.groups, &row.key.value);
                if found.len() > 1 {
                    return self.named(reader, set.groups, row);
                }
                if let Some(bindings) = found.pop().map(|item| item.bindings.clone()) {
                    for group in set.groups.iter_mut() {
                        group.items.retain(|item| item.bindings != bindings);
                    }
                    set.groups.retain(|group| !group.items.is_empty() || group.index().is_none());
                }
            }
        }
        if count(set.groups) == before {
            return RowEffect::NoMatch;
        }
        set.extensions.push(Extension {
            key: format!("overlay/removed {}", row.key.value).into(),
            value: self.why(&row.row.value).into(),
            span: reader.span(&row.key),
        });
        RowEffect::Changed
    }

    fn add(
        &mut self,
        reader: &mut Reader<'_, '_>,
        set: &mut ObjectSet<'_>,
        row: &PatchRow,
        objects: Objects,
    ) -> RowEffect {
        if exists(set.groups, objects) {
            return RowEffect::NoChange;
        }
        // Existing objects are part of the dictionary, so that they can get a further sub-entry.
        let mut dictionary = BTreeMap::new();
        let wanted = objects.indices.0..=objects.indices.1;
        let is_meant = |group: &Group| group.index().is_some_and(|index| wanted.contains(&index));
        for group in set.groups.extract_if(.., |group| is_meant(group)) {
            dictionary.insert(group.index().unwrap_or_default(), group);
        }
        objects::add(reader, &mut self.rows, &mut dictionary, &row.key, &row.row, None, None);
        let (change, span) = (self.change(reader, row), reader.span(&row.key));
        let is_new = |origin: Span| (origin.file, origin.start) == (span.file, span.start);
        for group in dictionary.values_mut() {
            for item in group.items.iter_mut().filter(|item| is_new(item.origin.span)) {
                change.record_new(item);
                explain("Added", &change.why, &mut item.documentation);
            }
            if is_new(group.origin.span) {
                let facts =
                    [(Fact::Name, !group.name.is_empty()), (Fact::Description, is_described(&group.documentation))];
                for (fact, _) in facts.into_iter().filter(|(_, is_stated)| *is_stated) {
                    group.origins.set(fact, Some(change.origin(false)));
                }
            }
        }
        set.groups.extend(dictionary.into_values());
        set.groups.sort_by_key(Group::index);
        RowEffect::Changed
    }
}

/// A change that an overlay makes. The origin of each changed fact is created from this struct.
pub(super) struct Change {
    /// File name of the overlay, without folders.
    pub file: CompactString,
    /// Line of the change in the overlay.
    pub line: u32,
    /// Reason for the change.
    pub why: CompactString,
}

impl Change {
    /// Returns the origin of a changed fact. `replaces` is true if the description declares another value for the fact.
    pub fn origin(&self, replaces: bool) -> FactOrigin {
        let row = OverlayOrigin { file: self.file.clone(), line: self.line, replaces, why: self.why.clone() };
        FactOrigin::Overlay(Box::new(row))
    }

    /// Records the overlay row as the origin of the facts that the row changed in an item. `is_type` is true if the row
    /// has a type. Access rights that are an assumption keep their origin.
    fn record(&self, item: &mut Item, before: &Item, is_type: bool) {
        for fact in Fact::ALL {
            let is_other = matches!(fact, Fact::Type if !is_type) || matches!(fact, Fact::Meaning if is_type);
            // The row may declare the value that a rule of the compiler assumed. The fact then has a new origin, but
            // its old value.
            let was_by_rule = matches!(before.origins.get(fact), Some(FactOrigin::Rule(_)));
            let is_stated_now = was_by_rule && item.origins.get(fact).is_none();
            let is_changed = fact.differs(item, before) || is_stated_now;
            if is_other || !is_changed || item.is_access_assumed() && fact == Fact::Access {
                continue;
            }
            item.origins.set(fact, Some(self.origin(fact.is_stated(before) && !was_by_rule)));
        }
    }

    /// Records the overlay row as the origin of all facts in an item that the row added. Facts that already have an
    /// origin, such as a rule of the compiler, keep this origin.
    fn record_new(&self, item: &mut Item) {
        for fact in Fact::ALL {
            if fact.is_stated(item) && item.origins.get(fact).is_none() {
                item.origins.set(fact, Some(self.origin(false)));
            }
        }
    }
}

/// Returns the file name of the overlay, without folders.
pub(super) fn file_name(reader: &Reader<'_, '_>) -> CompactString {
    crate::text::file_name(reader.source.name()).into()
}

fn is_described(documentation: &Option<Arc<Documentation>>) -> bool {
    documentation.as_deref().is_some_and(|documentation| !documentation.text.is_empty())
}

fn name_of<T>(given: &TextOr<T>) -> Option<String> {
    match given {
        TextOr::Text(name) => Some(name.clone()),
        TextOr::Table(_) => None,
    }
}

/// Returns the items that `key` names, either by item name, or by group and item name with a slash between them.
fn find<'g>(groups: &'g mut [Group], key: &str) -> Vec<&'g mut Item> {
    let mut found = Vec::new();
    for group in groups {
        let Group { name, items, .. } = group;
        let in_group = key.strip_prefix(name.as_str()).and_then(|rest| rest.strip_prefix('/'));
        found.extend(items.iter_mut().filter(|item| item.name == key || in_group == Some(item.name.as_str())));
    }
    found
}

/// Removes objects, or sub-entries and the objects that have no sub-entries left.
fn remove_objects(groups: &mut Vec<Group>, objects: Objects) {
    let is_meant = |index: u16| (objects.indices.0..=objects.indices.1).contains(&index);
    let Some((first, last)) = objects.subs else {
        groups.retain(|group| !group.index().is_some_and(is_meant));
        return;
    };
    groups.retain_mut(|group| {
        let count = group.items.len();
        if group.index().is_some_and(is_meant) {
            group.items.retain(|item| !item.object().is_some_and(|(_, sub)| (first..=last).contains(&sub)));
        }
        group.items.len() == count || !group.items.is_empty()
    });
}

/// Returns whether all objects or sub-entries that a row would add already exist.
fn exists(groups: &[Group], objects: Objects) -> bool {
    (objects.indices.0..=objects.indices.1).all(|index| {
        let group = groups.binary_search_by_key(&Some(index), Group::index).ok().and_then(|at| groups.get(at));
        match (group, objects.subs) {
            (None, _) => false,
            (Some(_), None) => true,
            (Some(group), Some((first, last))) => (first..=last).all(|sub| group.sub(sub).is_some()),
        }
    })
}

/// Restores the text and translations that the documentation had before a row without `doc` changed the item.
fn keep_words(documentation: &mut Option<Arc<Documentation>>, before: Option<&Documentation>) {
    let Some(before) = before else { return };
    match documentation {
        Some(documentation) => {
            let documentation = Arc::make_mut(documentation);
            (documentation.text, documentation.translations) = (before.text.clone(), before.translations.clone())
        }
        None => *documentation = Some(Arc::new(before.clone())),
    }
}

/// Adds the reason for a change to the documentation of the changed element.
fn explain(what: &str, why: &str, documentation: &mut Option<Arc<Documentation>>) {
    let documentation = Arc::make_mut(documentation.get_or_insert_default());
    let gap = if documentation.text.is_empty() { "" } else { "\n" };
    let end = if why.ends_with(['.', '!', '?']) { "" } else { "." };
    documentation.text = format!("{}{gap}{what} by an overlay: {why}{end}", documentation.text).into();
}
