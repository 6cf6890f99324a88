//! Objects with sub-indices and their record types.

use std::sync::Arc;

use compact_str::{format_compact, CompactString};

use super::types::{unique, AddedType, SubItem, Types};
use crate::note::{NoteKind, Notes, Subject};
use lexibus_codegen::ir::{Access, Bus, Documentation, Field, Group, Item, Mappable, ObjectCode, Texts, Type};
use lexibus_codegen::unique::Unique;

/// The bus that an ESI describes.
pub(super) const BUS: Bus = Bus::EtherCat;

/// A sub-index of an object that has a record type.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) sub_index: u8,
    pub(super) ty: Type,
    /// Position of the field in the record.
    pub(super) field: usize,
    /// Element number if the field is an array.
    pub(super) element: Option<u32>,
}

/// The properties that a record type states for a field. All items that the field describes have these properties.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FieldFacts {
    pub(super) access: Access,
    pub(super) mappable: Mappable,
    pub(super) backup: bool,
    pub(super) setting: bool,
    pub(super) safety: Option<CompactString>,
    pub(super) read_states: Vec<CompactString>,
    pub(super) write_states: Vec<CompactString>,
    pub(super) names: Texts,
    pub(super) documentation: Option<Arc<Documentation>>,
}

impl FieldFacts {
    pub(super) fn of(item: &Item) -> Self {
        let behavior = item.behavior.as_deref();
        FieldFacts {
            access: item.access_on(BUS),
            mappable: item.mappable,
            backup: behavior.is_some_and(|behavior| behavior.backup),
            setting: behavior.is_some_and(|behavior| behavior.setting),
            safety: behavior.and_then(|behavior| behavior.safety.clone()),
            read_states: behavior.map_or_else(Vec::new, |behavior| behavior.read_states.clone()),
            write_states: behavior.map_or_else(Vec::new, |behavior| behavior.write_states.clone()),
            names: if display_name(item).is_some() { Texts::default() } else { item.names.clone() },
            documentation: item.documentation.clone(),
        }
    }
}

/// Returns the display name of an item if the item has only one display name and this name is in English. ETG.2000
/// stores the display name in the object and allows no other languages.
pub(super) fn display_name(item: &Item) -> Option<&CompactString> {
    match &*item.names {
        [only] if only.language.starts_with("en") => Some(&only.text),
        _ => None,
    }
}

/// The planned type of an object.
pub(super) struct Plan {
    /// Name of the type.
    pub(super) ty: CompactString,
    pub(super) bits: u32,
    /// Names of the sub-items in the type, for entries without a name in the object. `None` means that the object has a single
    /// value.
    pub(super) names: Option<Vec<CompactString>>,
}

/// Returns the entries of an object whose record type has these fields, sorted by sub-index. An array field gives one
/// entry per element (ETG.2000, DataType). An array field gives a single entry if its elements would reach the
/// sub-index of the next field or exceed sub-index 255. An array field whose type name begins with `ARRAY` also gives a
/// single entry.
pub(super) fn expansion(types: &Types<'_>, fields: &[Field]) -> Vec<Entry> {
    let (mut entries, mut next) = (Vec::new(), 0u32);
    for (position, field) in fields.iter().enumerate() {
        let following = fields.get(position + 1).and_then(|field| field.sub_index).map(u32::from);
        let (first, mut count, mut ty) = span(types, field, next, following);
        if count > 1 && first.saturating_add(count) > 256 {
            (count, ty) = (1, field.ty);
        }
        for number in 0..count {
            let Some(sub_index) = first.checked_add(number).and_then(|sub| u8::try_from(sub).ok()) else { break };
            let element = (ty != field.ty || count > 1).then_some(number + 1);
            entries.push(Entry { sub_index, ty, field: position, element });
        }
        next = first.saturating_add(count);
    }
    entries.sort_by_key(|entry| entry.sub_index);
    entries.dedup_by_key(|entry| entry.sub_index);
    entries
}

/// Returns the first sub-index of a field, the number of its sub-indices, and the type of each of them.
fn span(types: &Types<'_>, field: &Field, next: u32, following: Option<u32>) -> (u32, u32, Type) {
    let given = field.sub_index.map(u32::from);
    let Some((element, lower, count)) = types.elements(field.ty) else { return (given.unwrap_or(next), 1, field.ty) };
    let first = given.unwrap_or_else(|| u32::try_from(lower).unwrap_or(0).max(next));
    let room = following.is_none_or(|following| following >= first.saturating_add(count));
    let is_one_value = types.def(field.ty).is_some_and(|def| def.name.starts_with("ARRAY"));
    if is_one_value || !room {
        return (first, 1, field.ty);
    }
    (first, count, element)
}

