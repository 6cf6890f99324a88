//! Items that are accessed through the windows of a register table.

use crate::check::context::Context;
use crate::ir::{Binding, IndirectBinding, Item};

/// Returns the items that are accessed through a window.
pub(super) fn behind<'a>(context: &Context<'a>) -> impl Iterator<Item = &'a Item> {
    context.owner.items().filter(|item| windows(item).next().is_some())
}

/// Returns the windows through which an item is accessed.
pub(super) fn windows(item: &Item) -> impl Iterator<Item = &IndirectBinding> {
    item.bindings.iter().filter_map(|binding| match binding {
        Binding::Indirect(window) => Some(&**window),
        _ => None,
    })
}
