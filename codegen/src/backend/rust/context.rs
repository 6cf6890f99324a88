//! What lowering knows of a device or a module: its elements, where they are found, their names, and what documentation links to.

use std::ops::Deref;

use super::links::{Here, Links};
use super::located::Located;
use super::naming::types::NamedType;
use super::naming::Names;
use super::words;
use crate::ir::Type;

/// A device or a module with the results of all stages before lowering.
pub(super) struct Context<'a> {
    pub located: Located<'a>,
    pub names: Names<'a>,
    pub links: Links,
}

impl<'a> Deref for Context<'a> {
    type Target = Located<'a>;

    fn deref(&self) -> &Located<'a> {
        &self.located
    }
}

impl Context<'_> {
    /// The enumeration or the bit field of a type that is one.
    pub fn enumeration(&self, ty: Type) -> Option<&NamedType> {
        let (position, _) = self.resolve(ty).1?;
        self.names.types.get(position)
    }

    /// A link from `here` to the item of this name, or to the message of this name if there is no such item.
    pub fn link(&self, name: &str, here: Here<'_>) -> Option<String> {
        let item = self.item(name).and_then(|item| self.links.constant(item));
        let path = item.or_else(|| self.links.message(name))?;
        Some(here.text(&words::escape(name), path))
    }
}
