//! Identifiers of elements, and references to these elements. A reference may come before the element.

use std::borrow::Cow;

use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::Given;
use crate::ir::{Catalog, ModuleId, ModuleUse, SlotNumbers, SubmoduleId, SubmoduleUse};
use crate::source::Span;
use crate::text::brief;

/// Kind of an element with an identifier. Identifiers are unique within a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ElementKind {
    AccessPoint,
    Module,
    /// Built-in submodule: `VirtualSubmoduleItem`, `InterfaceSubmoduleItem`, or a port that cannot be removed.
    BuiltIn,
    /// Submodule in `SubmoduleList`.
    Pluggable,
    Value,
    Graphic,
    Category,
}

impl ElementKind {
    /// Returns the name of an XML element of this kind for diagnostics.
    fn element(self) -> &'static str {
        match self {
            ElementKind::AccessPoint => "DeviceAccessPointItem",
            ElementKind::Module => "ModuleItem",
            ElementKind::BuiltIn => "VirtualSubmoduleItem",
            ElementKind::Pluggable => "SubmoduleItem",
            ElementKind::Value => "ValueItem",
            ElementKind::Graphic => "GraphicItem",
            ElementKind::Category => "CategoryItem",
        }
    }
}

/// Element into which modules or submodules can be plugged.
#[derive(Clone, Copy, Debug)]
pub(super) enum Owner {
    /// Device access point at this position in the catalog.
    Device(usize),
    /// Module at this position in the catalog.
    Module(usize),
}

#[derive(Default)]
pub(super) struct Links<'a> {
    ids: HashMap<(ElementKind, Cow<'a, str>), (u32, Span)>,
    /// References to modules that can be plugged into the device at this position.
    pub modules: Vec<(usize, Given<'a>, SlotNumbers)>,
    /// References to submodules that can be plugged into an element.
    pub submodules: Vec<(Owner, Given<'a>, SlotNumbers)>,
    /// References that are only checked: the target must exist, but the reference is not part of the IR.
    pub others: Vec<(ElementKind, Given<'a>)>,
}

impl<'a> Links<'a> {
    /// Registers the identifier of an element at `position`. Returns the span of an earlier element with the same
    /// identifier.
    pub fn register(&mut self, kind: ElementKind, id: &Given<'a>, position: usize) -> Option<Span> {
        let element = (u32::try_from(position).unwrap_or(u32::MAX), id.span);
        let (_, first) = *self.ids.entry((kind, id.text.clone())).or_insert(element);
        (first != id.span).then_some(first)
    }

    fn find(&self, kind: ElementKind, target: &Given<'a>, diagnostics: &mut Diagnostics) -> Option<u32> {
        let found = self.ids.get(&(kind, target.text.clone()));
        if found.is_none() {
            unresolved(kind.element(), target, diagnostics);
        }
        found.map(|&(position, _)| position)
    }

    /// Resolves all references, and reports missing targets.
    pub fn resolve(mut self, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
        for (device, target, places) in std::mem::take(&mut self.modules) {
            let module = self.find(ElementKind::Module, &target, diagnostics).map(ModuleId);
            if let (Some(module), Some(device)) = (module, catalog.devices.get_mut(device)) {
                device.modules.push(ModuleUse { module, places });
            }
        }
        for (owner, target, places) in std::mem::take(&mut self.submodules) {
            let Some(submodule) = self.find(ElementKind::Pluggable, &target, diagnostics).map(SubmoduleId) else {
                continue;
            };
            let uses = match owner {
                Owner::Device(at) => catalog.devices.get_mut(at).map(|device| &mut device.submodules),
                Owner::Module(at) => catalog.modules.get_mut(at).map(|module| &mut module.submodules),
            };
            if let Some(uses) = uses {
                uses.push(SubmoduleUse { submodule, places });
            }
        }
        for (kind, target) in std::mem::take(&mut self.others) {
            self.find(kind, &target, diagnostics);
        }
    }
}

/// Reports a reference to an element that does not exist.
pub(super) fn unresolved(element: &str, target: &Given<'_>, diagnostics: &mut Diagnostics) {
    let message = format!("the file has no {element} with the ID `{}`", brief(&target.text));
    let found = codes::UNRESOLVED_TARGET.at(target.span, message).label("the reference is ignored");
    diagnostics.push(found.help("check the spelling; identifiers are case-sensitive"));
}
