//! Lookup of definitions by name.

use std::sync::Arc;

use super::at::At;
use crate::collections::{HashMap, HashMapExt};

/// Definitions in the order of the table, with a lookup by name in constant time. Copies of this list share the
/// definitions.
#[derive(Debug)]
pub(super) struct ByName<T>(Arc<Lookup<T>>);

#[derive(Debug)]
struct Lookup<T> {
    all: Vec<(At<String>, T)>,
    /// Positions in `all`, by name. The first definition counts if a name is repeated.
    positions: HashMap<String, usize>,
}

impl<T> ByName<T> {
    pub fn new(all: Vec<(At<String>, T)>) -> Self {
        let mut positions = HashMap::with_capacity(all.len());
        for (at, (name, _)) in all.iter().enumerate() {
            positions.entry(name.value.clone()).or_insert(at);
        }
        ByName(Arc::new(Lookup { all, positions }))
    }

    /// Returns the definition called `name`, with the span of its name.
    pub fn get(&self, name: &str) -> Option<&(At<String>, T)> {
        self.0.all.get(*self.0.positions.get(name)?)
    }

    pub fn iter(&self) -> impl Iterator<Item = &(At<String>, T)> {
        self.0.all.iter()
    }

    /// Returns the names of all definitions.
    pub fn names(&self) -> impl Iterator<Item = &At<String>> {
        self.0.all.iter().map(|(name, _)| name)
    }
}

impl<T> Clone for ByName<T> {
    fn clone(&self) -> Self {
        ByName(Arc::clone(&self.0))
    }
}

impl<T> Default for ByName<T> {
    fn default() -> Self {
        ByName::new(Vec::new())
    }
}
