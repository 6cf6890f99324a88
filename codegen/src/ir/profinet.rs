//! Capabilities of PROFINET IO devices, and submodules (GSDML).

use std::sync::Arc;

use super::{CompactString, Documentation, Extensions, Group, Identity, ProcessImage, SlotNumbers, Texts, TypeId};
use crate::source::Origin;

/// Position of a [`Submodule`] in [`Catalog::submodules`](super::Catalog::submodules).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubmoduleId(pub u32);

/// Capabilities of a device access point, and settings for its controller.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProfinetSettings {
    /// Module ident number of the device access point.
    pub ident: u32,
    /// Device ID, unique among the devices of the vendor (`DeviceID`).
    pub device_id: u16,
    /// Main family and product family (`Family`).
    pub family: (CompactString, CompactString),
    /// Supported PROFINET version (`PNIO_Version`).
    pub pnio_version: CompactString,
    /// Numbers of the physical slots (`PhysicalSlots`).
    pub slots: super::Numbers,
    /// Initial name of station (`DNS_CompatibleName`).
    pub dns_name: CompactString,
    /// Minimum interval between two frames in units of 31.25 µs (`MinDeviceInterval`).
    pub min_device_interval: Option<u16>,
    /// Maximum length of a record in bytes; 4068 if the source states no maximum.
    pub max_record_size: u32,
    /// Maximum number of application relations.
    pub relations: u16,
    /// Start-up modes (`Legacy`, `Advanced`).
    pub startup_modes: Vec<CompactString>,
    /// Maximum lengths of inputs and outputs, including provider and consumer status.
    pub max_lengths: IoLengths,
    /// Supported send clocks as multiples of 31.25 µs (send clock factors).
    pub send_clocks: super::Numbers,
    /// Reduction ratios, each a power of two.
    pub reduction_ratios: super::Numbers,
    /// Slots that accept or contain the device access point.
    pub places: SlotNumbers,
    /// Names of subslots (`SubslotList`).
    pub subslot_names: Vec<SubslotName>,
    /// Vendor-specific blocks of the connect request (`ARVendorBlock`).
    pub vendor_blocks: Vec<VendorBlock>,
    /// Further attributes as the source spells them. Attributes of child elements have keys like `Element@Attribute`.
    pub attributes: Vec<(CompactString, CompactString)>,
}

/// Number and name of a subslot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubslotName {
    /// Number of the subslot.
    pub number: u16,
    /// Name of the subslot.
    pub name: CompactString,
    /// Name of the subslot in other languages.
    pub names: Texts,
}

/// A vendor-specific block of the request that opens an application relation (`Request` of `ARVendorBlock`).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VendorBlock {
    /// API number of the block.
    pub api: u32,
    /// Structure identifier (`APStructureIdentifier`).
    pub identifier: u16,
    /// Fields of the block, as a record whose index is the structure identifier.
    pub record: Group,
    /// Menus in which an engineering tool shows the fields.
    pub menus: Vec<Menu>,
}

/// Maximum lengths of the cyclic data of a device access point in bytes (`IOConfigData`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoLengths {
    /// Maximum length of the controller's inputs.
    pub input: Option<u16>,
    /// Maximum length of the controller's outputs.
    pub output: Option<u16>,
    /// Maximum sum of the lengths of inputs and outputs, if limited.
    pub data: Option<u16>,
}

/// A submodule, which has data, records and diagnosis.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Submodule {
    /// Identifier of the submodule in the source.
    pub id: CompactString,
    /// Ident number of the submodule.
    pub ident: u32,
    /// Kind of the submodule.
    pub kind: SubmoduleKind,
    /// API number: 0, or the number of a profile (0x3A00 PROFIdrive, 0x3E00 encoder).
    pub api: u32,
    /// Name of the submodule.
    pub name: CompactString,
    /// Name of the submodule in other languages.
    pub names: Texts,
    /// Description of the submodule from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Order code and vendor name of the submodule; empty if the source does not state them for the submodule.
    pub identity: Identity,
    /// Cyclic inputs of the controller, if any.
    pub input: Option<Box<IoData>>,
    /// Cyclic outputs of the controller, if any.
    pub output: Option<Box<IoData>>,
    /// Lengths of provider status and consumer status in bytes.
    pub status_lengths: (u8, u8),
    /// Parameter records, in the order of transfer.
    pub records: Vec<Group>,
    /// F-parameters, if the submodule is a safety submodule.
    pub f_parameters: Option<Box<FParameters>>,
    /// Menus in which an engineering tool shows the parameters.
    pub menus: Vec<Menu>,
    /// Types and identifiers of the submodule's pictures.
    pub graphics: Vec<(CompactString, CompactString)>,
    /// Further attributes as the source spells them, for example whether the submodule may be removed during operation.
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Facts about the submodule that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the submodule in the source.
    pub origin: Origin,
}

/// The kind of a submodule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SubmoduleKind {
    /// A submodule that is a part of a module, at fixed subslots.
    #[default]
    Virtual,
    /// A submodule that is plugged into a subslot.
    Pluggable,
    /// A PROFINET interface, at subslot 0x8000, 0x8100, ….
    Interface,
    /// A port, at subslot 0x8001, ….
    Port,
}

