//! Descriptions of a device on one bus.

use std::error::Error;
use std::fmt;

use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::facts::address;
use lexibus_codegen::ir::{AxisStep, Binding, Catalog, Device, Format, Group, ObjectCode};
use lexibus_codegen::source::Source;
use lexibus_codegen::text::similar;

use crate::address::{Address, Network};
use crate::parameter::Parameter;

/// Maximum number of parameters with the same name that an error lists.
const CANDIDATES: usize = 8;

/// The description of a device on one bus.
#[derive(Clone, Debug)]
pub struct Description {
    catalog: Catalog,
    position: usize,
    network: Network,
}

/// The reason why a description cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DescriptionError {
    /// The file has errors or isn't a device description. The text contains the reason.
    Invalid(String),
    /// The catalog contains no device.
    NoDevice,
    /// The catalog contains several devices. The list contains their names.
    SeveralDevices(Vec<String>),
    /// The device has no parameter on this network.
    NotOnNetwork(Network),
}

impl fmt::Display for DescriptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DescriptionError::Invalid(message) => f.write_str(message),
            DescriptionError::NoDevice => f.write_str("the file describes no device"),
            DescriptionError::SeveralDevices(names) => {
                write!(f, "the file describes several devices; select one of: {}", names.join(", "))
            }
            DescriptionError::NotOnNetwork(Network::CanOpen) => f.write_str("the description has no CANopen objects"),
            DescriptionError::NotOnNetwork(Network::Modbus) => f.write_str("the description has no Modbus registers"),
        }
    }
}

impl Error for DescriptionError {}

/// The reason why a text doesn't identify a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FindError {
    /// No parameter has this name, path or address. The second field is a similar name or path, if there is one.
    Unknown(String, Option<String>),
    /// The address belongs to an object of an axis after the first one. The fields are the address, the number of this
    /// axis, and the corresponding parameter of the first axis.
    OtherAxis(String, u8, String),
    /// Several parameters have this name or path. The list contains the addresses and paths of at most eight of them.
    Ambiguous(String, Vec<String>),
}

impl fmt::Display for FindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FindError::Unknown(text, None) => write!(f, "the description has no parameter `{text}`"),
            FindError::Unknown(text, Some(similar)) => {
                write!(f, "the description has no parameter `{text}`; did you mean `{similar}`?")
            }
            FindError::OtherAxis(text, axis, first) => write!(
                f,
                "`{text}` is an object of axis {axis}, but only objects of the first axis can be accessed, here {first}"
            ),
            FindError::Ambiguous(text, candidates) => {
                write!(f, "several parameters have the name `{text}`; use an address: {}", candidates.join(", "))
            }
        }
    }
}

impl Error for FindError {}

impl Description {
    /// Reads and checks a description file. `options` selects the device if the file describes several.
    ///
    /// # Errors
    ///
    /// Fails if the file has errors, or if the file and `options` don't select exactly one device. Also fails if this device
    /// has no parameter on the network.
    pub fn compile(source: Source, network: Network, options: &Options) -> Result<Self, DescriptionError> {
        let compilation = compile::check(source, options);
        match compilation.usable() {
            Some(catalog) => Self::new(catalog.clone(), network),
            None => {
                let errors = compilation.diagnostics.list().iter();
                let mut errors = errors.filter(|found| found.severity == lexibus_codegen::diagnostics::Severity::Error);
                let first = errors.next().map(|error| compilation.one_line(error));
                Err(DescriptionError::Invalid(
                    first.unwrap_or_else(|| "the file is not a device description".to_owned()),
                ))
            }
        }
    }

    /// Creates a description of the only device in `catalog`.
    ///
    /// # Errors
    ///
    /// Fails if the catalog doesn't contain exactly one device, or if this device has no parameter on the network.
    pub fn new(catalog: Catalog, network: Network) -> Result<Self, DescriptionError> {
        let devices = catalog.devices.iter().enumerate().filter(|(_, device)| !device.dictionary_only);
        let devices: Vec<(usize, String)> = devices.map(|(at, device)| (at, device.name.to_string())).collect();
        let position = match devices.as_slice() {
            [] => return Err(DescriptionError::NoDevice),
            [(position, _)] => *position,
            several => {
                return Err(DescriptionError::SeveralDevices(several.iter().map(|(_, name)| name.clone()).collect()))
            }
        };
        let description = Self { catalog, position, network };
        let is_empty = description.parameters().next().is_none();
        if is_empty {
            Err(DescriptionError::NotOnNetwork(network))
        } else {
            Ok(description)
        }
    }

