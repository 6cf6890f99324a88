//! Checks example conversions that the manual prints. The printed physical value may differ by at most 1 LSB from the
//! physical value that the scale determines.

use super::physical;
use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{stated, Conversion, Device, Item, MachineUnit, Quantity, Scale};
use crate::text::brief;

/// The number of digits after the first significant digit. The resulting seven digits are enough for a raw value of 16
/// bits.
const DIGITS: f64 = 6.0;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Context { device, owner, .. } = context;
    let fields = device.messages.iter().flat_map(|message| message.values().map(|value| &value.item));
    for item in owner.items().chain(fields) {
        let Some(quantity) = stated::quantity(item) else { continue };
        for conversion in &quantity.conversions {
            if let Some((text, help)) = problem(device, item, quantity, conversion) {
                diagnostics.push(codes::CONVERSION_DIFFERS.at(conversion.at, text).help(help));
            }
        }
    }
}

/// Returns the problem in an example conversion, and a help text. The problem is that the printed and the computed
/// physical value differ by more than 1 LSB, or that no physical value can be computed.
fn problem(
    device: &Device,
    item: &Item,
    quantity: &Quantity,
    conversion: &Conversion,
) -> Option<(String, &'static str)> {
    let (raw, value) = (conversion.raw? as f64, conversion.value?);
    let name = brief(&item.name);
    let unit = conversion.unit.as_ref().unwrap_or(&quantity.unit);
    let convert = |raw: f64| {
        physical(device, quantity, conversion, raw).and_then(|number| in_unit(device, quantity, conversion, number))
    };
    let (below, exact, above) = match (convert(raw - 1.0), convert(raw), convert(raw + 1.0)) {
        (Ok(below), Ok(exact), Ok(above)) => (below, exact, above),
        (Err(why), ..) | (_, Err(why), _) | (.., Err(why)) => {
            let text = format!("the conversion of `{name}` cannot be checked: {why}");
            return Some((text, "correct the keys of the conversion, or delete the conversion"));
        }
    };
    let (low, high) = (below.min(above), below.max(above));
    let is_within = low <= value && value <= high || low.is_nan() || high.is_nan();
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    (!is_within).then(|| {
        let converted = physical::rounded(exact, DIGITS);
        let text = format!("according to the scale of `{name}`, the raw value {raw} is {converted}{unit}, not {value}");
        (text, "keep the numbers that are consistent, and add a `doubt`")
    })
}

/// Returns the physical value of a raw value. Returns an error text if the scale needs a value that neither the conversion
/// nor its model states.
fn physical(device: &Device, quantity: &Quantity, conversion: &Conversion, raw: f64) -> Result<f64, String> {
    let model = conversion.model.as_ref().and_then(|model| device.variant(model));
    physical::of_raw(quantity.scale.as_ref(), raw, |name| {
        let constant = matches!(quantity.scale, Some(Scale::Fraction { .. })).then(|| physical::constant(model, name));
        constant
            .flatten()
            .or(conversion.by)
            .ok_or_else(|| format!("the key `by`, which holds the value of `{}`, is missing", brief(name)))
    })
}

/// Converts the physical value `number` to the unit of the example conversion. Returns an error text if this unit is neither
/// the unit of the item nor its machine unit, or if a machine constant has no value.
fn in_unit(device: &Device, quantity: &Quantity, conversion: &Conversion, number: f64) -> Result<f64, String> {
    let Some(unit) = conversion.unit.as_ref().filter(|unit| **unit != quantity.unit) else { return Ok(number) };
    match quantity.machine.as_deref().filter(|machine| machine.unit == *unit) {
        Some(machine) => Ok(number * ratio(device, machine, conversion)?),
        None => Err(format!("the unit `{}` is neither the unit of the item nor its machine unit", brief(unit))),
    }
}

/// Returns the ratio of a value in the machine unit to the physical value.
fn ratio(device: &Device, unit: &MachineUnit, conversion: &Conversion) -> Result<f64, String> {
    let model = conversion.model.as_ref().and_then(|model| model.id);
    physical::ratio(unit, |number| {
        let in_example = conversion.given.iter().find(|(given, _)| given == number).map(|(_, value)| *value);
        let value = in_example.or_else(|| physical::given(device, model?, number));
        value.ok_or_else(|| format!("the value of `{}` is missing in `given`", brief(number)))
    })
}
