//! Modular devices: slots, and modules that can be plugged into them.

use super::{
    CompactString, Documentation, Extensions, Group, Identity, InitCommand, Item, Numbers, Places, ProcessData,
    SubmoduleUse, SubslotName, Texts, TypeDef,
};
use crate::source::Origin;

/// A place for modules.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slot {
    /// Its number, or first number.
    pub number: u16,
    /// Its name.
    pub name: CompactString,
    /// Least and greatest number of modules in it.
    pub instances: (u16, u16),
    /// The name in other languages.
    pub names: Texts,
    /// What fits; empty = all modules of the device.
    pub fits: Vec<Fit>,
    /// The module that is there by default.
    pub default: Option<Fit>,
    /// Number of the slot group, where it belongs to one.
    pub group: Option<u16>,
    /// What to add to the index of a module's objects per slot.
    pub index_increment: u16,
    /// What to add to the number of a module's PDOs per slot.
    pub pdo_increment: u16,
    /// What to add to the index of a module's objects per slot group.
    pub group_index_increment: u16,
    /// What to add to the number of a module's PDOs per slot group.
    pub group_pdo_increment: u16,
}

/// What fits into a slot.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Fit {
    /// The module with this ident number.
    Ident(u32),
    /// Every module of this class.
    Class(CompactString),
    /// The module that goes by this name.
    Name(CompactString),
}

/// Position of a [`Module`] in [`Catalog::modules`](super::Catalog::modules).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModuleId(pub u32);

/// A module, and the slots that it may or has to be in.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModuleUse {
    /// The module.
    pub module: ModuleId,
    /// The slots.
    pub places: Places,
}

/// A module of a modular device (`[M1ModuleInfo]` … of CiA 306, Module of ETG.2000, ModuleItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Module {
    /// Its number in the description, counted from 1 (CiA 306), or its ident number (ETG.2000, GSDML).
    pub number: u32,
    /// Its identifier in the source, where it has one (ID of a ModuleItem, Type of a Module).
    pub id: CompactString,
    /// The class that slots name (ModuleClass of ETG.2000).
    pub class: CompactString,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Its version, as the source spells it.
    pub version: CompactString,
    /// Its revision, as the source spells it.
    pub revision: CompactString,
    /// Order code and identity numbers.
    pub identity: Identity,
    /// Lines of comment.
    pub comments: Vec<CompactString>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Types that its objects name.
    pub types: Vec<TypeDef>,
    /// Objects that exist once however many such modules are plugged in.
    pub fixed_objects: Vec<Group>,
    /// Sub-indices that each such module adds to objects of the device.
    pub sub_extensions: Vec<SubExtension>,
    /// Objects of the module itself (ETG.2000), relative to its slot.
    pub groups: Vec<Group>,
    /// Its cyclic data, relative to its slot.
    pub process_data: ProcessData,
    /// Number of the group of modules whose process data are put together (ModulePdoGroup of ETG.2000).
    pub pdo_group: Option<u16>,
    /// What a master writes at start-up (ETG.2000).
    pub init_commands: Vec<InitCommand>,
    /// Submodules that it has, and those that can be plugged into it (GSDML).
    pub submodules: Vec<SubmoduleUse>,
    /// Subslots that there are (GSDML, PhysicalSubslots); empty = those of its own submodules.
    pub subslots: Numbers,
    /// Names of its subslots (GSDML, SubslotList).
    pub subslot_names: Vec<SubslotName>,
    /// Device profiles that it follows, by number.
    pub profiles: Vec<u32>,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
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
    /// With bit-wise packing: the sub-indices are added to every module of so many. `None` for plain counting.
    pub per: Option<u16>,
    /// Whether a full object is continued at the next index (ObjExtend).
    pub extends_object: bool,
    /// What each added sub-index looks like; its sub-index is 1.
    pub template: Item,
}
