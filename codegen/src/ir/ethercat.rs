//! Capabilities and configuration of EtherCAT slaves (ETG.2000, `Device`).

use super::{CompactString, FamilyRef, LocalText};
use crate::source::Origin;

/// Capabilities of a device on EtherCAT, and settings for its master.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EtherCatSettings {
    /// Physical layer of each of up to four ports (`Physics`): Y = MII, K = LVDS, H = MII with Fast Hot Connect, blank = no port.
    pub physics: CompactString,
    /// Device family, by its key (`GroupType`).
    pub group: FamilyRef,
    /// Product code and revision of each device that engineering tools hide because of this description (`HideType`).
    pub hides: Vec<(Option<u32>, Option<u32>)>,
    /// True if engineering tools hide the device itself (`Invisible`).
    pub invisible: bool,
    /// FMMUs, in the order in which the slave controller numbers them.
    pub fmmus: Vec<Fmmu>,
    /// Sync units of the device.
    pub sync_units: Vec<SyncUnit>,
    /// Mailbox of the device, if it has one.
    pub mailbox: Option<Box<Mailbox>>,
    /// Distributed clocks, if the device supports them.
    pub clocks: Option<Box<DistributedClocks>>,
    /// Rules for the slots of a modular device.
    pub slots: Option<Box<SlotRules>>,
    /// ESC registers that a master writes: address and value (`ESC`).
    pub registers: Vec<(u16, u32)>,
    /// EEPROM content, if the source describes it.
    pub eeprom: Option<Box<Eeprom>>,
    /// Names of the timeout elements (`PreopTimeout`, `RequestTimeout`, …) and their values in milliseconds.
    pub timeouts: Vec<(CompactString, u32)>,
    /// Current in milliamperes that the device draws from the E-bus, if given; negative = the device supplies the E-bus
    /// (`EBusCurrent`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ebus_current: Option<i32>,
    /// Address of the ESC register that contains the identification value, if given (`IdentificationAdo`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub identification_register: Option<u16>,
    /// True if the device shows its identification value in the AL status code (`IdentificationReg134`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub identification_in_al_status: bool,
    /// True if the device does not support LRW datagrams, so that a master uses LRD and LWR (`UseLrdLwr`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub without_lrw: bool,
    /// Attributes of the device type that only engineering tools and masters use.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tool: Option<Box<ToolSettings>>,
    /// Capacity of the slave controller (`EtherCATController`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub controller: Option<SlaveController>,
    /// True if the device supports a station alias, if given (`StationAliasSupported`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub station_alias: Option<bool>,
    /// Internet addresses of the device's documentation, with their languages (`URL`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub urls: Vec<LocalText>,
    /// File name of the device's picture, after the name of its element (`Image16x14` or `ImageFile16x14`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub picture: Option<(CompactString, CompactString)>,
    /// True if the device changes to the state "SafeOp" before it is synchronized (`StartToSafeopNoSync`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub safe_op_without_sync: bool,
}

/// Attributes of a device type for engineering tools and masters, with their texts unchanged (`Type`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ToolSettings {
    /// Comparison of the product code with that of the connected device: `NONE`, `EQ` (`CheckProductCode`).
    pub check_product_code: CompactString,
    /// Comparison of the revision: `NONE`, `EQ`, `EQ_OR_G`, `LW_EQ`, … (`CheckRevisionNo`).
    pub check_revision: CompactString,
    /// Comparison of the serial number: `NONE`, `EQ` (`CheckSerialNo`).
    pub check_serial_number: CompactString,
    /// Class of sync manager settings in TwinCAT (`TcSmClass`).
    pub sync_manager_class: CompactString,
    /// Whether TwinCAT brings the device to the state "SafeOp" in its configuration mode (`TcCfgModeSafeOp`).
    pub safe_op_in_config_mode: CompactString,
    /// Group of modules with contiguous process data (`ModulePdoGroup`).
    pub module_pdo_group: CompactString,
    /// Whether a master writes the list of modules to the device (`DownloadModuleList`).
    pub download_module_list: CompactString,
    /// Whether an engineering tool shows sub-devices that can be hidden (`ShowHideableSubDevices`).
    pub show_hideable_sub_devices: CompactString,
}

