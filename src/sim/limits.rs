//! Limits of requests of Modbus.

/// How many registers, or bits, one request takes at most (MODBUS Application Protocol 6).
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub read: u16,
    pub write: u16,
}

impl Limits {
    /// Those of registers.
    pub const REGISTERS: Self = Self { read: 125, write: 123 };
    /// Those of single bits.
    pub const BITS: Self = Self { read: 2000, write: 1968 };
}
