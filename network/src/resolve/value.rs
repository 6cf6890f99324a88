//! Converts declared values to values of an object's type.

use std::cmp::Ordering;

use lexibus_codegen::facts::{encoding, types};
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Bus, Device, Item, Limits, Scale, Type, Value};
use lexibus_codegen::text::similar;

use crate::syntax::Scalar;

/// The reason why a declared value does not fit its object.
#[derive(Debug, PartialEq)]
pub(crate) struct WrongValue {
    pub message: String,
    pub help: Option<String>,
}

impl WrongValue {
    fn new(message: impl Into<String>) -> Self {
        WrongValue { message: message.into(), help: None }
    }

    fn help(self, help: impl Into<String>) -> Self {
        WrongValue { help: Some(help.into()), ..self }
    }
}

/// Returns the basic type of an item on CANopen or EtherCAT.
pub(crate) fn basic_type(device: &Device, item: &Item, bus: Bus) -> Type {
    types::basic(&device.types, declared_type(item, bus))
}

fn declared_type(item: &Item, bus: Bus) -> Type {
    match bus {
        Bus::EtherCat => item.type_on(bus),
        _ => item.object_type(),
    }
}

/// Converts a declared value. Resolves formulas with `$NODEID` for the node-ID `id`; on EtherCAT, they are errors.
pub(crate) fn convert(device: &Device, item: &Item, bus: Bus, given: &Scalar, id: u8) -> Result<Value, WrongValue> {
    let ty = basic_type(device, item, bus);
    let value = match (given, ty) {
        (Scalar::Text(text), _) => text_value(device, item, bus, text)?.resolved(id),
        (Scalar::Integer(number @ 0..=1), Type::Boolean) => Value::Bool(*number == 1),
        (Scalar::Integer(number), Type::Real32 | Type::Real64) => Value::Real(*number as f64),
        (Scalar::Integer(number), _) if ty.integer_range().is_some() => Value::Int(*number),
        (Scalar::Real(number), Type::Real32 | Type::Real64) => Value::Real(*number),
        (Scalar::Bool(flag), Type::Boolean) => Value::Bool(*flag),
        (Scalar::Real(number), _) if ty.integer_range().is_some() => {
            let wrong = WrongValue::new(format!("{number} is not an integer, but the type of the object is {ty}"));
            return Err(match unit(item) {
                Some(unit) => wrong
                    .help(format!("write `\"{number} {unit}\"` for a physical value, or an integer for a raw value")),
                None => wrong.help("write a raw value"),
            });
        }
        _ => return Err(WrongValue::new(format!("{} is not a value of the type {ty}", given.described()))),
    };
    fitting(value, ty)
}

/// Returns a value if it is in the range of the type, or the reason why it is not.
fn fitting(value: Value, ty: Type) -> Result<Value, WrongValue> {
    match (encoding::fits(&value, ty), ty.integer_range()) {
        (true, _) => Ok(value),
        (false, Some((low, high))) => Err(WrongValue::new(format!("{value} is not in the range of {ty}"))
            .help(format!("write a value from {low} to {high}"))),
        (false, None) => Err(WrongValue::new(format!("{value} is not a value of the type {ty}"))),
    }
}

fn unit(item: &Item) -> Option<&str> {
    let quantity = item.quantity.as_ref()?;
    (!quantity.unit.is_empty()).then_some(quantity.unit.as_str())
}

fn text_value(device: &Device, item: &Item, bus: Bus, text: &str) -> Result<Value, WrongValue> {
    let ty = basic_type(device, item, bus);
    match ty {
        Type::VisibleString(_) | Type::UnicodeString(_) => return Ok(Value::Text(text.into())),
        Type::OctetString(_) | Type::Domain | Type::Opaque(_) => {
            let wrong =
                || WrongValue::new(format!("{text:?} is not a list of bytes")).help("write bytes, such as \"01 FF\"");
            return bytes(text).map(Value::Bytes).ok_or_else(wrong);
        }
        _ => {}
    }
    if let Some(offset) = formula(text) {
        return match bus {
            Bus::EtherCat => Err(WrongValue::new("a device on EtherCAT has no node-ID").help("write a number")),
            _ => Ok(Value::NodeId(offset)),
        };
    }
    // Names are tried first, because the name of a value can have the form of a physical value: `50 Hz`.
    match (named(device, item, bus, text), quantity(text)) {
        (Some(value), _) => Ok(value),
        (None, Some((number, unit))) => physical(item, number, unit, ty),
        (None, None) => Err(unnamed(device, item, bus, text)),
    }
}

/// Reads `$NODEID`, `$NODEID+0x180`.
fn formula(text: &str) -> Option<i128> {
    let rest = text.strip_prefix("$NODEID")?.trim();
    if rest.is_empty() {
        return Some(0);
    }
    let digits = rest.strip_prefix('+')?.trim();
    match digits.strip_prefix("0x") {
        Some(digits) => i128::from_str_radix(digits, 16).ok(),
        None => digits.parse().ok(),
    }
}

