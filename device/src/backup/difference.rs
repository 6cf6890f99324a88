//! Comparison of two backups.

use std::fmt;

use lexibus_codegen::ir::Value;

use super::entry::{Backup, Entry};
use crate::description::Description;

/// A parameter whose value differs between two backups, or that only one of them contains.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Address of the parameter as text.
    pub address: String,
    /// Path of the parameter.
    pub name: String,
    /// Value in the first backup as text; `None` if the first backup doesn't contain the parameter.
    pub old: Option<String>,
    /// Value in the second backup as text; `None` if the second backup doesn't contain the parameter.
    pub new: Option<String>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = |value: &Option<String>| value.clone().unwrap_or_else(|| "not in the backup".to_owned());
        write!(f, "{} {}: {}, now {}", self.address, self.name, value(&self.old), value(&self.new))
    }
}

/// Returns the differences between two backups of devices with the same description. Parameters that only the second
/// backup contains come last. Values relative to the node-ID are compared as formulas.
#[must_use]
pub fn difference(description: &Description, old: &Backup, new: &Backup) -> Vec<Difference> {
    let text = |entry: &Entry, value: &Value| {
        let parameter = description.at(entry.address);
        parameter.map_or_else(|| value.to_string(), |parameter| parameter.text(value))
    };
    let of = |entry: &Entry, old: Option<&Value>, new: Option<&Value>| Difference {
        address: entry.address_text.clone(),
        name: entry.name.clone(),
        old: old.map(|value| text(entry, value)),
        new: new.map(|value| text(entry, value)),
    };
    let (old_values, new_values) = (old.values(), new.values());
    let changed = old.entries.iter().filter_map(|entry| {
        let found = new_values.get(&entry.address).copied();
        (found != Some(&entry.value)).then(|| of(entry, Some(&entry.value), found))
    });
    let added = new.entries.iter().filter(|entry| !old_values.contains_key(&entry.address));
    changed.chain(added.map(|entry| of(entry, None, Some(&entry.value)))).collect()
}
