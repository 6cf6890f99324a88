//! Slot plans: modules and submodules in their slots.

mod records;

pub use records::{RecordWrite, Records, Replacement};

use core::error;
use core::fmt;

use super::descriptor::{contains, numbers, Dap, Module, Submodule, SubmoduleUse};

/// A plan of the submodules of a device: at most `N` submodules, including those of the device access point.
///
/// The plan checks each change against the device description. [`Plan::expected`] returns the configuration that the
/// controller expects. [`Plan::records`] returns the start-up records.
#[derive(Clone, Copy, Debug)]
pub struct Plan<const N: usize> {
    dap: &'static Dap,
    /// Entries sorted by slot and subslot. Only the first `len` entries are used; the others are `None`.
    entries: [Option<Entry>; N],
    len: usize,
}

/// A plugged submodule, or a module without submodules.
#[derive(Clone, Copy, Debug)]
struct Entry {
    slot: u16,
    subslot: u16,
    module: &'static Module,
    submodule: Option<&'static Submodule>,
    is_fixed: bool,
}

/// The expected configuration of a subslot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Application process identifier (API).
    pub api: u32,
    /// Module ident number.
    pub module_ident: u32,
    /// Submodule ident number.
    pub submodule_ident: u32,
    /// Length of the inputs in bytes; `None` if there are no inputs.
    pub input_len: Option<u16>,
    /// Length of the outputs in bytes; `None` if there are no outputs.
    pub output_len: Option<u16>,
    /// Length of the provider status (IOPS) in bytes.
    pub provider_len: u8,
    /// Length of the consumer status (IOCS) in bytes.
    pub consumer_len: u8,
}

/// Reasons why an operation on a plan fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PlanError {
    /// The device doesn't have the slot.
    NoSuchSlot,
    /// The slot already has a module.
    SlotTaken,
    /// The module in the slot cannot be removed.
    FixedModule,
    /// The device doesn't support the module, or doesn't allow it in this slot.
    ModuleNotAllowed,
    /// The slot is empty.
    EmptySlot,
    /// The module doesn't have the subslot, or the subslot contains no submodule to remove.
    NoSuchSubslot,
    /// The subslot already has a submodule.
    SubslotTaken,
    /// The submodule in the subslot cannot be removed.
    FixedSubmodule,
    /// The module doesn't support the submodule, or doesn't allow it in this subslot.
    SubmoduleNotAllowed,
    /// The number of submodules, plus the number of modules without submodules, exceeds `N`.
    Full,
    /// The inputs exceed the device's maximum length.
    InputsTooLong,
    /// The outputs exceed the device's maximum length.
    OutputsTooLong,
    /// Inputs and outputs together exceed the device's maximum length.
    DataTooLong,
    /// The plan has no record with this address.
    NoSuchRecord,
    /// The length of the replacement differs from the length of the record.
    RecordLength,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoSuchSlot => "the device has no such slot",
            Self::SlotTaken => "the slot already has a module",
            Self::FixedModule => "the module in the slot cannot be removed",
            Self::ModuleNotAllowed => "the module isn't allowed in this slot",
            Self::EmptySlot => "the slot is empty",
            Self::NoSuchSubslot => "the module has no such subslot",
            Self::SubslotTaken => "the subslot already has a submodule",
            Self::FixedSubmodule => "the submodule in the subslot cannot be removed",
            Self::SubmoduleNotAllowed => "the submodule isn't allowed in this subslot",
            Self::Full => "too many submodules for the plan",
            Self::InputsTooLong => "the inputs exceed the device's maximum length",
            Self::OutputsTooLong => "the outputs exceed the device's maximum length",
            Self::DataTooLong => "inputs and outputs together exceed the device's maximum length",
            Self::NoSuchRecord => "the plan has no such record",
            Self::RecordLength => "the data don't have the length of the record",
        })
    }
}

impl error::Error for PlanError {}

impl<const N: usize> Plan<N> {
    /// Creates a plan that contains the device access point and its fixed modules and submodules.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::Full`] if there are more than `N` submodules, or [`PlanError::InputsTooLong`],
    /// [`PlanError::OutputsTooLong`] or [`PlanError::DataTooLong`] if the data exceed a maximum length.
    pub fn new(dap: &'static Dap) -> Result<Self, PlanError> {
        let mut plan = Self { dap, entries: [None; N], len: 0 };
        plan.add_module(dap.slot, &dap.module, true)?;
        for usage in dap.modules {
            for slot in numbers(usage.places.fixed) {
                plan.add_module(slot, usage.module, true)?;
            }
        }
        plan.check_lengths()?;
        Ok(plan)
    }

    /// Creates a plan that contains the fixed modules and submodules, and those that are plugged by default
    /// (`UsedInSlots` of GSDML).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Plan::new`].
    pub fn with_defaults(dap: &'static Dap) -> Result<Self, PlanError> {
        let mut plan = Self::new(dap)?;
        for usage in dap.modules {
            for slot in numbers(usage.places.used) {
                if plan.module(slot).is_none() {
                    plan.add_module(slot, usage.module, false)?;
                }
            }
        }
        for slot in core::iter::once(dap.slot).chain(numbers(dap.slots)) {
            plan.add_used_submodules(slot)?;
        }
        plan.check_lengths()?;
        Ok(plan)
    }

