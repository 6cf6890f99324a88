//! The windows and registers of a device or a module that a client can reach.

use std::ops::Deref;

use super::item_addresses::ItemAddresses;
use super::reachable::addressable;
use super::scope::Scope;
use super::window::{self, Window};
use crate::ir::{Group, GroupKind, Item};

/// A device or a module, and where its items are found.
pub(super) struct Located<'a> {
    scope: Scope<'a>,
    /// The windows through which items are found.
    pub windows: Vec<Window>,
    /// The items of chapters and images that a client can reach, with the titles of those.
    pub registers: Vec<(&'a str, &'a Item)>,
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

/// The items of chapters and images that a client can reach, with the titles of those.
fn registers<'a>(located: &Located<'a>) -> Vec<(&'a str, &'a Item)> {
    let is_chapter = |group: &&Group| matches!(group.kind, GroupKind::Chapter | GroupKind::Image { .. });
    let chapters = located.groups.iter().filter(is_chapter);
    // An image is told with the place of its fields.
    let title = |group: &'a Group| if group.kind == GroupKind::Chapter { group.name.as_str() } else { "" };
    let items = chapters.flat_map(|group| group.items.iter().map(move |item| (title(group), item)));
    items.filter(|(_, item)| !ItemAddresses::of(located, item).buses().is_empty()).collect()
}
