//! The modules in the slots of a modular SubDevice.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::{Binding, Catalog, Device, Fit, Group, GroupKind, Module, Slot};
use lexibus_codegen::number::hex32;
use lexibus_codegen::source::Span;
use lexibus_codegen::text::similar;

use super::declared::{DeclaredModule, DeclaredSubDevice};
use crate::syntax::{At, Scalar};

/// Maximum number of slots: the list of module idents (0xF030) has at most 255 entries.
const MAX_SLOTS: u16 = 255;

/// A module in a slot.
#[derive(Clone, Copy)]
pub(super) struct Plugged<'d> {
    /// Number of the slot, counted from 0.
    pub number: u16,
    pub slot: &'d Slot,
    pub module: &'d Module,
}

/// Amounts that are added to indices that depend on the slot or the slot group.
#[derive(Clone, Copy, Default)]
pub(super) struct Offsets {
    slot: u16,
    group: u16,
}

impl Offsets {
    /// Returns the index in the slot for the index in the description.
    pub fn apply(self, index: u16, depends_on_slot: bool, depends_on_slot_group: bool) -> u16 {
        let slot = if depends_on_slot { self.slot } else { 0 };
        let group = if depends_on_slot_group { self.group } else { 0 };
        index.wrapping_add(slot).wrapping_add(group)
    }
}

impl Plugged<'_> {
    /// Returns a device with the objects of the module. Their indices are those in the slot.
    pub fn objects_in_slot(self) -> Device {
        let Module { name, types, groups, .. } = self.module;
        let mut groups: Vec<Group> = groups.iter().filter_map(|group| in_slot(group, self.objects())).collect();
        // The objects of a device are sorted by index. The offsets can change the order, because only some indices depend on the slot.
        groups.sort_by_key(Group::index);
        Device { name: name.clone(), types: types.clone(), groups, ..Device::default() }
    }

    /// Returns the offsets of object indices.
    pub fn objects(self) -> Offsets {
        self.offsets(self.slot.index_increment, self.slot.group_index_increment)
    }

    /// Returns the offsets of PDO indices.
    pub fn pdos(self) -> Offsets {
        self.offsets(self.slot.pdo_increment, self.slot.group_pdo_increment)
    }

    fn offsets(self, per_slot: u16, per_group: u16) -> Offsets {
        Offsets {
            slot: per_slot.wrapping_mul(self.number),
            group: self.slot.group.map_or(0, |number| per_group.wrapping_mul(number)),
        }
    }
}

/// Returns an object of a module with its index in the slot.
fn in_slot(group: &Group, offsets: Offsets) -> Option<Group> {
    let GroupKind::Object { index, code, category } = group.kind else { return None };
    let index = offsets.apply(index, group.depends_on_slot, group.depends_on_slot_group);
    let mut group = Group { kind: GroupKind::Object { index, code, category }, ..group.clone() };
    for binding in group.items.iter_mut().flat_map(|item| item.bindings.iter_mut()) {
        if let Binding::Object { index: of_item, .. } = binding {
            *of_item = index;
        }
    }
    Some(group)
}

/// A modular device with the modules that it accepts.
struct Modular<'d> {
    device: &'d Device,
    modules: Vec<&'d Module>,
}

/// Returns the modules of a SubDevice, sorted by slot. If the SubDevice has no key `modules`, these are the default modules
/// of the description.
pub(super) fn plug<'d>(
    catalog: &'d Catalog,
    device: &'d Device,
    declared: &DeclaredSubDevice,
    diagnostics: &mut Diagnostics,
) -> Vec<Plugged<'d>> {
    let known = device.modules.iter().filter_map(|usage| catalog.modules.get(usage.module.0 as usize));
    let modular = Modular { device, modules: known.collect() };
    let mut plugged = match &declared.modules {
        None => modular.default_modules(),
        Some(modules) => modular.declared_modules(modules, diagnostics),
    };
    plugged.sort_by_key(|plugged| plugged.number);
    // Otherwise, a rejected module could be reported again as missing.
    if declared.modules.as_ref().is_none_or(|modules| modules.len() == plugged.len()) {
        let span = declared.modules.as_ref().map_or(declared.name.span, |modules| modules.span);
        modular.check_minimum(&plugged, span, diagnostics);
    }
    plugged
}

fn fault(span: Span, message: String) -> Diagnostic {
    Diagnostic::new(&codes::SLOT_MODULE, span, message)
}

fn shown(module: &Module) -> String {
    format!("`{}` ({})", if module.id.is_empty() { &module.name } else { &module.id }, hex32(module.number))
}

fn accepts(slot: &Slot, module: &Module) -> bool {
    let fits = |fit: &Fit| match fit {
        Fit::Ident(ident) => *ident == module.number,
        Fit::Class(class) | Fit::Name(class) => !class.is_empty() && *class == module.class,
    };
    slot.fits.is_empty() || slot.fits.iter().any(fits)
}

impl<'d> Modular<'d> {
    /// Returns each series of slots with the number of its first slot.
    fn series(&self) -> impl Iterator<Item = (u16, &'d Slot)> {
        self.device.slots.iter().scan(0u16, |next, slot| {
            let first = *next;
            *next = first.saturating_add(slot.instances.1);
            Some((first, slot))
        })
    }

