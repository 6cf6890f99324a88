//! Slot plans: the plugged modules, the resulting process image, and the commands that configure the device.

use core::fmt;

use super::assignment::{assignment_writes, mapping_writes};
use super::depends_on::Growth;
use super::mailbox::Transition;
use super::module::{Increments, Module, Slot};
use super::pdo::{PdoInfo, MAX_MAPPED_ENTRIES};
use super::startup::StartupCommand;
use super::{Device, SyncManager};
use crate::pdo::{MappedEntry, SdoWrite};

/// Index of the object that lists the idents of the configured modules (ETG.5001.1).
const MODULE_IDENTS: u16 = 0xF030;

/// Assigns modules to the slots of a modular device. The device has at most `N` slots.
///
/// ```ignore
/// let mut plan = SlotPlan::<16>::new(&coupler::DEVICE)?;
/// plan.plug(0, &modules::eight_inputs::MODULE)?;
/// plan.check()?;
/// let placed = plan.pdo(0, 0x1A00);                      // position of the inputs of slot 0
/// configure(&mut client, plan.startup())?;               // in Pre-Operational
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SlotPlan<const N: usize> {
    device: &'static Device,
    modules: [Option<&'static Module>; N],
}

/// Reasons why a module cannot be plugged or a plan is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanError {
    /// The device isn't modular, or has more than `N` slots.
    Slots,
    /// The device has no slot with this number.
    NoSuchSlot(u16),
    /// The slot with this number already has a module.
    Taken(u16),
    /// The slot doesn't accept the module.
    DoesNotFit {
        /// Number of the slot.
        slot: u16,
        /// Ident of the module.
        ident: u32,
    },
    /// A series of slots has fewer modules than its minimum. Contains the number of the first free slot of the series.
    Empty(u16),
    /// A list object has too few sub-indices. List objects are the PDO assignments (0x1C10 and following), the list of
    /// module idents (0xF030), and the mapping of a PDO for padding.
    TooMany {
        /// Index of the list object.
        index: u16,
        /// Required number of entries.
        count: usize,
    },
    /// The process data exceed the maximum length of the sync manager.
    TooLong {
        /// Number of the sync manager.
        sync_manager: u8,
        /// Length of the data in bytes.
        bytes: usize,
        /// Maximum length in bytes.
        max: usize,
    },
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlanError::Slots => f.write_str("the device has no slots, or more than the plan can hold"),
            PlanError::NoSuchSlot(slot) => write!(f, "slot {slot} doesn't exist"),
            PlanError::Taken(slot) => write!(f, "slot {slot} already has a module"),
            PlanError::DoesNotFit { slot, ident } => write!(f, "slot {slot} doesn't accept module {ident:#010X}"),
            PlanError::Empty(slot) => write!(f, "slot {slot} requires a module"),
            PlanError::TooMany { index, count } => write!(f, "object {index:#06X} cannot hold {count} entries"),
            PlanError::TooLong { sync_manager, bytes, max } => {
                write!(f, "sync manager {sync_manager} has {bytes} bytes of process data; the maximum is {max}")
            }
        }
    }
}

impl core::error::Error for PlanError {}

/// A PDO of a modular device, or padding, and its position in the process image of a sync manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotPdo {
    /// Slot of the module; `None` for padding, and for a PDO of the device itself.
    pub slot: Option<u16>,
    /// Index of the PDO in this slot; 0 for padding without a PDO.
    pub index: u16,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Bit offset in the process data of the sync manager.
    pub bit: u32,
    /// Length in bits.
    pub bits: u32,
    content: Content,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    /// A PDO, and the index offsets of the slot-dependent objects in its mapping.
    Pdo(&'static PdoInfo, Growth),
    /// Padding in front of the PDOs of a group of modules.
    Gap,
}

