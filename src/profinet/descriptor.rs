//! What a device consists of, as constant data.

/// A device access point: the head of a device, and what can be plugged into it.
#[derive(Clone, Copy, Debug)]
pub struct Dap {
    /// Number of the vendor.
    pub vendor_id: u16,
    /// Number that tells the devices of a vendor apart.
    pub device_id: u16,
    /// The slot that it is in.
    pub slot: u16,
    /// Its ident number, name and submodules.
    pub module: Module,
    /// Slots that there are, by first and last number of each range.
    pub slots: &'static [(u16, u16)],
    /// Modules that can be plugged in.
    pub modules: &'static [ModuleUse],
    /// Greatest length of the cyclic data.
    pub max_lengths: IoLengths,
    /// Greatest length of a record in bytes.
    pub max_record_size: u32,
}

/// Greatest lengths of cyclic data in bytes, provider and consumer status included; `None` where there is no limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IoLengths {
    /// Inputs.
    pub input: Option<u16>,
    /// Outputs.
    pub output: Option<u16>,
    /// Both together.
    pub data: Option<u16>,
}

/// A module.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// Module ident number.
    pub ident: u32,
    /// Its name.
    pub name: &'static str,
    /// Submodules that it has, and those that can be plugged into it.
    pub submodules: &'static [SubmoduleUse],
    /// Subslots that there are, by first and last number of each range; empty = those of its submodules.
    pub subslots: &'static [(u16, u16)],
}

/// A module that a device may have, and where.
#[derive(Clone, Copy, Debug)]
pub struct ModuleUse {
    /// The module.
    pub module: &'static Module,
    /// The slots.
    pub places: Places,
}

impl ModuleUse {
    /// `module` in these slots.
    #[must_use]
    pub const fn new(module: &'static Module, places: Places) -> Self {
        Self { module, places }
    }
}

/// A submodule.
#[derive(Clone, Copy, Debug)]
pub struct Submodule {
    /// Submodule ident number.
    pub ident: u32,
    /// Number of the application process (API): 0, or that of a profile, such as 0x3A00 for PROFIdrive.
    pub api: u32,
    /// Its name.
    pub name: &'static str,
    /// Length of its inputs in bytes, an F message trailer included; `None` where it has none.
    pub input_len: Option<u16>,
    /// Length of its outputs in bytes, an F message trailer included; `None` where it has none.
    pub output_len: Option<u16>,
    /// Length of the provider status (IOPS) in bytes.
    pub provider_len: u8,
    /// Length of the consumer status (IOCS) in bytes.
    pub consumer_len: u8,
    /// Its parameter records with their defaults, in the order of transfer.
    pub records: &'static [Record],
}

/// A submodule that a module may have, and where.
#[derive(Clone, Copy, Debug)]
pub struct SubmoduleUse {
    /// The submodule.
    pub submodule: &'static Submodule,
    /// The subslots.
    pub places: Places,
}

impl SubmoduleUse {
    /// `submodule` in these subslots.
    #[must_use]
    pub const fn new(submodule: &'static Submodule, places: Places) -> Self {
        Self { submodule, places }
    }
}

/// A parameter record with its defaults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Its index.
    pub index: u16,
    /// Its place among the records of its submodule at start-up; 0 = any.
    pub transfer_sequence: u16,
    /// Its name.
    pub name: &'static str,
    /// Its bytes by default.
    pub data: &'static [u8],
}

impl Record {
    /// A record.
    #[must_use]
    pub const fn new(index: u16, transfer_sequence: u16, name: &'static str, data: &'static [u8]) -> Self {
        Self { index, transfer_sequence, name, data }
    }
}

/// Where something may be or has to be plugged: slots of a module, subslots of a submodule, each by first and last
/// number of a range. All empty means anywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Places {
    /// Where it may be.
    pub allowed: &'static [(u16, u16)],
    /// Where it always is.
    pub fixed: &'static [(u16, u16)],
    /// Where it is unless somebody chooses otherwise.
    pub used: &'static [(u16, u16)],
}

impl Places {
    /// Places of each kind.
    #[must_use]
    pub const fn new(
        allowed: &'static [(u16, u16)],
        fixed: &'static [(u16, u16)],
        used: &'static [(u16, u16)],
    ) -> Self {
        Self { allowed, fixed, used }
    }

    /// Always in these places.
    #[must_use]
    pub const fn fixed(fixed: &'static [(u16, u16)]) -> Self {
        Self::new(&[], fixed, &[])
    }

    /// At will in these places.
    #[must_use]
    pub const fn allowed(allowed: &'static [(u16, u16)]) -> Self {
        Self::new(allowed, &[], &[])
    }

    /// Whether it may be, or is, at `place`.
    #[must_use]
    pub const fn fits(&self, place: u16) -> bool {
        let anywhere = self.allowed.is_empty() && self.fixed.is_empty() && self.used.is_empty();
        anywhere || contains(self.allowed, place) || contains(self.fixed, place) || contains(self.used, place)
    }

    /// Whether it is always at `place`.
    #[must_use]
    pub const fn is_fixed(&self, place: u16) -> bool {
        contains(self.fixed, place)
    }
}

/// Whether `number` lies in one of the ranges.
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

/// Each number of the ranges.
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
