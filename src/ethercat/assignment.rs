//! PDO assignments: the PDOs that are exchanged, the resulting process image, and the commands that configure the
//! slave.

use core::fmt;

use super::depends_on::Growth;
use super::mailbox::Transition;
use super::pdo::PdoInfo;
use super::startup::StartupCommand;
use super::Device;
use crate::pdo::{MappedEntry, Pdo, SdoWrite};

/// Index of the assignment object of sync manager 0 (ETG.1000.6 5.6.7.4).
pub(super) const ASSIGN: u16 = 0x1C10;

/// A PDO and its position in the process image of its sync manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssignedPdo {
    /// Description of the PDO.
    pub pdo: &'static PdoInfo,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Bit offset in the process data of the sync manager.
    pub bit: u32,
    /// Length in bits.
    pub bits: u32,
    /// Mapping of the PDO: the mapping in the device description, or the mapping passed to
    /// [`Assignment::with_mapping`].
    pub mapping: &'static [MappedEntry],
}

/// A valid assignment of at most `N` PDOs of a device.
///
/// The PDOs of one sync manager are packed without gaps, in the order of their assignment.
#[derive(Clone, Copy, Debug)]
pub struct Assignment<const N: usize = 32> {
    device: &'static Device,
    assigned: [Option<AssignedPdo>; N],
    len: usize,
}

/// Reasons why an assignment is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AssignmentError {
    /// The device has no PDO with this index, or the PDO isn't assigned.
    Unknown(u16),
    /// The list of PDOs contains this PDO more than once.
    Twice(u16),
    /// One of the two PDOs excludes the other one.
    Conflict(u16, u16),
    /// This mandatory PDO is not assigned.
    Missing(u16),
    /// The device has no sync manager for this PDO.
    NoSyncManager(u16),
    /// The process data exceed the maximum length of the sync manager.
    TooLong {
        /// Number of the sync manager.
        sync_manager: u8,
        /// Length of the data in bytes.
        bytes: usize,
        /// Maximum length in bytes.
        max: usize,
    },
    /// More than `N` PDOs are assigned, or more than 255 PDOs to one sync manager.
    TooMany,
    /// The mapping of this PDO, or every mapping of the device, is read-only.
    Fixed(u16),
}

impl fmt::Display for AssignmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssignmentError::Unknown(index) => write!(f, "the device has no PDO {index:#06X}"),
            AssignmentError::Twice(index) => write!(f, "the PDO {index:#06X} is assigned twice"),
            AssignmentError::Conflict(one, other) => {
                write!(f, "the PDOs {one:#06X} and {other:#06X} exclude each other")
            }
            AssignmentError::Missing(index) => write!(f, "the mandatory PDO {index:#06X} is not assigned"),
            AssignmentError::NoSyncManager(index) => write!(f, "the device has no sync manager for PDO {index:#06X}"),
            AssignmentError::TooLong { sync_manager, bytes, max } => {
                write!(f, "sync manager {sync_manager} has {bytes} bytes of process data; the maximum is {max}")
            }
            AssignmentError::TooMany => f.write_str("too many PDOs for the assignment or for one sync manager"),
            AssignmentError::Fixed(index) => write!(f, "the mapping of the PDO {index:#06X} cannot be changed"),
        }
    }
}

impl core::error::Error for AssignmentError {}

impl<const N: usize> Assignment<N> {
    /// Creates the default assignment of the device.
    ///
    /// # Errors
    ///
    /// Returns an [`AssignmentError`] if the default assignment in the device description is invalid, or if `N` is too
    /// small.
    pub fn by_default(device: &'static Device) -> Result<Self, AssignmentError> {
        Self::new(device, device.default_pdos)
    }

    /// Creates an assignment of the PDOs whose mapping objects have these indices, in this order.
    ///
    /// # Errors
    ///
    /// Returns an [`AssignmentError`] if the assignment is invalid.
    pub fn new(device: &'static Device, pdos: &[u16]) -> Result<Self, AssignmentError> {
        let mut assignment = Self { device, assigned: [None; N], len: 0 };
        for &index in pdos {
            assignment.add(index)?;
        }
        let missing = device.pdos.iter().find(|pdo| pdo.mandatory && assignment.find(pdo.index).is_none());
        if let Some(pdo) = missing {
            return Err(AssignmentError::Missing(pdo.index));
        }
        assignment.check_lengths()?;
        Ok(assignment)
    }

