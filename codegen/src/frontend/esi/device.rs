//! Devices.

use super::pdo::{self, Pdos};
use super::profile::Profiles;
use super::reader::{note, Given, Names, Read, Reader};
use super::references::{Elsewhere, EntryType, Target};
use super::types::Types;
use super::{clocks, device_info, dictionary, eeprom, items, mailbox, slots, sync};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, EtherCatSettings, Extensions, Group, PdoEntry, PdoEntryKind, SyncManager, Type, TypeDef};
use crate::source::Span;
use crate::syntax::xml::Tag;

/// What is collected of a device until its end.
#[derive(Default)]
struct Parts<'a> {
    device: Device,
    settings: EtherCatSettings,
    names: Names<'a>,
    comment: Names<'a>,
    managers: Vec<(SyncManager, Given<'a>)>,
    pdos: Pdos<'a>,
    profiles: Profiles<'a>,
    has_type: bool,
}

/// Reads a Device, and the files that it refers to.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Device, Elsewhere)> {
    let mut parts = Parts::default();
    parts.device.origin = reader.cursor.origin(parent);
    let fields = reader.fields(parent, &["Physics", "Invisible"], &mut parts.device.extensions)?;
    let [physics, invisible] = &fields;
    parts.settings.physics = physics.compact();
    parts.settings.invisible = reader.flag(invisible);
    while let Some(tag) = reader.cursor.child(parent)? {
        child(reader, &tag, &mut parts)?;
    }
    if !parts.has_type {
        reader.report(&codes::MISSING_IDENTITY, parent.span, "this device has no Type", "it has no product code");
    }
    Ok(finish(reader, parts))
}

fn child<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, parts: &mut Parts<'a>) -> Read<()> {
    let Parts { device, settings, .. } = parts;
    let extensions = &mut device.extensions;
    match tag.name {
        "Type" => {
            parts.has_type = true;
            device_type(reader, tag, device)?;
        }
        "HideType" => hide(reader, tag, settings, extensions)?,
        "Name" => reader.name(tag, &mut parts.names, extensions)?,
        "Comment" => reader.name(tag, &mut parts.comment, extensions)?,
        "Info" => device_info::read(reader, tag, settings, extensions)?,
        "GroupType" => settings.group = reader.leaf(tag, extensions)?.compact(),
        "Profile" => parts.profiles.read(reader, tag, extensions)?,
        "Fmmu" => sync::fmmu(reader, tag, settings, extensions)?,
        "Sm" => sync::sync_manager(reader, tag, &mut parts.managers, extensions)?,
        "Su" => sync::sync_unit(reader, tag, settings, extensions)?,
        "RxPdo" | "TxPdo" => pdo::read(reader, tag, &mut parts.pdos)?,
        "Mailbox" => settings.mailbox = Some(Box::new(mailbox::read(reader, tag, extensions)?)),
        "Dc" => settings.clocks = Some(Box::new(clocks::read(reader, tag, extensions)?)),
        "Slots" => {
            let rules = slots::read(reader, tag, &mut device.slots, &mut device.extensions)?;
            settings.slots = Some(Box::new(rules));
        }
        "ESC" => eeprom::registers(reader, tag, settings, extensions)?,
        "Eeprom" => settings.eeprom = Some(Box::new(eeprom::read(reader, tag, extensions)?)),
        "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(tag, extensions)?,
        "VendorSpecific" => reader.vendor_specific(tag, extensions)?,
        "URL" | "Sci" | "AlternativeType" | "SubDevice" => reader.keep(tag, extensions)?,
        _ => reader.unknown(tag, extensions)?,
    }
    Ok(())
}

fn device_type<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    let fields = reader.fields(tag, &["ProductCode", "RevisionNo", "SerialNo"], &mut device.extensions)?;
    let [product, revision, serial] = &fields;
    let identity = &mut device.identity;
    identity.product_code = reader.int(product, "product code");
    identity.revision_number = reader.int(revision, "revision number");
    identity.serial_number = reader.int(serial, "serial number");
    if product.is_empty() {
        let message = "this device has no product code";
        reader.report(&codes::MISSING_IDENTITY, tag.span, message, "a master can't tell it from others");
    }
    let given = reader.content(&mut device.extensions)?;
    identity.order_code = given.compact();
    device.id = given.compact();
    Ok(())
}

