//! Reads the vendor, groups, devices and modules of a file.

use super::budget::Cost;
use super::description::{Description, Owner, Reference, Target};
use super::reader::{Names, Reader};
use super::{device, modules};
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{CompactString, Family, Header};
use crate::source::Span;
use crate::syntax::xml::Tag;

/// Header and vendor of a file.
#[derive(Default)]
struct Vendor<'a> {
    id: Given<'a>,
    names: Names<'a>,
    seen: bool,
    header: Header,
}

/// Reads an `EtherCATInfo` or `EtherCATModule` element.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, description: &mut Description) -> Read<()> {
    let catalog = &mut description.catalog;
    let (first_device, first_module) = (catalog.devices.len(), catalog.modules.len());
    let mut vendor = Vendor::default();
    let [version] = reader.attributes(parent, ["Version"])?;
    vendor.header.format_version = version.compact();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Vendor" => read_vendor(reader, &tag, &mut vendor, &mut description.catalog.vendor_urls)?,
            "InfoReference" => {
                let given = reader.text(&tag)?;
                if !given.is_empty() {
                    description.references.push((Owner::Catalog, Reference::new(&given, Target::Info)));
                }
                reader.note("InfoReference", &given);
            }
            "Descriptions" => {
                while let Some(list) = reader.child(&tag)? {
                    read_list(reader, &list, description)?;
                }
            }
            _ => read_list(reader, &tag, description)?,
        }
    }
    identify(reader, parent.span, &vendor, description, first_device, first_module);
    Ok(())
}

fn read_list<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, description: &mut Description) -> Read<()> {
    match list.name {
        "Groups" => reader.each(list, "Group", |reader, tag| family(reader, tag, description))?,
        "Devices" => {
            reader.each(list, "Device", |reader, tag| {
                let (device, other_files) = device::read(reader, tag)?;
                description.add_other_files(Owner::Device(description.catalog.devices.len()), other_files);
                description.catalog.devices.push(device);
                Ok(())
            })?;
        }
        "Modules" => {
            reader.each(list, "Module", |reader, tag| {
                let (module, other_files) = modules::read(reader, tag)?;
                description.add_other_files(Owner::Module(description.catalog.modules.len()), other_files);
                description.catalog.modules.push(module);
                Ok(())
            })?;
        }
        // A template in this list is read when a PDO refers to the template.
        "Pdos" => reader.skip(list)?,
        _ => reader.unknown(list)?,
    }
    Ok(())
}

fn read_vendor<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    vendor: &mut Vendor<'a>,
    urls: &mut Vec<CompactString>,
) -> Read<()> {
    vendor.seen = true;
    let [version] = reader.attributes(parent, ["FileVersion"])?;
    vendor.header.file_version = version.compact();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Id" => vendor.id = reader.text(&tag)?,
            "Name" => reader.name(&tag, &mut vendor.names)?,
            "Comment" => {
                let mut comment = Names::default();
                reader.name(&tag, &mut comment)?;
                vendor.header.comments.extend(comment.all().map(|text| text.text));
            }
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            "URL" => urls.push(reader.text(&tag)?.compact()),
            "DescriptionURL" => reader.keep(&tag)?,
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

/// Sets the vendor of all devices and modules of a file, and the header of the devices. The `Vendor` element may come
/// after the devices and modules.
fn identify(
    reader: &mut Reader<'_, '_>,
    root: Span,
    vendor: &Vendor<'_>,
    description: &mut Description,
    first_device: usize,
    first_module: usize,
) {
    let id = reader.int(&vendor.id, "vendor ID");
    if vendor.id.is_empty() {
        let (message, label) = match vendor.seen {
            true => ("the vendor has no ID", "<Id> is empty or missing"),
            false => ("the file has no vendor", "<Vendor> is missing"),
        };
        reader.report(&codes::MISSING_IDENTITY, root, message, label);
    }
    let name = vendor.names.name();
    let catalog = &mut description.catalog;
    catalog.vendor_names = vendor.names.others();
    let Header { file_version, format_version, comments, .. } = &vendor.header;
    let of_comments = comments.iter().map(|text| size_of_val(text) + text.len()).sum::<usize>();
    let of_header = file_version.len() + format_version.len() + of_comments;
    for device in catalog.devices.iter_mut().skip(first_device) {
        device.identity.vendor_id = id;
        if reader.derive(Cost::text(name.len() + of_header), root) {
            (device.header, device.identity.vendor_name) = (vendor.header.clone(), name.clone());
        }
    }
    for module in catalog.modules.iter_mut().skip(first_module) {
        module.identity.vendor_id = id;
        if reader.derive(Cost::text(name.len()), root) {
            module.identity.vendor_name = name.clone();
        }
    }
}

/// Reads a `Group` element, which describes a family of devices.
fn family<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, description: &mut Description) -> Read<()> {
    let fields = reader.attributes(parent, ["SortOrder", "ParentGroup"])?;
    let [order, above] = &fields;
    reader.note("Group@SortOrder", order);
    reader.note("Group@ParentGroup", above);
    let mut family = Family { origin: reader.origin(parent), ..Family::default() };
    let mut names = Names::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Type" => family.id = reader.text(&tag)?.compact(),
            "Name" => reader.name(&tag, &mut names)?,
            "Comment" => {
                let mut comment = Names::default();
                reader.name(&tag, &mut comment)?;
                family.descriptions.extend(comment.all());
            }
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    (family.name, family.names) = (names.name(), names.others());
    description.catalog.families.push(family);
    Ok(())
}
