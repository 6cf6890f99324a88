//! Types of numbers that have a scale or raw values with a special meaning.

use super::code::{generic, list, Doc};
use super::context::Context;
use crate::ir::{Item, Quantity, Scale};

/// The Rust type of a quantity.
pub(super) struct QuantityType {
    /// Path of the type in the runtime crate, with its generic arguments.
    pub path: Doc,
    /// Name of the type for use in other names.
    pub word: String,
}

/// Returns the type of an item's value. Returns `None` if the value is not a number, if it has neither a scale nor raw
/// values with a special meaning, or if its scale differs between models or buses. Also returns `None` if no type of
/// the runtime can express the scale.
pub(super) fn of(context: &Context<'_>, item: &Item) -> Option<QuantityType> {
    let quantity = item.quantity.as_ref()?;
    if item.variants.iter().any(|variant| variant.scale.is_some()) {
        return None;
    }
    let ty = context.value_type(item.ty);
    if !ty.is_real() {
        ty.native()?;
    }
    let sentinels = if ty.is_real() { Vec::new() } else { sentinels(quantity) };
    let (base, word) = (&*ty.path(), ty.word());
    let mut quantity_type = match &quantity.scale {
        None if sentinels.is_empty() => return None,
        None => linear(base, &word, 1.0, 0.0)?,
        Some(Scale::Linear { factor, offset }) => linear(base, &word, *factor, *offset)?,
        Some(Scale::Reciprocal { numerator }) => by_fraction("Reciprocal", base, &word, *numerator)?,
        Some(Scale::ByItem { factor, .. }) => by_fraction("PerItem", base, &word, *factor)?,
        Some(Scale::Fraction { bits, .. }) => {
            QuantityType { path: generic!("rt::Fraction", base, *bits), word: format!("Fraction{bits}Of{word}") }
        }
        // No type of the runtime multiplies a value by the value of another item, so the program must do this.
        Some(Scale::TimesItem { .. }) => return None,
        Some(Scale::Exponent { base: 10, fraction: 0, .. }) => {
            QuantityType { path: generic!("rt::Exponential", base), word: format!("Exponential{word}") }
        }
        Some(Scale::Exponent { base: raised, fraction, .. }) => QuantityType {
            path: generic!("rt::Exponential", base, *raised, *fraction),
            word: format!("Exponential{raised}Of{fraction}Bits{word}"),
        },
    };
    for (raw, _) in sentinels {
        quantity_type = QuantityType {
            path: generic!("rt::OrNone", quantity_type.path, raw),
            word: format!("{}OrNone{}", quantity_type.word, spelled(raw)),
        };
    }
    Some(quantity_type)
}

/// Returns the raw values with a special meaning, each with the name of the meaning, without repetitions.
fn sentinels(quantity: &Quantity) -> Vec<(i128, &str)> {
    let mut list: Vec<(i128, &str)> = Vec::new();
    for (value, name) in &quantity.sentinels {
        if let Some(raw) = value.as_int().filter(|raw| !list.iter().any(|(known, _)| known == raw)) {
            list.push((raw, name));
        }
    }
    list
}

fn linear(base: &str, word: &str, factor: f64, offset: f64) -> Option<QuantityType> {
    let (num, den, offset) = common(factor, offset)?;
    let arguments = match (den, offset) {
        (1, 0) => vec![num],
        (_, 0) => vec![num, den],
        _ => vec![num, den, offset],
    };
    let plus = if offset == 0 { String::new() } else { format!("Plus{}", spelled(offset.into())) };
    Some(QuantityType {
        path: with_numbers("rt::Scaled", base, &arguments),
        word: format!("{word}Times{}Per{den}{plus}", spelled(num.into())),
    })
}

fn by_fraction(name: &str, base: &str, word: &str, factor: f64) -> Option<QuantityType> {
    let (num, den) = rational(factor)?;
    let arguments = if den == 1 { vec![num] } else { vec![num, den] };
    Some(QuantityType {
        path: with_numbers(&format!("rt::{name}"), base, &arguments),
        word: format!("{name}{word}Times{}Per{den}", spelled(num.into())),
    })
}

