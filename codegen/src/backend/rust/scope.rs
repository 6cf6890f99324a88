//! What has objects and PDOs of its own: a device, or a module of a modular one.

use super::value_type::ValueType;
use crate::facts::words;
use crate::ir::{
    Device, Group, Item, ItemId, ItemRef, Manual, Module, ObjectBuses, Pdo, ProcessImage, Shape, Type, TypeDef,
};

/// The bus on which objects are addressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ObjectBus {
    CanOpen,
    CoE,
}

/// A device or a module, with the types that it defines.
pub(super) struct Scope<'a> {
    pub bus: ObjectBus,
    pub groups: &'a [Group],
    /// The position of the first of them, as ids count them.
    first_group: u32,
    pub types: &'a [TypeDef],
    pub pdos: &'a [Pdo],
    /// The device; a module has none.
    pub device: Option<&'a Device>,
    /// What is known of the manual that the description was taken from.
    pub manual: Manual,
}

impl<'a> Scope<'a> {
    /// A device.
    pub fn of_device(device: &'a Device) -> Self {
        let bus = if device.ethercat.is_some() || device.dictionary_only { ObjectBus::CoE } else { ObjectBus::CanOpen };
        let scope = Scope::new(bus, &device.groups, &device.types, &device.process_data.pdos);
        Scope { manual: words::manual(device), device: Some(device), ..scope }
    }

    /// A module.
    pub fn of_module(module: &'a Module) -> Self {
        let scope = Scope::new(ObjectBus::CoE, &module.groups, &module.types, &module.process_data.pdos);
        Scope { first_group: module.fixed_objects.len() as u32, ..scope }
    }

    fn new(bus: ObjectBus, groups: &'a [Group], types: &'a [TypeDef], pdos: &'a [Pdo]) -> Self {
        Scope { bus, groups, first_group: 0, types, pdos, device: None, manual: Manual::default() }
    }

    /// The object with this index.
    pub fn object(&self, index: u16) -> Option<&'a Group> {
        let position = self.groups.binary_search_by_key(&Some(index), Group::index).ok()?;
        self.groups.get(position)
    }

    /// The bus of a PDO: that of the device, or the only one that the PDO is on.
    pub fn bus_of(&self, pdo: &Pdo) -> ObjectBus {
        match pdo.buses {
            Some(ObjectBuses::COE) => ObjectBus::CoE,
            Some(ObjectBuses::CANOPEN) => ObjectBus::CanOpen,
            _ => self.bus,
        }
    }

    /// The fixed process image of this name.
    pub fn image(&self, name: &str) -> Option<&'a ProcessImage> {
        self.device?.process_data.images.iter().find(|image| image.name == name)
    }

    /// What a type comes down to: a basic one, or one with a shape of its own.
    pub fn resolve(&self, ty: Type) -> (Type, Option<(u32, &'a TypeDef)>) {
        /// Longer chains of names are a circle.
        const DEPTH: usize = 16;
        let mut ty = ty;
        for _ in 0..DEPTH {
            let Type::Named(id) = ty else { return (ty, None) };
            let Some(definition) = self.types.get(id.0 as usize) else { break };
            match &definition.shape {
                Shape::Alias(other) => ty = *other,
                Shape::Enumeration { base, .. } | Shape::BitField { base, .. } | Shape::Scaled { base, .. } => {
                    return (*base, Some((id.0, definition)))
                }
                Shape::Array { .. } | Shape::Record(_) => return (Type::Opaque(None), Some((id.0, definition))),
            }
        }
        (Type::Opaque(None), None)
    }

    /// The basic type behind a type.
    pub fn base(&self, ty: Type) -> Type {
        let (base, _) = self.resolve(ty);
        match base {
            Type::Named(_) => self.resolve(base).0,
            basic => basic,
        }
    }

    /// How values of a type are written.
    pub fn value_type(&self, ty: Type) -> ValueType {
        ValueType::of(self.base(ty))
    }

    /// The groups with their positions, as ids count them.
    pub fn positioned_groups(&self) -> impl Iterator<Item = (u32, &'a Group)> + use<'a> {
        (self.first_group..).zip(self.groups)
    }

    /// The item with this id.
    pub fn item(&self, id: ItemId) -> Option<&'a Item> {
        ItemId { group: id.group.checked_sub(self.first_group)?, ..id }.of(self.groups)
    }

    /// The item that a reference leads to.
    pub fn referred(&self, reference: &ItemRef) -> Option<&'a Item> {
        self.item(reference.id?)
    }
}
