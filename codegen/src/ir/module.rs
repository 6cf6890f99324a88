//! Modular devices: slots, and modules that can be plugged into them.

use serde::{Deserialize, Serialize};

use super::{CompactString, Extension, Group, Identity, Item, LocalText, ProcessData};
use crate::source::Origin;

/// A place for modules.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Slot {
    /// Its number, or first number.
    pub number: u16,
    /// Its name.
    pub name: CompactString,
    /// Least and greatest number of modules in it.
    pub instances: (u16, u16),
    /// Identity or class of the modules that fit; empty = all.
    pub fits: Vec<CompactString>,
    /// The module that is there by default.
    pub default: Option<CompactString>,
    /// What to add to the index of a module's objects per slot.
    pub index_increment: u16,
    /// What to add to the number of a module's PDOs per slot.
    pub pdo_increment: u16,
}

/// A module of a modular device (`[M1ModuleInfo]` … of CiA 306, Module of ETG.2000, ModuleItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Module {
    /// Its number in the description, counted from 1, or its identifier.
    pub number: u32,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Vec<LocalText>,
    /// Its version, as the source spells it.
    pub version: CompactString,
    /// Its revision, as the source spells it.
    pub revision: CompactString,
    /// Order code and identity numbers.
    pub identity: Identity,
    /// Lines of comment.
    pub comments: Vec<CompactString>,
    /// Objects that exist once however many such modules are plugged in.
    pub fixed_objects: Vec<Group>,
    /// Sub-indices that each such module adds to objects of the device.
    pub sub_extensions: Vec<SubExtension>,
    /// Objects of the module itself (ETG.2000), relative to its slot.
    pub groups: Vec<Group>,
    /// Its cyclic data.
    pub process_data: ProcessData,
    /// What the source says beyond that.
    pub extensions: Vec<Extension>,
    /// Where it is declared.
    pub origin: Origin,
}

/// Sub-indices that a module adds to an object (`[M<n>SubExt<index>]` of CiA 306).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
