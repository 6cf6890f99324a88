//! Writes the dictionary of a device or module: data types and objects.

use compact_str::CompactString;

use super::object;
use super::record::{self, FieldFacts, Plan};
use super::text::{documentation, hex, name, names};
use super::types::{basic_name, is_self_named, AddedType, SubItem, Types};
use super::Context;
use crate::note::{NoteKind, Notes, Subject};
use crate::xml::Xml;
use lexibus_codegen::etg::type_name::{self, Basic};
use lexibus_codegen::ir::{Access, EnumValue, Group, Item, Shape, Type, TypeDef};

/// An object with its entries by sub-index, and the plan for its type.
type Planned<'g> = (&'g Group, Vec<(u8, &'g Item)>, Plan);

/// Writes the Dictionary element unless it is empty.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, types: &mut Types<'_>, groups: &[&Group]) {
    let planned: Vec<Planned<'_>> = groups
        .iter()
        .filter_map(|group| {
            let items = entries(group, &mut xml.notes);
            if items.is_empty() {
                xml.notes.add(NoteKind::EmptyObject, Subject::object(group));
                return None;
            }
            let plan = record::plan(types, group, &items, &mut xml.notes);
            Some((*group, items, plan))
        })
        .collect();
    if planned.is_empty() && types.defs.is_empty() {
        return;
    }
    xml.open("Dictionary");
    data_types(xml, types);
    xml.open("Objects");
    for (group, items, plan) in &planned {
        object::write(xml, context, types, group, items, plan);
    }
    xml.close();
    xml.close();
}

/// Returns the entries of an object, one for each sub-index. Adds a note for each other item.
fn entries<'g>(group: &'g Group, notes: &mut Notes) -> Vec<(u8, &'g Item)> {
    let mut items: Vec<(u8, &Item)> = Vec::with_capacity(group.items.len());
    let mut seen = [false; 256];
    for item in &group.items {
        match super::objects::address(item) {
            Some((_, sub)) if !std::mem::replace(&mut seen[usize::from(sub)], true) => items.push((sub, item)),
            Some((index, sub)) => notes.add(NoteKind::Duplicate, Subject::Entry(index, sub)),
            None => notes.add(NoteKind::NotAnObject, Subject::item(item)),
        }
    }
    items.sort_by_key(|(sub, _)| *sub);
    items
}

fn data_types(xml: &mut Xml, types: &mut Types<'_>) {
    xml.open("DataTypes");
    for (at, def) in (0u32..).zip(types.defs) {
        data_type(xml, types, at, def);
    }
    // An added type refers only to basic types, declared types, and types that were added before it.
    for added in &types.added {
        added_type(xml, added);
    }
    xml.close();
}

fn data_type(xml: &mut Xml, types: &mut Types<'_>, at: u32, def: &TypeDef) {
    let (name, subject) = (types.name_of(at), Subject::Named(&def.name));
    let bits = types.bits(Type::Named(lexibus_codegen::ir::TypeId(at))).unwrap_or(0);
    let base = match &def.shape {
        Shape::Alias(_) if is_self_named(def, &name) => None,
        Shape::Alias(ty) | Shape::Array { element: ty, .. } => Some(*ty),
        Shape::Enumeration { base, .. } => Some(*base),
        Shape::BitField { .. } if matches!(type_name::basic(&name), Some((Basic::Bits(_), _))) => None,
        Shape::BitField { base, .. } => {
            xml.notes.add(NoteKind::BitField, subject);
            Some(*base)
        }
        Shape::Scaled { base, .. } => {
            xml.notes.add(NoteKind::Quantity, subject);
            Some(*base)
        }
        Shape::Record(_) => None,
    };
    let base = base.map(|ty| types.reference(ty, &mut xml.notes, subject).0);
    xml.open("DataType");
    xml.optional_leaf("Index", def.code.map(|code| hex(code, 4)));
    xml.leaf("Name", &name);
    xml.optional_leaf("BaseType", base.filter(|base| *base != name));
    documentation(xml, "Comment", def.documentation.as_deref(), subject);
    xml.leaf("BitSize", bits);
    match &def.shape {
        Shape::Array { dimensions, .. } => {
            for (lower, count) in dimensions {
                array_info(xml, i64::from(*lower), *count);
            }
        }
        Shape::Record(_) => sub_items(xml, types, at, def),
        Shape::Enumeration { values, .. } => values.iter().for_each(|value| enum_info(xml, "EnumInfo", value)),
        _ => {}
    }
    xml.close();
}

fn array_info(xml: &mut Xml, lower: i64, count: u32) {
    xml.leaves("ArrayInfo", &[("LBound", &lower), ("Elements", &count)]);
}

