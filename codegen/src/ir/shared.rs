//! What modular devices of all buses share: places, families, and texts that many elements have in common.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use smallvec::SmallVec;

use super::{CompactString, LocalText};
use crate::source::{Origin, Span};

/// A text in further languages. Copies share one list: a device of 50,000 parameters names many of them alike.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Texts(Option<Arc<[LocalText]>>);

impl Deref for Texts {
    type Target = [LocalText];

    fn deref(&self) -> &[LocalText] {
        self.0.as_deref().unwrap_or(&[])
    }
}

impl From<Vec<LocalText>> for Texts {
    fn from(list: Vec<LocalText>) -> Self {
        Texts((!list.is_empty()).then(|| list.into()))
    }
}

impl FromIterator<LocalText> for Texts {
    fn from_iter<I: IntoIterator<Item = LocalText>>(list: I) -> Self {
        list.into_iter().collect::<Vec<_>>().into()
    }
}

impl fmt::Debug for Texts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl Serialize for Texts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de> Deserialize<'de> for Texts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Texts::from)
    }
}

/// Numbers of slots or subslots, and the like: ranges in the order of the source (`1..3 7`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Places {
    /// Where it may be plugged (`AllowedInSlots`, `AllowedInSubslots`).
    pub allowed: Numbers,
    /// Where it is and can't be removed (`FixedInSlots`, `FixedInSubslots`).
    pub fixed: Numbers,
    /// Where it is by default (`UsedInSlots`, `UsedInSubslots`).
    pub used: Numbers,
}
