//! Reads `Device` elements.

use super::description::OtherFiles;
use super::lower::lower;
use super::pdos::Pdos;
use super::profile::Profiles;
use super::reader::{Names, Reader};
use super::{clocks, device_info, eeprom, mailbox, slots, sync};
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Device, EtherCatSettings, Reference, SyncManager, ToolSettings};
use crate::syntax::xml::Tag;

/// Contents of a `Device` element that are collected until its end tag.
#[derive(Default)]
struct Parts<'a> {
    device: Device,
    settings: EtherCatSettings,
    names: Names<'a>,
    comment: Names<'a>,
    managers: Vec<(SyncManager, Given<'a>)>,
    pdos: Pdos<'a>,
    profiles: Profiles<'a>,
    has_type: bool,
}

/// Reads a `Device` element. Also returns the references to other files, and the types of PDO entries that these files may define.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Device, OtherFiles)> {
    let (mut parts, start) = (Parts::default(), reader.extensions.len());
    parts.device.origin = reader.origin(parent);
    let fields = reader.attributes(parent, ["Physics", "Invisible"])?;
    let [physics, invisible] = &fields;
    parts.settings.physics = physics.compact();
    parts.settings.invisible = reader.flag(invisible);
    while let Some(tag) = reader.child(parent)? {
        child(reader, &tag, &mut parts)?;
    }
    if !parts.has_type {
        let (message, label) = ("this device has no <Type>", "the device has no product code");
        reader.report(&codes::MISSING_IDENTITY, parent.span, message, label);
    }
    reader.note("AddInfo", &parts.profiles.add_info);
    reader.note("SubAddInfo", &parts.profiles.sub_add_info);
    parts.device.extensions = reader.extensions_since(start);
    Ok(finish(reader, parts))
}

fn child<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, parts: &mut Parts<'a>) -> Read<()> {
    let Parts { device, settings, .. } = parts;
    match tag.name {
        "Type" => {
            parts.has_type = true;
            device_type(reader, tag, device, settings)?;
        }
        "HideType" => hide(reader, tag, settings)?,
        "Name" => reader.name(tag, &mut parts.names)?,
        "Comment" => reader.name(tag, &mut parts.comment)?,
        "Info" => device_info::read(reader, tag, settings)?,
        "GroupType" => {
            let group = reader.text(tag)?;
            settings.group = Reference::new(group.compact(), group.span);
        }
        "Profile" => parts.profiles.read(reader, tag)?,
        "Fmmu" => sync::fmmu(reader, tag, settings)?,
        "Sm" => sync::sync_manager(reader, tag, &mut parts.managers)?,
        "Su" => sync::sync_unit(reader, tag, settings)?,
        "RxPdo" | "TxPdo" => parts.pdos.read(reader, tag)?,
        "Mailbox" => settings.mailbox = Some(Box::new(mailbox::read(reader, tag)?)),
        "Dc" => settings.clocks = Some(Box::new(clocks::read(reader, tag)?)),
        "Slots" => settings.slots = Some(Box::new(slots::read(reader, tag, &mut device.slots)?)),
        "ESC" => eeprom::registers(reader, tag, settings)?,
        "Eeprom" => settings.eeprom = Some(Box::new(eeprom::read(reader, tag)?)),
        "Image16x14" | "ImageFile16x14" if settings.picture.is_none() => {
            settings.picture = Some((tag.name.into(), reader.text(tag)?.compact()));
        }
        "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(tag)?,
        "VendorSpecific" => reader.vendor_specific(tag)?,
        "URL" => {
            let mut url = Names::default();
            reader.name(tag, &mut url)?;
            settings.urls.extend(url.all());
        }
        "Sci" | "AlternativeType" | "SubDevice" => reader.keep(tag)?,
        _ => reader.unknown(tag)?,
    }
    Ok(())
}

/// Reads a `Type` element.
fn device_type<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    device: &mut Device,
    settings: &mut EtherCatSettings,
) -> Read<()> {
    const NAMES: [&str; 12] = [
        "ProductCode",
        "RevisionNo",
        "SerialNo",
        "UseLrdLwr",
        "CheckProductCode",
        "CheckRevisionNo",
        "CheckSerialNo",
        "TcSmClass",
        "TcCfgModeSafeOp",
        "ModulePdoGroup",
        "DownloadModuleList",
        "ShowHideableSubDevices",
    ];
    let [product, revision, serial, without_lrw, texts @ ..] = &reader.attributes(tag, NAMES)?;
    settings.without_lrw = reader.flag(without_lrw);
    if texts.iter().any(|given| !given.is_empty()) {
        let [check_product_code, check_revision, check_serial_number, class, safe_op, group, download, show] =
            texts.each_ref().map(Given::compact);
        settings.tool = Some(Box::new(ToolSettings {
            check_product_code,
            check_revision,
            check_serial_number,
            sync_manager_class: class,
            safe_op_in_config_mode: safe_op,
            module_pdo_group: group,
            download_module_list: download,
            show_hideable_sub_devices: show,
        }));
    }
    let identity = &mut device.identity;
    identity.product_code = reader.int(product, "product code");
    identity.revision_number = reader.int(revision, "revision number");
    identity.serial_number = reader.int(serial, "serial number");
    if product.is_empty() {
        let message = "this device has no product code";
        reader.report(&codes::MISSING_IDENTITY, tag.span, message, "a master cannot identify the device");
    }
    let given = reader.content()?;
    identity.order_code = given.compact();
    device.id = given.compact();
    Ok(())
}

fn hide<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    let fields = reader.attributes(tag, ["ProductCode", "RevisionNo", "ProductRevision"])?;
    let [product, revision, name] = &fields;
    reader.note("HideType@ProductRevision", name);
    let hidden = (reader.int(product, "product code"), reader.int(revision, "revision number"));
    settings.hides.push(hidden);
    let given = reader.content()?;
    reader.note("HideType", &given);
    Ok(())
}

fn finish(reader: &mut Reader<'_, '_>, parts: Parts<'_>) -> (Device, OtherFiles) {
    let Parts { mut device, settings, names, comment, managers, pdos, mut profiles, .. } = parts;
    (device.name, device.names) = (names.name(), names.others());
    device.identity.product_name = device.name.clone();
    device.documentation = comment.documentation();
    device.process_data.sync_managers = sync::settle(reader, managers, &pdos.list);
    device.profiles = profiles.numbers;
    device.code_tables = profiles.code_tables;
    let lowered = lower(reader, profiles.dictionary, pdos, &mut device.process_data, &mut profiles.other_files);
    (device.types, device.groups) = lowered;
    device.ethercat = Some(Box::new(settings));
    (device, profiles.other_files)
}
