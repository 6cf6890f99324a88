//! Devices: identity, file header, bus settings, models and axes.

use std::sync::Arc;

use super::{
    CodeTable, CompactString, Composite, Documentation, Doubts, EtherCatSettings, Extensions, FactOrigin, Framing,
    Group, Item, Message, Module, ModuleUse, Procedure, ProcessData, ProfinetSettings, RegisterSpace, Slot,
    StateMachine, SubmoduleUse, Texts, TypeDef, Value,
};
use crate::source::{Origin, Span};

/// A device that a file describes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Device {
    /// Name of the device.
    pub name: CompactString,
    /// Name of the device in other languages.
    pub names: Texts,
    /// Identifier of the device in the source, if any (ID of a device access point).
    pub id: CompactString,
    /// True if the description contains only a dictionary that devices share, and no device (EtherCATDict of ETG.2000).
    pub dictionary_only: bool,
    /// Identity: vendor, product and revision.
    pub identity: Identity,
    /// Header of the description file.
    pub header: Header,
    /// Settings of the device on CANopen.
    pub canopen: Option<Box<CanOpenSettings>>,
    /// Settings of the device on EtherCAT.
    pub ethercat: Option<Box<EtherCatSettings>>,
    /// Settings of the device on PROFINET.
    pub profinet: Option<Box<ProfinetSettings>>,
    /// Requests that the device accepts for each Modbus table, if the source states them.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub modbus: Vec<ModbusTable>,
    /// Example Modbus frames in the source: node address, function code and data, with or without CRC.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub modbus_examples: Vec<super::MessageExample>,
    /// Node-ID range, or range of Modbus server addresses: first and last number.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub node_ids: Option<(u8, u8)>,
    /// Numbers of the device profiles that the device follows (402 = drives, 5001 = modular device).
    pub profiles: Vec<u32>,
    /// Network settings, if the file configures a single device (DCF, XDC).
    pub commissioning: Option<Box<Commissioning>>,
    /// Types that the device defines.
    pub types: Vec<TypeDef>,
    /// Groups without an index, such as chapters of registers, followed by objects sorted by index.
    pub groups: Vec<Group>,
    /// Cyclic data of the device.
    pub process_data: ProcessData,
    /// Slots of a modular device.
    pub slots: Vec<Slot>,
    /// Modules that the device accepts.
    pub modules: Vec<ModuleUse>,
    /// Submodules of a device access point, and submodules that it accepts.
    pub submodules: Vec<SubmoduleUse>,
    /// Messages of a command protocol.
    pub messages: Vec<Message>,
    /// Parameter spaces of the command protocol.
    pub parameter_spaces: Vec<super::ParameterSpace>,
    /// Framing of the command protocol: delimiters, escapes and checksum.
    pub framing: Option<Box<Framing>>,
    /// Machine constants that unit conversions use.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub given: Vec<super::GivenNumber>,
    /// Code tables, such as alarms, emergency codes and abort codes.
    pub code_tables: Vec<CodeTable>,
    /// State machines of the device.
    pub machines: Vec<StateMachine>,
    /// Procedures of the device.
    pub procedures: Vec<Procedure>,
    /// Numbers that are split over several items.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub composites: Vec<Composite>,
    /// Models and firmware versions that share this description.
    pub variants: Vec<Variant>,
    /// Rules that derive the objects of further axes from those of the first axis.
    pub axes: Option<AxisRule>,
    /// Description of the device from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Manual that the description was transcribed from.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub manual: Option<Box<super::Manual>>,
    /// Ambiguities in the source about the device as a whole or the options of its register table, with the assumptions made.
    pub doubts: Doubts,
    /// Facts about the device that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the device in the source.
    pub origin: Origin,
}

impl Device {
    /// Returns all items, group by group.
    pub fn items(&self) -> impl Iterator<Item = &Item> + Clone {
        self.groups.iter().flat_map(|group| &group.items)
    }

    /// Returns the object with this index. The objects must be sorted by index, and must follow all other groups.
    pub fn object(&self, index: u16) -> Option<&Group> {
        let position = self.groups.binary_search_by_key(&Some(index), Group::index).ok()?;
        self.groups.get(position)
    }

