//! Bits of the controlword and of the statusword (CiA 402-2 10.3.1 and 10.3.2).

/// Controlword: "new set-point" in profile position mode, "homing operation start" in homing mode.
pub(super) const START: u16 = 1 << 4;
/// Controlword: "change set immediately".
pub(super) const IMMEDIATELY: u16 = 1 << 5;
/// Controlword: "relative".
pub(super) const RELATIVE: u16 = 1 << 6;
/// Controlword: bits 0 to 3 and 7, which command the state machine.
pub(super) const OF_STATE: u16 = 0x8F;
/// Controlword: bits 0 to 3 and 7 of the command "enable operation".
pub(super) const ENABLE_OPERATION: u16 = 0x0F;
/// Controlword: bits 0 to 3 and 7 of the command "quick stop".
pub(super) const QUICK_STOP: u16 = 0x02;
/// Controlword: "halt".
pub(super) const HALT: u16 = 1 << 8;
/// Controlword: the bits whose meaning depends on the mode.
pub(super) const OF_MODE: u16 = START | IMMEDIATELY | RELATIVE | 1 << 9;

/// Statusword: "target reached".
pub(super) const REACHED: u16 = 1 << 10;
/// Statusword: "set-point acknowledge", "homing attained" or "drive follows the command value", depending on the mode.
pub(super) const CONFIRMED: u16 = 1 << 12;
/// Statusword: "following error", "max slippage error" or "homing error", depending on the mode.
pub(super) const FAILED: u16 = 1 << 13;
