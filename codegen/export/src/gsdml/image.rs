//! Describes a device of another format as a device access point if it has fixed process images. One submodule contains the
//! process images as its cyclic data.

use compact_str::{format_compact, CompactString};
use smallvec::smallvec;

use super::options::TrackedOptions;
use crate::note::{self, NoteKind, Notes, Subject};
use crate::options::MissingFacts;
use crate::types::resolved;
use lexibus_codegen::ir::{
    Binding, Catalog, Device, Direction, Header, Identity, IoData, IoItem, IoLengths, Numbers, PdoEntry, PdoEntryKind,
    ProcessImage, ProfinetSettings, SlotNumbers, Submodule, SubmoduleId, SubmoduleKind, SubmoduleUse, Type, TypeDef,
};

/// Subslot numbers of the first interface and of its first port.
const INTERFACE: u16 = 0x8000;
const PORT: u16 = 0x8001;
const MAX_PORTS: u16 = 0x0FFF;

/// Returns a GSDML catalog with the devices of `source` that have fixed process images. Returns `None` if no device has a fixed
/// process image.
pub(super) fn catalog(
    source: &Catalog,
    options: &TrackedOptions<'_>,
    notes: &mut Notes,
    missing: &mut MissingFacts,
) -> Option<Catalog> {
    let mut target = Catalog::default();
    for device in source.devices.iter().filter(|device| !device.process_data.images.is_empty()) {
        losses(source, device, notes);
        let position = target.devices.len();
        let mut maker = Maker { options, missing, notes, target: &mut target, position };
        let device = maker.device(device);
        target.devices.push(device);
    }
    (!target.devices.is_empty()).then_some(target)
}

struct Maker<'m> {
    options: &'m TrackedOptions<'m>,
    missing: &'m mut MissingFacts,
    notes: &'m mut Notes,
    target: &'m mut Catalog,
    /// Position of the device in the file, counted from 0.
    position: usize,
}