    /// Returns the catalog that contains the device.
    #[must_use]
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// Returns the device.
    #[must_use]
    pub fn device(&self) -> &Device {
        &self.catalog.devices[self.position]
    }

    /// Returns the position of the device in the catalog.
    pub(crate) fn position(&self) -> usize {
        self.position
    }

    /// Returns the network.
    #[must_use]
    pub fn network(&self) -> Network {
        self.network
    }

    /// Returns the name of the description file; empty if the catalog names no file.
    #[must_use]
    pub fn file_name(&self) -> &str {
        self.catalog.files.first().map_or("", |file| &file.name)
    }

    /// Returns the format of the description file, or `None` if the catalog names no file.
    #[must_use]
    pub fn format(&self) -> Option<Format> {
        self.catalog.files.first().map(|file| file.format)
    }

    /// Returns the parameters that the device has on the network, in the order of the [groups](Device::groups). Definitions
    /// of data types, NULL objects and reserved entries are left out.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter<'_>> {
        let groups = self.device().groups.iter().filter(|group| is_data(group));
        groups.flat_map(|group| {
            let items = group.items.iter().filter(|item| !item.is_reserved);
            items.filter_map(|item| Parameter::new(self, group, item))
        })
    }

    /// Returns the parameter at an address. A reserved entry of an object is returned too.
    #[must_use]
    pub fn at(&self, address: Address) -> Option<Parameter<'_>> {
        match address {
            Address::Object(object) => self.object(object.index, object.sub_index),
            Address::Register(_) => self.search(address),
        }
    }

    fn search(&self, address: Address) -> Option<Parameter<'_>> {
        self.parameters().find(|parameter| parameter.address() == address)
    }

    /// Returns the parameter at an index and sub-index. A reserved entry is returned too.
    pub(crate) fn object(&self, index: u16, sub_index: u8) -> Option<Parameter<'_>> {
        let group = self.device().object(index).filter(|group| is_data(group));
        match group {
            Some(group) => Parameter::new(self, group, group.sub(sub_index)?),
            None => self.search(Address::Object(lexibus::Object::new(index, sub_index))),
        }
    }

    /// Returns the parameter with a name, a path or an address:
    ///
    /// - the name of the parameter, in any case: `Profile velocity`;
    /// - the name of the object or chapter, a slash and the name of the parameter: `Identity object/Vendor-ID`;
    /// - index and sub-index in hexadecimal: `0x6081`, `0x1018:1`;
    /// - table and wire address, in decimal or hexadecimal: `input register 101`, `coil 3`, `register 0x2710`, or, for a holding
    ///   register, only `101`. The first bit of a part follows a point: `register 101.3`.
    ///
    /// # Errors
    ///
    /// Fails if no parameter matches, or if several parameters have this name or path.
    pub fn find(&self, text: &str) -> Result<Parameter<'_>, FindError> {
        let text = text.trim();
        if let Some(parameter) = self.by_address(text) {
            return Ok(parameter);
        }
        if let Some((axis, first)) = object_address(text).and_then(|object| self.of_other_axis(object)) {
            return Err(FindError::OtherAxis(text.to_owned(), axis, first.to_string()));
        }
        let matching =
            |is: &dyn Fn(&Parameter<'_>) -> bool| self.parameters().filter(|parameter| is(parameter)).collect();
        let by_path: Vec<Parameter<'_>> = matching(&|parameter| parameter.path().eq_ignore_ascii_case(text));
        let by_name: Vec<Parameter<'_>> = matching(&|parameter| parameter.name().eq_ignore_ascii_case(text));
        let found = if by_path.is_empty() { by_name } else { by_path };
        match found.as_slice() {
            [parameter] => Ok(*parameter),
            [] => {
                let names: Vec<String> =
                    self.parameters().flat_map(|parameter| [parameter.name(), parameter.path()]).collect();
                let similar = similar(text, names.iter().map(String::as_str)).map(str::to_owned);
                Err(FindError::Unknown(text.to_owned(), similar))
            }
            several => {
                let candidate =
                    |parameter: &Parameter<'_>| format!("{} ({})", parameter.address_text(), parameter.path());
                Err(FindError::Ambiguous(text.to_owned(), several.iter().take(CANDIDATES).map(candidate).collect()))
            }
        }
    }

    /// If the object belongs to an axis after the first one, returns the number of this axis and the corresponding
    /// parameter of the first axis. Otherwise, returns `None`.
    fn of_other_axis(&self, object: (u16, u8)) -> Option<(u8, Parameter<'_>)> {
        let (index, sub_index) = object;
        let axes = self.device().axes.as_ref().filter(|_| self.network == Network::CanOpen)?;
        let first = |step: u16, axis: u8| index.checked_sub(step.checked_mul(axis.into())?);
        let objects = (1..axes.axes).flat_map(|axis| axes.rules.iter().map(move |rule| (axis, rule)));
        let mut objects = objects.filter_map(|(axis, rule)| match rule.step {
            AxisStep::Index(step) => {
                Some((axis, first(step, axis).filter(|first| (rule.indices.0..=rule.indices.1).contains(first))?))
            }
            _ => None,
        });
        objects.find_map(|(axis, first)| Some((axis + 1, self.object(first, sub_index)?)))
    }

    fn by_address(&self, text: &str) -> Option<Parameter<'_>> {
        match self.network {
            Network::CanOpen => {
                let (index, sub_index) = object_address(text)?;
                self.object(index, sub_index)
            }
            Network::Modbus => {
                let (table, register, bit) = register_address(text)?;
                self.parameters().find(|parameter| match parameter.binding() {
                    Binding::Register(binding) => {
                        (binding.address, binding.bit_offset) == (register, bit)
                            && address::table(binding.space).eq_ignore_ascii_case(table)
                    }
                    _ => false,
                })
            }
        }
    }
}

