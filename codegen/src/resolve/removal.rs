//! Removes groups of items from a resolved description, and updates the ids that refer to items.

use super::mentions::{for_each, of_items_and_types, Mention, Visit};
use crate::ir::{Device, ElementId, Group, ItemId, Module, Pdo};

/// Removes the groups of a device for which `keep` returns false. Clears the ids in references to removed items.
pub(crate) fn of_device(device: &mut Device, keep: impl Fn(&Group) -> bool) {
    if let Some(moved) = Moved::retain(&mut device.groups, 0, keep) {
        moved.entries(&mut device.process_data.pdos);
        for_each(device, &mut |mention| moved.mention(mention));
    }
}

/// Removes the groups of a module for which `keep` returns false, except fixed objects.
pub(crate) fn of_module(module: &mut Module, keep: impl Fn(&Group) -> bool) {
    let Module { fixed_objects, groups, types, process_data, .. } = module;
    if let Some(moved) = Moved::retain(groups, fixed_objects.len() as u32, keep) {
        moved.entries(&mut process_data.pdos);
        let visit: Visit<'_> = &mut |mention| moved.mention(mention);
        of_items_and_types(fixed_objects.iter_mut().chain(groups), types, visit);
    }
}

/// New positions of groups after a removal.
struct Moved {
    /// Number of groups that precede the list and keep their positions.
    first: u32,
    /// New position of each group in the list; `None` for removed groups.
    positions: Vec<Option<u32>>,
}

impl Moved {
    /// Removes groups from a list. Returns `None` if no group was removed.
    fn retain(groups: &mut Vec<Group>, first: u32, keep: impl Fn(&Group) -> bool) -> Option<Self> {
        let mut positions = Vec::with_capacity(groups.len());
        let mut kept = 0;
        groups.retain(|group| {
            let is_kept = keep(group);
            positions.push(is_kept.then_some(kept));
            kept += u32::from(is_kept);
            is_kept
        });
        (groups.len() < positions.len()).then_some(Moved { first, positions })
    }

    /// Returns the new id of an item, or `None` if the item was removed.
    fn id(&self, id: ItemId) -> Option<ItemId> {
        let Some(position) = id.group.checked_sub(self.first) else { return Some(id) };
        let group = self.positions.get(position as usize).copied().flatten()?;
        Some(ItemId { group: group + self.first, ..id })
    }

    fn entries(&self, pdos: &mut [Pdo]) {
        for entry in pdos.iter_mut().flat_map(|pdo| &mut pdo.entries) {
            entry.item = entry.item.and_then(|id| self.id(id));
        }
    }

    fn mention(&self, mention: Mention<'_>) {
        match mention {
            Mention::Item(reference) => reference.id = reference.id.and_then(|id| self.id(id)),
            Mention::Element(reference) => {
                if let Some(ElementId::Item(id)) = reference.id {
                    reference.id = self.id(id).map(ElementId::Item);
                }
            }
        }
    }
}
