//! Which requests a device takes.

use crate::register::RegisterTable;

/// Which requests a device takes, table by table. Generated bindings have it as `MODBUS`.
///
/// ```
/// use lexibus::modbus::{Limits, Span, TableLimits};
///
/// // Functions 3 and 6 only, 8 registers at once, and nothing at address 4:
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
    /// Holding registers (4x).
    pub holding: TableLimits,
    /// Input registers (3x).
    pub input: TableLimits,
    /// Coils (0x).
    pub coil: TableLimits,
    /// Discrete inputs (1x).
    pub discrete: TableLimits,
}

/// Which requests a table takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TableLimits {
    /// Numbers of the functions; empty where the description doesn't say, and all that the table has are meant.
    pub functions: &'static [u8],
    /// The greatest number of registers, or bits, that one request reads.
    pub max_read: u16,
    /// The greatest number of registers, or bits, that one request writes.
    pub max_write: u16,
    /// Whether a value that is longer than one request is read and written in several, one after the other. The device, or
    /// who reads it, may see one half of the new value then and one half of the old one.
    pub split: bool,
    /// Addresses that can be read along with their neighbours: the description has them, every model has them, and reading
    /// them changes nothing.
    pub readable: &'static [Span],
}

/// Addresses of a table that follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The first one.
    pub first: u16,
    /// The last one.
    pub last: u16,
    /// How many registers of 16 bits each stands for, as in [`Register`](crate::Register).
    pub words_per_address: u8,
}

impl Span {
    /// Addresses that stand for a register, or a bit, each.
    #[must_use]
    pub const fn new(first: u16, last: u16) -> Self {
        Self { first, last, words_per_address: 1 }
    }

    /// The same addresses where each stands for so many registers.
    #[must_use]
    pub const fn words_per_address(self, words: u8) -> Self {
        Self { words_per_address: words, ..self }
    }
}

impl TableLimits {
    /// Holding registers as the specification of Modbus has them: 125 are read at once, 123 written.
    pub const HOLDING: Self = Self::standard(125, 123);

    /// Input registers as the specification has them: 125 are read at once.
    pub const INPUT: Self = Self::standard(125, 0);

    /// Coils as the specification has them: 2000 are read at once, 1968 written.
    pub const COIL: Self = Self::standard(2000, 1968);

    /// Discrete inputs as the specification has them: 2000 are read at once.
    pub const DISCRETE: Self = Self::standard(2000, 0);

    const fn standard(max_read: u16, max_write: u16) -> Self {
        Self { functions: &[], max_read, max_write, split: false, readable: &[] }
    }

    /// Whether the table takes this function, or the description doesn't say which ones it takes.
    #[must_use]
    pub const fn takes(&self, function: u8) -> bool {
        self.functions.is_empty() || self.names(function)
    }

    /// Whether the description says that the table takes this function.
    #[must_use]
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
    /// What the specification of Modbus allows (MODBUS Application Protocol V1.1b3, 6.1 to 6.12).
    pub const STANDARD: Self = Self {
        holding: TableLimits::HOLDING,
        input: TableLimits::INPUT,
        coil: TableLimits::COIL,
        discrete: TableLimits::DISCRETE,
    };

    /// What is known of a table.
    #[must_use]
    pub const fn of(&self, table: RegisterTable) -> &TableLimits {
        match table {
            RegisterTable::Holding => &self.holding,
            RegisterTable::Input => &self.input,
            RegisterTable::Coil => &self.coil,
            RegisterTable::DiscreteInput => &self.discrete,
        }
    }

    /// The greatest number of registers, or bits, that one request reads from a table: what the device allows, and never
    /// more than the specification does.
    #[must_use]
    pub const fn max_read(&self, table: RegisterTable) -> u16 {
        smaller(self.of(table).max_read, Self::STANDARD.of(table).max_read)
    }

    /// The greatest number of registers, or bits, that one request writes to a table: what the device allows, and never
    /// more than the specification does.
    #[must_use]
    pub const fn max_write(&self, table: RegisterTable) -> u16 {
        smaller(self.of(table).max_write, Self::STANDARD.of(table).max_write)
    }
}

impl Default for Limits {
    /// [`Limits::STANDARD`].
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
        let small = TableLimits { max_read: 8, max_write: 2, ..TableLimits::HOLDING };
        let limits = Limits { holding: small, ..limits };
        assert_eq!((limits.max_read(RegisterTable::Holding), limits.max_write(RegisterTable::Holding)), (8, 2));
        assert_eq!((limits.max_read(RegisterTable::Coil), limits.max_write(RegisterTable::Input)), (2000, 0));
        assert_eq!(limits.max_read(RegisterTable::DiscreteInput), 2000);
    }
}
