//! References to items from other elements of a device.

use crate::collections::HashMap;
use crate::ir::owner::Owner;
use crate::ir::{
    BitFieldEntry, BitMeaning, Condition, Device, EnumValue, Item, ItemId, ItemRef, MessageId, ProcedureId, Shape,
    Step, Type,
};

/// An element that refers to an item. An element without an ID is identified by its position in the device's list.
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
    /// An item with a bit or value whose meaning depends on this item.
    Meaning(ItemId, Part),
    /// An item that can be written only for some values of this item.
    WritableWhen(ItemId),
    /// An item that this item replaces.
    Replaced(ItemId),
    /// An item that names this item as related: as the same value, as the same quantity, as the high word of its value, or as the
    /// number of its valid elements.
    Related(ItemId),
}

/// A part of an item, by its position in the item's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// A field of a bit field.
    Bit(usize),
    /// A named value.
    Value(usize),
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
        let types = Owner::of_types(&device.types);
        for (position, group) in (0..).zip(&device.groups) {
            for (id, item) in group.items_at(position) {
                referrers.of_item(id, item);
                for (part, condition) in conditions(types, item.ty) {
                    referrers.add(condition.item.id, Referrer::Meaning(id, part));
                }
            }
        }
        referrers
    }

    /// Returns the elements that refer to an item: PDOs, state machines, procedures, messages and other items.
    pub fn of(&self, item: ItemId) -> &[Referrer] {
        self.0.get(&item).map_or(&[], Vec::as_slice)
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

/// Returns the conditions on which the meanings of a type's bits and values depend. If a field of a bit field has named
/// values, their conditions count as conditions of this field.
pub fn conditions<'d>(types: Owner<'d>, ty: Type) -> Vec<(Part, &'d Condition)> {
    let of_values = |values: &'d [EnumValue]| {
        values.iter().enumerate().filter_map(|(at, value)| Some((at, value.when.as_deref()?)))
    };
    let of_field = |(at, field): (usize, &'d BitFieldEntry)| {
        let enumeration = match field.meaning {
            BitMeaning::Enumeration(id) => types.enumeration(Type::Named(id)),
            _ => None,
        };
        let of_values =
            enumeration.into_iter().flat_map(|(values, _)| of_values(values)).map(|(_, condition)| condition);
        field.when.as_deref().into_iter().chain(of_values).map(move |condition| (Part::Bit(at), condition))
    };
    match types.definition(ty).map(|definition| &definition.shape) {
        Some(Shape::BitField { fields, .. }) => fields.iter().enumerate().flat_map(of_field).collect(),
        Some(Shape::Enumeration { values, .. }) => {
            of_values(values).map(|(at, condition)| (Part::Value(at), condition)).collect()
        }
        _ => Vec::new(),
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
        let related = RelatedItems { same_quantity: Some(Box::new(reference())), ..RelatedItems::default() };
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
