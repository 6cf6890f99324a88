//! Filters that select devices, modules and objects. `resolve` removes the elements that no filter matches.
//!
//! A vendor file can describe hundreds of devices. The compiler reads all devices and modules, but checks only the selected devices
//! and modules, and generates code only for them.

pub mod arguments;

use std::fmt;
use std::str::FromStr;

use crate::ir::{Device, Module, Submodule};
use crate::number::{hex16, hex32};
use crate::text::glob;

/// Filters that select devices, modules, submodules and objects of a description. An empty list selects all elements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Filters that select devices.
    pub devices: Vec<DeviceFilter>,
    /// Filters that select modules and submodules. Built-in modules and submodules are always selected.
    pub modules: Vec<Filter>,
    /// Filters that select objects.
    pub objects: Vec<ObjectFilter>,
    /// True if the filters for objects also select the PDOs of devices, by the indices of their mapping objects. An export to EDS needs
    /// this, because it writes the mapping object of each PDO. Generated code contains all PDOs.
    pub pdos: bool,
}

impl Selection {
    pub(crate) fn has_object(&self, index: u16) -> bool {
        self.objects.is_empty() || self.objects.iter().any(|filter| (filter.first..=filter.last).contains(&index))
    }
}

/// A filter that selects elements by name or number.
///
/// The numbers `0x2521` and `9505` match a product code or an ident number. Any text, including a number, can match a name, an
/// order code or an identifier. Case is ignored, and `*` matches any characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Text of the filter as the user typed it.
    typed: String,
    /// Text of the filter in lower case.
    text: String,
    number: Option<u32>,
}

impl Filter {
    fn new(text: &str) -> Self {
        let typed = text.trim();
        Filter { typed: typed.to_owned(), text: typed.to_lowercase(), number: number(typed) }
    }

    /// Returns the text of the filter in lower case.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn matches(&self, number: Option<u32>, names: &[&str]) -> bool {
        (self.number.is_some() && self.number == number)
            || names.iter().any(|name| !name.is_empty() && glob(&self.text, &name.to_lowercase()))
    }
}

impl From<&str> for Filter {
    fn from(text: &str) -> Self {
        Filter::new(text)
    }
}

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.typed)
    }
}

/// A filter for devices by name, order code, identifier or product code, and optionally by revision.
///
/// Examples are `EL3004`, `0x0BBC3052`, `EL3004@0x00110000` and `EL3004@latest`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceFilter {
    device: Filter,
    revision: Option<Revision>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Revision {
    Number(u32),
    Latest,
}

impl FromStr for DeviceFilter {
    type Err = SelectionError;

    fn from_str(text: &str) -> Result<Self, SelectionError> {
        let (device, revision) = match text.rsplit_once('@') {
            None => (text, None),
            Some((device, "latest")) => (device, Some(Revision::Latest)),
            Some((device, revision)) => match number(revision.trim()) {
                Some(number) => (device, Some(Revision::Number(number))),
                // A name can contain an at sign, so the text after `@` need not be a revision.
                None => (text, None),
            },
        };
        if device.trim().is_empty() {
            return Err(SelectionError(format!("`{text}` does not name a device: expected a name or a product code")));
        }
        Ok(DeviceFilter { device: Filter::new(device), revision })
    }
}

impl fmt::Display for DeviceFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.device)?;
        match self.revision {
            None => Ok(()),
            Some(Revision::Latest) => f.write_str("@latest"),
            Some(Revision::Number(number)) => write!(f, "@{}", hex32(number)),
        }
    }
}

/// A filter for objects by index: `0x6040`, or a range that includes both limits, `0x6000..0x67FF`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectFilter {
    pub(crate) first: u16,
    pub(crate) last: u16,
}

impl FromStr for ObjectFilter {
    type Err = SelectionError;

    fn from_str(text: &str) -> Result<Self, SelectionError> {
        let index = |text: &str| number(text.trim()).and_then(|number| u16::try_from(number).ok());
        let (first, last) = text.split_once("..").unwrap_or((text, text));
        match (index(first), index(last)) {
            (Some(first), Some(last)) if first <= last => Ok(ObjectFilter { first, last }),
            _ => Err(SelectionError(format!("`{text}` is not an index: expected 0x6040 or 0x6000..0x67FF"))),
        }
    }
}

impl fmt::Display for ObjectFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", hex16(self.first))?;
        if self.last != self.first {
            write!(f, "..{}", hex16(self.last))?;
        }
        Ok(())
    }
}

/// The reason why a text is not a valid filter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SelectionError(String);

impl fmt::Display for SelectionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for SelectionError {}

fn number(text: &str) -> Option<u32> {
    match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).or_else(|| text.strip_prefix("#x")) {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

impl DeviceFilter {
    /// Returns the filter without the revision.
    pub(crate) fn device(&self) -> &Filter {
        &self.device
    }

    /// Returns whether the filter selects the latest revision.
    pub(crate) fn is_latest(&self) -> bool {
        self.revision == Some(Revision::Latest)
    }

    pub(crate) fn matches(&self, device: &Device) -> bool {
        let identity = &device.identity;
        let revision = match self.revision {
            Some(Revision::Number(number)) => identity.revision_number == Some(number),
            Some(Revision::Latest) | None => true,
        };
        revision && self.device.matches(identity.product_code, &device_names(device))
    }
}

pub(crate) fn device_names(device: &Device) -> [&str; 4] {
    let identity = &device.identity;
    [&device.name, &identity.order_code, &device.id, &identity.product_name]
}

pub(crate) fn module_names(module: &Module) -> [&str; 3] {
    [&module.name, &module.id, &module.identity.order_code]
}

pub(crate) fn submodule_names(submodule: &Submodule) -> [&str; 3] {
    [&submodule.name, &submodule.id, &submodule.identity.order_code]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_by_index_and_range() {
        let parse = |text: &str| text.parse::<ObjectFilter>();
        assert_eq!(parse("0x6000..0x67FF"), Ok(ObjectFilter { first: 0x6000, last: 0x67FF }));
        assert_eq!(parse("0x6040"), Ok(ObjectFilter { first: 0x6040, last: 0x6040 }));
        for wrong in ["", "x", "0x10000", "2..1", ".."] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
