//! The mailbox, and what a master sends to it at start-up.

use super::depends_on::DependsOn;

/// A change of state of the slave (ETG.1000.6 6.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Transition {
    /// Init to Pre-Operational.
    IP = 1,
    /// Pre-Operational to Safe-Operational.
    PS = 2,
    /// Safe-Operational to Operational.
    SO = 4,
    /// Safe-Operational to Pre-Operational.
    SP = 8,
    /// Operational to Pre-Operational.
    OP = 16,
    /// Operational to Safe-Operational.
    OS = 32,
}

/// A set of changes of state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Transitions(u8);

impl Transitions {
    /// No change.
    pub const NONE: Transitions = Transitions(0);

    /// The set of these changes.
    #[must_use]
    pub const fn of(list: &[Transition]) -> Self {
        let mut bits = 0;
        let mut at = 0;
        while at < list.len() {
            bits |= list[at] as u8;
            at += 1;
        }
        Self(bits)
    }

    /// Whether `transition` is in the set.
    #[must_use]
    pub const fn contains(self, transition: Transition) -> bool {
        self.0 & transition as u8 != 0
    }
}

/// A value that a master writes to an object on a change of state (InitCmd of ETG.2000).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InitCommand {
    /// On which changes of state.
    pub transitions: Transitions,
    /// Index of the object.
    pub index: u16,
    /// Sub-index of the object.
    pub sub_index: u8,
    /// Whether all sub-indices are written at once.
    pub complete_access: bool,
    /// What the index grows with, where a module brings the command along.
    pub depends_on: DependsOn,
    /// The bytes.
    pub data: &'static [u8],
}

/// CAN application protocol over EtherCAT: what of it the slave supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coe {
    /// Whether the SDO information service is supported.
    pub sdo_info: bool,
    /// Whether the assignment of PDOs may be written.
    pub pdo_assign: bool,
    /// Whether the mapping of PDOs may be written.
    pub pdo_config: bool,
    /// Whether all sub-indices may be transferred at once.
    pub complete_access: bool,
    /// What a master writes at start-up.
    pub init_commands: &'static [InitCommand],
}

/// The protocols of the mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mailbox {
    /// CAN application protocol over EtherCAT.
    pub coe: Option<Coe>,
    /// ADS over EtherCAT.
    pub aoe: bool,
    /// Ethernet over EtherCAT.
    pub eoe: bool,
    /// File access over EtherCAT.
    pub foe: bool,
    /// Servo profile over EtherCAT.
    pub soe: bool,
    /// Vendor-specific protocol over EtherCAT.
    pub voe: bool,
}

impl Mailbox {
    /// No mailbox.
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
