//! Devices and modules of modular devices, as owners of objects and PDOs.

use super::value_type::ValueType;
use crate::facts::words;
use crate::ir::{
    Device, Group, ImageRef, Item, ItemId, ItemRef, Manual, Module, ObjectBuses, Pdo, ProcessImage, Shape, Type,
    TypeDef,
};

/// The bus on which a device's objects are addressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ObjectBus {
    CanOpen,
    CoE,
}

/// A device or module with the types that it defines.
pub(super) struct Scope<'a> {
    pub bus: ObjectBus,
    pub groups: &'a [Group],
    /// Group number of the first group in item IDs.
    first_group: u32,
    pub types: &'a [TypeDef],
    pub pdos: &'a [Pdo],
    /// The device. `None` if the scope is a module.
    pub device: Option<&'a Device>,
    /// The manual from which the description was transcribed.
    pub manual: Manual,
}

impl<'a> Scope<'a> {
    /// Creates the scope of a device.
    pub fn of_device(device: &'a Device) -> Self {
        let bus = if device.ethercat.is_some() || device.dictionary_only { ObjectBus::CoE } else { ObjectBus::CanOpen };
        let scope = Scope::new(bus, &device.groups, &device.types, &device.process_data.pdos);
        Scope { manual: words::manual(device), device: Some(device), ..scope }
    }

    /// Creates the scope of a module.
    pub fn of_module(module: &'a Module) -> Self {
        let scope = Scope::new(ObjectBus::CoE, &module.groups, &module.types, &module.process_data.pdos);
        Scope { first_group: module.fixed_objects.len() as u32, ..scope }
    }

    fn new(bus: ObjectBus, groups: &'a [Group], types: &'a [TypeDef], pdos: &'a [Pdo]) -> Self {
        Scope { bus, groups, first_group: 0, types, pdos, device: None, manual: Manual::default() }
    }

    /// Returns the object with this index.
    pub fn object(&self, index: u16) -> Option<&'a Group> {
        let position = self.groups.binary_search_by_key(&Some(index), Group::index).ok()?;
        self.groups.get(position)
    }

    /// Returns the bus of a PDO. If the description does not limit the PDO to one bus, returns the bus of the device or
    /// module.
    pub fn bus_of(&self, pdo: &Pdo) -> ObjectBus {
        match pdo.buses {
            Some(ObjectBuses::COE) => ObjectBus::CoE,
            Some(ObjectBuses::CANOPEN) => ObjectBus::CanOpen,
            _ => self.bus,
        }
    }

    /// Returns whether a PDO can be transferred on EtherCAT.
    pub fn is_on_ethercat(&self, pdo: &Pdo) -> bool {
        pdo.buses.map_or(self.bus == ObjectBus::CoE, |buses| buses.coe)
    }

    /// Returns the referenced process image.
    pub fn image(&self, reference: &ImageRef) -> Option<&'a ProcessImage> {
        self.device?.image(reference)
    }

    /// Resolves aliases of a type. Returns the resulting type: a basic type, or the base type of an enumeration, bit
    /// field or scaled type. Arrays, records and cycles result in `Type::Opaque`. If the chain of aliases ends at a
    /// definition, also returns this definition and its position in `types`.
    pub fn resolve(&self, ty: Type) -> (Type, Option<(u32, &'a TypeDef)>) {
        /// Maximum length of a chain of type aliases. A longer chain is treated as a cycle.
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

    /// Returns the basic type of a type.
    pub fn base(&self, ty: Type) -> Type {
        let (base, _) = self.resolve(ty);
        match base {
            Type::Named(_) => self.resolve(base).0,
            basic => basic,
        }
    }

    /// Returns the Rust type for values of a type.
    pub fn value_type(&self, ty: Type) -> ValueType {
        ValueType::of(self.base(ty))
    }

    /// Returns the groups with their group numbers in item IDs.
    pub fn positioned_groups(&self) -> impl Iterator<Item = (u32, &'a Group)> + use<'a> {
        (self.first_group..).zip(self.groups)
    }

    /// Returns the item with this ID.
    pub fn item(&self, id: ItemId) -> Option<&'a Item> {
        ItemId { group: id.group.checked_sub(self.first_group)?, ..id }.of(self.groups)
    }

    /// Returns the referenced item.
    pub fn referred(&self, reference: &ItemRef) -> Option<&'a Item> {
        self.item(reference.id?)
    }
}
