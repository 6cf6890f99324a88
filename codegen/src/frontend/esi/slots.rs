//! Reads the slots of a modular device.

use super::reader::{Names, Reader};
use crate::frontend::xml::{Given, Read};
use crate::ir::{CompactString, Extension, Fit, ModulePdoGroup, Slot, SlotRules};
use crate::syntax::xml::Tag;

/// Reads a `Slots` element. Slots are numbered from 0. A `Slot` element for several modules counts as several slots.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, slots: &mut Vec<Slot>) -> Read<SlotRules> {
    let mut rules = rules(reader, parent)?;
    let first = slots.len();
    // Increments are collected as options. A slot without an increment uses the increment of the `Slots` element.
    let mut slot_increments = Vec::new();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Slot" => {
                let (slot, increments) = slot(reader, &tag)?;
                slots.push(slot);
                slot_increments.push(increments);
            }
            "SlotGroupData" => group(reader, &tag, &mut rules)?,
            "ModulePdoGroup" => rules.pdo_groups.push(pdo_group(reader, &tag)?),
            "SlotSelections" => rules.selections.push(selection(reader, &tag)?),
            _ => reader.unknown(&tag)?,
        }
    }
    let mut number = slots.get(..first).and_then(<[Slot]>::last).map_or(0, after);
    for (slot, [index, pdo, group_index, group_pdo]) in slots.iter_mut().skip(first).zip(slot_increments) {
        slot.number = number;
        slot.index_increment = index.unwrap_or(rules.index_increment);
        slot.pdo_increment = pdo.unwrap_or(rules.pdo_increment);
        slot.group_index_increment = group_index.unwrap_or(rules.group_index_increment);
        slot.group_pdo_increment = group_pdo.unwrap_or(rules.group_pdo_increment);
        number = after(slot);
    }
    Ok(rules)
}

/// Returns the number of the slot after `slot`.
fn after(slot: &Slot) -> u16 {
    slot.number.saturating_add(slot.instances.1.max(1))
}

fn rules<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<SlotRules> {
    const NAMES: [&str; 10] = [
        "MaxSlotCount",
        "MaxSlotGroupCount",
        "SlotIndexIncrement",
        "SlotPdoIncrement",
        "SlotGroupIndexIncrement",
        "SlotGroupPdoIncrement",
        "DownloadModuleIdentList",
        "DownloadModuleAddressList",
        "DownloadModuleListTransition",
        "IdentifyModuleBy",
    ];
    let fields = reader.attributes(tag, NAMES)?;
    let [slots, groups, index, pdo, group_index, group_pdo, idents, addresses, transition, identify] = &fields;
    reader.note("IdentifyModuleBy", identify);
    let transition = if transition.is_empty() { CompactString::const_new("PS") } else { transition.compact() };
    Ok(SlotRules {
        max_slots: reader.int(slots, "number of slots"),
        max_groups: reader.int(groups, "number of slot groups"),
        index_increment: increment(reader, index).unwrap_or(0),
        pdo_increment: increment(reader, pdo).unwrap_or(0),
        group_index_increment: increment(reader, group_index).unwrap_or(0),
        group_pdo_increment: increment(reader, group_pdo).unwrap_or(0),
        download_idents: reader.flag(idents),
        download_addresses: reader.flag(addresses),
        download_transition: transition,
        ..SlotRules::default()
    })
}

fn increment(reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Option<u16> {
    reader.int(given, "index increment")
}

/// Increments that a slot declares: object index and PDO index per slot, then object index and PDO index per slot
/// group.
type Increments = [Option<u16>; 4];

fn slot<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Slot, Increments)> {
    const NAMES: [&str; 10] = [
        "MinInstances",
        "MaxInstances",
        "SlotGroup",
        "SlotIndexIncrement",
        "SlotPdoIncrement",
        "SlotGroupIndexIncrement",
        "SlotGroupPdoIncrement",
        "Default",
        "Fallback",
        "TreeView",
    ];
    let fields = reader.attributes(parent, NAMES)?;
    let [min, max, group, index, pdo, group_index, group_pdo, default, fallback, view] = &fields;
    reader.note("Slot@Fallback", fallback);
    reader.note("Slot@TreeView", view);
    let min = reader.int(min, "number of modules").unwrap_or(0);
    let mut slot = Slot {
        instances: (min, reader.int(max, "number of modules").unwrap_or(min.max(1))),
        group: reader.int(group, "slot group number"),
        default: reader.int(default, "module ident number").map(Fit::Ident),
        ..Slot::default()
    };
    let increments = [index, pdo, group_index, group_pdo].map(|given| increment(reader, given));
    let mut names = Names::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => reader.name(&tag, &mut names)?,
            "ModuleIdent" => module_ident(reader, &tag, &mut slot)?,
            "ModuleClass" => module_class(reader, &tag, &mut slot)?,
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    (slot.name, slot.names) = (names.name(), names.others());
    Ok((slot, increments))
}

fn module_ident<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, slot: &mut Slot) -> Read<()> {
    let [default] = reader.attributes(tag, ["Default"])?;
    let is_default = reader.int::<u32>(&default, "number").is_some_and(|value| value != 0);
    let given = reader.content()?;
    if let Some(ident) = reader.int(&given, "module ident number") {
        slot.fits.push(Fit::Ident(ident));
        if is_default {
            slot.default = Some(Fit::Ident(ident));
        }
    }
    Ok(())
}

fn module_class<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, slot: &mut Slot) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Class" => slot.fits.push(Fit::Class(reader.text(&tag)?.compact())),
            "VendorId" | "Name" => reader.keep(&tag)?,
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

fn group<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, rules: &mut SlotRules) -> Read<()> {
    let [number] = reader.attributes(parent, ["SlotGroup"])?;
    let number = reader.int(&number, "slot group number").unwrap_or(0);
    let mut names = Names::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => reader.name(&tag, &mut names)?,
            "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    let others = names.others();
    reader.extensions.extend(others.iter().map(|text| {
        let key = compact_str::format_compact!("SlotGroupData {number}/Name@{}", text.language);
        Extension { key, value: text.text.clone(), span: parent.span }
    }));
    rules.groups.push((number, names.name()));
    Ok(())
}

fn pdo_group<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<ModulePdoGroup> {
    let fields = reader.attributes(tag, ["Alignment", "RxPdo", "TxPdo"])?;
    let [alignment, receive, transmit] = &fields;
    let group = ModulePdoGroup {
        alignment: reader.int(alignment, "alignment in bytes").unwrap_or(0),
        rx_pdo: reader.int(receive, "index"),
        tx_pdo: reader.int(transmit, "index"),
    };
    let given = reader.content()?;
    reader.note("ModulePdoGroup", &given);
    Ok(group)
}

fn selection<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(CompactString, Vec<u32>)> {
    let (mut names, mut idents) = (Names::default(), Vec::new());
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => reader.name(&tag, &mut names)?,
            "ModuleIdent" => idents.extend(reader.number::<u32>(&tag, "module ident number")?),
            _ => reader.unknown(&tag)?,
        }
    }
    Ok((names.name(), idents))
}
