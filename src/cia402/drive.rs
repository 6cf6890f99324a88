//! Operations of a drive, blocking and async.

use core::fmt;
use core::marker::PhantomData;
use core::time::Duration;

use super::bits::{CONFIRMED, ENABLE_OPERATION, FAILED, HALT, OF_MODE, OF_STATE, REACHED, START};
use super::error::MotionError;
use super::homing::Outcome;
use super::integer::{ReadInteger, WriteInteger};
use super::objects::{Homing, Objects, Positioning, Velocity};
use super::settling::{Settling, SETTLING};
use super::target::Target;
use super::{Mode, State};
use crate::client::{AsyncClient, Client};
use crate::machine::{MachineState, StateWord};
use crate::remaining::Remaining;

/// Operations of one axis. The method `cia402` of a generated device returns a `Drive`. `C` is the client, and `O`
/// determines the [`Objects`] of the device.
///
/// Methods without a suffix need a [`Client`]. Methods with the suffix `_async` need an [`AsyncClient`] and don't
/// block. Each method that waits has a deadline, and polls the drive every 5 ms. Such a method pauses with
/// [`Client::wait`](crate::Client::wait), and returns [`MotionError::Wait`] if the client fails to wait. If a future is
/// dropped before it completes, bit 4 of the controlword can remain set.
///
/// The [module](super) describes the conditions that apply to all operations.
pub struct Drive<'c, C, O> {
    pub(super) client: &'c mut C,
    objects: PhantomData<fn() -> O>,
}

impl<'c, C, O> Drive<'c, C, O> {
    /// Creates the operations of the drive that `client` accesses.
    #[must_use]
    pub fn new(client: &'c mut C) -> Self {
        Self { client, objects: PhantomData }
    }
}

impl<C, O> fmt::Debug for Drive<'_, C, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Drive").finish_non_exhaustive()
    }
}