/// Parses index and sub-index: `0x6081`, `0x1018:1`.
fn object_address(text: &str) -> Option<(u16, u8)> {
    let (index, sub_index) = text.split_once(':').unwrap_or((text, "0"));
    let index = u16::from_str_radix(hexadecimal(index)?, 16).ok()?;
    let sub_index = hexadecimal(sub_index).unwrap_or(sub_index);
    Some((index, u8::from_str_radix(sub_index, 16).ok()?))
}

/// Parses the table, the wire address and the first bit of a Modbus address: `input register 101`, `0x2710`, `register 7.3`.
fn register_address(text: &str) -> Option<(&str, u16, Option<u8>)> {
    let (table, number) = text.rsplit_once(' ').unwrap_or(("register", text));
    let (number, bit) = number.split_once('.').map_or((number, None), |(number, bit)| (number, Some(bit)));
    let register = match hexadecimal(number) {
        Some(digits) => u16::from_str_radix(digits, 16).ok()?,
        None => number.parse().ok()?,
    };
    Some((table.trim_end(), register, bit.map(str::parse).transpose().ok()?))
}

fn hexadecimal(text: &str) -> Option<&str> {
    text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))
}

/// Returns whether a group contains values. Definitions of data types and NULL objects contain none.
fn is_data(group: &Group) -> bool {
    !matches!(group.object_code(), Some(ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::described;

    #[test]
    fn registers_have_decimal_and_hexadecimal_addresses() {
        const TABLE: &str = r#"
lexibus = 1
[device]
name = "Meter"
buses = ["modbus"]
[spaces.register]
modbus = { table = "holding", first = 0 }
[spaces.input]
modbus = { table = "input", first = 0 }
[[chapters]]
title = "Values"
space = "register"
defaults = { access = "ro", type = "u16" }
[chapters.registers]
Far = { reg = 10000 }
Near = { reg = 10 }
Part = { reg = 11, part = 4, type = "bool" }
[[chapters]]
title = "Inputs"
space = "input"
defaults = { access = "ro", type = "u16" }
[chapters.registers]
Input = { reg = 10 }
"#;
        let meter = described(Source::new("meter.toml", TABLE.into()), Network::Modbus);
        let name = |text: &str| meter.find(text).map(|parameter| parameter.name()).unwrap_or_default();
        for text in ["10000", "0x2710", "register 10000", "Register 0x2710"] {
            assert_eq!(name(text), "Far", "{text}");
        }
        assert_eq!(["10", "register 0xA", "10.0", "coil 10", "70000"].map(name), ["Near", "Near", "", "", ""]);
        assert_eq!(["register 11.4", "11.4", "11"].map(name), ["Part", "Part", ""]);
        assert_eq!(["input register 10", "Input Register 0x0A"].map(name), ["Input", "Input"]);
    }
}
