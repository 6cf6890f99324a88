//! Generates the constructor call of a handle.

use super::code::{call, list, seq, Doc};
use super::item_addresses::ItemAddresses;
use super::item_type::ItemType;
use super::literal;
use super::value_type::ValueType;
use super::variant;
use crate::ir::{Item, Value};
use crate::number::{hex16, hex8};

/// Default arguments, which the short constructors omit.
const FULL: &str = "rt::Range::Full";
const UNKNOWN: &str = "rt::Initial::Unknown";
const NO_FLAGS: &str = "rt::Flags::NONE";

/// Arguments of a handle's constructor, without the address.
pub(super) struct Arguments<'i> {
    name: String,
    range: Doc,
    initial: Doc,
    /// Default value, if a literal can express it.
    default: Option<Doc>,
    unit: &'i str,
    flags: &'static str,
}

impl<'i> Arguments<'i> {
    /// Returns the constructor arguments of an item. `outer` is the path from the handle's module to the device's
    /// module.
    pub fn of(item: &'i Item, name: &str, ty: &ItemType<'_>, outer: &str) -> Self {
        let wrap = |literal: String| match ty.named {
            Some(_) => call!(seq![ty.path(outer), "::from_raw"], literal),
            None => Doc::from(literal),
        };
        // Convert the Boolean default of an enumeration to a number.
        let number = item.default.as_ref().filter(|_| ty.named.is_some()).and_then(Value::as_int).map(Value::Int);
        let default = number.as_ref().or(item.default.as_ref());
        // A byte string literal has an array type and would need a conversion to a slice.
        let literal = default.filter(|_| !matches!(ty.basic, ValueType::Bytes(_)));
        Arguments {
            name: literal::string(name),
            range: ty.basic.range_as(&variant::widest(item), &wrap),
            initial: ty.basic.initial_as(default, &wrap),
            default: literal.and_then(|value| ty.basic.literal(value)).map(wrap),
            unit: item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str()),
            flags: flags(item),
        }
    }

    /// Returns the shortest constructor call. Each additional argument increases the time that `rustc` needs for a handle
    /// by a tenth.
    pub fn constructor(&self, addresses: &ItemAddresses<'_>, location: impl FnOnce() -> Doc) -> Doc {
        self.of_object(addresses).or_else(|| self.of_register(addresses)).unwrap_or_else(|| {
            let Arguments { name, range, initial, flags, .. } = self;
            call!("new", location(), name, range, initial, literal::string(self.unit), flags)
        })
    }

    /// Returns the arguments that may differ between the models of a device: range and initial value.
    pub fn of_model(&self) -> [&Doc; 2] {
        [&self.range, &self.initial]
    }

    /// Returns whether the item has no unit and all values of its type are allowed.
    fn is_plain(&self) -> bool {
        self.range.text() == FULL && self.unit.is_empty()
    }

    /// Returns the constructor call of an item whose only address is an object. Returns `None` for other items, and if
    /// the short constructors of objects cannot express the item.
    fn of_object(&self, addresses: &ItemAddresses<'_>) -> Option<Doc> {
        let (object, index, sub) = addresses.only_object().filter(|_| self.is_plain())?;
        let (name, flags) = (&self.name, self.flags);
        let [index, sub] = [hex16(index), hex8(sub)];
        match (&self.default, flags) {
            (Some(default), NO_FLAGS) => Some(call!(seq![object, "_with_default"], index, sub, name, default)),
            (Some(default), _) => {
                Some(call!(seq!["flagged_", object, "_with_default"], index, sub, name, flags, default))
            }
            (None, _) if self.initial.text() != UNKNOWN => None,
            (None, NO_FLAGS) => Some(call!(object, index, sub, name)),
            (None, _) => Some(call!(seq!["flagged_", object], index, sub, name, flags)),
        }
    }

    /// Returns the constructor call of a register, which may also have an object address. Returns `None` for other
    /// items, and if the short constructors of registers cannot express the item.
    fn of_register(&self, addresses: &ItemAddresses<'_>) -> Option<Doc> {
        let address = addresses.with_register().filter(|_| self.initial.text() == UNKNOWN)?;
        let Arguments { name, range, flags, .. } = self;
        let address = address.into_iter().map(Doc::from);
        let text = |text: &str| Doc::from(text);
        Some(match self.is_plain() {
            true => list("register(", address.chain([text(name), text(flags)]), ")"),
            false => {
                let unit = Doc::from(literal::string(self.unit));
                list("register_within(", address.chain([text(name), range.clone(), unit, text(flags)]), ")")
            }
        })
    }
}

/// Returns the PDO flags of an item, which state whether RPDOs and whether TPDOs can map the item.
pub(super) fn flags(item: &Item) -> &'static str {
    match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => "rt::Flags::PDO",
        (true, false) => "rt::Flags::RPDO",
        (false, true) => "rt::Flags::TPDO",
        (false, false) => NO_FLAGS,
    }
}
