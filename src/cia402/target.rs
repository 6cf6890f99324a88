//! Set-points of profile position mode.

use super::bits::{IMMEDIATELY, RELATIVE};

/// A set-point of profile position mode (CiA 402-2 12.2). Positions are raw values of the target position (0x607A), in
/// the position unit of the drive.
///
/// ```
/// use lexibus::cia402::Target;
///
/// let after_the_active_move = Target::absolute(5000);
/// let now = Target::relative(-20).immediately();
/// # assert_ne!(after_the_active_move, now);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    pub(super) position: i32,
    /// Bits of the controlword.
    pub(super) bits: u16,
}

impl Target {
    /// Bits of the controlword that belong to a set-point.
    pub(super) const BITS: u16 = IMMEDIATELY | RELATIVE;

    /// Creates a set-point with an absolute position.
    #[must_use]
    pub const fn absolute(position: i32) -> Self {
        Self { position, bits: 0 }
    }

    /// Creates a set-point relative to the last target position. The positioning option code (0x60F2) can select another
    /// reference.
    #[must_use]
    pub const fn relative(distance: i32) -> Self {
        Self { position: distance, bits: RELATIVE }
    }

    /// Returns the set-point with the "change set immediately" bit: the drive replaces the active set-point with this
    /// one. Without this bit, the axis first completes the active move.
    #[must_use]
    pub const fn immediately(self) -> Self {
        Self { bits: self.bits | IMMEDIATELY, ..self }
    }

    pub(super) const fn is_immediate(self) -> bool {
        self.bits & IMMEDIATELY != 0
    }
}
