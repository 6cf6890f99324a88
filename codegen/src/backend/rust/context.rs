//! Input of the lowering to plain data: a device or module, with the addresses, names and links of its elements.

use std::ops::Deref;

use super::links::{DocModule, Links};
use super::located::Located;
use super::naming::types::NamedType;
use super::naming::Names;
use super::words;
use crate::ir::stated::is_of_profile;
use crate::ir::{ElementId, Reference, Type};

/// A device or module with the results of all previous stages.
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
    /// Returns the enumeration or bit field of a type. Returns `None` for other types.
    pub fn enumeration(&self, ty: Type) -> Option<&NamedType> {
        let (position, _) = self.resolve(ty).1?;
        self.names.types.get(position)
    }

    /// Returns whether a profile states the type at `position` in the list of types.
    pub fn is_of_profile(&self, position: u32) -> bool {
        self.types.get(position as usize).is_some_and(|definition| is_of_profile(definition.stated_by.as_deref()))
    }

    /// Returns a link from `doc_module` to the referenced element, if this element has a path.
    pub fn link<Id: Copy + Into<ElementId>>(
        &self,
        reference: &Reference<Id>,
        doc_module: DocModule<'_>,
    ) -> Option<String> {
        self.link_to(reference.id?.into(), &reference.name, doc_module)
    }

    /// Returns a link from `doc_module` to an element, if the element has a path. The text of the link is `name`.
    pub fn link_to(&self, id: ElementId, name: &str, doc_module: DocModule<'_>) -> Option<String> {
        Some(doc_module.text(&words::escape(name), self.links.path(id)?))
    }
}
