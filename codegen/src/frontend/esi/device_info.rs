//! Reads the `Info` element of a device: timeouts, ports, electrical data.

use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::EtherCatSettings;
use crate::syntax::xml::Tag;

/// Reads the `Info` element of a device into `settings`.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "StateMachine" | "Mailbox" => timeouts(reader, &tag, settings)?,
            "Electrical"
            | "EtherCATController"
            | "Port"
            | "ExecutionUnit"
            | "StationAliasSupported"
            | "IdentificationAdo"
            | "IdentificationReg134"
            | "DeviceFeature" => reader.keep(&tag)?,
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn timeouts<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Timeout" => {
                while let Some(inner) = reader.child(&tag)? {
                    let limit = reader.number(&inner, "time in milliseconds")?;
                    settings.timeouts.extend(limit.map(|limit| (inner.name.into(), limit)));
                }
            }
            "Behavior" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}