    /// Replaces the mapping of one PDO by a custom mapping. `P` is a struct declared with [`pdo!`](crate::pdo!). The
    /// offsets of all following PDOs of the same sync manager change accordingly.
    ///
    /// # Errors
    ///
    /// - [`AssignmentError::Unknown`] if the PDO isn't assigned.
    /// - [`AssignmentError::Fixed`] if the mapping of this PDO, or every mapping of the device, is read-only.
    /// - [`AssignmentError::TooLong`] if the process data exceed the maximum length of the sync manager.
    pub fn with_mapping<P: Pdo>(mut self) -> Result<Self, AssignmentError> {
        let configures = self.device.mailbox.coe.is_some_and(|coe| coe.pdo_config);
        let mut assigned = self.assigned.iter_mut().flatten();
        let assigned =
            assigned.find(|assigned| assigned.pdo.index == P::INDEX).ok_or(AssignmentError::Unknown(P::INDEX))?;
        if assigned.pdo.fixed || !configures {
            return Err(AssignmentError::Fixed(P::INDEX));
        }
        (assigned.mapping, assigned.bits) = (P::MAPPING, crate::pdo::custom::bits(P::MAPPING));
        for at in 0..self.len {
            let (before, rest) = self.assigned.split_at_mut(at);
            let Some(Some(moved)) = rest.first_mut() else { continue };
            moved.bit = bits_of(before, moved.sync_manager);
        }
        self.check_lengths()?;
        Ok(self)
    }

    fn check_lengths(&self) -> Result<(), AssignmentError> {
        for manager in self.device.sync_managers {
            let bytes = self.bytes(manager.number);
            let max = manager.max_size.map_or(usize::MAX, usize::from);
            if bytes > max {
                return Err(AssignmentError::TooLong { sync_manager: manager.number, bytes, max });
            }
        }
        Ok(())
    }

    fn add(&mut self, index: u16) -> Result<(), AssignmentError> {
        let pdo = self.device.pdo(index).ok_or(AssignmentError::Unknown(index))?;
        for other in self.pdos() {
            if other.pdo.index == index {
                return Err(AssignmentError::Twice(index));
            }
            if other.pdo.conflicts_with(pdo) {
                return Err(AssignmentError::Conflict(other.pdo.index, index));
            }
        }
        let sync_manager = self.device.sync_manager_of(pdo).ok_or(AssignmentError::NoSyncManager(index))?;
        if self.pdos().filter(|other| other.sync_manager == sync_manager).count() >= usize::from(u8::MAX) {
            return Err(AssignmentError::TooMany);
        }
        let assigned =
            AssignedPdo { pdo, sync_manager, bit: self.bits(sync_manager), bits: pdo.bits, mapping: pdo.mapping };
        *self.assigned.get_mut(self.len).ok_or(AssignmentError::TooMany)? = Some(assigned);
        self.len += 1;
        Ok(())
    }

    /// Returns the PDOs in the order of the assignment.
    pub fn pdos(&self) -> impl Iterator<Item = AssignedPdo> + '_ {
        self.assigned.iter().copied().flatten()
    }

    /// Returns the PDO whose mapping object has this index, or `None` if the PDO isn't assigned.
    #[must_use]
    pub fn find(&self, index: u16) -> Option<AssignedPdo> {
        self.pdos().find(|assigned| assigned.pdo.index == index)
    }

    /// Returns the length of a sync manager's process data in bits.
    #[must_use]
    pub fn bits(&self, sync_manager: u8) -> u32 {
        bits_of(&self.assigned, sync_manager)
    }

    /// Returns the length of a sync manager's process data in bytes, rounded up.
    #[must_use]
    pub fn bytes(&self, sync_manager: u8) -> usize {
        self.bits(sync_manager).div_ceil(8) as usize
    }

    /// Returns the start-up commands. Send the commands in Pre-Operational before you request Safe-Operational.
    ///
    /// The device's own commands for the transitions IP and PS come first. The [`commands`](Self::commands) of the
    /// assignment follow.
    pub fn startup(&self) -> impl Iterator<Item = StartupCommand> + '_ {
        let commands =
            [Transition::IP, Transition::PS].into_iter().flat_map(|transition| self.device.init_commands(transition));
        commands.chain(self.commands().map(|write| StartupCommand::of_write(Transition::PS, write)))
    }

    /// Returns the SDO writes that configure the assignment (ETG.1000.6 5.6.7.4). Send the writes in Pre-Operational.
    ///
    /// The writes clear the assignment, write the writable mappings of the assigned PDOs, and then write the
    /// assignment. Writes to read-only objects are left out.
    pub fn commands(&self) -> impl Iterator<Item = SdoWrite> + '_ {
        let coe = self.device.mailbox.coe;
        let assigns = coe.is_some_and(|coe| coe.pdo_assign);
        let configures = coe.is_some_and(|coe| coe.pdo_config);
        let managers =
            move || self.device.sync_managers.iter().filter(move |manager| assigns && manager.carries_data());
        let clear = managers().map(|manager| SdoWrite::new_u8(manager.assignment(), 0, 0));
        let mappings = self.pdos().filter(move |assigned| configures && assigned.pdo.holds(assigned.mapping));
        let mappings =
            mappings.flat_map(|assigned| mapping_writes(assigned.pdo.index, assigned.mapping, Growth::default()));
        let assign = managers().flat_map(move |manager| {
            let assigned = move || self.pdos().filter(move |assigned| assigned.sync_manager == manager.number);
            assignment_writes(manager.assignment(), move || assigned().map(|assigned| assigned.pdo.index))
        });
        clear.chain(mappings).chain(assign)
    }
}

