//! Links to elements of a device.

/// Maximum number of links of one relation.
const MOST: usize = 20;

/// A link to an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Link {
    pub title: String,
    /// File and anchor of the element.
    pub target: String,
}

/// Returns the elements without repetitions, in the order of their first occurrence.
pub(super) fn unique<T: PartialEq>(list: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut unique = Vec::new();
    for element in list {
        if !unique.contains(&element) {
            unique.push(element);
        }
    }
    unique
}

/// The elements that have the same relation to an item, such as the PDOs that map it.
#[derive(Debug)]
pub(super) struct Relation {
    pub title: &'static str,
    pub links: Vec<Link>,
    /// Number of further elements.
    pub others: usize,
}

impl Relation {
    /// Creates a relation without repeated links. Returns `None` if there are no links.
    pub fn new(title: &'static str, links: Vec<Link>) -> Option<Self> {
        let mut unique = unique(links);
        let others = unique.len().saturating_sub(MOST);
        unique.truncate(MOST);
        (!unique.is_empty()).then_some(Relation { title, links: unique, others })
    }
}
