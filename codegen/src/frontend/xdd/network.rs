//! The communication network profile, but for the objects.

use compact_str::format_compact;

use super::application::span_of;
use super::identity;
use super::modules;
use super::objects::ObjectList;
use super::reader::{note, Given, Read, Reader};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{CanOpenSettings, CanOpenSpans, Device, DynamicChannel, Extensions};
use crate::syntax::xml::Tag;

/// ApplicationLayers: the object list, dummy entries, dynamic channels.
pub(super) fn application_layers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
    objects: &mut ObjectList,
) -> Read<()> {
    const NAMES: [&str; 2] = ["conformanceClass", "communicationEntityType"];
    let fields = reader.fields(parent, &NAMES, &mut device.extensions)?;
    keep(&NAMES, &fields, &mut device.extensions);
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "CANopenObjectList" => objects.note(reader, &tag, device)?,
            "dummyUsage" => dummy_usage(reader, &tag, device, canopen)?,
            "dynamicChannels" => dynamic_channels(reader, &tag, device, canopen)?,
            "identity" => identity::read(reader, &tag, device)?,
            "moduleManagement" => modules::ranges(reader, &tag, device)?,
            _ => reader.unknown(&tag, &mut device.extensions)?,
        }
    }
    Ok(())
}

fn keep<const N: usize>(names: &[&str; N], fields: &[Option<Given<'_>>; N], extensions: &mut Extensions) {
    for (name, given) in names.iter().zip(fields) {
        note(name, given.as_ref(), extensions);
    }
}

/// `<dummy entry="Dummy0001=1"/>`: a line of `[DummyUsage]` in an attribute.
fn dummy_usage<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    canopen.dummies_given = true;
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name != "dummy" {
            reader.unknown(&tag, &mut device.extensions)?;
            continue;
        }
        let [entry] = reader.fields(&tag, &["entry"], &mut device.extensions)?;
        let Some(given) = entry else { continue };
        match dummy(&given.text) {
            Some((code, true)) if !canopen.dummies.contains(&code) => canopen.dummies.push(code),
            Some(_) => {}
            None => {
                reader.bad(&given, "dummy entry", "left out; expected `Dummy0005=1`, say");
                note("dummy", Some(&given), &mut device.extensions);
            }
        }
    }
    canopen.dummies.sort_unstable();
    Ok(())
}

fn dummy(entry: &str) -> Option<(u8, bool)> {
    let (key, value) = entry.split_once('=')?;
    let key = key.trim();
    let digits = key.get(5..).filter(|_| key[..5].eq_ignore_ascii_case("Dummy"))?;
    let hexadecimal = digits.len() <= 4 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let code = hexadecimal.then(|| u8::from_str_radix(digits, 16).ok()).flatten()?;
    match value.trim() {
        "0" => Some((code, false)),
        "1" => Some((code, true)),
        _ => None,
    }
}

fn dynamic_channels<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    const NAMES: [&str; 7] =
        ["dataType", "accessType", "startIndex", "endIndex", "maxNumber", "addressOffset", "bitAlignment"];
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name != "dynamicChannel" {
            reader.unknown(&tag, &mut device.extensions)?;
            continue;
        }
        let fields = reader.fields(&tag, &NAMES, &mut device.extensions)?;
        let [data_type, access, start, end, max_number, offset, alignment] = &fields;
        let mut range = crate::ir::CompactString::default();
        let start = reader.hex(start.as_ref(), 0xFFFF, "index");
        let end = reader.hex(end.as_ref(), 0xFFFF, "index");
        if let (Some(start), Some(end)) = (start, end) {
            range = format_compact!("0x{start:04X}-0x{end:04X}");
        }
        note("dynamicChannel@bitAlignment", alignment.as_ref(), &mut device.extensions);
        canopen.dynamic_channels.push(DynamicChannel {
            data_type: reader.hex(data_type.as_ref(), u32::MAX, "data type").unwrap_or(0),
            direction: access.as_ref().map_or_else(Default::default, |access| access.text.as_ref().into()),
            range,
            offset: reader.hex(offset.as_ref(), u32::MAX, "offset").map_or(0, i64::from),
            difference: None,
            max_number: reader.unsigned(max_number.as_ref(), u32::MAX, "number of channels"),
        });
    }
    Ok(())
}

/// TransportLayers/PhysicalLayer/baudRate.
pub(super) fn transport_layers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            // Some files leave out the layer in between.
            "PhysicalLayer" => transport_layers(reader, &tag, device, canopen)?,
            "baudRate" => baud_rate(reader, &tag, device, canopen)?,
            _ => reader.unknown(&tag, &mut device.extensions)?,
        }
    }
    Ok(())
}