/// Returns the total length in bits of the PDOs that are assigned to a sync manager.
fn bits_of(assigned: &[Option<AssignedPdo>], sync_manager: u8) -> u32 {
    let pdos = assigned.iter().flatten().filter(|assigned| assigned.sync_manager == sync_manager);
    pdos.fold(0, |bits, assigned| bits.saturating_add(assigned.bits))
}

impl super::SyncManager {
    /// Returns whether the sync manager carries process data.
    #[must_use]
    pub const fn carries_data(&self) -> bool {
        matches!(self.purpose, super::SyncManagerPurpose::Outputs | super::SyncManagerPurpose::Inputs)
    }

    /// Returns the index of the object that lists the PDOs assigned to this sync manager.
    #[must_use]
    pub const fn assignment(&self) -> u16 {
        ASSIGN + self.number as u16
    }
}

/// Returns the writes of a mapping in this order: clear the mapping, write the entries, write the number of entries.
/// `growth` is added to the indices of slot-dependent objects.
pub(super) fn mapping_writes(
    index: u16,
    mapping: &'static [crate::MappedEntry],
    growth: Growth,
) -> impl Iterator<Item = SdoWrite> {
    let entries = mapping.iter().zip(1..=u8::MAX).map(move |(entry, sub)| {
        let entry = crate::MappedEntry { index: entry.index.wrapping_add(growth.of(entry.depends_on)), ..*entry };
        SdoWrite::new_u32(index, sub, entry.word())
    });
    let count = SdoWrite::new_u8(index, 0, mapping.len() as u8);
    core::iter::once(SdoWrite::new_u8(index, 0, 0)).chain(entries).chain(core::iter::once(count))
}

