//! Behavior of a simulated axis.

use core::fmt;

use super::device::Device;

/// Behavior of one axis of a device, for example of a drive.
pub(super) trait Behavior: fmt::Debug + Send {
    /// Returns the number of the axis. The first axis has number 1.
    fn axis(&self) -> u8;

    /// Executes one step of the simulation. Returns whether the state of the axis has changed.
    fn step(&mut self, device: &mut Device) -> bool;

    /// Reacts to a write by a client or by process data.
    fn observe(&mut self, device: &mut Device);

    /// Enters the fault reaction with an error code. If `persists` is true, the fault cannot be reset before
    /// [`clear_cause`](Self::clear_cause).
    fn fail(&mut self, code: u16, persists: bool, device: &mut Device);

    /// Removes the cause of the fault, so that the fault can be reset.
    fn clear_cause(&mut self);
}
