//! Adds the facts of a profile that a description lacks.
//!
//! A profile does not change facts that the description states. A profile adds nothing to an item whose type does not match the
//! type in the profile, or to a missing object. Such differences are not reported.

use std::sync::Arc;

use super::profile::{Described, Profile, Signal, Telegram};
use crate::collections::HashMap;
use crate::ir::object_names::{in_range, item_at, item_name, name_conditions};
use crate::ir::owner::Owner;
use crate::ir::stated::is_of_profile;
use crate::ir::{
    Binding, BitFieldEntry, BitMeaning, CodeTable, CompactString, Condition, Device, Direction, Documentation, Fact,
    FactOrigin, FactOrigins, Group, IoData, Item, Module, ObjectCode, Pdo, PdoEntry, PdoEntryKind, Shape, StateMachine,
    Submodule, Type, TypeDef, TypeId, TypeRef,
};
use crate::source::{FileId, Origin};

/// Indices of the objects of the first axis. Further axes have the same objects at other indices.
const AXIS: std::ops::RangeInclusive<u16> = 0x6000..=0x67FF;

/// Maximum number of axes (CiA 402: 0x6000 to 0x9FFF).
const AXES: u16 = 8;

/// State while a profile is applied to devices, modules and submodules.
pub(crate) struct Completion<'p> {
    profile: &'p Profile,
    /// Types of the device, module or catalog, followed by types that the profile adds.
    types: Vec<TypeDef>,
    /// Types that were added, by the type in the profile and the underlying integer.
    added: HashMap<(TypeId, Type), TypeId>,
    /// Fact origins of the last item that each of the profile's objects completed. Further items of the same object mostly have the
    /// same origins and share this list.
    origins: Vec<FactOrigins>,
}

/// The old and the new type of each changed item, by index and sub-index.
type Replaced = HashMap<(u16, u8), (Type, Type)>;

impl<'p> Completion<'p> {
    pub(crate) fn new(profile: &'p Profile) -> Self {
        Completion { profile, types: Vec::new(), added: HashMap::default(), origins: Vec::new() }
    }

    /// Completes the objects, code tables and state machines of a device. `is_table` returns whether a file is a register table
    /// or overlay.
    pub(crate) fn device(&mut self, device: &mut Device, is_table: &dyn Fn(FileId) -> bool) {
        self.objects(&mut device.groups, &mut device.types, &mut device.process_data.pdos);
        // The codes of the profile are left out if the manual lists codes, because the two lists can contradict each other. The
        // diagnosis texts of an ESI have other codes, which do not conflict with those of the profile.
        let of_manual =
            |table: &CodeTable| is_table(table.origin.span.file) && !is_of_profile(table.stated_by.as_deref());
        let has_codes = device.code_tables.iter().any(of_manual);
        for table in self.profile.codes.iter().filter(|_| !has_codes) {
            device.code_tables.push(CodeTable { stated_by: self.standard(&table.documentation), ..table.clone() });
        }
        for machine in &self.profile.machines {
            let exists = |name: &CompactString| item_at(&device.groups, name).is_some();
            if !exists(&machine.status_item) || !exists(&machine.control_item) {
                continue;
            }
            let status_item = item_name(&device.groups, &machine.status_item);
            if !device.machines.iter().any(|other| other.status_item == status_item) {
                let control_item = item_name(&device.groups, &machine.control_item);
                let state_type = self.state_type(machine, &device.types);
                let stated_by = self.standard(&machine.documentation);
                let completed = StateMachine { status_item, control_item, state_type, stated_by, ..machine.clone() };
                device.machines.push(completed);
            }
        }
    }

