//! Limits of a device's requests.

use crate::register::RegisterTable;

/// The requests that a device supports, for each Modbus table. Generated bindings contain these limits as the constant
/// `MODBUS`.
///
/// ```
/// use lexibus::modbus::{Limits, Span, TableLimits};
///
/// // Only functions 3 and 6, at most 8 registers per read request, and no register at address 4:
/// const MODBUS: Limits = Limits {
///     holding: TableLimits {
///         functions: &[3, 6],
///         max_read: 8,
///         readable: &[Span::new(0, 3), Span::new(5, 20)],
///         ..TableLimits::HOLDING
///     },
///     ..Limits::STANDARD
/// };
/// assert!(MODBUS.holding.takes(6) && !MODBUS.holding.takes(16));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Limits {
    /// Limits for holding registers (4x).
    pub holding: TableLimits,
    /// Limits for input registers (3x).
    pub input: TableLimits,
    /// Limits for coils (0x).
    pub coil: TableLimits,
    /// Limits for discrete inputs (1x).
    pub discrete: TableLimits,
}

/// The requests that a device supports for one table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TableLimits {
    /// Supported function codes. The list is empty if the device description doesn't list the supported functions.
    /// Clients then use all functions of the table except the optional functions 22 and 23.
    pub functions: &'static [u8],
    /// Maximum number of registers or bits in a read request.
    pub max_read: u16,
    /// Maximum number of registers or bits in a write request.
    pub max_write: u16,
    /// True if a value that exceeds one request is split into several requests. A transfer in several requests isn't
    /// atomic: the device or the client may see a mix of the old and the new value.
    pub split: bool,
    /// Addresses that a read request may include if they are between the addresses of two items. These addresses exist
    /// on every model, and reading them has no side effects.
    pub readable: &'static [Span],
}

/// Maximum number of registers that function 23 writes (MODBUS Application Protocol V1.1b3, 6.17).
pub(crate) const MAX_EXCHANGED: u16 = 121;

/// A range of consecutive addresses of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// First address.
    pub first: u16,
    /// Last address.
    pub last: u16,
    /// Number of 16-bit registers per address, as in [`Register`](crate::Register).
    pub words_per_address: u8,
}

impl Span {
    /// Creates a range with one register or bit per address.
    #[must_use]
    pub const fn new(first: u16, last: u16) -> Self {
        Self { first, last, words_per_address: 1 }
    }

    /// Returns the same range with `words` registers per address.
    #[must_use]
    pub const fn words_per_address(self, words: u8) -> Self {
        Self { words_per_address: words, ..self }
    }
}

impl TableLimits {
    /// Limits of holding registers in the Modbus specification: 125 per read request, 123 per write request.
    pub const HOLDING: Self = Self::standard(125, 123);

    /// Limit of input registers in the Modbus specification: 125 per read request.
    pub const INPUT: Self = Self::standard(125, 0);

    /// Limits of coils in the Modbus specification: 2000 per read request, 1968 per write request.
    pub const COIL: Self = Self::standard(2000, 1968);

    /// Limit of discrete inputs in the Modbus specification: 2000 per read request.
    pub const DISCRETE: Self = Self::standard(2000, 0);

    const fn standard(max_read: u16, max_write: u16) -> Self {
        Self { functions: &[], max_read, max_write, split: false, readable: &[] }
    }

    /// Returns whether the device supports a function for this table. If the device description lists no functions,
    /// returns true for every function, including the optional functions 22 and 23.
    #[must_use]
    pub const fn takes(&self, function: u8) -> bool {
        self.functions.is_empty() || self.names(function)
    }

    /// Returns whether the device description lists this function for the table.
    #[must_use]
    #[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
    pub const fn names(&self, function: u8) -> bool {
        let mut at = 0;
        while at < self.functions.len() {
            if self.functions[at] == function {
                return true;
            }
            at += 1;
        }
        false
    }
}

impl Limits {
    /// The limits in the Modbus specification (MODBUS Application Protocol V1.1b3, 6.1 to 6.12).
    pub const STANDARD: Self = Self {
        holding: TableLimits::HOLDING,
        input: TableLimits::INPUT,
        coil: TableLimits::COIL,
        discrete: TableLimits::DISCRETE,
    };

    /// Returns the limits of a Modbus table.
    #[must_use]
    pub const fn of(&self, table: RegisterTable) -> &TableLimits {
        match table {
            RegisterTable::Holding => &self.holding,
            RegisterTable::Input => &self.input,
            RegisterTable::Coil => &self.coil,
            RegisterTable::DiscreteInput => &self.discrete,
        }
    }

    /// Returns the maximum number of registers or bits in a read request. The lower of the device's limit and the
    /// specification's limit applies.
    #[must_use]
    pub const fn max_read(&self, table: RegisterTable) -> u16 {
        smaller(self.of(table).max_read, Self::STANDARD.of(table).max_read)
    }

    /// Returns the maximum number of registers or bits in a write request. The lower of the device's limit and the
    /// specification's limit applies.
    #[must_use]
    pub const fn max_write(&self, table: RegisterTable) -> u16 {
        smaller(self.of(table).max_write, Self::STANDARD.of(table).max_write)
    }

    /// Returns the maximum number of holding registers that a request with function 23 writes: the limit of a write
    /// request, but at most 121. Returns 0 if the device description doesn't list function 23, because the function is
    /// optional. [`max_read`](Self::max_read) limits the registers that the request reads.
    #[must_use]
    pub const fn max_exchanged(&self) -> u16 {
        if self.holding.names(23) {
            smaller(self.max_write(RegisterTable::Holding), MAX_EXCHANGED)
        } else {
            0
        }
    }
}

impl Default for Limits {
    /// Returns [`Limits::STANDARD`].
    fn default() -> Self {
        Self::STANDARD
    }
}

const fn smaller(one: u16, other: u16) -> u16 {
    if one < other {
        one
    } else {
        other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_that_nobody_named() {
        assert!(TableLimits::HOLDING.takes(16) && !TableLimits::HOLDING.names(22));
        let limits = TableLimits { functions: &[3, 22], ..TableLimits::HOLDING };
        assert!(limits.takes(22) && limits.names(22) && !limits.takes(6) && !limits.names(6));
    }

    #[test]
    fn never_more_than_modbus_has() {
        let greedy = TableLimits { max_read: 500, max_write: 500, ..TableLimits::HOLDING };
        let limits = Limits { holding: greedy, ..Limits::default() };
        assert_eq!((limits.max_read(RegisterTable::Holding), limits.max_write(RegisterTable::Holding)), (125, 123));
        assert_eq!((limits.max_exchanged(), Limits::STANDARD.max_exchanged()), (0, 0));
        let exchanging = |max_write| TableLimits { functions: &[3, 16, 23], max_write, ..TableLimits::HOLDING };
        let most = |max_write| Limits { holding: exchanging(max_write), ..Limits::STANDARD }.max_exchanged();
        assert_eq!((most(500), most(8)), (121, 8));
        let small = TableLimits { max_read: 8, max_write: 2, ..TableLimits::HOLDING };
        let limits = Limits { holding: small, ..limits };
        assert_eq!((limits.max_read(RegisterTable::Holding), limits.max_write(RegisterTable::Holding)), (8, 2));
        assert_eq!((limits.max_read(RegisterTable::Coil), limits.max_write(RegisterTable::Input)), (2000, 0));
        assert_eq!(limits.max_read(RegisterTable::DiscreteInput), 2000);
    }
}
