//! Facts that few elements have.

use std::fmt;
use std::ops::{Deref, DerefMut};

/// A fact that most elements do not have. If the fact is missing, reading it returns the default value, and only the memory of one
/// pointer is used.
pub struct Rare<T>(Option<Box<T>>);

/// A type of fact with a static default value, which all elements without this fact share.
pub trait Missing: Default + 'static {
    /// Returns the default value.
    fn missing() -> &'static Self;
}

impl<T: Missing> Deref for Rare<T> {
    type Target = T;

    fn deref(&self) -> &T {
        match &self.0 {
            Some(fact) => fact,
            None => T::missing(),
        }
    }
}

impl<T: Missing> DerefMut for Rare<T> {
    fn deref_mut(&mut self) -> &mut T {
        self.0.get_or_insert_default()
    }
}

impl<T> Default for Rare<T> {
    fn default() -> Self {
        Rare(None)
    }
}

impl<T: Clone> Clone for Rare<T> {
    fn clone(&self) -> Self {
        Rare(self.0.clone())
    }
}

impl<T: Missing + PartialEq> PartialEq for Rare<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: Missing + Eq> Eq for Rare<T> {}

impl<T: Missing + PartialEq> From<T> for Rare<T> {
    fn from(fact: T) -> Self {
        Rare((fact != *T::missing()).then(|| Box::new(fact)))
    }
}

impl<T: Missing + fmt::Debug> fmt::Debug for Rare<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        T::fmt(self, f)
    }
}

#[cfg(feature = "serde")]
impl<T: Missing + serde::Serialize> serde::Serialize for Rare<T> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        T::serialize(self, serializer)
    }
}

#[cfg(feature = "serde")]
impl<'de, T: Missing + PartialEq + serde::Deserialize<'de>> serde::Deserialize<'de> for Rare<T> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Rare::from)
    }
}

#[cfg(test)]
mod tests {
    use super::Rare;
    use crate::ir::{Limits, Value};

    #[test]
    fn a_missing_fact_allocates_no_memory_and_equals_the_default_value() {
        let missing: Rare<Limits> = Limits::default().into();
        assert!(missing.0.is_none() && missing.is_empty());
        let mut other = missing.clone();
        other.low = Some(Value::Int(1));
        assert!(other != missing && missing.low.is_none());
        other.low = None;
        assert_eq!(other, missing);
    }
}
