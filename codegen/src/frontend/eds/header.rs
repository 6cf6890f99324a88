//! Reads the header sections, which describe the file and the device.

use std::collections::BTreeMap;

use super::lists::{self, Lists};
use super::object::in_order_of_file;
use super::reader::{Fixed, Reader};
use super::sections::{List, SectionKind};
use crate::diagnostics::codes;
use crate::frontend::canopen::{network, number};
use crate::ir::{CanOpenSettings, Commissioning, CompactString, Device, DynamicChannel, Extension, Extensions, Header};
use crate::syntax::ini::{Entry, Section};

/// Fills `device` from its header sections and returns the object lists.
pub(super) fn read(reader: &mut Reader<'_, '_>, header: &[(SectionKind, Section)], device: &mut Device) -> Lists {
    let header = by_kind(header);
    report_missing(reader, &header);
    let mut lists = Lists::default();
    let mut canopen = CanOpenSettings::default();
    let kept_before = device.extensions.len();
    for (kind, sections) in &header {
        reader.duplicate_sections(sections);
        let kept_before = device.extensions.len();
        match kind {
            SectionKind::FileInfo => file_info(reader, sections, device),
            SectionKind::DeviceInfo => device_info(reader, sections, device, &mut canopen),
            SectionKind::DummyUsage => dummy_usage(reader, sections, device, &mut canopen),
            SectionKind::Comments => comments(reader, sections, &mut device.header.comments, &mut device.extensions),
            SectionKind::List(list) => lists.read(reader, *list, sections, device),
            SectionKind::Commissioning => commissioning(reader, sections, device),
            SectionKind::SupportedModules => Lists::supported_modules(reader, sections, device),
            SectionKind::ConnectedModules => connected_modules(reader, sections, device),
            SectionKind::DynamicChannels => dynamic_channels(reader, sections, device, &mut canopen),
            _ => {}
        }
        reader.take_comments(&mut device.extensions);
        name_section(*kind, &mut device.extensions[kept_before..]);
    }
    in_order_of_file(&mut device.extensions[kept_before..]);
    device.name = device.identity.product_name.clone();
    device.canopen = Some(Box::new(canopen));
    lists
}

/// Groups the sections by kind, in the order of their first occurrence. A file may repeat a section.
fn by_kind(header: &[(SectionKind, Section)]) -> Vec<(SectionKind, Vec<Section>)> {
    let mut kinds: Vec<(SectionKind, Vec<Section>)> = Vec::new();
    for (kind, section) in header {
        match kinds.iter_mut().find(|(other, _)| other == kind) {
            Some((_, same)) => same.push(*section),
            None => kinds.push((*kind, vec![*section])),
        }
    }
    kinds
}

/// Prefixes the keys of a section's extensions with the name of the section, as in `section/key`.
fn name_section(kind: SectionKind, extensions: &mut [Extension]) {
    for extension in extensions.iter_mut() {
        extension.key = compact_str::format_compact!("{}/{}", kind.name(), extension.key);
    }
}

fn report_missing(reader: &mut Reader<'_, '_>, header: &[(SectionKind, Vec<Section>)]) {
    let mandatory = [
        (SectionKind::FileInfo, "FileInfo"),
        (SectionKind::DeviceInfo, "DeviceInfo"),
        (SectionKind::List(List::Mandatory), "MandatoryObjects"),
    ];
    for (kind, name) in mandatory {
        if !header.iter().any(|(other, _)| *other == kind) {
            reader.missing_section(name);
        }
    }
}

/// Returns the position of `key` in `names`, ignoring case.
fn position(names: &[&str], key: &str) -> Option<usize> {
    names.iter().position(|name| name.eq_ignore_ascii_case(key))
}

