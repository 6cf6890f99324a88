//! Resolves the names in references to ids.

use std::collections::HashMap;

use super::mentions::{for_each, of_items_and_types, window_sides, Mention};
use crate::ir::owner::{Index, Owner};
use crate::ir::{
    CompactString, Device, ElementId, Entries, Group, ItemId, MessageId, Module, Pdo, PdoEntryKind, ProcedureId,
    Reference, Shape, Step, Transition, TypeDef, TypeId,
};

/// Resolves the references of a device. Returns whether the device contains a reference to an item.
pub(super) fn device(device: &mut Device) -> bool {
    mapped_items(&mut device.process_data.pdos, &device.groups, 0);
    messages(device);
    procedures(device);
    state_types(device);
    let mut names = HashMap::new();
    for_each(device, &mut |mention| collect(&mut names, &mention));
    if names.is_empty() {
        return false;
    }
    find(&mut names, &[&device.groups], &device.types);
    let messages = Positions::new(device.messages.iter().map(|message| &message.name));
    for_each(device, &mut |mention| resolve(mention, &names, &messages));
    true
}

/// Resolves the references of a module. In the ids of a module, the groups are numbered consecutively: first the fixed objects,
/// then the other groups.
pub(super) fn module(module: &mut Module) {
    let mut names = HashMap::new();
    let Module { fixed_objects, groups, types, process_data, .. } = module;
    mapped_items(&mut process_data.pdos, groups, fixed_objects.len() as u32);
    of_items_and_types(fixed_objects.iter_mut().chain(&mut *groups), types, &mut |mention| {
        collect(&mut names, &mention);
    });
    if !names.is_empty() {
        find(&mut names, &[fixed_objects, groups], types);
        let messages = Positions::new([].into_iter());
        let groups = fixed_objects.iter_mut().chain(groups);
        of_items_and_types(groups, types, &mut |mention| resolve(mention, &names, &messages));
    }
}

/// The position of the first element with each name.
struct Positions(HashMap<CompactString, u32>);

impl Positions {
    fn new<'n>(names: impl Iterator<Item = &'n CompactString>) -> Self {
        Positions::of((0..).zip(names))
    }

    fn of<'n>(named: impl Iterator<Item = (u32, &'n CompactString)>) -> Self {
        let mut positions = HashMap::new();
        for (position, name) in named {
            positions.entry(name.clone()).or_insert(position);
        }
        Positions(positions)
    }

    fn resolve<Id>(&self, reference: &mut Reference<Id>, id: fn(u32) -> Id) {
        reference.id = self.find(&reference.name).map(id);
    }

    fn find(&self, name: &CompactString) -> Option<u32> {
        self.0.get(name).copied()
    }
}

/// Sets the id of a reference.
fn resolve(mention: Mention<'_>, items: &Found, messages: &Positions) {
    let item = items.get(mention.name()).copied().flatten();
    match mention {
        Mention::Item(reference) => reference.id = item,
        Mention::Element(reference) => {
            let message = || messages.find(&reference.name).map(|at| ElementId::Message(MessageId(at)));
            reference.id = item.map(ElementId::Item).or_else(message);
        }
    }
}

fn messages(device: &mut Device) {
    if device.messages.is_empty() {
        return;
    }
    let positions = Positions::new(device.messages.iter().map(|message| &message.name));
    let availabilities = device.messages.iter_mut().filter_map(|message| message.availability.as_mut());
    for other in availabilities.filter_map(|availability| availability.replaced_by.as_mut()) {
        positions.resolve(other, |at| ElementId::Message(MessageId(at)));
    }
    let of_messages = device.messages.iter_mut().flat_map(|message| [&mut message.after, &mut message.error]);
    let of_spaces =
        device.parameter_spaces.iter_mut().flat_map(|space| [&mut space.read, &mut space.write, &mut space.store]);
    of_messages.chain(of_spaces).flatten().for_each(|reference| positions.resolve(reference, MessageId));
    for machine in &mut device.machines {
        // A shared list is only changed if necessary, because a change copies the list.
        let is_message = |transition: &Transition| {
            transition.command.as_ref().is_some_and(|command| positions.find(command).is_some())
        };
        if machine.transitions.iter().any(is_message) {
            let commands = machine.transitions.to_mut().iter_mut().filter_map(|transition| transition.command.as_mut());
            commands.for_each(|command| positions.resolve(command, MessageId));
        }
    }
    for step in device.procedures.iter_mut().flat_map(|procedure| &mut procedure.steps) {
        if let Step::Send(message) = step {
            positions.resolve(message, MessageId);
        }
    }
}

