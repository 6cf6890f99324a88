//! What lowering knows of a device or a module: its elements, where they are found, their names, and what documentation links to.

use std::ops::Deref;

use super::links::{Here, Links};
use super::located::Located;
use super::naming::types::NamedType;
use super::naming::Names;
use super::words;
use crate::ir::{ElementId, Reference, Type};

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

    /// A link from `here` to the element that a reference leads to, if it has a path.
    pub fn link<Id: Copy + Into<ElementId>>(&self, reference: &Reference<Id>, here: Here<'_>) -> Option<String> {
        self.link_to(reference.id?.into(), &reference.name, here)
    }

    /// A link from `here` to an element that shows this name, if it has a path.
    pub fn link_to(&self, id: ElementId, name: &str, here: Here<'_>) -> Option<String> {
        Some(here.text(&words::escape(name), self.links.path(id)?))
    }
}
