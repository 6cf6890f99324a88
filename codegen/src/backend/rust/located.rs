//! The windows and registers of a device or module that clients can access.

use std::ops::Deref;

use super::item_addresses::ItemAddresses;
use super::reachable::addressable;
use super::scope::Scope;
use super::window::{self, Window};
use crate::ir::{Group, GroupKind, Item, ItemId};

/// A device or module, with its windows and the registers that a client can access.
pub(super) struct Located<'a> {
    scope: Scope<'a>,
    /// Windows through which some items are accessed.
    pub windows: Vec<Window>,
    /// Items that a client can access, from register chapters and process images.
    pub registers: Vec<Register<'a>>,
}

/// An item of a register chapter or process image, and the title of the chapter.
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

    /// Returns two noun phrases for items with handles: one to follow "every", and one to follow an adjective.
    pub fn handles(&self) -> [&'static str; 2] {
        let has_objects = addressable(self).next().is_some();
        match (self.registers.is_empty(), has_objects) {
            (true, _) => ["entry of the object dictionary", "entry"],
            (false, true) => ["register and every entry of the object dictionary", "register or entry"],
            (false, false) => ["register", "register"],
        }
    }
}

impl<'a> Deref for Located<'a> {
    type Target = Scope<'a>;

    fn deref(&self) -> &Scope<'a> {
        &self.scope
    }
}

/// Returns the items that a client can access, from register chapters and process images.
fn registers<'a>(located: &Located<'a>) -> Vec<Register<'a>> {
    let registers = |(position, group): (u32, &'a Group)| {
        // A process image needs no title, because the addresses of its fields contain the name of the image.
        let chapter = if group.kind == GroupKind::Chapter { group.name.as_str() } else { "" };
        group.items_at(position).map(move |(id, item)| Register { chapter, id, item })
    };
    let is_chapter = |group: &Group| matches!(group.kind, GroupKind::Chapter | GroupKind::Image { .. });
    let chapters = located.positioned_groups().filter(|(_, group)| is_chapter(group));
    let reachable = |register: &Register<'_>| !ItemAddresses::of(located, register.item).buses().is_empty();
    chapters.flat_map(registers).filter(reachable).collect()
}
