//! Reads the section `segment` of `network.toml`.

use super::declared::{DeclaredModule, DeclaredSegment, DeclaredSubDevice};
use crate::declared::ObjectName;
use crate::frontend::common::{named_object, numbered, parameters};
use crate::frontend::reader::{Reader, Table};
use crate::frontend::section::{keys, Form, Section};
use crate::syntax::{At, Content, Entry, Node};

/// The section `segment`.
pub(crate) static SECTION: Section = Section {
    name: "the section `segment`",
    keys: keys! {
        "cycle" Form::Integer(1, 4_000_000), "Cycle time in µs.";
        "subdevices" Form::Named(&SUBDEVICE), "SubDevices by name, in the order of their positions on the bus.";
    },
};

/// The section of a SubDevice.
pub(crate) static SUBDEVICE: Section = Section {
    name: "the section of a SubDevice",
    keys: keys! {
        "device" Form::Text, "Path of the device description (ESI or register table), relative to the network file.";
        "model" Form::Text, "Name, order code or product code of the device, if the description contains several devices.";
        "overlays" Form::Texts, "Paths of overlays, relative to the network file.";
        "revision_number" Form::Integer(0, 0xFFFF_FFFF), "Expected revision number, instead of that of the description.";
        "alias" Form::Integer(0, 0xFFFF), "Station alias; 0 = none.";
        "modules" Form::ValuesOr(&MODULE), "Modules of a modular device: slot number, counted from 0 = module ident or name, or a table with the module and the values of its objects. By default, the default modules of the description.";
        "pdos" Form::Objects, "Assigned PDOs of the SubDevice itself, by index (`0x1600`) or name. By default, the PDOs that the description assigns.";
        "dc" Form::Text, "Name of the mode of the distributed clocks. By default, the first mode of the description.";
        "parameters" Form::Values, "Values of objects, which are written after the PDO assignment. Keys and values are those of a node's `parameters`.";
    },
};

/// The table of a module in a slot.
pub(crate) static MODULE: Section = Section {
    name: "the table of a module",
    keys: keys! {
        "module" Form::IntegerOrText, "Ident, type or name of the module.";
        "parameters" Form::Values, "Values of objects of the module, which are written after those of the SubDevice. The key is a name, or the address in the slot.";
    },
};

/// Reads the section `segment`.
pub(crate) fn read(reader: &mut Reader<'_>, node: &Node) -> DeclaredSegment {
    let table = reader.table(node, &SECTION);
    let cycle = reader.integer(table, "cycle");
    let entries = table.get("subdevices").map_or(&[][..], |node| reader.entries(node, "name of the SubDevice = table"));
    let subdevices = entries.iter().filter_map(|entry| subdevice(reader, entry)).collect();
    DeclaredSegment { span: node.span, cycle, subdevices }
}

/// Reads a SubDevice. Returns `None` if it is not a table.
fn subdevice(reader: &mut Reader<'_>, entry: &Entry) -> Option<DeclaredSubDevice> {
    let table = reader.table(&entry.value, &SUBDEVICE);
    if !matches!(entry.value.content, Content::Table(_)) {
        return None;
    }
    Some(DeclaredSubDevice {
        name: entry.key.clone(),
        device: reader.text(table, "device"),
        model: reader.text(table, "model"),
        overlays: reader.texts(table, "overlays"),
        revision_number: reader.integer(table, "revision_number").map(|number| number.value),
        alias: reader.integer(table, "alias"),
        modules: modules(reader, table),
        pdos: pdos(reader, table),
        clock_mode: reader.text(table, "dc"),
        parameters: parameters(reader, table),
    })
}

fn modules(reader: &mut Reader<'_>, table: Table<'_>) -> Option<At<Vec<DeclaredModule>>> {
    let node = table.get("modules")?;
    let entries = reader.entries(node, "slot = module");
    Some(At::new(entries.iter().filter_map(|entry| module(reader, entry)).collect(), node.span))
}

fn module(reader: &mut Reader<'_>, entry: &Entry) -> Option<DeclaredModule> {
    let slot = At::new(numbered(reader, entry, "a slot", 0..=254)?, entry.key.span);
    if !matches!(entry.value.content, Content::Table(_)) {
        return Some(DeclaredModule { slot, module: reader.scalar(&entry.value)?, parameters: Vec::new() });
    }
    let table = reader.table(&entry.value, &MODULE);
    let Some(module) = table.get("module") else {
        reader.missing(table, "module");
        return None;
    };
    Some(DeclaredModule { slot, module: reader.scalar(module)?, parameters: parameters(reader, table) })
}

fn pdos(reader: &mut Reader<'_>, table: Table<'_>) -> Option<At<Vec<At<ObjectName>>>> {
    let node = table.get("pdos")?;
    let list = reader.list(node).iter();
    Some(At::new(list.filter_map(|pdo| named_object(reader, pdo)).collect(), node.span))
}
