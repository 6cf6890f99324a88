//! Writes device access points.

use super::elements;
use super::module::{find, graphics, info, slot_lists, subslots};
use super::values::ranges;
use super::{record, submodule, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Device, GroupKind, Menu, ModuleUse, ProfinetSettings, SubmoduleKind};

/// Default value of MaxSupportedRecordSize: the maximum length of a record in bytes.
const RECORD_SIZE: u32 = 4068;

/// Writes the element of a device access point.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    let none = ProfinetSettings::default();
    let settings = device.profinet.as_deref().unwrap_or(&none);
    let attributes = settings.attributes.as_slice();
    xml.open("DeviceAccessPointItem");
    head(xml, device, settings);
    let [vendor, hardware, software] =
        ["ModuleInfo/VendorName", "HardwareRelease", "SoftwareRelease"].map(|key| find(attributes, key));
    let values = [vendor, &device.identity.order_code, hardware, software];
    info(xml, context, &device.name, &device.names, device.documentation.as_deref(), attributes, values);
    elements::CERTIFICATION.write(xml, attributes);
    subslots(xml, context, &settings.subslot_names);
    io_config_data(xml, settings);
    useable_modules(xml, context, &device.modules);
    vendor_blocks(xml, context, settings);
    let has_interface = device.submodules.iter().any(|submodule_use| {
        let found = context.catalog.submodules.get(submodule_use.submodule.0 as usize);
        found.is_some_and(|submodule| submodule.kind == SubmoduleKind::Interface)
    });
    submodule::built_in(xml, context, &device.submodules, Some(settings));
    graphics(xml, attributes);
    elements::ASSETS.write(xml, attributes);
    // In the GSDML schemas V1.0 and V2.0, a device access point contains ApplicationRelations if none of its interfaces does.
    let has_relations = !has_interface || attributes.iter().any(|(key, _)| key.starts_with("ApplicationRelations@"));
    if has_relations && context.is_gsdml {
        let relations = submodule::relations(attributes, Some(settings).filter(|_| !has_interface), false);
        elements::RELATIONS.write(xml, &relations);
    }
    elements::REDUNDANCY.write(xml, attributes);
    submodule::useable(xml, context, &device.submodules);
    slot_list(xml, context, device);
    elements::SLOT_GROUPS.write(xml, attributes);
    elements::FIELDBUS_SLOTS.write(xml, attributes);
    xml.close();
    xml.notes.add_many(NoteKind::Extension, device.extensions.len(), Subject::Named(&device.name));
}

fn head(xml: &mut Xml, device: &Device, settings: &ProfinetSettings) {
    xml.attribute("ID", &device.id);
    xml.attribute("ModuleIdentNumber", format_args!("0x{:08X}", settings.ident));
    xml.text_attribute("PNIO_Version", &settings.pnio_version);
    xml.text_attribute("DNS_CompatibleName", &settings.dns_name);
    xml.text_attribute("PhysicalSlots", &ranges(&settings.slots));
    xml.optional("MinDeviceInterval", settings.min_device_interval);
    slot_lists(xml, &settings.places, "Slots");
    xml.unless("MaxSupportedRecordSize", settings.max_record_size, RECORD_SIZE);
    elements::kept(xml, &settings.attributes);
}

fn io_config_data(xml: &mut Xml, settings: &ProfinetSettings) {
    let lengths = settings.max_lengths;
    xml.open("IOConfigData");
    xml.optional("MaxInputLength", lengths.input);
    xml.optional("MaxOutputLength", lengths.output);
    xml.optional("MaxDataLength", lengths.data);
    elements::attributes_of(xml, "IOConfigData", &settings.attributes);
    xml.close();
}

fn useable_modules(xml: &mut Xml, context: &Context<'_>, uses: &[ModuleUse]) {
    xml.list("UseableModules", uses, |xml, module_use| {
        let Some(module) = context.catalog.modules.get(module_use.module.0 as usize) else { return };
        xml.open("ModuleItemRef");
        xml.attribute("ModuleItemTarget", &module.id);
        slot_lists(xml, &module_use.places, "Slots");
        xml.close();
    });
}

fn vendor_blocks(xml: &mut Xml, context: &mut Context<'_>, settings: &ProfinetSettings) {
    xml.list("ARVendorBlock", &settings.vendor_blocks, |xml, block| {
        let GroupKind::Record(record) = &block.record.kind else { return };
        xml.open("Request");
        xml.attribute("Length", record.length);
        xml.unless("API", block.api, 0);
        xml.attribute("APStructureIdentifier", block.identifier);
        let menus: Vec<&Menu> = block.menus.iter().collect();
        record::body(xml, context, record, &block.record, &menus);
        xml.close();
    });
}

fn slot_list(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    xml.list("SlotList", &device.slots, |xml, slot| {
        let text = context.texts.id(&slot.name, &slot.names);
        xml.empty("SlotItem", &[("SlotNumber", &slot.number), ("TextId", &text)]);
    });
}