    /// Returns the modules that the device accepts. `modules` contains all modules of the catalog.
    pub fn accepted_modules<'m>(&self, modules: &'m [Module]) -> impl Iterator<Item = &'m Module> + use<'m, '_> {
        self.modules.iter().filter_map(|accepted| modules.get(accepted.module.0 as usize))
    }

    /// Returns the item at an index and sub-index. The item is a value of an object, or a register with an object
    /// address if the device has no object with this index.
    pub fn entry(&self, index: u16, sub_index: u8) -> Option<&super::Item> {
        match self.object(index) {
            Some(object) => object.sub(sub_index),
            None => {
                let others = self.groups.iter().take_while(|group| group.index().is_none());
                others.flat_map(|group| &group.items).find(|item| item.object() == Some((index, sub_index)))
            }
        }
    }
}

/// Identity of a device: vendor, product and revision (object 0x1018, CiA 301 7.5.2.21).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Identity {
    /// Vendor ID of the device (sub-index 1).
    pub vendor_id: Option<u32>,
    /// Name of the vendor.
    pub vendor_name: CompactString,
    /// Product code of the device (sub-index 2).
    pub product_code: Option<u32>,
    /// Name of the product.
    pub product_name: CompactString,
    /// Revision number of the device (sub-index 3).
    pub revision_number: Option<u32>,
    /// Order code of the product.
    pub order_code: CompactString,
    /// Serial number, if the file describes a single device.
    pub serial_number: Option<u32>,
    /// Further identity numbers with their names, such as the module ident number of a PROFINET device access point.
    pub others: Vec<(CompactString, u32)>,
    /// Origins of the numbers that do not come from the header of the description.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub origins: Vec<(IdentityNumber, FactOrigin)>,
}

/// A number in the identity object 0x1018.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum IdentityNumber {
    /// Vendor ID (sub-index 1).
    VendorId,
    /// Product code (sub-index 2).
    ProductCode,
    /// Revision number (sub-index 3).
    RevisionNumber,
}

impl IdentityNumber {
    /// All identity numbers.
    pub const ALL: [IdentityNumber; 3] =
        [IdentityNumber::VendorId, IdentityNumber::ProductCode, IdentityNumber::RevisionNumber];

    /// Returns the name of the identity number.
    pub fn name(self) -> &'static str {
        match self {
            IdentityNumber::VendorId => "vendor ID",
            IdentityNumber::ProductCode => "product code",
            IdentityNumber::RevisionNumber => "revision number",
        }
    }
}

impl Identity {
    /// Returns the vendor ID, product code or revision number; `None` = not given.
    pub fn number(&self, number: IdentityNumber) -> Option<u32> {
        match number {
            IdentityNumber::VendorId => self.vendor_id,
            IdentityNumber::ProductCode => self.product_code,
            IdentityNumber::RevisionNumber => self.revision_number,
        }
    }
}

/// The requests that a device accepts for one Modbus table.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModbusTable {
    /// The Modbus table.
    pub space: RegisterSpace,
    /// Function codes that the device accepts for the table; empty = not given.
    pub functions: Vec<u8>,
    /// Maximum number of registers, coils or discrete inputs that one request reads.
    pub max_read: Option<u16>,
    /// Maximum number of registers or coils that one request writes.
    pub max_write: Option<u16>,
    /// True if a value that is too long for one request can be read or written with several requests.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub split: bool,
}

/// Header of a description file (`[FileInfo]` of CiA 306, attributes of ProfileBody in CiA 311), with its texts
/// unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Header {
    /// Name of the file.
    pub file_name: CompactString,
    /// Version of the file.
    pub file_version: CompactString,
    /// Revision of the file.
    pub file_revision: CompactString,
    /// Version of the format (EDSVersion); empty = not given.
    pub format_version: CompactString,
    /// Description of the file.
    pub description: CompactString,
    /// Time at which the file was created.
    pub creation_time: CompactString,
    /// Date on which the file was created.
    pub creation_date: CompactString,
    /// Author of the file.
    pub created_by: CompactString,
    /// Time of the last modification.
    pub modification_time: CompactString,
    /// Date of the last modification.
    pub modification_date: CompactString,
    /// Author of the last modification.
    pub modified_by: CompactString,
    /// File name of the EDS that the DCF is based on (LastEDS).
    pub last_eds: CompactString,
    /// Lines of the section `[Comments]`.
    pub comments: Vec<CompactString>,
}

