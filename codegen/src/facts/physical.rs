//! Conversion between raw values and physical values, and their notation in documentation.

use crate::ir::{Limits, Quantity, Scale, Type, Value};

/// Conversion from raw values of an item to physical values.
#[derive(Clone, Copy)]
pub struct Physical<'q> {
    unit: &'q str,
    scale: &'q Scale,
}

impl<'q> Physical<'q> {
    /// Returns the conversion of a quantity, or `None` if raw value and physical value are the same.
    pub fn of(quantity: Option<&'q Quantity>) -> Option<Self> {
        let quantity = quantity?;
        Physical::scaled(quantity.scale.as_ref()?, shown_unit(quantity))
    }

    /// Returns the conversion of a scale, or `None` if raw value and physical value are the same.
    pub fn scaled(scale: &'q Scale, unit: &'q str) -> Option<Self> {
        let is_raw = matches!(scale, Scale::Linear { factor, offset } if *factor == 1.0 && *offset == 0.0);
        (!is_raw).then_some(Physical { unit, scale })
    }

    /// Returns the physical value without its unit, such as `25.0` for raw value 250 with scale factor 0.1. Returns
    /// `None` if the scale depends on another item or on the model, or if the raw value has no physical value.
    fn number(&self, raw: &Value) -> Option<String> {
        match *self.scale {
            Scale::Linear { factor, offset } => linear(raw, factor, offset),
            Scale::Reciprocal { numerator } => {
                raw.as_real().filter(|raw| *raw != 0.0).map(|raw| short(numerator / raw))
            }
            _ => None,
        }
    }

    /// Formats a value: `25.0 °C (raw 250)`, or `raw 250` if the physical value is unknown. `raw` formats raw values, and `unit`
    /// formats units.
    pub fn value(&self, value: &Value, raw: &dyn Fn(&Value) -> String, unit: &dyn Fn(&str) -> String) -> String {
        match self.number(value) {
            Some(number) => format!("{} (raw {})", self.with_unit(&number, unit), raw(value)),
            None => format!("raw {}", raw(value)),
        }
    }

    /// Formats a range: `-20.0 … 200.0 °C (raw -200 … 2000)`, or with one limit `≥ -20.0 °C (raw ≥ -200)`.
    pub fn range(
        &self,
        limits: (Option<&Value>, Option<&Value>),
        raw: &dyn Fn(&Value) -> String,
        unit: &dyn Fn(&str) -> String,
    ) -> String {
        let raw = span((limits.0.map(raw), limits.1.map(raw)));
        match self.numbers(limits.0, limits.1) {
            Some(numbers) => format!("{} (raw {raw})", self.with_unit(&numbers, unit)),
            None => format!("raw {raw}"),
        }
    }

