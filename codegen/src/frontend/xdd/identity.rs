//! Reads the file header and the identity of the device.

use super::number::integer;
use super::reader::Reader;
use crate::frontend::xml::{Given, Read};
use crate::ir::{CompactString, Device, Extension};
use crate::syntax::xml::Tag;

/// Reads the attributes of a profile body. A file has two profile bodies. If both bodies have the same attribute, the
/// value in the first body applies.
pub(super) fn body<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    const NAMES: [&str; 12] = [
        "fileName",
        "fileVersion",
        "fileCreationTime",
        "fileCreationDate",
        "fileCreator",
        "fileModificationTime",
        "fileModificationDate",
        "fileModifiedBy",
        "formatName",
        "formatVersion",
        "supportedLanguages",
        "deviceClass",
    ];
    let fields = reader.attributes(tag, NAMES)?;
    let header = &mut device.header;
    let targets = [
        &mut header.file_name,
        &mut header.file_version,
        &mut header.creation_time,
        &mut header.creation_date,
        &mut header.created_by,
        &mut header.modification_time,
        &mut header.modification_date,
        &mut header.modified_by,
    ];
    for (target, given) in targets.into_iter().zip(&fields) {
        if target.is_empty() {
            *target = given.compact();
        }
    }
    // The IR header has a field for the version of CiA 306, but none for the version of CiA 311.
    for (name, given) in NAMES.iter().zip(&fields).skip(9) {
        reader.note(name, given);
    }
    Ok(())
}

/// Reads a `DeviceIdentity` element, or the identity in the communication profile, which repeats a part of
/// `DeviceIdentity`.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "vendorName" => name(reader, &tag, &mut device.identity.vendor_name)?,
            "productName" => name(reader, &tag, &mut device.identity.product_name)?,
            "orderNumber" => order_number(reader, &tag, device)?,
            "vendorID" => number(reader, &tag, &mut device.identity.vendor_id)?,
            "productID" => number(reader, &tag, &mut device.identity.product_code)?,
            // A schema that some tools use misspells this name as `revisionNumer`.
            "revisionNumber" | "revisionNumer" => number(reader, &tag, &mut device.identity.revision_number)?,
            "version" => {
                let kind = reader.attribute(&tag, "versionType")?;
                let content = reader.content()?;
                reader.note(&format!("version/{}", kind.text), &content);
            }
            "productText" => product_text(reader, &tag, device)?,
            "vendorText"
            | "deviceFamily"
            | "productFamily"
            | "buildDate"
            | "specificationRevision"
            | "instanceName" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn name<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, name: &mut CompactString) -> Read<()> {
    let content = reader.text(tag)?;
    if name.is_empty() {
        *name = content.compact();
    }
    Ok(())
}

/// Reads an order number. The first order number is that of the device. The others, which belong to variants of the device, become
/// extensions.
fn order_number<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    let given = reader.text(tag)?;
    if device.identity.order_code.is_empty() {
        device.identity.order_code = given.compact();
    } else if device.identity.order_code != given.text {
        reader.note("orderNumber", &given);
    }
    Ok(())
}

/// Reads a number of the device identity. Reports any other text, and stores it as an extension, because other ISO
/// 15745 profiles allow texts. A number that differs from an earlier one becomes an extension, too.
fn number<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, number: &mut Option<u32>) -> Read<()> {
    let given = reader.text(tag)?;
    if given.is_missing() {
        return Ok(());
    }
    let value = parse(&given).and_then(|value| u32::try_from(value).ok());
    match value {
        Some(value) if number.is_none() => *number = Some(value),
        Some(value) if *number == Some(value) => {}
        Some(_) => reader.note(tag.name, &given),
        None => {
            reader.bad(&given, tag.name, "kept as an extension attribute; expected a 32-bit number");
            reader.note(tag.name, &given);
        }
    }
    Ok(())
}

/// Reads a number of the device identity. Eight digits without a prefix are a 32-bit hexadecimal number (`hexBinary`).
fn parse(given: &Given<'_>) -> Option<i128> {
    let text = given.text.as_ref();
    if text.len() == 8 && text.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return i128::from_str_radix(text, 16).ok();
    }
    integer(text)
}

/// Reads the description of the product, preferably in English. This text corresponds to the description in an EDS
/// file.
fn product_text<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    let texts = reader.texts(parent)?;
    let documentation = texts.documentation().unwrap_or_default();
    device.header.description = (&*documentation.text).into();
    let others = documentation.translations.iter().cloned().chain(texts.labels.all());
    reader.extensions.extend(others.map(|text| {
        let key = compact_str::format_compact!("productText/{}", text.language);
        Extension { key, value: text.text, span: parent.span }
    }));
    Ok(())
}
