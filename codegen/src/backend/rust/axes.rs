//! Devices with several axes: the static `AXES`, from which the runtime calculates the object addresses of each axis.

use super::code::{Data, Declaration, Doc};
use super::docs;
use crate::ir::{AxisRange, AxisRule, AxisStep, Device};

/// Returns the static `AXES` of a device with more than one axis. Also returns a phrase ` of …, …` with the names of the
/// device models that have several axes. The phrase is empty if all models of the device have several axes.
pub(super) fn model(device: &Device) -> Option<(Declaration, String)> {
    let rule = device.axes.as_ref().filter(|rule| rule.axes > 1)?;
    let names: Vec<String> = rule.models.iter().map(|name| docs::escape(name)).collect();
    let models = if names.is_empty() { String::new() } else { format!(" of {}", names.join(", ")) };
    let docs = format!("Number of axes{models}, and the rules for the addresses of their objects.");
    Some((Declaration::new([docs], "static AXES: rt::Axes", axes(device, rule)), models))
}

fn axes(device: &Device, rule: &AxisRule) -> Doc {
    let is_within = |index: u16| rule.rules.iter().any(|range| (range.indices.0..=range.indices.1).contains(&index));
    let items = device.groups.iter().flat_map(|group| &group.items).filter(|item| item.shared_by_axes);
    let mut shared: Vec<(u16, u8)> =
        items.filter_map(|item| item.object()).filter(|object| is_within(object.0)).collect();
    shared.sort_unstable();
    shared.dedup();
    let object = |(index, sub): (u16, u8)| Data::call("rt::Object::new", vec![Data::index(index), number(sub)]);
    Data::fields(
        "rt::Axes",
        vec![
            ("count", number(rule.axes)),
            ("ranges", Data::slice(rule.rules.iter().map(range))),
            ("shared", Data::slice(shared.into_iter().map(object))),
        ],
    )
}

fn range(range: &AxisRange) -> Doc {
    let step = match range.step {
        AxisStep::Index(step) => Data::call("rt::AxisStep::Index", vec![Data::index(step)]),
        AxisStep::SubIndex => Doc::from("rt::AxisStep::SubIndex"),
        AxisStep::SubIndexStride(step) => Data::call("rt::AxisStep::SubIndexStride", vec![number(step)]),
    };
    let (first, last) = range.indices;
    Data::fields("rt::AxisRange", vec![("first", Data::index(first)), ("last", Data::index(last)), ("step", step)])
}

fn number(value: u8) -> Doc {
    Doc::from(value.to_string())
}
