//! Writes the cyclic data of a submodule.

use super::types::{self, Name};
use super::{elements, Context};
use crate::note::Subject;
use crate::xml::Xml;
use lexibus_codegen::ir::{IoChannel, IoData, IoItem, PdoEntry, PdoEntryKind, Submodule, Type};

/// Writes the IOData element.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, submodule: &Submodule) {
    xml.open("IOData");
    let (provider, consumer) = submodule.status_lengths;
    xml.unless("IOPS_Length", provider, 1);
    xml.unless("IOCS_Length", consumer, 1);
    elements::attributes_of(xml, "IOData", &submodule.attributes);
    for (element, data) in [("Input", &submodule.input), ("Output", &submodule.output)] {
        if let Some(data) = data {
            direction(xml, context, element, data);
        }
    }
    xml.close();
}

fn direction(xml: &mut Xml, context: &mut Context<'_>, element: &'static str, data: &IoData) {
    xml.open(element);
    xml.flag("Consistency", data.consistent, "All items consistency");
    let mut next = 0usize;
    for item in &data.items {
        let first = item.first_field as usize;
        simple(xml, context, data.image.fields.get(next..first).unwrap_or_default());
        let fields = data.image.fields.get(first..first.saturating_add(item.fields as usize)).unwrap_or_default();
        composed(xml, context, item, fields);
        next = first + fields.len();
    }
    simple(xml, context, data.image.fields.get(next..).unwrap_or_default());
    data.channels.iter().for_each(|each| channel(xml, each));
    xml.close();
}

/// Writes a data item for each field.
fn simple(xml: &mut Xml, context: &mut Context<'_>, fields: &[PdoEntry]) {
    let types = context.types;
    for field in fields {
        let Name { name, needs_length, note } = types::name(field.ty, field.bits, types);
        xml.notes.add_all(note, Subject::Named(&field.name));
        xml.open("DataItem");
        xml.attribute("DataType", name);
        xml.optional("Length", needs_length.then_some(field.bits / 8));
        xml.attribute("TextId", context.texts.id(&field.name, &field.names));
        xml.close();
    }
}

/// Writes a data item that consists of bits or of two values, or that has no fields.
fn composed(xml: &mut Xml, context: &mut Context<'_>, item: &IoItem, fields: &[PdoEntry]) {
    let is_bit = |field: &PdoEntry| field.kind == PdoEntryKind::Padding || field.bits == 1 && field.ty == Type::Boolean;
    let is_bits = !fields.is_empty() && fields.iter().all(is_bit);
    let needs_length = item.data_type.contains("String") && item.data_type != "OctetString2+Unsigned8"
        || item.data_type.contains("STRING");
    xml.open("DataItem");
    xml.attribute("DataType", &item.data_type);
    xml.optional("Length", needs_length.then_some(item.bits / 8));
    xml.flag("UseAsBits", is_bits, "true");
    xml.flag("Subordinate", item.subordinate, "true");
    xml.attribute("TextId", context.texts.id(&item.name, &item.names));
    if is_bits {
        // Numbers in cyclic data are big-endian. GSDML counts the bits of a number from its last byte.
        let is_number = item.data_type.starts_with("Unsigned")
            || item.data_type.starts_with("Integer")
            || matches!(item.data_type.as_str(), "V2" | "L2");
        for field in fields.iter().filter(|field| field.kind != PdoEntryKind::Padding) {
            let bit_offset = field.bit_offset.saturating_sub(item.bit_offset);
            let offset = match item.bits.checked_div(8).filter(|bytes| is_number && bit_offset / 8 < *bytes) {
                Some(bytes) => (bytes - 1 - bit_offset / 8) * 8 + bit_offset % 8,
                None => bit_offset,
            };
            let text = context.texts.id(&field.name, &field.names);
            xml.empty("BitDataItem", &[("BitOffset", &offset), ("TextId", &text)]);
        }
    }
    xml.close();
}

fn channel(xml: &mut Xml, channel: &IoChannel) {
    xml.open("Channel");
    xml.attribute("Number", channel.number);
    channel.attributes.iter().for_each(|(name, value)| xml.attribute(name, value));
    if let Some((offset, bits)) = channel.data {
        xml.empty("Data", &[("BitOffset", &offset), ("BitLength", &bits)]);
    }
    if let Some((offset, _)) = channel.quality {
        xml.empty("Quality", &[("BitOffset", &offset), ("Format", &channel.quality_format)]);
    }
    xml.close();
}