/// Returns the path of a type with `base` and these numbers as generic arguments.
fn with_numbers(path: &str, base: &str, numbers: &[i64]) -> Doc {
    let parameters = std::iter::once(base.to_owned()).chain(numbers.iter().map(i64::to_string));
    list(&format!("{path}<"), parameters, ">")
}

fn spelled(number: i128) -> String {
    if number < 0 {
        format!("Minus{}", number.unsigned_abs())
    } else {
        number.to_string()
    }
}

/// Converts `factor` and `offset` to fractions with a common denominator. Returns the numerator of the factor, the
/// denominator, and the numerator of the offset. Returns `None` if `factor` or an `offset` other than 0 has no fraction
/// (see [`rational`]), or if a result does not fit in 64 bits.
fn common(factor: f64, offset: f64) -> Option<(i64, i64, i64)> {
    let (num, den) = rational(factor)?;
    if offset == 0.0 {
        return Some((num, den, 0));
    }
    let (shift, parts) = rational(offset)?;
    let both = i128::from(den) / i128::from(gcd(den, parts)) * i128::from(parts);
    let of = |num: i64, den: i64| i64::try_from(i128::from(num).checked_mul(both / i128::from(den))?).ok();
    Some((of(num, den)?, i64::try_from(both).ok()?, of(shift, parts)?))
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 {
        a
    } else {
        gcd(b, a % b)
    }
}

/// Returns the first convergent of the continued fraction of `real` whose quotient, as an `f64`, is `real`: 0.01 gives
/// 1/100. Returns `None` for 0, subnormal numbers, NaN and infinity, and if the numerator or denominator does not fit
/// in 64 bits.
fn rational(real: f64) -> Option<(i64, i64)> {
    if !real.is_normal() {
        return None;
    }
    let bits = real.abs().to_bits();
    let exponent = (bits >> 52) as i32 - 1075;
    let mantissa = i128::from(bits & ((1 << 52) - 1) | 1 << 52);
    let (mut p, mut q) = match exponent {
        0..=62 => (mantissa << exponent, 1),
        -126..=-1 => (mantissa, 1_i128 << -exponent),
        _ => return None,
    };
    // Use continued fractions: no fraction with a smaller denominator is nearer to the number than the result of a
    // step.
    let ((mut num, mut den), mut last) = ((1_i128, 0_i128), (0_i128, 1_i128));
    loop {
        let whole = p / q;
        let next = (whole.checked_mul(num)?.checked_add(last.0)?, whole.checked_mul(den)?.checked_add(last.1)?);
        (last, (num, den)) = ((num, den), next);
        let (small, parts) = (i64::try_from(num).ok()?, i64::try_from(den).ok()?);
        if num as f64 / den as f64 == real.abs() {
            return Some((if real < 0.0 { -small } else { small }, parts));
        }
        (p, q) = (q, p - whole * q);
        if q == 0 {
            return None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simplest_fractions() {
        for (real, fraction) in [
            (0.01, (1, 100)),
            (0.08, (2, 25)),
            (-0.1, (-1, 10)),
            (25e6, (25_000_000, 1)),
            (1.0 / 3.0, (1, 3)),
            (0.000_030_517_578_125, (1, 32_768)),
            (1e-9, (1, 1_000_000_000)),
            (4.8828125e-4, (1, 2048)),
        ] {
            assert_eq!(rational(real), Some(fraction), "{real}");
        }
        for real in [0.0, f64::NAN, f64::INFINITY, 1e-300, 1e300, 1e19] {
            assert_eq!(rational(real), None, "{real}");
        }
        let odd = 9.587_379_924_285_257e-5;
        let (num, den) = rational(odd).expect("two numbers");
        assert_eq!(num as f64 / den as f64, odd);
    }

    #[test]
    fn offsets_share_the_denominator() {
        assert_eq!(common(0.1, -40.0), Some((1, 10, -400)));
        assert_eq!(common(0.5, 273.15), Some((10, 20, 5463)));
        assert_eq!(common(1.0, 0.0), Some((1, 1, 0)));
    }
}
