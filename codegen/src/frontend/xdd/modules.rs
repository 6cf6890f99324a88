//! Modular devices: the interfaces into which modules are plugged (CiA 311, module management).
//!
//! The modules themselves have files of their own, which are read as devices.

use super::reader::{note, Read, Reader, Texts};
use crate::ir::{Device, Fit, Slot};
use crate::syntax::xml::Tag;

/// DeviceManager: its interfaces become slots, everything else extensions.
pub(super) fn device_manager<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "moduleManagement" | "moduleInterfaceList" => device_manager(reader, &tag, device)?,
            "interface" => interface(reader, &tag, device)?,
            _ => reader.keep(&tag, &mut device.extensions)?,
        }
    }
    Ok(())
}

fn interface<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    const NAMES: [&str; 6] =
        ["uniqueID", "maxChilds", "unusedSlots", "multipleChilds", "identityIDRef", "moduleAddressing"];
    let fields = reader.fields(parent, &NAMES, &mut device.extensions)?;
    let [id, max, rest @ ..] = &fields;
    let max = reader.unsigned(max.as_ref(), 0xFFFF, "number of modules").map_or(0, |max| max as u16);
    let number = u16::try_from(device.slots.len() + 1).unwrap_or(u16::MAX);
    let mut slot = Slot { number, instances: (0, max), ..Slot::default() };
    for (name, given) in NAMES.iter().skip(2).zip(rest) {
        note(&format!("interface@{name}"), given.as_ref(), &mut device.extensions);
    }
    let mut texts = Texts::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "moduleTypeList" {
            while let Some(kind) = reader.cursor.child(&tag)? {
                let [name] = reader.fields(&kind, &["type"], &mut device.extensions)?;
                slot.fits.extend(name.map(|given| Fit::Name(given.text.into())));
            }
        } else if !reader.texts(&tag, &mut texts)? {
            reader.keep(&tag, &mut device.extensions)?;
        }
    }
    slot.name = texts.label();
    if slot.name.is_empty() {
        slot.name = id.as_ref().map_or_else(Default::default, |id| id.text.as_ref().into());
    }
    device.slots.push(slot);
    Ok(())
}

/// The ranges of indices that modules take, of which the IR knows nothing.
pub(super) fn ranges<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
    reader.keep(tag, &mut device.extensions)
}
