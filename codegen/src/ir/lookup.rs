//! Lookup tables for items.

use std::cell::OnceCell;
use std::collections::BTreeSet;

use super::{Group, Item, ItemId};
use crate::collections::HashMap;

/// Lookup table of items by index and sub-index, including registers with an object address.
///
/// The objects must be sorted by index, and must follow all other groups.
#[derive(Clone, Debug)]
pub struct Entries<'a> {
    groups: &'a [Group],
    /// Registers with an object address. The map is built when an index without an object is looked up for the first time.
    registers: OnceCell<HashMap<(u16, u8), ItemId>>,
}

impl<'a> Entries<'a> {
    /// Creates a lookup table of the items of a device or module.
    pub fn new(groups: &'a [Group]) -> Self {
        Entries { groups, registers: OnceCell::new() }
    }

    /// Returns the item at an index and sub-index. Registers with an object address are ignored if the device has an object with
    /// this index.
    pub fn get(&self, index: u16, sub_index: u8) -> Option<&'a Item> {
        self.find(index, sub_index)?.of(self.groups)
    }

    /// Returns the id of the item at an index and sub-index.
    pub fn find(&self, index: u16, sub_index: u8) -> Option<ItemId> {
        match self.groups.binary_search_by_key(&Some(index), Group::index) {
            Ok(group) => {
                let item = self.groups.get(group)?.position(sub_index)?;
                Some(ItemId { group: group as u32, item: item as u32 })
            }
            Err(_) => self.registers().get(&(index, sub_index)).copied(),
        }
    }

    /// Returns whether the device or module has no groups.
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    fn registers(&self) -> &HashMap<(u16, u8), ItemId> {
        self.registers.get_or_init(|| {
            let mut registers = HashMap::default();
            let chapters = (0..).zip(self.groups).take_while(|(_, group)| group.index().is_none());
            for (id, item) in chapters.flat_map(|(position, group)| group.items_at(position)) {
                if let Some(object) = item.object() {
                    registers.entry(object).or_insert(id);
                }
            }
            registers
        })
    }
}

/// Lookup table of items by name and path, built at the first lookup. If several items share a name, the table contains the first
/// one.
#[derive(Clone, Debug)]
pub struct ItemNames<'a> {
    groups: &'a [Group],
    names: OnceCell<HashMap<&'a str, &'a Item>>,
    paths: OnceCell<ItemPaths<'a>>,
}

impl<'a> ItemNames<'a> {
    /// Creates a lookup table of the items of a device or module.
    pub fn new(groups: &'a [Group]) -> Self {
        ItemNames { groups, names: OnceCell::new(), paths: OnceCell::new() }
    }

    /// Returns the first item with this name.
    pub fn by_name(&self, name: &str) -> Option<&'a Item> {
        let names = self.names.get_or_init(|| {
            let mut names = HashMap::default();
            for item in self.groups.iter().flat_map(|group| &group.items) {
                names.entry(item.name.as_str()).or_insert(item);
            }
            names
        });
        names.get(name).copied()
    }

    /// Returns the item at a path of chapter name and item name (`Chapter/Item`).
    pub fn by_path(&self, path: &str) -> Option<&'a Item> {
        self.paths.get_or_init(|| ItemPaths::new(self.groups)).find(path).map(|(_, item)| item)
    }
}

/// Lookup table of items by path (`Chapter/Item`).
#[derive(Clone, Debug, Default)]
pub struct ItemPaths<'a> {
    chapters: HashMap<&'a str, HashMap<&'a str, (ItemId, &'a Item)>>,
    /// The different numbers of slashes that chapter names contain.
    slashes: BTreeSet<usize>,
}

impl<'a> ItemPaths<'a> {
    /// Creates a lookup table of the items of these groups.
    pub fn new(groups: impl IntoIterator<Item = &'a Group>) -> Self {
        let mut paths = ItemPaths::default();
        for (position, group) in (0..).zip(groups) {
            paths.slashes.insert(group.name.matches('/').count());
            let chapter = paths.chapters.entry(group.name.as_str()).or_default();
            for (id, item) in group.items_at(position) {
                chapter.entry(item.name.as_str()).or_insert((id, item));
            }
        }
        paths
    }

    /// Returns the first item at a path, with its id.
    pub fn find(&self, path: &str) -> Option<(ItemId, &'a Item)> {
        // A slash can belong to the chapter name or to the item name.
        let found = self.slashes.iter().filter_map(|&slashes| {
            let (at, _) = path.match_indices('/').nth(slashes)?;
            self.chapters.get(&path[..at])?.get(&path[at + 1..]).copied()
        });
        found.min_by_key(|(id, _)| id.group)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, GroupKind, ObjectBuses, ObjectCode};

    fn item(name: &str, index: u16, sub_index: u8) -> Item {
        let mut item = Item::new(Binding::Object { index, sub_index, buses: ObjectBuses { canopen: true, coe: true } });
        item.name = name.into();
        item
    }

    fn chapter(name: &str, items: &[&str]) -> Group {
        let items = items.iter().map(|name| item(name, 0x2000, 0)).collect();
        Group { name: name.into(), kind: GroupKind::Chapter, items, ..Group::object(0, ObjectCode::Var) }
    }

    #[test]
    fn an_item_is_found_by_chapter_and_name() {
        let groups = [
            chapter("Axis", &["Speed", "Position/Rate"]),
            chapter("In/Out", &["Speed"]),
            chapter("Axis", &["Speed", "Torque"]),
            chapter("A/B", &["C"]),
            chapter("A", &["B/C", "B/D"]),
            chapter("A/B", &["D"]),
        ];
        let paths = ItemPaths::new(&groups);
        let is = |path: &str, group: usize, item: usize| {
            paths.find(path).is_some_and(|(_, found)| std::ptr::eq(found, &groups[group].items[item]))
        };
        assert!(is("Axis/Speed", 0, 0));
        assert!(is("Axis/Position/Rate", 0, 1));
        assert!(is("In/Out/Speed", 1, 0));
        assert!(is("Axis/Torque", 2, 1));
        assert!(is("A/B/C", 3, 0));
        assert!(is("A/B/D", 4, 1));
        for unknown in ["Speed", "Axis", "Axis/", "/Speed", "In/Out", "In/Speed", "Axis/Speed/"] {
            assert!(paths.find(unknown).is_none(), "{unknown}");
        }
    }

    #[test]
    fn an_object_takes_precedence_over_a_register_with_the_same_index() {
        let mut registers = chapter("Registers", &[]);
        registers.items = vec![item("a", 0x2000, 1), item("again", 0x2000, 1), item("hidden", 0x3000, 1)];
        let mut object = Group::object(0x3000, ObjectCode::Record);
        object.items.push(item("b", 0x3000, 2));
        let groups = [registers, object];
        let entries = Entries::new(&groups);
        let name = |index, sub_index| entries.get(index, sub_index).map(|item| item.name.as_str());
        assert_eq!(name(0x2000, 1), Some("a"));
        assert_eq!(name(0x3000, 2), Some("b"));
        assert_eq!(name(0x3000, 1), None);
        assert_eq!(name(0x2000, 0), None);
    }
}
