//! Random values and limits.

use lexibus_codegen::ir::{Limits, Type, Value};

use super::bytes::Bytes;
use super::names;

/// Returns an integer. Most integers are small, and some are at the limit of a type.
pub fn number(b: &mut Bytes<'_>) -> i128 {
    match b.within(0..=7) {
        0..=3 => b.within(0..=9),
        4 => b.within(-3..=300),
        5 => (1_i128 << b.within(0_u32..=64)) - 1,
        6 => -(1_i128 << b.within(0_u32..=63)),
        _ => i128::from(b.any::<i64>()),
    }
}

/// Returns a floating-point number.
pub fn real(b: &mut Bytes<'_>) -> f64 {
    const REALS: [f64; 16] = [
        1.0,
        0.1,
        -0.01,
        0.5,
        100.0,
        -40.0,
        0.0,
        -0.0,
        std::f64::consts::PI,
        std::f64::consts::E,
        1.0 / 3.0,
        1e300,
        f64::MAX,
        f64::MIN_POSITIVE,
        f64::INFINITY,
        f64::NAN,
    ];
    match b.one_in(6) {
        true => f64::from_bits(b.any()),
        false => b.pick(&REALS),
    }
}

/// Returns a value that the type can usually represent.
pub fn of(b: &mut Bytes<'_>, ty: Type) -> Value {
    if b.one_in(8) {
        return any(b);
    }
    match ty {
        Type::Boolean => Value::Bool(b.any()),
        Type::Integer(_) | Type::Unsigned(_) => Value::Int(within(b, ty)),
        Type::Real32 | Type::Real64 => Value::Real(real(b)),
        Type::VisibleString(_) | Type::UnicodeString(_) => Value::Text(names::text(b)),
        Type::TimeOfDay | Type::TimeDifference => Value::Time { milliseconds: b.any(), days: b.any() },
        Type::OctetString(_) | Type::Domain | Type::Time(_) | Type::Opaque(_) => Value::Bytes(b.list(6, Bytes::any)),
        Type::Named(_) => any(b),
    }
}

fn within(b: &mut Bytes<'_>, ty: Type) -> i128 {
    match ty.integer_range() {
        Some((low, high)) if b.one_in(4) => b.pick(&[low, high]),
        Some((low, high)) => number(b).clamp(low, high),
        None => number(b),
    }
}

/// Returns a value of any kind.
pub fn any(b: &mut Bytes<'_>) -> Value {
    match b.within(0..=7) {
        0 => Value::Bool(b.any()),
        1 | 2 => Value::Int(number(b)),
        3 => Value::Real(real(b)),
        4 => Value::Text(names::text(b)),
        5 => Value::Bytes(b.list(6, Bytes::any)),
        6 => Value::NodeId(b.pick(&[0, 0x600, -5, 1 << 40])),
        _ => Value::Raw(names::text(b)),
    }
}

/// Returns limits. The minimum is usually not greater than the maximum.
pub fn limits(b: &mut Bytes<'_>, ty: Type) -> Limits {
    if b.one_in(2) {
        return Limits::default();
    }
    let (mut low, mut high) = (b.maybe(2, |b| of(b, ty)), b.maybe(2, |b| of(b, ty)));
    let is_swapped = low.as_ref().zip(high.as_ref()).is_some_and(|(low, high)| low.as_real() > high.as_real());
    if is_swapped && !b.one_in(8) {
        std::mem::swap(&mut low, &mut high);
    }
    let allowed: Vec<(Value, Value)> = b.few(4, 4, |b| {
        let first = of(b, ty);
        let last = b.maybe(2, |b| of(b, ty)).filter(|last| last.as_real() >= first.as_real());
        (first.clone(), last.unwrap_or(first))
    });
    let text = if matches!(ty, Type::VisibleString(_)) { names::version(b) } else { Default::default() };
    Limits { low, high, allowed: allowed.into(), text }
}
