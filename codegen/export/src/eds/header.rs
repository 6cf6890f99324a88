//! Writes the sections about the file and the device, and the object lists.

use super::extras::{Extra, Header};
use super::note::{NoteKind, Subject};
use super::object;
use super::section::{comment_lines, indices, Section, BIT_RATES};
use super::writer::Writer;
use super::{file_info, Context, Flavor};
use lexibus_codegen::ir::{CanOpenSettings, Catalog, Commissioning, CompactString, DynamicChannel, Group};

/// Writes a header section. An optional section is written only if it has content. If the section is an object list, also
/// writes the sections of its objects.
pub(super) fn write<'e>(
    writer: &mut Writer,
    context: &Context<'_>,
    catalog: &Catalog,
    header: Header,
    extras: impl Iterator<Item = Extra<'e>> + Clone,
    objects: &[&Group],
) {
    let mut out = Section::new(writer, header);
    if extras.clone().next().is_some() {
        out.open();
    }
    match header {
        Header::FileInfo => file_info::write(&mut out, context),
        Header::DeviceInfo => device_info(out.open(), context, objects),
        Header::DummyUsage => dummy_usage(&mut out, context),
        Header::Comments => comments(&mut out, &context.device.header.comments),
        Header::Commissioning => commissioning(&mut out, context),
        Header::SupportedModules => supported_modules(&mut out, context, catalog),
        Header::ConnectedModules => connected_modules(&mut out, context),
        Header::DynamicChannels => dynamic_channels(&mut out, context),
        Header::Mandatory | Header::Optional | Header::Manufacturer => list(out.open(), header, objects),
    }
    for extra in extras {
        writer.extension(extra.key, extra.value, Subject::Named(header.name()));
    }
    let listed = objects.iter().filter(|group| list_of(group) == Some(header));
    object::all(writer, context, listed);
}

fn device_info(writer: &mut Writer, context: &Context<'_>, objects: &[&Group]) {
    let (device, identity) = (context.device, &context.device.identity);
    let unknown = CanOpenSettings::default();
    let canopen = device.canopen.as_deref().unwrap_or(&unknown);
    let product =
        if context.is_verbatim || !identity.product_name.is_empty() { &identity.product_name } else { &device.name };
    writer.name("VendorName", &identity.vendor_name, Subject::Device);
    number(writer, "VendorNumber", identity.vendor_id);
    writer.name("ProductName", product, Subject::Device);
    number(writer, "ProductNumber", identity.product_code);
    number(writer, "RevisionNumber", identity.revision_number);
    if !identity.order_code.is_empty() {
        writer.name("OrderCode", &identity.order_code, Subject::Device);
    }
    for rate in BIT_RATES {
        writer.flag(&format!("BaudRate_{rate}"), canopen.bit_rates.contains(&rate));
    }
    writer.flag("SimpleBootUpMaster", canopen.boot_up_master);
    writer.flag("SimpleBootUpSlave", canopen.boot_up_slave);
    writer.optional("Granularity", canopen.granularity);
    writer.entry("DynamicChannelsSupported", canopen.dynamic_channels_supported);
    writer.flag("GroupMessaging", canopen.group_messaging);
    pdo_count(writer, "NrOfRXPDO", context, canopen.rx_pdos, objects, 0x1600);
    pdo_count(writer, "NrOfTXPDO", context, canopen.tx_pdos, objects, 0x1A00);
    writer.flag("LSS_Supported", canopen.lss);
    let compact_pdo = Some(canopen.compact_pdo).filter(|mask| *mask != 0);
    writer.optional("CompactPDO", compact_pdo.map(|mask| format!("0x{mask:02X}")));
}

/// Writes the number of PDOs that the source declares. If the source declares no number and the device is not a CANopen
/// device, writes the number of mapping objects.
fn pdo_count(
    writer: &mut Writer,
    key: &'static str,
    context: &Context<'_>,
    announced: Option<u16>,
    objects: &[&Group],
    first: u16,
) {
    if let Some(count) = announced {
        writer.entry(key, count);
    } else if !context.is_canopen {
        let is_mapping = |group: &&&Group| group.index().is_some_and(|index| (first..first + 0x200).contains(&index));
        writer.entry(key, objects.iter().filter(is_mapping).count());
    }
}

fn number(writer: &mut Writer, key: &'static str, value: Option<u32>) {
    writer.optional(key, value.map(|value| format!("0x{value:08X}")));
}