impl Maker<'_> {
    fn require<T: Default>(&mut self, given: Option<T>, key: &'static str) -> T {
        self.missing.require(given, key)
    }

    fn device(&mut self, source: &Device) -> Device {
        self.require(self.options.date(), "date");
        let description = source.documentation.as_deref().map_or("", |documentation| &documentation.text);
        let mut device = Device {
            name: source.name.clone(),
            names: source.names.clone(),
            id: self.id("DAP"),
            documentation: source.documentation.clone(),
            identity: Identity {
                vendor_name: source.identity.vendor_name.clone(),
                order_code: self.options.order_number().as_deref().unwrap_or(&source.identity.order_code).into(),
                ..Identity::default()
            },
            header: Header { description: description.into(), ..Header::default() },
            ..Device::default()
        };
        device.profinet = Some(Box::new(self.settings()));
        let submodule = self.submodule(source);
        let subslot = self.options.subslot().unwrap_or(1);
        self.add(&mut device, submodule, subslot);
        self.interface(&mut device);
        device
    }

    /// Returns an identifier that is unique in the file.
    fn id(&self, what: &str) -> CompactString {
        format_compact!("{what}_{}", self.position + 1)
    }

    fn add(&mut self, device: &mut Device, submodule: Submodule, subslot: u16) {
        let position = u32::try_from(self.target.submodules.len()).unwrap_or(u32::MAX);
        let places = SlotNumbers { fixed: Numbers::from_iter([subslot]), ..SlotNumbers::default() };
        device.submodules.push(SubmoduleUse { submodule: SubmoduleId(position), places });
        self.target.submodules.push(submodule);
    }

    fn settings(&mut self) -> ProfinetSettings {
        let options = self.options;
        let input = self.require(options.max_input_length(), "max-input-length");
        let output = self.require(options.max_output_length(), "max-output-length");
        let mut settings = ProfinetSettings {
            ident: self.require(options.module_ident(), "module-ident"),
            family: (
                options.main_family().as_deref().unwrap_or_default().into(),
                options.product_family().as_deref().unwrap_or_default().into(),
            ),
            pnio_version: self.require(options.pnio_version(), "pnio-version").into(),
            // Slot 0 contains the device access point. The device has no other slots.
            slots: Numbers(smallvec![(0, 0)]),
            dns_name: self.require(options.dns_name(), "dns-name").into(),
            min_device_interval: Some(self.require(options.min_device_interval(), "min-device-interval")),
            max_record_size: 4068,
            relations: 1,
            startup_modes: list(options.startup_modes().as_deref().unwrap_or("Legacy")),
            max_lengths: IoLengths { input: Some(input), output: Some(output), data: None },
            send_clocks: options.send_clocks().unwrap_or_default(),
            reduction_ratios: options.reduction_ratios().unwrap_or_default(),
            places: SlotNumbers { fixed: Numbers(smallvec![(0, 0)]), ..SlotNumbers::default() },
            ..ProfinetSettings::default()
        };
        settings.attributes = self.attributes();
        settings
    }

    /// Returns attributes of the device access point for which the IR has no field.
    fn attributes(&mut self) -> Vec<(CompactString, CompactString)> {
        let options = self.options;
        let required = [
            ("ObjectUUID_LocalIndex", self.require(options.object_uuid_index(), "object-uuid-index").to_string()),
            (
                "NameOfStationNotTransferable",
                self.require(options.name_not_transferable(), "name-not-transferable").to_string(),
            ),
            ("DeviceAccessSupported", self.require(options.device_access(), "device-access").to_string()),
            ("CheckDeviceID_Allowed", self.require(options.check_device_id(), "check-device-id").to_string()),
        ];
        let given = [("HardwareRelease", options.hardware_release()), ("SoftwareRelease", options.software_release())];
        let given = given.into_iter().filter_map(|(key, value)| Some((key, value?)));
        let all = required.into_iter().chain(self.certificate()).chain(given);
        all.map(|(key, value)| (CompactString::const_new(key), value.into())).collect()
    }

    /// Returns the attributes of CertificationInfo. The list is empty if the options have no conformance class.
    fn certificate(&mut self) -> Vec<(&'static str, String)> {
        let options = self.options;
        let Some(conformance) = options.conformance_class() else { return Vec::new() };
        let application = self.require(options.application_class(), "application-class");
        let application = if application == "none" { String::new() } else { application };
        let netload = options.netload_class().map(|class| ("CertificationInfo@NetloadClass", class));
        let classes =
            [("CertificationInfo@ConformanceClass", conformance), ("CertificationInfo@ApplicationClass", application)];
        classes.into_iter().chain(netload).collect()
    }

    /// Returns the submodule that contains the process data.
    fn submodule(&mut self, source: &Device) -> Submodule {
        let mut submodule = Submodule {
            id: self.id("IO"),
            ident: self.require(self.options.submodule_ident(), "submodule-ident"),
            kind: SubmoduleKind::Virtual,
            name: source.name.clone(),
            names: source.names.clone(),
            documentation: source.documentation.clone(),
            status_lengths: (1, 1),
            ..Submodule::default()
        };
        let alarms = self.require(self.options.process_alarms(), "process-alarms");
        submodule.attributes.push(("MayIssueProcessAlarm".into(), format_compact!("{alarms}")));
        for image in &source.process_data.images {
            let subject = match image.direction {
                Direction::Transmit => &mut submodule.input,
                Direction::Receive => &mut submodule.output,
            };
            match subject {
                Some(_) => self.notes.add(NoteKind::OtherPart, Subject::Named(&image.name)),
                None => {
                    let data = io_data(image, &source.types, self.notes);
                    let consistent = self.options.consistent().unwrap_or(false);
                    *subject = Some(Box::new(IoData { consistent, ..data }));
                }
            }
        }
        submodule
    }

    /// Adds the interface and its ports if the options contain the interface's ident number. Otherwise, adds a note.
    fn interface(&mut self, device: &mut Device) {
        let options = self.options;
        let Some(ident) = options.interface_ident() else {
            return self.notes.add(NoteKind::Incomplete, Subject::Named("InterfaceSubmoduleItem"));
        };
        let mut attributes = vec![(
            CompactString::const_new("SupportedProtocols"),
            CompactString::from(self.require(options.supported_protocols(), "supported-protocols")),
        )];
        attributes.extend(options.rt_classes().as_ref().map(|classes| ("SupportedRT_Classes".into(), classes.into())));
        let name = CompactString::from(self.require(options.interface_name(), "interface-name"));
        let interface = Submodule {
            id: self.id("Interface"),
            ident,
            kind: SubmoduleKind::Interface,
            name: name.clone(),
            attributes,
            status_lengths: (1, 1),
            ..Submodule::default()
        };
        self.add(device, interface, INTERFACE);
        let ports = self.require(options.ports(), "ports");
        self.notes.add_many(NoteKind::GivenFact, ports > MAX_PORTS, Subject::Named("ports"));
        for number in 0..ports.min(MAX_PORTS) {
            let kind = self.require(options.mau_type(), "mau-type");
            let port = Submodule {
                id: format_compact!("Port_{}_{}", self.position + 1, number + 1),
                ident: self.require(options.port_ident(), "port-ident"),
                kind: SubmoduleKind::Port,
                name: format_compact!("{name} P{}", number + 1),
                attributes: vec![("MAUTypeItem@Value".into(), format_compact!("{kind}"))],
                status_lengths: (1, 1),
                ..Submodule::default()
            };
            self.add(device, port, PORT + number);
        }
    }
}

