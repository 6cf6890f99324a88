//! Values: defaults, limits, configured values, labels of enumerations.

use std::cmp::Ordering;
use std::fmt;

use thin_vec::ThinVec;

use super::{CompactString, Type};

/// A value as its source means it, converted to its type.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Value {
    /// A BOOLEAN.
    Bool(bool),
    /// An integer of any width and sign.
    Int(i128),
    /// A real number; also the value of an integer type's limit where the source gives a fraction.
    Real(#[cfg_attr(feature = "serde", serde(with = "super::real"))] f64),
    /// A text.
    Text(CompactString),
    /// An octet string.
    Bytes(Vec<u8>),
    /// `$NODEID + offset`: known only once the device has its node-ID (CiA 306, formulas).
    NodeId(i128),
    /// A time of day or a difference: milliseconds and days (CiA 301 7.1.6.5, 7.1.6.6).
    Time {
        /// Milliseconds after midnight.
        milliseconds: u32,
        /// Days since 1984-01-01, or days of a difference.
        days: u16,
    },
    /// Text that could not be converted to the item's type; a diagnostic said so.
    Raw(CompactString),
}

impl Value {
    /// The number, where the value is an integer or a boolean.
    pub fn as_int(&self) -> Option<i128> {
        match self {
            Value::Int(value) => Some(*value),
            Value::Bool(value) => Some(i128::from(*value)),
            _ => None,
        }
    }

    /// The value with `$NODEID` resolved.
    pub fn resolved(&self, node_id: u8) -> Value {
        match self {
            Value::NodeId(offset) => Value::Int(offset + i128::from(node_id)),
            other => other.clone(),
        }
    }

    /// Compares two numbers; `None` if one is no number.
    pub fn compare(&self, other: &Value) -> Option<Ordering> {
        match (self.as_int(), other.as_int()) {
            (Some(one), Some(other)) => Some(one.cmp(&other)),
            _ => self.as_real()?.partial_cmp(&other.as_real()?),
        }
    }

    /// The number as a real, for comparisons across integer and real values.
    pub fn as_real(&self) -> Option<f64> {
        match self {
            Value::Real(value) => Some(*value),
            other => other.as_int().map(|value| value as f64),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Bool(value) => write!(f, "{value}"),
            Value::Int(value) => write!(f, "{value}"),
            Value::Real(value) => write!(f, "{value}"),
            Value::Text(value) => write!(f, "{value:?}"),
            Value::Bytes(bytes) => bytes.iter().try_for_each(|byte| write!(f, "{byte:02X}")),
            Value::NodeId(0) => write!(f, "$NODEID"),
            Value::NodeId(offset @ ..0) => write!(f, "$NODEID+{offset}"),
            Value::NodeId(offset) => write!(f, "$NODEID+{offset:#X}"),
            Value::Time { milliseconds, days } => write!(f, "{days} d {milliseconds} ms"),
            Value::Raw(text) => write!(f, "`{text}`"),
        }
    }
}

/// Inclusive limits of a value.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// The least value.
    pub low: Option<Value>,
    /// The greatest value.
    pub high: Option<Value>,
    /// Where the values are a list, or several ranges: first and last of each, in the order of the source. `low` and
    /// `high` are the least and the greatest of them.
    pub allowed: ThinVec<(Value, Value)>,
}

impl Limits {
    /// Whether neither limit is given.
    pub fn is_empty(&self) -> bool {
        self.low.is_none() && self.high.is_none()
    }

    /// Returns the lower and the upper limit that are integers.
    pub fn integers(&self) -> (Option<i128>, Option<i128>) {
        let integer = |limit: &Option<Value>| limit.as_ref().and_then(Value::as_int);
        (integer(&self.low), integer(&self.high))
    }

    /// Returns whether the lower limit is above the upper one. Limits of an integer are rounded to the integers between them.
    pub fn are_swapped(&self, ty: Type) -> bool {
        let (Some(low), Some(high)) = (&self.low, &self.high) else { return false };
        let is_whole = matches!(ty, Type::Integer(_) | Type::Unsigned(_));
        match (low.as_real(), high.as_real()) {
            (Some(low), Some(high)) if is_whole && low.ceil() > high.floor() => true,
            _ => low.compare(high) == Some(Ordering::Greater),
        }
    }
}

/// Why limits exclude a value.
pub(crate) enum Excluded<'l> {
    Below(&'l Value),
    Above(&'l Value),
    NotAllowed,
}

impl fmt::Display for Excluded<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Excluded::Below(low) => write!(f, "below the lower limit {low}"),
            Excluded::Above(high) => write!(f, "above the upper limit {high}"),
            Excluded::NotAllowed => f.write_str("none of the allowed values"),
        }
    }
}

/// Returns why limits exclude a value. Values that are no numbers are never excluded.
pub(crate) fn excluded<'l>(limits: &'l Limits, value: &Value) -> Option<Excluded<'l>> {
    let is = |limit: &&Value, order| value.compare(limit) == Some(order);
    let below = || limits.low.as_ref().filter(|low| is(low, Ordering::Less)).map(Excluded::Below);
    let above = || limits.high.as_ref().filter(|high| is(high, Ordering::Greater)).map(Excluded::Above);
    let not_allowed = || (!is_allowed(value, &limits.allowed)).then_some(Excluded::NotAllowed);
    below().or_else(above).or_else(not_allowed)
}

/// Whether a number is in one of the ranges, where there are any.
fn is_allowed(value: &Value, allowed: &[(Value, Value)]) -> bool {
    let within = |(first, last): &(Value, Value)| {
        first.compare(value).is_none_or(|order| order != Ordering::Greater)
            && value.compare(last).is_none_or(|order| order != Ordering::Greater)
    };
    allowed.is_empty() || allowed.iter().any(within)
}
