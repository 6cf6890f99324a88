//! What is exchanged cyclically, with exact bit positions.

use serde::{Deserialize, Serialize};

use super::{CompactString, Type, Value};
use crate::source::Origin;

/// Cyclic data of a device or a module.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProcessData {
    /// PDOs, RPDOs first, each by number.
    pub pdos: Vec<Pdo>,
    /// Sync managers of an EtherCAT slave, by number.
    pub sync_managers: Vec<SyncManager>,
    /// Other images with a fixed layout, such as the data of a PROFINET submodule.
    pub images: Vec<ProcessImage>,
}

/// Direction of cyclic data, seen from the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Received by the device: outputs of the controller, RPDO.
    Receive,
    /// Sent by the device: inputs of the controller, TPDO.
    Transmit,
}

/// One process data object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Whether no section describes it and it follows from NrOfRXPDO or NrOfTXPDO and CompactPDO (CiA 306).
    pub implicit: bool,
    /// Where it is declared.
    pub origin: Origin,
}

impl Pdo {
    /// Length in bits.
    pub fn bits(&self) -> u32 {
        self.entries.iter().map(|entry| entry.bits).sum()
    }

    /// Length in bytes, the last one perhaps not full.
    pub fn bytes(&self) -> usize {
        self.bits().div_ceil(8) as usize
    }
}

/// Communication parameters of a CANopen PDO (CiA 301 7.5.2.35, 7.5.2.37).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Its name: that of the mapped item, or the source's own.
    pub name: CompactString,
    /// Its type: that of the mapped item, or the source's own.
    pub ty: Type,
    /// Where the entry stands.
    pub origin: Origin,
}

/// What a PDO entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PdoEntryKind {
    /// An item of the device.
    Item,
    /// An object that the source doesn't describe: raw bits.
    Unknown,
    /// Room that nobody uses: a dummy entry of CANopen, padding of EtherCAT.
    Padding,
}

/// A sync manager of an EtherCAT slave (ETG.1000.4 6.7).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SyncManager {
    /// Its number.
    pub number: u8,
    /// Mailbox or process data, and the direction.
    pub purpose: SyncManagerPurpose,
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
}

/// What a sync manager is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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

/// A process image with a fixed layout.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