/// Returns the writes of an assignment object: first the entries, then the number of entries. Returns no writes if no
/// PDO is assigned.
pub(super) fn assignment_writes<I: Iterator<Item = u16>>(
    object: u16,
    indices: impl Fn() -> I,
) -> impl Iterator<Item = SdoWrite> {
    let count = indices().count() as u8;
    let entries = indices().zip(1..=u8::MAX).map(move |(index, sub)| SdoWrite::new_u16(object, sub, index));
    entries.chain((count > 0).then(|| SdoWrite::new_u8(object, 0, count)))
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::super::samples::DRIVE;
    use super::*;

    #[test]
    fn layout_follows_the_order() {
        let assignment = Assignment::<8>::new(&DRIVE, &[0x1601, 0x1600, 0x1A00]).unwrap();
        let pdos: Vec<_> = assignment.pdos().map(|one| (one.pdo.index, one.sync_manager, one.bit)).collect();
        assert_eq!(pdos, [(0x1601, 2, 0), (0x1600, 2, 3), (0x1A00, 3, 0)]);
        assert_eq!((assignment.bits(2), assignment.bytes(2), assignment.bytes(3), assignment.bytes(4)), (19, 3, 2, 0));
        assert_eq!(assignment.find(0x1600).map(|assigned| assigned.bit), Some(3));
    }

    #[test]
    fn illegal_choices_are_refused() {
        let new = |pdos: &[u16]| Assignment::<3>::new(&DRIVE, pdos).map(|_| ()).unwrap_err();
        assert_eq!(new(&[0x1600, 0x1777]), AssignmentError::Unknown(0x1777));
        assert_eq!(new(&[0x1600, 0x1600]), AssignmentError::Twice(0x1600));
        assert_eq!(new(&[0x1600, 0x1602, 0x1A00]), AssignmentError::Conflict(0x1600, 0x1602));
        assert_eq!(new(&[0x1602, 0x1600, 0x1A00]), AssignmentError::Conflict(0x1602, 0x1600));
        assert_eq!(new(&[0x1600]), AssignmentError::Missing(0x1A00));
        assert_eq!(new(&[0x1A00, 0x1A01]), AssignmentError::TooLong { sync_manager: 3, bytes: 10, max: 8 });
        let one = Assignment::<1>::by_default(&DRIVE).map(|_| ()).unwrap_err();
        assert_eq!(one, AssignmentError::TooMany);
    }

    /// A custom mapping of the statusword and a gap. The gap has 5 bits, or 50 bits if `LONG` is true.
    struct Custom<const INDEX: u16, const LONG: bool>;

    impl<const INDEX: u16, const LONG: bool> Pdo for Custom<INDEX, LONG> {
        const INDEX: u16 = INDEX;
        const MAPPING: &'static [MappedEntry] =
            &[MappedEntry::new(0x6041, 0, 16), MappedEntry::new(0, 0, if LONG { 50 } else { 5 })];
        const LEN: usize = 3;
    }

    #[test]
    fn a_mapping_of_ones_own_takes_the_place_of_the_description_s() {
        let assignment = Assignment::<8>::by_default(&DRIVE).unwrap();
        let custom = assignment.with_mapping::<Custom<0x1A00, false>>().unwrap();
        assert_eq!((assignment.bits(3), custom.bits(2), custom.bits(3)), (16, 16, 21));
        let commands: Vec<_> = custom.commands().filter(|write| write.object().index == 0x1A00).collect();
        assert_eq!(
            commands,
            [
                SdoWrite::new_u8(0x1A00, 0, 0),
                SdoWrite::new_u32(0x1A00, 1, 0x6041_0010),
                SdoWrite::new_u32(0x1A00, 2, 0x0000_0005),
                SdoWrite::new_u8(0x1A00, 0, 2),
            ]
        );
    }

    #[test]
    fn mappings_that_the_device_does_not_take_are_refused() {
        let assignment = Assignment::<8>::by_default(&DRIVE).unwrap();
        let long = assignment.with_mapping::<Custom<0x1A00, true>>().map(|_| ()).unwrap_err();
        assert_eq!(long, AssignmentError::TooLong { sync_manager: 3, bytes: 9, max: 8 });
        let fixed = assignment.with_mapping::<Custom<0x1600, false>>().map(|_| ()).unwrap_err();
        assert_eq!(fixed, AssignmentError::Fixed(0x1600));
        let unknown = assignment.with_mapping::<Custom<0x1A01, false>>().map(|_| ()).unwrap_err();
        assert_eq!(unknown, AssignmentError::Unknown(0x1A01));
    }

    #[test]
    fn commands_clear_map_and_assign() {
        let assignment = Assignment::<8>::by_default(&DRIVE).unwrap();
        let commands: Vec<_> = assignment.commands().collect();
        assert_eq!(
            commands,
            [
                SdoWrite::new_u8(0x1C12, 0, 0),
                SdoWrite::new_u8(0x1C13, 0, 0),
                // The mapping of 0x1600 is fixed, that of 0x1A00 is writable.
                SdoWrite::new_u8(0x1A00, 0, 0),
                SdoWrite::new_u32(0x1A00, 1, 0x6041_0010),
                SdoWrite::new_u8(0x1A00, 0, 1),
                SdoWrite::new_u16(0x1C12, 1, 0x1600),
                SdoWrite::new_u8(0x1C12, 0, 1),
                SdoWrite::new_u16(0x1C13, 1, 0x1A00),
                SdoWrite::new_u8(0x1C13, 0, 1),
            ]
        );
    }

    #[test]
    fn the_start_up_list_begins_with_what_the_description_asks_for() {
        use super::super::{Coe, Device, InitCommand, Mailbox, Transitions};
        use crate::ethercat::DependsOn;

        const fn init(transition: Transition, index: u16) -> InitCommand {
            let transitions = Transitions::of(&[transition]);
            let depends_on = DependsOn::Nothing;
            InitCommand { transitions, index, sub_index: 0, complete_access: false, depends_on, data: &[8] }
        }

        const INIT: &[InitCommand] =
            &[init(Transition::PS, 0x6060), init(Transition::OP, 0x2000), init(Transition::IP, 0x2001)];
        const COE: Coe =
            Coe { sdo_info: false, pdo_assign: false, pdo_config: false, complete_access: false, init_commands: INIT };
        static CUSTOM: Device = Device { mailbox: Mailbox { coe: Some(COE), ..Mailbox::NONE }, ..DRIVE };
        let assignment = Assignment::<8>::by_default(&CUSTOM).unwrap();
        let commands: Vec<_> = assignment.startup().map(|command| (command.object.index, command.transition)).collect();
        // The assignment of this device is read-only.
        assert_eq!(commands, [(0x2001, Transition::IP), (0x6060, Transition::PS)]);
        let assignment = Assignment::<8>::by_default(&DRIVE).unwrap();
        assert_eq!(assignment.startup().count(), assignment.commands().count());
    }
}
