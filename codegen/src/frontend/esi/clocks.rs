//! Distributed clocks.

use super::reader::{has_attributes, note, Read, Reader};
use crate::ir::{ClockMode, ClockSyncManager, ClockTime, DistributedClocks, Extensions};
use crate::syntax::xml::Tag;

/// Reads Dc.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<DistributedClocks> {
    let mut clocks = DistributedClocks::default();
    if has_attributes(parent) {
        for attribute in parent.attributes() {
            let attribute = attribute?;
            if !attribute.is_namespace() {
                let value = attribute.value(reader.diagnostics).into();
                clocks.attributes.push((attribute.name.into(), value));
            }
        }
    }
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "OpMode" => clocks.modes.push(mode(reader, &tag, extensions)?),
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(clocks)
}

fn mode<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<ClockMode> {
    let mut mode = ClockMode::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Name" => mode.name = reader.leaf(&tag, extensions)?.compact(),
            "Desc" => mode.description = reader.leaf(&tag, extensions)?.compact(),
            "AssignActivate" => {
                mode.assign_activate = reader.number(&tag, "value of a register", extensions)?.unwrap_or(0);
            }
            "CycleTimeSync0" => mode.cycle_sync0 = time(reader, &tag, extensions)?,
            "ShiftTimeSync0" => mode.shift_sync0 = time(reader, &tag, extensions)?,
            "CycleTimeSync1" => mode.cycle_sync1 = time(reader, &tag, extensions)?,
            "ShiftTimeSync1" => mode.shift_sync1 = time(reader, &tag, extensions)?,
            "Sm" => mode.sync_managers.push(sync_manager(reader, &tag, extensions)?),
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(mode)
}

fn time<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<ClockTime> {
    let fields = reader.fields(tag, &["Factor", "Input", "OutputDelayTime", "InputDelayTime"], extensions)?;
    let [factor, input, output_delay, input_delay] = &fields;
    note("OutputDelayTime", output_delay, extensions);
    note("InputDelayTime", input_delay, extensions);
    let (factor, input) = (reader.int(factor, "factor"), reader.flag(input));
    let given = reader.content(extensions)?;
    Ok(ClockTime { nanoseconds: reader.int(&given, "time in nanoseconds").unwrap_or(0), factor, input })
}

fn sync_manager<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<ClockSyncManager> {
    let [number] = reader.fields(parent, &["No"], extensions)?;
    let number = reader.int(&number, "number of a sync manager").unwrap_or(0);
    let mut manager = ClockSyncManager { number, ..ClockSyncManager::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "SyncType" => manager.sync_type = reader.number(&tag, "synchronisation type", extensions)?,
            "Pdo" => {
                let [factor] = reader.fields(&tag, &["OSFac"], extensions)?;
                let factor = reader.int(&factor, "oversampling factor");
                let given = reader.content(extensions)?;
                manager.pdos.extend(reader.int(&given, "index").map(|index| (index, factor)));
            }
            "CycleTime" | "ShiftTime" => reader.keep(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(manager)
}
