//! Values, limits of values, and reasons why limits exclude a value.

use std::cmp::Ordering;
use std::fmt;

use thin_vec::ThinVec;

use super::rare::Missing;
use super::{CompactString, Type};
use crate::number::hex;

/// A value, converted to the type of its item.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Value {
    /// A BOOLEAN value.
    Bool(bool),
    /// An integer value of any width and sign.
    Int(i128),
    /// A real number; also a fractional limit of an integer.
    Real(#[cfg_attr(feature = "serde", serde(with = "super::real"))] f64),
    /// A string value.
    Text(CompactString),
    /// An octet string value.
    Bytes(Vec<u8>),
    /// `$NODEID + offset`, which depends on the node-ID of the device (CiA 306, formulas).
    NodeId(i128),
    /// TIME_OF_DAY or TIME_DIFFERENCE (CiA 301 7.1.6.5, 7.1.6.6).
    Time {
        /// Milliseconds after midnight, or milliseconds of the difference in addition to its days.
        milliseconds: u32,
        /// Days since 1984-01-01, or days of the difference.
        days: u16,
    },
    /// A text that was not converted to the type of the item. The text is a value of a DOMAIN or of an unknown type, or an
    /// unreadable value. A diagnostic reports values of a DOMAIN and unreadable values.
    Raw(CompactString),
}

impl Value {
    /// Returns the number, if the value is an integer or a boolean.
    pub fn as_int(&self) -> Option<i128> {
        match self {
            Value::Int(value) => Some(*value),
            Value::Bool(value) => Some(i128::from(*value)),
            _ => None,
        }
    }

    /// Returns the value for this node-ID: replaces `$NODEID + offset` with a number.
    pub fn resolved(&self, node_id: u8) -> Value {
        match self {
            Value::NodeId(offset) => Value::Int(offset + i128::from(node_id)),
            other => other.clone(),
        }
    }

    /// Compares two numbers. Returns `None` if at least one of the two values is not a number.
    pub fn compare(&self, other: &Value) -> Option<Ordering> {
        match (self.as_int(), other.as_int()) {
            (Some(one), Some(other)) => Some(one.cmp(&other)),
            _ => self.as_real()?.partial_cmp(&other.as_real()?),
        }
    }

    /// Returns the value as a real number, if it is a number. Use this method to compare integers with real values.
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
            Value::NodeId(offset) => write!(f, "$NODEID+{}", hex(*offset)),
            Value::Time { milliseconds, days } => write!(f, "{days} d {milliseconds} ms"),
            Value::Raw(text) => write!(f, "`{text}`"),
        }
    }
}

/// Inclusive limits of a value.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// Minimum of the value.
    pub low: Option<Value>,
    /// Maximum of the value.
    pub high: Option<Value>,
    /// Allowed ranges in the order of the source, if there are several ranges or a list of values. Each range has a minimum and a
    /// maximum. `low` and `high` are the minimum and maximum of all ranges.
    pub allowed: ThinVec<(Value, Value)>,
    /// Allowed values as the source spells them, if the type of the item is not a number (GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub text: CompactString,
}

impl Missing for Limits {
    fn missing() -> &'static Self {
        static MISSING: Limits =
            Limits { low: None, high: None, allowed: ThinVec::new(), text: CompactString::const_new("") };
        &MISSING
    }
}

impl Limits {
    /// Returns whether the limits contain neither a minimum nor a maximum.
    pub fn is_empty(&self) -> bool {
        self.low.is_none() && self.high.is_none()
    }

    /// Returns the minimum and the maximum. A limit that is neither an integer nor a boolean is `None`.
    pub fn integers(&self) -> (Option<i128>, Option<i128>) {
        let integer = |limit: &Option<Value>| limit.as_ref().and_then(Value::as_int);
        (integer(&self.low), integer(&self.high))
    }

    /// Returns whether the minimum is above the maximum. Limits of an integer type are rounded inwards before the comparison.
    pub fn are_swapped(&self, ty: Type) -> bool {
        let (Some(low), Some(high)) = (&self.low, &self.high) else { return false };
        let is_whole = matches!(ty, Type::Integer(_) | Type::Unsigned(_));
        match (low.as_real(), high.as_real()) {
            (Some(low), Some(high)) if is_whole && low.ceil() > high.floor() => true,
            _ => low.compare(high) == Some(Ordering::Greater),
        }
    }
}

/// The reason why limits exclude a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Excluded<'l> {
    /// The value is below this minimum.
    Below(&'l Value),
    /// The value is above this maximum.
    Above(&'l Value),
    /// The value is in none of the allowed ranges.
    NotAllowed,
}

impl fmt::Display for Excluded<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Excluded::Below(low) => write!(f, "below the minimum {low}"),
            Excluded::Above(high) => write!(f, "above the maximum {high}"),
            Excluded::NotAllowed => f.write_str("not one of the allowed values"),
        }
    }
}

/// Returns the reason why limits exclude a value, or `None` if the limits allow the value. Values that are not numbers are never
/// excluded.
pub fn excluded<'l>(limits: &'l Limits, value: &Value) -> Option<Excluded<'l>> {
    let is = |limit: &&Value, order| value.compare(limit) == Some(order);
    let below = || limits.low.as_ref().filter(|low| is(low, Ordering::Less)).map(Excluded::Below);
    let above = || limits.high.as_ref().filter(|high| is(high, Ordering::Greater)).map(Excluded::Above);
    let not_allowed = || (!is_allowed(value, &limits.allowed)).then_some(Excluded::NotAllowed);
    below().or_else(above).or_else(not_allowed)
}

/// Returns whether a number is in one of the allowed ranges. Also returns true if the list of ranges is empty.
fn is_allowed(value: &Value, allowed: &[(Value, Value)]) -> bool {
    let within = |(first, last): &(Value, Value)| {
        first.compare(value).is_none_or(|order| order != Ordering::Greater)
            && value.compare(last).is_none_or(|order| order != Ordering::Greater)
    };
    allowed.is_empty() || allowed.iter().any(within)
}
