//! Device description as constants.

/// A device access point (DAP): the head module of a device, with the modules that the device supports.
#[derive(Clone, Copy, Debug)]
pub struct Dap {
    /// Vendor ID.
    pub vendor_id: u16,
    /// Device ID, assigned by the vendor.
    pub device_id: u16,
    /// Slot of the device access point.
    pub slot: u16,
    /// The device access point as a module, with its ident number, name and submodules.
    pub module: Module,
    /// Available slots, as ranges `(first, last)` of slot numbers.
    pub slots: &'static [(u16, u16)],
    /// Modules that the device supports.
    pub modules: &'static [ModuleUse],
    /// Maximum lengths of the cyclic data.
    pub max_lengths: IoLengths,
    /// Maximum length of a record in bytes.
    pub max_record_size: u32,
}

/// Maximum lengths of cyclic data in bytes, including provider and consumer status. `None` means unlimited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IoLengths {
    /// Maximum length of the inputs.
    pub input: Option<u16>,
    /// Maximum length of the outputs.
    pub output: Option<u16>,
    /// Maximum length of inputs and outputs together.
    pub data: Option<u16>,
}

/// A module and its submodules.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// Module ident number.
    pub ident: u32,
    /// Name of the module.
    pub name: &'static str,
    /// Built-in submodules, and submodules that can be plugged in.
    pub submodules: &'static [SubmoduleUse],
    /// Available subslots, as ranges `(first, last)` of subslot numbers. If the list is empty, the subslots of the
    /// submodules are available.
    pub subslots: &'static [(u16, u16)],
}

/// A module that a device supports, and the slots for this module.
#[derive(Clone, Copy, Debug)]
pub struct ModuleUse {
    /// The module.
    pub module: &'static Module,
    /// The slots that the module can occupy.
    pub places: Places,
}

impl ModuleUse {
    /// Creates an entry for `module` in these slots.
    #[must_use]
    pub const fn new(module: &'static Module, places: Places) -> Self {
        Self { module, places }
    }
}

/// A submodule: the lengths of its cyclic data, and its parameter records.
#[derive(Clone, Copy, Debug)]
pub struct Submodule {
    /// Submodule ident number.
    pub ident: u32,
    /// Application process identifier (API): 0, or the number of a profile, such as 0x3A00 for PROFIdrive.
    pub api: u32,
    /// Name of the submodule.
    pub name: &'static str,
    /// Length of the inputs in bytes, including an F-message trailer. `None` if the submodule has no inputs.
    pub input_len: Option<u16>,
    /// Length of the outputs in bytes, including an F-message trailer. `None` if the submodule has no outputs.
    pub output_len: Option<u16>,
    /// Length of the provider status (IOPS) in bytes.
    pub provider_len: u8,
    /// Length of the consumer status (IOCS) in bytes.
    pub consumer_len: u8,
    /// Parameter records with default values, in the order of their transfer.
    pub records: &'static [Record],
}

/// A submodule that a module supports, and the subslots for this submodule.
#[derive(Clone, Copy, Debug)]
pub struct SubmoduleUse {
    /// The submodule.
    pub submodule: &'static Submodule,
    /// The subslots that the submodule can occupy.
    pub places: Places,
}

impl SubmoduleUse {
    /// Creates an entry for `submodule` in these subslots.
    #[must_use]
    pub const fn new(submodule: &'static Submodule, places: Places) -> Self {
        Self { submodule, places }
    }
}

/// A parameter record with default values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Index of the record.
    pub index: u16,
    /// Position of the record among the start-up records of the submodule; 0 means any position.
    pub transfer_sequence: u16,
    /// Name of the record.
    pub name: &'static str,
    /// Default content of the record.
    pub data: &'static [u8],
}

impl Record {
    /// Creates a record.
    #[must_use]
    pub const fn new(index: u16, transfer_sequence: u16, name: &'static str, data: &'static [u8]) -> Self {
        Self { index, transfer_sequence, name, data }
    }
}

/// The slots of a module, or the subslots of a submodule, as ranges `(first, last)` of numbers. If all lists are empty,
/// every slot or subslot is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Places {
    /// Slots or subslots into which the module or submodule can be plugged.
    pub allowed: &'static [(u16, u16)],
    /// Slots or subslots into which the module or submodule is built.
    pub fixed: &'static [(u16, u16)],
    /// Slots or subslots into which the module or submodule is plugged by default.
    pub used: &'static [(u16, u16)],
}

impl Places {
    /// Creates the `Places` of a module or submodule from three lists of slots or subslots.
    #[must_use]
    pub const fn new(
        allowed: &'static [(u16, u16)],
        fixed: &'static [(u16, u16)],
        used: &'static [(u16, u16)],
    ) -> Self {
        Self { allowed, fixed, used }
    }

    /// Creates the `Places` of a module or submodule that is built into these slots or subslots.
    #[must_use]
    pub const fn fixed(fixed: &'static [(u16, u16)]) -> Self {
        Self::new(&[], fixed, &[])
    }

    /// Creates the `Places` of a module or submodule that can be plugged into these slots or subslots.
    #[must_use]
    pub const fn allowed(allowed: &'static [(u16, u16)]) -> Self {
        Self::new(allowed, &[], &[])
    }

    /// Returns whether the slot or subslot is in one of the lists, or all lists are empty.
    #[must_use]
    pub const fn fits(&self, place: u16) -> bool {
        let anywhere = self.allowed.is_empty() && self.fixed.is_empty() && self.used.is_empty();
        anywhere || contains(self.allowed, place) || contains(self.fixed, place) || contains(self.used, place)
    }

    /// Returns whether the module or submodule is built into this slot or subslot.
    #[must_use]
    pub const fn is_fixed(&self, place: u16) -> bool {
        contains(self.fixed, place)
    }
}

/// Returns whether `number` is in one of the ranges.
#[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
pub(super) const fn contains(ranges: &[(u16, u16)], number: u16) -> bool {
    let mut at = 0;
    while at < ranges.len() {
        if ranges[at].0 <= number && number <= ranges[at].1 {
            return true;
        }
        at += 1;
    }
    false
}

/// Returns all numbers in the ranges.
pub(super) fn numbers(ranges: &'static [(u16, u16)]) -> impl Iterator<Item = u16> {
    ranges.iter().flat_map(|&(first, last)| first..=last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn places() {
        const BOTH: Places = Places::new(&[(2, 4)], &[(7, 7)], &[(9, 9)]);
        let fits: Vec<u16> = (0..12).filter(|&place| BOTH.fits(place)).collect();
        assert_eq!(fits, [2, 3, 4, 7, 9]);
        assert!(BOTH.is_fixed(7) && !BOTH.is_fixed(2));
        assert!(Places::new(&[], &[], &[]).fits(0x8000));
        assert!(!Places::fixed(&[(1, 1)]).fits(2) && Places::allowed(&[(1, 1)]).fits(1));
        assert_eq!(numbers(&[(1, 3), (7, 7)]).collect::<Vec<_>>(), [1, 2, 3, 7]);
    }
}
