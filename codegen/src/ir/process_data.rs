//! What is exchanged cyclically, with exact bit positions.

use std::collections::HashMap;

use super::{CompactString, Documentation, Doubts, Extensions, ItemId, ObjectBuses, Texts, Type, Value};
use crate::source::Origin;

/// Cyclic data of a device or a module.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProcessData {
    /// PDOs, RPDOs first, each by number.
    pub pdos: Vec<Pdo>,
    /// Sync managers of an EtherCAT slave, by number.
    pub sync_managers: Vec<SyncManager>,
    /// Other images with a fixed layout, such as the data of a PROFINET submodule.
    pub images: Vec<ProcessImage>,
}

/// How many sub-indices an object has for the entries of a mapping, or the PDOs of an assignment, beside sub-index 0
/// (ETG.1000.6 5.6.7.4).
pub const MAX_PDO_SUBS: usize = 254;

impl ProcessData {
    /// The PDOs that are assigned by default, each with its sync manager: outputs first, in the order of the source. Of
    /// PDOs that exclude each other, and of those of one index, the first one counts (ETG.2000, Sm of RxPdo and TxPdo).
    pub fn assigned_by_default(&self) -> Vec<(&Pdo, u8)> {
        self.default_assignment().assigned
    }

    /// The same, with what is left out for it.
    pub(crate) fn default_assignment(&self) -> DefaultAssignment<'_> {
        let mut all = DefaultAssignment::default();
        for direction in [Direction::Receive, Direction::Transmit] {
            for pdo in self.pdos.iter().filter(|pdo| pdo.direction == direction && !pdo.is_virtual) {
                let Some(number) = pdo.sync_manager.filter(|&number| self.has_sync_manager(number)) else { continue };
                match all.conflict(pdo) {
                    Some(other) => all.left_out.push((pdo, other)),
                    None => all.assign(pdo, number),
                }
            }
        }
        all
    }

    /// Whether there is a sync manager with this number. Some descriptions have no list of them at all.
    pub fn has_sync_manager(&self, number: u8) -> bool {
        self.sync_managers.is_empty() || self.sync_managers.iter().any(|own| own.number == number)
    }
}

/// Which PDOs are assigned by default, looked up by index: a file may have as many as there are indices.
#[derive(Debug, Default)]
pub(crate) struct DefaultAssignment<'a> {
    /// Each with its sync manager.
    pub assigned: Vec<(&'a Pdo, u8)>,
    /// Each with the first one that it conflicts with.
    pub left_out: Vec<(&'a Pdo, &'a Pdo)>,
    /// Places in `assigned` by mapping index: several where they are on different buses.
    by_index: HashMap<u16, Vec<usize>>,
    /// The first place in `assigned` that excludes an index.
    excluded: HashMap<u16, usize>,
}

impl<'a> DefaultAssignment<'a> {
    /// The first one for which [`Pdo::conflicts_with`] is true.
    fn conflict(&self, pdo: &Pdo) -> Option<&'a Pdo> {
        let of_index = |index: &u16| self.by_index.get(index).into_iter().flatten().copied();
        let twin = of_index(&pdo.mapping_index).find(|&at| !self.assigned[at].0.is_apart(pdo));
        let by_others = self.excluded.get(&pdo.mapping_index).copied();
        let by_itself = pdo.excludes.iter().filter_map(|index| of_index(index).next()).min();
        [twin, by_others, by_itself].into_iter().flatten().min().map(|at| self.assigned[at].0)
    }

    fn assign(&mut self, pdo: &'a Pdo, sync_manager: u8) {
        let at = self.assigned.len();
        self.by_index.entry(pdo.mapping_index).or_default().push(at);
        for &index in &pdo.excludes {
            self.excluded.entry(index).or_insert(at);
        }
        self.assigned.push((pdo, sync_manager));
    }
}

/// Direction of cyclic data, seen from the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Direction {
    /// Received by the device: outputs of the controller, RPDO.
    Receive,
    /// Sent by the device: inputs of the controller, TPDO.
    Transmit,
}

