//! A choice of PDOs, the process image that it makes, and the commands that set it up.

use core::fmt;

use super::depends_on::Growth;
use super::mailbox::Transition;
use super::pdo::PdoInfo;
use super::startup::StartupCommand;
use super::Device;
use crate::pdo::{MappedEntry, Pdo, SdoWrite};

/// Index of the assignment object of sync manager 0 (ETG.1000.6 5.6.7.4).
pub(super) const ASSIGN: u16 = 0x1C10;

/// A PDO at its place in the process image of its sync manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssignedPdo {
    /// The PDO.
    pub pdo: &'static PdoInfo,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Its first bit, counted from the first of the sync manager's data.
    pub bit: u32,
    /// Length in bits.
    pub bits: u32,
    /// What it carries: the mapping of the description, or [one's own](Assignment::with_mapping).
    pub mapping: &'static [MappedEntry],
}

/// A legal choice of at most `N` PDOs of a device.
///
/// The PDOs of a sync manager follow each other bit by bit, in the order in which they are assigned.
#[derive(Clone, Copy, Debug)]
pub struct Assignment<const N: usize = 32> {
    device: &'static Device,
    assigned: [Option<AssignedPdo>; N],
    len: usize,
}

/// Why PDOs can't be assigned together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AssignmentError {
    /// The device has no PDO with this index.
    Unknown(u16),
    /// A PDO is named twice.
    Twice(u16),
    /// The second excludes the first, or the other way round.
    Conflict(u16, u16),
    /// A mandatory PDO is missing.
    Missing(u16),
    /// No sync manager takes the PDO.
    NoSyncManager(u16),
    /// The data of a sync manager are longer than it can be.
    TooLong {
        /// Number of the sync manager.
        sync_manager: u8,
        /// Length of the data in bytes.
        bytes: usize,
        /// Greatest length in bytes.
        max: usize,
    },
    /// There are more PDOs than the assignment has room for, or the device for those of one sync manager, which are 255.
    TooMany,
    /// The mapping of the PDO can't be changed.
    Fixed(u16),
}

impl fmt::Display for AssignmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssignmentError::Unknown(index) => write!(f, "the device has no PDO {index:#06X}"),
            AssignmentError::Twice(index) => write!(f, "the PDO {index:#06X} is named twice"),
            AssignmentError::Conflict(one, other) => {
                write!(f, "the PDOs {one:#06X} and {other:#06X} exclude each other")
            }
            AssignmentError::Missing(index) => write!(f, "the PDO {index:#06X} has to be assigned"),
            AssignmentError::NoSyncManager(index) => write!(f, "no sync manager takes the PDO {index:#06X}"),
            AssignmentError::TooLong { sync_manager, bytes, max } => {
                write!(f, "the data of sync manager {sync_manager} have {bytes} bytes, and at most {max} fit")
            }
            AssignmentError::TooMany => f.write_str("there are more PDOs than the assignment has room for"),
            AssignmentError::Fixed(index) => write!(f, "the mapping of the PDO {index:#06X} can't be changed"),
        }
    }
}

impl core::error::Error for AssignmentError {}

impl<const N: usize> Assignment<N> {
    /// The PDOs that are assigned by default.
    ///
    /// # Errors
    ///
    /// Where the description contradicts itself, or has more than `N` of them.
    pub fn by_default(device: &'static Device) -> Result<Self, AssignmentError> {
        Self::new(device, device.default_pdos)
    }

    /// The PDOs with these indices, in this order.
    ///
    /// # Errors
    ///
    /// Why they can't be assigned together.
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

    /// The same PDOs, with a mapping of one's own for one of them: a struct that [`pdo!`](crate::pdo!) made. The PDOs
    /// behind it move.
    ///
    /// # Errors
    ///
    /// [`AssignmentError::Unknown`] where the PDO isn't assigned, [`AssignmentError::Fixed`] where the device lets nobody
    /// write its mapping, and [`AssignmentError::TooLong`].
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

    /// The PDOs, in the order in which they are assigned.
    pub fn pdos(&self) -> impl Iterator<Item = AssignedPdo> + '_ {
        self.assigned.iter().copied().flatten()
    }

    /// The PDO with this index, where it is assigned.
    #[must_use]
    pub fn find(&self, index: u16) -> Option<AssignedPdo> {
        self.pdos().find(|assigned| assigned.pdo.index == index)
    }

    /// Length in bits of the data of a sync manager.
    #[must_use]
    pub fn bits(&self, sync_manager: u8) -> u32 {
        bits_of(&self.assigned, sync_manager)
    }

    /// Length in bytes of the data of a sync manager, the last one perhaps not full.
    #[must_use]
    pub fn bytes(&self, sync_manager: u8) -> usize {
        self.bits(sync_manager).div_ceil(8) as usize
    }

    /// What a master writes in Pre-Operational before it asks for Safe-Operational: what the description asks for on the
    /// changes of state IP and PS, then the [`commands`](Self::commands) of the assignment.
    pub fn startup(&self) -> impl Iterator<Item = StartupCommand> + '_ {
        let commands =
            [Transition::IP, Transition::PS].into_iter().flat_map(|transition| self.device.init_commands(transition));
        commands.chain(self.commands().map(|write| StartupCommand::of_write(Transition::PS, write)))
    }

    /// The writes that set the assignment up in Pre-Operational: clear the assignment, write each mapping that can be
    /// changed, write the assignment (ETG.1000.6 5.6.7.4). What the device lets nobody write is left out.
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

/// Length in bits of those of `assigned` that are on this sync manager.
fn bits_of(assigned: &[Option<AssignedPdo>], sync_manager: u8) -> u32 {
    let pdos = assigned.iter().flatten().filter(|assigned| assigned.sync_manager == sync_manager);
    pdos.fold(0, |bits, assigned| bits.saturating_add(assigned.bits))
}

impl super::SyncManager {
    /// Whether it carries process data.
    #[must_use]
    pub const fn carries_data(&self) -> bool {
        matches!(self.purpose, super::SyncManagerPurpose::Outputs | super::SyncManagerPurpose::Inputs)
    }

    /// Index of the object that holds the PDOs assigned to it.
    #[must_use]
    pub const fn assignment(&self) -> u16 {
        ASSIGN + self.number as u16
    }
}

/// Clear, entries, count. The indices of mapped objects that depend on the place of their module grow.
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

/// Entries and count of an assignment object; nothing where no PDO is assigned.
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

    /// A mapping of one's own: the status word and a gap of 5 bits, or a `LONG` one of 50.
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
                // 0x1600 is fixed; 0x1A00 isn't.
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
        // Of the assignment, nothing can be written.
        assert_eq!(commands, [(0x2001, Transition::IP), (0x6060, Transition::PS)]);
        let assignment = Assignment::<8>::by_default(&DRIVE).unwrap();
        assert_eq!(assignment.startup().count(), assignment.commands().count());
    }
}