fn dummy_usage(out: &mut Section<'_>, context: &Context<'_>) {
    let Some(canopen) = context.device.canopen.as_deref().filter(|canopen| canopen.dummies_given) else { return };
    let writer = out.open();
    // Some readers require a DummyUsage entry for each type that CiA 306 lists in its examples.
    let usual = 1..=7;
    for code in usual.clone() {
        writer.numbered(format_args!("Dummy{code:04X}"), u8::from(canopen.dummies.contains(&code)));
    }
    for code in canopen.dummies.iter().filter(|code| !usual.contains(code)) {
        writer.numbered(format_args!("Dummy{code:04X}"), 1);
    }
}

fn comments(out: &mut Section<'_>, lines: &[CompactString]) {
    if !lines.is_empty() {
        comment_lines(out.open(), lines);
    }
}

fn commissioning(out: &mut Section<'_>, context: &Context<'_>) {
    let Some(commissioning) = context.device.commissioning.as_deref().filter(|_| context.flavor == Flavor::Dcf) else {
        return;
    };
    let is_of_modules =
        Commissioning { connected_modules: commissioning.connected_modules.clone(), ..Commissioning::default() }
            == *commissioning;
    if is_of_modules && !commissioning.connected_modules.is_empty() {
        return;
    }
    let writer = out.open();
    writer.optional("NodeID", commissioning.node_id);
    writer.plain("NodeName", &commissioning.node_name, Subject::Device);
    writer.optional("Baudrate", commissioning.bit_rate);
    writer.optional("NetNumber", commissioning.net_number);
    writer.plain("NetworkName", &commissioning.network_name, Subject::Device);
    writer.flag("CANopenManager", commissioning.manager);
    number(writer, "LSS_SerialNumber", commissioning.lss_serial_number);
}

fn supported_modules(out: &mut Section<'_>, context: &Context<'_>, catalog: &Catalog) {
    let count = context.device.accepted_modules(&catalog.modules).count();
    if context.is_canopen && (count > 0 || out.is_open) {
        out.open().entry("NrOfEntries", count);
    }
}

fn connected_modules(out: &mut Section<'_>, context: &Context<'_>) {
    let Some(commissioning) = context.device.commissioning.as_deref().filter(|_| context.flavor == Flavor::Dcf) else {
        return;
    };
    if commissioning.connected_modules.is_empty() && !out.is_open {
        return;
    }
    let writer = out.open();
    writer.entry("NrOfEntries", commissioning.connected_modules.len());
    for (module, number) in commissioning.connected_modules.iter().zip(1..) {
        writer.numbered(number, module);
    }
}

fn dynamic_channels(out: &mut Section<'_>, context: &Context<'_>) {
    let Some(canopen) = context.device.canopen.as_deref() else { return };
    if canopen.dynamic_channels.is_empty() && !out.is_open {
        return;
    }
    let writer = out.open();
    writer.entry("NrOfSeg", canopen.dynamic_channels.len());
    for (channel, number) in canopen.dynamic_channels.iter().zip(1..) {
        dynamic_channel(writer, channel, number);
    }
}

fn dynamic_channel(writer: &mut Writer, channel: &DynamicChannel, number: i32) {
    let subject = Subject::Named("DynamicChannels");
    writer.numbered(format_args!("Type{number}"), format_args!("0x{:04X}", channel.data_type));
    for (key, text) in [("Dir", &channel.direction), ("Range", &channel.range)] {
        if !text.is_empty() {
            let text = writer.one_line(text, subject);
            writer.numbered(format_args!("{key}{number}"), text);
        }
    }
    let key = format_args!("PPOffset{number}");
    match channel.difference {
        Some(difference) => writer.numbered(key, format_args!("{}, {difference}", channel.offset)),
        None => writer.numbered(key, channel.offset),
    }
    writer.notes.add_many(NoteKind::Setting, channel.max_number.is_some(), subject);
}

/// Returns the object list to which an object belongs. Objects below 0x1000 define data types and belong to no list.
fn list_of(group: &Group) -> Option<Header> {
    match group.index()? {
        0x0000..=0x0FFF => None,
        0x1000 | 0x1001 | 0x1018 => Some(Header::Mandatory),
        0x2000..=0x5FFF => Some(Header::Manufacturer),
        _ => Some(Header::Optional),
    }
}

fn list(writer: &mut Writer, header: Header, objects: &[&Group]) {
    let indices_of_list =
        || objects.iter().filter(|group| list_of(group) == Some(header)).filter_map(|group| group.index());
    indices(writer, "SupportedObjects", indices_of_list().count(), indices_of_list());
}
