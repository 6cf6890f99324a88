//! References to items by index and sub-index (`0x6040`, `0x1018:1`), which overlays and profiles use.

use super::owner::object;
use super::{CompactString, Condition, Group, Item, ItemRef, Shape, TypeDef};

/// Returns the objects whose indices are in the range from `first` to `last`, inclusive. The groups must be sorted as
/// [`Device::object`](super::Device::object) requires.
pub(crate) fn in_range(groups: &mut [Group], first: u16, last: u16) -> &mut [Group] {
    let start = groups.partition_point(|group| group.index() < Some(first));
    let end = groups.partition_point(|group| group.index() <= Some(last));
    groups.get_mut(start..end).unwrap_or_default()
}

/// Returns the item at the address `name`: an index, or an index and sub-index, such as `0x1018:1`.
pub(crate) fn item_at<'g>(groups: &'g [Group], name: &str) -> Option<&'g Item> {
    let (index, sub_index) = object(name)?;
    let position = groups.binary_search_by_key(&Some(index), Group::index).ok()?;
    groups.get(position)?.sub(sub_index)
}

/// Returns the reference with the name of its item instead of index and sub-index. Returns the unchanged reference if the item does
/// not exist or has no name.
pub(crate) fn item_name(groups: &[Group], reference: &ItemRef) -> ItemRef {
    match item_at(groups, reference) {
        Some(item) if !item.name.is_empty() => ItemRef { name: item.name.clone(), ..reference.clone() },
        _ => reference.clone(),
    }
}

/// Replaces indices in the conditions of bits and values with item names, and adds the names of the values in these conditions.
pub(crate) fn name_conditions(
    groups: &[Group],
    types: &mut [TypeDef],
    value_names: &dyn Fn(&Condition) -> Option<Vec<CompactString>>,
) {
    for definition in types {
        let conditions: Vec<_> = match &mut definition.shape {
            Shape::BitField { fields, .. } => fields.iter_mut().filter_map(|field| field.when.as_deref_mut()).collect(),
            Shape::Enumeration { values, .. } => {
                values.iter_mut().filter_map(|value| value.when.as_deref_mut()).collect()
            }
            _ => continue,
        };
        for when in conditions {
            when.names = value_names(when).unwrap_or_default();
            when.item = item_name(groups, &when.item);
        }
    }
}
