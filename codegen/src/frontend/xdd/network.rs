//! Reads the communication network profile, except the objects.

use compact_str::format_compact;

use super::identity;
use super::object_list::{self, Positions};
use super::reader::Reader;
use crate::frontend::canopen::network;
use crate::frontend::xml::{Given, Read};
use crate::ir::{CanOpenSettings, CanOpenSpans, CompactString, Device, DynamicChannel};
use crate::number::hex16;
use crate::syntax::xml::Tag;

/// Reads an `ApplicationLayers` element: the object list, dummy entries, dynamic channels and identity.
pub(super) fn application_layers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
    objects: &mut Positions,
) -> Read<()> {
    let [class, entity] = reader.attributes(parent, ["conformanceClass", "communicationEntityType"])?;
    reader.note("conformanceClass", &class);
    reader.note("communicationEntityType", &entity);
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "CANopenObjectList" => object_list::read(reader, &tag, objects)?,
            "dummyUsage" => dummy_usage(reader, &tag, canopen)?,
            "dynamicChannels" => dynamic_channels(reader, &tag, canopen)?,
            "identity" => identity::read(reader, &tag, device)?,
            // The IR has no field for the index ranges of modules, so they become extensions.
            "moduleManagement" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

/// Reads dummy usage entries such as `<dummy entry="Dummy0001=1"/>`. The attribute has the form of an EDS entry in
/// `[DummyUsage]`.
fn dummy_usage<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, canopen: &mut CanOpenSettings) -> Read<()> {
    canopen.dummies_given = true;
    reader.each(parent, "dummy", |reader, tag| {
        let [given] = reader.attributes(tag, ["entry"])?;
        match dummy(&given.text) {
            Some((code, true)) if !canopen.dummies.contains(&code) => canopen.dummies.push(code),
            None if !given.is_missing() => {
                reader.bad(&given, "dummy entry", "left out; expected a line such as `Dummy0005=1`");
                reader.note("dummy", &given);
            }
            _ => {}
        }
        Ok(())
    })?;
    canopen.dummies.sort_unstable();
    Ok(())
}

fn dummy(entry: &str) -> Option<(u8, bool)> {
    let (key, value) = entry.split_once('=')?;
    let code = network::dummy_code(key.trim())?;
    match value.trim() {
        "0" => Some((code, false)),
        "1" => Some((code, true)),
        _ => None,
    }
}

fn dynamic_channels<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, canopen: &mut CanOpenSettings) -> Read<()> {
    const NAMES: [&str; 7] =
        ["dataType", "accessType", "startIndex", "endIndex", "maxNumber", "addressOffset", "bitAlignment"];
    reader.each(parent, "dynamicChannel", |reader, tag| {
        let fields = reader.attributes(tag, NAMES)?;
        let [data_type, access, start, end, max_number, offset, alignment] = &fields;
        let mut range = CompactString::default();
        let start = reader.hex(start, 0xFFFF, "index");
        let end = reader.hex(end, 0xFFFF, "index");
        if let (Some(start), Some(end)) = (start, end) {
            range = format_compact!("{}-{}", hex16(start), hex16(end));
        }
        reader.note("dynamicChannel@bitAlignment", alignment);
        canopen.dynamic_channels.push(DynamicChannel {
            data_type: reader.hex(data_type, u32::MAX, "data type").unwrap_or(0),
            direction: access.compact(),
            range,
            offset: reader.hex(offset, u32::MAX, "offset").map_or(0, i64::from),
            difference: None,
            max_number: reader.unsigned(max_number, u32::MAX, "number of channels"),
        });
        Ok(())
    })
}

/// Reads the bit rates in `TransportLayers/PhysicalLayer/baudRate`.
pub(super) fn transport_layers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            // `PhysicalLayer` is optional because some files omit this element around `baudRate`.
            "PhysicalLayer" => transport_layers(reader, &tag, canopen)?,
            "baudRate" => baud_rate(reader, &tag, canopen)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn baud_rate<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, canopen: &mut CanOpenSettings) -> Read<()> {
    let [default] = reader.attributes(parent, ["defaultValue"])?;
    reader.note("baudRate@defaultValue", &default);
    reader.each(parent, "supportedBaudRate", |reader, tag| {
        let [given] = reader.attributes(tag, ["value"])?;
        if given.text.eq_ignore_ascii_case("auto-baudRate") {
            canopen.auto_bit_rate = true;
        } else {
            canopen.bit_rates.extend(bit_rate(reader, &given));
        }
        Ok(())
    })
}

