//! Parses values that a person writes.

use std::error::Error;
use std::fmt;

use lexibus_codegen::facts::{encoding, types};
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Type, Value};

use crate::parameter::Parameter;

/// Unit that marks a raw value.
const RAW: &str = "raw";

/// The reason why a text isn't a value of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ParseError {
    /// The text isn't a value of the type. The fields are the text, with or without its unit, and the type.
    NoValue(String, String),
    /// The value is scaled, so a number needs the unit or `raw`. The field is the unit of the parameter, which may be
    /// empty.
    UnitNeeded(String),
    /// The unit isn't that of the parameter. The fields are the unit of the parameter, which may be empty, and the
    /// given unit.
    OtherUnit(String, String),
    /// The physical value cannot be converted to a raw value. For example, the scale depends on another parameter or on
    /// the model.
    NoConversion,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParseError::NoValue(text, ty) => write!(f, "`{text}` is not a value of the type {ty}"),
            ParseError::UnitNeeded(unit) if unit.is_empty() => {
                f.write_str("the value is scaled; add `raw` if the number is the raw value")
            }
            ParseError::UnitNeeded(unit) => {
                write!(f, "the value is scaled; add the unit `{unit}`, or `raw` if the number is the raw value")
            }
            ParseError::OtherUnit(unit, given) if unit.is_empty() => {
                write!(f, "the parameter has no unit, but the text has the unit `{given}`")
            }
            ParseError::OtherUnit(unit, given) => write!(f, "the unit is `{unit}`, not `{given}`"),
            ParseError::NoConversion => f.write_str(
                "the physical value cannot be converted to a raw value; write the raw value with `raw` after it",
            ),
        }
    }
}

impl Error for ParseError {}

impl Parameter<'_> {
    /// Parses a value. Depending on the type, the text is a number with the unit of the parameter, a raw value (`1550 raw`),
    /// the name of a value or a formula with `$NODEID`. It can also be a text, a time (`2 d 500 ms`), or bytes in
    /// hexadecimal.
    ///
    /// If the type is an integer, a physical value is rounded to the nearest raw value.
    ///
    /// # Errors
    ///
    /// Fails if the text doesn't have the form of a value of the parameter's type, or if the unit is missing or wrong. Also
    /// fails if a physical value cannot be converted to a raw value. [`Write::new`](crate::Write::new) checks the range of
    /// the value.
    pub fn parse(&self, text: &str) -> Result<Value, ParseError> {
        let basic = self.basic();
        match basic {
            Type::VisibleString(_) | Type::UnicodeString(_) => Ok(Value::Text(text.into())),
            Type::Boolean | Type::Integer(_) | Type::Unsigned(_) | Type::Real32 | Type::Real64 => {
                self.named(text.trim()).map_or_else(|| self.number(text.trim()), Ok)
            }
            Type::TimeOfDay | Type::TimeDifference => {
                let value = bytes(text).and_then(|bytes| encoding::value(&bytes, basic));
                time(text).or(value).ok_or_else(|| self.no_value(text))
            }
            _ => bytes(text).map(Value::Bytes).ok_or_else(|| self.no_value(text)),
        }
    }

    /// Returns the value with this name: a value of an enumeration, or a value with a special meaning.
    fn named(&self, text: &str) -> Option<Value> {
        let is = |name: &str| name.eq_ignore_ascii_case(text);
        let sentinels = self.item().quantity.as_deref().map_or(&[][..], |quantity| &quantity.sentinels);
        if let Some((value, _)) = sentinels.iter().find(|(_, meaning)| is(meaning)) {
            return Some(value.clone());
        }
        let (values, _) = Owner::of_types(&self.description().device().types).enumeration(self.ty())?;
        values.iter().find(|named| named.last.is_none() && is(&named.name)).map(|named| Value::Int(named.value))
    }

    fn number(&self, text: &str) -> Result<Value, ParseError> {
        let (number, unit) = split(text);
        let expected = self.unit();
        let is_scaled = self.physical().is_some();
        match unit {
            RAW => self.raw(number),
            "" if is_scaled => match formula(number) {
                Some(value) => Ok(value),
                None => Err(ParseError::UnitNeeded(expected.to_owned())),
            },
            "" => self.raw(number),
            unit if unit != expected => Err(ParseError::OtherUnit(expected.to_owned(), unit.to_owned())),
            _ => match self.physical() {
                None => self.raw(number),
                Some(_) if number.parse::<f64>().is_err() => Err(self.no_value(text)),
                Some(physical) => physical.raw(number, self.basic()).ok_or(ParseError::NoConversion),
            },
        }
    }

    fn raw(&self, text: &str) -> Result<Value, ParseError> {
        let value = match self.basic() {
            Type::Boolean => match text {
                "0" | "false" => Some(Value::Bool(false)),
                "1" | "true" => Some(Value::Bool(true)),
                _ => None,
            },
            Type::Real32 | Type::Real64 => text.parse().ok().filter(|number: &f64| number.is_finite()).map(Value::Real),
            _ => integer(text).map(Value::Int).or_else(|| formula(text)),
        };
        value.ok_or_else(|| self.no_value(text))
    }

    fn no_value(&self, text: &str) -> ParseError {
        let ty = types::name(&self.description().device().types, self.ty());
        ParseError::NoValue(text.to_owned(), ty)
    }
}