fn procedures(device: &mut Device) {
    if device.procedures.is_empty() {
        return;
    }
    let positions = Positions::new(device.procedures.iter().map(|procedure| &procedure.name));
    let items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    for side in items.flat_map(|item| &mut item.bindings).flat_map(window_sides) {
        side.procedure.iter_mut().for_each(|reference| positions.resolve(reference, ProcedureId));
    }
}

fn state_types(device: &mut Device) {
    let mut types = device.machines.iter_mut().filter_map(|machine| machine.state_type.as_mut()).peekable();
    if types.peek().is_some() {
        let is_enumeration = |definition: &TypeDef| matches!(definition.shape, Shape::Enumeration { .. });
        let enumerations = (0..).zip(&device.types).filter(|(_, definition)| is_enumeration(definition));
        let positions = Positions::of(enumerations.map(|(position, definition)| (position, &definition.name)));
        types.for_each(|reference| positions.resolve(reference, TypeId));
    }
}

/// Sets the ids of the items that PDO entries map. `first` is the number of groups that precede `groups`.
fn mapped_items(pdos: &mut [Pdo], groups: &[Group], first: u32) {
    let items = Entries::new(groups);
    for entry in pdos.iter_mut().flat_map(|pdo| &mut pdo.entries).filter(|entry| entry.kind == PdoEntryKind::Item) {
        let id = items.find(entry.index, entry.sub_index);
        entry.item = id.map(|id| ItemId { group: id.group + first, ..id });
    }
}

/// Items by name; `None` for a name without an item.
type Found = HashMap<CompactString, Option<ItemId>>;

fn collect(names: &mut Found, mention: &Mention<'_>) {
    let name = mention.name();
    if !name.is_empty() && !names.contains_key(name) {
        names.insert(name.clone(), None);
    }
}

fn find(names: &mut Found, groups: &[&[Group]], types: &[TypeDef]) {
    let items = Index::new(Owner { types, groups });
    for (name, id) in names {
        *id = items.find(name);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{mentions::target, removal};
    use super::*;
    use crate::ir::{Binding, GroupKind, Item, ObjectCode, RelatedItems, Value};

    fn item(name: &str, index: u16) -> Item {
        let mut item = Item::new(Binding::canopen(index, 0));
        item.name = name.into();
        item
    }

    fn group(name: &str, kind: GroupKind, items: Vec<Item>) -> Group {
        Group { name: name.into(), kind, items, ..Group::object(0, ObjectCode::Var) }
    }

    fn id(group: u32, item: u32) -> Option<ItemId> {
        Some(ItemId { group, item })
    }

    #[test]
    fn names_paths_and_addresses_become_ids() {
        let object = GroupKind::Object { index: 0x2005, code: ObjectCode::Var, category: None };
        let chapter = group("Axis", GroupKind::Chapter, vec![item("Speed", 0x2000), item("Mode", 0x2001)]);
        let mut device =
            Device { groups: vec![chapter, group("Limit", object, vec![item("", 0x2005)])], ..Device::default() };
        let related = RelatedItems {
            same_as: Some("Axis/Mode".into()),
            same_quantity: Some("Nothing".into()),
            ..RelatedItems::default()
        };
        device.groups[0].items[0].related = Some(Box::new(related));
        let steps = ["Speed", "0x2001", "Limit"].map(|name| Step::Write(name.into(), Value::Int(1)));
        let procedure = crate::ir::Procedure {
            name: "Start".into(),
            names: Default::default(),
            arguments: Vec::new(),
            steps: steps.into(),
            step_spans: Vec::new(),
            documentation: None,
            origin: Default::default(),
        };
        device.procedures.push(procedure);
        assert!(super::device(&mut device));
        let ids: Vec<_> = device.procedures[0].steps.iter_mut().filter_map(|step| target(step)?.id).collect();
        assert_eq!(ids.into_iter().map(Some).collect::<Vec<_>>(), [id(0, 0), id(0, 1), id(1, 0)]);
        let related = device.groups[0].items[0].related.as_deref().expect("relations");
        assert_eq!(related.same_as.as_ref().and_then(|reference| reference.id), id(0, 1));
        assert_eq!(related.same_quantity.as_ref().and_then(|reference| reference.id), None);
        // After the removal of a group, the ids refer to the same items as before.
        removal::of_device(&mut device, |group| group.name != "Axis");
        let ids: Vec<_> =
            device.procedures[0].steps.iter_mut().filter_map(target).map(|reference| reference.id).collect();
        assert_eq!(ids, [None, None, id(0, 0)]);
    }
}
