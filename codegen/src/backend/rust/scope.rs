//! What has objects and PDOs of its own: a device, or a module of a modular one.

use super::enumeration::{self, EnumerationModel};
use super::options::RustOptions;
use super::value_type::ValueType;
use crate::ir::{Device, Group, Module, Pdo, Shape, Type, TypeDef};

/// The bus on which objects are addressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ObjectBus {
    CanOpen,
    CoE,
}

impl ObjectBus {
    /// The type of the location.
    pub fn location(self) -> &'static str {
        match self {
            ObjectBus::CanOpen => "rt::OnCanOpen",
            ObjectBus::CoE => "rt::OnCoE",
        }
    }

    /// The call that makes a location, without its arguments.
    pub fn address(self) -> &'static str {
        match self {
            ObjectBus::CanOpen => "rt::OnCanOpen::canopen",
            ObjectBus::CoE => "rt::OnCoE::coe",
        }
    }
}

/// A device or a module, with its enumerations ready to be written.
pub(super) struct Scope<'a> {
    pub bus: ObjectBus,
    pub groups: &'a [Group],
    pub types: &'a [TypeDef],
    pub pdos: &'a [Pdo],
    /// The enumerations that an item or a PDO has, by the position of their types.
    pub enumerations: Vec<(u32, EnumerationModel)>,
}

impl<'a> Scope<'a> {
    pub fn of_device(device: &'a Device, options: &RustOptions) -> Self {
        let bus = if device.ethercat.is_some() || device.dictionary_only { ObjectBus::CoE } else { ObjectBus::CanOpen };
        Scope::new(bus, &device.groups, &device.types, &device.process_data.pdos, options)
    }

    pub fn of_module(module: &'a Module, options: &RustOptions) -> Self {
        Scope::new(ObjectBus::CoE, &module.groups, &module.types, &module.process_data.pdos, options)
    }

    fn new(bus: ObjectBus, groups: &'a [Group], types: &'a [TypeDef], pdos: &'a [Pdo], options: &RustOptions) -> Self {
        let mut scope = Scope { bus, groups, types, pdos, enumerations: Vec::new() };
        scope.enumerations = enumeration::models(&scope, options);
        scope
    }

    /// The object with this index.
    pub fn object(&self, index: u16) -> Option<&'a Group> {
        let position = self.groups.binary_search_by_key(&Some(index), Group::index).ok()?;
        self.groups.get(position)
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

    /// The enumeration of a type that is one.
    pub fn enumeration(&self, ty: Type) -> Option<&EnumerationModel> {
        let (_, definition) = self.resolve(ty);
        let (position, _) = definition?;
        self.enumerations.iter().find(|(own, _)| *own == position).map(|(_, model)| model)
    }
}