    /// Returns the raw value of a physical value: 1550 for `15.5` with scale factor 0.01. The raw value of an integer type is
    /// rounded to the nearest integer. Returns `None` if `text` is not a number, or if the raw value is not finite or too large.
    /// Also returns `None` if the scale depends on another item or on the model.
    pub fn raw(&self, text: &str, ty: Type) -> Option<Value> {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite())?;
        let exact = |factor, offset| Ratio::of_raw(text, factor, offset);
        let raw = match *self.scale {
            Scale::Linear { factor, offset } if !is_real(ty) => {
                return exact(factor, offset)
                    .and_then(|raw| raw.rounded())
                    .or_else(|| whole((number - offset) / factor))
                    .map(Value::Int);
            }
            Scale::Linear { factor, offset } => {
                exact(factor, offset).map_or((number - offset) / factor, |raw| raw.real())
            }
            Scale::Reciprocal { numerator } => numerator / number,
            _ => return None,
        };
        match is_real(ty) {
            true => raw.is_finite().then_some(Value::Real(raw)),
            false => whole(raw).map(Value::Int),
        }
    }

    /// Formats a value for a table that has a column for units: `25.0`, or `raw 250` if the physical value is unknown.
    pub fn cell(&self, value: &Value, raw: &dyn Fn(&Value) -> String) -> String {
        self.number(value).unwrap_or_else(|| format!("raw {}", raw(value)))
    }

    /// Formats a range for a table that has a column for units: `-20.0 … 200.0`, or `raw -200 … 2000`.
    pub fn range_cell(&self, limits: (Option<&Value>, Option<&Value>), raw: &dyn Fn(&Value) -> String) -> String {
        self.numbers(limits.0, limits.1)
            .unwrap_or_else(|| format!("raw {}", span((limits.0.map(raw), limits.1.map(raw)))))
    }

    /// Returns the range of the physical values: `-20.0 … 200.0`. Returns `None` if a physical value is unknown, or if the
    /// conversion has a pole in the range.
    fn numbers(&self, low: Option<&Value>, high: Option<&Value>) -> Option<String> {
        match (low.map(|low| self.number(low)), high.map(|high| self.number(high))) {
            (Some(None), _) | (_, Some(None)) => None,
            _ if self.has_pole_in(low, high) => None,
            (low, high) if self.is_falling() => Some(span((high.flatten(), low.flatten()))),
            (low, high) => Some(span((low.flatten(), high.flatten()))),
        }
    }

    /// Returns whether the range from `low` to `high` contains a pole of the conversion (division by zero). `None` means that the
    /// range has no minimum or no maximum.
    fn has_pole_in(&self, low: Option<&Value>, high: Option<&Value>) -> bool {
        let is_above = |value: Option<&Value>| value.and_then(Value::as_real).is_some_and(|value| value > 0.0);
        let is_below = |value: Option<&Value>| value.and_then(Value::as_real).is_some_and(|value| value < 0.0);
        matches!(self.scale, Scale::Reciprocal { .. }) && !is_above(low) && !is_below(high)
    }

    /// Returns whether the physical value decreases when the raw value increases.
    fn is_falling(&self) -> bool {
        match *self.scale {
            Scale::Linear { factor, .. } => factor < 0.0,
            Scale::Reciprocal { numerator } => numerator > 0.0,
            _ => false,
        }
    }

    /// Formats a difference between two values: `0.5 K (raw 5)`. The offset of the scale does not apply to a difference.
    pub fn step(&self, step: &Value, raw: &dyn Fn(&Value) -> String, unit: &dyn Fn(&str) -> String) -> String {
        match *self.scale {
            Scale::Linear { factor, .. } => {
                let scale = Scale::Linear { factor: factor.abs(), offset: 0.0 };
                Physical { unit: self.unit, scale: &scale }.value(step, raw, unit)
            }
            _ => format!("raw {}", raw(step)),
        }
    }

    fn with_unit(&self, number: &str, unit: &dyn Fn(&str) -> String) -> String {
        match self.unit {
            "" => number.to_owned(),
            text => format!("{number} {}", unit(text)),
        }
    }
}

/// Returns the unit that documentation shows for a quantity. A ratio is shown without a unit.
pub fn shown_unit(quantity: &Quantity) -> &str {
    if quantity.unit == "1" {
        ""
    } else {
        &quantity.unit
    }
}

/// Formats a range: `1 … 5`, `≥ 1`, `≤ 5`.
pub fn span(limits: (Option<String>, Option<String>)) -> String {
    match limits {
        (Some(low), Some(high)) => format!("{low} … {high}"),
        (Some(low), None) => format!("≥ {low}"),
        (None, Some(high)) => format!("≤ {high}"),
        (None, None) => String::new(),
    }
}

/// Returns whether a limit depends on the node-ID, which is only known at run time.
pub fn depends_on_node(limits: &Limits) -> bool {
    [&limits.low, &limits.high].into_iter().any(|limit| matches!(limit, Some(Value::NodeId(_))))
}

/// Returns the physical value with as many decimals as factor and offset have: raw value 250 with scale factor 0.1 is `25.0`. The
/// result is exact if the raw value is an integer, and neither factor nor offset has more than nine decimals. Otherwise, the result
/// is rounded as described at [`short`].
fn linear(raw: &Value, factor: f64, offset: f64) -> Option<String> {
    let exact = || {
        let (factor, offset) = (Decimal::of(factor)?, Decimal::of(offset)?);
        let places = factor.places.max(offset.places);
        let number = raw.as_int()?.checked_mul(factor.scaled(places)?)?.checked_add(offset.scaled(places)?)?;
        Some(Decimal { number, places }.text())
    };
    match exact() {
        Some(text) => Some(text),
        None => raw.as_real().map(|raw| short(raw * factor + offset)),
    }
}

fn is_real(ty: Type) -> bool {
    matches!(ty, Type::Real32 | Type::Real64)
}

/// Returns the nearest integer, or `None` if the number is not finite or too large.
fn whole(number: f64) -> Option<i128> {
    (number.is_finite() && number.abs() < 1e30).then(|| number.round() as i128)
}

/// The exact raw value of a physical value with a linear scale, as a fraction.
struct Ratio {
    numerator: i128,
    denominator: i128,
}

