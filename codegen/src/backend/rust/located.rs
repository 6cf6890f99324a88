//! The windows and registers of a device or a module that a client can reach.

use std::ops::Deref;

use super::item_addresses::ItemAddresses;
use super::reachable::addressable;
use super::scope::Scope;
use super::window::{self, Window};
use crate::ir::{Group, GroupKind, Item, ItemId};

/// A device or a module, and where its items are found.
pub(super) struct Located<'a> {
    scope: Scope<'a>,
    /// The windows through which items are found.
    pub windows: Vec<Window>,
    /// The items of chapters and images that a client can reach.
    pub registers: Vec<Register<'a>>,
}

/// An item of a chapter or an image, with the title of that.
#[derive(Clone, Copy)]
pub(super) struct Register<'a> {
    pub chapter: &'a str,
    pub id: ItemId,
    pub item: &'a Item,
}

impl<'a> Located<'a> {
    pub fn of(scope: Scope<'a>) -> Self {
        let windows = scope.device.map(|device| window::windows(&scope, device)).unwrap_or_default();
        let mut located = Located { scope, windows, registers: Vec::new() };
        located.registers = registers(&located);
        located
    }

    /// What the handles are of, and what one of them is of at the start of a sentence and within it.
    pub fn handles(&self) -> [&'static str; 3] {
        let has_objects = addressable(self).next().is_some();
        match (self.registers.is_empty(), has_objects) {
            (true, _) => ["entry of the object dictionary", "An entry", "an entry"],
            (false, true) => [
                "register and every entry of the object dictionary",
                "A register or an entry",
                "a register or an entry",
            ],
            (false, false) => ["register", "A register", "a register"],
        }
    }
}

impl<'a> Deref for Located<'a> {
    type Target = Scope<'a>;

    fn deref(&self) -> &Scope<'a> {
        &self.scope
    }
}

/// The items of chapters and images that a client can reach.
fn registers<'a>(located: &Located<'a>) -> Vec<Register<'a>> {
    let registers = |(position, group): (u32, &'a Group)| {
        // An image is told with the place of its fields.
        let chapter = if group.kind == GroupKind::Chapter { group.name.as_str() } else { "" };
        group.items_at(position).map(move |(id, item)| Register { chapter, id, item })
    };
    let is_chapter = |group: &Group| matches!(group.kind, GroupKind::Chapter | GroupKind::Image { .. });
    let chapters = located.positioned_groups().filter(|(_, group)| is_chapter(group));
    let reachable = |register: &Register<'_>| !ItemAddresses::of(located, register.item).buses().is_empty();
    chapters.flat_map(registers).filter(reachable).collect()
}
