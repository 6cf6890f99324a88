//! Random process data: PDOs, sync managers and process images.

use lexibus_codegen::ir::{
    CompactString, Direction, Group, ObjectBuses, Oversampling, Pdo, PdoCommunication, PdoEntry, PdoEntryKind,
    ProcessData, ProcessImage, SyncManager, SyncManagerPurpose, TypeDef, Value,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::items::BOTH;
use super::names;
use super::types;

const DIRECTIONS: [Direction; 2] = [Direction::Receive, Direction::Transmit];

/// Returns process data for these objects and types.
pub fn data(b: &mut Bytes<'_>, groups: &[Group], types: &[TypeDef], is_ethercat: bool) -> ProcessData {
    let mut pdos = Vec::new();
    for direction in DIRECTIONS {
        let first = if direction == Direction::Receive { 0x1600 } else { 0x1A00 };
        let mut numbers = b.list(3, |b| b.within(0..=9));
        numbers.sort_unstable();
        numbers.dedup();
        pdos.extend(numbers.into_iter().map(|number| pdo(b, groups, types, direction, first + number, is_ethercat)));
    }
    ProcessData { pdos, sync_managers: if is_ethercat { sync_managers(b) } else { Vec::new() }, images: Vec::new() }
}

fn pdo(
    b: &mut Bytes<'_>,
    groups: &[Group],
    types: &[TypeDef],
    direction: Direction,
    index: u16,
    is_ethercat: bool,
) -> Pdo {
    const BUSES: [ObjectBuses; 3] = [BOTH, ObjectBuses::CANOPEN, ObjectBuses::COE];
    let mut entries: Vec<PdoEntry> = b.list(6, |b| entry(b, groups, types));
    let mut offset = 0_u32;
    for entry in &mut entries {
        entry.bit_offset = offset;
        offset = offset.saturating_add(entry.bits);
    }
    let pdo = Pdo::new(direction, index);
    Pdo {
        name: names::name(b),
        // CANopen PDO numbers start at 1.
        number: if is_ethercat { pdo.number } else { pdo.number + 1 },
        communication: b.maybe(2, |b| communication(b, index)),
        entries,
        fixed: b.any(),
        mandatory: b.any(),
        sync_manager: if is_ethercat { b.maybe(2, |b| b.within(0..=4)) } else { None },
        excludes: b.few(4, 2, |b| b.within(0x1600..=0x1603)),
        excluded_sync_managers: b.few(8, 1, |b| b.within(0..=4)),
        sync_unit: b.maybe(8, |b| b.within(0..=2)),
        depends_on_slot: b.one_in(8),
        depends_on_slot_group: b.one_in(8),
        is_virtual: b.one_in(8),
        overwritten_by_module: b.one_in(8),
        oversampling: b.maybe(8, |b| {
            let [factor, min, max, index_increment] = [0; 4].map(|_| b.maybe(2, |b| b.within(0..=9)));
            Box::new(Oversampling { factor, min, max, index_increment })
        }),
        order: b.maybe(8, Bytes::any),
        sra_parameter: b.maybe(8, Bytes::any),
        names: names::texts(b),
        max_bytes: b.maybe(8, |b| b.within(0..=16)),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        extensions: names::extensions(b),
        buses: b.maybe(6, |b| b.pick(&BUSES)),
        implicit: b.one_in(12),
        ..pdo
    }
}

fn communication(b: &mut Bytes<'_>, mapping: u16) -> PdoCommunication {
    let cob_ids =
        [Value::NodeId(0x200), Value::Int(0x8000_0181), Value::NodeId(-5), Value::Int(1 << 40), Value::Raw("x".into())];
    PdoCommunication {
        index: mapping - 0x200,
        cob_id: b.maybe(2, |b| b.pick(&cob_ids)),
        transmission_type: b.any(),
        inhibit_time: b.any(),
        event_timer: b.any(),
        sync_start: b.any(),
        writable: b.list(5, |b| b.within(0..=6)),
    }
}

/// Returns a PDO entry for an existing or missing object, or padding.
fn entry(b: &mut Bytes<'_>, groups: &[Group], types: &[TypeDef]) -> PdoEntry {
    let objects: Vec<&Group> =
        groups.iter().filter(|group| group.index().is_some() && !group.items.is_empty()).collect();
    let mut entry = match b.within(0..=7) {
        0..=4 if !objects.is_empty() => {
            let object = b.pick(&objects);
            let item = b.pick(&object.items);
            let (index, sub) = item.object().unwrap_or_default();
            let bits = types::base(types, item.ty).bits().unwrap_or(16);
            PdoEntry { kind: PdoEntryKind::Item, name: item.name, ty: item.ty, ..PdoEntry::new(index, sub, bits) }
        }
        5 => PdoEntry { kind: PdoEntryKind::Padding, ..PdoEntry::new(0, 0, b.within(1..=16)) },
        6 => {
            let ty = types::any(b, types.len());
            let bits = b.pick(&[1, 8, 16, 32, 64, 3, 100]);
            PdoEntry { kind: PdoEntryKind::Unnumbered, name: names::name(b), ty, ..PdoEntry::new(0, 0, bits) }
        }
        _ => PdoEntry::new(b.within(0x2000..=0x2020), b.within(0..=3), b.pick(&[1, 8, 16, 32, 64, 7, 80])),
    };
    if b.one_in(12) {
        entry.bits = b.pick(&[0, 1, 5, 8, 16, 33, 64, 65, 1000]);
    }
    entry.fixed = b.one_in(4);
    entry.depends_on_slot = b.one_in(8);
    entry.depends_on_slot_group = b.one_in(8);
    entry.names = names::texts(b);
    entry
}

fn sync_managers(b: &mut Bytes<'_>) -> Vec<SyncManager> {
    let purposes = [
        SyncManagerPurpose::MailboxOut,
        SyncManagerPurpose::MailboxIn,
        SyncManagerPurpose::Outputs,
        SyncManagerPurpose::Inputs,
    ];
    let count = b.within(0..=5);
    (0..count)
        .map(|number| {
            let purpose = if b.one_in(6) { b.pick(&purposes) } else { purposes[usize::from(number) % 4] };
            SyncManager {
                number,
                purpose,
                label: purpose.label().into(),
                start_address: b.any(),
                default_size: b.maybe(2, |b| b.within(0..=128)),
                size_range: (b.maybe(4, |b| b.within(0..=9)), b.maybe(4, |b| b.within(9..=200))),
                control: b.any(),
                enable: b.any(),
                op_only: b.one_in(6),
                is_virtual: b.one_in(6),
                origin: Origin::default(),
            }
        })
        .collect()
}

/// Returns a process image with this name. The fields are usually contiguous and within the image.
pub fn image(b: &mut Bytes<'_>, name: CompactString, types: &[TypeDef], least: u32) -> ProcessImage {
    let mut next = 0;
    let fields = b.list(9, |b| {
        let ty = types::any(b, types.len());
        let bits = types::base(types, ty).bits().filter(|_| !b.one_in(6)).unwrap_or_else(|| b.within(0..=70));
        let padding = if bits.is_multiple_of(8) { u32::next_multiple_of(next, 8) - next } else { 0 };
        let bit_offset = if b.one_in(12) { b.within(0..=100) } else { next + padding };
        next = bit_offset.saturating_add(bits);
        let kind = if b.one_in(8) { PdoEntryKind::Padding } else { PdoEntryKind::Item };
        let (name, names) = (names::name(b), names::texts(b));
        PdoEntry { bit_offset, kind, name, names, ty, ..PdoEntry::new(0, 0, bits) }
    });
    let length = if b.one_in(8) { b.within(least..=40) } else { next.div_ceil(8).max(least) };
    ProcessImage {
        name,
        direction: b.pick(&DIRECTIONS),
        length,
        overhead: b.pick(&[0, 0, 0, 4, 5]),
        big_endian: b.any(),
        fields,
        doubts: names::doubts(b),
    }
}
