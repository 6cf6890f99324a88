//! Capabilities and configuration of EtherCAT slaves (ETG.2000, `Device`).

use super::CompactString;
use crate::source::Origin;

/// Capabilities of a device on EtherCAT, and settings for its master.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EtherCatSettings {
    /// Physical layer of each of up to four ports (`Physics`): Y = MII, K = LVDS, H = enhanced link, blank = no port.
    pub physics: CompactString,
    /// Name of the device family (`GroupType`).
    pub group: CompactString,
    /// Product code and revision of each device that tools hide because of this description (`HideType`).
    pub hides: Vec<(Option<u32>, Option<u32>)>,
    /// Whether tools hide the device itself (`Invisible`).
    pub invisible: bool,
    /// FMMUs in the order of the slave controller.
    pub fmmus: Vec<Fmmu>,
    /// Sync units.
    pub sync_units: Vec<SyncUnit>,
    /// Mailbox, if any.
    pub mailbox: Option<Box<Mailbox>>,
    /// Distributed clocks, if any.
    pub clocks: Option<Box<DistributedClocks>>,
    /// Rules for slots of a modular device.
    pub slots: Option<Box<SlotRules>>,
    /// ESC registers that a master writes: address and value (`ESC`).
    pub registers: Vec<(u16, u32)>,
    /// EEPROM content.
    pub eeprom: Option<Box<Eeprom>>,
    /// Timeouts in milliseconds, with the name of the element (`PreopTimeout`, `RequestTimeout`, …).
    pub timeouts: Vec<(CompactString, u32)>,
}

/// A fieldbus memory management unit (ETG.1000.4 6.6).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fmmu {
    /// Purpose as the source spells it: `Outputs`, `Inputs`, `MBoxState`.
    pub purpose: CompactString,
    /// Number of the mapped sync manager, if given.
    pub sync_manager: Option<u8>,
    /// Number of the mapped sync unit, if given.
    pub sync_unit: Option<u8>,
    /// Whether the FMMU is enabled only in the state Op.
    pub op_only: bool,
}

/// A sync unit: process data that are exchanged together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SyncUnit {
    /// Name.
    pub name: CompactString,
    /// Whether the sync unit needs a separate sync unit in the master (`SeparateSu`).
    pub separate: bool,
    /// Whether the sync unit needs a separate frame.
    pub separate_frame: bool,
    /// Whether the data of the sync unit depend on the input state.
    pub depends_on_input_state: bool,
    /// Whether frames may be repeated.
    pub frame_repeat: bool,
}

/// The mailbox and its protocols (ETG.1000.6).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mailbox {
    /// Whether the data link layer of the mailbox is supported, which repeats lost requests.
    pub data_link_layer: bool,
    /// Whether the mailbox runs in real-time mode.
    pub real_time: bool,
    /// ADS over EtherCAT.
    pub aoe: Option<Protocol>,
    /// Ethernet over EtherCAT.
    pub eoe: Option<Protocol>,
    /// CAN application protocol over EtherCAT.
    pub coe: Option<Coe>,
    /// File access over EtherCAT.
    pub foe: Option<Protocol>,
    /// Servo profile over EtherCAT.
    pub soe: Option<Protocol>,
    /// Vendor-specific protocol over EtherCAT.
    pub voe: Option<Protocol>,
}

/// A mailbox protocol, described by its attributes only.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Protocol {
    /// Attributes as the source spells them (`IP`, `MAC`, `ChannelCount`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Commands that a master sends at start-up.
    pub init_commands: Vec<InitCommand>,
}

/// CAN application protocol over EtherCAT.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Coe {
    /// Whether the SDO information service is supported.
    pub sdo_info: bool,
    /// Whether the PDO assignment can be written (0x1C12, 0x1C13).
    pub pdo_assign: bool,
    /// Whether the PDO mapping can be written (0x1600 …, 0x1A00 …).
    pub pdo_config: bool,
    /// Whether a master reads the PDO assignment from the device.
    pub pdo_upload: bool,
    /// Whether complete access is supported: the transfer of all sub-indices at once.
    pub complete_access: bool,
    /// Whether segmented SDO transfer is supported.
    pub segmented_sdo: bool,
    /// Whether there is a diagnosis history (0x10F3).
    pub diag_history: bool,
    /// Further attributes as the source spells them (`EdsFile`, `DS402Channels`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Commands that a master sends at start-up.
    pub init_commands: Vec<InitCommand>,
}

