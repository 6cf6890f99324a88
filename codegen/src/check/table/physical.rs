//! Physical values: the conversion of raw values, and constants of the machine that the device drives.

use crate::ir::{CompactString, Device, GivenRef, MachineUnit, Scale, Variant, VariantId};

/// Returns the physical value of a raw value. `other` returns the values that the scale depends on: constants of a model, and
/// other items.
pub(super) fn of_raw<E>(
    scale: Option<&Scale>,
    raw: f64,
    other: impl Fn(&CompactString) -> Result<f64, E>,
) -> Result<f64, E> {
    Ok(match scale {
        None => raw,
        Some(Scale::Linear { factor, offset }) => raw * factor + offset,
        Some(Scale::Reciprocal { numerator }) => numerator / raw,
        Some(Scale::Fraction { bits, base }) => raw / 2f64.powi((*bits).into()) * other(base)?,
        Some(Scale::Exponent { exponent, base, fraction }) => {
            raw / 2f64.powi((*fraction).into()) * f64::from(*base).powf(other(exponent)?)
        }
        Some(Scale::ByItem { item, factor }) => raw * factor / other(item)?,
        Some(Scale::TimesItem { item, factor }) => raw * factor * other(item)?,
    })
}

/// Returns the ratio of a value in the machine unit to the physical value. `number` returns the value of a machine constant.
pub(super) fn ratio<E>(unit: &MachineUnit, number: impl Fn(&GivenRef) -> Result<f64, E>) -> Result<f64, E> {
    let product = |list: &[GivenRef]| list.iter().map(&number).product::<Result<f64, E>>();
    Ok(product(&unit.times)? / product(&unit.over)?)
}

/// Returns the value of a model's constant, or `None` if the model has no numeric constant with this name.
pub(super) fn constant(model: Option<&Variant>, name: &str) -> Option<f64> {
    model?.constants.iter().find(|(constant, _)| constant == name)?.1.as_real()
}

/// Returns the value of a machine constant (`[given]`) for a model, if the table defines the value.
pub(super) fn given(device: &Device, model: VariantId, number: &GivenRef) -> Option<f64> {
    let models = &device.given_number(number)?.models;
    models.iter().find(|(other, _)| other.id == Some(model))?.1.as_real()
}

/// Rounds a number to `digits` digits after the first significant digit.
pub(super) fn rounded(number: f64, digits: f64) -> f64 {
    let factor = 10f64.powf((digits - number.abs().log10().floor()).clamp(-300.0, 300.0));
    match (number * factor).round() / factor {
        rounded if rounded.is_finite() => rounded,
        _ => number,
    }
}
