//! What a PROFINET IO device can, and its submodules (GSDML).

use super::{CompactString, Documentation, Extensions, Group, Identity, Places, ProcessImage, Texts, TypeId};
use crate::source::Origin;

/// Position of a [`Submodule`] in [`Catalog::submodules`](super::Catalog::submodules).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubmoduleId(pub u32);

/// A device access point: what it can, and how a controller sets it up.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProfinetSettings {
    /// Module ident number of the device access point.
    pub ident: u32,
    /// Number that tells the devices of a vendor apart (`DeviceID`).
    pub device_id: u16,
    /// Main family and product family (`Family`).
    pub family: (CompactString, CompactString),
    /// Version of PROFINET that it follows (`PNIO_Version`).
    pub pnio_version: CompactString,
    /// Slots that there are.
    pub slots: super::Numbers,
    /// Name by which a new device answers (`DNS_CompatibleName`).
    pub dns_name: CompactString,
    /// Least interval between two frames in units of 31.25 µs (`MinDeviceInterval`).
    pub min_device_interval: Option<u16>,
    /// Greatest length of a record in bytes; 4068 where the source doesn't say.
    pub max_record_size: u32,
    /// Greatest number of application relations.
    pub relations: u16,
    /// Start-up modes (`Legacy`, `Advanced`).
    pub startup_modes: Vec<CompactString>,
    /// Greatest length in bytes of inputs, outputs, and both, provider and consumer status included.
    pub max_lengths: IoLengths,
    /// Send clock factors in units of 31.25 µs.
    pub send_clocks: super::Numbers,
    /// Reduction ratios, a power of two.
    pub reduction_ratios: super::Numbers,
    /// Slots in which the device access point itself may or has to be.
    pub places: Places,
    /// Names of its subslots (`SubslotList`).
    pub subslot_names: Vec<SubslotName>,
    /// What a controller may send when it connects (`ARVendorBlock`).
    pub vendor_blocks: Vec<VendorBlock>,
    /// Further attributes, as the source spells them; those of an element within it as `Element@Attribute`.
    pub attributes: Vec<(CompactString, CompactString)>,
}

/// The name of a subslot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubslotName {
    /// Its number.
    pub number: u16,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
}

/// A block of a vendor's data in the request that opens an application relation (`Request` of `ARVendorBlock`).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VendorBlock {
    /// API number.
    pub api: u32,
    /// Structure identifier (`APStructureIdentifier`).
    pub identifier: u16,
    /// Its fields, as those of a record whose index is the structure identifier.
    pub record: Group,
    /// Menus of an engineering tool.
    pub menus: Vec<Menu>,
}

/// Greatest lengths of the data that a device access point exchanges (`IOConfigData`), in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoLengths {
    /// Inputs of the controller.
    pub input: Option<u16>,
    /// Outputs of the controller.
    pub output: Option<u16>,
    /// Both together, where limited.
    pub data: Option<u16>,
}

/// A submodule: what has data, records and diagnosis.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Submodule {
    /// Its identifier in the source.
    pub id: CompactString,
    /// Submodule ident number.
    pub ident: u32,
    /// What kind of submodule it is.
    pub kind: SubmoduleKind,
    /// API number: 0, or that of a profile (0x3A00 PROFIdrive, 0x3E00 encoder).
    pub api: u32,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Order code and the like.
    pub identity: Identity,
    /// Inputs of the controller, where it has some.
    pub input: Option<Box<IoData>>,
    /// Outputs of the controller, where it has some.
    pub output: Option<Box<IoData>>,
    /// Length in bytes of the provider status, and of the consumer status.
    pub status_lengths: (u8, u8),
    /// Parameter records, in the order of transfer.
    pub records: Vec<Group>,
    /// The parameters of functional safety, where it has them.
    pub f_parameters: Option<Box<FParameters>>,
    /// Menus of an engineering tool.
    pub menus: Vec<Menu>,
    /// Pictures, by kind.
    pub graphics: Vec<(CompactString, CompactString)>,
    /// Whether it may be pulled while the device runs; and further attributes, as the source spells them.
    pub attributes: Vec<(CompactString, CompactString)>,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
    pub origin: Origin,
}

