//! Reads the head of a table: device, manual, models, axes.

use super::at::At;
use super::buses;
use super::format::{AxesTable, DeviceTable, ManualTable, ModelTable, NumberOrText};
use super::notation;
use super::tree::Reader;
use super::{lints, value};
use crate::diagnostics::codes;
use crate::ir::{
    AxisRange, AxisRule, AxisStep, Bus, Buses, CanOpenSettings, CiteUnit, CompactString, Device, EtherCatSettings,
    Identity, Manual, ManualSection, Type, Variant,
};
use crate::text::brief;

/// Adds the facts in `[device]` to the device. Returns the buses of the device, or all buses if `[device]` lists none.
pub(super) fn head(reader: &mut Reader<'_, '_>, table: &At<DeviceTable>, device: &mut Device) -> Buses {
    let head = &table.value;
    device.origin = reader.origin(table);
    match &head.name {
        Some(name) => device.name = name.value.as_str().into(),
        None => reader.report(&codes::TABLE_VALUE, reader.span(table), "the device has no `name`"),
    }
    device.names = reader.original(head.orig.as_deref());
    device.identity = Identity {
        vendor_id: head.vendor_id,
        vendor_name: head.vendor.as_deref().unwrap_or_default().into(),
        product_code: head.product_code,
        product_name: device.name.clone(),
        revision_number: head.revision,
        order_code: head.order_code.as_deref().unwrap_or_default().into(),
        ..Identity::default()
    };
    device.profiles.clone_from(&head.profiles);
    device.node_ids = head.node_ids.as_ref().and_then(|given| node_ids(reader, given));
    device.documentation = reader.documentation_of(head);
    device.doubts = reader.doubts_of(head, device.origin);
    let buses = head.buses.as_ref().map_or(Buses::ALL, |list| buses::read(reader, list));
    if buses.contains(Bus::CanOpen) && head.buses.is_some() {
        device.canopen = Some(Box::new(CanOpenSettings {
            bit_rates: head.bit_rates.clone(),
            granularity: head.granularity,
            rx_pdos: head.rx_pdos,
            tx_pdos: head.tx_pdos,
            lss: head.lss,
            ..CanOpenSettings::default()
        }));
    }
    if buses.contains(Bus::EtherCat) && head.buses.is_some() {
        device.ethercat = Some(Box::<EtherCatSettings>::default());
    }
    buses
}

/// Reads the range of valid node-IDs. Returns `None` and reports an error if `given` is not a valid range within 1 to 255.
fn node_ids(reader: &mut Reader<'_, '_>, given: &At<NumberOrText>) -> Option<(u8, u8)> {
    let range = notation::range(&given.value.to_string());
    let number = |number: i128| u8::try_from(number).ok().filter(|&number| number > 0);
    let found = range.and_then(|(first, last)| Some((number(first)?, number(last)?)));
    let found = found.filter(|(first, last)| first <= last);
    if found.is_none() {
        let message = "node IDs must be from 1 to 255";
        reader.report_with_help(&codes::TABLE_VALUE, reader.span(given), message, "write a range such as `\"1..127\"`");
    }
    found
}

/// Reads the table `[manual]`.
pub(super) fn manual(reader: &mut Reader<'_, '_>, table: &At<ManualTable>) -> Box<Manual> {
    let manual = &table.value;
    let text = |text: &Option<String>| CompactString::from(text.as_deref().unwrap_or_default());
    reader.language = text(&manual.language);
    let units = [("page", CiteUnit::Page), ("line", CiteUnit::Line)];
    let counts = manual.cites.as_ref().and_then(|word| reader.word(word, "unit of citations", &units));
    Box::new(Manual {
        title: text(&manual.title),
        edition: text(&manual.edition),
        language: text(&manual.language),
        counts,
        documentation: manual.doc.clone().unwrap_or_default(),
        sections: sections(reader, manual),
    })
}

/// Returns the sections of a manual, sorted by their first page or line. Reports a key that is not a number.
fn sections(reader: &mut Reader<'_, '_>, table: &ManualTable) -> Vec<ManualSection> {
    let mut sections = Vec::new();
    for (key, title) in table.sections.iter() {
        match key.value.parse() {
            Ok(start) => sections.push(ManualSection { start, title: title.value.as_str().into() }),
            Err(_) => {
                let message = format!("`{}` is neither a page number nor a line number", brief(&key.value));
                let found = codes::TABLE_VALUE.at(reader.span(key), message);
                let help = "write the number of the first page or line: `2170 = \"Motion parameters\"`";
                reader.diagnostics.push(found.help(help));
            }
        }
    }
    sections.sort_by_key(|section| section.start);
    sections
}

/// Reads a model or a firmware version.
pub(super) fn model(reader: &mut Reader<'_, '_>, table: &At<ModelTable>, device: &mut Device) {
    let model = &table.value;
    let Some(name) = &model.name else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "the model has no `name`");
        return;
    };
    let origin = reader.origin(name);
    let doubts = reader.doubts_of(model, origin);
    let constant = |literal: &super::at::Literal| value::convert(literal, Type::Opaque(None), false);
    let constants = model.constants.iter();
    let constants = constants.filter_map(|(key, literal)| Some((key.value.as_str().into(), constant(&literal.value)?)));
    device.variants.push(Variant {
        name: name.value.as_str().into(),
        identity: Identity {
            product_code: model.product_code,
            revision_number: model.revision,
            order_code: model.order_code.as_deref().unwrap_or_default().into(),
            product_name: name.value.as_str().into(),
            ..Identity::default()
        },
        constants: constants.collect(),
        documentation: reader.documentation_of(model),
        doubts,
        origin,
    });
}

/// Reads the rules that derive the objects of further axes from those of the first axis.
pub(super) fn axes(reader: &mut Reader<'_, '_>, table: &At<AxesTable>, device: &mut Device) {
    let axes = &table.value;
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(axes, origin));
    let mut rules = Vec::new();
    for rule in &axes.rules {
        let objects = rule.value.objects.as_ref().and_then(|objects| notation::objects(&objects.value.to_string()));
        let objects = objects.filter(|objects| objects.subs.is_none()).map(|objects| objects.indices);
        let step = match (&rule.value.index, &rule.value.sub, &rule.value.sub_stride) {
            (Some(index), None, None) => Some(AxisStep::Index(*index)),
            (None, Some(word), None) if word == "axis" => Some(AxisStep::SubIndex),
            (None, None, Some(stride)) => Some(AxisStep::SubIndexStride(*stride)),
            _ => None,
        };
        match (objects, step) {
            (Some(indices), Some(step)) => rules.push(AxisRange { indices, step }),
            _ => {
                let text = brief(reader.source.slice(reader.span(rule)));
                let message = format!("`{text}` is not a valid rule of `[axes]`");
                let help = "write `objects` and one of `index`, `sub = \"axis\"` and `sub_stride`, such as \
                            `{ objects = \"0x6000..0x67FF\", index = 0x800 }`";
                let found = codes::TABLE_VALUE.at(reader.span(rule), message).help(help);
                let digits = rule.value.objects.as_ref().and_then(|given| lints::digits_of_index(reader, given));
                reader.diagnostics.push(match digits {
                    Some(digits) => found.note(digits),
                    None => found,
                });
            }
        }
    }
    let models = axes.models.iter().flatten().map(|model| model.value.as_str().into()).collect();
    device.axes = Some(AxisRule { axes: axes.count, models, rules });
}
