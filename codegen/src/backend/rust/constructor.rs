//! The call that makes a handle.

use super::code::{call, list, seq, Doc};
use super::item_addresses::ItemAddresses;
use super::item_type::ItemType;
use super::literal;
use super::value_type::ValueType;
use super::variant;
use crate::ir::{Item, Value};

/// What shorter constructors leave out.
const FULL: &str = "rt::Range::Full";
const UNKNOWN: &str = "rt::Initial::Unknown";
const NO_FLAGS: &str = "rt::Flags::NONE";

/// What the constructors of a handle take beside its address.
pub(super) struct Arguments<'i> {
    name: String,
    range: Doc,
    initial: Doc,
    /// The default, where it can be told as a literal.
    default: Option<Doc>,
    unit: &'i str,
    flags: &'static str,
}

impl<'i> Arguments<'i> {
    /// `outer` leads from the handle's place to the device's.
    pub fn of(item: &'i Item, name: &str, ty: &ItemType<'_>, outer: &str) -> Self {
        let wrap = |literal: String| match ty.named {
            Some(_) => call!(seq![ty.path(outer), "::from_raw"], literal),
            None => Doc::from(literal),
        };
        // A truth value is the number of an enumeration.
        let number = item.default.as_ref().filter(|_| ty.named.is_some()).and_then(Value::as_int).map(Value::Int);
        let default = number.as_ref().or(item.default.as_ref());
        // Byte strings have the type of an array, which only a conversion of its own turns into a slice.
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

    /// The shortest call that says everything, and whether it needs the runtime's name: every argument costs `rustc` a tenth of what the
    /// rest of the handle does.
    pub fn constructor(&self, addresses: &ItemAddresses<'_>, location: impl FnOnce() -> Doc) -> (Doc, bool) {
        if let Some(call) = self.of_object(addresses) {
            return (call, self.flags != NO_FLAGS);
        }
        let call = self.of_register(addresses).unwrap_or_else(|| {
            let Arguments { name, range, initial, flags, .. } = self;
            call!("new", location(), name, range, initial, literal::string(self.unit), flags)
        });
        (call, true)
    }

    /// The arguments in which models of a device differ: range and initial value.
    pub fn of_model(&self) -> [&Doc; 2] {
        [&self.range, &self.initial]
    }

    /// Whether every value of the type is one of the item's, and it has no unit.
    fn is_plain(&self) -> bool {
        self.range.text() == FULL && self.unit.is_empty()
    }

    /// The call for what is an object, and nothing else.
    fn of_object(&self, addresses: &ItemAddresses<'_>) -> Option<Doc> {
        let (object, index, sub) = addresses.only_object().filter(|_| self.is_plain())?;
        let (name, flags) = (&self.name, self.flags);
        let [index, sub] = [format!("0x{index:04X}"), format!("0x{sub:02X}")];
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

    /// The call for a register, which may be an object as well.
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

/// Into which PDOs an item can be mapped.
pub(super) fn flags(item: &Item) -> &'static str {
    match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => "rt::Flags::PDO",
        (true, false) => "rt::Flags::RPDO",
        (false, true) => "rt::Flags::TPDO",
        (false, false) => NO_FLAGS,
    }
}
