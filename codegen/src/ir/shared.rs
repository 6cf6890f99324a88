//! Types that several parts of the IR use: shared lists, ranges of numbers, families, slot numbers.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use smallvec::SmallVec;

use super::{CompactString, LocalText};
use crate::source::{Origin, Span};

/// A copy-on-write list. An empty list allocates no memory, and a list with one element allocates memory once.
///
/// Copies share their elements until one copy is changed. Sharing saves memory: items of large devices share names, and drives
/// share the codes and states of their profile.
pub struct SharedList<T>(Option<Arc<SmallVec<[T; 1]>>>);

/// Translations of a text.
pub type Texts = SharedList<LocalText>;

impl<T> SharedList<T> {
    fn new(mut list: SmallVec<[T; 1]>) -> Self {
        list.shrink_to_fit();
        SharedList((!list.is_empty()).then(|| Arc::new(list)))
    }

    /// Returns whether the list has no elements.
    pub fn is_empty(&self) -> bool {
        self.0.as_ref().is_none_or(|list| list.is_empty())
    }
}

impl<T: Clone> SharedList<T> {
    /// Returns the elements for modification. Other copies of the list do not change.
    pub fn to_mut(&mut self) -> &mut SmallVec<[T; 1]> {
        Arc::make_mut(self.0.get_or_insert_with(Arc::default))
    }
}

impl<T> Clone for SharedList<T> {
    fn clone(&self) -> Self {
        SharedList(self.0.clone())
    }
}

impl<T> Default for SharedList<T> {
    fn default() -> Self {
        SharedList(None)
    }
}

impl<T> Deref for SharedList<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        self.0.as_ref().map_or(&[], |list| list.as_slice())
    }
}

impl<T: PartialEq> PartialEq for SharedList<T> {
    fn eq(&self, other: &Self) -> bool {
        let same = self.0.as_ref().zip(other.0.as_ref()).is_some_and(|(one, other)| Arc::ptr_eq(one, other));
        same || **self == **other
    }
}

impl<T: Eq> Eq for SharedList<T> {}

impl<T> From<Vec<T>> for SharedList<T> {
    fn from(list: Vec<T>) -> Self {
        SharedList::new(SmallVec::from_vec(list))
    }
}

impl<T> FromIterator<T> for SharedList<T> {
    fn from_iter<I: IntoIterator<Item = T>>(list: I) -> Self {
        SharedList::new(list.into_iter().collect())
    }
}

impl<'l, T> IntoIterator for &'l SharedList<T> {
    type Item = &'l T;
    type IntoIter = std::slice::Iter<'l, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: fmt::Debug> fmt::Debug for SharedList<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(feature = "serde")]
impl<T: serde::Serialize> serde::Serialize for SharedList<T> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

#[cfg(feature = "serde")]
impl<'de, T: serde::Deserialize<'de>> serde::Deserialize<'de> for SharedList<T> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(SharedList::from)
    }
}

/// Ranges of numbers, such as slots or subslots, in the order of the source (`1..3 7`). Each range includes its last number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Numbers(pub SmallVec<[(u16, u16); 2]>);

impl Numbers {
    /// Returns whether the list is empty.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns whether a range contains `number`.
    pub fn contains(&self, number: u16) -> bool {
        self.0.iter().any(|&(first, last)| (first..=last).contains(&number))
    }

    /// Returns an iterator over the numbers of all ranges.
    pub fn iter(&self) -> impl Iterator<Item = u16> + '_ {
        self.0.iter().flat_map(|&(first, last)| first..=last)
    }

    /// Returns how many numbers the ranges contain. A number that is in several ranges counts once for each of these ranges.
    pub fn count(&self) -> usize {
        self.0.iter().map(|&(first, last)| usize::from(last.saturating_sub(first)) + 1).sum()
    }
}

impl FromIterator<u16> for Numbers {
    fn from_iter<I: IntoIterator<Item = u16>>(list: I) -> Self {
        Numbers(list.into_iter().map(|number| (number, number)).collect())
    }
}

/// A location in the source that comparisons ignore.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mark(pub Span);

impl PartialEq for Mark {
    fn eq(&self, _: &Mark) -> bool {
        true
    }
}

/// A family of devices or modules (`Group` of ETG.2000, `CategoryItem` of GSDML).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Family {
    /// Key by which devices and modules refer to the family.
    pub id: CompactString,
    /// Name of the family.
    pub name: CompactString,
    /// Name of the family in other languages.
    pub names: Texts,
    /// Descriptions, one for each language.
    pub descriptions: Vec<LocalText>,
    /// Location of the family in the source.
    pub origin: Origin,
}

/// Slots of a module, or subslots of a submodule. If all lists are empty, every slot or subslot is allowed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlotNumbers {
    /// Slots or subslots that accept the module or submodule (`AllowedInSlots`, `AllowedInSubslots`).
    pub allowed: Numbers,
    /// Slots or subslots that always contain the module or submodule (`FixedInSlots`, `FixedInSubslots`).
    pub fixed: Numbers,
    /// Slots or subslots that contain the module or submodule by default (`UsedInSlots`, `UsedInSubslots`).
    pub used: Numbers,
}

impl SlotNumbers {
    /// Returns whether one of the lists contains the slot or subslot. Also returns true if all lists are empty.
    pub fn accept(&self, place: u16) -> bool {
        let lists = [&self.allowed, &self.fixed, &self.used];
        lists.iter().all(|list| list.is_empty()) || lists.iter().any(|list| list.contains(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_affects_one_copy_only() {
        let first: SharedList<u8> = [1, 2].into_iter().collect();
        let mut other = first.clone();
        assert!(first == other && std::ptr::eq(&*first, &*other));
        other.to_mut().push(3);
        assert_eq!((&*first, &*other), (&[1, 2][..], &[1, 2, 3][..]));
        assert!(SharedList::<u8>::from(Vec::new()).0.is_none());
    }
}
