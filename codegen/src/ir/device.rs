//! A device: identity, file header, bus settings, and what it consists of.

use super::{
    CodeTable, CompactString, Composite, Documentation, Doubts, EtherCatSettings, Extensions, Framing, Group, Item,
    Message, Module, ModuleUse, Procedure, ProcessData, ProfinetSettings, RegisterSpace, Slot, StateMachine,
    SubmoduleUse, Texts, TypeDef, Value,
};
use crate::source::{Origin, Span};

/// One device.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Device {
    /// What it is called.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Its identifier in the source, where it has one (ID of a device access point).
    pub id: CompactString,
    /// Whether the source describes no device, only a dictionary that devices refer to (EtherCATDict of ETG.2000).
    pub dictionary_only: bool,
    /// Who made it and which one it is.
    pub identity: Identity,
    /// What the file says about itself.
    pub header: Header,
    /// What the device can on CANopen.
    pub canopen: Option<Box<CanOpenSettings>>,
    /// What the device can on EtherCAT.
    pub ethercat: Option<Box<EtherCatSettings>>,
    /// What the device can on PROFINET.
    pub profinet: Option<Box<ProfinetSettings>>,
    /// What its tables of Modbus take, where the source says so.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub modbus: Vec<ModbusTable>,
    /// Frames of Modbus that the source prints: node, function and data, with or without the CRC.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub modbus_examples: Vec<super::MessageExample>,
    /// First and last of the numbers that a node, or a server, may have.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub node_ids: Option<(u8, u8)>,
    /// Device profiles that it follows, by number (402 = drives, 5001 = modular device).
    pub profiles: Vec<u32>,
    /// The place of this one device in a network (DCF, XDC).
    pub commissioning: Option<Box<Commissioning>>,
    /// Types that it defines.
    pub types: Vec<TypeDef>,
    /// Its chapters of registers, and then its objects, sorted by index.
    pub groups: Vec<Group>,
    /// Cyclic data.
    pub process_data: ProcessData,
    /// Slots of a modular device.
    pub slots: Vec<Slot>,
    /// Modules that can be plugged in.
    pub modules: Vec<ModuleUse>,
    /// Submodules of a device access point itself, and those that can be plugged into it.
    pub submodules: Vec<SubmoduleUse>,
    /// Request and reply frames of a command protocol.
    pub messages: Vec<Message>,
    /// Numbers by which the command protocol addresses items.
    pub parameter_spaces: Vec<super::ParameterSpace>,
    /// How frames of the command protocol are delimited and checked.
    pub framing: Option<Box<Framing>>,
    /// Numbers of the machine, of which units make use.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub given: Vec<super::GivenNumber>,
    /// Alarms, emergency codes, abort codes and the like.
    pub code_tables: Vec<CodeTable>,
    /// State machines.
    pub machines: Vec<StateMachine>,
    /// Sequences of steps.
    pub procedures: Vec<Procedure>,
    /// Numbers that are split over several items.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub composites: Vec<Composite>,
    /// Models and firmware versions that share this description.
    pub variants: Vec<Variant>,
    /// How the objects of further axes follow from those of the first.
    pub axes: Option<AxisRule>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// The manual that the description was transcribed from.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub manual: Option<Box<super::Manual>>,
    /// Contradictions of the source.
    pub doubts: Doubts,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
    pub origin: Origin,
}

impl Device {
    /// All items, group by group.
    pub fn items(&self) -> impl Iterator<Item = &Item> + Clone {
        self.groups.iter().flat_map(|group| &group.items)
    }

    /// The object with this index. The objects have to be sorted, and to stand behind groups that are none.
    pub fn object(&self, index: u16) -> Option<&Group> {
        let position = self.groups.binary_search_by_key(&Some(index), Group::index).ok()?;
        self.groups.get(position)
    }

    /// The modules that can be plugged in, of those of the catalogue.
    pub fn own_modules<'m>(&self, modules: &'m [Module]) -> impl Iterator<Item = &'m Module> + use<'m, '_> {
        self.modules.iter().filter_map(|own| modules.get(own.module.0 as usize))
    }

    /// The item at an index and sub-index: of an object, or a register that is an object too.
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

/// Who made a device and which one it is (object 0x1018, CiA 301 7.5.2.19).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Identity {
    /// Number of the vendor.
    pub vendor_id: Option<u32>,
    /// Name of the vendor.
    pub vendor_name: CompactString,
    /// Product code.
    pub product_code: Option<u32>,
    /// Name of the product.
    pub product_name: CompactString,
    /// Revision number.
    pub revision_number: Option<u32>,
    /// Order code.
    pub order_code: CompactString,
    /// Serial number, where the file is about one device.
    pub serial_number: Option<u32>,
    /// Ident number of a PROFINET device access point, or other identity numbers by name.
    pub others: Vec<(CompactString, u32)>,
}