fn file_info(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device) {
    let header = &mut device.header;
    let fields = [
        ("FileName", &mut header.file_name),
        ("FileVersion", &mut header.file_version),
        ("FileRevision", &mut header.file_revision),
        ("EDSVersion", &mut header.format_version),
        ("Description", &mut header.description),
        ("CreationTime", &mut header.creation_time),
        ("CreationDate", &mut header.creation_date),
        ("CreatedBy", &mut header.created_by),
        ("ModificationTime", &mut header.modification_time),
        ("ModificationDate", &mut header.modification_date),
        ("ModifiedBy", &mut header.modified_by),
        ("LastEDS", &mut header.last_eds),
    ];
    let names = fields.each_ref().map(|(name, _)| *name);
    let mut seen = names.map(|_| None);
    for ref entry in reader.doc.entries_of(sections) {
        let Some(which) = position(&names, reader.doc.key(entry)) else {
            reader.extension(entry, &mut device.extensions);
            continue;
        };
        reader.once(&mut seen[which], entry);
        let text = reader.doc.value(entry);
        let form_ok = match which {
            1 | 2 => is_version(text),
            3 => is_eds_version(text),
            5 | 8 => is_time(text),
            6 | 9 => is_date(text),
            _ => true,
        };
        if !form_ok && !text.is_empty() {
            header_format(reader, entry, names[which], which);
        }
        *fields[which].1 = text.into();
    }
    missing(reader, sections, &names, &seen, &[0, 1, 2]);
    old_version(reader, sections, &device.header, seen[3].as_ref());
}

/// Reports each mandatory entry that a section lacks or leaves empty.
fn missing(
    reader: &mut Reader<'_, '_>,
    sections: &[Section],
    keys: &[&str],
    seen: &[Option<Entry>],
    mandatory: &[usize],
) {
    for &which in mandatory {
        if seen[which].as_ref().is_none_or(|entry| reader.doc.value(entry).is_empty()) {
            reader.missing_entry(sections, keys[which]);
        }
    }
}

fn header_format(reader: &mut Reader<'_, '_>, entry: &Entry, name: &str, which: usize) {
    let expected = match which {
        1 | 2 => "an integer from 0 to 255",
        3 => "a version of the form x.y, such as 4.0",
        5 | 8 => "a time of the form hh:mm with AM or PM, such as 09:30AM",
        _ => "a date of the form mm-dd-yyyy, such as 12-31-2020",
    };
    let message = format!("{name} is not {expected}");
    let span = reader.doc.value_span(entry);
    reader.diagnostics.push(codes::HEADER_FORMAT.at(span, message).label("kept as text"));
}

fn old_version(reader: &mut Reader<'_, '_>, sections: &[Section], header: &Header, entry: Option<&Entry>) {
    let (version, given) = match header.format_version.as_str() {
        "" => ("3.0", false),
        version => (version, true),
    };
    if version.parse::<f64>().is_ok_and(|version| version < 4.0) {
        let (message, span) = match entry.filter(|_| given) {
            Some(entry) => {
                (format!("the file has EDS version {version}, which is older than 4.0"), reader.doc.value_span(entry))
            }
            None => {
                ("the file has no EDSVersion, so its EDS version is 3.0".to_owned(), reader.doc.name_span(&sections[0]))
            }
        };
        reader.diagnostics.push(codes::OLD_EDS_VERSION.at(span, message));
    }
}

fn is_version(text: &str) -> bool {
    number::parse(text, &[]).int().is_some_and(|version| (0..=255).contains(&version))
}

fn is_eds_version(text: &str) -> bool {
    let digit = |part: &str| part.len() == 1 && part.as_bytes()[0].is_ascii_digit();
    text.split_once('.').is_some_and(|(major, minor)| digit(major) && digit(minor) && major <= "4")
}

fn is_time(text: &str) -> bool {
    let bytes = text.as_bytes();
    let (Some(time), Some(half)) = (bytes.get(..5), text.get(5..)) else { return false };
    let digits = [0, 1, 3, 4].iter().all(|&at| time[at].is_ascii_digit());
    digits && time[2] == b':' && matches!(half.trim().to_ascii_uppercase().as_str(), "AM" | "PM")
}

