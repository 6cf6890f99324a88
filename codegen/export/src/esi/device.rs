//! Writes the Device element.

use super::text::{documentation, hex, names};
use super::types::Types;
use super::{clocks, diagnosis, dictionary, eeprom, extras, losses, mailbox, objects, pdo, slots, sync, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{CompactString, Device, Direction, EtherCatSettings, Pdo};

/// Writes the Device element of a device.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, device: &Device) {
    let unknown = EtherCatSettings::default();
    let settings = device.ethercat.as_deref().unwrap_or(&unknown);
    let subject = Subject::Named(&device.name);
    xml.open("Device");
    xml.flag("Invisible", settings.invisible, "true");
    physics(xml, context, settings);
    device_type(xml, context, device, settings);
    for (product, revision) in &settings.hides {
        xml.open("HideType");
        xml.optional("ProductCode", product.map(|code| hex(code, 8)));
        xml.optional("RevisionNo", revision.map(|number| hex(number, 8)));
        xml.close();
    }
    names(xml, "Name", &device.name, &device.names, subject);
    documentation(xml, "Comment", device.documentation.as_deref(), subject);
    extras::urls(xml, settings);
    extras::info(xml, settings);
    let group = Some(settings.group.to_string()).filter(|group| !group.is_empty() || context.is_esi);
    let group = context.missing.require(context.options.group().or(group), "group");
    xml.leaf("GroupType", group);
    dictionary(xml, context, device, |xml, context, types| {
        sync::write(xml, context, device, settings);
        let is_on_ethercat = |pdo: &&Pdo| pdo.buses.is_none_or(|buses| buses.coe || device.ethercat.is_none());
        let mut pdos: Vec<&Pdo> = device.process_data.pdos.iter().filter(is_on_ethercat).collect();
        // ETG.2000 requires all RxPdos before the TxPdos. The export of an ESI keeps the order of its source.
        if !context.is_esi {
            pdos.sort_by_key(|pdo| pdo.direction == Direction::Transmit);
        }
        for pdo in pdos {
            pdo::write(xml, types, pdo, device.ethercat.is_some());
        }
    });
    mailbox::write(xml, context, settings.mailbox.as_deref());
    if let Some(clocks) = &settings.clocks {
        clocks::write(xml, clocks);
    }
    slots::write(xml, device, settings);
    eeprom::registers(xml, settings);
    eeprom::write(xml, context, settings);
    if let Some((element, file)) = &settings.picture {
        xml.leaf(element.to_string(), file);
    }
    xml.close();
    losses::of_device(context, device, &mut xml.notes);
}

/// Writes the Profile elements with the dictionary and the diagnosis messages, or only the dictionary if the file
/// describes no device. Then calls `after` with the data types of the dictionary.
pub(super) fn dictionary(
    xml: &mut Xml,
    context: &mut Context<'_>,
    device: &Device,
    after: impl FnOnce(&mut Xml, &mut Context<'_>, &Types<'_>),
) {
    let of_registers = objects::of_registers(device, &mut xml.notes);
    let objects = objects::of_device(device, &of_registers, &mut xml.notes);
    let mut types = Types::new(&device.types, context.is_esi, &mut xml.notes);
    if device.dictionary_only {
        dictionary::write(xml, context, &mut types, &objects);
    } else {
        profiles(xml, context, device, |xml, context| {
            dictionary::write(xml, context, &mut types, &objects);
            diagnosis::write(xml, &device.code_tables);
        });
    }
    after(xml, context, &types);
}

/// Writes a Profile element for each profile number. Calls `first` within the first element. A device without a profile
/// number gets one element if it has objects, types or code tables.
fn profiles(xml: &mut Xml, context: &mut Context<'_>, device: &Device, first: impl FnOnce(&mut Xml, &mut Context<'_>)) {
    let has_more = !device.groups.is_empty() || !device.types.is_empty() || !device.code_tables.is_empty();
    if device.profiles.is_empty() && !has_more {
        return;
    }
    let (number, others) = match device.profiles.split_first() {
        Some((number, others)) => (Some(number), others),
        None => (None, [].as_slice()),
    };
    xml.open("Profile");
    xml.optional_leaf("ProfileNo", number);
    first(xml, context);
    xml.close();
    for number in others {
        xml.leaves("Profile", &[("ProfileNo", &number)]);
    }
}

fn physics(xml: &mut Xml, context: &mut Context<'_>, settings: &EtherCatSettings) {
    let is_known = |ports: &str| ports.len() <= 4 && ports.bytes().all(|port| b"YKH ,".contains(&port));
    let ports = settings.physics.to_string();
    let ports = Some(ports).filter(|ports| context.is_esi || !ports.is_empty());
    let ports = context.missing.require(context.options.physics().or(ports), "physics");
    xml.notes.add_many(NoteKind::Spelling, !is_known(&ports), Subject::Named("Physics"));
    xml.attribute("Physics", if is_known(&ports) { &ports } else { "" });
}

fn device_type(xml: &mut Xml, context: &mut Context<'_>, device: &Device, settings: &EtherCatSettings) {
    let (identity, options) = (&device.identity, context.options);
    let product = options.product_code().or(identity.product_code);
    let revision = options.revision().or(identity.revision_number);
    xml.open("Type");
    // Both numbers are required, because a master identifies the device by them.
    if !context.is_esi {
        context.missing.require(product, "product-code");
        context.missing.require(revision, "revision");
    }
    xml.optional("ProductCode", product.map(|code| hex(code, 8)));
    xml.optional("RevisionNo", revision.map(|number| hex(number, 8)));
    xml.optional("SerialNo", identity.serial_number.map(|number| hex(number, 8)));
    extras::of_type(xml, settings);
    let named = [&identity.order_code, &device.name].into_iter().find(|name| !name.is_empty());
    let order_code = if context.is_esi { Some(&identity.order_code) } else { named };
    let order_code =
        context.missing.require(options.order_code().or(order_code.map(CompactString::to_string)), "order-code");
    xml.content(order_code);
    xml.close();
}
