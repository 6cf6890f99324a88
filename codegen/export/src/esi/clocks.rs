//! Writes the distributed clocks.

use super::text::hex;
use crate::note::{NoteKind, Notes, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{ClockMode, ClockSyncManager, ClockTime, DistributedClocks};

/// Attributes of the Dc element that the IR stores unchanged.
const ATTRIBUTES: [&str; 5] =
    ["UnknownFRMW", "Unknown64Bit", "ExternalRefClock", "PotentialReferenceClock", "TimeLoopControlOnly"];

/// Writes the Dc element.
pub(super) fn write(xml: &mut Xml, notes: &mut Notes, clocks: &DistributedClocks) {
    xml.open("Dc");
    for (name, value) in &clocks.attributes {
        match ATTRIBUTES.contains(&name.as_str()) {
            true => xml.attribute(name, value),
            false => notes.add(NoteKind::Extension, Subject::Named("Dc")),
        }
    }
    clocks.modes.iter().for_each(|each| mode(xml, each));
    xml.close();
}

fn mode(xml: &mut Xml, mode: &ClockMode) {
    xml.open("OpMode");
    xml.leaf("Name", &mode.name);
    xml.text_leaf("Desc", &mode.description);
    xml.leaf("AssignActivate", hex(mode.assign_activate, 4));
    time(xml, "CycleTimeSync0", mode.cycle_sync0);
    time(xml, "ShiftTimeSync0", mode.shift_sync0);
    time(xml, "CycleTimeSync1", mode.cycle_sync1);
    time(xml, "ShiftTimeSync1", mode.shift_sync1);
    mode.sync_managers.iter().for_each(|manager| sync_manager(xml, manager));
    xml.close();
}

/// Writes a clock time unless it equals the default.
fn time(xml: &mut Xml, element: &'static str, time: ClockTime) {
    if time == ClockTime::default() {
        return;
    }
    xml.open(element);
    xml.optional("Factor", time.factor);
    xml.flag("Input", time.input && element.starts_with("Shift"), "true");
    xml.content(time.nanoseconds);
    xml.close();
}

fn sync_manager(xml: &mut Xml, manager: &ClockSyncManager) {
    xml.open("Sm");
    xml.attribute("No", manager.number);
    xml.optional_leaf("SyncType", manager.sync_type);
    for (index, factor) in &manager.pdos {
        xml.open("Pdo");
        xml.optional("OSFac", *factor);
        xml.content(hex(*index, 4));
        xml.close();
    }
    xml.close();
}
