//! Creates objects for registers that have an object address but belong to no declared object.

use std::collections::{BTreeMap, HashSet};

use lexibus_codegen::ir::{Binding, CompactString, Device, Group, Item, ObjectCode, Type, Value};
use lexibus_codegen::source::Origin;

/// Name of sub-index 0 if no register describes it (CiA 301 7.4.3).
const COUNT_NAME: CompactString = CompactString::const_new("Highest sub-index supported");

/// Returns an object for each index that occurs only in registers. An object with only sub-index 0 is a VAR; other objects
/// are RECORDs. `address` returns the index and sub-index of a register on the bus of the export.
pub(super) fn objects(device: &Device, address: impl Fn(&Item) -> Option<(u16, u8)>) -> Vec<Group> {
    let object_indices: HashSet<u16> = device.groups.iter().filter_map(Group::index).collect();
    let mut by_index: BTreeMap<u16, (&Group, BTreeMap<u8, &Item>)> = BTreeMap::new();
    for chapter in device.groups.iter().filter(|group| group.index().is_none()) {
        for item in &chapter.items {
            let Some((index, sub)) = address(item).filter(|(index, _)| !object_indices.contains(index)) else {
                continue;
            };
            by_index.entry(index).or_insert_with(|| (chapter, BTreeMap::new())).1.entry(sub).or_insert(item);
        }
    }
    by_index.into_iter().map(|(index, (chapter, items))| object(index, chapter, &items)).collect()
}

fn object(index: u16, chapter: &Group, items: &BTreeMap<u8, &Item>) -> Group {
    let single = items.get(&0).filter(|_| items.len() == 1);
    let mut group = Group::object(index, if single.is_some() { ObjectCode::Var } else { ObjectCode::Record });
    group.name = name(chapter, items);
    group.items = items.values().map(|item| (*item).clone()).collect();
    if let (None, Some(&highest)) = (items.get(&0), items.keys().next_back()) {
        group.items.insert(0, count(index, highest));
    }
    group
}

/// Returns the item for sub-index 0, which is mandatory in objects with sub-indices (CiA 301 7.4.3).
fn count(index: u16, highest: u8) -> Item {
    let mut item = Item::new(Binding::canopen(index, 0));
    item.name = COUNT_NAME;
    item.ty = Type::Unsigned(8);
    item.default = Some(Value::Int(i128::from(highest)));
    item
}

/// Returns the number of `objects` without a register for sub-index 0.
pub(super) fn completed(objects: &[Group]) -> usize {
    let is_count = |item: &Item| item.origin == Origin::default() && item.name == COUNT_NAME;
    objects.iter().filter(|group| group.items.first().is_some_and(is_count)).count()
}

/// Returns the name of an object: the name of its only entry, or the chapter's name if there are several entries.
fn name(chapter: &Group, items: &BTreeMap<u8, &Item>) -> CompactString {
    match items.values().next() {
        Some(item) if items.len() == 1 => item.name.clone(),
        _ => chapter.name.clone(),
    }
}

/// Returns the number of registers that have the index of a declared object or the address of an earlier register.
pub(super) fn duplicates(device: &Device, address: impl Fn(&Item) -> Option<(u16, u8)>) -> usize {
    let chapters = device.groups.iter().filter(|group| group.index().is_none());
    let addresses = chapters.flat_map(|chapter| &chapter.items).filter_map(address);
    let mut seen = HashSet::new();
    addresses.filter(|&(index, sub)| device.object(index).is_some() || !seen.insert((index, sub))).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::GroupKind;

    #[test]
    fn registers_become_objects() {
        let item = |name: &str, index, sub| {
            let mut item = Item::new(Binding::canopen(index, sub));
            item.name = name.into();
            item
        };
        let mut chapter =
            Group { kind: GroupKind::Chapter, name: "Motor".into(), ..Group::object(0, ObjectCode::Record) };
        chapter.items = vec![
            item("Current", 0x2001, 0),
            item("Poles", 0x2000, 2),
            item("Type", 0x2000, 1),
            item("Axis", 0x2002, 1),
            item("Elsewhere", 0x6040, 0),
            item("Again", 0x2001, 0),
        ];
        let control = Group::object(0x6040, ObjectCode::Var);
        let device = Device { groups: vec![chapter, control], ..Device::default() };
        let objects = objects(&device, Item::object);
        let summary = |group: &Group| (group.index(), group.object_code(), group.name.to_string(), group.items.len());
        let expected = [
            (Some(0x2000), Some(ObjectCode::Record), "Motor".to_owned(), 3),
            (Some(0x2001), Some(ObjectCode::Var), "Current".to_owned(), 1),
            (Some(0x2002), Some(ObjectCode::Record), "Axis".to_owned(), 2),
        ];
        assert_eq!(objects.iter().map(summary).collect::<Vec<_>>(), expected);
        assert_eq!((duplicates(&device, Item::object), completed(&objects)), (2, 2));
        assert_eq!(objects[0].sub(0).and_then(|item| item.default.clone()), Some(Value::Int(2)));
    }
}
