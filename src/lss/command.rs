//! Command specifiers: the first bytes of LSS messages (CiA 305).

pub(super) const SWITCH_GLOBAL: u8 = 0x04;
pub(super) const CONFIGURE_NODE_ID: u8 = 0x11;
pub(super) const CONFIGURE_BIT_TIMING: u8 = 0x13;
pub(super) const ACTIVATE_BIT_TIMING: u8 = 0x15;
pub(super) const STORE: u8 = 0x17;
/// First of four commands, one for each number of the address.
pub(super) const SWITCH_SELECTIVE: u8 = 0x40;
pub(super) const SWITCHED_SELECTIVE: u8 = 0x44;
pub(super) const IDENTIFY_UNCONFIGURED: u8 = 0x4C;
/// Answer to a fastscan request.
pub(super) const IDENTIFIED: u8 = 0x4F;
pub(super) const IDENTIFIED_UNCONFIGURED: u8 = 0x50;
pub(super) const FAST_SCAN: u8 = 0x51;
/// First of four commands, one for each number of the address.
pub(super) const INQUIRE: u8 = 0x5A;
pub(super) const INQUIRE_NODE_ID: u8 = 0x5E;

/// Node-ID value that means "no node-ID".
pub(super) const NO_NODE_ID: u8 = 0xFF;

/// Value of the field BitCheck in the fastscan request that starts a scan.
pub(super) const START_SCAN: u8 = 0x80;
