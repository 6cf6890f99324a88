//! What is behind the windows of a register table, and the items that they name.

use crate::ir::owner::{Index, Owner};
use crate::ir::{Binding, IndirectBinding, Item};

/// A device with windows.
pub(super) struct Windows<'d> {
    pub owner: Owner<'d>,
    /// The items that are behind a window.
    pub behind: Vec<&'d Item>,
    index: Index<'d>,
}

impl<'d> Windows<'d> {
    /// `None` where nothing is behind a window.
    pub fn of(owner: Owner<'d>) -> Option<Self> {
        let behind: Vec<&Item> = owner.items().filter(|item| windows(item).next().is_some()).collect();
        (!behind.is_empty()).then(|| Windows { owner, behind, index: Index::new(owner) })
    }

    /// The item that a window names.
    pub fn item(&self, name: &str) -> Option<&'d Item> {
        self.index.find(name)
    }
}

/// The windows behind which an item is.
pub(super) fn windows(item: &Item) -> impl Iterator<Item = &IndirectBinding> {
    item.bindings.iter().filter_map(|binding| match binding {
        Binding::Indirect(window) => Some(&**window),
        _ => None,
    })
}
