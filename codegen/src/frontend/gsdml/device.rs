//! Reads device access points: the settings of a device, and the modules and submodules that can be plugged into the
//! device.

use super::links::{ElementKind, Owner};
use super::reader::Reader;
use super::submodule::Holder;
use crate::frontend::xml::{Given, Read};
use crate::ir::{
    Catalog, Device, Group, GroupKind, IoLengths, Numbers, ObjectCode, ProfinetSettings, Record, Slot, Submodule,
    VendorBlock,
};
use crate::syntax::xml::Tag;

/// Maximum record length in bytes if the file does not declare one.
const RECORD_SIZE: u32 = 4068;

/// Send clock factor if the file does not declare one: 32 × 31.25 µs = 1 ms.
const SEND_CLOCK: u16 = 32;

impl<'a> Reader<'a, '_> {
    /// Reads a `DeviceAccessPointList` element.
    pub fn device_list(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.each(list, "DeviceAccessPointItem", |reader, tag| {
            let device = reader.device(tag, catalog)?;
            catalog.devices.push(device);
            Ok(())
        })
    }

    fn device(&mut self, parent: &Tag<'a>, catalog: &mut Catalog) -> Read<Device> {
        let start = self.extensions.len();
        let mut device = Device { origin: self.origin(parent), ..Device::default() };
        let mut settings = self.settings(parent, catalog.devices.len(), &mut device)?;
        let mut info = None;
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "ModuleInfo" => info = Some(self.module_info(&tag)?),
                _ => self.device_child(&tag, catalog, &mut device, &mut settings)?,
            }
        }
        match info {
            Some(info) => {
                let identity = &mut device.identity;
                info.add_to(&mut device.name, &mut device.documentation, identity, &mut settings.attributes);
            }
            None => self.missing(parent, "ModuleInfo", "the name is left empty"),
        }
        if settings.startup_modes.is_empty() {
            settings.startup_modes.push("Legacy".into());
        }
        if settings.send_clocks.is_empty() {
            settings.send_clocks = Numbers::from_iter([SEND_CLOCK]);
        }
        settings.relations = settings.relations.max(1);
        device.profinet = Some(Box::new(settings));
        device.extensions = self.extensions_since(start);
        Ok(device)
    }

    /// Reads the attributes of a device access point.
    fn settings(&mut self, tag: &Tag<'a>, position: usize, device: &mut Device) -> Read<ProfinetSettings> {
        const NAMES: [&str; 9] = [
            "ID",
            "ModuleIdentNumber",
            "PNIO_Version",
            "PhysicalSlots",
            "MinDeviceInterval",
            "DNS_CompatibleName",
            "AllowedInSlots",
            "FixedInSlots",
            "MaxSupportedRecordSize",
        ];
        let mut settings = ProfinetSettings::default();
        let [id, ident, version, slots, interval, dns, allowed, fixed, record] =
            self.attributes_and_others(tag, NAMES, &mut settings.attributes)?;
        self.register(tag, ElementKind::AccessPoint, &id, position);
        device.id = id.compact();
        settings.ident = self.required_ident(tag, &ident, "ModuleIdentNumber");
        settings.pnio_version = version.compact();
        settings.slots = self.numbers(&slots);
        settings.min_device_interval = self.unsigned16(&interval, "minimum device interval");
        settings.dns_name = dns.compact();
        settings.places = self.places([allowed, fixed, Given::missing()]);
        settings.max_record_size = self.unsigned(&record, u32::MAX, "maximum record length").unwrap_or(RECORD_SIZE);
        device.identity.others.push(("module_ident".into(), settings.ident));
        Ok(settings)
    }

    fn device_child(
        &mut self,
        tag: &Tag<'a>,
        catalog: &mut Catalog,
        device: &mut Device,
        settings: &mut ProfinetSettings,
    ) -> Read<()> {
        let owner = catalog.devices.len();
        match tag.name {
            "VirtualSubmoduleList" | "SystemDefinedSubmoduleList" => {
                let (submodules, uses) = (&mut catalog.submodules, &mut device.submodules);
                self.built_in(tag, &mut Holder { submodules, uses, settings: Some(settings) })
            }
            "UseableModules" => self.useable_modules(tag, owner),
            "UseableSubmodules" => self.useable_submodules(tag, Owner::Device(owner)),
            "IOConfigData" => self.io_config_data(tag, settings),
            "SubslotList" => {
                settings.subslot_names = self.subslot_list(tag)?;
                Ok(())
            }
            "SlotList" => self.slot_list(tag, device),
            "ARVendorBlock" => self.vendor_blocks(tag, settings),
            "Graphics" => self.keep_graphics(tag, &mut settings.attributes),
            "ApplicationRelations" => {
                // In GSDML V1.0 and V2.0, `ApplicationRelations` is a child of the device access point, not of the
                // interface.
                let mut kept = Submodule::default();
                self.application_relations(tag, Some(settings), &mut kept)?;
                settings.attributes.append(&mut kept.attributes);
                Ok(())
            }
            "CertificationInfo"
            | "AssetManagement"
            | "SystemRedundancy"
            | "SlotGroups"
            | "FieldbusIntegrationSlots" => self.keep_as_attributes(tag, &mut settings.attributes),
            _ => self.unknown(tag),
        }
    }

    fn useable_modules(&mut self, list: &Tag<'a>, device: usize) -> Read<()> {
        let names = ["ModuleItemTarget", "AllowedInSlots", "FixedInSlots", "UsedInSlots"];
        self.each(list, "ModuleItemRef", |reader, tag| {
            let [target, allowed, fixed, used] = reader.attributes(tag, names)?;
            let places = reader.places([allowed, fixed, used]);
            if reader.require(tag, &target, "ModuleItemTarget", "left out") {
                reader.format.links.modules.push((device, target, places));
            }
            reader.no_children(tag)
        })
    }

    fn io_config_data(&mut self, tag: &Tag<'a>, settings: &mut ProfinetSettings) -> Read<()> {
        let names = ["MaxInputLength", "MaxOutputLength", "MaxDataLength"];
        let [input, output, data] = self.attributes_and_prefixed(tag, names, &mut settings.attributes)?;
        settings.max_lengths = IoLengths {
            input: self.unsigned16(&input, "data length"),
            output: self.unsigned16(&output, "data length"),
            data: self.unsigned16(&data, "data length"),
        };
        self.no_children(tag)
    }

    fn slot_list(&mut self, list: &Tag<'a>, device: &mut Device) -> Read<()> {
        self.each(list, "SlotItem", |reader, tag| {
            let [number, text] = reader.attributes(tag, ["SlotNumber", "TextId"])?;
            let name = reader.name(tag, text);
            reader.require(tag, &number, "SlotNumber", "left out");
            if let Some(number) = reader.unsigned16(&number, "slot number") {
                device.slots.push(Slot { number, name, instances: (0, 1), ..Slot::default() });
            }
            reader.no_children(tag)
        })
    }

    fn vendor_blocks(&mut self, list: &Tag<'a>, settings: &mut ProfinetSettings) -> Read<()> {
        self.each(list, "Request", |reader, tag| {
            let start = reader.extensions.len();
            let mut group = Group::object(0, ObjectCode::Record);
            group.origin = reader.origin(tag);
            let names = ["Length", "API", "APStructureIdentifier"];
            let [length, api, identifier] = reader.attributes(tag, names)?;
            let identifier = reader.unsigned16(&identifier, "structure identifier").unwrap_or(0);
            let length = reader.record_length(tag, &length);
            let mut record = Record { index: identifier, length, ..Record::default() };
            let mut menus = Vec::new();
            reader.record_body(tag, &mut record, &mut group, &mut menus)?;
            group.kind = GroupKind::Record(Box::new(record));
            group.extensions = reader.extensions_since(start);
            let api = reader.unsigned(&api, u32::MAX, "API number").unwrap_or(0);
            settings.vendor_blocks.push(VendorBlock { api, identifier, record: group, menus });
            Ok(())
        })
    }
}
