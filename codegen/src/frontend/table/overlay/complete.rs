//! A profile adds what a description leaves unsaid.
//!
//! What a device says of itself stays: its names, its types of bits and values, its units, its words. Where its object is
//! of another width than the profile's, or isn't there, the profile has nothing to add, and nobody is told.

use std::collections::HashMap;

use super::super::buses;
use super::super::format::{ImageTable, Row};
use super::super::process;
use super::super::rows::{Named, Rows};
use super::super::tree::{cited, Reader};
use super::super::types;
use super::{at_place, in_range, item_name, name_conditions, Patch, PatchRow, Profile, Target};
use crate::diagnostics::Diagnostics;
use crate::ir::{
    Binding, Buses, CodeTable, CompactString, Device, Direction, Documentation, Fact, FactOrigin, Group, IoData, Item,
    Module, Pdo, PdoEntry, PdoEntryKind, Shape, StateMachine, Submodule, Type, TypeDef, TypeId, TypeRef,
};
use crate::source::{FileId, Origin};
use crate::text::standard_and_clause;

/// Indices of which each axis has its own.
const AXIS: std::ops::RangeInclusive<u16> = 0x6000..=0x67FF;

/// The greatest number of axes (CiA 402: 0x6000 to 0x9FFF).
const AXES: u16 = 8;

/// A profile while it is applied to one device after another.
pub(crate) struct Completion<'p> {
    profile: &'p Profile,
    rows: Rows,
    /// What would be wrong with the profile is told by its test.
    silent: Diagnostics,
}

/// Types of items that were replaced, by object.
type Replaced = HashMap<(u16, u8), (Type, Type)>;

impl<'p> Completion<'p> {
    pub(crate) fn new(profile: &'p Profile) -> Self {
        Completion { profile, rows: profile.patch.filler(), silent: Diagnostics::default() }
    }