fn is_date(text: &str) -> bool {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes[at].is_ascii_digit();
    bytes.len() == 10
        && bytes[2] == b'-'
        && bytes[5] == b'-'
        && [0, 1, 3, 4, 6, 7, 8, 9].iter().all(|&at| digit(at))
        && (b"01"..=b"12").contains(&&[bytes[0], bytes[1]])
}

const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

fn device_info(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device, canopen: &mut CanOpenSettings) {
    const KEYS: [&str; 15] = [
        "VendorName",
        "ProductName",
        "OrderCode",
        "VendorNumber",
        "ProductNumber",
        "RevisionNumber",
        "SimpleBootUpMaster",
        "SimpleBootUpSlave",
        "Granularity",
        "DynamicChannelsSupported",
        "GroupMessaging",
        "NrOfRXPDO",
        "NrOfTXPDO",
        "LSS_Supported",
        "CompactPDO",
    ];
    let mut seen = [None; KEYS.len()];
    let mut rates = [None; BIT_RATES.len()];
    for ref entry in reader.doc.entries_of(sections) {
        let key = reader.doc.key(entry);
        let Some(which) = position(&KEYS, key) else {
            if !bit_rate(reader, entry, &mut rates, canopen) {
                reader.extension(entry, &mut device.extensions);
            }
            continue;
        };
        reader.once(&mut seen[which], entry);
        match which {
            0..=2 => {
                let (mut name, mut at) = (CompactString::default(), Default::default());
                reader.name(Some(entry), &mut name, &mut at);
                match which {
                    0 => device.identity.vendor_name = name,
                    1 => device.identity.product_name = name,
                    _ => device.identity.order_code = name,
                }
            }
            3 => device.identity.vendor_id = reader.u32_of(entry),
            4 => device.identity.product_code = reader.u32_of(entry),
            5 => device.identity.revision_number = reader.u32_of(entry),
            6 => canopen.boot_up_master = reader.flag(entry),
            7 => canopen.boot_up_slave = reader.flag(entry),
            8 => canopen.granularity = granularity(reader, entry),
            9 => canopen.dynamic_channels_supported = reader.u32_of(entry).unwrap_or(0),
            10 => canopen.group_messaging = reader.flag(entry),
            11 => {
                canopen.rx_pdos = reader.unsigned(entry, 0xFFFF).map(|count| count as u16);
                canopen.at.rx_pdos = reader.doc.value_span(entry);
            }
            12 => {
                canopen.tx_pdos = reader.unsigned(entry, 0xFFFF).map(|count| count as u16);
                canopen.at.tx_pdos = reader.doc.value_span(entry);
            }
            13 => canopen.lss = reader.flag(entry),
            _ => canopen.compact_pdo = reader.unsigned(entry, 0xFF).unwrap_or(0) as u8,
        }
    }
    missing(reader, sections, &KEYS, &seen, &[0, 1, 3, 4]);
}

/// Reads a bit rate such as `BaudRate_250=1`. Returns false if the key is not a bit rate.
fn bit_rate(
    reader: &mut Reader<'_, '_>,
    entry: &Entry,
    seen: &mut [Option<Entry>; BIT_RATES.len()],
    canopen: &mut CanOpenSettings,
) -> bool {
    let key = reader.doc.key(entry);
    let rate = key.get(9..).filter(|_| key[..9].eq_ignore_ascii_case("BaudRate_"));
    let rate = rate.and_then(|rate| rate.parse::<u16>().ok());
    let which = rate.and_then(|rate| BIT_RATES.iter().position(|&known| known == rate));
    let Some(which) = which else { return false };
    reader.once(&mut seen[which], entry);
    let rate = BIT_RATES[which];
    canopen.bit_rates.retain(|&other| other != rate);
    if reader.flag(entry) {
        let at = canopen.bit_rates.partition_point(|&other| other < rate);
        canopen.bit_rates.insert(at, rate);
    }
    true
}

