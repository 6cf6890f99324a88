//! Adds mapped objects that the dictionary of an EtherCAT slave or module does not describe.
//!
//! A device has every object that its PDOs map. If the dictionary does not describe a mapped object, the compiler adds an
//! object with the name, type and length of the PDO entry. The line number of an added object is 0, because the file
//! contains only the PDO entry.

use std::collections::BTreeMap;

use crate::ir::{
    Access, Binding, Device, Direction, Fact, FactOrigins, Group, Item, Module, ObjectCode, Pdo, PdoEntry,
    PdoEntryKind, Rule,
};
use crate::source::Origin;

/// Adds the undescribed mapped objects to a device. PDO entries whose index depends on the slot are skipped, because they map
/// objects of a module.
pub(super) fn device(device: &mut Device) {
    complete(&mut device.groups, &mut device.process_data.pdos, false);
}

/// Adds the undescribed mapped objects to a module.
pub(super) fn module(module: &mut Module) {
    complete(&mut module.groups, &mut module.process_data.pdos, true);
}

/// The sub-indices of an object that only PDO entries describe, in the order of these entries.
#[derive(Default)]
struct Implied {
    items: Vec<Item>,
    depends_on_slot: bool,
    depends_on_slot_group: bool,
    origin: Origin,
}

impl Implied {
    /// Returns the item that this PDO entry maps. The first entry that maps an item gives its name and type.
    fn item(&mut self, entry: &PdoEntry, origin: Origin, origins: &FactOrigins) -> &mut Item {
        let object = Some((entry.index, entry.sub_index));
        let position = self.items.iter().position(|item| item.object() == object);
        let position = position.unwrap_or_else(|| {
            let mut item = Item::new(Binding::coe(entry.index, entry.sub_index));
            (item.name, item.names) = (entry.name.clone(), entry.names.clone());
            (item.ty, item.origin) = (entry.ty, origin);
            item.origins.clone_from(origins);
            // Most of these objects have one item, and `Vec` would allocate memory for four.
            self.items.reserve_exact(1);
            self.items.push(item);
            self.items.len() - 1
        });
        &mut self.items[position]
    }
}

fn complete(groups: &mut Vec<Group>, pdos: &mut [Pdo], is_module: bool) {
    let mut objects: BTreeMap<u16, Implied> = BTreeMap::new();
    let origins = FactOrigins::by_rule(&[Fact::Access, Fact::Mappable], Rule::MappedObject);
    for pdo in pdos {
        for entry in &mut pdo.entries {
            if entry.kind != PdoEntryKind::Unknown || (entry.depends_on_slot && !is_module) {
                continue;
            }
            entry.kind = PdoEntryKind::Item;
            let object = objects.entry(entry.index).or_default();
            object.depends_on_slot |= entry.depends_on_slot;
            object.depends_on_slot_group |= entry.depends_on_slot_group;
            let origin = Origin { line: 0, ..entry.origin };
            if object.items.is_empty() {
                object.origin = origin;
            }
            let item = object.item(entry, origin, &origins);
            match pdo.direction {
                Direction::Receive => (item.access, item.mappable.rpdo) = (Access::ReadWrite, true),
                Direction::Transmit => item.mappable.tpdo = true,
            }
        }
    }
    add(groups, objects);
}

/// Adds the implied objects to the described objects in `groups`, which are sorted by index. If an object is already described,
/// adds only its implied sub-indices.
fn add(groups: &mut Vec<Group>, objects: BTreeMap<u16, Implied>) {
    let described = groups.len();
    for (index, mut object) in objects {
        let known = groups.get_mut(..described).unwrap_or_default();
        let position = known.binary_search_by_key(&Some(index), Group::index).ok();
        if let Some(group) = position.and_then(|position| known.get_mut(position)) {
            group.items.append(&mut object.items);
            sort(&mut group.items);
            continue;
        }
        let is_var = matches!(object.items.as_slice(), [item] if item.object() == Some((index, 0)));
        let mut group = Group::object(index, if is_var { ObjectCode::Var } else { ObjectCode::Record });
        if let (true, Some(item)) = (is_var, object.items.first()) {
            (group.name, group.names) = (item.name.clone(), item.names.clone());
        }
        group.items = object.items;
        sort(&mut group.items);
        group.origin = object.origin;
        group.depends_on_slot = object.depends_on_slot;
        group.depends_on_slot_group = object.depends_on_slot_group;
        groups.push(group);
    }
    if groups.len() > described {
        groups.sort_by_key(Group::index);
    }
}

/// Sorts the items of an object by sub-index.
fn sort(items: &mut [Item]) {
    items.sort_by_key(|item| item.object().map(|(_, sub)| sub));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{PdoEntry, Type};

    #[test]
    fn mapped_objects_exist() {
        let entry = |index, sub, name: &str| PdoEntry {
            name: name.into(),
            ty: Type::Unsigned(8),
            ..PdoEntry::new(index, sub, 8)
        };
        let mut receive = Pdo::new(Direction::Receive, 0x1600);
        receive.entries = vec![entry(0x7000, 1, "Out"), entry(0x7000, 2, "Both")];
        let mut transmit = Pdo::new(Direction::Transmit, 0x1A00);
        transmit.entries = vec![entry(0x7000, 2, "Both"), entry(0x6041, 0, "Status")];
        let mut device = Device { groups: vec![Group::object(0x6800, ObjectCode::Var)], ..Device::default() };
        device.process_data.pdos = vec![receive, transmit];
        super::device(&mut device);
        let indices: Vec<_> = device.groups.iter().filter_map(Group::index).collect();
        assert_eq!(indices, [0x6041, 0x6800, 0x7000]);
        let status = device.object(0x6041).unwrap();
        assert_eq!((status.object_code(), status.name.as_str()), (Some(ObjectCode::Var), "Status"));
        let both = device.entry(0x7000, 2).unwrap();
        assert_eq!((both.access, both.mappable.rpdo, both.mappable.tpdo), (Access::ReadWrite, true, true));
        assert_eq!(device.entry(0x6041, 0).unwrap().access, Access::ReadOnly);
        assert!(device.groups.iter().all(|group| group.origin.line == 0));
    }
}