/// Returns the bit rate in kbit/s for a text such as `250 Kbps`.
fn bit_rate(reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Option<u16> {
    if given.is_missing() {
        return None;
    }
    let digits = given.text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, unit) = given.text.split_at(digits);
    let (number, unit) = (number.parse::<u16>().ok(), unit.trim());
    let (value, plain) = match (number, unit.to_ascii_lowercase().as_str()) {
        (Some(rate), "kbps" | "kbit/s") => (Some(rate), true),
        (Some(rate), "mbps" | "mbit/s") => (rate.checked_mul(1000), false),
        (Some(rate), "") => (Some(rate), false),
        _ => (None, false),
    };
    if !plain {
        let label = value.map_or_else(|| "left out".into(), |rate| format!("read as {rate} kbit/s"));
        reader.bad(given, "CiA 311 bit rate, such as `250 Kbps`", label);
    }
    value
}

/// Reads a `NetworkManagement` element: features and commissioning.
pub(super) fn management<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "CANopenGeneralFeatures" => general_features(reader, &tag, canopen)?,
            "CANopenMasterFeatures" => master_features(reader, &tag, canopen)?,
            "deviceCommissioning" => commissioning(reader, &tag, device)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn general_features<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, canopen: &mut CanOpenSettings) -> Read<()> {
    const NAMES: [&str; 9] = [
        "groupMessaging",
        "dynamicChannels",
        "granularity",
        "nrOfRxPDO",
        "nrOfTxPDO",
        "bootUpSlave",
        "layerSettingServiceSlave",
        "selfStartingDevice",
        "SDORequestingDevice",
    ];
    let fields = reader.attributes(tag, NAMES)?;
    let [messaging, channels, granularity, rx, tx, slave, lss, self_starting, sdo_requesting] = &fields;
    canopen.group_messaging = reader.flag(messaging);
    canopen.dynamic_channels_supported = reader.unsigned(channels, u32::MAX, "number").unwrap_or(0);
    canopen.granularity = reader.unsigned(granularity, 0xFF, "granularity").map(|bits| bits as u8);
    if let Some(bits) = canopen.granularity {
        network::granularity(bits, granularity.span, reader.diagnostics);
    }
    canopen.rx_pdos = reader.unsigned(rx, 0xFFFF, "number of PDOs").map(|count| count as u16);
    canopen.tx_pdos = reader.unsigned(tx, 0xFFFF, "number of PDOs").map(|count| count as u16);
    canopen.at = CanOpenSpans { rx_pdos: rx.span, tx_pdos: tx.span };
    canopen.boot_up_slave = reader.flag(slave);
    canopen.lss = reader.flag(lss);
    reader.note("selfStartingDevice", self_starting);
    reader.note("SDORequestingDevice", sdo_requesting);
    reader.no_children(tag)
}

fn master_features<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, canopen: &mut CanOpenSettings) -> Read<()> {
    const NAMES: [&str; 5] =
        ["bootUpMaster", "flyingMaster", "SDOManager", "configurationManager", "layerSettingServiceMaster"];
    let fields = reader.attributes(tag, NAMES)?;
    canopen.boot_up_master = reader.flag(&fields[0]);
    for (name, given) in NAMES.iter().zip(&fields).skip(1) {
        reader.note(name, given);
    }
    reader.no_children(tag)
}

fn commissioning<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    const NAMES: [&str; 6] = ["nodeID", "nodeName", "actualBaudRate", "networkNumber", "networkName", "CANopenManager"];
    let fields = reader.attributes(tag, NAMES)?;
    let [node_id, node_name, rate, number, network_name, manager] = &fields;
    let mut commissioning = device.commissioning.take().unwrap_or_default();
    commissioning.node_id = node_id_of(reader, node_id);
    commissioning.bit_rate = bit_rate(reader, rate);
    commissioning.net_number = reader.unsigned(number, u32::MAX, "network number");
    commissioning.manager = reader.flag(manager);
    commissioning.node_name = node_name.compact();
    commissioning.network_name = network_name.compact();
    device.commissioning = Some(commissioning);
    reader.no_children(tag)
}

fn node_id_of(reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Option<u8> {
    let value = reader.unsigned(given, 0xFF, "node-ID")?;
    network::node_id(value, given.span, reader.diagnostics)
}

#[cfg(test)]
mod tests {
    use super::dummy;

    #[test]
    fn dummy_entries() {
        assert_eq!(dummy("Dummy0005=1"), Some((5, true)));
        assert_eq!(dummy("dummy001B = 0"), Some((0x1B, false)));
        for text in ["", "Dummy0005", "Dummy=1", "Dummy0005=2", "Dummé=1", "Dummy0100=1"] {
            assert_eq!(dummy(text), None, "{text}");
        }
    }
}