/// One process data object.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pdo {
    /// Direction.
    pub direction: Direction,
    /// Number, counted from 1 (CANopen) or the offset of its mapping object.
    pub number: u16,
    /// Its name, where the source has one.
    pub name: CompactString,
    /// Index of its mapping object (0x1600 …, 0x1A00 …).
    pub mapping_index: u16,
    /// Communication parameters (CANopen).
    pub communication: Option<PdoCommunication>,
    /// What it carries, in order.
    pub entries: Vec<PdoEntry>,
    /// Whether the mapping can't be changed.
    pub fixed: bool,
    /// Whether it has to be assigned.
    pub mandatory: bool,
    /// The sync manager to which it is assigned by default.
    pub sync_manager: Option<u8>,
    /// Mapping objects of PDOs that can't be assigned together with this one.
    pub excludes: Vec<u16>,
    /// Sync managers to which it can't be assigned (ExcludedSm of ETG.2000).
    pub excluded_sync_managers: Vec<u8>,
    /// The sync unit that it belongs to (ETG.2000).
    pub sync_unit: Option<u8>,
    /// Whether its index grows with the slot of its module.
    pub depends_on_slot: bool,
    /// Whether its index grows with the slot group of its module.
    pub depends_on_slot_group: bool,
    /// Whether it carries no data of its own and isn't assigned (Virtual of ETG.2000).
    pub is_virtual: bool,
    /// Whether the PDO of a module takes its place (OverwrittenByModule).
    pub overwritten_by_module: bool,
    /// Oversampling, where it is sampled several times a cycle.
    pub oversampling: Option<Box<Oversampling>>,
    /// The name in other languages.
    pub names: Texts,
    /// Greatest length of its own in bytes, where the source gives one that isn't its sync manager's.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub max_bytes: Option<u16>,
    /// What the source says about it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// The buses on which it is mapped so; all those of the device where none is said.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub buses: Option<ObjectBuses>,
    /// Whether no section describes it and it follows from NrOfRXPDO or NrOfTXPDO and CompactPDO (CiA 306).
    pub implicit: bool,
    /// Whether it follows from its mapping object, and is not declared as a PDO.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub from_object: bool,
    /// Where it is declared.
    pub origin: Origin,
}

impl Pdo {
    /// A PDO with nothing but an index.
    pub fn new(direction: Direction, mapping_index: u16) -> Self {
        let first = if direction == Direction::Receive { 0x1600 } else { 0x1A00 };
        Pdo {
            direction,
            number: mapping_index.wrapping_sub(first),
            name: CompactString::default(),
            mapping_index,
            communication: None,
            entries: Vec::new(),
            fixed: false,
            mandatory: false,
            sync_manager: None,
            excludes: Vec::new(),
            excluded_sync_managers: Vec::new(),
            sync_unit: None,
            depends_on_slot: false,
            depends_on_slot_group: false,
            is_virtual: false,
            overwritten_by_module: false,
            oversampling: None,
            names: Texts::default(),
            max_bytes: None,
            documentation: None,
            doubts: Doubts::new(),
            extensions: Extensions::new(),
            buses: None,
            implicit: false,
            from_object: false,
            origin: Origin::default(),
        }
    }

    /// Returns whether the mapping can be written to the device: every entry has an index, or is padding.
    pub fn is_mapping_known(&self) -> bool {
        self.entries.iter().all(|entry| entry.kind != PdoEntryKind::Unnumbered)
    }

    /// Whether no bus has both.
    pub fn is_apart(&self, other: &Pdo) -> bool {
        let of_both = self.buses.zip(other.buses);
        of_both.is_some_and(|(one, other)| !(one.canopen && other.canopen || one.coe && other.coe))
    }

    /// Whether the two can't be assigned together: one excludes the other, or they are one PDO described twice.
    pub fn conflicts_with(&self, other: &Pdo) -> bool {
        self.mapping_index == other.mapping_index && !self.is_apart(other)
            || self.excludes.contains(&other.mapping_index)
            || other.excludes.contains(&self.mapping_index)
    }

    /// Length in bits.
    pub fn bits(&self) -> u32 {
        self.entries.iter().fold(0, |bits, entry| bits.saturating_add(entry.bits))
    }

    /// Length in bytes, the last one perhaps not full.
    pub fn bytes(&self) -> usize {
        self.bits().div_ceil(8) as usize
    }
}

/// Communication parameters of a CANopen PDO (CiA 301 7.5.2.35, 7.5.2.37).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PdoCommunication {
    /// Index of the communication object (0x1400 …, 0x1800 …).
    pub index: u16,
    /// Sub-index 1: COB-ID with the valid, RTR and frame bits.
    pub cob_id: Option<Value>,
    /// Sub-index 2: transmission type.
    pub transmission_type: Option<u8>,
    /// Sub-index 3: inhibit time in 100 µs.
    pub inhibit_time: Option<u16>,
    /// Sub-index 5: event timer in ms.
    pub event_timer: Option<u16>,
    /// Sub-index 6: SYNC start value.
    pub sync_start: Option<u8>,
    /// Sub-indices that can be written.
    pub writable: Vec<u8>,
}

