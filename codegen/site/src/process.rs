//! Cyclic data (PDOs, process images and sync managers) with byte grids.

use std::collections::HashMap;

use super::anchor::Names;
use super::grid;
use super::words;
use lexibus_codegen::facts::cob_id::{self, CobId};
use lexibus_codegen::facts::{address, pdo, types};
use lexibus_codegen::ir::{
    Direction, ItemId, Manual, ObjectBuses, Pdo, PdoEntry, PdoEntryKind, ProcessData, ProcessImage, TypeDef, Value,
};
use lexibus_codegen::number::{self, hex16};

/// The process data of a device.
#[derive(Debug, Default)]
pub(super) struct ProcessPart {
    pub frames: Vec<Frame>,
    /// Data of the PDO builder as JSON, if a mapping can be changed.
    pub builder: Option<String>,
}

/// A PDO or process image, as a page shows it.
#[derive(Debug, Default)]
pub(super) struct Frame {
    pub anchor: String,
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<super::entry::Doubt>,
    /// Base of the COB-ID, including its flags, if the COB-ID is the sum of this base and the node-ID.
    pub cob_id_of_node: Option<u32>,
    pub rows: Vec<grid::Row>,
    pub entries: Vec<Entry>,
}

impl Frame {
    /// Returns whether at least one entry is an object. The data of PROFINET submodules are not objects.
    pub fn has_objects(&self) -> bool {
        self.entries.iter().any(|entry| !entry.object.is_empty())
    }

    /// Returns the entry in a cell of the byte grid, or `None` if the bits of the cell are unused.
    pub fn entry(&self, cell: &grid::Cell) -> Option<&Entry> {
        self.entries.get(cell.entry?)
    }
}

/// A row in the list of entries.
#[derive(Debug)]
pub(super) struct Entry {
    pub position: String,
    /// Address of the mapped object.
    pub object: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub ty: String,
    pub bits: u32,
    pub item: Option<ItemId>,
    /// File and anchor of the mapped item. Empty if no page shows the item.
    pub target: String,
}

/// A sync manager of an EtherCAT slave, as a page shows it.
#[derive(Debug)]
pub(super) struct SyncManager {
    pub number: u8,
    pub purpose: String,
    pub start: String,
    pub size: String,
}

/// Data that all PDOs of a device or module share.
#[derive(Clone, Copy)]
pub(super) struct About<'d> {
    /// Buses on which the objects of the device or module exist.
    pub buses: ObjectBuses,
    pub manual: &'d Manual,
}

/// Returns all cyclic data of a device or module.
pub(super) fn frames(data: &ProcessData, types: &[TypeDef], about: About<'_>) -> Vec<Frame> {
    let mut counts = HashMap::new();
    data.pdos.iter().for_each(|each| *counts.entry(each.mapping_index).or_insert(0) += 1);
    let pdos = data.pdos.iter().map(|each| {
        let frame = pdo(each, types, about);
        // PDOs on different buses can have the same index, so their anchors contain the bus.
        match each.buses.filter(|_| counts[&each.mapping_index] > 1) {
            Some(buses) if buses.coe => Frame { anchor: format!("{}.EtherCAT", frame.anchor), ..frame },
            Some(_) => Frame { anchor: format!("{}.CANopen", frame.anchor), ..frame },
            None => frame,
        }
    });
    let images = data.images.iter().map(|each| Frame {
        doubts: super::entry::doubts(&each.doubts, &each.name, about.manual),
        ..image(each, types, &format!("image-{}", each.name), "")
    });
    let mut names = Names::default();
    let once = |frame: Frame| Frame { anchor: names.anchor(&frame.anchor), ..frame };
    pdos.chain(images).map(once).collect()
}

pub(super) fn sync_managers(data: &ProcessData) -> Vec<SyncManager> {
    let one = |manager: &lexibus_codegen::ir::SyncManager| SyncManager {
        number: manager.number,
        purpose: manager.purpose.label().to_owned(),
        start: hex16(manager.start_address),
        size: manager.default_size.map(|size| size.to_string()).unwrap_or_default(),
    };
    data.sync_managers.iter().map(one).collect()
}