fn baud_rate<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    let [default] = reader.fields(parent, &["defaultValue"], &mut device.extensions)?;
    note("baudRate@defaultValue", default.as_ref(), &mut device.extensions);
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name != "supportedBaudRate" {
            reader.unknown(&tag, &mut device.extensions)?;
            continue;
        }
        let [value] = reader.fields(&tag, &["value"], &mut device.extensions)?;
        match value {
            Some(given) if given.text.eq_ignore_ascii_case("auto-baudRate") => canopen.auto_bit_rate = true,
            given => canopen.bit_rates.extend(bit_rate(reader, given.as_ref())),
        }
    }
    Ok(())
}

/// `250 Kbps`, in kbit/s.
fn bit_rate(reader: &mut Reader<'_, '_>, given: Option<&Given<'_>>) -> Option<u16> {
    let given = given?;
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
        reader.bad(given, "bit rate of CiA 311, such as `250 Kbps`", label);
    }
    value
}

/// NetworkManagement: features and commissioning.
pub(super) fn management<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "CANopenGeneralFeatures" => general_features(reader, &tag, device, canopen)?,
            "CANopenMasterFeatures" => master_features(reader, &tag, device, canopen)?,
            "deviceCommissioning" => commissioning(reader, &tag, device)?,
            _ => reader.unknown(&tag, &mut device.extensions)?,
        }
    }
    Ok(())
}

fn general_features<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
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
    let fields = reader.fields(tag, &NAMES, &mut device.extensions)?;
    let [messaging, channels, granularity, rx, tx, slave, lss, self_starting, sdo_requesting] = &fields;
    canopen.group_messaging = reader.flag(messaging.as_ref());
    canopen.dynamic_channels_supported = reader.unsigned(channels.as_ref(), u32::MAX, "number").unwrap_or(0);
    canopen.granularity = reader.unsigned(granularity.as_ref(), 0xFF, "granularity").map(|bits| bits as u8);
    if let (Some(bits @ 65..), Some(given)) = (canopen.granularity, granularity) {
        let message = format!("a granularity of {bits} bits is more than a PDO has");
        reader
            .diagnostics
            .push(Diagnostic::new(&codes::VALUE_NOT_ALLOWED, given.span, message).label("expected 0 to 64"));
    }
    canopen.rx_pdos = reader.unsigned(rx.as_ref(), 0xFFFF, "number of PDOs").map(|count| count as u16);
    canopen.tx_pdos = reader.unsigned(tx.as_ref(), 0xFFFF, "number of PDOs").map(|count| count as u16);
    canopen.at = CanOpenSpans { rx_pdos: span_of(rx.as_ref()), tx_pdos: span_of(tx.as_ref()) };
    canopen.boot_up_slave = reader.flag(slave.as_ref());
    canopen.lss = reader.flag(lss.as_ref());
    note("selfStartingDevice", self_starting.as_ref(), &mut device.extensions);
    note("SDORequestingDevice", sdo_requesting.as_ref(), &mut device.extensions);
    reader.no_children(tag, &mut device.extensions)
}

fn master_features<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) -> Read<()> {
    const NAMES: [&str; 5] =
        ["bootUpMaster", "flyingMaster", "SDOManager", "configurationManager", "layerSettingServiceMaster"];
    let fields = reader.fields(tag, &NAMES, &mut device.extensions)?;
    canopen.boot_up_master = reader.flag(fields[0].as_ref());
    for (name, given) in NAMES.iter().zip(&fields).skip(1) {
        note(name, given.as_ref(), &mut device.extensions);
    }
    reader.no_children(tag, &mut device.extensions)
}

fn commissioning<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    const NAMES: [&str; 6] = ["nodeID", "nodeName", "actualBaudRate", "networkNumber", "networkName", "CANopenManager"];
    let fields = reader.fields(tag, &NAMES, &mut device.extensions)?;
    let [node_id, node_name, rate, number, network_name, manager] = &fields;
    let mut own = device.commissioning.take().unwrap_or_default();
    own.node_id = node_id_of(reader, node_id.as_ref());
    own.bit_rate = bit_rate(reader, rate.as_ref());
    own.net_number = reader.unsigned(number.as_ref(), u32::MAX, "network number");
    own.manager = reader.flag(manager.as_ref());
    let text =
        |given: &Option<Given<'_>>| given.as_ref().map_or_else(Default::default, |given| given.text.as_ref().into());
    own.node_name = text(node_name);
    own.network_name = text(network_name);
    device.commissioning = Some(own);
    reader.no_children(tag, &mut device.extensions)
}

fn node_id_of(reader: &mut Reader<'_, '_>, given: Option<&Given<'_>>) -> Option<u8> {
    let value = reader.unsigned(given, 0xFF, "node-ID")?;
    if !(1..=127).contains(&value) {
        let message = format!("{value} is no node-ID");
        let span = given.map_or_else(Default::default, |given| given.span);
        reader.diagnostics.push(Diagnostic::new(&codes::VALUE_NOT_ALLOWED, span, message).label("expected 1 to 127"));
        return None;
    }
    Some(value as u8)
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
