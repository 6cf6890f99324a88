//! Collects the values that configure a node or a SubDevice, and checks them against its description.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::facts::encoding;
use lexibus_codegen::ir::{Bus, Device, Item, Value};
use lexibus_codegen::source::Span;

use super::object::{address, find};
use super::value::{basic_type, broken_limit, convert};
use crate::declared::{DeclaredParameter, ObjectName};
use crate::syntax::{At, Scalar};
use crate::values::{Values, Write};

/// Collects the values that are written to a node or to a SubDevice.
pub(crate) struct Writer<'a> {
    pub device: &'a Device,
    pub bus: Bus,
    pub id: u8,
    pub writes: Vec<Write>,
    pub diagnostics: &'a mut Diagnostics,
}

impl Writer<'_> {
    /// Returns the initial values of all objects.
    pub fn initial(&self) -> Values<'_> {
        Values { device: self.device, id: self.id, writes: &[] }
    }

    /// Writes a number unless the initial value of the object is the same number.
    pub fn change<T: Copy + Into<i128>>(&mut self, object: (u16, u8), value: Option<&At<T>>) {
        let Some(value) = value else { return };
        let number: i128 = value.value.into();
        if self.initial().get(object) != Some(number) {
            self.write(object, number, value.span);
        }
    }

    /// Writes a number to an object. Reports an object that the device does not have or that cannot be written, and a value that
    /// the object cannot have.
    pub fn write(&mut self, object: (u16, u8), number: impl Into<i128>, span: Span) {
        let name = At::new(ObjectName::Address(object.0, object.1), span);
        self.parameter(&DeclaredParameter { object: name, value: At::new(Scalar::Integer(number.into()), span) });
    }

    /// Writes a declared value. Reports an object that is not found or that cannot be written, and a value that the object cannot
    /// have.
    pub fn parameter(&mut self, parameter: &DeclaredParameter) {
        let Some((item, object)) = find(self.device, &parameter.object, self.diagnostics) else { return };
        let span = parameter.value.span;
        match convert(self.device, item, self.bus, &parameter.value.value, self.id) {
            Err(wrong) => {
                let message = format!("{}: {}", title(item, object), wrong.message);
                let found = Diagnostic::new(&codes::PARAMETER_TYPE, span, message);
                self.diagnostics.push(wrong.help.into_iter().fold(found, Diagnostic::help));
            }
            Ok(value) => {
                self.check(item, object, &value, parameter);
                let Some(bytes) = encoding::bytes(&value, basic_type(self.device, item, self.bus)) else { return };
                self.writes.push(Write { object, value: Some(value), bytes, span });
            }
        }
    }

    /// Reports a value outside of the limits, and an object that cannot be written.
    fn check(&mut self, item: &Item, object: (u16, u8), value: &Value, parameter: &DeclaredParameter) {
        let limits = item.limits_on(self.bus).unwrap_or(&item.limits);
        if let Some(rule) = broken_limit(limits, value, self.id) {
            let message = format!("{}: the value {value} is {rule}", title(item, object));
            self.diagnostics.push(Diagnostic::new(&codes::PARAMETER_RANGE, parameter.value.span, message));
        }
        if !item.access_on(self.bus).writable() {
            let message = format!("{} cannot be written", title(item, object));
            let found = Diagnostic::new(&codes::READ_ONLY_PARAMETER, parameter.object.span, message);
            let access = item.access_on(self.bus).name();
            self.diagnostics.push(
                found.label(format!("the description states the access rights `{access}`")).help("remove the value"),
            );
        }
    }
}

/// Returns the address and name of an item for diagnostics: ``object 0x6081 `Profile velocity` ``.
pub(super) fn title(item: &Item, object: (u16, u8)) -> String {
    format!("object {} `{}`", address(object), item.name)
}
