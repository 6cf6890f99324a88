//! Additional properties of an item.

/// Set of properties of an item. [`union`](Self::union) combines two sets, also in constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Flags(u8);

impl Flags {
    /// The empty set.
    pub const NONE: Self = Self(0);

    /// The item can be mapped into an RPDO, a PDO that the device receives (CiA 301 7.5.2.36).
    pub const RPDO: Self = Self(1);

    /// The item can be mapped into a TPDO, a PDO that the device transmits (CiA 301 7.5.2.38).
    pub const TPDO: Self = Self(1 << 1);

    /// The item can be mapped into RPDOs and TPDOs.
    pub const PDO: Self = Self(1 | 1 << 1);

    /// Returns the flags that are in `self`, in `other` or in both.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns whether `self` contains all flags of `other`.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: Flags = Flags::RPDO.union(Flags::TPDO);
    const _: () = assert!(BOTH.contains(Flags::RPDO));

    #[test]
    fn sets() {
        assert!(BOTH.contains(Flags::TPDO) && BOTH.contains(BOTH) && BOTH.contains(Flags::NONE));
        assert!(!Flags::RPDO.contains(BOTH));
        assert!(!Flags::NONE.contains(Flags::TPDO));
    }
}
