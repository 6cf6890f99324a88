//! What an EtherCAT slave can, and how its controller is set up (ETG.2000, `Device`).

use super::CompactString;
use crate::source::Origin;

/// What a device can on EtherCAT, and how a master sets it up.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EtherCatSettings {
    /// The kind of each of up to four ports (`Physics`): Y = MII, K = LVDS, H = enhanced, blank = none.
    pub physics: CompactString,
    /// Name of the family that it belongs to (`GroupType`).
    pub group: CompactString,
    /// Revisions that this description hides from a list of devices (`HideType`): product code and revision.
    pub hides: Vec<(Option<u32>, Option<u32>)>,
    /// Whether it isn't offered in a list of devices itself (`Invisible`).
    pub invisible: bool,
    /// FMMUs, in the order of the slave controller.
    pub fmmus: Vec<Fmmu>,
    /// Sync units.
    pub sync_units: Vec<SyncUnit>,
    /// The mailbox, where there is one.
    pub mailbox: Option<Box<Mailbox>>,
    /// Distributed clocks, where it has them.
    pub clocks: Option<Box<DistributedClocks>>,
    /// How its slots are counted, where it is modular.
    pub slots: Option<Box<SlotRules>>,
    /// Registers of the slave controller that a master writes: address and value (`ESC`).
    pub registers: Vec<(u16, u32)>,
    /// Content of the EEPROM.
    pub eeprom: Option<Box<Eeprom>>,
    /// Time limits in milliseconds, by the name of the element (`PreopTimeout`, `RequestTimeout`, …).
    pub timeouts: Vec<(CompactString, u32)>,
}

/// A fieldbus memory management unit (ETG.1000.4 6.6).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fmmu {
    /// What it maps: `Outputs`, `Inputs`, `MBoxState`, or what the source says.
    pub purpose: CompactString,
    /// The sync manager that it maps, where given.
    pub sync_manager: Option<u8>,
    /// The sync unit that it maps, where given.
    pub sync_unit: Option<u8>,
    /// Whether it is to be enabled in Op only.
    pub op_only: bool,
}

/// A sync unit: process data that is exchanged together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SyncUnit {
    /// Its name.
    pub name: CompactString,
    /// Whether it has a sync unit of its own in the master (`SeparateSu`).
    pub separate: bool,
    /// Whether it needs a frame of its own.
    pub separate_frame: bool,
    /// Whether its data depend on the input state.
    pub depends_on_input_state: bool,
    /// Whether frames may be repeated.
    pub frame_repeat: bool,
}

/// The mailbox and its protocols (ETG.1000.6).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mailbox {
    /// Whether the data link layer of the mailbox is supported (repeat requests).
    pub data_link_layer: bool,
    /// Whether it runs in real-time mode.
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

/// A mailbox protocol of which nothing but its flags matters.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Protocol {
    /// Its attributes, by name, as the source spells them (`IP`, `MAC`, `ChannelCount`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// What a master sends at start-up.
    pub init_commands: Vec<InitCommand>,
}

/// CAN application protocol over EtherCAT.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Coe {
    /// Whether the SDO information service is supported.
    pub sdo_info: bool,
    /// Whether the assignment of PDOs may be written (0x1C12, 0x1C13).
    pub pdo_assign: bool,
    /// Whether the mapping of PDOs may be written (0x1600 …, 0x1A00 …).
    pub pdo_config: bool,
    /// Whether a master reads the assignment from the device.
    pub pdo_upload: bool,
    /// Whether all sub-indices may be transferred at once.
    pub complete_access: bool,
    /// Whether segmented SDO transfer is supported.
    pub segmented_sdo: bool,
    /// Whether there is a diagnosis history (0x10F3).
    pub diag_history: bool,
    /// Further attributes, by name, as the source spells them (`EdsFile`, `DS402Channels`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// What a master writes at start-up.
    pub init_commands: Vec<InitCommand>,
}

