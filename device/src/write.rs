//! Writes of single values.

use std::error::Error;
use std::fmt;

use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{Condition, Value};

use crate::connection::Connection;
use crate::failure::Failure;
use crate::parameter::Parameter;
use crate::parse::ParseError;

/// A checked write of a value to a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Write<'d> {
    parameter: Parameter<'d>,
    value: Value,
    bytes: Vec<u8>,
}

/// The reason why a write failed.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WriteError {
    /// The text isn't a value of the parameter.
    Parse(ParseError),
    /// The parameter is read-only or constant.
    ReadOnly,
    /// The value isn't a value of the type, or depends on an unknown node-ID. The field is the type.
    NoValue(String),
    /// The value is outside the limits, or is not one of the writable values, of the description. The fields are the
    /// reason, and the range or the writable values.
    Excluded(String, String),
    /// The description allows writing only while a condition holds, and the condition doesn't hold or cannot be
    /// checked.
    Condition(String),
    /// The write failed, or a value that a condition needs could not be read.
    Failed(Failure),
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WriteError::Parse(error) => error.fmt(f),
            WriteError::ReadOnly => f.write_str("the parameter is read-only"),
            WriteError::NoValue(ty) => write!(f, "the value does not fit the type {ty}"),
            WriteError::Excluded(reason, range) if range.is_empty() => write!(f, "the value is {reason}"),
            WriteError::Excluded(reason, range) => write!(f, "the value is {reason}; the range is {range}"),
            WriteError::Condition(condition) => write!(f, "the value can be written only while {condition}"),
            WriteError::Failed(failure) => failure.fmt(f),
        }
    }
}

impl Error for WriteError {}

impl From<ParseError> for WriteError {
    fn from(error: ParseError) -> Self {
        WriteError::Parse(error)
    }
}

impl From<Failure> for WriteError {
    fn from(failure: Failure) -> Self {
        WriteError::Failed(failure)
    }
}

impl<'d> Write<'d> {
    /// Parses and checks a value. `node_id` is the node-ID of the device, for formulas.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Parameter::parse`] and [`Write::new`].
    pub fn parse(parameter: Parameter<'d>, text: &str, node_id: Option<u8>) -> Result<Self, WriteError> {
        Self::new(parameter, parameter.parse(text)?, node_id)
    }

    /// Creates a write. Checks the value against the access rights, the type, the limits and the writable values of the
    /// parameter. Nothing is sent.
    ///
    /// # Errors
    ///
    /// Fails if the description doesn't allow this value, or if the value depends on the node-ID and `node_id` is `None`.
    pub fn new(parameter: Parameter<'d>, value: Value, node_id: Option<u8>) -> Result<Self, WriteError> {
        if !parameter.access().writable() {
            return Err(WriteError::ReadOnly);
        }
        let value = node_id.map_or_else(|| value.clone(), |node_id| value.resolved(node_id));
        let no_value = || WriteError::NoValue(parameter.basic().with_length());
        let is_finite = !matches!(value, Value::Real(number) if !number.is_finite());
        let bytes = parameter.encode(&value, node_id).filter(|_| is_finite).ok_or_else(no_value)?;
        if let Some(reason) = parameter.excluded(&value, node_id) {
            return Err(WriteError::Excluded(reason, parameter.range()));
        }
        let writable = parameter.behavior().map_or(&[][..], |behavior| &behavior.writable_values);
        if !writable.is_empty() && !writable.contains(&value) {
            let values: Vec<String> = writable.iter().map(|value| parameter.text(value)).collect();
            return Err(WriteError::Excluded("not one of the writable values".to_owned(), values.join(", ")));
        }
        Ok(Self { parameter, value, bytes })
    }

    /// Creates a write without checks. A restore derives such writes from values that it checked.
    pub(crate) fn unchecked(parameter: Parameter<'d>, value: Value, bytes: Vec<u8>) -> Self {
        Self { parameter, value, bytes }
    }

    /// Returns the parameter.
    #[must_use]
    pub fn parameter(&self) -> Parameter<'d> {
        self.parameter
    }

    /// Returns the value.
    #[must_use]
    pub fn value(&self) -> &Value {
        &self.value
    }

    /// Returns the bytes of the value.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Checks the conditions under which the description allows the write. Reads the items that the conditions name.
    ///
    /// # Errors
    ///
    /// Fails if a condition doesn't hold or cannot be checked.
    pub fn check_conditions(&self, connection: &mut impl Connection) -> Result<(), WriteError> {
        let conditions = self.parameter.behavior().map_or(&[][..], |behavior| &behavior.write_when);
        conditions.iter().try_for_each(|condition| self.check_condition(condition, connection))
    }

    fn check_condition(&self, condition: &Condition, connection: &mut impl Connection) -> Result<(), WriteError> {
        let description = self.parameter.description();
        let text = || WriteError::Condition(PLAIN.holds(condition));
        let item = description.device().referred(&condition.item).ok_or_else(text)?;
        let mut parameters = description.parameters();
        let parameter = parameters.find(|parameter| std::ptr::eq(parameter.item(), item)).ok_or_else(text)?;
        let value = parameter.read(connection)?.value.ok_or_else(text)?;
        let masked = match (condition.mask, value.as_int()) {
            (Some(mask), Some(number)) => Value::Int(number & i128::from(mask)),
            (_, Some(number)) => Value::Int(number),
            _ => value,
        };
        if condition.values.iter().any(|value| value.compare(&masked) == Some(std::cmp::Ordering::Equal)) {
            Ok(())
        } else {
            Err(text())
        }
    }

    /// Checks the conditions and writes the value.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`check_conditions`](Self::check_conditions), or the reason why the value was not transferred.
    pub fn execute(&self, connection: &mut impl Connection) -> Result<(), WriteError> {
        self.check_conditions(connection)?;
        Ok(connection.write(self.parameter.address(), &self.bytes)?)
    }
}

impl fmt::Display for Write<'_> {
    /// Writes the parameter and the value: `0x6081:00 Profile velocity = 20000`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            Value::Bytes(bytes) => write!(f, "{} = {}", self.parameter, lexibus_codegen::number::bytes(bytes)),
            value => write!(f, "{} = {}", self.parameter, self.parameter.text(value)),
        }
    }
}