/// Capacity of an EtherCAT slave controller; `None` = not given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlaveController {
    /// Size of the memory for process data and mailboxes in bytes (`DpramSize`).
    pub memory_bytes: Option<u32>,
    /// Number of sync managers (`SmCount`).
    pub sync_managers: Option<u32>,
    /// Number of FMMUs (`FmmuCount`).
    pub fmmus: Option<u32>,
}

/// A fieldbus memory management unit (ETG.1000.4 6.6).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fmmu {
    /// Purpose of the FMMU as the source spells it: `Outputs`, `Inputs`, `MBoxState`.
    pub purpose: CompactString,
    /// Number of the sync manager that the FMMU maps, if given.
    pub sync_manager: Option<u8>,
    /// Number of the sync unit that the FMMU maps, if given.
    pub sync_unit: Option<u8>,
    /// True if the FMMU is enabled only in the state "Op".
    pub op_only: bool,
}

/// A sync unit: process data that are exchanged together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SyncUnit {
    /// Name of the sync unit.
    pub name: CompactString,
    /// True if a master must not combine these process data with those of other devices in one sync unit (`SeparateSu`).
    pub separate: bool,
    /// True if a master must exchange these process data in a separate frame (`SeparateFrame`).
    pub separate_frame: bool,
    /// True if the data of the sync unit depend on the input state (`DependOnInputState`).
    pub depends_on_input_state: bool,
    /// True if a master may repeat the frames of the sync unit.
    pub frame_repeat: bool,
}

/// The mailbox and its protocols (ETG.1000.6).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mailbox {
    /// True if the device supports the data link layer of the mailbox (`DataLinkLayer`). This layer repeats lost messages.
    pub data_link_layer: bool,
    /// True if the mailbox runs in real-time mode (`RealTimeMode`).
    pub real_time: bool,
    /// ADS over EtherCAT (AoE), if supported.
    pub aoe: Option<Protocol>,
    /// Ethernet over EtherCAT (EoE), if supported.
    pub eoe: Option<Protocol>,
    /// CAN application protocol over EtherCAT (CoE), if supported.
    pub coe: Option<Coe>,
    /// File access over EtherCAT (FoE), if supported.
    pub foe: Option<Protocol>,
    /// Servo drive profile over EtherCAT (SoE), if supported.
    pub soe: Option<Protocol>,
    /// Vendor-specific protocol over EtherCAT (VoE), if supported.
    pub voe: Option<Protocol>,
}

/// A mailbox protocol whose capabilities the IR stores as attributes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Protocol {
    /// Attributes of the protocol as the source spells them (`IP`, `MAC`, `ChannelCount`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Commands that a master sends at state transitions (`InitCmd`).
    pub init_commands: Vec<InitCommand>,
}

/// Capabilities of the CAN application protocol over EtherCAT (CoE).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Coe {
    /// True if the SDO information service is supported.
    pub sdo_info: bool,
    /// True if the PDO assignment can be written (0x1C12, 0x1C13).
    pub pdo_assign: bool,
    /// True if the PDO mapping can be written (0x1600 …, 0x1A00 …).
    pub pdo_config: bool,
    /// True if a master reads the PDO mapping and the PDO assignment from the device.
    pub pdo_upload: bool,
    /// True if complete access is supported: the transfer of all sub-indices at once.
    pub complete_access: bool,
    /// True if segmented SDO transfer is supported.
    pub segmented_sdo: bool,
    /// True if the device has a diagnosis history (0x10F3).
    pub diag_history: bool,
    /// Further attributes as the source spells them (`EdsFile`, `DS402Channels`).
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Commands that a master sends at state transitions (`InitCmd`).
    pub init_commands: Vec<InitCommand>,
}