    fn patch(&self) -> &'p Patch {
        &self.profile.patch
    }

    /// The buses that devices which follow the profile are on.
    pub(crate) fn buses(&mut self) -> Buses {
        let buses = self.profile.head.buses.as_ref();
        buses.map_or(Buses::ALL, |list| self.with_reader(|reader, _| buses::read(reader, list)))
    }

    fn with_reader<T>(&mut self, act: impl FnOnce(&mut Reader<'_, '_>, &mut Rows) -> T) -> T {
        let mut reader = Reader::new(&self.profile.source, FileId(0), &mut self.silent);
        reader.language.clone_from(&self.profile.patch.language);
        reader.standard = self.profile.standard();
        act(&mut reader, &mut self.rows)
    }

    /// Completes a device; `is_table` tells register tables and overlays from other files.
    pub(crate) fn device(&mut self, device: &mut Device, is_table: &dyn Fn(FileId) -> bool) {
        self.objects(&mut device.groups, &mut device.types, &mut device.process_data.pdos);
        // The codes that a manual lists may contradict those of the profile. Diagnosis texts of an ESI are other codes.
        let of_manual = |own: &CodeTable| is_table(own.origin.span.file) && !is_from_profile(own);
        let has_own = device.code_tables.iter().any(of_manual);
        for (table, doubts) in self.profile.codes.iter().filter(|_| !has_own) {
            device.code_tables.push(table.clone());
            device.doubts.extend(doubts.iter().cloned());
        }
        for (machine, doubts) in &self.profile.machines {
            let exists = |name: &CompactString| at_place(&device.groups, name).is_some();
            if !exists(&machine.status_item) || !exists(&machine.control_item) {
                continue;
            }
            let status_item = item_name(&device.groups, &machine.status_item);
            if !device.machines.iter().any(|own| own.status_item == status_item) {
                let control_item = item_name(&device.groups, &machine.control_item);
                let state_type = self.state_type(machine, &device.types);
                device.machines.push(StateMachine { status_item, control_item, state_type, ..machine.clone() });
                device.doubts.extend(doubts.iter().cloned());
            }
        }
    }

    /// The enumeration of the device that is the profile's own of the machine's states; without it, the states have a type of
    /// their own.
    fn state_type(&self, machine: &StateMachine, types: &[TypeDef]) -> Option<TypeRef> {
        let name = machine.state_type.as_ref()?;
        let [own, of_device] = [&self.patch().types, types].map(|types| types.iter().find(|own| own.name == *name));
        (own?.shape == of_device?.shape).then(|| name.clone())
    }

    /// Completes the objects of a module.
    pub(crate) fn module(&mut self, module: &mut Module) {
        self.objects(&mut module.groups, &mut module.types, &mut module.process_data.pdos);
    }

    fn objects(&mut self, groups: &mut [Group], types: &mut Vec<TypeDef>, pdos: &mut [Pdo]) {
        let before = types.len();
        let shifts = self.axes(groups);
        let patch = self.patch();
        self.start(types);
        let mut replaced = Replaced::new();
        for row in &patch.rows {
            let Target::Objects(objects) = row.target else { continue };
            let is_of_axis = AXIS.contains(&objects.indices.0) && AXIS.contains(&objects.indices.1);
            for shift in shifts.iter().take(if is_of_axis { shifts.len() } else { 1 }) {
                let first = objects.indices.0.saturating_add(*shift);
                let indices = (first, objects.indices.1.saturating_add(*shift));
                for group in in_range(groups, indices) {
                    let number = u32::from(group.index().unwrap_or_default().saturating_sub(first));
                    self.group(group, row, (objects.subs, number), &mut replaced);
                }
            }
        }
        self.finish(types, before);
        name_conditions(groups, types.get_mut(before..).unwrap_or_default());
        let entries = pdos.iter_mut().flat_map(|pdo| &mut pdo.entries);
        for entry in entries.filter(|entry| entry.kind == PdoEntryKind::Item) {
            match replaced.get(&(entry.index, entry.sub_index)) {
                Some((old, new)) if *old == entry.ty => entry.ty = *new,
                _ => {}
            }
        }
    }

    /// What to add to indices for each axis that there is; 0 is the first.
    fn axes(&self, groups: &[Group]) -> Vec<u16> {
        let mut shifts = vec![0];
        let (Some(step), Some(when)) = (self.profile.head.axis_index, self.profile.when) else { return shifts };
        let exists = |index: u16| groups.binary_search_by_key(&Some(index), Group::index).is_ok();
        let further = (1..AXES).filter_map(|axis| step.checked_mul(axis));
        shifts.extend(further.filter(|shift| when.checked_add(*shift).is_some_and(exists)));
        shifts
    }

    fn group(
        &mut self,
        group: &mut Group,
        row: &PatchRow,
        (subs, number): (Option<(u8, u8)>, u32),
        replaced: &mut Replaced,
    ) {
        let is_head = subs.is_none() && group.object_code().is_some_and(crate::ir::ObjectCode::has_subs);
        if is_head {
            let said = &row.row.value;
            let (doc, cite) = (said.doc.as_deref(), said.cite.as_ref().map(cited));
            describe(&mut group.documentation, self.with_reader(|reader, _| reader.documentation(doc, cite)));
            return;
        }
        let (first, last) = subs.unwrap_or((0, 0));
        for item in &mut group.items {
            let Some(place) = item.object().filter(|(_, sub)| (first..=last).contains(sub)) else { continue };
            if let Some(types) = self.item(item, row, number) {
                replaced.insert(place, types);
            }
        }
    }

    /// Adds to an item what it doesn't say; gives its old and new type where that is another one.
    fn item(&mut self, item: &mut Item, row: &PatchRow, number: u32) -> Option<(Type, Type)> {
        let (old, own) = (item.ty, self.rows.definitions.underlying(item.ty));
        let said = &row.row.value;
        if !is_alike(own, said) || !self.is_on_bus(item, said) {
            return None;
        }
        let named = Named { name: &item.name, key: &row.key, number, end: row.row.end };
        let mut complete = Item { ty: own, ..Item::new(item.bindings.first()?.clone()) };
        let clause = said.cite.as_ref().map(cited).unwrap_or_default();
        let standard = FactOrigin::Standard(standard_and_clause(&self.profile.standard(), &clause).into());
        let admits_meaning = item.origins.admits(Fact::Meaning, !self.is_plain(old), &standard);
        let new = self.with_reader(|reader, rows| {
            rows.fill(reader, &mut complete, named, said, None);
            admits_meaning.then(|| rows.meaning(reader, named, said, own)).flatten()
        });
        if let Some(ty) = new {
            item.ty = ty;
            item.origins.set(Fact::Meaning, Some(standard.clone()));
        }
        for fact in [Fact::Unit, Fact::Behaviour] {
            if !fact.is_stated(&complete) || !item.origins.admits(fact, fact.is_stated(item), &standard) {
                continue;
            }
            match fact {
                Fact::Unit => item.quantity = complete.quantity.take(),
                _ => item.behaviour = complete.behaviour.take(),
            }
            item.origins.set(fact, Some(standard.clone()));
        }
        describe(&mut item.documentation, complete.documentation);
        (item.ty != old).then_some((old, item.ty))
    }

    /// Whether a type says nothing of bits and values.
    fn is_plain(&self, ty: Type) -> bool {
        let mut ty = ty;
        loop {
            let Type::Named(TypeId(id)) = ty else { return true };
            match self.rows.definitions.types.get(id as usize).map(|definition| &definition.shape) {
                // Later types may refer to earlier ones only, so that this ends.
                Some(Shape::Alias(Type::Named(TypeId(next)))) if *next >= id => return false,
                Some(Shape::Alias(other)) => ty = *other,
                _ => return false,
            }
        }
    }

    fn is_on_bus(&mut self, item: &Item, row: &Row) -> bool {
        if row.buses.is_none() {
            return true;
        }
        let wanted = self.with_reader(|reader, rows| rows.buses_of(reader, row));
        item.bindings.iter().any(|binding| match binding {
            Binding::Object { buses, .. } => !wanted.and((*buses).into()).is_empty(),
            _ => false,
        })
    }

    /// New types go behind those of the device.
    fn start(&mut self, types: &mut Vec<TypeDef>) {
        self.rows.definitions.types = std::mem::take(types);
        self.rows.definitions.made.clear();
        self.rows.buses = Buses::ALL;
    }

    /// Gives the types back. Those that are new stand nowhere in the description, and their names must not change those of
    /// the types that it has.
    fn finish(&mut self, types: &mut Vec<TypeDef>, before: usize) {
        *types = std::mem::take(&mut self.rows.definitions.types);
        self.rows.definitions.doubts.clear();
        self.rows.definitions.mentioned.clear();
        self.rows.references.clear();
        let before = before.min(types.len());
        let (own, new) = types.split_at_mut(before);
        let is_value = |definition: &&TypeDef| {
            matches!(definition.shape, Shape::Enumeration { .. } | Shape::BitField { .. } | Shape::Alias(_))
        };
        let taken: Vec<String> = own.iter().filter(is_value).map(|definition| letters(&definition.name)).collect();
        for definition in new {
            definition.origin = Origin::default();
            if taken.contains(&letters(&definition.name)) {
                let profile = self.profile.head.name.as_deref().unwrap_or("profile");
                definition.name = format!("{profile} {}", definition.name).into();
            }
        }
    }

    /// Completes the data of submodules that follow the profile.
    pub(crate) fn submodules<'s>(
        &mut self,
        submodules: impl Iterator<Item = &'s mut Submodule>,
        types: &mut Vec<TypeDef>,
    ) {
        let before = types.len();
        self.start(types);
        submodules.for_each(|submodule| self.submodule(submodule));
        self.finish(types, before);
    }

    /// Its fields by their names, and where it is one of the profile's telegrams also by their places.
    fn submodule(&mut self, submodule: &mut Submodule) {
        let patch = self.patch();
        let mut telegrams = Vec::new();
        for image in patch.images.iter().filter(|image| is_called(&submodule.name, image.value.name.as_deref())) {
            let direction = image.value.direction.as_ref();
            let direction = self.with_reader(|reader, _| process::direction(reader, direction));
            telegrams.push((direction, &image.value));
        }
        let data = [(Direction::Receive, &mut submodule.output), (Direction::Transmit, &mut submodule.input)];
        for (direction, data) in data {
            let telegram = telegrams.iter().find(|(own, _)| *own == Some(direction)).map(|(_, image)| *image);
            if let Some(data) = data {
                self.fields(data, telegram);
            }
        }
    }

    fn fields(&mut self, data: &mut IoData, telegram: Option<&ImageTable>) {
        let patch = self.patch();
        for field in &mut data.image.fields {
            let by_place = telegram.and_then(|telegram| {
                let at = |own: Option<u32>| own.map(|own| own.saturating_mul(8)) == Some(field.bit_offset);
                telegram.fields.iter().find(|(_, own)| at(own.value.at)).map(|(name, _)| letters(&name.value))
            });
            let by_name = letters(&field.name);
            let signal = |name: &str| patch.rows.iter().find(|row| is_signal(row) && letters(&row.key.value) == name);
            let row = signal(&by_name).or_else(|| by_place.as_deref().and_then(signal));
            if let Some(row) = row {
                self.field(field, row);
            }
        }
    }

    fn field(&mut self, field: &mut PdoEntry, row: &PatchRow) {
        let own = self.rows.definitions.underlying(field.ty);
        if !is_alike(own, &row.row.value) || !self.is_plain(field.ty) {
            return;
        }
        let named = Named { name: &field.name, key: &row.key, number: 0, end: row.row.end };
        let ty = self.with_reader(|reader, rows| rows.meaning(reader, named, &row.row.value, own));
        field.ty = ty.unwrap_or(field.ty);
    }
}