/// Returns the type of an object. For an object without sub-indices, this is the type of the value. For an object with
/// sub-indices, it is a declared type that describes exactly the object's entries, or a new type.
pub(super) fn plan(types: &mut Types<'_>, group: &Group, items: &[(u8, &Item)], notes: &mut Notes) -> Plan {
    if let ([(0, item)], false) = (items, group.object_code().is_some_and(ObjectCode::has_subs)) {
        let (ty, bits) = types.reference(item.type_on(BUS), notes, Subject::item(item));
        return Plan { ty, bits, names: None };
    }
    let index = group.index().unwrap_or(0);
    let key: Vec<(u8, Type)> = items.iter().map(|(sub, item)| (*sub, item.type_on(BUS))).collect();
    let candidates = types.records.get(&key).cloned().unwrap_or_default();
    let usual = format_compact!("DT{index:04X}");
    let (first, others): (Vec<u32>, Vec<u32>) = candidates.into_iter().partition(|&at| types.name_of(at) == usual);
    let mut candidates = first.into_iter().chain(others);
    if let Some(plan) = candidates.find_map(|at| existing(types, at, group, items)) {
        return plan;
    }
    if group.object_code() == Some(ObjectCode::Array) && is_array(types, items) {
        return new_array(types, &usual, items, notes);
    }
    new_record(types, &usual, items, notes)
}

/// Returns a plan with the declared record type at `at` if the properties of its fields fit these items.
fn existing(types: &mut Types<'_>, at: u32, group: &Group, items: &[(u8, &Item)]) -> Option<Plan> {
    let entries = expansion(types, types.fields(at));
    // The type of an ARRAY object must consist of sub-index 0 and arrays. The type of a RECORD object must not.
    let is_array = match entries.split_first() {
        Some((first, rest)) => {
            first.sub_index == 0 && !rest.is_empty() && rest.iter().all(|rest| rest.element.is_some())
        }
        None => false,
    };
    if matches!(group.object_code(), Some(code @ (ObjectCode::Array | ObjectCode::Record)) if is_array != (code == ObjectCode::Array))
    {
        return None;
    }
    let fields = field_names(types, at);
    let names: Vec<CompactString> = entries.iter().map(|entry| name_of(entry, &fields)).collect();
    if !matches_by_name_or_position(&entries, &fields, items) {
        return None;
    }
    let mut facts: Vec<Option<FieldFacts>> = vec![None; fields.len()];
    for (entry, (_, item)) in entries.iter().zip(items) {
        let (item_facts, field_facts) = (FieldFacts::of(item), facts.get_mut(entry.field)?);
        if field_facts.get_or_insert_with(|| item_facts.clone()) != &item_facts {
            return None;
        }
    }
    let facts: Option<Vec<FieldFacts>> = facts.into_iter().collect();
    let facts = facts?;
    if types.uses.entry(at).or_insert_with(|| facts.clone()) != &facts {
        return None;
    }
    let bits = types.defs.get(at as usize).and_then(|def| def.bits).unwrap_or(0);
    Some(Plan { ty: types.name_of(at), bits, names: Some(names) })
}

/// Returns the field names of a record, made unique as the schema requires.
pub(super) fn field_names(types: &Types<'_>, at: u32) -> Vec<CompactString> {
    unique_names(types.fields(at).iter().map(|field| field.name.as_str()))
}

fn unique_names<'n>(names: impl Iterator<Item = &'n str>) -> Vec<CompactString> {
    let mut seen = Unique::default();
    names.map(|name| unique(&mut seen, name)).collect()
}

/// Returns the name of an entry for which the object gives no name: the name of its field. If the field is an array,
/// the number of the element follows.
fn name_of(entry: &Entry, fields: &[CompactString]) -> CompactString {
    let name = fields.get(entry.field).cloned().unwrap_or_default();
    match entry.element {
        Some(number) => format_compact!("{name} {number}"),
        None => name,
    }
}

/// Returns whether readers assign each item to the correct entry. Readers identify the entry of a SubItem element by
/// the name or, if no name matches, by the position.
fn matches_by_name_or_position(entries: &[Entry], fields: &[CompactString], items: &[(u8, &Item)]) -> bool {
    let named = |entry: &Entry| fields.get(entry.field).map_or("", CompactString::as_str);
    items.iter().enumerate().all(|(position_of_item, (_, item))| {
        let single = entries
            .iter()
            .position(|entry| entry.element.is_none_or(|number| number == 1) && named(entry) == item.name);
        single.is_none_or(|found| found <= position_of_item)
    })
}