impl Ratio {
    /// Returns the raw value of the decimal number `text`, or `None` if factor, offset or `text` has too many digits, or if
    /// `text` has an exponent.
    fn of_raw(text: &str, factor: f64, offset: f64) -> Option<Self> {
        let (value, factor, offset) = (Decimal::parsed(text)?, Decimal::of(factor)?, Decimal::of(offset)?);
        let places = value.places.max(factor.places).max(offset.places);
        let numerator = value.scaled(places)?.checked_sub(offset.scaled(places)?)?;
        Some(Ratio { numerator, denominator: factor.scaled(places)? })
    }

    fn real(&self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// Returns the nearest integer, or `None` after an overflow or a division by zero. Halves are rounded away from zero.
    fn rounded(&self) -> Option<i128> {
        let (numerator, denominator) = (self.numerator.checked_abs()?, self.denominator.checked_abs()?);
        let raw = numerator.checked_mul(2)?.checked_add(denominator)?.checked_div(denominator.checked_mul(2)?)?;
        Some(if (self.numerator < 0) == (self.denominator < 0) { raw } else { -raw })
    }
}

/// A decimal number: `number` / 10^`places`.
struct Decimal {
    number: i128,
    places: u32,
}

impl Decimal {
    /// Returns the decimal number, or `None` if it is not finite or has more than nine decimals.
    fn of(number: f64) -> Option<Self> {
        Decimal::parsed(&number.to_string())
    }

    /// Returns the decimal number with this text. Returns `None` for other texts, for more than nine decimals, and for an
    /// exponent.
    fn parsed(text: &str) -> Option<Self> {
        let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
        let places = u32::try_from(decimals.len()).ok().filter(|places| *places <= 9)?;
        Some(Decimal { number: format!("{whole}{decimals}").parse().ok()?, places })
    }

    /// Returns the number in units of 10^-`places`, or `None` if the result is not an integer or overflows.
    fn scaled(&self, places: u32) -> Option<i128> {
        self.number.checked_mul(10_i128.checked_pow(places.checked_sub(self.places)?)?)
    }