impl<const N: usize> SlotPlan<N> {
    /// Creates a plan with empty slots.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::Slots`] if the device isn't modular or has more than `N` slots.
    pub fn new(device: &'static Device) -> Result<Self, PlanError> {
        let plan = Self { device, modules: [None; N] };
        let count: usize = plan.slots().iter().map(|slot| usize::from(slot.max)).sum();
        match device.slots {
            Some(_) if plan.slots().is_empty() || count <= N => Ok(plan),
            _ => Err(PlanError::Slots),
        }
    }

    /// Creates a plan with the default module of each slot. Slots without a default module stay empty.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`SlotPlan::new`] and [`SlotPlan::plug`].
    pub fn by_default(device: &'static Device) -> Result<Self, PlanError> {
        let mut plan = Self::new(device)?;
        for number in 0..plan.count() {
            let default = plan.slot(number).and_then(|slot| slot.default);
            let module = default.and_then(|ident| plan.known_modules().iter().find(|module| module.ident == ident));
            if let Some(module) = module {
                plan.plug(number, module)?;
            }
        }
        Ok(plan)
    }

    /// Plugs `module` into a slot. Slot numbers start at 0.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::NoSuchSlot`], [`PlanError::DoesNotFit`] or [`PlanError::Taken`] if the module cannot be
    /// plugged.
    pub fn plug(&mut self, slot: u16, module: &'static Module) -> Result<(), PlanError> {
        let group = self.slot(slot).ok_or(PlanError::NoSuchSlot(slot))?;
        if !group.takes(module) {
            return Err(PlanError::DoesNotFit { slot, ident: module.ident });
        }
        match self.modules.get_mut(usize::from(slot)) {
            None => Err(PlanError::NoSuchSlot(slot)),
            Some(Some(_)) => Err(PlanError::Taken(slot)),
            Some(free) => {
                *free = Some(module);
                Ok(())
            }
        }
    }

