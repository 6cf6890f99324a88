//! Writes the file with its vendor, groups, devices and modules.

use std::collections::HashMap;

use lexibus_codegen::ir::{Catalog, Device, Format, Identity};

use super::super::note::Subject;
use super::super::options::MissingFacts;
use super::super::xml::Xml;
use super::context::Context;
use super::options::TrackedOptions;
use super::text::{hex, names};
use super::{device, diagnosis, extras, losses, module, text};
use super::{Export, NoteKind, Options, Refusal};

/// Version of ETG.2000 whose schema describes the exported file.
const VERSION: &str = "1.17";

/// Exports the EtherCAT slaves of `catalog`, and its other devices with objects, except PROFINET devices. Modules are
/// exported only if the source is an ESI. A file has one vendor, so devices and modules of other vendors are left out
/// with a note. The encoding is UTF-8.
///
/// # Errors
///
/// Returns [`Refusal::Nothing`] if there is nothing to export, and [`Refusal::Missing`] if the schema requires facts that neither
/// the source nor the options contain.
pub fn export(catalog: &Catalog, options: &Options) -> Result<Export, Refusal> {
    let options = &TrackedOptions::new(options);
    let devices: Vec<&Device> = catalog.devices.iter().filter(|device| is_slave(device)).collect();
    let is_messages =
        devices.is_empty() && catalog.modules.is_empty() && catalog.code_tables.iter().any(diagnosis::is_list);
    if devices.is_empty() && !(is_esi(catalog) && (!catalog.modules.is_empty() || is_messages)) {
        return Err(Refusal::Nothing);
    }
    let mut context = Context {
        catalog,
        options,
        missing: MissingFacts::new(Options::KEYS),
        units: HashMap::new(),
        is_esi: is_esi(catalog),
    };
    let mut xml = Xml::new();
    match devices.as_slice() {
        [device] if device.dictionary_only => dictionary_only(&mut xml, &mut context, device),
        [] if is_messages => messages_only(&mut xml, catalog),
        devices => info(&mut xml, &mut context, devices),
    }
    options.note_unused(&mut xml.notes);
    context.missing.finish(xml)
}

/// Returns whether an ESI can describe the device.
fn is_slave(device: &Device) -> bool {
    let has_objects = || device.groups.iter().any(|group| group.items.iter().any(|item| item.object().is_some()));
    device.ethercat.is_some() || device.profinet.is_none() && has_objects()
}

fn is_esi(catalog: &Catalog) -> bool {
    catalog.files.first().is_some_and(|file| file.format == Format::Esi)
}

/// Writes a file that contains only the dictionary of a device.
fn dictionary_only(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    xml.open("EtherCATDict");
    xml.text_attribute("Version", &device.header.format_version);
    device::dictionary(xml, context, device, |_, _, _| {});
    xml.close();
    losses::of_device(context, device, &mut xml.notes);
}

/// Writes a file that contains only diagnosis messages.
fn messages_only(xml: &mut Xml, catalog: &Catalog) {
    xml.open("EtherCATDiag");
    extras::diagnosis_version(xml, catalog);
    diagnosis::write(xml, &catalog.code_tables);
    xml.close();
}

fn info(xml: &mut Xml, context: &mut Context<'_>, devices: &[&Device]) {
    xml.open("EtherCATInfo");
    let first = devices.first();
    let version = first.map_or("", |device| device.header.format_version.as_str());
    match context.is_esi {
        true if version.is_empty() => {}
        true => xml.attribute("Version", version),
        false => xml.attribute("Version", VERSION),
    }
    let of_modules = || context.catalog.modules.first().map(|module| &module.identity);
    let none = Identity::default();
    let identity = first.map(|device| &device.identity).or_else(of_modules).unwrap_or(&none).clone();
    vendor(xml, context, first, &identity);
    xml.open("Descriptions");
    groups(xml, context, devices);
    xml.open("Devices");
    for device in devices {
        match device.identity.vendor_id == identity.vendor_id {
            true => device::write(xml, context, device),
            false => xml.notes.add(NoteKind::OtherVendor, Subject::Named(&device.name)),
        }
    }
    xml.close();
    if context.is_esi && !context.catalog.modules.is_empty() {
        xml.open("Modules");
        for module in &context.catalog.modules {
            match module.identity.vendor_id == identity.vendor_id {
                true => module::write(xml, context, module),
                false => xml.notes.add(NoteKind::OtherVendor, Subject::Named(&module.name)),
            }
        }
        xml.close();
    } else {
        xml.notes.add_many(NoteKind::Module, context.catalog.modules.len(), Subject::Device);
    }
    losses::of_catalog(context, &mut xml.notes);
}

fn vendor(xml: &mut Xml, context: &mut Context<'_>, device: Option<&&Device>, identity: &Identity) {
    let header = device.map(|device| &device.header);
    xml.open("Vendor");
    let version = header.map(|header| &header.file_version).filter(|version| context.is_esi && !version.is_empty());
    match version {
        Some(version) if version.parse::<i32>().is_ok() => xml.attribute("FileVersion", version),
        Some(_) => xml.notes.add(NoteKind::FileInfo, Subject::Device),
        None => {}
    }
    let id = context.missing.require(context.options.vendor_id().or(identity.vendor_id), "vendor-id");
    xml.leaf("Id", hex(id, 8));
    let name = Some(identity.vendor_name.to_string()).filter(|name| !name.is_empty() || context.is_esi);
    let name = context.missing.require(context.options.vendor_name().or(name), "vendor-name");
    xml.leaf("Name", name);
    for name in &context.catalog.vendor_names {
        text::name(xml, "Name", name, Subject::Named("Vendor"));
    }
    if context.is_esi {
        header.into_iter().flat_map(|header| &header.comments).for_each(|comment| xml.leaf("Comment", comment));
    }
    extras::of_vendor(xml, context.catalog);
    xml.close();
}

/// Writes the device groups of an ESI source, and the group from the options if the source does not define it.
fn groups(xml: &mut Xml, context: &mut Context<'_>, devices: &[&Device]) {
    xml.open("Groups");
    let catalog = context.catalog;
    let families = if context.is_esi { catalog.families.as_slice() } else { &[] };
    for family in families {
        let subject = Subject::Named(&family.name);
        xml.open("Group");
        xml.leaf("Type", &family.id);
        names(xml, "Name", &family.name, &family.names, subject);
        for local in &family.descriptions {
            text::name(xml, "Comment", local, subject);
        }
        xml.close();
    }
    let group = if devices.is_empty() { None } else { context.options.group() };
    if let Some(group) = &group {
        if !families.iter().any(|family| family.id == *group) {
            xml.leaves("Group", &[("Type", &group), ("Name", &group)]);
        }
    }
    xml.close();
}