/// Splits a text at each `;` into words.
fn list(text: &str) -> Vec<CompactString> {
    text.split(';').map(str::trim).filter(|word| !word.is_empty()).map(Into::into).collect()
}

/// Converts an image to data items of whole bytes. Fields that share a byte become one data item; its one-bit fields
/// keep their names.
fn io_data(image: &ProcessImage, types: &[TypeDef], notes: &mut Notes) -> IoData {
    let mut fields: Vec<PdoEntry> = Vec::new();
    let mut items = Vec::new();
    let mut sorted: Vec<&PdoEntry> = image.fields.iter().collect();
    sorted.sort_by_key(|field| field.bit_offset);
    let (mut at, mut next) = (0u32, 0usize);
    while let Some(first) = sorted.get(next) {
        let start = first.bit_offset / 8 * 8;
        filler(&mut fields, at, start);
        // Extend the data item to all fields that begin in its last byte or earlier.
        let mut end = first.bit_offset.saturating_add(first.bits);
        let mut last = next + 1;
        while let Some(field) = sorted.get(last).filter(|field| field.bit_offset / 8 < end.div_ceil(8)) {
            end = end.max(field.bit_offset.saturating_add(field.bits));
            last += 1;
        }
        let end_of_bytes = end.div_ceil(8) * 8;
        let run = sorted.get(next..last).unwrap_or_default();
        match run {
            [only] if only.bit_offset == start && end == end_of_bytes => {
                fields.push(whole(only, image, types, notes));
            }
            _ => bits(&mut fields, &mut items, run, start, end_of_bytes, notes),
        }
        (at, next) = (end_of_bytes, last);
    }
    filler(&mut fields, at, image.length.saturating_mul(8));
    let image = ProcessImage { fields, big_endian: true, ..image.clone() };
    IoData { image, consistent: false, items, channels: Vec::new() }
}

/// Adds a data item for bytes that no field occupies.
fn filler(fields: &mut Vec<PdoEntry>, from: u32, to: u32) {
    if from < to {
        let octets = Type::OctetString(Some((to - from) / 8));
        let name = CompactString::const_new("Reserved");
        let kind = PdoEntryKind::Unknown;
        fields.push(PdoEntry { bit_offset: from, kind, name, ty: octets, ..PdoEntry::new(0, 0, to - from) });
    }
}

/// Returns the data item of a field that occupies whole bytes.
fn whole(field: &PdoEntry, image: &ProcessImage, types: &[TypeDef], notes: &mut Notes) -> PdoEntry {
    let subject = Subject::Named(&field.name);
    let octets = |kind| (Type::OctetString(Some(field.bits / 8)), Some(kind));
    let (below, note) = resolved(field.ty, types);
    let below = below.unwrap_or(Type::Opaque(None));
    let (ty, type_note) = match below {
        Type::Unsigned(width) | Type::Integer(width) if u32::from(width) != field.bits => octets(NoteKind::UnknownType),
        Type::Unsigned(16 | 32 | 64) | Type::Integer(16 | 32 | 64) | Type::Real32 | Type::Real64
            if !image.big_endian =>
        {
            octets(NoteKind::ByteOrder)
        }
        Type::Unsigned(8 | 16 | 32 | 64) | Type::Integer(8 | 16 | 32 | 64) | Type::Real32 | Type::Real64 => {
            (below, None)
        }
        Type::Boolean if field.bits == 8 => (below, None),
        Type::VisibleString(_) | Type::OctetString(_) => (below, None),
        Type::Opaque(_) => octets(NoteKind::UnknownType),
        _ => octets(NoteKind::Structure),
    };
    notes.add_all(note.into_iter().chain(type_note), subject);
    PdoEntry { ty, ..field.clone() }
}

