//! What has objects and PDOs of its own: a device, or a module of a modular one.

use std::cell::OnceCell;
use std::collections::HashMap;

use super::value_type::ValueType;
use crate::facts::words;
use crate::ir::{Device, Group, Item, ItemNames, Manual, Module, ObjectBuses, Pdo, ProcessImage, Shape, Type, TypeDef};

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
    pub types: &'a [TypeDef],
    pub pdos: &'a [Pdo],
    /// The device; a module has none.
    pub device: Option<&'a Device>,
    /// What is known of the manual that the description was taken from.
    pub manual: Manual,
    /// Items by what they are called.
    called: ItemNames<'a>,
    /// The first values of objects by the names of those.
    by_object: OnceCell<HashMap<&'a str, &'a Item>>,
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
        Scope::new(ObjectBus::CoE, &module.groups, &module.types, &module.process_data.pdos)
    }

    fn new(bus: ObjectBus, groups: &'a [Group], types: &'a [TypeDef], pdos: &'a [Pdo]) -> Self {
        Scope {
            bus,
            groups,
            types,
            pdos,
            device: None,
            manual: Manual::default(),
            called: ItemNames::new(groups),
            by_object: OnceCell::new(),
        }
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

    /// The item that other elements of the description call so: by its name, its object's name, its address, or the names
    /// of its chapter and its own (`Chapter/Item`).
    pub fn item(&self, name: &str) -> Option<&'a Item> {
        let by_object = || self.by_object().get(name).copied();
        let found = self.called.by_name(name).or_else(by_object).or_else(|| {
            let (index, sub) = name.split_once(':').unwrap_or((name, "0"));
            let index = u16::from_str_radix(index.trim().strip_prefix("0x")?, 16).ok()?;
            self.object(index)?.sub(sub.trim().parse().ok()?)
        });
        found.or_else(|| self.called.by_path(name))
    }

    /// By its name, the first value of an object.
    fn by_object(&self) -> &HashMap<&'a str, &'a Item> {
        self.by_object.get_or_init(|| {
            let mut first: HashMap<&str, Option<&Item>> = HashMap::new();
            for group in self.groups.iter().filter(|group| group.index().is_some()) {
                first.entry(group.name.as_str()).or_insert(group.items.first());
            }
            first.into_iter().filter_map(|(name, item)| Some((name, item?))).collect()
        })
    }
}