    fn slot(&self, number: u16) -> Option<&'d Slot> {
        let mut series = self.series();
        series.find(|(first, slot)| number >= *first && number - first < slot.instances.1).map(|(_, slot)| slot)
    }

    fn count(&self) -> u16 {
        self.device.slots.iter().fold(0u16, |count, slot| count.saturating_add(slot.instances.1))
    }

    fn default_modules(&self) -> Vec<Plugged<'d>> {
        let plugged = |number| {
            let slot = self.slot(number)?;
            let Some(Fit::Ident(ident)) = slot.default else { return None };
            let module = self.modules.iter().find(|module| module.number == ident && accepts(slot, module))?;
            Some(Plugged { number, slot, module })
        };
        (0..self.count().min(MAX_SLOTS)).filter_map(plugged).collect()
    }

    fn declared_modules(&self, modules: &[DeclaredModule], diagnostics: &mut Diagnostics) -> Vec<Plugged<'d>> {
        let mut plugged: Vec<Plugged<'d>> = Vec::new();
        for DeclaredModule { slot, module, .. } in modules {
            if plugged.iter().any(|plugged| plugged.number == slot.value) {
                diagnostics.push(fault(slot.span, format!("slot {} has several modules", slot.value)));
                continue;
            }
            match self.declared_module(slot, module) {
                Ok(module) => plugged.push(module),
                Err(found) => diagnostics.push(*found),
            }
        }
        plugged
    }

    fn declared_module(&self, number: &At<u16>, name: &At<Scalar>) -> Result<Plugged<'d>, Box<Diagnostic>> {
        let Some(slot) = self.slot(number.value).filter(|_| number.value < MAX_SLOTS) else {
            let found = fault(number.span, format!("`{}` has no slot {}", self.device.name, number.value));
            let count = self.count().min(MAX_SLOTS);
            return Err(Box::new(match count {
                0 => found.help("remove `modules`; the device is not modular"),
                _ => found.help(format!("use a slot from 0 to {}", count - 1)),
            }));
        };
        let found: Vec<&Module> = self.modules.iter().copied().filter(|module| is_named(module, name)).collect();
        if let Some(module) = found.iter().find(|module| accepts(slot, module)) {
            return Ok(Plugged { number: number.value, slot, module });
        }
        let accepted = || self.modules.iter().filter(|module| accepts(slot, module));
        let names = accepted().take(8).map(|module| shown(module)).collect::<Vec<_>>().join(", ");
        let help =
            if names.is_empty() { "remove the module".to_owned() } else { format!("use one of the modules {names}") };
        Err(Box::new(match found.first() {
            Some(module) => {
                let message = format!("slot {} does not accept the module {}", number.value, shown(module));
                fault(name.span, message).help(help)
            }
            None => {
                let message = format!("`{}` has no module {}", self.device.name, given(&name.value));
                let ids = accepted().flat_map(|module| [module.id.as_str(), module.name.as_str()]);
                let similar = match &name.value {
                    Scalar::Text(text) => similar(text, ids.filter(|id| !id.is_empty())),
                    _ => None,
                };
                let help = similar.map_or(help, |similar| format!("write `{similar}`"));
                fault(name.span, message).help(help)
            }
        }))
    }

    /// Reports each series of slots that has fewer modules than its minimum.
    fn check_minimum(&self, plugged: &[Plugged<'_>], span: Span, diagnostics: &mut Diagnostics) {
        for (first, slot) in self.series() {
            let (minimum, maximum) = slot.instances;
            let is_inside = |number: u16| number >= first && number - first < maximum;
            let count = plugged.iter().filter(|plugged| is_inside(plugged.number)).count();
            if count < usize::from(minimum) {
                let message = match maximum {
                    0 | 1 => format!("slot {first} (`{}`) has no module", slot.name),
                    _ => {
                        let last = first.saturating_add(maximum - 1);
                        let slots = format!("slots {first} to {last} (`{}`)", slot.name);
                        format!("{slots} have {count} modules, but the minimum is {minimum}")
                    }
                };
                diagnostics.push(fault(span, message).help("declare the modules in `modules`: slot = module"));
            }
        }
    }
}

fn is_named(module: &Module, name: &Scalar) -> bool {
    match name {
        Scalar::Text(text) => [&module.id, &module.name].iter().any(|name| name.eq_ignore_ascii_case(text)),
        Scalar::Integer(ident) => i128::from(module.number) == *ident,
        _ => false,
    }
}

/// Formats the name or ident of a module for a diagnostic.
fn given(name: &Scalar) -> String {
    match name {
        Scalar::Text(text) => format!("`{text}`"),
        Scalar::Integer(ident) => u32::try_from(*ident).map_or_else(|_| ident.to_string(), hex32),
        other => other.described(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::{Item, ObjectCode};

    /// An object that depends on the slot comes after an object that does not, although its index in the description is smaller.
    #[test]
    fn objects_in_a_slot_are_found_by_their_index() {
        let object = |index: u16, depends_on_slot: bool| Group {
            items: vec![Item::new(Binding::canopen(index, 0))],
            depends_on_slot,
            ..Group::object(index, ObjectCode::Var)
        };
        let groups = vec![object(0x6000, true), object(0x6001, false), object(0x6002, true)];
        let module = Module { groups, ..Module::default() };
        let slot = Slot { index_increment: 0x10, ..Slot::default() };
        let device = Plugged { number: 1, slot: &slot, module: &module }.objects_in_slot();
        for index in [0x6001, 0x6010, 0x6012] {
            assert_eq!(device.object(index).and_then(Group::index), Some(index));
            assert_eq!(device.entry(index, 0).and_then(Item::object), Some((index, 0)));
        }
        assert!(device.object(0x6000).is_none() && device.object(0x6002).is_none());
    }
}