/// A command that a master sends to the mailbox at a state transition.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InitCommand {
    /// State transitions: `IP`, `PS`, `SP`, `SO`, `OP`, `OS`.
    pub transitions: Vec<CompactString>,
    /// Index of the object (CoE), IDN (SoE) or frame type (EoE).
    pub index: u16,
    /// Sub-index of the object (CoE) or drive channel (SoE).
    pub sub_index: u8,
    /// Data in the byte order of the wire.
    pub data: Vec<u8>,
    /// Whether the index depends on the slot of its module.
    pub depends_on_slot: bool,
    /// Whether the index depends on the slot group of its module.
    pub depends_on_slot_group: bool,
    /// Whether the command uses complete access.
    pub complete_access: bool,
    /// Whether users cannot change the command.
    pub fixed: bool,
    /// Whether a master adapts the data (`AdaptAutomatically`).
    pub adapt: bool,
    /// Whether a module can replace the command.
    pub overwritten_by_module: bool,
    /// Purpose.
    pub comment: CompactString,
    /// Location in the source.
    pub origin: Origin,
}

/// Distributed clocks.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DistributedClocks {
    /// Attributes as the source spells them (`UnknownFRMW`, `PotentialReferenceClock`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Modes of operation, default mode first.
    pub modes: Vec<ClockMode>,
}

/// A mode of operation of the distributed clocks (`OpMode`).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockMode {
    /// Name.
    pub name: CompactString,
    /// Description.
    pub description: CompactString,
    /// Value of register 0x0980 (`AssignActivate`).
    pub assign_activate: u32,
    /// Cycle time of SYNC0.
    pub cycle_sync0: ClockTime,
    /// Shift time of SYNC0.
    pub shift_sync0: ClockTime,
    /// Cycle time of SYNC1.
    pub cycle_sync1: ClockTime,
    /// Shift time of SYNC1.
    pub shift_sync1: ClockTime,
    /// Settings of sync managers in this mode.
    pub sync_managers: Vec<ClockSyncManager>,
}

/// A time of a clock mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockTime {
    /// Time in nanoseconds; 0 if it follows from the cycle time.
    pub nanoseconds: i32,
    /// Factor of the cycle time (for SYNC1: of the cycle time of SYNC0); a negative number is a divisor.
    pub factor: Option<i32>,
    /// Whether the shift is relative to the inputs.
    pub input: bool,
}

/// Settings of a sync manager in a mode of the distributed clocks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockSyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Synchronization type as in object 0x1C32:01, if given.
    pub sync_type: Option<u16>,
    /// Index of each PDO with its oversampling factor.
    pub pdos: Vec<(u16, Option<u16>)>,
}

/// Rules for the slots of a modular device (`Slots`).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlotRules {
    /// Maximum number of slots, if given.
    pub max_slots: Option<u16>,
    /// Maximum number of slot groups, if given.
    pub max_groups: Option<u16>,
    /// Increment of the index of an object from slot to slot.
    pub index_increment: u16,
    /// Increment of the index of a PDO from slot to slot.
    pub pdo_increment: u16,
    /// Increment of the index of an object from slot group to slot group.
    pub group_index_increment: u16,
    /// Increment of the index of a PDO from slot group to slot group.
    pub group_pdo_increment: u16,
    /// Whether a master writes the list of configured modules to 0xF030 (`DownloadModuleIdentList`).
    pub download_idents: bool,
    /// Whether a master writes the list of module addresses.
    pub download_addresses: bool,
    /// State transition at which a master writes the lists; default `PS`.
    pub download_transition: CompactString,
    /// Groups of modules with contiguous process data.
    pub pdo_groups: Vec<ModulePdoGroup>,
    /// Numbers and names of slot groups.
    pub groups: Vec<(u16, CompactString)>,
    /// Named arrangements of modules.
    pub selections: Vec<(CompactString, Vec<u32>)>,
}

/// Modules with contiguous process data (`ModulePdoGroup`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModulePdoGroup {
    /// Alignment of the data of each module in bytes; 0 and 1 = none.
    pub alignment: u16,
    /// Index of the RPDO of the device before the RPDOs of the modules, if given.
    pub rx_pdo: Option<u16>,
    /// Index of the TPDO of the device before the TPDOs of the modules, if given.
    pub tx_pdo: Option<u16>,
}

/// EEPROM content of a slave (ETG.1000.6 5.4, ETG.2010).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Eeprom {
    /// The complete content, if the source has it.
    pub data: Vec<u8>,
    /// Size in bytes.
    pub byte_size: Option<u32>,
    /// The first words, which configure the slave controller.
    pub config_data: Vec<u8>,
    /// Mailbox configuration of the Bootstrap state.
    pub boot_strap: Vec<u8>,
    /// Numbers and contents of further categories.
    pub categories: Vec<(u16, Vec<u8>)>,
    /// Whether the EEPROM is assigned to the process data interface (PDI).
    pub assign_to_pdi: bool,
}