    /// Removes the module from a slot. Returns this module, or `None` if the slot was empty or doesn't exist.
    pub fn unplug(&mut self, slot: u16) -> Option<&'static Module> {
        self.modules.get_mut(usize::from(slot))?.take()
    }

    /// Returns the module in a slot, or `None` if the slot is empty or doesn't exist.
    #[must_use]
    pub fn module(&self, slot: u16) -> Option<&'static Module> {
        self.modules.get(usize::from(slot)).copied().flatten()
    }

    /// Checks that every series of slots has its minimum number of modules. Also checks the length of the process data of
    /// each sync manager, and the number of entries of each list object. [`PlanError::TooMany`] describes the list objects.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::Empty`], [`PlanError::TooLong`] or [`PlanError::TooMany`] if the plan is invalid.
    pub fn check(&self) -> Result<(), PlanError> {
        let mut first = 0;
        for slot in self.slots() {
            let numbers = first..first + slot.max;
            let plugged = numbers.clone().filter(|&number| self.module(number).is_some()).count();
            if plugged < usize::from(slot.min) {
                let free = numbers.clone().find(|&number| self.module(number).is_none());
                return Err(PlanError::Empty(free.unwrap_or(first)));
            }
            first = numbers.end;
        }
        for manager in self.device.sync_managers.iter().filter(|manager| manager.carries_data()) {
            let (bytes, max) = (self.bytes(manager.number), manager.max_size.map_or(usize::MAX, usize::from));
            if bytes > max {
                return Err(PlanError::TooLong { sync_manager: manager.number, bytes, max });
            }
            let assigned = || self.pdos(manager.number).filter(|placed| placed.index != 0);
            room_for(manager.assignment(), assigned().count(), MAX_LISTED)?;
            for gap in assigned().filter(|placed| placed.content == Content::Gap) {
                room_for(gap.index, gap.bits.div_ceil(MAX_ENTRY_BITS) as usize, MAX_MAPPED_ENTRIES)?;
            }
        }
        room_for(MODULE_IDENTS, self.plugged().last().map_or(0, |(_, slot)| usize::from(slot) + 1), MAX_LISTED)
    }

    /// Returns the offset that a slot adds to the object index `index` of its module. `index` is the object's index in
    /// slot 0. Returns `None` if the slot is empty or doesn't exist.
    #[must_use]
    pub fn index_offset(&self, slot: u16, index: u16) -> Option<u16> {
        let depends_on = self.module(slot)?.depends_on(index);
        Some(self.objects(slot).of(depends_on))
    }

    /// Returns the PDOs and the padding of a sync manager in the order of the process image. The default PDOs of the
    /// device come first. The PDOs of the modules follow, sorted by group and slot.
    pub fn pdos(&self, sync_manager: u8) -> impl Iterator<Item = SlotPdo> + '_ {
        let manager = self.device.sync_manager(sync_manager);
        let pdos = manager.into_iter().flat_map(move |manager| {
            let defaults = self.device.default_pdos.iter().filter_map(|&index| self.device.pdo(index));
            let pdos = defaults.filter(move |pdo| self.device.sync_manager_of(pdo) == Some(manager.number));
            let pdos = pdos.map(move |pdo| (None, pdo.index, Content::Pdo(pdo, Growth::default()), pdo.bits));
            pdos.chain(self.groups().flat_map(move |group| self.group(manager, group)))
        });
        let mut bit: u32 = 0;
        pdos.filter_map(move |(slot, index, content, bits)| {
            // For a gap, `bits` is the alignment. The length of the gap depends on its offset.
            let bits = if content == Content::Gap { bit.next_multiple_of(bits.max(1)) - bit } else { bits };
            let placed = SlotPdo { slot, index, sync_manager, bit, bits, content };
            bit = bit.saturating_add(bits);
            (bits > 0).then_some(placed)
        })
    }

    /// Returns a PDO of the module in a slot, or `None` if the slot has no module or the module has no such PDO.
    /// `index` is the PDO's index in slot 0, as in the device description.
    #[must_use]
    pub fn pdo(&self, slot: u16, index: u16) -> Option<SlotPdo> {
        let is_it = |placed: &SlotPdo| match placed.content {
            Content::Pdo(pdo, _) => placed.slot == Some(slot) && pdo.index == index,
            Content::Gap => false,
        };
        self.device.sync_managers.iter().find_map(|manager| self.pdos(manager.number).find(is_it))
    }

    /// Returns the length of a sync manager's process data in bytes, rounded up.
    #[must_use]
    pub fn bytes(&self, sync_manager: u8) -> usize {
        let end = self.pdos(sync_manager).last().map_or(0, |placed| placed.bit + placed.bits);
        end.div_ceil(8) as usize
    }

    /// Returns the start-up commands for the transitions IP and PS. Send them in Pre-Operational before you request
    /// Safe-Operational.
    pub fn startup(&self) -> impl Iterator<Item = StartupCommand> + '_ {
        self.commands(Transition::IP).chain(self.commands(Transition::PS))
    }

    /// Returns the commands of a transition in this order: module idents, commands of the device, commands of the
    /// modules, PDO mappings, and PDO assignment. Only the commands of the transition PS contain PDO mappings and PDO
    /// assignment.
    pub fn commands(&self, transition: Transition) -> impl Iterator<Item = StartupCommand> + '_ {
        let of_write = move |write| StartupCommand::of_write(transition, write);
        let downloads = self.device.slots.is_some_and(|slots| slots.download_idents.contains(transition));
        let idents = downloads.then(|| self.idents().map(of_write)).into_iter().flatten();
        let of_device = self.device.init_commands(transition);
        let modules = self.plugged().flat_map(move |(module, slot)| {
            let growth = self.objects(slot);
            let due = module.init_commands.iter().filter(move |command| command.transitions.contains(transition));
            due.map(move |command| StartupCommand::of_init(command, transition, growth))
        });
        let assigns = transition == Transition::PS;
        let assignment = assigns.then(|| self.assignment().map(of_write)).into_iter().flatten();
        idents.chain(of_device).chain(modules).chain(assignment)
    }

    /// Calls `visit` for each command of a transition, in the order of [`commands`](Self::commands).
    ///
    /// # Errors
    ///
    /// Stops at the first error of `visit` and returns this error.
    pub fn try_for_each_command<E>(
        &self,
        transition: Transition,
        visit: impl FnMut(StartupCommand) -> Result<(), E>,
    ) -> Result<(), E> {
        self.commands(transition).try_for_each(visit)
    }

    fn slots(&self) -> &'static [Slot] {
        self.device.slots.map_or(&[], |slots| slots.slots)
    }

    fn known_modules(&self) -> &'static [&'static Module] {
        self.device.slots.map_or(&[], |slots| slots.modules)
    }

    fn count(&self) -> u16 {
        self.slots().iter().map(|slot| slot.max).fold(0, u16::saturating_add)
    }

    /// Returns the slot entry that describes the slot with this number, or `None` if the device has no such slot.
    fn slot(&self, number: u16) -> Option<&'static Slot> {
        let mut first: u16 = 0;
        self.slots().iter().find(|slot| {
            let is_it = (first..first.saturating_add(slot.max)).contains(&number);
            first = first.saturating_add(slot.max);
            is_it
        })
    }

    fn plugged(&self) -> impl Iterator<Item = (&'static Module, u16)> + '_ {
        self.modules.iter().zip(0..).filter_map(|(module, slot)| Some(((*module)?, slot)))
    }

    /// Returns the numbers of the module groups, or a single `None` if the device has no groups.
    fn groups(&self) -> impl Iterator<Item = Option<u16>> {
        let count = self.device.slots.map_or(0, |slots| slots.pdo_groups.len()) as u16;
        (count == 0).then_some(None).into_iter().chain((0..count).map(Some))
    }

    /// Returns the PDOs of one module group in a sync manager, preceded by the padding of the group.
    fn group(
        &self,
        manager: &'static SyncManager,
        group: Option<u16>,
    ) -> impl Iterator<Item = (Option<u16>, u16, Content, u32)> + '_ {
        let rules = group.and_then(|group| self.device.slots?.pdo_groups.get(usize::from(group)));
        let is_member = move |module: &Module| match group {
            None => true,
            // A module with an invalid group number belongs to the last group.
            Some(group) => usize::from(module.pdo_group).min(self.last_group()) == usize::from(group),
        };
        let members = self.plugged().filter(move |(module, _)| is_member(module));
        let pdos = members.flat_map(move |(module, slot)| {
            let pdos = module.pdos.iter().filter(move |pdo| self.device.sync_manager_of(pdo) == Some(manager.number));
            pdos.map(move |pdo| self.in_slot(pdo, slot))
        });
        let outputs = manager.purpose == super::SyncManagerPurpose::Outputs;
        let gap = rules.filter(|rules| rules.alignment > 0).map(|rules| {
            let index = if outputs { rules.rx_pdo } else { rules.tx_pdo };
            (None, index.unwrap_or(0), Content::Gap, u32::from(rules.alignment) * 8)
        });
        // A group without process data needs no padding.
        let mut pdos = pdos.peekable();
        let gap = gap.filter(|_| pdos.peek().is_some());
        gap.into_iter().chain(pdos)
    }

    fn last_group(&self) -> usize {
        self.device.slots.map_or(0, |slots| slots.pdo_groups.len().saturating_sub(1))
    }

    fn in_slot(&self, pdo: &'static PdoInfo, slot: u16) -> (Option<u16>, u16, Content, u32) {
        let shift = self.growth(slot, |increments| increments.pdo).of(pdo.depends_on);
        (Some(slot), pdo.index.wrapping_add(shift), Content::Pdo(pdo, self.objects(slot)), pdo.bits)
    }

    /// Returns the offsets that a slot adds to object indices.
    fn objects(&self, slot: u16) -> Growth {
        self.growth(slot, |increments| increments.index)
    }

    /// Returns the index offsets of a slot: the slot number and the group number, each multiplied by its increment.
    fn growth(&self, slot: u16, increment: impl Fn(Increments) -> u16) -> Growth {
        let Some(place) = self.slot(slot) else { return Growth::default() };
        let group = place.group.map_or(0, |group| increment(group.increments).wrapping_mul(group.number));
        Growth { slot: increment(place.increments).wrapping_mul(slot), group }
    }

    fn idents(&self) -> impl Iterator<Item = SdoWrite> + '_ {
        // `check` rejects plans with more modules.
        let last = self.plugged().last().map_or(0, |(_, slot)| slot + 1).min(u16::from(u8::MAX)) as u8;
        let ident = |slot: u16| self.module(slot).map_or(0, |module| module.ident);
        let entries = (0..last).map(move |slot| SdoWrite::new_u32(MODULE_IDENTS, slot + 1, ident(u16::from(slot))));
        let count = SdoWrite::new_u8(MODULE_IDENTS, 0, last);
        core::iter::once(SdoWrite::new_u8(MODULE_IDENTS, 0, 0)).chain(entries).chain(core::iter::once(count))
    }

    fn assignment(&self) -> impl Iterator<Item = SdoWrite> + '_ {
        let coe = self.device.mailbox.coe;
        let (assigns, configures) = (coe.is_some_and(|coe| coe.pdo_assign), coe.is_some_and(|coe| coe.pdo_config));
        let all = || self.device.sync_managers.iter().filter(|manager| manager.carries_data());
        let managers = move || all().filter(move |_| assigns);
        let clear = managers().map(|manager| SdoWrite::new_u8(manager.assignment(), 0, 0));
        let mappings = all().flat_map(|manager| self.pdos(manager.number)).filter(move |_| configures);
        let mappings = mappings.flat_map(|placed| placed.mapping());
        let assign = managers().flat_map(move |manager| {
            let indices = move || self.pdos(manager.number).map(|placed| placed.index).filter(|&index| index != 0);
            assignment_writes(manager.assignment(), indices)
        });
        clear.chain(mappings).chain(assign)
    }
}

