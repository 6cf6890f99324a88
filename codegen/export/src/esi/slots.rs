//! Writes the slots of a modular device.

use super::text::{hex, names};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Device, EtherCatSettings, Fit, Slot, SlotRules};

/// Writes the Slots element. If the source has no slot settings for EtherCAT, only adds a note that counts the slots.
pub(super) fn write(xml: &mut Xml, device: &Device, settings: &EtherCatSettings) {
    let Some(rules) = settings.slots.as_deref() else {
        return xml.notes.add_many(NoteKind::Slot, device.slots.len(), Subject::Named(&device.name));
    };
    xml.open("Slots");
    attributes(xml, rules);
    for each in &device.slots {
        slot(xml, each, rules);
    }
    for (number, name) in &rules.groups {
        xml.open("SlotGroupData");
        xml.attribute("SlotGroup", number);
        xml.text_leaf("Name", name);
        xml.close();
    }
    for group in &rules.pdo_groups {
        xml.open("ModulePdoGroup");
        xml.unless("Alignment", group.alignment, 0);
        xml.optional("RxPdo", group.rx_pdo.map(|index| hex(index, 4)));
        xml.optional("TxPdo", group.tx_pdo.map(|index| hex(index, 4)));
        xml.close();
    }
    for (name, idents) in &rules.selections {
        xml.open("SlotSelections");
        xml.leaf("Name", name);
        idents.iter().for_each(|ident| xml.leaf("ModuleIdent", hex(*ident, 8)));
        xml.close();
    }
    xml.close();
}

fn attributes(xml: &mut Xml, rules: &SlotRules) {
    xml.flag("DownloadModuleIdentList", rules.download_idents, "true");
    xml.flag("DownloadModuleAddressList", rules.download_addresses, "true");
    match rules.download_transition.as_str() {
        "PS" | "" => {}
        transition @ ("IP" | "SO") => xml.attribute("DownloadModuleListTransition", transition),
        _ => xml.notes.add(NoteKind::Spelling, Subject::Named("DownloadModuleListTransition")),
    }
    xml.optional("MaxSlotCount", rules.max_slots);
    xml.optional("MaxSlotGroupCount", rules.max_groups);
    let increments = [
        ("SlotPdoIncrement", rules.pdo_increment),
        ("SlotGroupPdoIncrement", rules.group_pdo_increment),
        ("SlotIndexIncrement", rules.index_increment),
        ("SlotGroupIndexIncrement", rules.group_index_increment),
    ];
    for (name, increment) in increments {
        xml.optional(name, (increment != 0).then(|| hex(increment, 1)));
    }
}

fn slot(xml: &mut Xml, slot: &Slot, rules: &SlotRules) {
    let subject = Subject::Named(&slot.name);
    xml.open("Slot");
    xml.optional("SlotGroup", slot.group);
    xml.attribute("MinInstances", slot.instances.0);
    xml.attribute("MaxInstances", slot.instances.1);
    let increments = [
        ("SlotPdoIncrement", slot.pdo_increment, rules.pdo_increment),
        ("SlotGroupPdoIncrement", slot.group_pdo_increment, rules.group_pdo_increment),
        ("SlotIndexIncrement", slot.index_increment, rules.index_increment),
        ("SlotGroupIndexIncrement", slot.group_index_increment, rules.group_index_increment),
    ];
    for (name, value, usual) in increments {
        xml.optional(name, (value != usual).then(|| hex(value, 1)));
    }
    if let Some(Fit::Ident(ident)) = slot.default {
        xml.attribute("Default", hex(ident, 8));
    }
    if !slot.name.is_empty() || !slot.names.is_empty() {
        names(xml, "Name", &slot.name, &slot.names, subject);
    }
    fits(xml, slot);
    xml.close();
}

/// Writes references to the modules that fit a slot: by ident, or by class if there are no idents. Adds a note for each
/// other reference.
fn fits(xml: &mut Xml, slot: &Slot) {
    let by_ident = slot.fits.iter().any(|fit| matches!(fit, Fit::Ident(_)));
    for fit in &slot.fits {
        match fit {
            Fit::Ident(ident) => xml.leaf("ModuleIdent", hex(*ident, 8)),
            Fit::Class(class) if !by_ident => {
                xml.leaves("ModuleClass", &[("Class", &class)]);
            }
            Fit::Class(_) | Fit::Name(_) => xml.notes.add(NoteKind::Slot, Subject::Named(&slot.name)),
        }
    }
}
