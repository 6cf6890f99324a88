//! Writes the distributed clocks.

use super::extras;
use super::text::hex;
use crate::xml::Xml;
use lexibus_codegen::ir::{ClockMode, ClockSyncManager, ClockTime, DistributedClocks};

/// Writes the Dc element.
pub(super) fn write(xml: &mut Xml, clocks: &DistributedClocks) {
    xml.open("Dc");
    extras::attributes(xml, "Dc", &clocks.attributes);
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