impl SlotPdo {
    /// Returns the writes of the mapping, or no writes if the mapping cannot be written or the padding has no PDO. The
    /// mapping of padding depends only on the length of the padding.
    fn mapping(&self) -> impl Iterator<Item = SdoWrite> {
        let (index, bits) = (self.index, self.bits);
        let writes = match self.content {
            Content::Pdo(pdo, growth) => pdo.is_writable().then_some((pdo, growth)),
            Content::Gap => None,
        };
        let gap = (self.content == Content::Gap && index != 0).then_some(bits);
        let writes = writes.into_iter().flat_map(move |(pdo, growth)| mapping_writes(index, pdo.mapping, growth));
        let gap = gap.into_iter().flat_map(move |bits| gap_writes(index, bits));
        writes.chain(gap)
    }
}

/// Maximum number of bits of an entry in a PDO mapping.
const MAX_ENTRY_BITS: u32 = u8::MAX as u32;

/// Returns the writes that map `bits` bits of padding. [`SlotPlan::check`] checks that the mapping has enough sub-indices.
fn gap_writes(index: u16, bits: u32) -> impl Iterator<Item = SdoWrite> {
    let count = bits.div_ceil(MAX_ENTRY_BITS).min(MAX_MAPPED_ENTRIES as u32);
    let entry = move |at: u32| {
        let rest = (bits - at * MAX_ENTRY_BITS).min(MAX_ENTRY_BITS);
        SdoWrite::new_u32(index, at as u8 + 1, MappedEntry::new(0, 0, rest).word())
    };
    let count_of = move |count: u32| core::iter::once(SdoWrite::new_u8(index, 0, count as u8));
    count_of(0).chain((0..count).map(entry)).chain(count_of(count))
}

/// Maximum number of entries of a list of PDOs or of module idents.
const MAX_LISTED: usize = u8::MAX as usize;

/// Checks that a list object has enough sub-indices for `count` entries.
fn room_for(index: u16, count: usize, max: usize) -> Result<(), PlanError> {
    if count > max {
        return Err(PlanError::TooMany { index, count });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
