//! Further axes: the constant `AXES`, from which the runtime knows their addresses.

use super::data::Data;
use super::docs;
use crate::ir::{AxisRange, AxisRule, AxisStep, Device};

/// Axes, ready to be written.
pub(super) struct AxesModel {
    /// The models that have them, as a part of a sentence; empty = all.
    pub models: String,
    /// `AXES`.
    pub constant: String,
}

/// The axes of a device that has more than one.
pub(super) fn model(device: &Device, nest: usize) -> Option<AxesModel> {
    let rule = device.axes.as_ref().filter(|rule| rule.axes > 1)?;
    let column = "pub static AXES: rt::Axes = ".len();
    let names: Vec<String> = rule.models.iter().map(|name| docs::escape(name)).collect();
    let models = if names.is_empty() { String::new() } else { format!(" of {}", names.join(", ")) };
    Some(AxesModel { models, constant: axes(device, rule).render(0, column, 1, nest) })
}

fn axes(device: &Device, rule: &AxisRule) -> Data {
    let is_within = |index: u16| rule.rules.iter().any(|own| (own.indices.0..=own.indices.1).contains(&index));
    let items = device.groups.iter().flat_map(|group| &group.items).filter(|item| item.shared_by_axes);
    let mut shared: Vec<(u16, u8)> = items.filter_map(|item| item.object()).filter(|own| is_within(own.0)).collect();
    shared.sort_unstable();
    shared.dedup();
    let object = |(index, sub): (u16, u8)| Data::Call("rt::Object::new", vec![Data::index(index), number(sub)]);
    Data::Struct(
        "rt::Axes",
        vec![
            ("count", number(rule.axes)),
            ("ranges", Data::Slice(rule.rules.iter().map(range).collect())),
            ("shared", Data::Slice(shared.into_iter().map(object).collect())),
        ],
    )
}

fn range(range: &AxisRange) -> Data {
    let step = match range.step {
        AxisStep::Index(step) => Data::Call("rt::AxisStep::Index", vec![Data::index(step)]),
        AxisStep::SubIndex => Data::text("rt::AxisStep::SubIndex"),
        AxisStep::SubIndexStride(step) => Data::Call("rt::AxisStep::SubIndexStride", vec![number(step)]),
    };
    let (first, last) = range.indices;
    Data::Struct("rt::AxisRange", vec![("first", Data::index(first)), ("last", Data::index(last)), ("step", step)])
}

fn number(value: u8) -> Data {
    Data::text(value.to_string())
}