/// Reads the PDO mapping granularity: 0 for fixed mappings, or 1 to 64 bits. Some tools write 1 only to state that
/// mappings can be changed.
fn granularity(reader: &mut Reader<'_, '_>, entry: &Entry) -> Option<u8> {
    let value = reader.unsigned(entry, 0xFF)?;
    network::granularity(value as u8, reader.doc.value_span(entry), reader.diagnostics);
    Some(value as u8)
}

fn dummy_usage(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device, canopen: &mut CanOpenSettings) {
    canopen.dummies_given = true;
    let mut seen = [None; 256];
    let mut usage = [false; 256];
    for ref entry in reader.doc.entries_of(sections) {
        let Some(code) = network::dummy_code(reader.doc.key(entry)) else {
            reader.extension(entry, &mut device.extensions);
            continue;
        };
        reader.once(&mut seen[usize::from(code)], entry);
        usage[usize::from(code)] = reader.flag(entry);
    }
    canopen.dummies = (0..=u8::MAX).filter(|&code| usage[usize::from(code)]).collect();
}

/// Reads the entries `Line1`, `Line2` and so on in the order of their numbers. A gap in the numbers adds no empty line.
pub(super) fn comments(
    reader: &mut Reader<'_, '_>,
    sections: &[Section],
    lines: &mut Vec<CompactString>,
    extensions: &mut Extensions,
) {
    let mut numbered: Vec<(u32, Entry)> = Vec::new();
    let mut count = None;
    for ref entry in reader.doc.entries_of(sections) {
        let key = reader.doc.key(entry);
        let digits = key.get(4..).filter(|_| key[..4].eq_ignore_ascii_case("Line"));
        match digits.and_then(|digits| digits.parse::<u32>().ok()) {
            Some(number) => numbered.push((number, *entry)),
            // The value of `Lines` is ignored because it is redundant and often wrong.
            None if key.eq_ignore_ascii_case("Lines") => reader.once(&mut count, entry),
            None => reader.extension(entry, extensions),
        }
    }
    numbered.sort_by_key(|&(number, _)| number);
    for (position, (number, entry)) in numbered.iter().enumerate() {
        match numbered.get(position + 1) {
            Some((next, later)) if next == number => reader.duplicate_key(entry, later),
            _ => lines.push(reader.doc.value(entry).into()),
        }
    }
}

fn commissioning(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device) {
    const KEYS: [&str; 7] =
        ["NodeID", "NodeName", "Baudrate", "NetNumber", "NetworkName", "CANopenManager", "LSS_SerialNumber"];
    let mut seen = [None; KEYS.len()];
    let mut settings = device.commissioning.take().unwrap_or_default();
    for ref entry in reader.doc.entries_of(sections) {
        let Some(which) = position(&KEYS, reader.doc.key(entry)) else {
            reader.extension(entry, &mut device.extensions);
            continue;
        };
        reader.once(&mut seen[which], entry);
        let text = reader.doc.value(entry);
        match which {
            0 => settings.node_id = node_id(reader, entry),
            1 => settings.node_name = text.into(),
            2 => settings.bit_rate = reader.unsigned(entry, 0xFFFF).map(|rate| rate as u16),
            3 => settings.net_number = reader.u32_of(entry),
            4 => settings.network_name = text.into(),
            5 => settings.manager = reader.flag(entry),
            _ => settings.lss_serial_number = reader.u32_of(entry),
        }
    }
    missing(reader, sections, &KEYS, &seen, &[0, 2]);
    device.identity.serial_number = settings.lss_serial_number.filter(|&serial| serial != 0);
    device.commissioning = Some(settings);
}

fn node_id(reader: &mut Reader<'_, '_>, entry: &Entry) -> Option<u8> {
    let value = reader.unsigned(entry, 0xFF)?;
    network::node_id(value, reader.doc.value_span(entry), reader.diagnostics)
}

fn connected_modules(reader: &mut Reader<'_, '_>, sections: &[Section], device: &mut Device) {
    let mut settings = device.commissioning.take().unwrap_or_else(|| Box::new(Commissioning::default()));
    for entry in lists::numbered(reader, sections, "NrOfEntries", &mut device.extensions) {
        settings.connected_modules.extend(reader.unsigned(&entry, 0xFFFF).map(|module| module as u16));
    }
    device.commissioning = Some(settings);
}

