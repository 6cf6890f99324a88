//! Device access points.

use super::elements;
use super::module::{find, graphics, is_of_info, places, ranges, subslots, Info};
use super::{record, submodule, Context};
use crate::note::{NoteKind, Place};
use crate::xml::Xml;
use lexibus_codegen::ir::{CompactString, Device, GroupKind, Menu, ModuleUse, ProfinetSettings, SubmoduleKind};

/// Greatest length of a record where the file doesn't say.
const RECORD_SIZE: u32 = 4068;

/// Writes a device access point.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    let none = ProfinetSettings::default();
    let settings = device.profinet.as_deref().unwrap_or(&none);
    let attributes = settings.attributes.as_slice();
    xml.open("DeviceAccessPointItem");
    head(xml, device, settings);
    info(xml, context, device, settings);
    elements::CERTIFICATION.write(xml, attributes);
    subslots(xml, context, &settings.subslot_names);
    io_config_data(xml, settings);
    useable_modules(xml, context, &device.modules);
    vendor_blocks(xml, context, settings);
    let has_interface = device.submodules.iter().any(|own| {
        let found = context.catalog.submodules.get(own.submodule.0 as usize);
        found.is_some_and(|submodule| submodule.kind == SubmoduleKind::Interface)
    });
    submodule::built_in(xml, context, &device.submodules, Some(settings));
    graphics(xml, attributes);
    elements::ASSETS.write(xml, attributes);
    // Where there is no interface, or it has none of its own, V1.0 and V2.0 have this here.
    let is_here = !has_interface || attributes.iter().any(|(key, _)| key.starts_with("ApplicationRelations@"));
    if is_here && context.is_gsdml {
        let own = submodule::relations(attributes, Some(settings).filter(|_| !has_interface), false);
        elements::RELATIONS.write(xml, &own);
    }
    elements::REDUNDANCY.write(xml, attributes);
    submodule::useable(xml, context, &device.submodules);
    slot_list(xml, context, device);
    elements::SLOT_GROUPS.write(xml, attributes);
    elements::FIELDBUS_SLOTS.write(xml, attributes);
    xml.close();
    context.notes.add_many(NoteKind::Extension, device.extensions.len(), Place::Named(&device.name));
}

fn head(xml: &mut Xml, device: &Device, settings: &ProfinetSettings) {
    xml.attribute("ID", &device.id);
    xml.attribute("ModuleIdentNumber", format_args!("0x{:08X}", settings.ident));
    for (name, value) in [("PNIO_Version", &settings.pnio_version), ("DNS_CompatibleName", &settings.dns_name)] {
        if !value.is_empty() {
            xml.attribute(name, value);
        }
    }
    if !settings.slots.is_empty() {
        xml.attribute("PhysicalSlots", ranges(&settings.slots));
    }
    xml.optional("MinDeviceInterval", settings.min_device_interval);
    places(xml, &settings.places, "Slots");
    if settings.max_record_size != RECORD_SIZE {
        xml.attribute("MaxSupportedRecordSize", settings.max_record_size);
    }
    let is_own = |key: &str| !elements::is_of_element(key) && !is_of_info(key);
    for (key, value) in settings.attributes.iter().filter(|(key, _)| is_own(key)) {
        xml.attribute(key, value);
    }
}

fn info(xml: &mut Xml, context: &mut Context<'_>, device: &Device, settings: &ProfinetSettings) {
    let attributes = settings.attributes.as_slice();
    let info = Info {
        name: &device.name,
        names: &device.names,
        documentation: device.documentation.as_deref(),
        vendor: find(attributes, "ModuleInfo/VendorName"),
        order: &device.identity.order_code,
        hardware: find(attributes, "HardwareRelease"),
        software: find(attributes, "SoftwareRelease"),
        attributes,
    };
    info.write(xml, context);
}

fn io_config_data(xml: &mut Xml, settings: &ProfinetSettings) {
    let lengths = settings.max_lengths;
    xml.open("IOConfigData");
    xml.optional("MaxInputLength", lengths.input);
    xml.optional("MaxOutputLength", lengths.output);
    xml.optional("MaxDataLength", lengths.data);
    for (key, value) in &settings.attributes {
        if let Some(("IOConfigData", name)) = key.split_once('@') {
            xml.attribute(name, value);
        }
    }
    xml.close();
}

fn useable_modules(xml: &mut Xml, context: &Context<'_>, uses: &[ModuleUse]) {
    if uses.is_empty() {
        return;
    }
    xml.open("UseableModules");
    for own in uses {
        let Some(module) = context.catalog.modules.get(own.module.0 as usize) else { continue };
        xml.open("ModuleItemRef");
        xml.attribute("ModuleItemTarget", &module.id);
        places(xml, &own.places, "Slots");
        xml.close();
    }
    xml.close();
}

fn vendor_blocks(xml: &mut Xml, context: &mut Context<'_>, settings: &ProfinetSettings) {
    if settings.vendor_blocks.is_empty() {
        return;
    }
    xml.open("ARVendorBlock");
    for block in &settings.vendor_blocks {
        let GroupKind::Record(own) = &block.record.kind else { continue };
        xml.open("Request");
        xml.attribute("Length", own.length);
        if block.api != 0 {
            xml.attribute("API", block.api);
        }
        xml.attribute("APStructureIdentifier", block.identifier);
        let menus: Vec<&Menu> = block.menus.iter().collect();
        record::body(xml, context, own, &block.record, &menus);
        xml.close();
    }
    xml.close();
}

fn slot_list(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    if device.slots.is_empty() {
        return;
    }
    xml.open("SlotList");
    for slot in &device.slots {
        let text: CompactString = context.texts.id(&slot.name, &slot.names);
        xml.open("SlotItem");
        xml.attribute("SlotNumber", slot.number);
        xml.attribute("TextId", text);
        xml.close();
    }
    xml.close();
}
