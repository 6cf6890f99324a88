//! Access to the items and types of a device, a module, or all submodules of a catalog.

use std::cell::OnceCell;

use super::{EnumValue, Group, Item, ItemId, ItemPaths, Shape, Type, TypeDef, TypeId, Value, Zone};
use crate::collections::HashMap;
use crate::limits;
use crate::source::Span;

/// Maximum number of definitions that the search for an underlying type follows. Data types of a file can be nested this deep, and
/// types that objects of an XDD define may have cycles.
const MAX_ALIASES: usize = limits::MAX_XML_DEPTH + 1;

/// Groups of items, and the types of these items.
#[derive(Clone, Copy)]
pub struct Owner<'a> {
    /// Types of the items.
    pub types: &'a [TypeDef],
    /// Lists of the groups that contain the items.
    pub groups: &'a [&'a [Group]],
}

impl<'a> Owner<'a> {
    /// Creates an owner of types without items.
    pub fn of_types(types: &'a [TypeDef]) -> Self {
        Owner { types, groups: &[] }
    }

    /// Returns the item with this id. In the id, the groups of all lists are numbered consecutively.
    pub fn item(self, id: ItemId) -> Option<&'a Item> {
        let mut position = id.group as usize;
        for groups in self.groups {
            match groups.get(position) {
                Some(group) => return group.items.get(id.item as usize),
                None => position -= groups.len(),
            }
        }
        None
    }

    /// Returns the items of all groups.
    pub fn items(self) -> impl Iterator<Item = &'a Item> {
        self.groups.iter().flat_map(|groups| groups.iter()).flat_map(|group| &group.items)
    }

    /// Returns the items of all groups with their groups and ids.
    pub fn identified(self) -> impl Iterator<Item = (&'a Group, ItemId, &'a Item)> {
        let groups = self.groups.iter().flat_map(|groups| groups.iter());
        let ids =
            |(position, group): (u32, &'a Group)| group.items_at(position).map(move |(id, item)| (group, id, item));
        (0..).zip(groups).flat_map(ids)
    }

    /// Returns the definition of a named type after following aliases. Returns `None` if the type is basic or an alias of a basic
    /// type, if a definition is missing, or if there are too many nested aliases.
    pub fn definition(self, ty: Type) -> Option<&'a TypeDef> {
        let mut ty = ty;
        for _ in 0..MAX_ALIASES {
            let Type::Named(TypeId(id)) = ty else { return None };
            let definition = self.types.get(id as usize)?;
            match definition.shape {
                Shape::Alias(other) => ty = other,
                _ => return Some(definition),
            }
        }
        None
    }

    /// Returns the length of a type in bits, if the type has a fixed length. For a string, returns the maximum length, if known.
    pub fn fixed_bits(self, ty: Type) -> Option<u32> {
        match ty {
            Type::Named(TypeId(id)) => self.types.get(id as usize)?.bits,
            Type::VisibleString(length) | Type::OctetString(length) => length?.checked_mul(8),
            Type::UnicodeString(length) => length?.checked_mul(16),
            basic => basic.bits(),
        }
    }

    /// Returns the basic type under aliases, bit fields, enumerations and scaled types. Arrays and records are returned
    /// unchanged.
    pub fn basic(self, ty: Type) -> Type {
        let mut ty = ty;
        for _ in 0..MAX_ALIASES {
            let Type::Named(TypeId(id)) = ty else { break };
            match self.types.get(id as usize).map(|definition| &definition.shape) {
                Some(Shape::Alias(base) | Shape::BitField { base, .. } | Shape::Enumeration { base, .. }) => ty = *base,
                Some(Shape::Scaled { base, .. }) => ty = *base,
                _ => break,
            }
        }
        ty
    }

    /// Returns the integer type of an enumeration or bit field. Other types are returned unchanged.
    pub(crate) fn integer(self, ty: Type) -> Type {
        let Type::Named(TypeId(id)) = ty else { return ty };
        match self.types.get(id as usize).map(|definition| &definition.shape) {
            Some(Shape::Enumeration { base, .. } | Shape::BitField { base, .. }) => *base,
            _ => ty,
        }
    }

    /// Returns the values of an enumeration, and whether the list is complete. Returns `None` for other types.
    pub fn enumeration(self, ty: Type) -> Option<(&'a [EnumValue], bool)> {
        match &self.definition(ty)?.shape {
            Shape::Enumeration { values, closed, .. } => Some((values, *closed)),
            _ => None,
        }
    }
}

/// Location of the first use of each type. The map is built at the first lookup, because only diagnostics need the map.
pub(crate) struct TypeUses<'a> {
    uses: OnceCell<HashMap<TypeId, Span>>,
    owner: Owner<'a>,
}

impl<'a> TypeUses<'a> {
    pub fn new(owner: Owner<'a>) -> Self {
        TypeUses { uses: OnceCell::new(), owner }
    }

    /// Returns the location of the first use of a type, or of its definition if no item has this type.
    pub fn first(&self, id: TypeId) -> Span {
        let defined = || self.owner.types.get(id.0 as usize).map(|definition| definition.origin.span);
        self.uses().get(&id).copied().or_else(defined).unwrap_or_default()
    }

    fn uses(&self) -> &HashMap<TypeId, Span> {
        self.uses.get_or_init(|| {
            let mut first = HashMap::default();
            for item in self.owner.items() {
                if let Type::Named(id) = item.ty {
                    first.entry(id).or_insert(item.at.ty.or(item.origin.span));
                }
            }
            first
        })
    }
}

