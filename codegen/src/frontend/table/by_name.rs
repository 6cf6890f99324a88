//! Definitions that are found by their names.

use std::collections::HashMap;
use std::sync::Arc;

use super::at::At;

/// Definitions of one kind in the order of the table. A table may have as many of them as it has rows, each of which looks for its
/// own. Those of a profile are shared by all devices that it completes.
#[derive(Debug)]
pub(super) struct ByName<T>(Arc<Definitions<T>>);

#[derive(Debug)]
struct Definitions<T> {
    all: Vec<(At<String>, T)>,
    /// Where in `all` the first of a name is.
    places: HashMap<String, usize>,
}

impl<T> ByName<T> {
    pub fn new(all: Vec<(At<String>, T)>) -> Self {
        let mut places = HashMap::with_capacity(all.len());
        for (at, (name, _)) in all.iter().enumerate() {
            places.entry(name.value.clone()).or_insert(at);
        }
        ByName(Arc::new(Definitions { all, places }))
    }

    /// The definition of this name, and where the name stands.
    pub fn get(&self, name: &str) -> Option<&(At<String>, T)> {
        self.0.all.get(*self.0.places.get(name)?)
    }

    pub fn iter(&self) -> impl Iterator<Item = &(At<String>, T)> {
        self.0.all.iter()
    }

    /// Their names.
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
