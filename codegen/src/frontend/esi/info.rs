//! The vendor, groups, devices and modules of a file.

use super::reader::{note, Given, Names, Read, Reader};
use super::references::{Owner, Reference, Target};
use super::{device, modules, Description};
use crate::diagnostics::codes;
use crate::ir::{Extension, Extensions, Family, Header, LocalText};
use crate::source::Span;
use crate::syntax::xml::Tag;

/// What a file says about itself and its vendor.
#[derive(Default)]
struct Vendor<'a> {
    id: Given<'a>,
    names: Names<'a>,
    seen: bool,
    header: Header,
    extensions: Extensions,
}

/// Reads EtherCATInfo or EtherCATModule.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, description: &mut Description) -> Read<()> {
    let catalog = &mut description.catalog;
    let (first_device, first_module) = (catalog.devices.len(), catalog.modules.len());
    let mut vendor = Vendor::default();
    let [version] = reader.fields(parent, &["Version"], &mut catalog.extensions)?;
    vendor.header.format_version = version.compact();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Vendor" => read_vendor(reader, &tag, &mut vendor)?,
            "InfoReference" => {
                let given = reader.leaf(&tag, &mut description.catalog.extensions)?;
                if !given.is_empty() {
                    description.references.push((Owner::Catalog, Reference::new(&given, Target::Info)));
                }
                note("InfoReference", &given, &mut description.catalog.extensions);
            }
            "Descriptions" => {
                while let Some(list) = reader.cursor.child(&tag)? {
                    read_list(reader, &list, description)?;
                }
            }
            _ => read_list(reader, &tag, description)?,
        }
    }
    identify(reader, parent.span, vendor, description, (first_device, first_module));
    Ok(())
}

fn read_list<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, description: &mut Description) -> Read<()> {
    match list.name {
        "Groups" => {
            while let Some(tag) = reader.cursor.child(list)? {
                match tag.name {
                    "Group" => family(reader, &tag, description)?,
                    _ => reader.unknown(&tag, &mut description.catalog.extensions)?,
                }
            }
        }
        "Devices" => {
            while let Some(tag) = reader.cursor.child(list)? {
                if tag.name != "Device" {
                    reader.unknown(&tag, &mut description.catalog.extensions)?;
                    continue;
                }
                let (device, elsewhere) = device::read(reader, &tag)?;
                description.leave(Owner::Device(description.catalog.devices.len()), elsewhere);
                description.catalog.devices.push(device);
            }
        }
        "Modules" => {
            while let Some(tag) = reader.cursor.child(list)? {
                if tag.name != "Module" {
                    reader.unknown(&tag, &mut description.catalog.extensions)?;
                    continue;
                }
                let (module, elsewhere) = modules::read(reader, &tag)?;
                description.leave(Owner::Module(description.catalog.modules.len()), elsewhere);
                description.catalog.modules.push(module);
            }
        }
        // PDOs that name a template read it.
        "Pdos" => reader.cursor.skip(list)?,
        _ => reader.unknown(list, &mut description.catalog.extensions)?,
    }
    Ok(())
}

fn read_vendor<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, vendor: &mut Vendor<'a>) -> Read<()> {
    vendor.seen = true;
    let extensions = &mut vendor.extensions;
    let [version] = reader.fields(parent, &["FileVersion"], extensions)?;
    vendor.header.file_version = version.compact();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Id" => vendor.id = reader.leaf(&tag, extensions)?,
            "Name" => reader.name(&tag, &mut vendor.names, extensions)?,
            "Comment" => {
                let mut comment = Names::default();
                reader.name(&tag, &mut comment, extensions)?;
                vendor.header.comments.extend(comment.all().map(|text| text.text));
            }
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag, extensions)?,
            "URL" | "DescriptionURL" => reader.keep(&tag, extensions)?,
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}

/// Gives the devices and modules of a file its vendor, which may stand behind them.
fn identify(
    reader: &mut Reader<'_, '_>,
    root: Span,
    mut vendor: Vendor<'_>,
    description: &mut Description,
    (first_device, first_module): (usize, usize),
) {
    let id = reader.int(&vendor.id, "number of a vendor");
    if vendor.id.is_empty() {
        let (message, label) = match vendor.seen {
            true => ("the vendor has no number", "Id is empty or missing"),
            false => ("nothing says who the vendor is", "there is no Vendor"),
        };
        reader.report(&codes::MISSING_IDENTITY, root, message, label);
    }
    let name = vendor.names.name();
    let others = vendor.names.others();
    let catalog = &mut description.catalog;
    catalog.extensions.append(&mut vendor.extensions);
    catalog.extensions.extend(others.iter().map(|LocalText { language, text }| Extension {
        key: compact_str::format_compact!("Vendor/Name@{language}"),
        value: text.clone(),
        span: vendor.names.span(),
    }));
    let Header { file_version, format_version, comments, .. } = &vendor.header;
    let of_comments = comments.iter().map(|text| size_of_val(text) + text.len()).sum::<usize>();
    let of_header = file_version.len() + format_version.len() + of_comments;
    for device in catalog.devices.iter_mut().skip(first_device) {
        device.identity.vendor_id = id;
        if reader.derive((0, name.len() + of_header), root) {
            (device.header, device.identity.vendor_name) = (vendor.header.clone(), name.clone());
        }
    }
    for module in catalog.modules.iter_mut().skip(first_module) {
        module.identity.vendor_id = id;
        if reader.derive((0, name.len()), root) {
            module.identity.vendor_name = name.clone();
        }
    }
}

/// Reads a Group: a family of devices.
fn family<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, description: &mut Description) -> Read<()> {
    let extensions = &mut description.catalog.extensions;
    let fields = reader.fields(parent, &["SortOrder", "ParentGroup"], extensions)?;
    let [order, above] = &fields;
    note("Group@SortOrder", order, extensions);
    note("Group@ParentGroup", above, extensions);
    let mut family = Family { origin: reader.cursor.origin(parent), ..Family::default() };
    let mut names = Names::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Type" => family.id = reader.leaf(&tag, extensions)?.compact(),
            "Name" => reader.name(&tag, &mut names, extensions)?,
            "Comment" => {
                let mut comment = Names::default();
                reader.name(&tag, &mut comment, extensions)?;
                family.descriptions.extend(comment.all());
            }
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag, extensions)?,
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    (family.name, family.names) = (names.name(), names.others());
    description.catalog.families.push(family);
    Ok(())
}
