//! References from one element to another: a name with its place, and once resolved an id.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;

use super::{CompactString, Device, Group, Item};
use crate::source::Span;

/// Position of an [`Item`] in its device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ItemId {
    /// Position of its group in [`Device::groups`].
    pub group: u32,
    /// Position in [`Group::items`].
    pub item: u32,
}

impl ItemId {
    /// Returns the item in these groups.
    pub fn of(self, groups: &[Group]) -> Option<&Item> {
        groups.get(self.group as usize)?.items.get(self.item as usize)
    }
}

impl Device {
    /// Returns the item with this id.
    pub fn item(&self, id: ItemId) -> Option<&Item> {
        id.of(&self.groups)
    }

    /// Returns the item that a resolved reference leads to.
    pub fn referred(&self, reference: &ItemRef) -> Option<&Item> {
        self.item(reference.id?)
    }
}

/// A reference to an item of the same device.
///
/// It dereferences to its name, and is equal to another reference of that name. Serialized, it is the name alone: an id is only valid as
/// long as no group and no item is added or removed before it.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "CompactString", into = "CompactString"))]
pub struct ItemRef {
    /// The name of the item or its object, `Chapter/Item`, or its index and sub-index (`0x6040`, `0x1018:1`).
    pub name: CompactString,
    /// Where the name stands.
    pub span: Span,
    /// The item; `None` if there is none of this name, or the reference is not resolved.
    pub id: Option<ItemId>,
}

impl ItemRef {
    /// Creates a reference that is not resolved.
    pub fn new(name: impl Into<CompactString>, span: Span) -> Self {
        ItemRef { name: name.into(), span, id: None }
    }
}

impl Deref for ItemRef {
    type Target = CompactString;

    fn deref(&self) -> &CompactString {
        &self.name
    }
}

impl AsRef<str> for ItemRef {
    fn as_ref(&self) -> &str {
        &self.name
    }
}

impl PartialEq for ItemRef {
    fn eq(&self, other: &ItemRef) -> bool {
        self.name == other.name
    }
}

impl Eq for ItemRef {}

impl Hash for ItemRef {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl PartialEq<str> for ItemRef {
    fn eq(&self, name: &str) -> bool {
        self.name == name
    }
}

impl PartialEq<&str> for ItemRef {
    fn eq(&self, name: &&str) -> bool {
        self.name == *name
    }
}

impl PartialEq<CompactString> for ItemRef {
    fn eq(&self, name: &CompactString) -> bool {
        self.name == *name
    }
}

impl fmt::Display for ItemRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name, f)
    }
}

impl From<CompactString> for ItemRef {
    fn from(name: CompactString) -> Self {
        ItemRef::new(name, Span::default())
    }
}

impl From<&str> for ItemRef {
    fn from(name: &str) -> Self {
        ItemRef::new(name, Span::default())
    }
}

impl From<ItemRef> for CompactString {
    fn from(reference: ItemRef) -> Self {
        reference.name
    }
}