    /// Plugs `module` with its fixed submodules into `slot`.
    ///
    /// # Errors
    ///
    /// Returns a [`PlanError`] if the slot doesn't exist or already has a module. Also returns a [`PlanError`] if the
    /// module isn't allowed in the slot, or if there are too many submodules or data. After an error, the plan is
    /// unchanged.
    pub fn plug(&mut self, slot: u16, module: &'static Module) -> Result<(), PlanError> {
        if let Some(entry) = self.used().find(|entry| entry.slot == slot) {
            return Err(if self.is_fixed_module(slot, entry.module) {
                PlanError::FixedModule
            } else {
                PlanError::SlotTaken
            });
        }
        if !contains(self.dap.slots, slot) {
            return Err(PlanError::NoSuchSlot);
        }
        let mut uses = self.dap.modules.iter();
        if !uses.any(|usage| usage.module.ident == module.ident && usage.places.fits(slot)) {
            return Err(PlanError::ModuleNotAllowed);
        }
        let added = self.add_module(slot, module, false).and_then(|()| self.check_lengths());
        added.inspect_err(|_| self.retain(|entry| entry.slot != slot))
    }

    /// Removes the module in `slot` and its submodules.
    ///
    /// # Errors
    ///
    /// Returns [`PlanError::EmptySlot`] if the slot is empty, or [`PlanError::FixedModule`] if the module cannot be
    /// removed.
    pub fn unplug(&mut self, slot: u16) -> Result<(), PlanError> {
        let module = self.module(slot).ok_or(PlanError::EmptySlot)?;
        if self.is_fixed_module(slot, module) {
            return Err(PlanError::FixedModule);
        }
        self.retain(|entry| entry.slot != slot);
        Ok(())
    }

    /// Plugs `submodule` into `subslot` of the module in `slot`.
    ///
    /// # Errors
    ///
    /// Returns a [`PlanError`] if the slot is empty, or if the subslot doesn't exist or already has a submodule. Also
    /// returns a [`PlanError`] if the submodule isn't allowed in the subslot, or if there are too many submodules or
    /// data. After an error, the plan is unchanged.
    pub fn plug_submodule(&mut self, slot: u16, subslot: u16, submodule: &'static Submodule) -> Result<(), PlanError> {
        let module = self.module(slot).ok_or(PlanError::EmptySlot)?;
        if let Some(there) = self.submodules().find(|(entry, _)| entry.slot == slot && entry.subslot == subslot) {
            return Err(if there.0.is_fixed { PlanError::FixedSubmodule } else { PlanError::SubslotTaken });
        }
        let is_listed = |usage: &SubmoduleUse| usage.places.fits(subslot);
        if !contains(module.subslots, subslot)
            && (!module.subslots.is_empty() || !module.submodules.iter().any(is_listed))
        {
            return Err(PlanError::NoSuchSubslot);
        }
        let mut uses = module.submodules.iter();
        if !uses.any(|usage| usage.submodule.ident == submodule.ident && is_listed(usage)) {
            return Err(PlanError::SubmoduleNotAllowed);
        }
        let entry = Entry { slot, subslot, module, submodule: Some(submodule), is_fixed: false };
        self.insert(entry)?;
        self.check_lengths().inspect_err(|_| self.remove(slot, subslot))
    }

    /// Removes the submodule in `subslot` of `slot`.
    ///
    /// # Errors
    ///
    /// Returns a [`PlanError`] if the subslot is empty, or if the submodule cannot be removed.
    pub fn unplug_submodule(&mut self, slot: u16, subslot: u16) -> Result<(), PlanError> {
        let at = self.submodules().find(|(entry, _)| entry.slot == slot && entry.subslot == subslot);
        if at.ok_or(PlanError::NoSuchSubslot)?.0.is_fixed {
            return Err(PlanError::FixedSubmodule);
        }
        self.remove(slot, subslot);
        Ok(())
    }

