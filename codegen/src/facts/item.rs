//! Default, range and unit of an item, and what it can be mapped into.

use super::physical::{shown_unit, Physical};
use super::types;
use super::words::PLAIN;
use crate::ir::{Item, Limits, Mappable, Quantity, Scale, Type, TypeDef, Value};

/// A value of an item: the physical value first. `types` are those of its owner.
pub fn value(item: &Item, value: &Value, types: &[TypeDef]) -> String {
    let basic = types::basic(types, item.ty);
    PLAIN.of_item(item, value, &|value| raw(item, value, basic))
}

/// The default value; empty if there is none.
pub fn default(item: &Item, types: &[TypeDef]) -> String {
    item.default.as_ref().map(|default| value(item, default, types)).unwrap_or_default()
}

/// `0 … 5`, `1, 3 to 7`, `-20.0 … 200.0 °C (raw -200 … 2000)`; empty without limits. At most `shown` of single values.
pub fn range(item: &Item, limits: &Limits, types: &[TypeDef], shown: usize) -> String {
    let physical = Physical::of(item.quantity.as_deref());
    let basic = types::basic(types, item.ty);
    let raw = |value: &Value| raw(item, value, basic);
    match limits.allowed.is_empty() {
        true => PLAIN.range(limits, physical.as_ref(), &raw),
        false => PLAIN.first_allowed(limits, physical.as_ref(), &raw, shown),
    }
}

/// The unit of the physical value; empty if the raw value of the row isn't that and no physical one is shown.
pub fn unit(item: &Item) -> &str {
    match item.quantity.as_deref() {
        Some(Quantity { scale: Some(Scale::Exponent { .. }), .. }) | None => "",
        Some(quantity) => shown_unit(quantity),
    }
}

/// The PDOs that an item can be mapped into; `None` if it can't.
pub fn mappable(mappable: Mappable) -> Option<&'static str> {
    match (mappable.rpdo, mappable.tpdo) {
        (true, true) => Some("any PDO"),
        (true, false) => Some("RPDOs"),
        (false, true) => Some("TPDOs"),
        (false, false) => None,
    }
}

/// A raw value: decimal if it has a unit or a scale.
fn raw(item: &Item, value: &Value, ty: Type) -> String {
    match item.quantity {
        Some(_) => PLAIN.value(value),
        None => number(value, ty),
    }
}

/// A value in a table: numbers of unsigned types that look like bit patterns in hexadecimal.
fn number(value: &Value, ty: Type) -> String {
    match value {
        Value::Int(number) => integer(*number, matches!(ty, Type::Unsigned(_))),
        _ => PLAIN.value(value),
    }
}

/// A number; large unsigned ones in hexadecimal: most of them are bit patterns, addresses and signatures.
pub fn integer(number: i128, is_unsigned: bool) -> String {
    match number {
        0x1_0000.. if is_unsigned => format!("0x{number:X}"),
        _ => number.to_string(),
    }
}