/// The requests that a table of Modbus takes.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModbusTable {
    /// The table.
    pub space: RegisterSpace,
    /// Numbers of the functions; empty = not given.
    pub functions: Vec<u8>,
    /// The greatest number of registers, or bits, that one request reads.
    pub max_read: Option<u16>,
    /// The greatest number that one request writes.
    pub max_write: Option<u16>,
    /// Whether a value that is longer than that may be read and written in several requests.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub split: bool,
}

/// What a file says about itself (`[FileInfo]` of CiA 306, ISO15745 ProfileHeader). Texts are kept as written.
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
    /// Creation, time of day.
    pub creation_time: CompactString,
    /// Creation, date.
    pub creation_date: CompactString,
    /// Who created it.
    pub created_by: CompactString,
    /// Last change, time of day.
    pub modification_time: CompactString,
    /// Last change, date.
    pub modification_date: CompactString,
    /// Who changed it last.
    pub modified_by: CompactString,
    /// The EDS from which a DCF was made (LastEDS).
    pub last_eds: CompactString,
    /// Lines of `[Comments]`.
    pub comments: Vec<CompactString>,
}

/// What a device can on CANopen (`[DeviceInfo]`, `[DummyUsage]`, `[DynamicChannels]` of CiA 306).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CanOpenSettings {
    /// Supported bit rates in kbit/s.
    pub bit_rates: Vec<u16>,
    /// Whether it can detect the bit rate by itself.
    pub auto_bit_rate: bool,
    /// Whether it can be an NMT boot-up master.
    pub boot_up_master: bool,
    /// Whether it can be an NMT boot-up slave.
    pub boot_up_slave: bool,
    /// Granularity of PDO mapping in bits; 0 = mapping is fixed, `None` = not given.
    pub granularity: Option<u8>,
    /// Whether it supports dynamic channels (CiA 302-4), and how.
    pub dynamic_channels_supported: u32,
    /// Whether it supports multiplexed PDOs.
    pub group_messaging: bool,
    /// Number of RPDOs that the file announces.
    pub rx_pdos: Option<u16>,
    /// Number of TPDOs that the file announces.
    pub tx_pdos: Option<u16>,
    /// Whether it supports layer setting services.
    pub lss: bool,
    /// CompactPDO: which communication sub-indices an implicit PDO has; bit 0 is sub-index 1.
    pub compact_pdo: u8,
    /// Data types that may stand as dummy entries in a PDO mapping.
    pub dummies: Vec<u8>,
    /// Whether the file has a list of dummies at all.
    pub dummies_given: bool,
    /// Segments of dynamic channels.
    pub dynamic_channels: Vec<DynamicChannel>,
    /// Where its facts stand.
    pub at: CanOpenSpans,
}

/// Where facts of [`CanOpenSettings`] stand in the source; an empty span for what the source doesn't say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CanOpenSpans {
    /// The number of RPDOs.
    pub rx_pdos: Span,
    /// The number of TPDOs.
    pub tx_pdos: Span,
}

/// A segment of network variables (CiA 302-4).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DynamicChannel {
    /// Number of the data type.
    pub data_type: u32,
    /// Direction, as the source spells it.
    pub direction: CompactString,
    /// Range of indices, as the source spells it.
    pub range: CompactString,
    /// Offset in the process image.
    pub offset: i64,
    /// Difference between two channels in the process image, where given.
    pub difference: Option<i64>,
    /// Greatest number of channels, where given (CiA 311).
    pub max_number: Option<u32>,
}

/// The place of one device in a network (`[DeviceComissioning]` of CiA 306).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Commissioning {
    /// Node-ID, 1 to 127.
    pub node_id: Option<u8>,
    /// Name of the node.
    pub node_name: CompactString,
    /// Bit rate in kbit/s.
    pub bit_rate: Option<u16>,
    /// Number of the network.
    pub net_number: Option<u32>,
    /// Name of the network.
    pub network_name: CompactString,
    /// Whether it is the CANopen manager.
    pub manager: bool,
    /// Serial number for layer setting services.
    pub lss_serial_number: Option<u32>,
    /// Modules that are plugged in, by their number in the device description (`[ConnectedModules]`).
    pub connected_modules: Vec<u16>,
}

/// A model or firmware version of a family that shares one description.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Variant {
    /// Its name.
    pub name: CompactString,
    /// Its identity, where it differs.
    pub identity: Identity,
    /// Constants of the variant, by name (a base of scaled numbers).
    pub constants: Vec<(CompactString, Value)>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

/// How the items of further axes follow from those of the first.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisRule {
    /// Number of axes.
    pub axes: u8,
    /// Models that have so many; empty = all.
    pub models: Vec<CompactString>,
    /// Rules by range of index: the first that contains an item's index holds.
    pub rules: Vec<AxisRange>,
}

/// The rule for the objects of a range of indices.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisRange {
    /// First and last index.
    pub indices: (u16, u16),
    /// How to get to the next axis.
    pub step: AxisStep,
}

/// How to get from one axis to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum AxisStep {
    /// Add this to the index.
    Index(u16),
    /// The sub-index is the number of the axis.
    SubIndex,
    /// Add this to the sub-index.
    SubIndexStride(u8),
}
