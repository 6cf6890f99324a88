//! Modular devices: slots and modules.

use super::{
    CompactString, Documentation, Extensions, Group, Identity, InitCommand, Item, Numbers, ProcessData, SlotNumbers,
    SubmoduleUse, SubslotName, Texts, TypeDef,
};
use crate::source::Origin;

/// A slot for modules, or several equal slots.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slot {
    /// Number of the first slot.
    pub number: u16,
    /// Name.
    pub name: CompactString,
    /// Minimum and maximum number of modules.
    pub instances: (u16, u16),
    /// Name in other languages.
    pub names: Texts,
    /// Accepted modules; empty = all modules of the device.
    pub fits: Vec<Fit>,
    /// Default module.
    pub default: Option<Fit>,
    /// Number of the slot group, if any.
    pub group: Option<u16>,
    /// Increment of the index of a module's objects per slot.
    pub index_increment: u16,
    /// Increment of the number of a module's PDOs per slot.
    pub pdo_increment: u16,
    /// Increment of the index of a module's objects per slot group.
    pub group_index_increment: u16,
    /// Increment of the number of a module's PDOs per slot group.
    pub group_pdo_increment: u16,
}

/// Modules that a slot accepts.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Fit {
    /// The module with this ident number.
    Ident(u32),
    /// All modules of this class.
    Class(CompactString),
    /// The module with this name.
    Name(CompactString),
}

/// Position of a [`Module`] in [`Catalog::modules`](super::Catalog::modules).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModuleId(pub u32);

/// A module, and the slots that accept or contain it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModuleUse {
    /// The module.
    pub module: ModuleId,
    /// The slots.
    pub places: SlotNumbers,
}

/// A module of a modular device (`[M1ModuleInfo]` … of CiA 306, Module of ETG.2000, ModuleItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Module {
    /// Number in the description, counted from 1 (CiA 306), or module ident number (ETG.2000, GSDML).
    pub number: u32,
    /// Identifier in the source, if any (ID of a ModuleItem, Type of a Module).
    pub id: CompactString,
    /// Class to which slots refer (ModuleClass of ETG.2000).
    pub class: CompactString,
    /// Name.
    pub name: CompactString,
    /// Name in other languages.
    pub names: Texts,
    /// Version as the source spells it.
    pub version: CompactString,
    /// Revision as the source spells it.
    pub revision: CompactString,
    /// Order code and identity numbers.
    pub identity: Identity,
    /// Lines of comments.
    pub comments: Vec<CompactString>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Types of its objects.
    pub types: Vec<TypeDef>,
    /// Objects that exist once for any number of these modules.
    pub fixed_objects: Vec<Group>,
    /// Sub-indices that each of these modules adds to objects of the device.
    pub sub_extensions: Vec<SubExtension>,
    /// Objects of the module, relative to its slot (ETG.2000).
    pub groups: Vec<Group>,
    /// Cyclic data, relative to its slot.
    pub process_data: ProcessData,
    /// Number of the group of modules with contiguous process data (ModulePdoGroup of ETG.2000).
    pub pdo_group: Option<u16>,
    /// Commands that a master sends at start-up (ETG.2000).
    pub init_commands: Vec<InitCommand>,
    /// Submodules of the module, and submodules that it accepts (GSDML).
    pub submodules: Vec<SubmoduleUse>,
    /// Physical subslots (GSDML, PhysicalSubslots); empty = the subslots of its submodules.
    pub subslots: Numbers,
    /// Names of subslots (GSDML, SubslotList).
    pub subslot_names: Vec<SubslotName>,
    /// Numbers of its device profiles.
    pub profiles: Vec<u32>,
    /// Facts of the source without a field in the IR.
    pub extensions: Extensions,
    /// Location in the source.
    pub origin: Origin,
}

/// Sub-indices that a module adds to an object (`[M<n>SubExt<index>]` of CiA 306).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubExtension {
    /// Index of the object.
    pub index: u16,
    /// Number of sub-indices that the module adds.
    pub count: u16,
    /// Number of modules that share one set of sub-indices, with bit-wise packing; `None` = each module adds the sub-indices.
    pub per: Option<u16>,
    /// Whether the object at the next index continues a full object (ObjExtend).
    pub extends_object: bool,
    /// Template of each added sub-index. Its sub-index is 1.
    pub template: Item,
}