/// Defines the operations, blocking and async.
macro_rules! operations {
    (
        $Client:ident $read:ident $write:ident
        $set_mode:ident $mode:ident $wait_reached:ident $home:ident $home_with:ident $move_to:ident $set_velocity:ident
        private $enabled:ident $watched:ident $unhalted:ident $control:ident $command:ident $is_late:ident $change:ident
            $clear:ident $run_homing:ident $homed:ident $ready:ident $acknowledged:ident
        $($async:ident $await:ident)?
    ) => {
        impl<C: $Client, O: Objects<C::Bus>> Drive<'_, C, O> {
            /// Returns the active mode of operation (0x6061).
            ///
            /// # Errors
            ///
            /// Returns [`MotionError::Access`] if the access fails.
            pub $($async)? fn $mode(&mut self) -> Result<Mode, MotionError<C::Error>> {
                let mode = O::modes_of_operation_display().$read(self.client)$(.$await)??;
                Ok(Mode::from_raw(mode as i8))
            }

            /// Changes the mode of operation: writes the mode (0x6060) and waits until the drive confirms it (0x6061).
            ///
            /// If the mode changes, the method first clears bits 4, 5, 6 and 9 of the controlword, whose meaning
            /// depends on the mode. The controlword isn't written if the write could enable the drive or end a quick
            /// stop. This method works in all states. Stop the axis before you change the mode, unless the drive
            /// supports the change in motion. If the operation is enabled, write the target of the new mode before you
            /// activate a velocity, torque or cyclic mode. In these modes, the axis would follow an old target at once.
            ///
            /// `mode` is a [`Mode`], a value of the device's generated enumeration, or an `i8`.
            ///
            /// # Errors
            ///
            /// Returns [`MotionError::ModeNotConfirmed`] if the drive hasn't activated the mode before the deadline.
            /// Returns [`MotionError::Access`] if an access fails, for example because the drive refuses the mode.
            /// Returns [`MotionError::OtherSource`] if the mode would change while the operation is enabled and another
            /// source controls the drive.
            pub $($async)? fn $set_mode(
                &mut self,
                mode: impl StateWord,
                deadline: Duration,
            ) -> Result<(), MotionError<C::Error>> {
                let mode = Mode::from_raw(mode.bits() as i8);
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$change(mode, &mut remaining)$(.$await)?
            }

            /// Waits until the axis has reached its target, which bit 10 of the statusword reports. Use this method in
            /// modes 1 (profile position), 3 (profile velocity) and 4 (profile torque). If bit 10 is already 1 at the
            /// first poll, the bit can still refer to the previous target. The method then waits until 100 ms have
            /// passed, or until the bit has changed to 0 and back to 1.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::FollowingError`] or [`MotionError::Slippage`] if the drive reports a following error or
            ///   too much slippage (bit 13).
            /// - [`MotionError::WrongMode`] if another mode is active, [`MotionError::Halted`] if the "halt" bit is 1,
            ///   [`MotionError::OtherSource`] if another source controls the drive, or [`MotionError::Access`] if an
            ///   access fails.
            /// - [`MotionError::Deadline`] if the axis hasn't reached the target before the deadline. The axis
            ///   continues to move.
            pub $($async)? fn $wait_reached(&mut self, deadline: Duration) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                let mode = self.$mode()$(.$await)??;
                let mut status = self.$watched(mode)$(.$await)??;
                if !matches!(mode, Mode::ProfilePosition | Mode::ProfileVelocity | Mode::ProfileTorque) {
                    return Err(MotionError::WrongMode { active: mode });
                }
                self.$unhalted()$(.$await)??;
                let mut settling = Settling::new(self.client.now(), true);
                loop {
                    if settling.confirms(self.client.now(), status & REACHED != 0) {
                        return Ok(());
                    }
                    if self.$is_late(&mut remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                    status = self.$watched(mode)$(.$await)??;
                }
            }

            /// Reads the statusword. Returns an error if the operation isn't enabled.
            pub(super) $($async)? fn $enabled(&mut self) -> Result<u16, MotionError<C::Error>> {
                let status = O::statusword().$read(self.client)$(.$await)?? as u16;
                match State::from_raw(status) {
                    Some(State::OperationEnabled) => Ok(status),
                    Some(state) if state.is_fault() => {
                        let code = O::error_code().$read(self.client)$(.$await)?;
                        Err(MotionError::Fault { state, code: code.ok().map(|code| code as u16) })
                    }
                    state => Err(MotionError::NotEnabled { state, status }),
                }
            }

            /// Reads the statusword. Returns an error if the operation isn't enabled, or if the drive reports a
            /// following error or too much slippage.
            $($async)? fn $watched(&mut self, mode: Mode) -> Result<u16, MotionError<C::Error>> {
                let status = self.$enabled()$(.$await)??;
                match mode {
                    Mode::ProfilePosition if status & FAILED != 0 => {
                        let error = O::following_error().$read(self.client)$(.$await)?;
                        Err(MotionError::FollowingError { error: error.ok() })
                    }
                    Mode::ProfileVelocity if status & FAILED != 0 => Err(MotionError::Slippage),
                    _ => Ok(status),
                }
            }

            pub(super) $($async)? fn $control(&mut self) -> Result<u16, MotionError<C::Error>> {
                Ok(O::controlword().$read(self.client)$(.$await)?? as u16)
            }

            /// Returns the controlword, or an error if the "halt" bit is 1 or the command isn't "enable operation".
            $($async)? fn $unhalted(&mut self) -> Result<u16, MotionError<C::Error>> {
                let control = enables(self.$control()$(.$await)??)?;
                if control & HALT == 0 { Ok(control) } else { Err(MotionError::Halted) }
            }

            /// Reads the controlword from the drive and clears bit 4, unless the write could change the state.
            $($async)? fn $clear(&mut self) -> Result<(), MotionError<C::Error>> {
                let status = O::statusword().$read(self.client)$(.$await)?? as u16;
                let control = self.$control()$(.$await)??;
                if control & START != 0 && keeps_state(State::from_raw(status), control) {
                    self.$command(control & !START)$(.$await)??;
                }
                Ok(())
            }

            pub(super) $($async)? fn $command(&mut self, control: u16) -> Result<(), MotionError<C::Error>> {
                Ok(O::controlword().$write(self.client, control.into())$(.$await)??)
            }

            /// Waits until the next poll and returns false, or returns true if the deadline has passed.
            pub(super) $($async)? fn $is_late(&mut self, remaining: &mut Remaining) -> Result<bool, MotionError<C::Error>> {
                let Some(pause) = remaining.pause(self.client.now()) else { return Ok(true) };
                self.client.wait(pause)$(.$await)?.map_err(MotionError::Wait)?;
                Ok(false)
            }

            $($async)? fn $change(
                &mut self,
                mode: Mode,
                remaining: &mut Remaining,
            ) -> Result<(), MotionError<C::Error>> {
                let status = O::statusword().$read(self.client)$(.$await)?? as u16;
                let state = State::from_raw(status);
                if self.$mode()$(.$await)?? != mode {
                    let control = self.$control()$(.$await)??;
                    if state == Some(State::OperationEnabled) {
                        enables(control)?;
                    }
                    if control & OF_MODE != 0 && keeps_state(state, control) {
                        self.$command(control & !OF_MODE)$(.$await)??;
                    }
                }
                O::modes_of_operation().$write(self.client, mode.raw().into())$(.$await)??;
                loop {
                    let active = self.$mode()$(.$await)??;
                    if active == mode {
                        return Ok(());
                    }
                    if self.$is_late(remaining)$(.$await)?? {
                        return Err(MotionError::ModeNotConfirmed { requested: mode, active });
                    }
                }
            }
        }

        impl<C: $Client, O: Homing<C::Bus>> Drive<'_, C, O> {
            /// Executes homing with the homing method that is set in the drive (0x6098). Afterwards, homing mode stays
            /// active.
            ///
            /// The method activates mode 6 (homing) and sets bit 4 of the controlword ("homing operation start"). Then
            /// the method waits until bits 12 ("homing attained") and 10 ("target reached") of the statusword are 1,
            /// and clears bit 4 (CiA 402-2 13). If an error occurs after the start, the method also tries to clear bit
            /// 4. The drive then aborts homing, and doesn't restart homing when it is enabled again. For 100 ms, the
            /// method ignores a statusword that may show the result of an earlier homing procedure.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Homing`] if the drive reports a homing error (bit 13).
            /// - [`MotionError::Deadline`] if homing hasn't ended before the deadline.
            /// - [`MotionError::ModeNotConfirmed`] if the drive doesn't activate the mode.
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::Halted`] if the "halt" bit is 1, [`MotionError::OtherSource`] if another source
            ///   controls the drive, or [`MotionError::Access`] if an access fails.
            pub $($async)? fn $home(&mut self, deadline: Duration) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$enabled()$(.$await)??;
                self.$unhalted()$(.$await)??;
                self.$run_homing(&mut remaining)$(.$await)?
            }

            /// Sets the homing method and executes homing. `method` is the raw value of object 0x6098 (CiA 402-2
            /// 13.3.2). The drive keeps this value after homing.
            ///
            /// # Errors
            ///
            /// Returns the errors of `home`. Returns [`MotionError::Access`] with
            /// [`Error::OutOfRange`](crate::Error::OutOfRange) if the device description excludes the method.
            pub $($async)? fn $home_with(
                &mut self,
                method: i16,
                deadline: Duration,
            ) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$enabled()$(.$await)??;
                self.$unhalted()$(.$await)??;
                O::homing_method().$write(self.client, method.into())$(.$await)??;
                self.$run_homing(&mut remaining)$(.$await)?
            }

            $($async)? fn $run_homing(&mut self, remaining: &mut Remaining) -> Result<(), MotionError<C::Error>> {
                self.$change(Mode::Homing, remaining)$(.$await)??;
                let control = self.$unhalted()$(.$await)??;
                if control & START != 0 {
                    // The start needs a rising edge.
                    self.$command(control & !START)$(.$await)??;
                }
                // The drive needs time for the edge and the mode. A client that cannot wait fails before the start.
                let is_late = self.$is_late(remaining)$(.$await)??;
                let before = self.$enabled()$(.$await)??;
                if is_late {
                    return Err(MotionError::Deadline { status: before });
                }
                let control = self.$unhalted()$(.$await)??;
                let homed = match self.$command(control | START)$(.$await)? {
                    Ok(()) => self.$homed(before, remaining)$(.$await)?,
                    Err(error) => Err(error),
                };
                let cleared = self.$clear()$(.$await)?;
                homed.and(cleared)
            }

            $($async)? fn $homed(
                &mut self,
                before: u16,
                remaining: &mut Remaining,
            ) -> Result<(), MotionError<C::Error>> {
                let mut outcome = Outcome::new(self.client.now(), before);
                loop {
                    let status = self.$enabled()$(.$await)??;
                    if let Some(result) = outcome.of(self.client.now(), status) {
                        return result;
                    }
                    if self.$is_late(remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                }
            }
        }

        impl<C: $Client, O: Positioning<C::Bus>> Drive<'_, C, O> {
            /// Sends a set-point in profile position mode, with the handshake of CiA 402-2 12.2. The method returns as
            /// soon as the drive has accepted the set-point; `wait_reached` waits for the end of the move.
            ///
            /// The method waits until the drive can accept a set-point, and writes the target position (0x607A). Then
            /// the method sets bit 4 of the controlword ("new set-point") and writes bits 5 and 6. The method waits
            /// until bit 12 of the statusword ("set-point acknowledge") is 1, and clears bit 4. If an error occurs
            /// after bit 4 was set, the method also tries to clear the bit. Write the profile velocity and the ramps
            /// before you call this method.
            ///
            /// # Errors
            ///
            /// - [`MotionError::WrongMode`] if mode 1 (profile position) isn't active: use `set_mode`.
            /// - [`MotionError::Deadline`] if the drive hasn't acknowledged the set-point before the deadline. The
            ///   drive may nevertheless have accepted the set-point.
            /// - [`MotionError::FollowingError`] if the drive reports a following error (bit 13).
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::Halted`] if the "halt" bit is 1, or [`MotionError::OtherSource`] if another source
            ///   controls the drive.
            /// - [`MotionError::Access`] if an access fails, or if the position is outside the range that the device
            ///   description declares.
            pub $($async)? fn $move_to(
                &mut self,
                target: Target,
                deadline: Duration,
            ) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$enabled()$(.$await)??;
                match self.$mode()$(.$await)?? {
                    Mode::ProfilePosition => {}
                    active => return Err(MotionError::WrongMode { active }),
                }
                let control = self.$unhalted()$(.$await)??;
                if control & START != 0 {
                    self.$command(control & !START)$(.$await)??;
                }
                let is_confirmed = self.$ready(target, &mut remaining)$(.$await)??;
                O::target_position().$write(self.client, target.position)$(.$await)??;
                // The drive needs time for the edge. A client that cannot wait fails before the start.
                let is_late = self.$is_late(&mut remaining)$(.$await)??;
                let status = self.$watched(Mode::ProfilePosition)$(.$await)??;
                if is_late {
                    return Err(MotionError::Deadline { status });
                }
                let control = self.$unhalted()$(.$await)?? & !Target::BITS | target.bits;
                let acknowledged = match self.$command(control | START)$(.$await)? {
                    Ok(()) => self.$acknowledged(is_confirmed, &mut remaining)$(.$await)?,
                    Err(error) => Err(error),
                };
                let cleared = self.$clear()$(.$await)?;
                acknowledged.and(cleared)
            }

            /// Waits until the drive can accept a set-point. The drive can accept a set-point that replaces the active
            /// one even if another set-point is waiting. In this case, bit 12 stays 1. Returns whether bit 12 is 1.
            $($async)? fn $ready(
                &mut self,
                target: Target,
                remaining: &mut Remaining,
            ) -> Result<bool, MotionError<C::Error>> {
                let mut settling = Remaining::new(self.client.now(), SETTLING);
                loop {
                    let status = self.$watched(Mode::ProfilePosition)$(.$await)??;
                    let is_confirmed = status & CONFIRMED != 0;
                    if !is_confirmed || (target.is_immediate() && settling.pause(self.client.now()).is_none()) {
                        return Ok(is_confirmed);
                    }
                    if self.$is_late(remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                }
            }

            /// Waits until the drive acknowledges a set-point. If bit 12 was already 1 before the start, the method
            /// waits for at least 100 ms. It assumes that the drive detects the rising edge of bit 4 within this time.
            $($async)? fn $acknowledged(
                &mut self,
                is_confirmed: bool,
                remaining: &mut Remaining,
            ) -> Result<(), MotionError<C::Error>> {
                let mut settling = Remaining::new(self.client.now(), if is_confirmed { SETTLING } else { Duration::ZERO });
                loop {
                    let status = self.$watched(Mode::ProfilePosition)$(.$await)??;
                    if status & CONFIRMED != 0 && settling.pause(self.client.now()).is_none() {
                        return Ok(());
                    }
                    if self.$is_late(remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                }
            }
        }

        impl<C: $Client, O: Velocity<C::Bus>> Drive<'_, C, O> {
            /// Writes the target velocity (0x60FF) in modes 3 (profile velocity) and 9 (cyclic synchronous velocity).
            /// `velocity` is the raw value. In mode 3, `wait_reached` waits until the axis has this velocity. The axis
            /// keeps the velocity until another velocity is written. If a later operation fails, the program must
            /// therefore stop the axis.
            ///
            /// # Errors
            ///
            /// - [`MotionError::WrongMode`] if another mode is active: use `set_mode`.
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled".
            /// - [`MotionError::Halted`] if the "halt" bit is 1, or [`MotionError::OtherSource`] if another source
            ///   controls the drive.
            /// - [`MotionError::Access`] if an access fails, or if the velocity is outside the range that the device
            ///   description declares.
            pub $($async)? fn $set_velocity(&mut self, velocity: i32) -> Result<(), MotionError<C::Error>> {
                self.$enabled()$(.$await)??;
                match self.$mode()$(.$await)?? {
                    Mode::ProfileVelocity | Mode::CyclicSynchronousVelocity => {}
                    active => return Err(MotionError::WrongMode { active }),
                }
                self.$unhalted()$(.$await)??;
                Ok(O::target_velocity().$write(self.client, velocity)$(.$await)??)
            }
        }
    };
}

/// Returns whether the same command can be written again without a change of the state. A drive that has left
/// "Operation enabled" by itself would execute "enable operation" again.
fn keeps_state(state: Option<State>, control: u16) -> bool {
    match state {
        Some(State::OperationEnabled | State::FaultReactionActive | State::Fault) => true,
        Some(State::QuickStopActive) | None => false,
        Some(_) => control & OF_STATE != ENABLE_OPERATION,
    }
}

/// Returns the controlword if its command is "enable operation", and an error otherwise.
pub(super) fn enables<E>(control: u16) -> Result<u16, MotionError<E>> {
    match control & OF_STATE {
        ENABLE_OPERATION => Ok(control),
        _ => Err(MotionError::OtherSource { control }),
    }
}

operations! {
    Client read write
    set_mode mode wait_reached home home_with move_to set_velocity
    private enabled watched unhalted control command is_late change clear run_homing homed ready acknowledged
}
operations! {
    AsyncClient read_async write_async
    set_mode_async mode_async wait_reached_async home_async home_with_async move_to_async set_velocity_async
    private enabled_async watched_async unhalted_async control_async command_async is_late_async change_async
        clear_async run_homing_async homed_async ready_async acknowledged_async
    async await
}