    /// Returns the device access point.
    #[must_use]
    pub const fn dap(&self) -> &'static Dap {
        self.dap
    }

    /// Returns the module in `slot`.
    #[must_use]
    pub fn module(&self, slot: u16) -> Option<&'static Module> {
        self.used().find(|entry| entry.slot == slot).map(|entry| entry.module)
    }

    /// Returns the submodule in `subslot` of `slot`.
    #[must_use]
    pub fn submodule(&self, slot: u16, subslot: u16) -> Option<&'static Submodule> {
        self.used().find(|entry| entry.slot == slot && entry.subslot == subslot)?.submodule
    }

    /// Returns the expected configuration, sorted by slot and subslot. Modules without submodules are left out.
    pub fn expected(&self) -> impl Iterator<Item = Expected> + '_ {
        self.submodules().map(|(entry, submodule)| Expected {
            slot: entry.slot,
            subslot: entry.subslot,
            api: submodule.api,
            module_ident: entry.module.ident,
            submodule_ident: submodule.ident,
            input_len: submodule.input_len,
            output_len: submodule.output_len,
            provider_len: submodule.provider_len,
            consumer_len: submodule.consumer_len,
        })
    }

    /// Returns the lengths of the input frame and of the output frame in bytes.
    ///
    /// A frame contains the data of its direction with their provider status, and the consumer status of the opposite
    /// direction. A submodule without data counts as a submodule with inputs of length 0.
    #[must_use]
    pub fn lengths(&self) -> (u32, u32) {
        self.submodules().fold((0, 0), |(inputs, outputs), (_, submodule)| {
            let provider = u32::from(submodule.provider_len);
            let consumer = u32::from(submodule.consumer_len);
            let (mut to_controller, mut to_device) = (0, 0);
            if submodule.input_len.is_some() || submodule.output_len.is_none() {
                to_controller += u32::from(submodule.input_len.unwrap_or(0)) + provider;
                to_device += consumer;
            }
            if let Some(length) = submodule.output_len {
                to_device += u32::from(length) + provider;
                to_controller += consumer;
            }
            (inputs + to_controller, outputs + to_device)
        })
    }

    fn check_lengths(&self) -> Result<(), PlanError> {
        let (inputs, outputs) = self.lengths();
        let max = &self.dap.max_lengths;
        let exceeds = |length: u32, max: Option<u16>| max.is_some_and(|max| length > u32::from(max));
        match () {
            () if exceeds(inputs, max.input) => Err(PlanError::InputsTooLong),
            () if exceeds(outputs, max.output) => Err(PlanError::OutputsTooLong),
            () if exceeds(inputs + outputs, max.data) => Err(PlanError::DataTooLong),
            () => Ok(()),
        }
    }

    fn is_fixed_module(&self, slot: u16, module: &Module) -> bool {
        let mut uses = self.dap.modules.iter();
        slot == self.dap.slot || uses.any(|usage| usage.module.ident == module.ident && usage.places.is_fixed(slot))
    }

    fn used(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter().flatten()
    }

    fn submodules(&self) -> impl Iterator<Item = (&Entry, &'static Submodule)> {
        self.used().filter_map(|entry| Some((entry, entry.submodule?)))
    }

    /// Adds a module with its fixed submodules, if the slot is empty.
    fn add_module(&mut self, slot: u16, module: &'static Module, is_fixed: bool) -> Result<(), PlanError> {
        if self.module(slot).is_some() {
            return Ok(());
        }
        let place = Entry { slot, subslot: 0, module, submodule: None, is_fixed };
        self.insert(place)?;
        for usage in module.submodules {
            for subslot in numbers(usage.places.fixed) {
                self.insert(Entry { subslot, submodule: Some(usage.submodule), is_fixed: true, ..place })?;
            }
        }
        Ok(())
    }

    fn add_used_submodules(&mut self, slot: u16) -> Result<(), PlanError> {
        let Some(module) = self.module(slot) else { return Ok(()) };
        for usage in module.submodules {
            for subslot in numbers(usage.places.used) {
                if self.submodule(slot, subslot).is_none() {
                    let submodule = Some(usage.submodule);
                    self.insert(Entry { slot, subslot, module, submodule, is_fixed: false })?;
                }
            }
        }
        Ok(())
    }

    /// Inserts an entry at its sorted position. The first submodule of a module replaces the entry of the module
    /// itself.
    fn insert(&mut self, entry: Entry) -> Result<(), PlanError> {
        let is_bare = |other: &&mut Entry| other.slot == entry.slot && other.submodule.is_none();
        if let Some(bare) = self.entries.iter_mut().flatten().find(is_bare) {
            *bare = entry;
            return Ok(());
        }
        let free = self.entries.get_mut(self.len).ok_or(PlanError::Full)?;
        *free = Some(entry);
        self.len += 1;
        if let Some(entries) = self.entries.get_mut(..self.len) {
            entries.sort_unstable_by_key(|entry| entry.map(|entry| (entry.slot, entry.subslot)));
        }
        Ok(())
    }

    /// Removes a submodule. After the last submodule is removed, the module itself remains as an entry.
    fn remove(&mut self, slot: u16, subslot: u16) {
        let of_slot = self.used().filter(|entry| entry.slot == slot).count();
        if of_slot > 1 {
            return self.retain(|entry| (entry.slot, entry.subslot) != (slot, subslot));
        }
        if let Some(entry) = self.entries.iter_mut().flatten().find(|entry| entry.slot == slot) {
            *entry = Entry { subslot: 0, submodule: None, ..*entry };
        }
    }

    fn retain(&mut self, keep: impl Fn(&Entry) -> bool) {
        let mut kept = [None; N];
        let mut len = 0;
        for (to, entry) in kept.iter_mut().zip(self.used().filter(|entry| keep(entry))) {
            *to = Some(*entry);
            len += 1;
        }
        (self.entries, self.len) = (kept, len);
    }
}

#[cfg(test)]
mod tests;