/// Cyclic data of a submodule in one direction.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoData {
    /// Layout of the data. `overhead` is the length of the trailer of a PROFIsafe message.
    pub image: ProcessImage,
    /// True if all data items are transferred as one consistent block.
    pub consistent: bool,
    /// Data items that are subordinate, have named bits, or do not consist of exactly one field of the image, in order. Every other
    /// field of the image is a separate data item.
    pub items: Vec<IoItem>,
    /// Channels, sorted by number (GSDML V2.45).
    pub channels: Vec<IoChannel>,
}

/// A data item that is subordinate, has named bits, consists of several fields of the image (a value with its status), or has no
/// field (the trailer of a PROFIsafe message).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoItem {
    /// Name of the data item.
    pub name: CompactString,
    /// Name of the data item in other languages.
    pub names: Texts,
    /// Data type as the source spells it.
    pub data_type: CompactString,
    /// Bit offset from the start of the data.
    pub bit_offset: u32,
    /// Length of the data item in bits.
    pub bits: u32,
    /// Position of the data item's first field in the list of fields.
    pub first_field: u32,
    /// Number of the data item's fields, including padding.
    pub fields: u32,
    /// True if the data item is a part of the previous item (`Subordinate`).
    pub subordinate: bool,
}

/// A channel of GSDML V2.45: the bits of its value and its quality.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoChannel {
    /// Number of the channel.
    pub number: u16,
    /// Bit offset and number of bits of the value, if given.
    pub data: Option<(u32, u32)>,
    /// Bit offset and number of bits of the quality, if given.
    pub quality: Option<(u32, u32)>,
    /// Format of the quality as the source spells it (`Format`).
    pub quality_format: CompactString,
    /// Further attributes as the source spells them.
    pub attributes: Vec<(CompactString, CompactString)>,
}

/// The F-parameter record of PROFIsafe.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FParameters {
    /// Index of the record.
    pub index: u16,
    /// Position of the record in the order of transfer at start-up.
    pub transfer_sequence: u16,
    /// Checksum over the description of the F-parameters (`F_ParamDescCRC`).
    pub description_crc: Option<u16>,
    /// F-parameters in the order of the record.
    pub parameters: Vec<FParameter>,
    /// Location of the record in the source.
    pub origin: Origin,
}

/// A parameter in the F-parameter record of PROFIsafe.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FParameter {
    /// Name of the parameter (`F_Check_iPar`, `F_SIL`, `F_Source_Add`, …).
    pub name: CompactString,
    /// Default value as a number.
    pub default: i128,
    /// Name of the default value in the source (`SIL3`, `3-Byte-CRC`); empty if the source states a number.
    pub label: CompactString,
    /// Minimum and maximum of each allowed range; empty = all values.
    pub allowed: Vec<(i128, i128)>,
    /// Names of the allowed values, if values have names.
    pub allowed_labels: Vec<CompactString>,
    /// True if users can change the parameter in the engineering tool.
    pub changeable: bool,
    /// True if engineering tools show the parameter.
    pub visible: bool,
}

/// A menu of an engineering tool: parameters and further menus.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Menu {
    /// Identifier of the menu.
    pub id: CompactString,
    /// Name of the menu.
    pub name: CompactString,
    /// Name of the menu in other languages.
    pub names: Texts,
    /// Identifiers of the parameters and menus that the menu contains, in order.
    pub targets: Vec<CompactString>,
}

/// A submodule, and the subslots that accept or contain it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubmoduleUse {
    /// Position of the submodule in the catalog.
    pub submodule: SubmoduleId,
    /// Subslots that accept or contain the submodule.
    pub places: SlotNumbers,
}

/// A picture of devices or modules.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Graphic {
    /// Identifier of the picture.
    pub id: CompactString,
    /// Name of the picture file without extension.
    pub file: CompactString,
}

/// Layout of vendor-specific diagnosis data (`UnitDiagTypeItem`): the fields after the user structure identifier.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnitDiagnosis {
    /// API number of the structure.
    pub api: u32,
    /// Identifier of the user structure.
    pub identifier: u16,
    /// Name of the structure.
    pub name: CompactString,
    /// Name of the structure in other languages.
    pub names: Texts,
    /// Description of the structure from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Fields of the structure.
    pub fields: Vec<UnitDiagnosisField>,
    /// Facts about the structure that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the structure in the source.
    pub origin: Origin,
}

/// A field of a user structure.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnitDiagnosisField {
    /// Name of the field.
    pub name: CompactString,
    /// Name of the field in other languages.
    pub names: Texts,
    /// Bit offset from the start of the structure.
    pub bit_offset: u32,
    /// Length of the field in bits.
    pub bits: u32,
    /// Type of the field.
    pub ty: super::Type,
    /// Enumeration of the field's values, if it has one.
    pub values: Option<TypeId>,
    /// Default value of the field, or the value that identifies the structure.
    pub default: Option<super::Value>,
}
