//! The plan of what is plugged where.

mod records;

pub use records::{RecordWrite, Records, Replacement};

use core::error;
use core::fmt;

use super::descriptor::{contains, numbers, Dap, Module, Submodule, SubmoduleUse};

/// What is plugged into a device: at most `N` submodules, those of the device access point included.
///
/// It checks each step against the device's description, and yields what a controller expects of the device
/// ([`Plan::expected`]) and sends to it at start-up ([`Plan::records`]).
#[derive(Clone, Copy, Debug)]
pub struct Plan<const N: usize> {
    dap: &'static Dap,
    /// By slot and subslot; those from `len` on are empty.
    entries: [Option<Entry>; N],
    len: usize,
}

/// A submodule in its place, or a module that has none yet.
#[derive(Clone, Copy, Debug)]
struct Entry {
    slot: u16,
    subslot: u16,
    module: &'static Module,
    submodule: Option<&'static Submodule>,
    is_fixed: bool,
}

/// What a controller expects in one subslot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Number of the application process (API).
    pub api: u32,
    /// Module ident number.
    pub module_ident: u32,
    /// Submodule ident number.
    pub submodule_ident: u32,
    /// Length of the inputs in bytes; `None` where there are none.
    pub input_len: Option<u16>,
    /// Length of the outputs in bytes; `None` where there are none.
    pub output_len: Option<u16>,
    /// Length of the provider status (IOPS) in bytes.
    pub provider_len: u8,
    /// Length of the consumer status (IOCS) in bytes.
    pub consumer_len: u8,
}

/// Why something can't be plugged, pulled or replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PlanError {
    /// The device has no such slot.
    NoSuchSlot,
    /// There is a module in the slot already.
    SlotTaken,
    /// The module in the slot can't be removed.
    FixedModule,
    /// The device doesn't take this module, or not in this slot.
    ModuleNotAllowed,
    /// There is no module in the slot.
    EmptySlot,
    /// The module has no such subslot.
    NoSuchSubslot,
    /// There is a submodule in the subslot already.
    SubslotTaken,
    /// The submodule in the subslot can't be removed.
    FixedSubmodule,
    /// The module doesn't take this submodule, or not in this subslot.
    SubmoduleNotAllowed,
    /// The plan has no room for a further submodule: `N` is too small.
    Full,
    /// The inputs would be longer than the device can send.
    InputsTooLong,
    /// The outputs would be longer than the device can receive.
    OutputsTooLong,
    /// Inputs and outputs together would be longer than the device can handle.
    DataTooLong,
    /// No submodule of the plan has such a record.
    NoSuchRecord,
    /// The record has another length.
    RecordLength,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoSuchSlot => "the device has no such slot",
            Self::SlotTaken => "there is a module in the slot already",
            Self::FixedModule => "the module in the slot can't be removed",
            Self::ModuleNotAllowed => "the module isn't allowed in this slot",
            Self::EmptySlot => "there is no module in the slot",
            Self::NoSuchSubslot => "the module has no such subslot",
            Self::SubslotTaken => "there is a submodule in the subslot already",
            Self::FixedSubmodule => "the submodule in the subslot can't be removed",
            Self::SubmoduleNotAllowed => "the submodule isn't allowed in this subslot",
            Self::Full => "the plan has no room for a further submodule",
            Self::InputsTooLong => "the inputs are longer than the device can send",
            Self::OutputsTooLong => "the outputs are longer than the device can receive",
            Self::DataTooLong => "inputs and outputs are longer than the device can handle",
            Self::NoSuchRecord => "no submodule of the plan has such a record",
            Self::RecordLength => "the record has another length",
        })
    }
}

impl error::Error for PlanError {}

impl<const N: usize> Plan<N> {
    /// The device access point with what is always in it.
    ///
    /// # Errors
    ///
    /// When that is more than `N` submodules, or more data than the device can handle.
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

    /// The same with the modules and submodules that are in it unless somebody chooses otherwise (`UsedInSlots` of
    /// GSDML).
    ///
    /// # Errors
    ///
    /// As [`Plan::new`].
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

    /// Plugs `module` with its own submodules into `slot`.
    ///
    /// # Errors
    ///
    /// When there is no such slot, it is taken, the module isn't allowed there, or there is no room for it. The plan is
    /// then as it was.
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

    /// Takes the module in `slot` out, with its submodules.
    ///
    /// # Errors
    ///
    /// When there is none, or it can't be removed.
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
    /// When the slot is empty, there is no such subslot, it is taken, the submodule isn't allowed there, or there is no
    /// room for it. The plan is then as it was.
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

    /// Takes the submodule in `subslot` of `slot` out.
    ///
    /// # Errors
    ///
    /// When there is none, or it can't be removed.
    pub fn unplug_submodule(&mut self, slot: u16, subslot: u16) -> Result<(), PlanError> {
        let at = self.submodules().find(|(entry, _)| entry.slot == slot && entry.subslot == subslot);
        if at.ok_or(PlanError::NoSuchSubslot)?.0.is_fixed {
            return Err(PlanError::FixedSubmodule);
        }
        self.remove(slot, subslot);
        Ok(())
    }

    /// The device access point.
    #[must_use]
    pub const fn dap(&self) -> &'static Dap {
        self.dap
    }

    /// The module in `slot`.
    #[must_use]
    pub fn module(&self, slot: u16) -> Option<&'static Module> {
        self.used().find(|entry| entry.slot == slot).map(|entry| entry.module)
    }

    /// The submodule in `subslot` of `slot`.
    #[must_use]
    pub fn submodule(&self, slot: u16, subslot: u16) -> Option<&'static Submodule> {
        self.used().find(|entry| entry.slot == slot && entry.subslot == subslot)?.submodule
    }

    /// What a controller expects, by slot and subslot. A slot whose module has no submodule yet isn't there.
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

    /// Length in bytes of the inputs and of the outputs, provider and consumer status included.
    ///
    /// Data stand with their provider status on the one side, and their consumer status on the other. A submodule
    /// without data counts as one with inputs of no length.
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

    /// Adds a module with the submodules that are always in it; the slot is empty.
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

    /// Puts an entry in its place by slot and subslot. The first submodule of a module takes the place of the module's.
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

    /// Removes a submodule, and leaves its module even where it was the last one.
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
