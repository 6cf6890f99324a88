//! Limits of Modbus requests.

/// Maximum number of registers or bits in one request (MODBUS Application Protocol 6).
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub read: u16,
    pub write: u16,
}

impl Limits {
    /// Limits for registers.
    pub const REGISTERS: Self = Self { read: 125, write: 123 };
    /// Limits for bits.
    pub const BITS: Self = Self { read: 2000, write: 1968 };
}
