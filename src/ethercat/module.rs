//! Modules and slots of a modular device.

use super::depends_on::DependsOn;
use super::mailbox::{InitCommand, Transitions};
use super::pdo::PdoInfo;

/// The slots of a modular device, and the modules that can be plugged into them (ETG.5001.1).
#[derive(Clone, Copy, Debug)]
pub struct Slots {
    /// The slots in ascending order of their numbers, which start at 0. Each entry describes a series of [`Slot::max`]
    /// slots.
    pub slots: &'static [Slot],
    /// The modules that can be plugged in.
    pub modules: &'static [&'static Module],
    /// Groups of modules in the order of the process image. If the list is empty, modules are ordered by slot.
    pub pdo_groups: &'static [PdoGroup],
    /// Transitions during which the master writes the module idents to 0xF030. The set is empty if the master doesn't
    /// write the module idents.
    pub download_idents: Transitions,
}

/// A slot, or a series of similar slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Name of the slot.
    pub name: &'static str,
    /// Minimum number of modules in the series.
    pub min: u16,
    /// Maximum number of modules in the series.
    pub max: u16,
    /// Rules for the modules that the slot accepts. If the list is empty, the slot accepts every module.
    pub fits: &'static [Fit],
    /// Ident of the default module, if there is one.
    pub default: Option<u32>,
    /// Increments of the slot-dependent indices per slot.
    pub increments: Increments,
    /// The slot group that the slot belongs to, if any.
    pub group: Option<SlotGroup>,
}

/// A slot group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotGroup {
    /// Number of the group.
    pub number: u16,
    /// Increments of the slot-dependent indices per slot group.
    pub increments: Increments,
}

/// Increments of object and PDO indices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Increments {
    /// Increment of the object indices of a module.
    pub index: u16,
    /// Increment of the PDO indices of a module.
    pub pdo: u16,
}

/// A rule for the modules that a slot accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The slot accepts the module with this ident.
    Ident(u32),
    /// The slot accepts every module of this class.
    Class(&'static str),
}

/// A group of modules whose process data are contiguous.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoGroup {
    /// Alignment of the group's process data in bytes; 0 if the data are not aligned.
    pub alignment: u16,
    /// Index of the RxPDO that pads the process data in front of the group, if there is one.
    pub rx_pdo: Option<u16>,
    /// Index of the TxPDO that pads the process data in front of the group, if there is one.
    pub tx_pdo: Option<u16>,
}

/// A module. Slot-dependent indices are given for slot 0 and slot group 0.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// Module ident.
    pub ident: u32,
    /// Name of the module.
    pub name: &'static str,
    /// Class of the module, used by [`Fit::Class`]; empty if the module has no class.
    pub class: &'static str,
    /// Index of the module's group in [`Slots::pdo_groups`].
    pub pdo_group: u16,
    /// PDOs of the module, output PDOs first.
    pub pdos: &'static [PdoInfo],
    /// Initialization commands of the module.
    pub init_commands: &'static [InitCommand],
    /// Ranges of slot-dependent objects. All other objects have the same index in every slot.
    pub objects: &'static [SlotObjects],
}

/// A range of objects whose indices depend on the slot or slot group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotObjects {
    /// First index.
    pub first: u16,
    /// Last index.
    pub last: u16,
    /// Slot dependency of the indices.
    pub depends_on: DependsOn,
}

impl Increments {
    /// Creates increments for objects and PDOs.
    #[must_use]
    pub const fn new(index: u16, pdo: u16) -> Self {
        Self { index, pdo }
    }
}

impl SlotGroup {
    /// Creates a slot group with this number and these increments.
    #[must_use]
    pub const fn new(number: u16, increments: Increments) -> Self {
        Self { number, increments }
    }
}

impl SlotObjects {
    /// Creates a range from `first` to `last`, both inclusive.
    #[must_use]
    pub const fn new(first: u16, last: u16, depends_on: DependsOn) -> Self {
        Self { first, last, depends_on }
    }
}

impl Module {
    /// Returns the slot dependency of an object index.
    #[must_use]
    pub fn depends_on(&self, index: u16) -> DependsOn {
        let range = self.objects.iter().find(|range| (range.first..=range.last).contains(&index));
        range.map_or(DependsOn::Nothing, |range| range.depends_on)
    }
}

impl Slot {
    /// Returns whether the slot accepts `module`.
    #[must_use]
    pub fn takes(&self, module: &Module) -> bool {
        let fits = |fit: &Fit| match fit {
            Fit::Ident(ident) => *ident == module.ident,
            Fit::Class(class) => !class.is_empty() && *class == module.class,
        };
        self.fits.is_empty() || self.fits.iter().any(fits)
    }
}