/// Reads the segments of dynamic channels: `TypeN`, `DirN`, `RangeN`, `PPOffsetN` (CiA 302-4, CiA 306-2).
fn dynamic_channels(
    reader: &mut Reader<'_, '_>,
    sections: &[Section],
    device: &mut Device,
    canopen: &mut CanOpenSettings,
) {
    const FIELDS: [&str; 4] = ["Type", "Dir", "Range", "PPOffset"];
    let mut segments: BTreeMap<u32, [Option<Entry>; FIELDS.len()]> = BTreeMap::new();
    let mut count = None;
    for ref entry in reader.doc.entries_of(sections) {
        let key = reader.doc.key(entry);
        let split = key.len() - key.bytes().rev().take_while(u8::is_ascii_digit).count();
        match (position(&FIELDS, &key[..split]), key[split..].parse::<u32>()) {
            (Some(field), Ok(number)) => reader.once(&mut segments.entry(number).or_default()[field], entry),
            _ if key.eq_ignore_ascii_case("NrOfSeg") => reader.once(&mut count, entry),
            _ => reader.extension(entry, &mut device.extensions),
        }
    }
    if let Some(count) = count {
        lists::announced_count(reader, &count, segments.len(), false);
    }
    canopen.dynamic_channels.extend(segments.values().map(|fields| dynamic_channel(reader, fields)));
}

fn dynamic_channel(reader: &mut Reader<'_, '_>, fields: &[Option<Entry>; 4]) -> DynamicChannel {
    let mut segment = DynamicChannel::default();
    let [data_type, direction, range, offset] = fields;
    segment.data_type = data_type.as_ref().and_then(|entry| reader.u32_of(entry)).unwrap_or(0);
    let mut text = |entry: &Option<Entry>| entry.as_ref().map(|entry| reader.fixed(entry, Fixed::Number));
    segment.direction = text(direction).map_or("", |(text, _)| text).into();
    segment.range = text(range).map_or("", |(text, _)| text).into();
    let Some((text, span)) = text(offset).filter(|(text, _)| !text.is_empty()) else { return segment };
    for part in text.split(',').map(str::trim) {
        let span = reader.doc.span_of(part);
        reader.converter().quirk(number::parse(part, &[]), part, span);
    }
    match offsets(text) {
        Some((offset, difference)) => (segment.offset, segment.difference) = (offset, difference),
        None => {
            let message = format!("`{text}` is not a valid PPOffset");
            let label = "expected `offset` or `offset, difference`";
            reader.diagnostics.push(codes::ILLEGAL_NUMBER.at(span, message).label(label));
        }
    }
    segment
}

/// Reads an offset in the form `offset` or `offset, difference`.
fn offsets(text: &str) -> Option<(i64, Option<i64>)> {
    let number = |text: &str| number::parse(text.trim(), &[]).int().and_then(|value| i64::try_from(value).ok());
    match text.split_once(',') {
        Some((offset, difference)) => Some((number(offset)?, Some(number(difference)?))),
        None => Some((number(text)?, None)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_of_the_header() {
        assert!(is_date("12-31-2020") && !is_date("2016-03-25") && !is_date("13-01-2020") && !is_date("12-31-20é"));
        assert!(is_time("12:00PM") && is_time("09:30 am") && !is_time("17:24:43") && !is_time("9:30AM"));
        assert!(is_eds_version("4.0") && is_eds_version("3.0"));
        for text in ["404", "4", "402", "5.0", "4.10"] {
            assert!(!is_eds_version(text), "{text}");
        }
        assert!(is_version("1") && !is_version("1.0") && !is_version("-") && !is_version("256"));
        assert_eq!(offsets("0, 1"), Some((0, Some(1))));
        assert_eq!(offsets("0x10"), Some((16, None)));
    }
}