/// One entry of a PDO.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PdoEntry {
    /// Index of the mapped object; 0 for padding.
    pub index: u16,
    /// Sub-index of the mapped object.
    pub sub_index: u8,
    /// First bit, counted from the PDO's first.
    pub bit_offset: u32,
    /// Length in bits.
    pub bits: u32,
    /// What it is.
    pub kind: PdoEntryKind,
    /// The mapped item, once resolved; `None` for an object of another module. Of a module, the id counts its fixed objects first.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub item: Option<ItemId>,
    /// Its name: that of the mapped item, or the source's own.
    pub name: CompactString,
    /// Its type: that of the mapped item, or the source's own.
    pub ty: Type,
    /// Whether it can't be taken out of the mapping (Fixed of ETG.2000).
    pub fixed: bool,
    /// Whether its index grows with the slot of its module.
    pub depends_on_slot: bool,
    /// Whether its index grows with the slot group of its module.
    pub depends_on_slot_group: bool,
    /// The name in other languages.
    pub names: Texts,
    /// Where the entry stands.
    pub origin: Origin,
}

impl PdoEntry {
    /// An entry of an object that is not described yet, as raw bits; with index 0, padding.
    pub fn new(index: u16, sub_index: u8, bits: u32) -> Self {
        PdoEntry {
            index,
            sub_index,
            bit_offset: 0,
            bits,
            kind: if index == 0 { PdoEntryKind::Padding } else { PdoEntryKind::Unknown },
            item: None,
            name: CompactString::default(),
            ty: Type::Opaque(None),
            fixed: false,
            depends_on_slot: false,
            depends_on_slot_group: false,
            names: Texts::default(),
            origin: Origin::default(),
        }
    }
}

/// Several samples of a PDO in one cycle (OSFac, OSMin, OSMax, OSIndexInc of ETG.2000).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Oversampling {
    /// Number of samples by default.
    pub factor: Option<u16>,
    /// Least number of samples.
    pub min: Option<u16>,
    /// Greatest number of samples.
    pub max: Option<u16>,
    /// What the index grows by from sample to sample.
    pub index_increment: Option<u16>,
}

/// What a PDO entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum PdoEntryKind {
    /// An item of the device.
    Item,
    /// An object that the source doesn't describe: raw bits.
    Unknown,
    /// An object whose index the source doesn't give: raw bits under a name, with index 0.
    Unnumbered,
    /// Room that nobody uses: a dummy entry of CANopen, padding of EtherCAT.
    Padding,
}

/// A sync manager of an EtherCAT slave (ETG.1000.4 6.7).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SyncManager {
    /// Its number.
    pub number: u8,
    /// Mailbox or process data, and the direction.
    pub purpose: SyncManagerPurpose,
    /// The same as the source spells it.
    pub label: CompactString,
    /// Physical start address.
    pub start_address: u16,
    /// Length in bytes by default.
    pub default_size: Option<u16>,
    /// Least and greatest length in bytes.
    pub size_range: (Option<u16>, Option<u16>),
    /// Control register.
    pub control: u8,
    /// Whether it is enabled.
    pub enable: bool,
    /// Whether it is used in Op only.
    pub op_only: bool,
    /// Whether it exists for the description's sake only (Virtual of ETG.2000).
    pub is_virtual: bool,
    /// Where it is declared.
    pub origin: Origin,
}

/// What a sync manager is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SyncManagerPurpose {
    /// Mailbox, controller to device.
    MailboxOut,
    /// Mailbox, device to controller.
    MailboxIn,
    /// Process data, controller to device.
    Outputs,
    /// Process data, device to controller.
    Inputs,
}

impl SyncManagerPurpose {
    /// What an ESI calls it (ETG.2000, Sm).
    pub fn label(self) -> &'static str {
        match self {
            SyncManagerPurpose::MailboxOut => "MBoxOut",
            SyncManagerPurpose::MailboxIn => "MBoxIn",
            SyncManagerPurpose::Outputs => "Outputs",
            SyncManagerPurpose::Inputs => "Inputs",
        }
    }
}

/// A process image with a fixed layout.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProcessImage {
    /// Its name.
    pub name: CompactString,
    /// Direction.
    pub direction: Direction,
    /// Length in bytes of the user data.
    pub length: u32,
    /// Bytes that belong to the image but aren't user data (a PROFIsafe message trailer, status bytes).
    pub overhead: u32,
    /// Whether numbers are big-endian.
    pub big_endian: bool,
    /// Its fields; `index` and `sub_index` are 0 where the bus has none.
    pub fields: Vec<PdoEntry>,
}
