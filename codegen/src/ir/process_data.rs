//! Cyclic data with exact bit positions.

use std::sync::Arc;

use super::{CompactString, Documentation, Doubts, Extensions, ItemId, ObjectBuses, Texts, Type, Value};
use crate::collections::HashMap;
use crate::source::Origin;

/// Cyclic data of a device or a module.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProcessData {
    /// PDOs. In the list of a vendor file, all RPDOs come before all TPDOs. The PDOs of each direction are sorted by number on
    /// CANopen, and in the order of the file on EtherCAT.
    pub pdos: Vec<Pdo>,
    /// Sync managers of an EtherCAT slave, sorted by number.
    pub sync_managers: Vec<SyncManager>,
    /// Process images with a fixed layout.
    pub images: Vec<ProcessImage>,
}

/// Maximum number of sub-indices of a PDO mapping or PDO assignment object, except sub-index 0 (ETG.1000.6 5.6.7.4).
pub const MAX_PDO_SUBS: usize = 254;

impl ProcessData {
    /// Returns the PDOs that are assigned by default, with their sync managers: outputs, then inputs, in the order of the source.
    ///
    /// A PDO that conflicts with an earlier assigned PDO ([`Pdo::conflicts_with`]) is not assigned (ETG.2000, Sm of RxPdo and
    /// TxPdo).
    pub fn assigned_by_default(&self) -> Vec<(&Pdo, u8)> {
        self.default_assignment().assigned
    }

    /// Returns the PDOs that are assigned by default, and the PDOs that conflict with them.
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

    /// Returns whether a sync manager with this number exists. Also returns true if the description has no list of sync managers.
    pub fn has_sync_manager(&self, number: u8) -> bool {
        self.sync_managers.is_empty() || self.sync_managers.iter().any(|manager| manager.number == number)
    }
}

/// The default PDO assignment. The maps keep the time linear for files with thousands of PDOs.
#[derive(Debug, Default)]
pub(crate) struct DefaultAssignment<'a> {
    /// Assigned PDOs with their sync managers.
    pub assigned: Vec<(&'a Pdo, u8)>,
    /// PDOs that are not assigned because of a conflict, each with the first assigned PDO with which it conflicts.
    pub left_out: Vec<(&'a Pdo, &'a Pdo)>,
    /// Positions in `assigned` by mapping index. PDOs on different buses can share an index.
    by_index: HashMap<u16, Vec<usize>>,
    /// For each excluded index, the position in `assigned` of the first PDO that excludes it.
    excluded: HashMap<u16, usize>,
}

impl<'a> DefaultAssignment<'a> {
    /// Returns the first assigned PDO that conflicts with `pdo` ([`Pdo::conflicts_with`]).
    fn conflict(&self, pdo: &Pdo) -> Option<&'a Pdo> {
        let of_index = |index: &u16| self.by_index.get(index).into_iter().flatten().copied();
        let same_index = of_index(&pdo.mapping_index).find(|&at| !self.assigned[at].0.is_apart(pdo));
        let by_others = self.excluded.get(&pdo.mapping_index).copied();
        let by_itself = pdo.excludes.iter().filter_map(|index| of_index(index).next()).min();
        [same_index, by_others, by_itself].into_iter().flatten().min().map(|at| self.assigned[at].0)
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
    /// The device receives the data: outputs of the controller, RPDO.
    Receive,
    /// The device sends the data: inputs of the controller, TPDO.
    Transmit,
}

