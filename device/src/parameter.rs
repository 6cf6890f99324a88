//! Parameters: values of a device, with the facts of their description.

use std::fmt;

use lexibus_codegen::facts::pdo::is_mapping;
use lexibus_codegen::facts::physical::{shown_unit, Physical};
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::facts::{address, encoding, item as facts, types};
use lexibus_codegen::ir::{excluded, Access, Behavior, Binding, Group, Item, Limits, Type, TypeDef, Value};

use crate::address::Address;
use crate::connection::Connection;
use crate::description::Description;
use crate::failure::Failure;

/// A value of the device, with the facts of its description.
#[derive(Clone, Copy, Debug)]
pub struct Parameter<'d> {
    description: &'d Description,
    group: &'d Group,
    item: &'d Item,
    binding: &'d Binding,
    address: Address,
}

impl PartialEq for Parameter<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.address == other.address
    }
}

impl<'d> Parameter<'d> {
    /// Returns the parameter of an item, or `None` if the item has no address on the network.
    pub(crate) fn new(description: &'d Description, group: &'d Group, item: &'d Item) -> Option<Self> {
        let bus = description.network().bus();
        let ty = types::basic(&description.device().types, item.type_on(bus));
        let (address, binding) = Address::of(item, ty, description.network())?;
        Some(Self { description, group, item, binding, address })
    }

