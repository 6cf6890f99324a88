//! What modular devices of all buses share: places, families, and texts that many elements have in common.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use smallvec::SmallVec;

use super::{CompactString, LocalText};
use crate::source::{Origin, Span};

/// A list whose copies share it until one of them is changed: a device of 50,000 parameters names many of them alike, and every
/// drive has the codes and states that its profile gives it. An empty one takes no memory.
pub struct SharedList<T>(Option<Arc<Vec<T>>>);

/// A text in further languages.
pub type Texts = SharedList<LocalText>;

impl<T: Clone> SharedList<T> {
    /// The list of this copy alone, to be changed.
    pub fn to_mut(&mut self) -> &mut Vec<T> {
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
        let same = self.0.as_ref().zip(other.0.as_ref()).is_some_and(|(own, others)| Arc::ptr_eq(own, others));
        same || **self == **other
    }
}

impl<T: Eq> Eq for SharedList<T> {}

impl<T> From<Vec<T>> for SharedList<T> {
    fn from(list: Vec<T>) -> Self {
        SharedList((!list.is_empty()).then(|| Arc::new(list)))
    }
}

impl<T> FromIterator<T> for SharedList<T> {
    fn from_iter<I: IntoIterator<Item = T>>(list: I) -> Self {
        list.into_iter().collect::<Vec<_>>().into()
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

/// Numbers of slots or subslots, and the like: ranges in the order of the source (`1..3 7`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Numbers(pub SmallVec<[(u16, u16); 2]>);

impl Numbers {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether `number` is one of them.
    pub fn contains(&self, number: u16) -> bool {
        self.0.iter().any(|&(first, last)| (first..=last).contains(&number))
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = u16> + '_ {
        self.0.iter().flat_map(|&(first, last)| first..=last)
    }

    /// How many there are, where no two ranges overlap.
    pub fn count(&self) -> usize {
        self.0.iter().map(|&(first, last)| usize::from(last.saturating_sub(first)) + 1).sum()
    }
}

impl FromIterator<u16> for Numbers {
    fn from_iter<I: IntoIterator<Item = u16>>(list: I) -> Self {
        Numbers(list.into_iter().map(|number| (number, number)).collect())
    }
}

/// A place in the source that is no fact: elements that differ in nothing else are equal, and no output has it.
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
    /// Its key.
    pub id: CompactString,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// What the source says about it, in each language.
    pub descriptions: Vec<LocalText>,
    /// Where it is declared.
    pub origin: Origin,
}

/// The numbers of the slots, or subslots, that something may or has to be in. All empty = wherever the place allows it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Places {
    /// Where it may be plugged (`AllowedInSlots`, `AllowedInSubslots`).
    pub allowed: Numbers,
    /// Where it is and can't be removed (`FixedInSlots`, `FixedInSubslots`).
    pub fixed: Numbers,
    /// Where it is by default (`UsedInSlots`, `UsedInSubslots`).
    pub used: Numbers,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_seen_in_its_own_copy_alone() {
        let first: SharedList<u8> = [1, 2].into_iter().collect();
        let mut other = first.clone();
        assert!(first == other && std::ptr::eq(&*first, &*other));
        other.to_mut().push(3);
        assert_eq!((&*first, &*other), (&[1, 2][..], &[1, 2, 3][..]));
        assert!(SharedList::<u8>::from(Vec::new()).0.is_none());
    }
}
