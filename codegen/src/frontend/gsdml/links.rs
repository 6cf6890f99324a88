//! Elements by their identifiers, and references to them, which may come first.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::xml::Given;
use crate::ir::{Catalog, ModuleId, ModuleUse, Places, SubmoduleId, SubmoduleUse};
use crate::source::Span;
use crate::text::brief;

/// Kinds of elements: an identifier is unique among those of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    AccessPoint,
    Module,
    /// VirtualSubmoduleItem, InterfaceSubmoduleItem, and ports that can't be pulled.
    BuiltIn,
    /// An element of SubmoduleList.
    Pluggable,
    Value,
    Graphic,
    Category,
}

impl Kind {
    /// The element that has the identifier.
    fn element(self) -> &'static str {
        match self {
            Kind::AccessPoint => "DeviceAccessPointItem",
            Kind::Module => "ModuleItem",
            Kind::BuiltIn => "VirtualSubmoduleItem",
            Kind::Pluggable => "SubmoduleItem",
            Kind::Value => "ValueItem",
            Kind::Graphic => "GraphicItem",
            Kind::Category => "CategoryItem",
        }
    }
}

/// Which element has what can be plugged in.
#[derive(Clone, Copy, Debug)]
pub(super) enum Owner {
    /// The device access point at this position.
    Device(usize),
    /// The module at this position.
    Module(usize),
}

#[derive(Default)]
pub(super) struct Links<'a> {
    ids: HashMap<(Kind, Cow<'a, str>), (u32, Span)>,
    modules: Vec<(usize, Given<'a>, Places)>,
    submodules: Vec<(Owner, Given<'a>, Places)>,
    /// References that only have to lead somewhere.
    others: Vec<(Kind, Given<'a>)>,
}

impl<'a> Links<'a> {
    /// Registers the identifier of an element at `position`. Returns the identifier of an earlier element if it has the same.
    pub fn register(&mut self, kind: Kind, id: &Given<'a>, position: usize) -> Option<Span> {
        let element = (u32::try_from(position).unwrap_or(u32::MAX), id.span);
        let (_, first) = *self.ids.entry((kind, id.text.clone())).or_insert(element);
        (first != id.span).then_some(first)
    }

    /// A module that can be plugged into the device at `device`.
    pub fn module(&mut self, device: usize, target: Given<'a>, places: Places) {
        self.modules.push((device, target, places));
    }

    /// A submodule that can be plugged into `owner`.
    pub fn submodule(&mut self, owner: Owner, target: Given<'a>, places: Places) {
        self.submodules.push((owner, target, places));
    }

    /// A reference that is kept as it is written.
    pub fn mention(&mut self, kind: Kind, target: &Given<'a>) {
        self.others.push((kind, target.clone()));
    }

    fn find(&self, kind: Kind, target: &Given<'a>, diagnostics: &mut Diagnostics) -> Option<u32> {
        let found = self.ids.get(&(kind, target.text.clone()));
        if found.is_none() {
            unresolved(kind.element(), target, diagnostics);
        }
        found.map(|&(position, _)| position)
    }

    /// Follows all references.
    pub fn resolve(mut self, catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
        for (device, target, places) in std::mem::take(&mut self.modules) {
            let module = self.find(Kind::Module, &target, diagnostics).map(ModuleId);
            if let (Some(module), Some(device)) = (module, catalog.devices.get_mut(device)) {
                device.modules.push(ModuleUse { module, places });
            }
        }
        for (owner, target, places) in std::mem::take(&mut self.submodules) {
            let Some(submodule) = self.find(Kind::Pluggable, &target, diagnostics).map(SubmoduleId) else { continue };
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

/// Reports a reference that leads nowhere.
pub(super) fn unresolved(element: &str, target: &Given<'_>, diagnostics: &mut Diagnostics) {
    let message = format!("no {element} has the ID `{}`", brief(&target.text));
    diagnostics.push(
        Diagnostic::new(&codes::UNRESOLVED_TARGET, target.span, message)
            .label("the reference leads nowhere")
            .help("identifiers are compared letter by letter, in their case"),
    );
}