    fn text(&self) -> String {
        let sign = if self.number < 0 { "-" } else { "" };
        let digits = format!("{:0>width$}", self.number.unsigned_abs(), width = self.places as usize + 1);
        let (whole, decimals) = digits.split_at(digits.len() - self.places as usize);
        let point = if decimals.is_empty() { "" } else { "." };
        format!("{sign}{whole}{point}{decimals}")
    }
}

/// Formats a number with at most six significant digits, but with all digits before the decimal point. Very small and
/// very large numbers have scientific notation.
fn short(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return (number + 0.0).to_string();
    }
    let exponent = number.abs().log10().floor() as i32;
    if !(-6..15).contains(&exponent) {
        let text = format!("{number:.5e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'));
    }
    let text = format!("{number:.*}", (5 - exponent).max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(value: i128, factor: f64, offset: f64, unit: &str) -> String {
        let quantity =
            Quantity { unit: unit.into(), scale: Some(Scale::Linear { factor, offset }), ..Quantity::default() };
        let physical = Physical::of(Some(&quantity)).expect("a scale");
        physical.value(&Value::Int(value), &Value::to_string, &str::to_owned)
    }

    #[test]
    fn the_physical_value_comes_first() {
        assert_eq!(written(250, 0.1, 0.0, "°C"), "25.0 °C (raw 250)");
        assert_eq!(written(-10_000, 0.01, 0.0, "rev/s"), "-100.00 rev/s (raw -10000)");
        assert_eq!(written(3, 1.0 / 3.0, 0.0, ""), "1 (raw 3)");
        assert_eq!(written(1000, 0.5, -273.15, "°C"), "226.85 °C (raw 1000)");
        assert_eq!(written(1, 4.882_812_5e-4, 0.0, "V"), "0.000488281 V (raw 1)");
        assert_eq!(written(3, 1e-14, 0.0, "m"), "3e-14 m (raw 3)");
        assert_eq!(written(-5, 0.1, 0.0, ""), "-0.5 (raw -5)");
        let (most, digits) = (i128::from(u64::MAX), "1844674407370955161.5 (raw 18446744073709551615)");
        assert_eq!(written(most, 0.1, 0.0, ""), digits, "the number needs more than 53 bits");
        assert_eq!(written(most, 1.0, -1.0, ""), "18446744073709551614 (raw 18446744073709551615)");
        let unscaled = Quantity { unit: "ms".into(), ..Quantity::default() };
        assert!(Physical::of(Some(&unscaled)).is_none() && Physical::of(None).is_none());
    }

    #[test]
    fn a_physical_value_becomes_the_nearest_raw_value() {
        let raw = |text: &str, scale: Scale| {
            Physical { unit: "", scale: &scale }.raw(text, Type::Integer(64)).and_then(|raw| raw.as_int())
        };
        let linear = |factor, offset| Scale::Linear { factor, offset };
        assert_eq!(raw("15.5", linear(0.01, 0.0)), Some(1550));
        assert_eq!(raw("-15.5", linear(0.01, 0.0)), Some(-1550));
        assert_eq!(raw("15.504", linear(0.01, 0.0)), Some(1550));
        assert_eq!(raw("15.505", linear(0.01, 0.0)), Some(1551));
        assert_eq!(raw("-15.505", linear(0.01, 0.0)), Some(-1551));
        assert_eq!(raw("226.85", linear(0.5, -273.15)), Some(1000));
        assert_eq!(raw("-1.5", linear(-0.5, 0.0)), Some(3));
        assert_eq!(raw("1844674407370955161.5", linear(0.1, 0.0)), Some(u64::MAX.into()));
        assert_eq!(raw("1e3", linear(0.1, 0.0)), Some(10_000));
        assert_eq!(raw("1", linear(1.0 / 3.0, 0.0)), Some(3));
        assert_eq!(raw("6250000", Scale::Reciprocal { numerator: 25e6 }), Some(4));
        assert_eq!(raw("0", Scale::Reciprocal { numerator: 25e6 }), None);
        assert_eq!(raw("inf", linear(0.1, 0.0)), None);
        assert_eq!(raw("x", linear(0.1, 0.0)), None);
        assert_eq!(raw("1", linear(0.0, 0.0)), None);
        assert_eq!(raw(&i128::MAX.to_string(), linear(0.1, 0.0)), None, "too large");
        assert_eq!(raw("1", Scale::Fraction { bits: 15, base: "I".into() }), None);
    }

    #[test]
    fn the_raw_value_of_a_real_type_is_not_rounded() {
        let raw = |text: &str, scale: Scale| Physical { unit: "", scale: &scale }.raw(text, Type::Real64);
        let linear = |factor, offset| Scale::Linear { factor, offset };
        assert_eq!(raw("0.3", linear(0.1, 0.0)), Some(Value::Real(3.0)), "the quotient of the decimal numbers");
        assert_eq!(raw("-0.25", linear(2.0, 0.0)), Some(Value::Real(-0.125)));
        assert_eq!(raw("1e-3", linear(0.5, -0.5)), Some(Value::Real(1.002)));
        assert_eq!(raw("8", Scale::Reciprocal { numerator: 2.0 }), Some(Value::Real(0.25)));
        assert_eq!(raw("0", Scale::Reciprocal { numerator: 2.0 }), None);
        assert_eq!(raw("1", linear(0.0, 0.0)), None);
        assert_eq!(raw("x", linear(0.1, 0.0)), None);
    }

    #[test]
    fn ranges_go_from_the_lower_physical_value_to_the_upper_one() {
        let range = |scale: Scale, low: Option<i128>, high: Option<i128>| {
            let (low, high) = (low.map(Value::Int), high.map(Value::Int));
            let physical = Physical { unit: "Hz", scale: &scale };
            physical.range((low.as_ref(), high.as_ref()), &Value::to_string, &str::to_owned)
        };
        let linear = |factor| Scale::Linear { factor, offset: 0.0 };
        assert_eq!(range(linear(0.1), Some(-200), Some(2000)), "-20.0 … 200.0 Hz (raw -200 … 2000)");
        assert_eq!(range(linear(-0.5), Some(0), Some(3)), "-1.5 … 0.0 Hz (raw 0 … 3)");
        assert_eq!(range(linear(0.1), Some(5), None), "≥ 0.5 Hz (raw ≥ 5)");
        assert_eq!(range(Scale::Reciprocal { numerator: 25e6 }, Some(1), Some(4)), "6250000 … 25000000 Hz (raw 1 … 4)");
        assert_eq!(
            range(Scale::Reciprocal { numerator: 1.0 }, Some(-5), Some(5)),
            "raw -5 … 5",
            "the physical value of raw 0 is undefined"
        );
        assert_eq!(range(Scale::Reciprocal { numerator: 1.0 }, Some(0), Some(4)), "raw 0 … 4", "1 / 0 is undefined");
        let by_item = Scale::ByItem { item: "Base".into(), factor: 1.0 };
        assert_eq!(range(by_item, Some(0), Some(4)), "raw 0 … 4");
    }
}