/// Splits a text into a number and a unit.
fn split(text: &str) -> (&str, &str) {
    match text.split_once(char::is_whitespace) {
        Some((number, unit)) => (number, unit.trim()),
        None => (text, ""),
    }
}

/// Parses a decimal or hexadecimal integer.
fn integer(text: &str) -> Option<i128> {
    let (sign, digits) = text.strip_prefix('-').map_or((1, text), |digits| (-1, digits));
    let number = match digits.strip_prefix("0x").or_else(|| digits.strip_prefix("0X")) {
        Some(digits) => i128::from_str_radix(digits, 16).ok().filter(|_| !digits.starts_with(['+', '-']))?,
        None => digits.parse().ok().filter(|_| !digits.starts_with(['+', '-']))?,
    };
    Some(sign * number)
}

/// Parses a formula: `$NODEID`, `$NODEID+0x180`.
fn formula(text: &str) -> Option<Value> {
    let rest = text.strip_prefix("$NODEID")?;
    match rest.strip_prefix('+') {
        Some(offset) => {
            let is_short = |offset: &i128| offset.unsigned_abs() <= u64::MAX.into();
            integer(offset.trim()).filter(is_short).map(Value::NodeId)
        }
        None => rest.is_empty().then_some(Value::NodeId(0)),
    }
}

/// Parses a time: `2 d 500 ms`.
fn time(text: &str) -> Option<Value> {
    let (days, milliseconds) = text.trim().strip_suffix("ms")?.split_once('d')?;
    Some(Value::Time { milliseconds: milliseconds.trim().parse().ok()?, days: days.trim().parse().ok()? })
}