/// A process data object (PDO).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pdo {
    /// Direction of the PDO.
    pub direction: Direction,
    /// Number of the PDO: counted from 1 on CANopen, otherwise the index of the mapping object minus 0x1600 or 0x1A00.
    pub number: u16,
    /// Name of the PDO, if the source has one.
    pub name: CompactString,
    /// Index of the mapping object (0x1600 …, 0x1A00 …).
    pub mapping_index: u16,
    /// Communication parameters of the PDO on CANopen.
    pub communication: Option<PdoCommunication>,
    /// Entries of the PDO, in order.
    pub entries: Vec<PdoEntry>,
    /// True if the mapping cannot be changed.
    pub fixed: bool,
    /// True if a master has to assign the PDO.
    pub mandatory: bool,
    /// Sync manager to which the PDO is assigned by default; `None` = the PDO is not assigned by default.
    pub sync_manager: Option<u8>,
    /// Indices of the mapping objects whose PDOs cannot be assigned together with this PDO.
    pub excludes: Vec<u16>,
    /// Sync managers that cannot contain the PDO (ExcludedSm of ETG.2000).
    pub excluded_sync_managers: Vec<u8>,
    /// Number of the sync unit that contains the PDO (ETG.2000).
    pub sync_unit: Option<u8>,
    /// True if the index of the PDO depends on the slot of the module.
    pub depends_on_slot: bool,
    /// True if the index of the PDO depends on the slot group of the module.
    pub depends_on_slot_group: bool,
    /// True if the PDO has no data and is not assigned (Virtual of ETG.2000).
    pub is_virtual: bool,
    /// True if a PDO of a module replaces this PDO (OverwrittenByModule).
    pub overwritten_by_module: bool,
    /// Oversampling of the PDO: several samples in one cycle.
    pub oversampling: Option<Box<Oversampling>>,
    /// Position of the PDO in the assignment, if given (PdoOrder of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub order: Option<i32>,
    /// True if the PDO contains parameters of the safety-related application, if given (SRA_Parameter of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sra_parameter: Option<bool>,
    /// Name of the PDO in other languages.
    pub names: Texts,
    /// Maximum length in bytes, if the source states a maximum for this PDO instead of for its sync manager.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub max_bytes: Option<u16>,
    /// Description of the PDO from the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the PDO, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Facts about the PDO that have no field in the IR.
    pub extensions: Extensions,
    /// Buses on which the PDO has this mapping; `None` = all buses of the device.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub buses: Option<ObjectBuses>,
    /// True if the PDO has no section and follows from NrOfRXPDO, NrOfTXPDO and CompactPDO (CiA 306).
    pub implicit: bool,
    /// True if the PDO comes from a mapping object of the dictionary; false if the source declares the PDO itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub from_object: bool,
    /// Location of the PDO in the source.
    pub origin: Origin,
}

impl Pdo {
    /// Creates a PDO without entries.
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
            order: None,
            sra_parameter: None,
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

    /// Returns whether the index of every entry except padding is known. If an index is unknown, a client cannot write the
    /// mapping to the device.
    pub fn is_mapping_known(&self) -> bool {
        self.entries.iter().all(|entry| entry.kind != PdoEntryKind::Unnumbered)
    }

    /// Returns whether the two PDOs have no bus in common.
    pub fn is_apart(&self, other: &Pdo) -> bool {
        let of_both = self.buses.zip(other.buses);
        of_both.is_some_and(|(one, other)| !(one.canopen && other.canopen || one.coe && other.coe))
    }

    /// Returns whether the two PDOs cannot be assigned together: one excludes the other, or both have the same mapping
    /// index on a common bus.
    pub fn conflicts_with(&self, other: &Pdo) -> bool {
        self.mapping_index == other.mapping_index && !self.is_apart(other)
            || self.excludes.contains(&other.mapping_index)
            || other.excludes.contains(&self.mapping_index)
    }

    /// Returns the length of the PDO in bits.
    pub fn bits(&self) -> u32 {
        self.entries.iter().fold(0, |bits, entry| bits.saturating_add(entry.bits))
    }

    /// Returns the length of the PDO in bytes, rounded up.
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
    /// Sub-index 1: COB-ID, including the valid, RTR and frame bits.
    pub cob_id: Option<Value>,
    /// Sub-index 2: transmission type.
    pub transmission_type: Option<u8>,
    /// Sub-index 3: inhibit time in units of 100 µs.
    pub inhibit_time: Option<u16>,
    /// Sub-index 5: event timer in ms.
    pub event_timer: Option<u16>,
    /// Sub-index 6: SYNC start value.
    pub sync_start: Option<u8>,
    /// Sub-indices of the communication object that can be written.
    pub writable: Vec<u8>,
}

