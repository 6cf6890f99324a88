//! Device access points: what a device can, and what can be plugged into it.

use super::links::{Kind, Owner};
use super::module::{named_graphic, Info};
use super::reader::{attribute, Attributes, Given, Read, Reader};
use super::submodule::Holder;
use crate::ir::{
    Catalog, CompactString, Device, Extensions, Group, GroupKind, IoLengths, Numbers, ObjectCode, ProfinetSettings,
    Record, Slot, Submodule, VendorBlock,
};
use crate::syntax::xml::Tag;

/// Greatest length of a record where the source doesn't say.
const RECORD_SIZE: u32 = 4068;

/// Send clock factor where the source doesn't say: 1 ms.
const SEND_CLOCK: u16 = 32;

impl<'a> Reader<'a, '_> {
    /// Reads DeviceAccessPointList.
    pub fn device_list(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match tag.name {
                "DeviceAccessPointItem" => {
                    let device = self.device(&tag, catalog)?;
                    catalog.devices.push(device);
                }
                _ => self.unknown(&tag, &mut catalog.extensions)?,
            }
        }
        Ok(())
    }

    fn device(&mut self, parent: &Tag<'a>, catalog: &mut Catalog) -> Read<Device> {
        let mut device = Device { origin: self.cursor.origin(parent), ..Device::default() };
        let mut settings = self.settings(parent, catalog.devices.len(), &mut device)?;
        let mut info = None;
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "ModuleInfo" => info = Some(self.module_info(&tag, &mut device.extensions)?),
                _ => self.device_child(&tag, catalog, &mut device, &mut settings)?,
            }
        }
        match info {
            Some(info) => info.of_device(&mut device, &mut settings.attributes),
            None => self.missing(parent, "ModuleInfo", "its name is left empty"),
        }
        if settings.startup_modes.is_empty() {
            settings.startup_modes.push("Legacy".into());
        }
        if settings.send_clocks.is_empty() {
            settings.send_clocks = Numbers::from_iter([SEND_CLOCK]);
        }
        settings.relations = settings.relations.max(1);
        device.profinet = Some(Box::new(settings));
        Ok(device)
    }

    /// The attributes of a device access point.
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
            self.fields_of(tag, &NAMES, &mut settings.attributes)?;
        let text = |given: Option<Given<'a>>| given.map_or_else(CompactString::default, |given| given.text.into());
        self.register(tag, Kind::AccessPoint, id.as_ref(), position);
        device.id = text(id);
        settings.ident = self.required_ident(tag, ident.as_ref(), "ModuleIdentNumber");
        settings.pnio_version = text(version);
        settings.slots = self.numbers(slots.as_ref());
        settings.min_device_interval = self.unsigned16(interval.as_ref(), "multiple of 31.25 µs");
        settings.dns_name = text(dns);
        settings.places = self.places([allowed, fixed, None]);
        settings.max_record_size = self.unsigned(record.as_ref(), u32::MAX, "length in bytes").unwrap_or(RECORD_SIZE);
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
                let (uses, extensions) = (&mut device.submodules, &mut device.extensions);
                let submodules = &mut catalog.submodules;
                self.built_in(tag, &mut Holder { submodules, uses, settings: Some(settings), extensions })
            }
            "UseableModules" => self.useable_modules(tag, owner, &mut device.extensions),
            "UseableSubmodules" => self.useable_submodules(tag, Owner::Device(owner), &mut device.extensions),
            "IOConfigData" => self.io_config_data(tag, settings),
            "SubslotList" => {
                settings.subslot_names = self.subslot_list(tag, &mut device.extensions)?;
                Ok(())
            }
            "SlotList" => self.slot_list(tag, device),
            "ARVendorBlock" => self.vendor_blocks(tag, settings, &mut device.extensions),
            "Graphics" => {
                let graphics = self.graphics(tag, &mut device.extensions)?;
                settings.attributes.extend(graphics.into_iter().map(named_graphic));
                Ok(())
            }
            "ApplicationRelations" => {
                // V1.0 and V2.0 have it here.
                let mut kept = Submodule::default();
                self.application_relations(tag, Some(settings), &mut kept)?;
                settings.attributes.append(&mut kept.attributes);
                device.extensions.append(&mut kept.extensions);
                Ok(())
            }
            "CertificationInfo"
            | "AssetManagement"
            | "SystemRedundancy"
            | "SlotGroups"
            | "FieldbusIntegrationSlots" => self.keep_attributes(tag, &mut settings.attributes),
            _ => self.unknown(tag, &mut device.extensions),
        }
    }

    fn useable_modules(&mut self, list: &Tag<'a>, device: usize, rest: &mut Extensions) -> Read<()> {
        let names = ["ModuleItemTarget", "AllowedInSlots", "FixedInSlots", "UsedInSlots"];
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "ModuleItemRef" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let [target, allowed, fixed, used] = self.fields(&tag, &names, rest)?;
            let places = self.places([allowed, fixed, used]);
            match target {
                Some(target) => self.links.module(device, target, places),
                None => self.missing(&tag, "ModuleItemTarget", "left out"),
            }
            self.no_children(&tag, rest)?;
        }
        Ok(())
    }

    fn io_config_data(&mut self, tag: &Tag<'a>, settings: &mut ProfinetSettings) -> Read<()> {
        let mut others = Attributes::new();
        let names = ["MaxInputLength", "MaxOutputLength", "MaxDataLength"];
        let [input, output, data] = self.fields_of(tag, &names, &mut others)?;
        settings.max_lengths = IoLengths {
            input: self.unsigned16(input.as_ref(), "length in bytes"),
            output: self.unsigned16(output.as_ref(), "length in bytes"),
            data: self.unsigned16(data.as_ref(), "length in bytes"),
        };
        settings.attributes.extend(others.into_iter().map(|(key, value)| {
            let mut own = CompactString::from("IOConfigData@");
            own.push_str(&key);
            (own, value)
        }));
        self.cursor.skip(tag)?;
        Ok(())
    }

    fn slot_list(&mut self, list: &Tag<'a>, device: &mut Device) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "SlotItem" {
                self.unknown(&tag, &mut device.extensions)?;
                continue;
            }
            let [number, text] = self.fields(&tag, &["SlotNumber", "TextId"], &mut device.extensions)?;
            let name = self.name(&tag, text);
            if number.is_none() {
                self.missing(&tag, "SlotNumber", "left out");
            }
            if let Some(number) = self.unsigned16(number.as_ref(), "number of a slot") {
                device.slots.push(Slot { number, name, instances: (0, 1), ..Slot::default() });
            }
            self.no_children(&tag, &mut device.extensions)?;
        }
        Ok(())
    }

    fn vendor_blocks(&mut self, list: &Tag<'a>, settings: &mut ProfinetSettings, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "Request" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let mut group = Group::object(0, ObjectCode::Record);
            group.origin = self.cursor.origin(&tag);
            let names = ["Length", "API", "APStructureIdentifier"];
            let [length, api, identifier] = self.fields(&tag, &names, &mut group.extensions)?;
            let identifier = self.unsigned16(identifier.as_ref(), "structure identifier").unwrap_or(0);
            let length = self.record_length(&tag, length.as_ref());
            let mut record = Record { index: identifier, length, ..Record::default() };
            let mut menus = Vec::new();
            self.record_body(&tag, &mut record, &mut group, &mut menus)?;
            group.kind = GroupKind::Record(Box::new(record));
            let api = self.unsigned(api.as_ref(), u32::MAX, "API number").unwrap_or(0);
            settings.vendor_blocks.push(VendorBlock { api, identifier, record: group, menus });
        }
        Ok(())
    }
}

impl Info<'_> {
    /// What ModuleInfo says of a device access point.
    fn of_device(self, device: &mut Device, attributes: &mut Attributes) {
        let text = |given: Option<Given<'_>>| given.map_or_else(CompactString::default, |given| given.text.into());
        device.name = self.name;
        device.documentation = self.documentation;
        device.identity.vendor_name = text(self.vendor);
        device.identity.order_code = text(self.order);
        attribute("HardwareRelease", self.hardware.as_ref(), attributes);
        attribute("SoftwareRelease", self.software.as_ref(), attributes);
        attributes.extend(self.attributes);
    }
}
