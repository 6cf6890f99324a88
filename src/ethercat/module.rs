//! Slots of a modular device, and modules.

use super::depends_on::DependsOn;
use super::mailbox::{InitCommand, Transitions};
use super::pdo::PdoInfo;

/// How the slots of a modular device are counted, and what fits into them (ETG.5001.1).
#[derive(Clone, Copy, Debug)]
pub struct Slots {
    /// The slots, in order. Their numbers start at 0; each takes as many numbers as its greatest count of modules.
    pub slots: &'static [Slot],
    /// The modules that fit into one of them.
    pub modules: &'static [&'static Module],
    /// Groups of modules, in the order of the process image; empty = all modules by slot.
    pub pdo_groups: &'static [PdoGroup],
    /// On which changes of state a master writes the ident numbers of the modules to 0xF030; none where it doesn't.
    pub download_idents: Transitions,
}

/// A place for modules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Its name.
    pub name: &'static str,
    /// Least number of modules in it.
    pub min: u16,
    /// Greatest number of modules in it.
    pub max: u16,
    /// What fits; empty = every module.
    pub fits: &'static [Fit],
    /// Ident number of the module that is there by default.
    pub default: Option<u32>,
    /// What indices grow by from slot to slot.
    pub increments: Increments,
    /// The group that it belongs to, where there is one.
    pub group: Option<SlotGroup>,
}

/// The group that a slot belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotGroup {
    /// Its number.
    pub number: u16,
    /// What indices grow by from slot group to slot group.
    pub increments: Increments,
}

/// What indices grow by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Increments {
    /// Those of a module's objects.
    pub index: u16,
    /// Those of a module's PDOs.
    pub pdo: u16,
}

/// What fits into a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The module with this ident number.
    Ident(u32),
    /// Every module of this class.
    Class(&'static str),
}

/// Modules whose process data stand one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoGroup {
    /// The data of the group begin at a multiple of so many bytes; 0 = at the next bit.
    pub alignment: u16,
    /// Index of the RxPDO that fills the gap in front of the group, where there is one.
    pub rx_pdo: Option<u16>,
    /// Index of the TxPDO that fills the gap in front of the group, where there is one.
    pub tx_pdo: Option<u16>,
}

/// A module. Indices that depend on its place are those of slot 0 and slot group 0.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// Ident number.
    pub ident: u32,
    /// Its name.
    pub name: &'static str,
    /// The class by which slots name it; may be empty.
    pub class: &'static str,
    /// Position of its group among those of the device.
    pub pdo_group: u16,
    /// Its PDOs, those of the outputs first.
    pub pdos: &'static [PdoInfo],
    /// What a master writes at start-up.
    pub init_commands: &'static [InitCommand],
    /// Which of its objects grow with its place, by index; all others are the same in every slot.
    pub objects: &'static [SlotObjects],
}

/// Objects of a module whose indices grow with its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotObjects {
    /// Index of the first one.
    pub first: u16,
    /// Index of the last one.
    pub last: u16,
    /// What they grow with.
    pub depends_on: DependsOn,
}

impl Increments {
    /// Of objects and of PDOs.
    #[must_use]
    pub const fn new(index: u16, pdo: u16) -> Self {
        Self { index, pdo }
    }
}

impl SlotGroup {
    /// The group with this number.
    #[must_use]
    pub const fn new(number: u16, increments: Increments) -> Self {
        Self { number, increments }
    }
}

impl SlotObjects {
    /// Those from `first` to `last`.
    #[must_use]
    pub const fn new(first: u16, last: u16, depends_on: DependsOn) -> Self {
        Self { first, last, depends_on }
    }
}

impl Module {
    /// What the index of an object grows with.
    #[must_use]
    pub fn depends_on(&self, index: u16) -> DependsOn {
        let range = self.objects.iter().find(|range| (range.first..=range.last).contains(&index));
        range.map_or(DependsOn::Nothing, |range| range.depends_on)
    }
}

impl Slot {
    /// Whether `module` fits.
    #[must_use]
    pub fn takes(&self, module: &Module) -> bool {
        let fits = |fit: &Fit| match fit {
            Fit::Ident(ident) => *ident == module.ident,
            Fit::Class(class) => !class.is_empty() && *class == module.class,
        };
        self.fits.is_empty() || self.fits.iter().any(fits)
    }
}
