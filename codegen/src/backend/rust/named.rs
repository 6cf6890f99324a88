//! Enumerations, bit fields and state machines, ready to be printed.

use super::bit_field::{self, BitFieldModel};
use super::context::Context;
use super::enumeration::{self, EnumerationModel};
use super::machine::{self, MachineModel};
use super::naming::machines::NamedMachine;
use super::options::RustOptions;

/// The enumerations, bit fields and state machines of a device or module, ready to be printed.
#[derive(Default)]
pub(super) struct Types {
    /// Enumerations, each with the position of its definition in the list of types.
    pub enumerations: Vec<(u32, EnumerationModel)>,
    /// Bit fields, each with the position of its definition in the list of types.
    pub bit_fields: Vec<(u32, BitFieldModel)>,
    pub machines: Vec<MachineModel>,
    /// True if the device has bit fields. Bit fields that an earlier device defines are included.
    pub has_bit_fields: bool,
}

impl Types {
    pub(super) fn of<'a>(context: &'a Context<'_>, options: &RustOptions) -> Self {
        let names = &context.names.types;
        let methods = |machine: &'a NamedMachine<'_>| {
            [&machine.command_setter, &machine.getter, &machine.constructor, &machine.command_getter]
        };
        let machine_methods: Vec<&str> = names.machines.iter().flat_map(methods).map(String::as_str).collect();
        let enumerations = names.enumerations.iter();
        let enumerations: Vec<_> =
            enumerations.map(|(at, named)| (*at, enumeration::model(context, *at, named, options))).collect();
        let bit_field = |(at, named, views): &(_, _, Vec<_>)| {
            (*at, bit_field::model(context, *at, named, views, &machine_methods, options))
        };
        let bit_fields: Vec<_> = names.bit_fields.iter().map(bit_field).collect();
        let machines = machine::models(context, &bit_fields, &enumerations, options);
        Types { has_bit_fields: !bit_fields.is_empty(), enumerations, bit_fields, machines }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.enumerations.is_empty() && self.bit_fields.is_empty() && self.machines.is_empty()
    }

    /// Returns whether the code of the types contains a path into the runtime crate.
    pub(super) fn names_runtime(&self) -> bool {
        let has_values = !self.enumerations.is_empty() || !self.bit_fields.is_empty();
        has_values || self.machines.iter().any(MachineModel::uses_runtime)
    }
}
