//! The resolved segment: the configuration of each SubDevice as data.

use std::rc::Rc;

use lexibus_codegen::ir::{Device, Direction};
use lexibus_codegen::number;
use serde::{Serialize, Serializer};

use crate::description::Description;

/// An EtherCAT segment.
#[derive(Debug, Default, Serialize)]
pub struct Segment {
    /// Cycle time in ns; `None` if the file does not declare it.
    pub cycle_time: Option<u64>,
    /// Length of the outputs of all SubDevices in bytes. They start at logical address 0.
    pub output_bytes: u32,
    /// Length of the inputs of all SubDevices in bytes. They follow the outputs.
    pub input_bytes: u32,
    /// SubDevices in the order of their positions.
    pub subdevices: Vec<SubDevice>,
}

/// The configuration of a SubDevice.
#[derive(Debug, Serialize)]
pub struct SubDevice {
    /// Name of the SubDevice, as the network file spells it.
    pub name: String,
    /// Position on the bus, counted from 0.
    pub position: u16,
    /// Station alias; 0 = none.
    pub alias: u16,
    /// Description of the device.
    #[serde(skip)]
    pub description: Rc<Description>,
    /// Expected identity.
    pub identity: Identity,
    /// Modules in the slots, sorted by slot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub modules: Vec<PluggedModule>,
    /// Objects of the modules in their slots, in the order of `modules`.
    #[serde(skip)]
    pub module_objects: Vec<Device>,
    /// Commands in the order in which a MainDevice sends them.
    pub startup: Vec<StartupCommand>,
    /// Sync managers, sorted by number.
    pub sync_managers: Vec<SyncManager>,
    /// FMMUs of the process data.
    pub fmmus: Vec<Fmmu>,
    /// Assigned PDOs and padding. Those of a sync manager are in the order of their data.
    pub pdos: Vec<AssignedPdo>,
    /// Settings of the distributed clocks; `None` if the description has no modes or not the declared mode.
    pub dc: Option<Clock>,
}

/// Identity of a SubDevice; `None` = the number is unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Identity {
    /// Vendor-ID.
    pub vendor_id: Option<u32>,
    /// Product code.
    pub product_code: Option<u32>,
    /// Revision number.
    pub revision_number: Option<u32>,
}

/// A module in a slot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PluggedModule {
    /// Number of the slot, counted from 0.
    pub slot: u16,
    /// Ident of the module.
    pub ident: u32,
    /// Name of the module.
    pub name: String,
}

/// An SDO download during a state transition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StartupCommand {
    /// State transition: `IP` = Init to Pre-Operational, `PS` = Pre-Operational to Safe-Operational, `SO`, `SP`, `OP`, `OS`.
    pub transition: &'static str,
    /// Index of the object.
    pub index: u16,
    /// Sub-index of the object.
    pub sub_index: u8,
    /// True if the command uses complete access.
    pub complete_access: bool,
    /// Bytes of the value, as in the SDO download.
    #[serde(serialize_with = "hexadecimal")]
    pub data: Vec<u8>,
}

fn hexadecimal<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&number::bytes(bytes))
}

/// Settings of a sync manager (ETG.1000.4 6.7.2).
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Purpose as in an ESI: `MBoxOut`, `MBoxIn`, `Outputs`, `Inputs`.
    pub purpose: &'static str,
    /// Physical start address.
    pub start_address: u16,
    /// Length in bytes. For process data, this is the length of the assigned PDOs.
    pub length: u16,
    /// Value of the control register.
    pub control: u8,
    /// True if the sync manager is enabled. A sync manager without data is disabled.
    pub enable: bool,
    /// True if the sync manager is enabled only in Operational.
    pub op_only: bool,
}

/// An FMMU, which maps the process data of a sync manager bytewise to logical addresses (ETG.1000.4 6.6.2).
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fmmu {
    /// Number of the FMMU.
    pub number: u8,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Direction of the data: `outputs` or `inputs`.
    #[serde(serialize_with = "direction")]
    pub direction: Direction,
    /// Logical start address. The first byte of the outputs has address 0.
    pub logical_address: u32,
    /// Length in bytes.
    pub length: u16,
    /// Physical start address.
    pub physical_address: u16,
    /// True if the FMMU is enabled only in Operational.
    pub op_only: bool,
}

fn direction<S: Serializer>(direction: &Direction, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(direction_name(*direction))
}

/// Returns the name of a direction from the MainDevice's point of view.
pub(crate) fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "outputs",
        Direction::Transmit => "inputs",
    }
}

/// An assigned PDO or padding, with the position of its data.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AssignedPdo {
    /// Index of the PDO, or of the padding. The index 0 means padding without a mapping object.
    pub index: u16,
    /// Name of the PDO; may be empty.
    pub name: String,
    /// True for padding in front of a group of modules.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_padding: bool,
    /// Slot of the module that contains the PDO; `None` for a PDO of the SubDevice itself and for padding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slot: Option<u16>,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Offset in bits in the process data of the sync manager.
    pub bit_offset: u32,
    /// Length in bits.
    pub bits: u32,
}

/// Settings of the distributed clocks of a SubDevice.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Clock {
    /// Name of the mode.
    pub mode: String,
    /// Value of the registers 0x0980 and 0x0981 (`AssignActivate`).
    pub assign_activate: u32,
    /// Times of SYNC0.
    pub sync0: ClockSignal,
    /// Times of SYNC1.
    pub sync1: ClockSignal,
    /// Sync manager settings that the mode requires. They are not applied.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sync_managers: Vec<ClockSyncManager>,
}

/// Times of a SYNC signal in ns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ClockSignal {
    /// Cycle time.
    pub cycle_time: i64,
    /// Shift time.
    pub shift_time: i64,
    /// True if the shift is relative to the inputs.
    pub relative_to_inputs: bool,
}

/// Settings of a sync manager that a mode of the distributed clocks requires.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ClockSyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Synchronization type as in object 0x1C32:01; `None` if the description does not state it.
    pub sync_type: Option<u16>,
    /// Indices of PDOs, and the oversampling factor of each PDO.
    pub pdos: Vec<(u16, Option<u16>)>,
}
