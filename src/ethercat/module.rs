//! Slots of a modular device, and modules.

use super::mailbox::InitCommand;
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
    /// Whether a master writes the ident numbers of the modules to 0xF030.
    pub download_idents: bool,
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
    /// What the index of a module's objects grows by from slot to slot.
    pub index_increment: u16,
    /// What the index of a module's PDOs grows by from slot to slot.
    pub pdo_increment: u16,
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

/// A module. Indices that depend on the slot are those of slot 0.
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
