//! EtherCAT: device description for the master, PDO assignment and process image.
//!
//! Generated bindings describe a slave as a constant [`Device`] with sync managers, PDOs, start-up commands and slots.
//! An [`Assignment`] of PDOs computes the layout of the process image and the start-up commands for this layout. A
//! [`SlotPlan`] computes the layout and the commands for a modular device and its modules. The types of this module
//! don't allocate.
//!
//! The terms "inputs" and "outputs" are from the master's point of view: a TxPDO of the slave is an input.

mod assignment;
mod clock;
mod depends_on;
mod mailbox;
mod module;
mod pdo;
mod plan;
mod settings;
mod startup;
mod sync_manager;
mod wire_macro;

pub use assignment::{AssignedPdo, Assignment, AssignmentError};
pub use clock::{ClockMode, ClockTime};
pub use depends_on::DependsOn;
pub use mailbox::{Coe, InitCommand, Mailbox, Transition, Transitions};
pub use module::{Fit, Increments, Module, PdoGroup, Slot, SlotGroup, SlotObjects, Slots};
pub use pdo::{Direction, PdoInfo};
pub use plan::{PlanError, SlotPdo, SlotPlan};
pub use settings::{ClockSettings, ClockSignal, FmmuSettings, SyncManagerSettings};
pub use startup::{configure, configure_async, StartupCommand, StartupData};
pub use sync_manager::{Fmmu, FmmuPurpose, SyncManager, SyncManagerPurpose};

use crate::identity::Identity;

/// Description of a slave, for use by the master.
#[derive(Clone, Copy, Debug)]
pub struct Device {
    /// Identity: vendor, product and revision.
    pub identity: Identity,
    /// Sync managers in ascending order of their numbers.
    pub sync_managers: &'static [SyncManager],
    /// PDOs of the slave: first the output PDOs, then the input PDOs.
    pub pdos: &'static [PdoInfo],
    /// Indices of the PDOs that are assigned by default, in the order of the process image.
    pub default_pdos: &'static [u16],
    /// Mailbox protocols that the slave supports.
    pub mailbox: Mailbox,
    /// Slots and modules; `None` if the device isn't modular.
    pub slots: Option<Slots>,
}

impl Device {
    /// Returns the initialization commands of the device for a state transition, without the commands of its modules.
    pub fn init_commands(&self, transition: Transition) -> impl Iterator<Item = StartupCommand> {
        let commands = self.mailbox.coe.map_or(&[][..], |coe| coe.init_commands);
        let due = commands.iter().filter(move |command| command.transitions.contains(transition));
        due.map(move |command| StartupCommand::of_init(command, transition, depends_on::Growth::default()))
    }

    /// Returns the PDO whose mapping object has this index, or `None` if the device itself has no such PDO.
    #[must_use]
    pub fn pdo(&self, index: u16) -> Option<&'static PdoInfo> {
        self.pdos.iter().find(|pdo| pdo.index == index)
    }

    /// Returns the sync manager with this number, or `None` if the description doesn't list it.
    #[must_use]
    pub fn sync_manager(&self, number: u8) -> Option<&'static SyncManager> {
        self.sync_managers.iter().find(|manager| manager.number == number)
    }

    /// Returns the number of the sync manager for a PDO, or `None` if the device has no sync manager for the PDO. If
    /// the PDO has a default sync manager, the function returns the number of this sync manager. Otherwise, the
    /// function returns the number of the first sync manager that has the PDO's direction and that the PDO doesn't
    /// exclude. If the description lists no sync managers, the function returns the default sync manager of another PDO
    /// with the same direction.
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
    /// Returns the default sync manager of a PDO: of the first PDO that has this direction and a default sync manager.
    fn named_by_others(&self, direction: Direction) -> Option<u8> {
        self.pdos.iter().filter(|pdo| pdo.direction == direction).find_map(|pdo| pdo.sync_manager)
    }
}

#[cfg(test)]
pub(crate) mod samples;