/// One entry of a PDO.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PdoEntry {
    /// Index of the mapped object, or of the data type in a dummy entry; 0 for padding, and if the index is unknown.
    pub index: u16,
    /// Sub-index of the mapped object.
    pub sub_index: u8,
    /// Bit offset from the start of the PDO.
    pub bit_offset: u32,
    /// Length of the entry in bits.
    pub bits: u32,
    /// Kind of the entry.
    pub kind: PdoEntryKind,
    /// Id of the mapped item, set by `resolve`. `None` for padding, and for objects that this device or module does not describe.
    /// In the ids of a module, the groups are numbered consecutively: first the fixed objects, then the other groups.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub item: Option<ItemId>,
    /// Name in the mapping, or the name of the mapped item if the mapping states no name.
    pub name: CompactString,
    /// Type of the mapped item. On EtherCAT, the type in the mapping if the item is unknown or its length differs from that of the
    /// entry.
    pub ty: Type,
    /// True if the entry cannot be removed from the mapping (Fixed of ETG.2000).
    pub fixed: bool,
    /// True if the index of the entry depends on the slot of the module.
    pub depends_on_slot: bool,
    /// True if the index of the entry depends on the slot group of the module.
    pub depends_on_slot_group: bool,
    /// Name of the entry in other languages.
    pub names: Texts,
    /// Location of the entry in the source.
    pub origin: Origin,
}

impl PdoEntry {
    /// Creates an entry for an unknown object, or padding if the index is 0.
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

/// Oversampling: a PDO contains several samples in one cycle (OSFac, OSMin, OSMax, OSIndexInc of ETG.2000).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Oversampling {
    /// Default number of samples per cycle.
    pub factor: Option<u16>,
    /// Minimum number of samples per cycle.
    pub min: Option<u16>,
    /// Maximum number of samples per cycle.
    pub max: Option<u16>,
    /// Index increment from sample to sample.
    pub index_increment: Option<u16>,
}

/// The kind of a PDO entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum PdoEntryKind {
    /// An item of the device or of a module.
    Item,
    /// An object that the source does not describe, as raw bits.
    Unknown,
    /// An object without a known index, as raw bits with a name. The index of the entry is 0.
    Unnumbered,
    /// Unused bits: a dummy entry, which maps a data type (CANopen), or padding (EtherCAT).
    Padding,
}

/// A sync manager of an EtherCAT slave (ETG.1000.4 6.7).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Purpose of the sync manager: mailbox or process data, with the direction.
    pub purpose: SyncManagerPurpose,
    /// Purpose of the sync manager as the source spells it.
    pub label: CompactString,
    /// Physical start address of the sync manager's memory.
    pub start_address: u16,
    /// Default length of the sync manager's memory in bytes.
    pub default_size: Option<u16>,
    /// Minimum and maximum length of the sync manager's memory in bytes.
    pub size_range: (Option<u16>, Option<u16>),
    /// Value of the sync manager's control register.
    pub control: u8,
    /// True if the sync manager is enabled.
    pub enable: bool,
    /// True if the sync manager is enabled only in the state "Op".
    pub op_only: bool,
    /// True if the sync manager exists only in the description (Virtual of ETG.2000).
    pub is_virtual: bool,
    /// Location of the sync manager in the source.
    pub origin: Origin,
}

/// Purpose of a sync manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SyncManagerPurpose {
    /// Mailbox from controller to device.
    MailboxOut,
    /// Mailbox from device to controller.
    MailboxIn,
    /// Process data from controller to device.
    Outputs,
    /// Process data from device to controller.
    Inputs,
}

impl SyncManagerPurpose {
    /// Returns the name of the purpose in an ESI (ETG.2000, Sm).
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
    /// Name of the process image.
    pub name: CompactString,
    /// Direction of the process image.
    pub direction: Direction,
    /// Length of the user data in bytes.
    pub length: u32,
    /// Length in bytes of the trailer of a PROFIsafe message, which follows the user data; 0 if there is no trailer.
    pub overhead: u32,
    /// True if numbers are big-endian.
    pub big_endian: bool,
    /// Fields of the process image. On a bus without an object dictionary, `index` and `sub_index` of the fields are 0.
    pub fields: Vec<PdoEntry>,
    /// Ambiguities in the source about the process image, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
}
