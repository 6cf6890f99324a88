//! Checks items that contain the same quantity in two scales: their defaults must be the same physical value on every model.

use std::convert::Infallible;

use super::physical;
use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{stated, CompactString, Device, GivenRef, Item, MachineUnit, Scale, Value, Variant, VariantId};
use crate::text::{brief, glob};

/// The relative difference that two defaults may have because they were rounded to different raw values.
const TOLERANCE: f64 = 0.001;

/// The number of digits after the first significant digit. The resulting five digits make a difference of one thousandth visible.
const DIGITS: f64 = 4.0;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let Context { device, owner, .. } = context;
    for (_, id, item) in owner.identified() {
        let view = item.related.as_ref().and_then(|related| related.same_quantity.as_ref());
        let other = view.filter(|view| view.id != Some(id)).and_then(|view| device.referred(view));
        let Some(other) = other else { continue };
        let differences = differences(device, item, other);
        if let Some((first, others)) = differences.split_first() {
            let names = format!("`{}` and `{}`", brief(&item.name), brief(&other.name));
            let message = format!("{names} are declared as the same quantity, but {first}");
            let found = codes::QUANTITIES_DIFFER.at(item.at.default.or(item.origin.span), message);
            let found = others.iter().fold(found, |found, other| found.note(format!("{names} also differ: {other}")));
            diagnostics.push(found.note_at(other.at.default.or(other.origin.span), "the other item"));
        }
    }
}

/// Returns the differences between the defaults on each model, or the reason why the defaults cannot be compared.
fn differences(device: &Device, one: &Item, other: &Item) -> Vec<String> {
    let models: Vec<Option<VariantId>> = match device.variants.as_slice() {
        [] => vec![None],
        variants => (0..).map(VariantId).zip(variants).map(|(id, _)| Some(id)).collect(),
    };
    let mut found = Vec::new();
    for model in models {
        let of = |item| Physical::new(device, item, model);
        let (Some(one), Some(other)) = (of(one), of(other)) else { continue };
        let (one, other) = match (&one.machine, &other.machine) {
            _ if one.unit == other.unit => ((one.number, one.unit), (other.number, other.unit)),
            (Some(machine), Some(others)) if machine.1 == others.1 => (machine.clone(), others.clone()),
            _ => {
                found.push(format!("their units are `{}` and `{}`", brief(&one.unit), brief(&other.unit)));
                break;
            }
        };
        if (one.0 - other.0).abs() > TOLERANCE * one.0.abs().max(other.0.abs()) {
            let on = variant(device, model).map(|model| format!(" on {}", brief(&model.name))).unwrap_or_default();
            let [number, other] = [one.0, other.0].map(|number| physical::rounded(number, DIGITS));
            let unit = if one.1.is_empty() { String::new() } else { format!(" {}", brief(&one.1)) };
            found.push(format!("their default values{on} are {number} and {other}{unit}"));
        }
    }
    found
}

fn variant(device: &Device, id: Option<VariantId>) -> Option<&Variant> {
    device.variants.get(id?.0 as usize)
}

/// A default value as a physical value, and in the machine unit if the quantity has one.
struct Physical {
    number: f64,
    unit: CompactString,
    machine: Option<(f64, CompactString)>,
}

impl Physical {
    fn new(device: &Device, item: &Item, id: Option<VariantId>) -> Option<Self> {
        let model = variant(device, id);
        let raw = default(item, model)?;
        let Some(quantity) = stated::quantity(item) else {
            return Some(Physical { number: raw, unit: CompactString::default(), machine: None });
        };
        let other = |name: &CompactString| match &quantity.scale {
            Some(Scale::Fraction { .. }) => physical::constant(model, name).ok_or(()),
            Some(Scale::Exponent { exponent, .. }) => {
                device.referred(exponent).and_then(|item| default(item, model)).ok_or(())
            }
            _ => Err(()),
        };
        if matches!(quantity.scale, Some(Scale::Reciprocal { .. })) {
            return None;
        }
        let number = physical::of_raw(quantity.scale.as_ref(), raw, other).ok()?;
        let machine = quantity.machine.as_ref().map(|unit| (number * machine(device, unit, id), unit.unit.clone()));
        Some(Physical { number, unit: quantity.unit.clone(), machine })
    }
}

/// Returns the ratio of a value in the machine unit to the physical value. An unknown machine constant counts as 1, because it
/// changes the values of both items by the same factor.
fn machine(device: &Device, unit: &MachineUnit, model: Option<VariantId>) -> f64 {
    let value = |number: &GivenRef| model.and_then(|model| physical::given(device, model, number));
    let number = |number: &GivenRef| Ok::<_, Infallible>(value(number).unwrap_or(1.0));
    let Ok(ratio) = physical::ratio(unit, number);
    ratio
}

/// Returns the default value of an item on a model, or `None` if there is no numeric default value.
fn default(item: &Item, model: Option<&Variant>) -> Option<f64> {
    let is_model = |name: &CompactString| model.is_some_and(|model| glob(name, &model.name));
    let variants = item.variants.iter().filter(|variant| variant.models.iter().any(is_model));
    variants.filter_map(|variant| variant.default.as_ref()).next().or(item.default.as_ref()).and_then(Value::as_real)
}