/// Kinds of submodules.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SubmoduleKind {
    /// Part of a module, at fixed subslots.
    #[default]
    Virtual,
    /// Plugged into a subslot.
    Pluggable,
    /// A PROFINET interface, at subslot 0x8000, 0x8100, ….
    Interface,
    /// A port, at subslot 0x8001, ….
    Port,
}

/// Data of one direction.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoData {
    /// Layout of the data; `overhead` counts the bytes of an F message trailer.
    pub image: ProcessImage,
    /// Whether all items have to be consistent with each other.
    pub consistent: bool,
    /// Data items that aren't one field of the image each, in their order; every other field is a data item.
    pub items: Vec<IoItem>,
    /// Channels (V2.45), by number.
    pub channels: Vec<IoChannel>,
}

/// A data item that became several fields (bits, a value with its status), or none (an F message trailer).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoItem {
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Its data type, as the source spells it.
    pub data_type: CompactString,
    /// First bit, counted from the start of the data.
    pub bit_offset: u32,
    /// Number of bits.
    pub bits: u32,
    /// Position of its first field in the image.
    pub first_field: u32,
    /// Number of its fields, padding included.
    pub fields: u32,
    /// Whether it belongs to the item before it (`Subordinate`).
    pub subordinate: bool,
}

/// A channel of V2.45: which bits belong to it, and which bits tell their quality.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoChannel {
    /// Its number.
    pub number: u16,
    /// First bit and number of bits of its value, counted from the start of the data, where given.
    pub data: Option<(u32, u32)>,
    /// First bit and number of bits of its quality, where given.
    pub quality: Option<(u32, u32)>,
    /// What the quality is (`Format`), as the source spells it.
    pub quality_format: CompactString,
    /// Further attributes, as the source spells them.
    pub attributes: Vec<(CompactString, CompactString)>,
}

/// The F-parameter record of PROFIsafe.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FParameters {
    /// Index of the record.
    pub index: u16,
    /// Order of transfer at start-up.
    pub transfer_sequence: u16,
    /// Checksum over the description of the F-parameters (`F_ParamDescCRC`).
    pub description_crc: Option<u16>,
    /// Each parameter with its default and what is allowed, in the order of the record.
    pub parameters: Vec<FParameter>,
    /// Where it is declared.
    pub origin: Origin,
}

/// One F-parameter.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FParameter {
    /// Its name (`F_Check_iPar`, `F_SIL`, `F_Source_Add`, …).
    pub name: CompactString,
    /// Its value by default as a number.
    pub default: i128,
    /// Its value by default as the source spells it (`SIL3`, `3-Byte-CRC`), where that is no number.
    pub label: CompactString,
    /// First and last of each range of allowed values; empty = all.
    pub allowed: Vec<(i128, i128)>,
    /// The labels that are allowed, where the values have names.
    pub allowed_labels: Vec<CompactString>,
    /// Whether a user may change it.
    pub changeable: bool,
    /// Whether a tool shows it.
    pub visible: bool,
}

/// A menu of an engineering tool: parameters and further menus.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Menu {
    /// Its identifier.
    pub id: CompactString,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Identifiers of parameters and menus, in order.
    pub targets: Vec<CompactString>,
}

/// A submodule, and the subslots it may or has to be in.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubmoduleUse {
    /// The submodule.
    pub submodule: SubmoduleId,
    /// The subslots.
    pub places: Places,
}

/// A picture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Graphic {
    /// Its identifier.
    pub id: CompactString,
    /// Name of its file, without ending.
    pub file: CompactString,
}

/// Diagnosis of a user structure (`UnitDiagTypeItem`): the fields that follow a user structure identifier.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnitDiagnosis {
    /// API number.
    pub api: u32,
    /// User structure identifier.
    pub identifier: u16,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Its fields.
    pub fields: Vec<UnitDiagnosisField>,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
    pub origin: Origin,
}

/// A field of a user structure.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnitDiagnosisField {
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// First bit, counted from the first of the structure.
    pub bit_offset: u32,
    /// Number of bits.
    pub bits: u32,
    /// Its type.
    pub ty: super::Type,
    /// The enumeration of its values, where it has one.
    pub values: Option<TypeId>,
    /// The value that it has where the structure is meant, or by default.
    pub default: Option<super::Value>,
}