/// Parses bytes in hexadecimal, with or without spaces: `0A 1B`.
fn bytes(text: &str) -> Option<Vec<u8>> {
    let digits: Vec<char> = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    let byte = |pair: &[char]| u8::from_str_radix(&pair.iter().collect::<String>(), 16).ok();
    let is_complete = digits.len().is_multiple_of(2) && digits.iter().all(char::is_ascii_hexdigit);
    is_complete.then(|| digits.chunks(2).map(byte).collect())?
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{clock, pump, table};

    #[test]
    fn numbers_need_their_unit_if_they_are_scaled() {
        let description = table();
        let of = |name: &str, text: &str| description.find(name).expect("a parameter").parse(text);
        assert_eq!(of("Temperature", "25.5 °C"), Ok(Value::Int(255)));
        assert_eq!(of("Temperature", "255 raw"), Ok(Value::Int(255)));
        assert_eq!(of("Temperature", "0xFF raw"), Ok(Value::Int(255)));
        assert_eq!(of("Temperature", "25.5"), Err(ParseError::UnitNeeded("°C".into())));
        assert_eq!(of("Temperature", "25.5 K"), Err(ParseError::OtherUnit("°C".into(), "K".into())));
        assert_eq!(of("Temperature", "no sensor"), Ok(Value::Int(0x7FFF)));
        assert_eq!(of("Speed", "1500"), Ok(Value::Int(1500)));
        assert_eq!(of("Speed", "1500 rpm"), Ok(Value::Int(1500)));
        assert_eq!(of("Speed", "-1"), Ok(Value::Int(-1)));
        assert_eq!(of("Mode", "automatic"), Ok(Value::Int(1)));
        assert_eq!(of("Mode", "2"), Ok(Value::Int(2)));
        assert!(matches!(of("Mode", "fast"), Err(ParseError::NoValue(..))));
        assert!(matches!(of("Speed", "--1"), Err(ParseError::NoValue(..))));
        assert!(matches!(of("Temperature", "x °C"), Err(ParseError::NoValue(..))));
    }

    #[test]
    fn real_numbers_are_not_rounded() {
        let description = table();
        let of = |name: &str, text: &str| description.find(name).expect("a parameter").parse(text);
        assert_eq!(of("Gain", "0.25 V"), Ok(Value::Real(0.25)));
        assert_eq!(of("Gain", "0.25"), Ok(Value::Real(0.25)));
        assert_eq!(of("Offset", "0.3 mV"), Ok(Value::Real(3.0)));
        assert_eq!(of("Offset", "-0.025 mV"), Ok(Value::Real(-0.25)));
        assert_eq!(of("Offset", "2.5 raw"), Ok(Value::Real(2.5)));
        assert_eq!(of("Offset", "2.5"), Err(ParseError::UnitNeeded("mV".into())));
        assert_eq!(of("Period", "8 Hz"), Ok(Value::Real(0.25)));
        assert_eq!(of("Period", "0 Hz"), Err(ParseError::NoConversion));
        let offset = description.find("Offset").expect("a parameter");
        let write = crate::Write::parse(offset, "0.3 mV", None).expect("a write");
        assert_eq!((write.bytes(), offset.text(write.value())), (&3f32.to_le_bytes()[..], "0.3 mV (raw 3)".to_owned()));
    }

    #[test]
    fn times_are_days_and_milliseconds_or_six_bytes() {
        let description = clock();
        let parameter = description.find("Running time").expect("a parameter");
        let time = Value::Time { milliseconds: 500, days: 2 };
        assert_eq!(parameter.text(&time), "2 d 500 ms");
        for text in ["2 d 500 ms", "2d500ms", "F4 01 00 00 02 00"] {
            let write = crate::Write::parse(parameter, text, None).expect("a write");
            assert_eq!((write.value(), write.bytes()), (&time, &[0xF4, 1, 0, 0, 2, 0][..]), "{text}");
        }
        for text in ["500 ms", "2 d", "-1 d 5 ms", "F4 01 00 00 02"] {
            assert!(matches!(parameter.parse(text), Err(ParseError::NoValue(..))), "{text}");
        }
    }

    #[test]
    fn formulas_texts_and_bytes() {
        let description = pump();
        let of = |name: &str, text: &str| description.find(name).expect("a parameter").parse(text);
        assert_eq!(of("0x1800:1", "$NODEID+0x180"), Ok(Value::NodeId(0x180)));
        assert_eq!(of("0x1800:1", "$NODEID"), Ok(Value::NodeId(0)));
        assert_eq!(of("0x1800:1", "0x40000185"), Ok(Value::Int(0x4000_0185)));
        assert_eq!(bytes("0A1b ff"), Some(vec![0x0A, 0x1B, 0xFF]));
        assert_eq!(bytes("0A1"), None);
        assert_eq!(bytes("+A"), None);
    }
}