/// Capabilities of a device on CANopen (`[DeviceInfo]`, `[DummyUsage]`, `[DynamicChannels]` of CiA 306).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CanOpenSettings {
    /// Supported bit rates in kbit/s.
    pub bit_rates: Vec<u16>,
    /// True if the device detects the bit rate automatically.
    pub auto_bit_rate: bool,
    /// True if the device can be an NMT boot-up master.
    pub boot_up_master: bool,
    /// True if the device can be an NMT boot-up slave.
    pub boot_up_slave: bool,
    /// Granularity of the PDO mapping in bits; 0 = fixed mapping, `None` = not given.
    pub granularity: Option<u8>,
    /// Support of dynamic channels (CiA 302-4); 0 = not supported.
    pub dynamic_channels_supported: u32,
    /// True if the device supports multiplexed PDOs.
    pub group_messaging: bool,
    /// Number of RPDOs that the file states (NrOfRXPDO).
    pub rx_pdos: Option<u16>,
    /// Number of TPDOs that the file states (NrOfTXPDO).
    pub tx_pdos: Option<u16>,
    /// True if the device supports layer setting services (LSS).
    pub lss: bool,
    /// Mask of the sub-indices that communication objects of implicit PDOs have (CompactPDO); bit 0 is sub-index 1.
    pub compact_pdo: u8,
    /// Data types that are allowed as dummy entries in a PDO mapping.
    pub dummies: Vec<u8>,
    /// True if the file has a list of dummy entries.
    pub dummies_given: bool,
    /// Segments of dynamic channels.
    pub dynamic_channels: Vec<DynamicChannel>,
    /// Locations of the settings in the source.
    pub at: CanOpenSpans,
}

/// Locations of [`CanOpenSettings`] in the source. Spans of missing settings are empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CanOpenSpans {
    /// Location of the number of RPDOs (NrOfRXPDO).
    pub rx_pdos: Span,
    /// Location of the number of TPDOs (NrOfTXPDO).
    pub tx_pdos: Span,
}

/// A segment of dynamic channels: network variables with the same data type and direction (CiA 302-4).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DynamicChannel {
    /// Code of the data type.
    pub data_type: u32,
    /// Direction as the source spells it.
    pub direction: CompactString,
    /// Range of indices as an EDS spells it; for CiA 311, in the form `0xA080-0xA0BF`.
    pub range: CompactString,
    /// Offset in the process image.
    pub offset: i64,
    /// Distance between two channels in the process image, if given.
    pub difference: Option<i64>,
    /// Maximum number of channels, if given (CiA 311).
    pub max_number: Option<u32>,
}

/// Network settings of a single device (`[DeviceComissioning]` of CiA 306).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Commissioning {
    /// Node-ID of the device, from 1 to 127.
    pub node_id: Option<u8>,
    /// Name of the node.
    pub node_name: CompactString,
    /// Bit rate of the network in kbit/s.
    pub bit_rate: Option<u16>,
    /// Number of the network.
    pub net_number: Option<u32>,
    /// Name of the network.
    pub network_name: CompactString,
    /// True if the node is the CANopen manager.
    pub manager: bool,
    /// Serial number for layer setting services (LSS).
    pub lss_serial_number: Option<u32>,
    /// Connected modules, as numbers of modules in the device description (`[ConnectedModules]`).
    pub connected_modules: Vec<u16>,
}

/// A model or firmware version of a device family whose members share one description.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Variant {
    /// Name of the variant.
    pub name: CompactString,
    /// Identity of the variant, without the facts that all variants share, such as the vendor.
    pub identity: Identity,
    /// Names and values of the variant's constants, such as base values of fractions.
    pub constants: Vec<(CompactString, Value)>,
    /// Description of the variant from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the variant, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Location of the variant in the source.
    pub origin: Origin,
}

/// Rules that derive the items of further axes from those of the first axis.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisRule {
    /// Number of axes of the device.
    pub axes: u8,
    /// Models with this number of axes; empty = all.
    pub models: Vec<CompactString>,
    /// Rules for ranges of indices. The first range that contains the index of an item applies.
    pub rules: Vec<AxisRange>,
}

/// The rule for the objects in a range of indices.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisRange {
    /// First and last index of the range.
    pub indices: (u16, u16),
    /// Difference between the address of an object on one axis and on the next axis.
    pub step: AxisStep,
}

/// The difference between the address of an object on one axis and on the next axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum AxisStep {
    /// From axis to axis, the index increases by this number.
    Index(u16),
    /// The sub-index is the number of the axis.
    SubIndex,
    /// From axis to axis, the sub-index increases by this number.
    SubIndexStride(u8),
}
