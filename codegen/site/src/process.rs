//! Cyclic data: PDOs, process images and sync managers, with drawings byte by byte.

use super::anchor::Names;
use super::cell::Cell;
use super::words;
use lexibus_codegen::facts::cob_id::{self, CobId};
use lexibus_codegen::facts::number::hex16;
use lexibus_codegen::facts::{address, pdo, types};
use lexibus_codegen::ir::{
    Direction, Manual, ObjectBuses, Pdo, PdoEntry, PdoEntryKind, ProcessData, ProcessImage, SubjectKind, TypeDef,
};

/// Bytes in a row of a drawing, and the width of one.
const ROW: u32 = 8;
const CELL: u32 = 80;

/// Height of a row.
const HEIGHT: u32 = 40;

/// So many rows are drawn; what is behind them is in the list.
const MOST_ROWS: usize = 64;

/// What is exchanged together.
#[derive(Debug, Default)]
pub(super) struct Frame {
    pub anchor: String,
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<super::entry::Doubt>,
    pub rows: Vec<Row>,
    /// Height of the drawing.
    pub height: u32,
    pub entries: Vec<Entry>,
}

/// A row of the drawing: eight bytes.
#[derive(Debug)]
pub(super) struct Row {
    /// Number of its first byte.
    pub first: u32,
    pub top: u32,
    pub cells: Vec<Cell>,
}

/// A line of the list.
#[derive(Debug)]
pub(super) struct Entry {
    pub place: String,
    /// The object, and whether the device describes it.
    pub object: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub ty: String,
    pub bits: u32,
}

/// A sync manager of an EtherCAT slave.
#[derive(Debug)]
pub(super) struct SyncManager {
    pub number: u8,
    pub purpose: String,
    pub start: String,
    pub size: String,
}

/// What PDOs of a device or module have in common.
#[derive(Clone, Copy)]
pub(super) struct About<'d> {
    /// The buses that the objects are on.
    pub buses: ObjectBuses,
    pub manual: &'d Manual,
    /// The ambiguities of the device.
    pub doubts: &'d [lexibus_codegen::ir::Doubt],
}

/// All cyclic data of a device or module.
pub(super) fn frames(data: &ProcessData, types: &[TypeDef], about: About<'_>) -> Vec<Frame> {
    let pdos = data.pdos.iter().map(|own| pdo(own, types, about));
    let images = data.images.iter().enumerate().map(|(at, own)| Frame {
        doubts: super::entry::about(about.doubts, SubjectKind::Image, &own.name, about.manual),
        ..image(own, types, &format!("image-{at}"), "")
    });
    // PDOs of two buses may have one index.
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

fn pdo(own: &Pdo, types: &[TypeDef], about: About<'_>) -> Frame {
    let name = if own.name.is_empty() { String::new() } else { format!(": {}", own.name) };
    let mut facts = words::PLAIN.description(own.documentation.as_deref());
    let index = hex16(own.mapping_index);
    let mapping = if own.mapping_index == 0 { String::new() } else { format!(", mapped by {index}") };
    let bytes = own.bytes();
    facts.push(format!("{bytes} {}{mapping}.", if bytes == 1 { "byte" } else { "bytes" }));
    if let Some(communication) = &own.communication {
        let cob_id = |id| cob_id::text(id, CobId::of_pdo(own.direction)).unwrap_or_else(|| words::PLAIN.value(id));
        facts.extend(communication.cob_id.as_ref().map(|id| format!("COB-ID {}.", cob_id(id))));
        facts.extend(
            communication.transmission_type.map(|transmission_type| format!("Transmission type {transmission_type}.")),
        );
        facts.extend(communication.inhibit_time.map(|inhibit_time| format!("Inhibit time {inhibit_time} × 100 µs.")));
        facts.extend(communication.event_timer.map(|event_timer| format!("Event timer {event_timer} ms.")));
    }
    facts.extend(own.fixed.then(|| "Its mapping can't be changed.".to_owned()));
    facts.extend(own.mandatory.then(|| "It has to be assigned.".to_owned()));
    facts.extend(own.sync_manager.map(|number| format!("Assigned to sync manager {number} by default.")));
    if !own.excludes.is_empty() {
        let others: Vec<String> = own.excludes.iter().map(|index| hex16(*index)).collect();
        facts.push(format!("Can't be assigned together with {}.", others.join(", ")));
    }
    Frame {
        anchor: index,
        title: pdo::title(own, about.buses) + &name,
        facts,
        doubts: super::entry::doubts(&own.doubts, about.manual),
        ..drawn(&own.entries, own.bits(), types)
    }
}

/// An image whose title begins with `of`.
pub(super) fn image(own: &ProcessImage, types: &[TypeDef], anchor: &str, of: &str) -> Frame {
    let direction = match own.direction {
        Direction::Receive => "to the device",
        Direction::Transmit => "from the device",
    };
    let mut facts = vec![format!("{} bytes {direction}.", own.length)];
    facts.extend(own.big_endian.then(|| "Numbers are big-endian.".to_owned()));
    facts.extend((own.overhead > 0).then(|| format!("{} further bytes are no user data.", own.overhead)));
    Frame {
        anchor: anchor.to_owned(),
        title: if of.is_empty() { format!("Image {}", own.name) } else { of.to_owned() },
        facts,
        ..drawn(&own.fields, own.length.saturating_mul(8), types)
    }
}

/// A frame with nothing but what it carries.
fn drawn(entries: &[PdoEntry], bits: u32, types: &[TypeDef]) -> Frame {
    let bytes = bits.div_ceil(8);
    let rows: Vec<Row> = (0..bytes.div_ceil(ROW)).take(MOST_ROWS).map(|at| row(entries, at)).collect();
    let list = entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding).map(|own| Entry {
        place: address::bits_of(own.bit_offset, own.bits),
        object: if own.index == 0 { String::new() } else { address::object(own.index, own.sub_index) },
        name: own.name.to_string(),
        names: words::names(&own.names),
        ty: types::name(types, own.ty),
        bits: own.bits,
    });
    Frame { height: rows.len() as u32 * HEIGHT, rows, entries: list.collect(), ..Frame::default() }
}

fn row(entries: &[PdoEntry], number: u32) -> Row {
    let (first, last) = (number * ROW * 8, (number + 1) * ROW * 8);
    let cell = |entry: &PdoEntry| {
        let low = entry.bit_offset.max(first);
        let high = entry.bit_offset.saturating_add(entry.bits).min(last);
        let bits = high.checked_sub(low).filter(|bits| *bits > 0)?;
        let (left, width) = ((low - first) * CELL / 8, bits * CELL / 8);
        Some(match entry.kind {
            PdoEntryKind::Padding => Cell::padding(left, width),
            _ => Cell::new(left, width, &entry.name),
        })
    };
    Row { first: number * ROW, top: number * HEIGHT, cells: entries.iter().filter_map(cell).collect() }
}