/// Adds one data item, which consists of bits, for fields that share bytes or are not byte-aligned. Adds a note for
/// each field that is longer than one bit or overlaps another field.
fn bits(fields: &mut Vec<PdoEntry>, items: &mut Vec<IoItem>, run: &[&PdoEntry], from: u32, to: u32, notes: &mut Notes) {
    let first = u32::try_from(fields.len()).unwrap_or(u32::MAX);
    let padding = |at: u32, end: u32| PdoEntry {
        bit_offset: at,
        kind: PdoEntryKind::Padding,
        ..PdoEntry::new(0, 0, end.saturating_sub(at))
    };
    let mut at = from;
    for field in run {
        if field.bits != 1 || field.bit_offset < at {
            notes.add(NoteKind::Layout, Subject::Named(&field.name));
            continue;
        }
        if at < field.bit_offset {
            fields.push(padding(at, field.bit_offset));
        }
        fields.push(PdoEntry { ty: Type::Boolean, kind: PdoEntryKind::Item, ..(*field).clone() });
        at = field.bit_offset + 1;
    }
    if at < to {
        fields.push(padding(at, to));
    }
    let names: Vec<&str> = run.iter().map(|field| field.name.as_str()).collect();
    items.push(IoItem {
        name: match names.as_slice() {
            [only] => CompactString::from(*only),
            [one, .., last] => format_compact!("{one} … {last}"),
            [] => CompactString::default(),
        },
        data_type: if to - from == 8 { "Unsigned8".into() } else { "OctetString".into() },
        bit_offset: from,
        bits: to - from,
        first_field: first,
        fields: u32::try_from(fields.len()).unwrap_or(u32::MAX).saturating_sub(first),
        ..IoItem::default()
    });
}

/// Adds notes for facts of the device that its process images do not contain.
fn losses(catalog: &Catalog, device: &Device, notes: &mut Notes) {
    let subject = Subject::Named(&device.name);
    let others = [device.canopen.is_some(), device.ethercat.is_some()].iter().filter(|is_there| **is_there).count();
    notes.add_many(NoteKind::OtherBus, others + device.modbus.len(), subject);
    let parts = note::parts_of_tables(device) + device.code_tables.len();
    notes.add_many(NoteKind::OtherPart, parts, subject);
    note::of_device(catalog, device, notes, subject);
    notes.add_many(NoteKind::Pdo, device.process_data.pdos.len(), subject);
    for group in &device.groups {
        for item in &group.items {
            let in_image = item.bindings.iter().any(|binding| matches!(binding, Binding::Image(_)));
            let in_record = item.bindings.iter().any(|binding| matches!(binding, Binding::Record { .. }));
            let subject = Subject::Named(&item.name);
            match (in_image, in_record) {
                (true, _) => {
                    notes.add_many(NoteKind::Binding, item.bindings.len() - 1, subject);
                    notes.add_many(NoteKind::Quantity, item.quantity.is_some(), subject);
                    let limits = usize::from(!item.limits.is_empty()) + usize::from(item.default.is_some());
                    notes.add_many(NoteKind::Limits, limits, subject);
                    notes.add_many(NoteKind::Behavior, item.behavior.is_some(), subject);
                    note::of_item(item, notes, subject);
                    notes.add_many(NoteKind::Documentation, item.documentation.is_some(), subject);
                }
                // A record cannot contain registers: it requires start-up values for all its bytes, and registers have
                // none.
                (false, true) => notes.add(NoteKind::Binding, subject),
                (false, false) => notes.add(NoteKind::NotInData, subject),
            }
        }
    }
}