fn hide<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    settings: &mut EtherCatSettings,
    extensions: &mut Extensions,
) -> Read<()> {
    let fields = reader.fields(tag, &["ProductCode", "RevisionNo", "ProductRevision"], extensions)?;
    let [product, revision, name] = &fields;
    note("HideType@ProductRevision", name, extensions);
    let hidden = (reader.int(product, "product code"), reader.int(revision, "revision number"));
    settings.hides.push(hidden);
    let given = reader.content(extensions)?;
    note("HideType", &given, extensions);
    Ok(())
}

fn finish(reader: &mut Reader<'_, '_>, parts: Parts<'_>) -> (Device, Elsewhere) {
    let Parts { mut device, settings, names, comment, managers, pdos, mut profiles, .. } = parts;
    (device.name, device.names) = (names.name(), names.others());
    device.identity.product_name = device.name.clone();
    device.documentation = comment.documentation();
    device.process_data.sync_managers = sync::settle(reader, managers, &pdos.list);
    device.profiles = profiles.numbers;
    device.code_tables = profiles.code_tables;
    device.extensions.append(&mut profiles.dictionary.take_extensions());
    let lowered = lower(reader, profiles.dictionary, pdos, &mut device.process_data, &mut profiles.elsewhere);
    (device.types, device.groups) = lowered;
    device.ethercat = Some(Box::new(settings));
    (device, profiles.elsewhere)
}

/// Lowers the data types and objects of a device or module, and the PDOs whose entries name such types.
///
/// Types that may be in a file which `elsewhere` has are left to it.
pub(super) fn lower<'a>(
    reader: &mut Reader<'_, '_>,
    dictionary: dictionary::Dictionary<'a>,
    pdos: Pdos<'a>,
    data: &mut crate::ir::ProcessData,
    elsewhere: &mut Elsewhere,
) -> (Vec<TypeDef>, Vec<Group>) {
    let dictionary::Dictionary { types: raw, objects, mut subs, units, .. } = dictionary;
    let mut types = Types::new(reader, &raw);
    let has_files = elsewhere.files.iter().any(|file| file.target == Target::Dictionary);
    pdos.finish(data, |given, entry| {
        if has_files && entry.kind != PdoEntryKind::Padding && !given.is_empty() && !types.knows(&given.text) {
            elsewhere.types.push(EntryType::new(entry, given));
            return Type::Opaque(None);
        }
        entry_type(reader, &mut types, given, entry)
    });
    let groups = items::build(reader, &mut types, objects, &mut subs, &units);
    (types.into_defs(), groups)
}

/// The type of an entry: the one that it names, or else as many bits as it has.
fn entry_type(reader: &mut Reader<'_, '_>, types: &mut Types<'_, '_>, given: &Given<'_>, entry: &PdoEntry) -> Type {
    if given.is_empty() {
        return match u8::try_from(entry.bits) {
            Ok(bits @ 1..=64) if entry.kind != PdoEntryKind::Padding => Type::Unsigned(bits),
            _ => Type::Opaque(None),
        };
    }
    // What padding is called doesn't matter.
    if entry.kind == PdoEntryKind::Padding && super::type_name::basic(&given.text).is_none() {
        return Type::Opaque(None);
    }
    let ty = types.resolve(reader, given);
    check_length(reader.diagnostics, entry, (&given.text, given.span), types.bits(ty));
    ty
}

/// Reports an entry that is longer or shorter than its type, which has so many bits.
pub(super) fn check_length(
    diagnostics: &mut Diagnostics,
    entry: &PdoEntry,
    (name, span): (&str, Span),
    bits: Option<u32>,
) {
    match bits {
        Some(bits)
            if bits != entry.bits && entry.kind != PdoEntryKind::Padding && diagnostics.wants(&codes::ENTRY_LENGTH) =>
        {
            let message = format!("the entry has {} bits, but {name} has {bits}", entry.bits);
            diagnostics.push(Diagnostic::new(&codes::ENTRY_LENGTH, span, message).label("BitLen decides the layout"));
        }
        _ => {}
    }
}