/// A command that a master sends to the mailbox at a state transition.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InitCommand {
    /// State transitions at which the master sends the command: `IP`, `PS`, `SP`, `SO`, `OP`, `OS`.
    pub transitions: Vec<CompactString>,
    /// Index of the object (CoE), IDN (SoE) or frame type (EoE).
    pub index: u16,
    /// Sub-index of the object (CoE) or drive channel (SoE).
    pub sub_index: u8,
    /// Data of the command in the byte order of the wire.
    pub data: Vec<u8>,
    /// True if the index depends on the slot of the module.
    pub depends_on_slot: bool,
    /// True if the index depends on the slot group of the module.
    pub depends_on_slot_group: bool,
    /// True if the command uses complete access.
    pub complete_access: bool,
    /// True if users of the engineering tool cannot change the command.
    pub fixed: bool,
    /// True if a master adapts the data of the command automatically (`AdaptAutomatically`).
    pub adapt: bool,
    /// True if a module can replace the command.
    pub overwritten_by_module: bool,
    /// Purpose of the command.
    pub comment: CompactString,
    /// Location of the command in the source.
    pub origin: Origin,
}

/// Distributed clocks of an EtherCAT slave.
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
    /// Name of the mode.
    pub name: CompactString,
    /// Description of the mode.
    pub description: CompactString,
    /// Value of register 0x0980 (`AssignActivate`).
    pub assign_activate: u32,
    /// Cycle time of the signal SYNC0.
    pub cycle_sync0: ClockTime,
    /// Shift time of the signal SYNC0.
    pub shift_sync0: ClockTime,
    /// Cycle time of the signal SYNC1.
    pub cycle_sync1: ClockTime,
    /// Shift time of the signal SYNC1.
    pub shift_sync1: ClockTime,
    /// Settings of sync managers in this mode.
    pub sync_managers: Vec<ClockSyncManager>,
}

/// A cycle time or shift time of a clock mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClockTime {
    /// Time in nanoseconds. A cycle time of 0 means that a master calculates the time with [`ClockTime::factor`].
    pub nanoseconds: i32,
    /// Factor by which the cycle time is multiplied (for SYNC1, the cycle time of SYNC0); a negative number is a
    /// divisor.
    pub factor: Option<i32>,
    /// True if the shift is relative to the inputs.
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
    /// Indices of PDOs, and the oversampling factor of each PDO.
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
    /// Index increment of objects from slot to slot.
    pub index_increment: u16,
    /// Index increment of PDOs from slot to slot.
    pub pdo_increment: u16,
    /// Index increment of objects from slot group to slot group.
    pub group_index_increment: u16,
    /// Index increment of PDOs from slot group to slot group.
    pub group_pdo_increment: u16,
    /// True if a master writes the list of configured modules to 0xF030 (`DownloadModuleIdentList`).
    pub download_idents: bool,
    /// True if a master writes the list of module addresses (`DownloadModuleAddressList`).
    pub download_addresses: bool,
    /// State transition at which a master writes the lists; default `PS`.
    pub download_transition: CompactString,
    /// Groups of modules with contiguous process data.
    pub pdo_groups: Vec<ModulePdoGroup>,
    /// Numbers and names of slot groups.
    pub groups: Vec<(u16, CompactString)>,
    /// Names of module arrangements, and the ident numbers of the modules in each arrangement.
    pub selections: Vec<(CompactString, Vec<u32>)>,
}

/// Modules with contiguous process data (`ModulePdoGroup`).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModulePdoGroup {
    /// Alignment in bytes of the data of each module; 0 and 1 = no alignment.
    pub alignment: u16,
    /// Index of the device's RxPDO that precedes the RxPDOs of the modules, if given.
    pub rx_pdo: Option<u16>,
    /// Index of the device's TxPDO that precedes the TxPDOs of the modules, if given.
    pub tx_pdo: Option<u16>,
}

/// EEPROM content of a slave (ETG.1000.6 5.4, ETG.2010).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Eeprom {
    /// Complete EEPROM content, if the source contains it.
    pub data: Vec<u8>,
    /// Size of the EEPROM in bytes.
    pub byte_size: Option<u32>,
    /// First words of the EEPROM, which configure the slave controller.
    pub config_data: Vec<u8>,
    /// Mailbox configuration for the state "Bootstrap".
    pub boot_strap: Vec<u8>,
    /// Numbers and contents of further EEPROM categories.
    pub categories: Vec<(u16, Vec<u8>)>,
    /// True if the EEPROM is assigned to the process data interface (PDI).
    pub assign_to_pdi: bool,
}