    /// Returns a reference to the device's enumeration of states, if this enumeration equals that of the profile. Otherwise, a
    /// separate type is generated for the states.
    fn state_type(&self, machine: &StateMachine, types: &[TypeDef]) -> Option<TypeRef> {
        let name = machine.state_type.as_ref()?;
        let named = |types: &'_ [TypeDef]| {
            types.iter().find(|definition| definition.name == *name).map(|definition| definition.shape.clone())
        };
        (named(&self.profile.types)? == named(types)?).then(|| name.clone())
    }

    /// Completes the objects of a module.
    pub(crate) fn module(&mut self, module: &mut Module) {
        self.objects(&mut module.groups, &mut module.types, &mut module.process_data.pdos);
    }

    fn objects(&mut self, groups: &mut [Group], types: &mut Vec<TypeDef>, pdos: &mut [Pdo]) {
        let before = types.len();
        let shifts = self.axes(groups);
        self.start(types);
        let (mut replaced, mut origins) = (Replaced::default(), std::mem::take(&mut self.origins));
        origins.resize(self.profile.objects.len(), FactOrigins::default());
        for (described, origins) in self.profile.objects.iter().zip(&mut origins) {
            let (first, last) = described.indices;
            let is_of_axis = AXIS.contains(&first) && AXIS.contains(&last);
            for shift in shifts.iter().take(if is_of_axis { shifts.len() } else { 1 }) {
                let (first, last) = (first.saturating_add(*shift), last.saturating_add(*shift));
                for group in in_range(groups, first, last) {
                    self.group(group, described, origins, &mut replaced);
                }
            }
        }
        self.origins = origins;
        self.finish(types, before);
        let value_names = |when: &Condition| self.profile.value_names(when);
        name_conditions(groups, types.get_mut(before..).unwrap_or_default(), &value_names);
        let entries = pdos.iter_mut().flat_map(|pdo| &mut pdo.entries);
        for entry in entries.filter(|entry| entry.kind == PdoEntryKind::Item) {
            match replaced.get(&(entry.index, entry.sub_index)) {
                Some((old, new)) if *old == entry.ty => entry.ty = *new,
                _ => {}
            }
        }
    }

    /// Returns the index offset of each axis of the device. The offset of the first axis is 0.
    fn axes(&self, groups: &[Group]) -> Vec<u16> {
        let mut shifts = vec![0];
        let (Some(step), Some(when)) = (self.profile.axis_index, self.profile.when) else { return shifts };
        let exists = |index: u16| groups.binary_search_by_key(&Some(index), Group::index).is_ok();
        let further = (1..AXES).filter_map(|axis| step.checked_mul(axis));
        shifts.extend(further.filter(|shift| when.checked_add(*shift).is_some_and(exists)));
        shifts
    }

    fn group(&mut self, group: &mut Group, described: &Described, origins: &mut FactOrigins, replaced: &mut Replaced) {
        if described.subs.is_none() && group.object_code().is_some_and(ObjectCode::has_subs) {
            if describe(&mut group.documentation, described.documentation.as_ref()) {
                group.origins.set(Fact::Description, Some(FactOrigin::Standard(described.standard.clone())));
            }
            return;
        }
        let (first, last) = described.subs.unwrap_or((0, 0));
        for item in &mut group.items {
            let Some(object) = item.object().filter(|(_, sub)| (first..=last).contains(sub)) else { continue };
            if let Some(types) = self.item(item, described) {
                replaced.insert(object, types);
            }
            item.origins.share(origins);
        }
    }

    /// Adds missing facts to an item. If the type of the item has changed, returns its old type and its new type.
    fn item(&mut self, item: &mut Item, described: &Described) -> Option<(Type, Type)> {
        let (old, base) = (item.ty, self.underlying(item.ty));
        if !self.profile.is_alike(base, described.ty, described.meaning) || !is_on_bus(item, described) {
            return None;
        }
        let standard = FactOrigin::Standard(described.standard.clone());
        let admits_meaning = item.origins.admits(Fact::Meaning, !self.is_plain(old), &standard);
        let meaning = described.meaning.filter(|_| admits_meaning);
        if let Some(id) = meaning.and_then(|id| self.meaning(id, base)) {
            item.ty = Type::Named(id);
            item.origins.set(Fact::Meaning, Some(standard.clone()));
        }
        let facts = [(Fact::Unit, described.quantity.is_some()), (Fact::Behavior, described.behavior.is_some())];
        for (fact, _) in facts.into_iter().filter(|(_, is_described)| *is_described) {
            if !item.origins.admits(fact, fact.is_stated(item), &standard) {
                continue;
            }
            match fact {
                Fact::Unit => item.quantity.clone_from(&described.quantity),
                _ => item.behavior.clone_from(&described.behavior),
            }
            item.origins.set(fact, Some(standard.clone()));
        }
        if describe(&mut item.documentation, described.documentation.as_ref()) {
            item.origins.set(Fact::Description, Some(standard));
        }
        (item.ty != old).then_some((old, item.ty))
    }

    /// Adds a type of the profile with the underlying integer `base`, and returns its id. If the profile's type has another
    /// underlying integer, the name of the type gets a suffix.
    fn meaning(&mut self, id: TypeId, base: Type) -> Option<TypeId> {
        if let Some(added) = self.added.get(&(id, base)) {
            return Some(*added);
        }
        let mut definition = self.profile.definition(id)?.clone();
        let base_of_profile = match &mut definition.shape {
            Shape::BitField { base, fields } => {
                // The types of the bit field's entries are added first, in the order of the profile.
                let mut of_fields: Vec<_> = fields.iter_mut().filter_map(named_values).collect();
                of_fields.sort_by_key(|(id, _)| **id);
                for (id, base) in of_fields {
                    *id = self.meaning(*id, base)?;
                }
                base
            }
            Shape::Enumeration { base, .. } => base,
            _ => return None,
        };
        if std::mem::replace(base_of_profile, base) != base {
            definition.name.push_str(&base.integer_suffix());
        }
        definition.bits = base.bits();
        let added = TypeId(self.types.len() as u32);
        self.types.push(definition);
        self.added.insert((id, base), added);
        Some(added)
    }

    /// Returns the basic type under bit fields, enumerations, aliases and scaled types.
    fn underlying(&self, ty: Type) -> Type {
        Owner::of_types(&self.types).basic(ty)
    }

    /// Returns whether a type is basic, or an alias of a basic type.
    fn is_plain(&self, ty: Type) -> bool {
        let mut ty = ty;
        loop {
            let Type::Named(TypeId(id)) = ty else { return true };
            match self.types.get(id as usize).map(|definition| &definition.shape) {
                // The loop ends, because it only follows references to earlier types.
                Some(Shape::Alias(Type::Named(TypeId(next)))) if *next >= id => return false,
                Some(Shape::Alias(other)) => ty = *other,
                _ => return false,
            }
        }
    }

    /// Returns the origin of a definition: the clause that its description cites, or the standard as a whole.
    fn standard(&self, documentation: &Option<Arc<Documentation>>) -> Option<Box<FactOrigin>> {
        let cited = documentation.as_deref().and_then(|documentation| documentation.text_from.clone());
        Some(cited.unwrap_or_else(|| Box::new(FactOrigin::Standard(self.profile.name.clone()))))
    }

    /// Moves `types` into this struct, so that types can be added.
    fn start(&mut self, types: &mut Vec<TypeDef>) {
        self.types = std::mem::take(types);
        self.added.clear();
    }

    /// Moves the types from this struct back to `types`. The types after the first `before` types are new. Renames a new type if
    /// its name has the same [`letters`] as that of an older type.
    fn finish(&mut self, types: &mut Vec<TypeDef>, before: usize) {
        *types = std::mem::take(&mut self.types);
        types.shrink_to_fit();
        let before = before.min(types.len());
        let (of_device, new) = types.split_at_mut(before);
        let is_value = |definition: &&TypeDef| {
            matches!(definition.shape, Shape::Enumeration { .. } | Shape::BitField { .. } | Shape::Alias(_))
        };
        let names: Vec<String> =
            of_device.iter().filter(is_value).map(|definition| letters(&definition.name)).collect();
        for definition in new {
            definition.origin = Origin::default();
            definition.stated_by = self.standard(&definition.documentation);
            if names.contains(&letters(&definition.name)) {
                definition.name = format!("{} {}", self.profile.name, definition.name).into();
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

    /// Completes the fields of a submodule, which are found by their names. In a telegram of the profile, fields are also found
    /// by their offsets.
    fn submodule(&mut self, submodule: &mut Submodule) {
        let data = [(Direction::Receive, &mut submodule.output), (Direction::Transmit, &mut submodule.input)];
        for (direction, data) in data {
            let is_telegram = |telegram: &&Telegram| {
                telegram.direction == direction && is_called(&submodule.name, telegram.name.as_str())
            };
            let telegram = self.profile.telegrams.iter().find(is_telegram);
            if let Some(data) = data {
                self.fields(data, telegram);
            }
        }
    }

    fn fields(&mut self, data: &mut IoData, telegram: Option<&Telegram>) {
        for field in &mut data.image.fields {
            let signals = telegram.iter().flat_map(|telegram| &telegram.signals);
            let by_offset =
                signals.filter(|(byte, _)| byte.saturating_mul(8) == field.bit_offset).map(|(_, name)| name);
            let mut names = std::iter::once(&field.name).chain(by_offset.take(1)).map(|name| letters(name));
            let signals = &self.profile.signals;
            let signal = names.find_map(|name| signals.iter().find(|signal| letters(&signal.name) == name));
            if let Some(signal) = signal {
                self.field(field, signal);
            }
        }
    }

    fn field(&mut self, field: &mut PdoEntry, signal: &Signal) {
        let base = self.underlying(field.ty);
        if self.profile.is_alike(base, signal.ty, signal.meaning) && self.is_plain(field.ty) {
            field.ty = signal.meaning.and_then(|id| self.meaning(id, base)).map_or(field.ty, Type::Named);
        }
    }
}

/// Returns the enumeration of a bit-field entry, and an unsigned type with the length of the entry. Returns `None` if the entry has
/// no enumeration.
fn named_values(field: &mut BitFieldEntry) -> Option<(&mut TypeId, Type)> {
    match &mut field.meaning {
        BitMeaning::Enumeration(id) => Some((id, Type::Unsigned(field.bits))),
        _ => None,
    }
}

fn is_on_bus(item: &Item, described: &Described) -> bool {
    let Some(only) = described.buses else { return true };
    item.bindings.iter().any(|binding| match binding {
        Binding::Object { buses, .. } => (buses.canopen && only.canopen) || (buses.coe && only.coe),
        _ => false,
    })
}

/// Adds the description of a profile if the element has no description, and returns whether it was added. An existing citation
/// does not change.
fn describe(documentation: &mut Option<Arc<Documentation>>, of_profile: Option<&Arc<Documentation>>) -> bool {
    let Some(of_profile) = of_profile else { return false };
    match documentation {
        None => *documentation = Some(Arc::clone(of_profile)),
        Some(documentation) if documentation.text.is_empty() => {
            let documentation = Arc::make_mut(documentation);
            documentation.text.clone_from(&of_profile.text);
            documentation.text_from.clone_from(&of_profile.text_from);
        }
        Some(_) => return false,
    }
    true
}

/// Returns the letters and digits of a name in lower case. Names that differ only in case or in other characters can have the same
/// Rust name.
fn letters(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Returns whether the name of a submodule contains the name of a telegram without a digit directly after it.
fn is_called(name: &str, telegram: &str) -> bool {
    let (name, telegram) = (name.to_lowercase(), telegram.to_lowercase());
    let mut matches = name.match_indices(telegram.as_str());
    matches.any(|(at, _)| !name[at + telegram.len()..].starts_with(|letter: char| letter.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn telegrams_are_distinguished_by_their_number() {
        assert!(is_called("Standard telegram 1, PZD-2/2", "standard telegram 1"));
        assert!(!is_called("Standard telegram 102", "standard telegram 1"));
        assert!(!is_called("Drive", "standard telegram 1"));
        assert_eq!(letters("ZSW 1_ä"), "zsw1ä");
    }
}