    /// Returns the item of the intermediate representation.
    #[must_use]
    pub fn item(&self) -> &'d Item {
        self.item
    }

    /// Returns the object or chapter that contains the parameter.
    #[must_use]
    pub fn group(&self) -> &'d Group {
        self.group
    }

    /// Returns the description of the device.
    #[must_use]
    pub fn description(&self) -> &'d Description {
        self.description
    }

    pub(crate) fn binding(&self) -> &'d Binding {
        self.binding
    }

    /// Returns the address.
    #[must_use]
    pub fn address(&self) -> Address {
        self.address
    }

    /// Returns the address as text: `0x6081:00`, `register 101`.
    #[must_use]
    pub fn address_text(&self) -> String {
        address::number(self.binding)
    }

    /// Returns the name.
    #[must_use]
    pub fn name(&self) -> String {
        facts::entry_name(self.item, self.group)
    }

    /// Returns the name of the object or chapter, a slash and the name of the parameter. If the object or chapter has no
    /// name or the same name, returns only the name of the parameter.
    #[must_use]
    pub fn path(&self) -> String {
        let name = self.name();
        match self.group.name.as_str() {
            "" => name,
            group if group == name => name,
            group => format!("{group}/{name}"),
        }
    }

    fn types(&self) -> &'d [TypeDef] {
        &self.description.device().types
    }

    /// Returns the type on the network.
    #[must_use]
    pub fn ty(&self) -> Type {
        self.item.type_on(self.description.network().bus())
    }

    /// Returns the basic type on the network: the type without names of values and bits.
    #[must_use]
    pub fn basic(&self) -> Type {
        types::basic(self.types(), self.ty())
    }

    /// Returns the access rights on the network.
    #[must_use]
    pub fn access(&self) -> Access {
        self.item.access_on(self.description.network().bus())
    }

    /// Returns the default value on the network.
    #[must_use]
    pub fn default(&self) -> Option<&'d Value> {
        self.item.default_on(self.description.network().bus())
    }

    /// Returns the limits on the network.
    #[must_use]
    pub fn limits(&self) -> &'d Limits {
        self.item.limits_on(self.description.network().bus()).unwrap_or(&self.item.limits)
    }

    /// Returns the limits as text: `0 … 5`. The text is empty if there are no limits.
    #[must_use]
    pub fn range(&self) -> String {
        /// Maximum number of allowed values in the text.
        const SHOWN: usize = 8;
        facts::range(self.item, self.limits(), self.types(), SHOWN)
    }

    /// Returns the behavior, such as storage and side effects, or `None` if the description states none.
    #[must_use]
    pub fn behavior(&self) -> Option<&'d Behavior> {
        self.item.behavior.as_deref()
    }

    /// Returns the unit of the physical value; empty if there is none.
    #[must_use]
    pub fn unit(&self) -> &'d str {
        self.item.quantity.as_deref().map_or("", shown_unit)
    }

    /// Returns the conversion to physical values, if they differ from raw values.
    pub(crate) fn physical(&self) -> Option<Physical<'d>> {
        Physical::of(self.item.quantity.as_deref())
    }

    /// Returns the length in bytes, if the type has a fixed length.
    #[must_use]
    pub fn length(&self) -> Option<usize> {
        self.basic().bits().map(|bits| bits.div_ceil(8) as usize)
    }

    /// Returns the number of bytes to read on Modbus. On CANopen, the device determines the length.
    fn read_length(&self) -> usize {
        let of_register = match self.address {
            Address::Register(register) => 2 * usize::from(register.count),
            Address::Object(_) => 0,
        };
        self.length().unwrap_or(of_register)
    }

    /// Formats a value with its unit and raw value, or with its name: `15.50 rev/s (raw 1550)`, `6 (Homing)`, `100 ms`.
    #[must_use]
    pub fn text(&self, value: &Value) -> String {
        let text = facts::value(self.item, value, self.types());
        // No names of bits or values follow a COB-ID, a value with a special meaning, or a mapping.
        let is_explained =
            PLAIN.is_named(self.item, value) || self.address.object().is_some_and(|object| is_mapping(object.index));
        if let Some(meaning) = facts::meaning(self.ty(), value, self.types()).filter(|_| !is_explained) {
            return format!("{text} ({meaning})");
        }
        match self.unit() {
            "" => text,
            unit if self.physical().is_none() && !PLAIN.is_named(self.item, value) => format!("{text} {unit}"),
            _ => text,
        }
    }

    /// Decodes bytes that the device sent. Returns `None` if the bytes are not a value of the type.
    #[must_use]
    pub fn decode(&self, bytes: &[u8]) -> Option<Value> {
        encoding::value(bytes, self.basic())
    }

    /// Returns the bytes of a value. `node_id` replaces `$NODEID` in a formula. Returns `None` if the value isn't a
    /// value of the type, or if it depends on the node-ID and `node_id` is `None`.
    #[must_use]
    pub fn encode(&self, value: &Value, node_id: Option<u8>) -> Option<Vec<u8>> {
        let value = match node_id {
            Some(node_id) => value.resolved(node_id),
            None => value.clone(),
        };
        let basic = self.basic();
        (encoding::fits(&value, basic)).then(|| encoding::bytes(&value, basic))?
    }

    /// Returns the reason why a value is outside the limits, or `None` if it is within the limits. Limits whose minimum
    /// is above the maximum are ignored. `node_id` replaces `$NODEID` in a minimum or maximum.
    #[must_use]
    pub fn excluded(&self, value: &Value, node_id: Option<u8>) -> Option<String> {
        let resolve = |limit: &Option<Value>| match (limit, node_id) {
            (Some(limit @ Value::NodeId(_)), Some(node_id)) => Some(limit.resolved(node_id)),
            (limit, _) => limit.clone(),
        };
        let limits = self.limits();
        let limits = Limits { low: resolve(&limits.low), high: resolve(&limits.high), ..limits.clone() };
        // A minimum above the maximum is a mistake in the description.
        if limits.are_swapped(self.basic()) {
            return None;
        }
        excluded(&limits, value).map(|reason| reason.to_string())
    }

    /// Reads the value.
    ///
    /// # Errors
    ///
    /// Returns the reason why the value was not transferred.
    pub fn read(&self, connection: &mut impl Connection) -> Result<Reading<'d>, Failure> {
        let bytes = connection.read(self.address, self.read_length())?;
        Ok(Reading { parameter: *self, value: self.decode(&bytes), bytes })
    }
}

impl fmt::Display for Parameter<'_> {
    /// Writes address and path: `0x6081:00 Profile velocity`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.address_text(), self.path())
    }
}

/// A value that was read from a device.
#[derive(Clone, Debug)]
pub struct Reading<'d> {
    /// The parameter.
    pub parameter: Parameter<'d>,
    /// Bytes of the value.
    pub bytes: Vec<u8>,
    /// The value, or `None` if the bytes are not a value of the parameter's type.
    pub value: Option<Value>,
}

impl fmt::Display for Reading<'_> {
    /// Writes the value as [`Parameter::text`] does. Writes the bytes in hexadecimal if the value consists of bytes, or if
    /// they are not a value of the type.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            Some(Value::Bytes(bytes)) => f.write_str(&lexibus_codegen::number::bytes(bytes)),
            Some(value) => f.write_str(&self.parameter.text(value)),
            None => {
                let bytes = lexibus_codegen::number::bytes(&self.bytes);
                write!(f, "{bytes} (not a value of the type {})", self.parameter.basic().with_length())
            }
        }
    }
}