fn pdo(pdo: &Pdo, types: &[TypeDef], about: About<'_>) -> Frame {
    let name = if pdo.name.is_empty() { String::new() } else { format!(": {}", pdo.name) };
    let mut facts = words::PLAIN.description(pdo.documentation.as_deref());
    let index = hex16(pdo.mapping_index);
    let mapping = if pdo.mapping_index == 0 { String::new() } else { format!(", mapped by {index}") };
    facts.push(format!("{}{mapping}.", bytes(pdo.bytes())));
    let cob_id = pdo.communication.as_ref().and_then(|communication| communication.cob_id.as_ref());
    if let Some(communication) = &pdo.communication {
        let shown = |id| cob_id::text(id, CobId::of_pdo(pdo.direction)).unwrap_or_else(|| words::PLAIN.value(id));
        facts.extend(cob_id.map(|id| format!("COB-ID {}.", shown(id))));
        facts.extend(
            communication.transmission_type.map(|transmission_type| format!("Transmission type {transmission_type}.")),
        );
        facts.extend(communication.inhibit_time.map(|inhibit_time| format!("Inhibit time {inhibit_time} × 100 µs.")));
        facts.extend(communication.event_timer.map(|event_timer| format!("Event timer {event_timer} ms.")));
    }
    facts.extend(pdo.fixed.then(|| "The mapping cannot be changed.".to_owned()));
    facts.extend(pdo.mandatory.then(|| "The PDO must be assigned.".to_owned()));
    facts.extend(pdo.sync_manager.map(|number| format!("Assigned to sync manager {number} by default.")));
    if !pdo.excludes.is_empty() {
        let others: Vec<String> = pdo.excludes.iter().map(|index| hex16(*index)).collect();
        facts.push(format!("Cannot be assigned together with {}.", others.join(", ")));
    }
    Frame {
        cob_id_of_node: match cob_id {
            Some(Value::NodeId(offset)) => u32::try_from(*offset).ok(),
            _ => None,
        },
        anchor: index,
        title: pdo::title(pdo, about.buses) + &name,
        facts,
        doubts: super::entry::doubts(&pdo.doubts, "", about.manual),
        ..drawn(&pdo.entries, pdo.bits(), types)
    }
}

/// Converts a process image for a page. If `of` is not empty, the title is `of` and not the image's name.
pub(super) fn image(image: &ProcessImage, types: &[TypeDef], anchor: &str, of: &str) -> Frame {
    let direction = match image.direction {
        Direction::Receive => "to the device",
        Direction::Transmit => "from the device",
    };
    let mut facts = vec![format!("{} {direction}.", bytes(image.length as usize))];
    facts.extend(image.big_endian.then(|| "Numbers are big-endian.".to_owned()));
    facts.extend((image.overhead > 0).then(|| format!("{} further bytes are not user data.", image.overhead)));
    Frame {
        anchor: anchor.to_owned(),
        title: if of.is_empty() { format!("Image {}", image.name) } else { of.to_owned() },
        facts,
        ..drawn(&image.fields, image.length.saturating_mul(8), types)
    }
}

/// Returns a number of bytes as text: `1 byte`, `4 bytes`.
fn bytes(count: usize) -> String {
    format!("{count} {}", if count == 1 { "byte" } else { "bytes" })
}

/// Creates a frame that contains only the byte grid and the list of entries.
fn drawn(entries: &[PdoEntry], bits: u32, types: &[TypeDef]) -> Frame {
    let list = entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding).map(|entry| Entry {
        position: address::bits_of(entry.bit_offset, entry.bits),
        object: if entry.index == 0 { String::new() } else { number::object(entry.index, entry.sub_index) },
        name: entry.name.to_string(),
        names: words::names(&entry.name, &entry.names),
        ty: types::name(types, entry.ty),
        bits: entry.bits,
        item: entry.item,
        target: String::new(),
    });
    Frame { rows: grid::rows(entries, bits), entries: list.collect(), ..Frame::default() }
}
