//! Findings of a comparison.

use std::fmt;

use lexibus_codegen::number;
use serde::Serialize;

use crate::failure::Failure;
use crate::parameter::Parameter;

/// The kind of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// The description declares the parameter, but the device doesn't have it.
    Missing,
    /// The device has the object or sub-index, but the description doesn't declare it.
    Extra,
    /// A fact of the device differs from the description.
    Different,
    /// The device didn't transfer the value of the parameter.
    Unreadable,
    /// A fact cannot be verified, for example because the parameter must not be read.
    Unverifiable,
    /// The value of a writable parameter differs from the default value. This is not a deviation.
    Changed,
}

impl FindingKind {
    /// All kinds, in the order of the report.
    pub const ALL: [FindingKind; 6] = [
        FindingKind::Missing,
        FindingKind::Extra,
        FindingKind::Different,
        FindingKind::Unreadable,
        FindingKind::Unverifiable,
        FindingKind::Changed,
    ];

    /// Returns the name of the kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            FindingKind::Missing => "missing",
            FindingKind::Extra => "extra",
            FindingKind::Different => "different",
            FindingKind::Unreadable => "unreadable",
            FindingKind::Unverifiable => "unverifiable",
            FindingKind::Changed => "changed",
        }
    }

    /// Returns whether findings of this kind are deviations: all except unverifiable facts and changed values.
    #[must_use]
    pub fn is_deviation(self) -> bool {
        !matches!(self, FindingKind::Unverifiable | FindingKind::Changed)
    }
}

impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The fact about the device that an overlay can state.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// The device doesn't have the parameter.
    Nothing,
    /// The value has this length in bytes.
    Length(usize),
    /// The parameter can be read, although it is declared as write-only.
    Readable,
    /// The parameter cannot be read, although it is declared as readable.
    WriteOnly,
    /// The device has an object or sub-index that the description doesn't declare. The field is the length of its value, if it can be
    /// read.
    Object(Option<usize>),
    /// No fact that an overlay can state.
    Other,
}

/// A finding about a parameter, an object or the whole device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Kind of the finding.
    pub kind: FindingKind,
    /// Address of the parameter or object, or `identity` for the identity of a Modbus device.
    pub address: String,
    /// Path of the parameter, or name of a missing object; empty for an undeclared object or sub-index and for the whole device.
    pub name: String,
    /// The fact that differs, or the reason for the finding, as text.
    pub message: String,
    /// What the description declares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub declared: Option<String>,
    /// What the device has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub actual: Option<String>,
    /// SDO abort code, if the device sent one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub abort_code: Option<u32>,
    /// The fact that an overlay can state.
    #[serde(skip)]
    pub found: Found,
}

impl Finding {
    /// Creates a finding about a parameter.
    pub(super) fn of(parameter: &Parameter<'_>, kind: FindingKind, message: impl Into<String>) -> Self {
        Self::new(kind, parameter.address_text(), parameter.path(), message.into())
    }

    /// Creates a finding of the kind `Extra` about an object or sub-index that the description doesn't declare.
    pub(super) fn of_object(index: u16, sub_index: u8, message: impl Into<String>) -> Self {
        Self::new(FindingKind::Extra, number::object(index, sub_index), String::new(), message.into())
    }

    /// Creates a finding about a fact of the whole device.
    pub(super) fn of_device(kind: FindingKind, fact: &str, message: impl Into<String>) -> Self {
        Self::new(kind, fact.to_owned(), String::new(), message.into())
    }

    fn new(kind: FindingKind, address: String, name: String, message: String) -> Self {
        Self { kind, address, name, message, declared: None, actual: None, abort_code: None, found: Found::Other }
    }

    /// Adds what the description declares and what the device has.
    pub(super) fn compared(self, declared: impl Into<String>, actual: impl Into<String>) -> Self {
        Self { declared: Some(declared.into()), actual: Some(actual.into()), ..self }
    }

    pub(super) fn failed(self, failure: &Failure) -> Self {
        Self { abort_code: failure.abort_code().map(|code| code.0), ..self }
    }

    pub(super) fn found(self, found: Found) -> Self {
        Self { found, ..self }
    }
}

impl fmt::Display for Finding {
    /// Writes one line: `different: 0x6083:00 Profile acceleration: length: declared UNSIGNED32, found 2 bytes`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind, self.address)?;
        if !self.name.is_empty() {
            write!(f, " {}", self.name)?;
        }
        write!(f, ": {}", self.message)?;
        match (&self.declared, &self.actual) {
            (Some(declared), Some(actual)) => write!(f, ": declared {declared}, found {actual}"),
            _ => Ok(()),
        }
    }
}
