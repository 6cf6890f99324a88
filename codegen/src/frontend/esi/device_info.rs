//! Reads the `Info` element of a device: timeouts, ports, electrical data.

use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::{EtherCatSettings, SlaveController};
use crate::syntax::xml::Tag;

/// Reads the `Info` element of a device into `settings`.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "StateMachine" | "Mailbox" => timeouts(reader, &tag, settings)?,
            "Electrical" => electrical(reader, &tag, settings)?,
            "IdentificationAdo" => settings.identification_register = reader.number(&tag, "register address")?,
            "IdentificationReg134" => {
                let given = reader.text(&tag)?;
                settings.identification_in_al_status = reader.flag(&given);
            }
            "EtherCATController" => controller(reader, &tag, settings.controller.get_or_insert_default())?,
            "StationAliasSupported" => settings.station_alias = reader.flag_of(&tag)?,
            "Port" | "ExecutionUnit" | "DeviceFeature" => reader.keep(&tag)?,
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn controller<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, controller: &mut SlaveController) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        let number = match tag.name {
            "DpramSize" => &mut controller.memory_bytes,
            "SmCount" => &mut controller.sync_managers,
            "FmmuCount" => &mut controller.fmmus,
            _ => {
                reader.keep(&tag)?;
                continue;
            }
        };
        *number = reader.number(&tag, "number")?;
    }
    Ok(())
}

fn electrical<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "EBusCurrent" => settings.ebus_current = reader.number(&tag, "current in milliamperes")?,
            _ => reader.keep(&tag)?,
        }
    }
    Ok(())
}

/// Reads a `Behavior` element. Attributes that the IR has no field for become extensions.
fn behavior<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    const NAMES: [&str; 4] = ["StartToSafeopNoSync", "StartToInit", "StartToPreop", "StartToSafeop"];
    let [without_sync, others @ ..] = reader.attributes(parent, NAMES)?;
    settings.safe_op_without_sync = reader.flag(&without_sync);
    for (name, given) in NAMES[1..].iter().zip(&others) {
        reader.note(&format!("StateMachine/Behavior@{name}"), given);
    }
    while let Some(tag) = reader.child(parent)? {
        reader.keep(&tag)?;
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
            "Behavior" => behavior(reader, &tag, settings)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}