/// Lookup table for the names in references. Each map is built at the first lookup, because most descriptions have no references.
pub(crate) struct Index<'a> {
    names: OnceCell<HashMap<&'a str, ItemId>>,
    objects: OnceCell<HashMap<(u16, u8), ItemId>>,
    paths: OnceCell<ItemPaths<'a>>,
    owner: Owner<'a>,
}

impl<'a> Index<'a> {
    pub fn new(owner: Owner<'a>) -> Self {
        Index { names: OnceCell::new(), objects: OnceCell::new(), paths: OnceCell::new(), owner }
    }

    fn groups(&self) -> impl Iterator<Item = &'a Group> {
        self.owner.groups.iter().flat_map(|groups| groups.iter())
    }

    /// Returns a map from each name to the first item with this name. The name of an object with a single value also refers to
    /// that value. Names of records and chapters do not refer to items.
    fn names(&self) -> &HashMap<&'a str, ItemId> {
        self.names.get_or_init(|| {
            let items = self.owner.identified().map(|(_, id, item)| (item.name.as_str(), id));
            let single =
                self.owner.identified().filter(|(group, ..)| group.index().is_some() && group.items.len() == 1);
            let single = single.map(|(group, id, _)| (group.name.as_str(), id));
            let mut names = HashMap::default();
            for (name, id) in items.chain(single).filter(|(name, _)| !name.is_empty()) {
                names.entry(name).or_insert(id);
            }
            names
        })
    }

    fn objects(&self) -> &HashMap<(u16, u8), ItemId> {
        self.objects
            .get_or_init(|| self.owner.identified().filter_map(|(_, id, item)| Some((item.object()?, id))).collect())
    }

    /// Returns the item with this name, address (`0x6040`, `0x1018:1`) or path (`Chapter/Item`).
    pub fn find(&self, name: &str) -> Option<ItemId> {
        let by_name = || self.names().get(name).copied();
        let by_object = || self.objects().get(&object(name)?).copied();
        let by_path = || self.paths.get_or_init(|| ItemPaths::new(self.groups())).find(name).map(|(id, _)| id);
        by_name().or_else(by_object).or_else(by_path)
    }
}

/// Parses an index and sub-index: `0x6040`, `0x1018:1`. A missing sub-index is 0.
pub(crate) fn object(text: &str) -> Option<(u16, u8)> {
    let (index, sub_index) = text.split_once(':').unwrap_or((text, "0"));
    let number = |text: &str| match text.strip_prefix("0x") {
        Some(digits) => u16::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    Some((number(index)?, u8::try_from(number(sub_index)?).ok()?))
}

/// Returns whether a value of an enumeration is reserved, or `None` if the enumeration does not list the value. A named value in
/// a reserved range is not reserved.
pub(crate) fn reserved(labels: &[EnumValue], value: i128) -> Option<bool> {
    let matches = |label: &&EnumValue| (label.value..=label.last.unwrap_or(label.value)).contains(&value);
    let mut zones = labels.iter().filter(matches).map(|label| label.zone == Some(Zone::Reserved));
    let first = zones.next()?;
    Some(first && zones.all(|is_reserved| is_reserved))
}

/// Returns the only value that an item can have, if its minimum and maximum are equal integers.
pub(crate) fn fixed(item: &Item) -> Option<i128> {
    let low = item.limits.low.as_ref().and_then(Value::as_int)?;
    (item.limits.high.as_ref().and_then(Value::as_int) == Some(low)).then_some(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, GroupKind, ObjectCode};

    fn object(index: u16, name: &str, values: &[&str]) -> Group {
        let mut group = Group::object(index, ObjectCode::Record);
        group.name = name.into();
        for (sub, name) in (0..).zip(values) {
            let mut item = Item::new(Binding::canopen(index, sub));
            item.name = (*name).into();
            group.items.push(item);
        }
        group
    }

    #[test]
    fn only_the_name_of_an_object_with_a_single_value_refers_to_that_value() {
        let chapter = Group { kind: GroupKind::Chapter, ..object(0x2002, "Chapter", &["Only"]) };
        let groups = [object(0x2000, "Speed", &["Value"]), object(0x2001, "Gains", &["Count", "P"]), chapter];
        let all = [groups.as_slice()];
        let index = Index::new(Owner { types: &[], groups: &all });
        let found = |name| index.find(name).and_then(|id| index.owner.item(id)).map(|item| item.name.as_str());
        assert_eq!((found("Speed"), found("Gains/P"), found("0x2001:1")), (Some("Value"), Some("P"), Some("P")));
        assert!(index.find("Gains").is_none() && index.find("Chapter").is_none());
    }

    #[test]
    fn the_location_of_a_type_is_its_first_use() {
        let mut groups = [object(0x2000, "Speed", &["a"]), object(0x2001, "Limit", &["b"])];
        for (group, at) in groups.iter_mut().zip([5, 9]) {
            group.items[0].ty = Type::Named(TypeId(0));
            group.items[0].at.ty = Span::new(crate::source::FileId(0), at, at + 1);
        }
        let all = [groups.as_slice()];
        let owner = Owner { types: &[], groups: &all };
        assert_eq!(TypeUses::new(owner).first(TypeId(0)).start, 5);
        assert_eq!(TypeUses::new(owner).first(TypeId(1)), Span::default());
    }
}