/// Adds the words of a profile where a description has none; a citation that it has stays.
fn describe(documentation: &mut Option<Box<Documentation>>, of_profile: Option<Box<Documentation>>) {
    match (documentation, of_profile) {
        (documentation @ None, of_profile) => *documentation = of_profile,
        (Some(documentation), Some(of_profile)) if documentation.text.is_empty() => {
            (documentation.text, documentation.text_from) = (of_profile.text, of_profile.text_from);
        }
        _ => {}
    }
}

/// Whether a table of codes is a profile's.
fn is_from_profile(table: &CodeTable) -> bool {
    table.documentation.as_deref().is_some_and(|documentation| documentation.text_from.is_some())
}

fn is_signal(row: &PatchRow) -> bool {
    matches!(row.target, Target::Name)
}

/// Whether values of a type are as long as those that a row is about, and of its kind. Numbers with a sign aren't bits,
/// whatever their object is elsewhere; named values may well have another sign.
pub(super) fn is_alike(ty: Type, row: &Row) -> bool {
    let Some(wanted) = row.ty.as_ref().and_then(|ty| types::named(&ty.value)).map(|named| named.ty) else {
        return true;
    };
    if row.bits.is_some() && ty.is_signed() {
        return false;
    }
    let is_integer = |ty: Type| matches!(ty, Type::Integer(_) | Type::Unsigned(_));
    match is_integer(ty) && is_integer(wanted) {
        true => ty.bits() == wanted.bits(),
        false => std::mem::discriminant(&ty) == std::mem::discriminant(&wanted),
    }
}

/// Letters and digits alone, for names that differ in nothing else are one name in Rust.
fn letters(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Whether a submodule is the telegram of this name: its words, and no digit behind them.
fn is_called(name: &str, telegram: Option<&str>) -> bool {
    let Some(telegram) = telegram else { return false };
    let (name, telegram) = (name.to_lowercase(), telegram.to_lowercase());
    let mut places = name.match_indices(telegram.as_str());
    places.any(|(at, _)| !name[at + telegram.len()..].starts_with(|letter: char| letter.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn telegrams_are_told_apart_by_their_number() {
        assert!(is_called("Standard telegram 1, PZD-2/2", Some("standard telegram 1")));
        assert!(!is_called("Standard telegram 102", Some("standard telegram 1")));
        assert!(!is_called("Drive", Some("standard telegram 1")) && !is_called("x", None));
        assert_eq!(letters("ZSW 1_ä"), "zsw1ä");
    }
}