/// Something that a master sends to the mailbox on a change of state.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InitCommand {
    /// The changes of state: `IP`, `PS`, `SP`, `SO`, `OP`, `OS`.
    pub transitions: Vec<CompactString>,
    /// Index of the object (CoE), IDN (SoE) or type of the frame (EoE).
    pub index: u16,
    /// Sub-index of the object (CoE) or drive channel (SoE).
    pub sub_index: u8,
    /// What is sent, in the order of the wire.
    pub data: Vec<u8>,
    /// Whether the index grows with the slot.
    pub depends_on_slot: bool,
    /// Whether the index grows with the slot group.
    pub depends_on_slot_group: bool,
    /// Whether all sub-indices are written at once.
    pub complete_access: bool,
    /// Whether a user may not change it.
    pub fixed: bool,
    /// Whether a master adapts the data itself (`AdaptAutomatically`).
    pub adapt: bool,
    /// Whether a module may replace it.
    pub overwritten_by_module: bool,
    /// What it is for.
    pub comment: CompactString,
    /// Where it is declared.
    pub origin: Origin,
}

/// Distributed clocks.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DistributedClocks {
    /// Its attributes, by name, as the source spells them (`UnknownFRMW`, `PotentialReferenceClock`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// The modes of operation, the default one first.
    pub modes: Vec<ClockMode>,
}

/// A mode of operation of the distributed clocks (`OpMode`).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockMode {
    /// Its name.
    pub name: CompactString,
    /// What it does.
    pub description: CompactString,
    /// Value of the register 0x0980 (`AssignActivate`).
    pub assign_activate: u32,
    /// Cycle of Sync0.
    pub cycle_sync0: ClockTime,
    /// Shift of Sync0.
    pub shift_sync0: ClockTime,
    /// Cycle of Sync1.
    pub cycle_sync1: ClockTime,
    /// Shift of Sync1.
    pub shift_sync1: ClockTime,
    /// What holds for single sync managers in this mode.
    pub sync_managers: Vec<ClockSyncManager>,
}

/// A time of a clock mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockTime {
    /// The time in ns; 0 where it follows from the cycle time.
    pub nanoseconds: i32,
    /// The factor to the cycle time (of Sync1: to Sync0's); negative = a divisor.
    pub factor: Option<i32>,
    /// Whether the shift is relative to the inputs.
    pub input: bool,
}

/// What a clock mode says of a sync manager.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockSyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Synchronisation type, as 0x1C32:01 has it, where given.
    pub sync_type: Option<u16>,
    /// Index of each PDO with its oversampling factor.
    pub pdos: Vec<(u16, Option<u16>)>,
}

/// How the slots of a modular device are counted (`Slots`).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlotRules {
    /// Greatest number of slots, where given.
    pub max_slots: Option<u16>,
    /// Greatest number of slot groups, where given.
    pub max_groups: Option<u16>,
    /// What the index of an object grows by from slot to slot.
    pub index_increment: u16,
    /// What the index of a PDO grows by from slot to slot.
    pub pdo_increment: u16,
    /// What the index of an object grows by from slot group to slot group.
    pub group_index_increment: u16,
    /// What the index of a PDO grows by from slot group to slot group.
    pub group_pdo_increment: u16,
    /// Whether a master writes the list of configured modules to 0xF030 (`DownloadModuleIdentList`).
    pub download_idents: bool,
    /// Whether a master writes the list of module addresses.
    pub download_addresses: bool,
    /// The change of state on which it writes the lists; `PS` by default.
    pub download_transition: CompactString,
    /// Groups of modules whose process data are put together.
    pub pdo_groups: Vec<ModulePdoGroup>,
    /// Names of slot groups, by number.
    pub groups: Vec<(u16, CompactString)>,
    /// Arrangements of modules that go by a name.
    pub selections: Vec<(CompactString, Vec<u32>)>,
}

/// Modules whose process data stand one after the other (`ModulePdoGroup`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModulePdoGroup {
    /// Alignment of each module's data in bytes; 0 and 1 = none.
    pub alignment: u16,
    /// Index of the device's RPDO behind which the modules' RPDOs stand, where given.
    pub rx_pdo: Option<u16>,
    /// Index of the device's TPDO behind which the modules' TPDOs stand, where given.
    pub tx_pdo: Option<u16>,
}

/// Content of the EEPROM of a slave (ETG.1000.6 5.4, ETG.2010).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Eeprom {
    /// All of it, where the source gives it whole.
    pub data: Vec<u8>,
    /// Its size in bytes.
    pub byte_size: Option<u32>,
    /// The first words: configuration of the slave controller.
    pub config_data: Vec<u8>,
    /// Mailbox of the bootstrap state.
    pub boot_strap: Vec<u8>,
    /// Further categories: number and content.
    pub categories: Vec<(u16, Vec<u8>)>,
    /// Whether it is assigned to the process data interface.
    pub assign_to_pdi: bool,
}
