//! Reads the settings of distributed clocks.

use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::{ClockMode, ClockSyncManager, ClockTime, DistributedClocks};
use crate::syntax::xml::Tag;

/// Reads the `Dc` element of a device.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<DistributedClocks> {
    let mut clocks = DistributedClocks::default();
    reader.attributes_and_others(parent, [], &mut clocks.attributes)?;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "OpMode" => clocks.modes.push(mode(reader, &tag)?),
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(clocks)
}

fn mode<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<ClockMode> {
    let mut mode = ClockMode::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => mode.name = reader.text(&tag)?.compact(),
            "Desc" => mode.description = reader.text(&tag)?.compact(),
            "AssignActivate" => mode.assign_activate = reader.number(&tag, "register value")?.unwrap_or(0),
            "CycleTimeSync0" => mode.cycle_sync0 = time(reader, &tag)?,
            "ShiftTimeSync0" => mode.shift_sync0 = time(reader, &tag)?,
            "CycleTimeSync1" => mode.cycle_sync1 = time(reader, &tag)?,
            "ShiftTimeSync1" => mode.shift_sync1 = time(reader, &tag)?,
            "Sm" => mode.sync_managers.push(sync_manager(reader, &tag)?),
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(mode)
}

fn time<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<ClockTime> {
    let fields = reader.attributes(tag, ["Factor", "Input", "OutputDelayTime", "InputDelayTime"])?;
    let [factor, input, output_delay, input_delay] = &fields;
    reader.note("OutputDelayTime", output_delay);
    reader.note("InputDelayTime", input_delay);
    let (factor, input) = (reader.int(factor, "factor"), reader.flag(input));
    let given = reader.content()?;
    Ok(ClockTime { nanoseconds: reader.int(&given, "time in nanoseconds").unwrap_or(0), factor, input })
}

fn sync_manager<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<ClockSyncManager> {
    let [number] = reader.attributes(parent, ["No"])?;
    let number = reader.int(&number, "sync manager number").unwrap_or(0);
    let mut manager = ClockSyncManager { number, ..ClockSyncManager::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "SyncType" => manager.sync_type = reader.number(&tag, "synchronization type")?,
            "Pdo" => {
                let [factor] = reader.attributes(&tag, ["OSFac"])?;
                let factor = reader.int(&factor, "oversampling factor");
                let given = reader.content()?;
                manager.pdos.extend(reader.int(&given, "index").map(|index| (index, factor)));
            }
            "CycleTime" | "ShiftTime" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(manager)
}
