//! Values that configure a device, and the values of its objects after the configuration.

use lexibus_codegen::ir::{Device, Value};
use lexibus_codegen::source::Span;

/// A value that is written to an object of a node or of a SubDevice.
#[derive(Clone, Debug, PartialEq)]
pub struct Write {
    /// Index and sub-index.
    pub object: (u16, u8),
    /// The value, converted to the type of the object; `None` for a value that the description already configures.
    pub value: Option<Value>,
    /// The bytes of the value in an SDO transfer.
    pub bytes: Vec<u8>,
    /// Location in the network file for diagnostics; empty for a value that the description already configures.
    pub span: Span,
}

/// Values of the objects of a device: the last value that is written, or the initial value if none is written.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// The device.
    pub device: &'a Device,
    /// Node-ID, for values that depend on it.
    pub id: u8,
    /// Values that are written, in the order of the writes.
    pub writes: &'a [Write],
}

impl Values<'_> {
    /// Returns the value of an object, or `None` if it has no integer value. Values that the description configures are initial
    /// values.
    pub fn get(&self, object: (u16, u8)) -> Option<i128> {
        let last = self.writes.iter().rev().find(|write| write.object == object);
        let written = last.and_then(|write| write.value.as_ref());
        written.or_else(|| self.device.entry(object.0, object.1)?.initial())?.resolved(self.id).as_int()
    }

    /// Returns the value of an object as a number of type `T`. Returns `None` if the object has no integer value, or if the value is
    /// not in the range of `T`.
    pub fn number<T: TryFrom<i128>>(&self, object: (u16, u8)) -> Option<T> {
        self.get(object).and_then(|value| T::try_from(value).ok())
    }

    /// Returns whether the network file sets an object.
    pub fn is_set(&self, object: (u16, u8)) -> bool {
        self.writes.iter().any(|write| write.object == object && write.value.is_some())
    }

    /// Returns the location of the last write to an object; empty if the network file does not set the object.
    pub fn set_at(&self, object: (u16, u8)) -> Span {
        self.writes.iter().rev().find(|write| write.object == object).map_or(Span::MISSING, |write| write.span)
    }
}
