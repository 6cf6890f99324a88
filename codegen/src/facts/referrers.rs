//! References to items from other elements of a device.

use std::collections::HashMap;

use crate::ir::{Condition, Device, Item, ItemId, ItemRef, MessageId, ProcedureId, Shape, Step, TypeDef, TypeId};

/// An element that refers to an item. An element without an id is identified by its position in the device's list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Referrer {
    /// A PDO that maps the item.
    Pdo(usize),
    /// A state machine with the item as status item or control item.
    Machine(usize),
    /// A procedure that writes the item, reads it or waits for it.
    Procedure(ProcedureId),
    /// A message that the device accepts only for some values of the item.
    Message(MessageId),
    /// A type whose bits or values depend on the item.
    Type(TypeId),
    /// An item that can be written only for some values of this item.
    WritableWhen(ItemId),
    /// An item that this item replaces.
    Replaced(ItemId),
    /// An item with the same value or quantity, with the lower half of the value, or with the elements that this item
    /// counts.
    Related(ItemId),
}

/// Elements that refer to each item.
#[derive(Debug, Default)]
pub struct Referrers(HashMap<ItemId, Vec<Referrer>>);

impl Referrers {
    /// Collects the resolved references of a device.
    pub fn new(device: &Device) -> Self {
        let mut referrers = Referrers::default();
        for (at, pdo) in device.process_data.pdos.iter().enumerate() {
            pdo.entries.iter().for_each(|entry| referrers.add(entry.item, Referrer::Pdo(at)));
        }
        for (at, machine) in device.machines.iter().enumerate() {
            referrers.add_all([&machine.status_item, &machine.control_item], Referrer::Machine(at));
        }
        for (id, procedure) in (0..).map(ProcedureId).zip(&device.procedures) {
            let items = procedure.steps.iter().filter_map(Step::item);
            referrers.add_all(items, Referrer::Procedure(id));
        }
        for (id, message) in (0..).map(MessageId).zip(&device.messages) {
            referrers.add_all(items_of(&message.accepted_when), Referrer::Message(id));
        }
        for (id, definition) in (0..).map(TypeId).zip(&device.types) {
            referrers.of_type(id, definition);
        }
        for (position, group) in (0..).zip(&device.groups) {
            group.items_at(position).for_each(|(id, item)| referrers.of_item(id, item));
        }
        referrers
    }

    /// Returns the elements that refer to an item: PDOs, state machines, procedures, messages, types and other items.
    pub fn of(&self, item: ItemId) -> &[Referrer] {
        self.0.get(&item).map_or(&[], Vec::as_slice)
    }

    fn of_type(&mut self, id: TypeId, definition: &TypeDef) {
        let conditions: Vec<&Condition> = match &definition.shape {
            Shape::BitField { fields, .. } => fields.iter().filter_map(|field| field.when.as_deref()).collect(),
            Shape::Enumeration { values, .. } => values.iter().filter_map(|value| value.when.as_deref()).collect(),
            _ => return,
        };
        self.add_all(items_of(conditions), Referrer::Type(id));
    }

    fn of_item(&mut self, id: ItemId, item: &Item) {
        if let Some(behavior) = &item.behavior {
            self.add_all(items_of(&behavior.write_when), Referrer::WritableWhen(id));
        }
        let availability = item.availability.as_ref();
        let other = availability.and_then(|availability| availability.replaced_by.as_ref()?.id?.item());
        self.add(other, Referrer::Replaced(id));
        self.add_all(item.related.iter().flat_map(|related| related.all()), Referrer::Related(id));
    }

    fn add_all<'d>(&mut self, items: impl IntoIterator<Item = &'d ItemRef>, referrer: Referrer) {
        items.into_iter().for_each(|item| self.add(item.id, referrer));
    }

    /// Adds a referrer to an item, unless the last added referrer of the item is the same element.
    fn add(&mut self, item: Option<ItemId>, referrer: Referrer) {
        let Some(item) = item else { return };
        let referrers = self.0.entry(item).or_default();
        if referrers.last() != Some(&referrer) {
            referrers.push(referrer);
        }
    }
}

fn items_of<'d>(conditions: impl IntoIterator<Item = &'d Condition>) -> impl Iterator<Item = &'d ItemRef> {
    conditions.into_iter().map(|condition| &condition.item)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, Direction, Group, ObjectCode, Pdo, PdoEntry, RelatedItems};

    #[test]
    fn each_referrer_is_listed_once() {
        let id = ItemId { group: 0, item: 0 };
        let reference = || ItemRef { id: Some(id), ..ItemRef::from("Speed") };
        let mut speed = Group::object(0x2000, ObjectCode::Var);
        speed.items.push(Item::new(Binding::canopen(0x2000, 0)));
        let mut limit = Group::object(0x2001, ObjectCode::Var);
        limit.items.push(Item::new(Binding::canopen(0x2001, 0)));
        let related = RelatedItems { same_quantity: Some(reference()), ..RelatedItems::default() };
        limit.items[0].related = Some(Box::new(related));
        let mut pdo = Pdo::new(Direction::Transmit, 0x1A00);
        let entry = PdoEntry { item: Some(id), ..PdoEntry::new(0x2000, 0, 8) };
        pdo.entries = vec![entry.clone(), entry];
        let mut device = Device { groups: vec![speed, limit], ..Device::default() };
        device.process_data.pdos.push(pdo);
        let referrers = Referrers::new(&device);
        let expected = [Referrer::Pdo(0), Referrer::Related(ItemId { group: 1, item: 0 })];
        assert_eq!(referrers.of(id), expected);
        assert_eq!(referrers.of(ItemId { group: 1, item: 0 }), []);
    }
}
