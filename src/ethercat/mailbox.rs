//! The mailbox protocols of a slave and its initialization commands.

use super::depends_on::DependsOn;

/// A state transition of the slave (ETG.1000.6 6.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Transition {
    /// The transition from Init to Pre-Operational.
    IP = 1,
    /// The transition from Pre-Operational to Safe-Operational.
    PS = 2,
    /// The transition from Safe-Operational to Operational.
    SO = 4,
    /// The transition from Safe-Operational to Pre-Operational.
    SP = 8,
    /// The transition from Operational to Pre-Operational.
    OP = 16,
    /// The transition from Operational to Safe-Operational.
    OS = 32,
}

/// A set of state transitions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Transitions(u8);

impl Transitions {
    /// The empty set.
    pub const NONE: Transitions = Transitions(0);

    /// Creates a set from a list of transitions.
    #[must_use]
    #[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
    pub const fn of(list: &[Transition]) -> Self {
        let mut bits = 0;
        let mut at = 0;
        while at < list.len() {
            bits |= list[at] as u8;
            at += 1;
        }
        Self(bits)
    }

    /// Returns whether `transition` is in the set.
    #[must_use]
    pub const fn contains(self, transition: Transition) -> bool {
        self.0 & transition as u8 != 0
    }
}

/// A value that the master writes to an object during a state transition (`InitCmd` of ETG.2000).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InitCommand {
    /// The transitions during which the value is written.
    pub transitions: Transitions,
    /// Index of the object.
    pub index: u16,
    /// Sub-index of the object.
    pub sub_index: u8,
    /// True if complete access is used, which transfers all sub-indices at once.
    pub complete_access: bool,
    /// Slot dependency of the index, if the command belongs to a module.
    pub depends_on: DependsOn,
    /// Bytes of the value to write.
    pub data: &'static [u8],
}

/// Capabilities of CANopen over EtherCAT (CoE).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coe {
    /// True if the SDO information service is supported.
    pub sdo_info: bool,
    /// True if the PDO assignment is writable.
    pub pdo_assign: bool,
    /// True if PDO mappings are writable.
    pub pdo_config: bool,
    /// True if complete access is supported.
    pub complete_access: bool,
    /// Initialization commands of the device.
    pub init_commands: &'static [InitCommand],
}

/// The mailbox protocols that a slave supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mailbox {
    /// CANopen over EtherCAT (CoE).
    pub coe: Option<Coe>,
    /// ADS over EtherCAT (AoE).
    pub aoe: bool,
    /// Ethernet over EtherCAT (EoE).
    pub eoe: bool,
    /// File access over EtherCAT (FoE).
    pub foe: bool,
    /// Servo drive profile over EtherCAT (SoE).
    pub soe: bool,
    /// Vendor-specific protocol over EtherCAT (VoE).
    pub voe: bool,
}

impl Mailbox {
    /// Mailbox of a slave that supports no mailbox protocol.
    pub const NONE: Mailbox = Mailbox { coe: None, aoe: false, eoe: false, foe: false, soe: false, voe: false };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_transitions() {
        const SET: Transitions = Transitions::of(&[Transition::PS, Transition::OS]);
        assert!(SET.contains(Transition::PS) && SET.contains(Transition::OS) && !SET.contains(Transition::IP));
        assert!(!Transitions::NONE.contains(Transition::IP));
    }
}
