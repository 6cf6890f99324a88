//! Links to elements of a device.

use std::collections::HashSet;
use std::hash::Hash;

/// Maximum number of links of one relation.
const MOST: usize = 20;

/// A link to an element.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Link {
    pub title: String,
    /// File and anchor of the element.
    pub target: String,
}

/// Returns the elements without repetitions, in the order of their first occurrence.
pub(super) fn unique<T: Clone + Eq + Hash>(list: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut known = HashSet::new();
    list.into_iter().filter(|element| known.insert(element.clone())).collect()
}

/// The elements that have the same relation to an item, such as the PDOs that map it.
#[derive(Debug)]
pub(super) struct Relation {
    pub title: &'static str,
    pub links: Vec<Link>,
    /// Number of further elements, which have no link.
    pub others: usize,
}

impl Relation {
    /// Creates a relation without repeated links. Returns `None` if there are no links.
    pub fn new<'l>(title: &'static str, links: impl IntoIterator<Item = &'l Link>) -> Option<Self> {
        let unique = unique(links);
        let links: Vec<Link> = unique.iter().take(MOST).map(|link| (*link).clone()).collect();
        (!links.is_empty()).then(|| Relation { title, others: unique.len() - links.len(), links })
    }
}
