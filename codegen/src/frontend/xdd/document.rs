//! Reads a file: its profiles, and the device that the profiles describe.

use super::application::Application;
use super::object_list::Positions;
use super::reader::{Reader, Xdd};
use super::{identity, modules, network, objects, process, types};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::declared_encoding;
use crate::frontend::xml::Read;
use crate::ir::{CanOpenSettings, Catalog, Device, Extension};
use crate::source::{FileId, Source, Span};
use crate::syntax::xml::{Attribute, Cursor, Tag};

/// Reads the device that `source` describes. Reports repairs to `diagnostics`.
///
/// Returns `None` and reports one error if `source` is not well-formed, or does not describe a CANopen device.
pub fn read(source: &Source, file: FileId, aliases: &[String], diagnostics: &mut Diagnostics) -> Option<Catalog> {
    declared_encoding::report(source, file, diagnostics);
    let mut reader = Reader::new(Cursor::new(source.text(), file), diagnostics, Xdd { aliases });
    match container(&mut reader) {
        Ok(device) => Some(Catalog::of_device(device, Vec::new())),
        Err(stop) => {
            reader.diagnostics.push(*stop);
            None
        }
    }
}

/// Contents of the profiles of a file.
struct Profiles<'a> {
    device: Device,
    canopen: CanOpenSettings,
    application: Application<'a>,
    objects: Positions,
    /// True if the file contains a CANopen profile.
    canopen_seen: bool,
}

fn container<'a>(reader: &mut Reader<'a, '_>) -> Read<Device> {
    let root = reader.cursor.root()?;
    let mut profiles = Profiles {
        device: Device { origin: reader.origin(&root), ..Device::default() },
        canopen: CanOpenSettings::default(),
        application: Application::default(),
        objects: Positions::new(),
        canopen_seen: false,
    };
    match root.name {
        "ISO15745ProfileContainer" => {
            reader.each(&root, "ISO15745Profile", |reader, tag| profile(reader, tag, &mut profiles))?;
        }
        "ISO15745Profile" => profile(reader, &root, &mut profiles)?,
        _ => return Err(not_canopen(&root)),
    }
    // The content after the root element must also be well-formed.
    while reader.cursor.read()?.is_some() {}
    if !profiles.canopen_seen {
        return Err(not_canopen(&root));
    }
    let Profiles { mut device, mut canopen, mut application, objects, .. } = profiles;
    canopen.bit_rates.sort_unstable();
    canopen.bit_rates.dedup();
    device.name = device.identity.product_name.clone();
    device.canopen = Some(Box::new(canopen));
    device.extensions = reader.extensions_since(0);
    // Shrinking reduces the peak memory use, which occurs while the objects are read.
    application.parameters.shrink_to_fit();
    device.types = types::lower(reader, &mut application);
    objects::build(reader, &application, objects, &mut device)?;
    Ok(device)
}

fn not_canopen(root: &Tag<'_>) -> Box<Diagnostic> {
    let message = "this XML document does not describe a CANopen device";
    Box::new(codes::NOT_A_CANOPEN_XDD.at(root.name_span(), message).help(
        "check that the root element is ISO15745ProfileContainer, with profile bodies of the types \
         ProfileBody_Device_CANopen and ProfileBody_CommunicationNetwork_CANopen",
    ))
}

fn profile<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, profiles: &mut Profiles<'a>) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "ProfileHeader" => reader.keep(&tag)?,
            "ProfileBody" => body(reader, &tag, profiles)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn body<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, profiles: &mut Profiles<'a>) -> Read<()> {
    // Of the attributes in the schema instance namespace, only `type` matters. The prefix of this attribute is
    // arbitrary.
    let is_kind = |attribute: &Attribute<'_>| attribute.name == "type" && !attribute.prefix.is_empty();
    let kind = parent.attributes().find(|attribute| attribute.as_ref().map_or(true, is_kind)).transpose()?;
    let kind = kind.map(|attribute| (attribute.value(reader.diagnostics), attribute.span));
    if let Some((kind, span)) = &kind {
        let kind = kind.to_ascii_lowercase();
        if kind.contains("powerlink") {
            return Err(powerlink(*span));
        }
        if !kind.contains("canopen") {
            // The profile is for a technology other than CANopen, so its contents become extensions.
            return reader.keep(parent);
        }
        profiles.canopen_seen = true;
        if kind.contains("modular") {
            let (key, value) = ("ProfileBody@type".into(), kind.as_str().into());
            reader.extensions.push(Extension { key, value, span: *span });
        }
    }
    identity::body(reader, parent, &mut profiles.device)?;
    let Profiles { device, canopen, application, objects, canopen_seen } = profiles;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "DeviceIdentity" => identity::read(reader, &tag, device)?,
            "DeviceManager" => modules::device_manager(reader, &tag, device)?,
            "ApplicationProcess" => process::read(reader, &tag, application)?,
            "ApplicationLayers" => {
                *canopen_seen = true;
                network::application_layers(reader, &tag, device, canopen, objects)?;
            }
            "TransportLayers" => network::transport_layers(reader, &tag, canopen)?,
            "NetworkManagement" => network::management(reader, &tag, device, canopen)?,
            "DeviceFunction" | "ExternalProfileHandle" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn powerlink(span: Span) -> Box<Diagnostic> {
    let found = codes::POWERLINK_XDD.at(span, "this is an XDD for Ethernet POWERLINK, not for CANopen");
    let help = "ask the vendor for the CANopen XDD; the two formats share the extension .xdd and the outer elements";
    Box::new(found.label("this profile is defined by EPSG 311").help(help))
}
