//! Modular devices: slots and modules.

use std::sync::Arc;

use super::{
    CompactString, Documentation, Extensions, Group, Identity, InitCommand, Item, Mailbox, Numbers, ProcessData,
    SlotNumbers, SubmoduleUse, SubslotName, Texts, TypeDef,
};
use crate::source::Origin;

/// A slot for modules, or several consecutive slots with the same properties.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slot {
    /// Number of the first slot.
    pub number: u16,
    /// Name of the slot.
    pub name: CompactString,
    /// Minimum and maximum number of modules in the slot or slots.
    pub instances: (u16, u16),
    /// Name of the slot in other languages.
    pub names: Texts,
    /// Accepted modules; empty = all modules of the device.
    pub fits: Vec<Fit>,
    /// Module that the slot contains by default.
    pub default: Option<Fit>,
    /// Number of the slot group, if any.
    pub group: Option<u16>,
    /// Index increment of a module's objects per slot.
    pub index_increment: u16,
    /// Index increment of a module's PDOs per slot.
    pub pdo_increment: u16,
    /// Index increment of a module's objects per slot group.
    pub group_index_increment: u16,
    /// Index increment of a module's PDOs per slot group.
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
    /// Position of the module in the catalog.
    pub module: ModuleId,
    /// Slots that accept or contain the module.
    pub places: SlotNumbers,
}

/// A module of a modular device (`[M1ModuleInfo]` … of CiA 306, Module of ETG.2000, ModuleItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Module {
    /// Number of the module in the description, counted from 1 (CiA 306), or module ident number (ETG.2000, GSDML).
    pub number: u32,
    /// Identifier of the module in the source, if any (ID of a ModuleItem, Type of a Module).
    pub id: CompactString,
    /// Class of the module, to which slots refer (ModuleClass of ETG.2000).
    pub class: CompactString,
    /// Name of the module.
    pub name: CompactString,
    /// Name of the module in other languages.
    pub names: Texts,
    /// Version of the module as the source spells it.
    pub version: CompactString,
    /// Revision of the module as the source spells it.
    pub revision: CompactString,
    /// Order code and identity numbers of the module.
    pub identity: Identity,
    /// Comment lines about the module.
    pub comments: Vec<CompactString>,
    /// Description of the module from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Types of the module's objects.
    pub types: Vec<TypeDef>,
    /// Objects that exist only once, regardless of how many modules of this kind are connected.
    pub fixed_objects: Vec<Group>,
    /// Sub-indices that each connected module of this kind adds to objects of the device.
    pub sub_extensions: Vec<SubExtension>,
    /// Objects of the module, relative to its slot (ETG.2000).
    pub groups: Vec<Group>,
    /// Cyclic data of the module, relative to its slot.
    pub process_data: ProcessData,
    /// Number of the group of modules with contiguous process data (ModulePdoGroup of ETG.2000).
    pub pdo_group: Option<u16>,
    /// Mailbox protocols that the module adds or needs (Mailbox of ETG.2000).
    pub mailbox: Option<Box<Mailbox>>,
    /// Mode of the distributed clocks that the module needs (DcOpModeName of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub clock_mode: CompactString,
    /// Submodules of the module, and submodules that it accepts (GSDML).
    pub submodules: Vec<SubmoduleUse>,
    /// Physical subslots (GSDML, PhysicalSubslots); empty = the subslots of the module's submodules.
    pub subslots: Numbers,
    /// Names of subslots (GSDML, SubslotList).
    pub subslot_names: Vec<SubslotName>,
    /// Numbers of the device profiles that the module follows.
    pub profiles: Vec<u32>,
    /// Additional number of the profile, if given (AddInfo of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub add_info: Option<i32>,
    /// Further additional number of the profile, if given (SubAddInfo of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sub_add_info: Option<i32>,
    /// Further attributes of the module as the source spells them (GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub attributes: Vec<(CompactString, CompactString)>,
    /// Facts about the module that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the module in the source.
    pub origin: Origin,
}

impl Module {
    /// Returns the CoE commands that a master sends at state transitions.
    pub fn init_commands(&self) -> &[InitCommand] {
        let coe = self.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref());
        coe.map_or(&[], |coe| &coe.init_commands)
    }
}

/// Sub-indices that a module adds to an object (`[M<n>SubExt<index>]` of CiA 306).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SubExtension {
    /// Index of the object.
    pub index: u16,
    /// Number of sub-indices that the module adds; 0 if it adds bits to a common sub-index.
    pub count: u16,
    /// Number of bits that each module adds to a common sub-index; `None` = each module adds its own sub-indices.
    pub per: Option<u16>,
    /// True if the object at the next index contains the sub-indices that no longer fit into the object (ObjExtend).
    pub extends_object: bool,
    /// Template of each added sub-index. The template itself has sub-index 1.
    pub template: Item,
}
