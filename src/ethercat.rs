//! EtherCAT: what a master has to know of a slave, the PDOs that it assigns, and the process image that follows.
//!
//! Generated bindings describe a slave as a constant [`Device`]: sync managers, PDOs, start-up commands, slots. From it,
//! an [`Assignment`] of PDOs gives the layout of the process image and the commands that set it up; a [`SlotPlan`] does
//! the same for a modular device with its modules. None of them allocates.
//!
//! "Inputs" and "outputs" are those of the master: a TxPDO of the slave is an input.

mod assignment;
mod clock;
mod depends_on;
mod mailbox;
mod module;
mod pdo;
mod plan;
mod startup;
mod sync_manager;

pub use assignment::{AssignedPdo, Assignment, AssignmentError};
pub use clock::{ClockMode, ClockTime};
pub use depends_on::DependsOn;
pub use mailbox::{Coe, InitCommand, Mailbox, Transition, Transitions};
pub use module::{Fit, Increments, Module, PdoGroup, Slot, SlotGroup, SlotObjects, Slots};
pub use pdo::{Direction, PdoInfo};
pub use plan::{PlanError, SlotPdo, SlotPlan};
pub use startup::{configure, configure_async, StartupCommand, StartupData};
pub use sync_manager::{Fmmu, FmmuPurpose, SyncManager, SyncManagerPurpose};

use crate::identity::Identity;

/// What a master has to know of a slave.
#[derive(Clone, Copy, Debug)]
pub struct Device {
    /// Who made it, and which one it is.
    pub identity: Identity,
    /// Its sync managers, by number.
    pub sync_managers: &'static [SyncManager],
    /// Its PDOs, those of the outputs first.
    pub pdos: &'static [PdoInfo],
    /// The PDOs that are assigned by default, in the order of the process image.
    pub default_pdos: &'static [u16],
    /// Its mailbox.
    pub mailbox: Mailbox,
    /// What it takes in its slots; `None` for a device that isn't modular.
    pub slots: Option<Slots>,
}

impl Device {
    /// The commands of the device itself on a change of state.
    pub fn init_commands(&self, transition: Transition) -> impl Iterator<Item = StartupCommand> {
        let commands = self.mailbox.coe.map_or(&[][..], |coe| coe.init_commands);
        let due = commands.iter().filter(move |command| command.transitions.contains(transition));
        due.map(move |command| StartupCommand::of_init(command, transition, depends_on::Growth::default()))
    }

    /// The PDO with this mapping object.
    #[must_use]
    pub fn pdo(&self, index: u16) -> Option<&'static PdoInfo> {
        self.pdos.iter().find(|pdo| pdo.index == index)
    }

    /// The sync manager with this number.
    #[must_use]
    pub fn sync_manager(&self, number: u8) -> Option<&'static SyncManager> {
        self.sync_managers.iter().find(|manager| manager.number == number)
    }

    /// The sync manager that a PDO goes to: the one that it names, else the first for data of its direction. Where the description
    /// has no list of sync managers, it is that of another PDO of its direction.
    #[must_use]
    pub fn sync_manager_of(&self, pdo: &PdoInfo) -> Option<u8> {
        let purpose = match pdo.direction {
            Direction::Output => SyncManagerPurpose::Outputs,
            Direction::Input => SyncManagerPurpose::Inputs,
        };
        pdo.sync_manager.or_else(|| {
            let free = |manager: &&SyncManager| {
                manager.purpose == purpose && !pdo.excluded_sync_managers.contains(&manager.number)
            };
            let listed = self.sync_managers.iter().find(free).map(|manager| manager.number);
            listed.or_else(|| self.named_by_others(pdo.direction).filter(|_| self.sync_managers.is_empty()))
        })
    }
}

impl Device {
    /// The sync manager that the first PDO of a direction names that names one.
    fn named_by_others(&self, direction: Direction) -> Option<u8> {
        self.pdos.iter().filter(|pdo| pdo.direction == direction).find_map(|pdo| pdo.sync_manager)
    }
}

#[cfg(test)]
pub(crate) mod samples;