/// Writes a named value of an enumeration.
pub(super) fn enum_info(xml: &mut Xml, element: &'static str, value: &EnumValue) {
    let subject = Subject::Named(&value.name);
    xml.open(element);
    names(xml, "Text", &value.name, &value.names, subject);
    xml.leaf("Enum", value.value);
    documentation(xml, "Comment", value.documentation.as_deref(), subject);
    xml.close();
    xml.notes.add_many(NoteKind::ValueRange, value.last.is_some(), subject);
    let is_conditional = value.when.is_some() || value.zone.is_some();
    xml.notes.add_many(NoteKind::Behavior, is_conditional, subject);
    xml.notes.add_many(NoteKind::Availability, value.availability.is_some(), subject);
}

/// Writes the SubItem elements of a record type that the device declares.
fn sub_items(xml: &mut Xml, types: &mut Types<'_>, at: u32, def: &TypeDef) {
    let unique = record::field_names(types, at);
    let mut facts = types.uses.get(&at).cloned().unwrap_or_default().into_iter();
    for (field, name) in types.fields(at).iter().zip(unique) {
        xml.notes.add_many(NoteKind::Renamed, name != field.name, Subject::Named(&def.name));
        let (ty, _) = types.reference(field.ty, &mut xml.notes, Subject::Named(&def.name));
        let (sub_index, bits, offset) = (field.sub_index, field.bits, field.bit_offset);
        sub_item(xml, &SubItem { name, sub_index, ty, bits, offset, facts: facts.next() });
    }
}

fn sub_item(xml: &mut Xml, item: &SubItem) {
    let subject = Subject::Named(&item.name);
    xml.open("SubItem");
    xml.optional_leaf("SubIdx", item.sub_index);
    xml.leaf("Name", &item.name);
    for local in item.facts.iter().flat_map(|facts| facts.names.iter()) {
        name(xml, "DisplayName", local, subject);
    }
    xml.leaf("Type", &item.ty);
    let text = item.facts.as_ref().and_then(|facts| facts.documentation.as_deref());
    documentation(xml, "Comment", text, subject);
    xml.leaf("BitSize", item.bits);
    xml.leaf("BitOffs", item.offset);
    if let Some(facts) = &item.facts {
        xml.open("Flags");
        flags(xml, facts, None, subject);
        xml.leaf("Backup", u8::from(facts.backup));
        xml.leaf("Setting", u8::from(facts.setting));
        xml.close();
    }
    xml.close();
}

/// Writes the access rights, category, PDO mapping and safety mapping of an object or sub-item.
pub(super) fn flags(xml: &mut Xml, facts: &FieldFacts, category: Option<&'static str>, subject: Subject<'_>) {
    let read = record::check_states(&facts.read_states, &mut xml.notes, subject);
    let write = record::check_states(&facts.write_states, &mut xml.notes, subject);
    xml.open("Access");
    xml.optional("ReadRestrictions", read);
    xml.optional("WriteRestrictions", write);
    xml.content(match facts.access {
        Access::ReadOnly | Access::Constant => "ro",
        Access::WriteOnly => "wo",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "rw",
    });
    xml.close();
    xml.notes.add_many(NoteKind::Constant, facts.access == Access::Constant, subject);
    xml.optional_leaf("Category", category);
    let directions = [("R", facts.mappable.rpdo), ("T", facts.mappable.tpdo)];
    let directions: String = directions.into_iter().filter(|(_, is_set)| *is_set).map(|(letter, _)| letter).collect();
    xml.text_leaf("PdoMapping", &directions);
    let known = facts.safety.as_deref().filter(|safety| matches!(*safety, "si" | "so" | "sio" | "sp"));
    xml.optional_leaf("SafetyMapping", known);
    xml.notes.add_many(NoteKind::Spelling, facts.safety.is_some() && known.is_none(), subject);
}

fn added_type(xml: &mut Xml, added: &AddedType) {
    xml.open("DataType");
    xml.leaf("Name", &added.name);
    xml.optional_leaf("BaseType", added.array.as_ref().map(|(element, _)| element));
    xml.leaf("BitSize", added.bits);
    if let Some((_, count)) = added.array {
        array_info(xml, 1, count);
    }
    added.fields.iter().for_each(|field| sub_item(xml, field));
    xml.close();
}

/// Returns the type name of a PDO entry, or `None` if ETG.2000 has no name for the type. The exported file does not
/// have to define this type.
pub(super) fn entry_type(types: &Types<'_>, ty: Type) -> Option<CompactString> {
    match ty {
        Type::Named(id) => types.def(ty).map(|_| types.name_of(id.0)),
        Type::Opaque(_) | Type::Time(_) => None,
        basic => Some(basic_name(basic)),
    }
}