/// Returns whether the items are sub-index 0 and, starting at sub-index 1, elements of the same type and with the same
/// properties.
fn is_array(types: &Types<'_>, items: &[(u8, &Item)]) -> bool {
    let [(0, _), (_, first), ..] = items else { return false };
    let facts = FieldFacts::of(first);
    let is_like = |(position, (sub, item)): (usize, &(u8, &Item))| {
        usize::from(*sub) == position
            && (position == 0 || item.type_on(BUS) == first.type_on(BUS) && FieldFacts::of(item) == facts)
    };
    items.iter().enumerate().all(is_like) && types.elements(first.type_on(BUS)).is_none()
}

/// Bit offset of sub-index 1. The bits between sub-index 0 and sub-index 1 are unused (ETG.2000, DataType).
const FIRST_OFFSET: u32 = 16;

fn new_array(types: &mut Types<'_>, usual: &str, items: &[(u8, &Item)], notes: &mut Notes) -> Plan {
    const ELEMENTS: CompactString = CompactString::const_new("Elements");
    let (Some((_, count_item)), Some((_, first))) = (items.first(), items.get(1)) else {
        return new_record(types, usual, items, notes);
    };
    let count = u32::try_from(items.len() - 1).unwrap_or(u32::MAX);
    let (element, element_bits) = types.reference(first.type_on(BUS), notes, Subject::item(first));
    let (count_type, count_bits) = types.reference(count_item.type_on(BUS), notes, Subject::item(count_item));
    let bits = element_bits.saturating_mul(count);
    let array = types.unique(&format_compact!("{usual}ARR"));
    let of_array = AddedType { name: array.clone(), bits, array: Some((element, count)), fields: Vec::new() };
    types.added.push(of_array);
    let field = |name: &CompactString, sub_index, ty, bits, offset, item: &Item| {
        let facts = Some(FieldFacts::of(item));
        SubItem { name: name.clone(), sub_index: Some(sub_index), ty, bits, offset, facts }
    };
    let count_name = if count_item.name == ELEMENTS { "SubIndex 000".into() } else { count_item.name.clone() };
    let fields = vec![
        field(&count_name, 0, count_type, count_bits, 0, count_item),
        field(&ELEMENTS, 1, array, bits, FIRST_OFFSET, first),
    ];
    let numbered = (1..=count).map(|number| format_compact!("{ELEMENTS} {number}"));
    let names = std::iter::once(count_name).chain(numbered).collect();
    finish(types, usual, fields, names)
}

fn new_record(types: &mut Types<'_>, usual: &str, items: &[(u8, &Item)], notes: &mut Notes) -> Plan {
    let names = unique_names(items.iter().map(|(_, item)| item.name.as_str()));
    let (mut fields, mut next) = (Vec::with_capacity(items.len()), 0u32);
    for ((sub_index, item), name) in items.iter().zip(&names) {
        let (ty, bits) = types.reference(item.type_on(BUS), notes, Subject::item(item));
        let offset = if *sub_index > 0 { next.max(FIRST_OFFSET) } else { next };
        next = offset.saturating_add(bits);
        let facts = Some(FieldFacts::of(item));
        fields.push(SubItem { name: name.clone(), sub_index: Some((*sub_index).into()), ty, bits, offset, facts });
    }
    finish(types, usual, fields, names)
}

fn finish(types: &mut Types<'_>, usual: &str, fields: Vec<SubItem>, names: Vec<CompactString>) -> Plan {
    let bits = fields.last().map_or(0, |last| last.offset.saturating_add(last.bits));
    let ty = types.unique(usual);
    types.added.push(AddedType { name: ty.clone(), bits, array: None, fields });
    Plan { ty, bits, names: Some(names) }
}

/// Converts state names to the notation of the schema. Returns `None` if there are no names. If the schema does not
/// allow the names, adds a note and returns `None`.
pub(super) fn check_states(states: &[CompactString], notes: &mut Notes, subject: Subject<'_>) -> Option<String> {
    const KNOWN: [&str; 7] = ["PreOp", "PreOP", "PreOP_SafeOP", "PreOP_OP", "SafeOP", "SafeOP_OP", "OP"];
    let joined = states.join("_");
    if joined.is_empty() {
        return None;
    }
    let known = KNOWN.contains(&joined.as_str());
    notes.add_many(NoteKind::Spelling, !known, subject);
    known.then_some(joined)
}