/// Reads a number with a unit: `15.5 rev/s`.
fn quantity(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = text.trim().split_once(' ')?;
    Some((number.parse().ok()?, unit.trim()))
}

/// Returns the raw value of a physical value.
fn physical(item: &Item, number: f64, given: &str, ty: Type) -> Result<Value, WrongValue> {
    let Some(unit) = unit(item) else {
        return Err(WrongValue::new(format!("the object has no unit, but the value has the unit `{given}`"))
            .help("write a raw value"));
    };
    if unit != given {
        let wrong = WrongValue::new(format!("the value has the unit `{given}`, but the object has the unit `{unit}`"));
        return Err(wrong.help(format!("convert the value to `{unit}`")));
    }
    let scale = item.quantity.as_ref().and_then(|quantity| quantity.scale.as_ref());
    let raw = match scale {
        None => number,
        Some(Scale::Linear { factor, offset }) => (number - offset) / factor,
        Some(Scale::Reciprocal { numerator }) => numerator / number,
        Some(_) => {
            return Err(WrongValue::new("the scale of the object depends on other values").help("write a raw value"));
        }
    };
    if matches!(ty, Type::Real32 | Type::Real64) {
        return Ok(Value::Real(raw));
    }
    let rounded = raw.round();
    if (raw - rounded).abs() > 1e-6 * raw.abs().max(1.0) || !raw.is_finite() {
        let wrong = WrongValue::new(format!("{number} {unit} is not a multiple of the object's resolution"));
        return Err(match scale {
            Some(Scale::Linear { factor, offset }) => {
                wrong.help(format!("write `\"{} {unit}\"`", decimal(rounded * factor + offset)))
            }
            _ => wrong,
        });
    }
    Ok(Value::Int(rounded as i128))
}

/// Formats a number with at most 9 decimal places, so that rounding errors of the computation are not visible.
fn decimal(number: f64) -> String {
    let text = format!("{number:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns the names and values of the object's enumeration, without reserved and vendor-specific values.
fn enumeration<'d>(device: &'d Device, item: &Item, bus: Bus) -> Option<impl Iterator<Item = (&'d str, i128)>> {
    let (values, _) = Owner::of_types(&device.types).enumeration(declared_type(item, bus))?;
    Some(values.iter().filter(|value| value.is_named()).map(|value| (value.name.as_str(), value.value)))
}

/// Returns the value that has this name in the object's enumeration. Ignores the case of ASCII letters.
fn named(device: &Device, item: &Item, bus: Bus, text: &str) -> Option<Value> {
    let mut values = enumeration(device, item, bus)?;
    let named = values.find(|(name, _)| name.eq_ignore_ascii_case(text));
    named.map(|(_, value)| Value::Int(value))
}

/// Returns the reason why a text is not the name of a value.
fn unnamed(device: &Device, item: &Item, bus: Bus, text: &str) -> WrongValue {
    let Some(values) = enumeration(device, item, bus) else {
        return WrongValue::new(format!("{text:?} is not a value of the type {}", basic_type(device, item, bus)));
    };
    let wrong = WrongValue::new(format!("the object has no value `{text}`"));
    match similar(text, values.map(|(name, _)| name)) {
        Some(name) => wrong.help(format!("write `{name}`")),
        None => wrong.help("write a number"),
    }
}

fn bytes(text: &str) -> Option<Vec<u8>> {
    let digits: String = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    if !digits.is_ascii() || !digits.len().is_multiple_of(2) {
        return None;
    }
    (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&digits[at..at + 2], 16).ok()).collect()
}

/// Returns the rule that a value breaks: `below the minimum 0`. Returns `None` if the value breaks no rule.
pub(crate) fn broken_limit(limits: &Limits, value: &Value, id: u8) -> Option<String> {
    let compared = |limit: &Value| value.compare(&limit.resolved(id));
    let low = limits.low.as_ref().filter(|low| compared(low) == Some(Ordering::Less));
    let high = limits.high.as_ref().filter(|high| compared(high) == Some(Ordering::Greater));
    let is_within = |(first, last): &(Value, Value)| {
        compared(first) != Some(Ordering::Less) && compared(last) != Some(Ordering::Greater)
    };
    match (low, high) {
        (Some(low), _) => Some(format!("below the minimum {}", low.resolved(id))),
        (None, Some(high)) => Some(format!("above the maximum {}", high.resolved(id))),
        _ if !limits.allowed.is_empty() && !limits.allowed.iter().any(is_within) => {
            Some("not one of the allowed values".to_owned())
        }
        _ => None,
    }
}
