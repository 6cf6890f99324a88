//! Saved parameters.

use std::collections::BTreeMap;
use std::fmt;

use lexibus_codegen::ir::Value;

use crate::address::Address;
use crate::description::Description;
use crate::parameter::Parameter;

/// The saved parameters of a device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Backup {
    /// Node-ID or Modbus server address of the device.
    pub node_id: Option<u8>,
    /// Saved values, in the order of the description or of the TOML file.
    pub entries: Vec<Entry>,
    /// Writable parameters that were not saved; empty if the backup was not read from a device.
    pub skipped: Vec<Skipped>,
}

/// A saved value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Address of the parameter.
    pub address: Address,
    /// Address as text.
    pub address_text: String,
    /// Path of the parameter.
    pub name: String,
    /// The value. It can be a formula with `$NODEID`.
    pub value: Value,
}

impl Entry {
    pub(crate) fn new(parameter: &Parameter<'_>, value: Value) -> Self {
        Self { address: parameter.address(), address_text: parameter.address_text(), name: parameter.path(), value }
    }
}

/// A parameter that was not saved, or not restored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Address of the parameter as text.
    pub address: String,
    /// Path of the parameter.
    pub name: String,
    /// Reason as text.
    pub reason: String,
    /// True if the parameter should be part of the backup or restore, but cannot be saved or restored.
    pub is_failure: bool,
}

impl Skipped {
    pub(crate) fn new(parameter: &Parameter<'_>, reason: impl fmt::Display) -> Self {
        let (address, name) = (parameter.address_text(), parameter.path());
        Self { address, name, reason: reason.to_string(), is_failure: false }
    }

    pub(crate) fn failed(parameter: &Parameter<'_>, reason: impl fmt::Display) -> Self {
        Self { is_failure: true, ..Self::new(parameter, reason) }
    }
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}: {}", self.address, self.name, self.reason)
    }
}

impl Backup {
    /// Returns the values by address.
    #[must_use]
    pub fn values(&self) -> BTreeMap<Address, &Value> {
        self.entries.iter().map(|entry| (entry.address, &entry.value)).collect()
    }

    /// Returns whether no [skipped](Self::skipped) parameter is a [failure](Skipped::is_failure).
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.skipped.iter().any(|skipped| skipped.is_failure)
    }

    /// Returns the configured values of a description, such as the values in a DCF or XDC.
    #[must_use]
    pub fn of_description(description: &Description) -> Self {
        let device = description.device();
        let entries = description.parameters().filter_map(|parameter| {
            let value = parameter.item().configured_value()?;
            Some(Entry::new(&parameter, value.clone()))
        });
        let node_id = device.commissioning.as_ref().and_then(|commissioning| commissioning.node_id);
        Self { node_id, entries: entries.collect(), skipped: Vec::new() }
    }
}
