//! Reads the module interfaces of modular devices (CiA 311, module management).
//!
//! Manufacturers describe modules in separate files, which are read as devices.

use super::reader::{Reader, Texts};
use crate::frontend::xml::Read;
use crate::ir::{Device, Fit, Slot};
use crate::syntax::xml::Tag;

/// Reads a `DeviceManager` element. The module interfaces become slots, and other elements become extensions.
pub(super) fn device_manager<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "moduleManagement" | "moduleInterfaceList" => device_manager(reader, &tag, device)?,
            "interface" => interface(reader, &tag, device)?,
            _ => reader.keep(&tag)?,
        }
    }
    Ok(())
}

fn interface<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
    const NAMES: [&str; 6] =
        ["uniqueID", "maxChilds", "unusedSlots", "multipleChilds", "identityIDRef", "moduleAddressing"];
    let fields = reader.attributes(parent, NAMES)?;
    let [id, max, rest @ ..] = &fields;
    let max = reader.unsigned(max, 0xFFFF, "number of modules").map_or(0, |max| max as u16);
    let number = u16::try_from(device.slots.len() + 1).unwrap_or(u16::MAX);
    let mut slot = Slot { number, instances: (0, max), ..Slot::default() };
    for (name, given) in NAMES.iter().skip(2).zip(rest) {
        reader.note(&format!("interface@{name}"), given);
    }
    let mut texts = Texts::default();
    while let Some(tag) = reader.child(parent)? {
        if tag.name != "moduleTypeList" {
            reader.text_or_keep(&tag, &mut texts)?;
            continue;
        }
        while let Some(kind) = reader.child(&tag)? {
            let [name] = reader.attributes(&kind, ["type"])?;
            slot.fits.extend(name.non_empty().map(|name| Fit::Name(name.compact())));
        }
    }
    slot.name = texts.labels.name();
    if slot.name.is_empty() {
        slot.name = id.compact();
    }
    device.slots.push(slot);
    Ok(())
}
