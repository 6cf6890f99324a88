//! What Info says of a device: time limits, ports, electrical data.

use super::reader::{Read, Reader};
use crate::ir::{EtherCatSettings, Extensions};
use crate::syntax::xml::Tag;

/// Reads Info.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    settings: &mut EtherCatSettings,
    extensions: &mut Extensions,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "StateMachine" | "Mailbox" => timeouts(reader, &tag, settings, extensions)?,
            "Electrical"
            | "EtherCATController"
            | "Port"
            | "ExecutionUnit"
            | "StationAliasSupported"
            | "IdentificationAdo"
            | "IdentificationReg134"
            | "DeviceFeature" => reader.keep(&tag, extensions)?,
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}

fn timeouts<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    settings: &mut EtherCatSettings,
    extensions: &mut Extensions,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Timeout" => {
                while let Some(inner) = reader.cursor.child(&tag)? {
                    let limit = reader.number(&inner, "time in milliseconds", extensions)?;
                    settings.timeouts.extend(limit.map(|limit| (inner.name.into(), limit)));
                }
            }
            "Behavior" => reader.keep(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}
