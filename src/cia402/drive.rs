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
use super::state::{Mode, State};
use super::target::Target;
use crate::client::{AsyncClient, Client};
use crate::enumeration::Enumeration;
use crate::machine::StateWord;
use crate::remaining::Remaining;

/// Operations of one axis. The method `cia402` of a generated device creates this type. `C` is the client, and `O`
/// determines the [`Objects`] of the device.
///
/// Methods without a suffix need a [`Client`]. Methods with the suffix `_async` need an [`AsyncClient`] and don't block.
/// Each method that waits has a deadline, and polls the statusword every 5 ms through
/// [`Client::wait`](crate::Client::wait). If a future is dropped before its end, the bit 4 of the controlword can remain
/// set.
///
/// The [module](super) describes the conditions of all operations.
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
                Ok(Mode::from_native(mode as i8))
            }

            /// Changes the mode of operation: writes the mode (0x6060) and waits until the drive confirms it (0x6061).
            ///
            /// If the mode changes, the method first clears the bits 4, 5, 6 and 9 of the controlword. The meaning of
            /// these bits depends on the mode. The controlword isn't written if the write could enable the drive or end
            /// a quick stop. This method works in all states. Stop the axis before you change the mode, unless the
            /// drive supports the change in motion. If the operation is enabled, write the target of the new mode
            /// before you activate a velocity, torque or cyclic mode. In these modes, the axis follows an old target at
            /// once.
            ///
            /// `mode` is a [`Mode`], a value of the device's generated enumeration, or an `i8`.
            ///
            /// # Errors
            ///
            /// Returns [`MotionError::ModeNotConfirmed`] if the drive hasn't activated the mode before the deadline.
            /// Returns [`MotionError::Access`] if an access fails, for example because the drive refuses the mode.
            pub $($async)? fn $set_mode(
                &mut self,
                mode: impl StateWord,
                deadline: Duration,
            ) -> Result<(), MotionError<C::Error>> {
                let mode = Mode::from_native(mode.bits() as i8);
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$change(mode, &mut remaining)$(.$await)?
            }

            /// Waits until the axis has reached its target: bit 10 of the statusword. The method is for the modes 1
            /// (profile position), 3 (profile velocity) and 4 (profile torque). If bit 10 is 1 at the first poll, it must
            /// stay 1 for 100 ms, because it can still show the previous target.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::FollowingError`] or [`MotionError::Slippage`] if the drive reports it (bit 13).
            /// - [`MotionError::WrongMode`], [`MotionError::Halted`], [`MotionError::OtherSource`], [`MotionError::Access`].
            /// - [`MotionError::Deadline`] if the axis hasn't reached the target. The axis continues to move.
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
                match State::of_status(status) {
                    Some(State::OperationEnabled) => Ok(status),
                    Some(state) if state.is_fault() => {
                        let code = O::error_code().$read(self.client)$(.$await)?;
                        Err(MotionError::Fault { state, code: code.ok().map(|code| code as u16) })
                    }
                    state => Err(MotionError::NotEnabled { state, status }),
                }
            }

            /// Reads the statusword. Also returns an error if the drive reports a following error or slippage.
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

            /// Returns the controlword. Returns an error if its bit "halt" is 1, or if it doesn't enable the operation.
            $($async)? fn $unhalted(&mut self) -> Result<u16, MotionError<C::Error>> {
                let control = enables(self.$control()$(.$await)??)?;
                if control & HALT == 0 { Ok(control) } else { Err(MotionError::Halted) }
            }

            /// Clears bit 4 of the controlword that the drive has now, unless the write could change the state.
            $($async)? fn $clear(&mut self) -> Result<(), MotionError<C::Error>> {
                let status = O::statusword().$read(self.client)$(.$await)?? as u16;
                let control = self.$control()$(.$await)??;
                if control & START != 0 && keeps_state(State::of_status(status), control) {
                    self.$command(control & !START)$(.$await)??;
                }
                Ok(())
            }

            pub(super) $($async)? fn $command(&mut self, control: u16) -> Result<(), MotionError<C::Error>> {
                Ok(O::controlword().$write(self.client, control.into())$(.$await)??)
            }

            /// Waits until the next poll. Returns true after the deadline.
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
                let state = State::of_status(status);
                if self.$mode()$(.$await)?? != mode {
                    let control = self.$control()$(.$await)??;
                    if state == Some(State::OperationEnabled) {
                        enables(control)?;
                    }
                    if control & OF_MODE != 0 && keeps_state(state, control) {
                        self.$command(control & !OF_MODE)$(.$await)??;
                    }
                }
                O::modes_of_operation().$write(self.client, mode.native().into())$(.$await)??;
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
            /// Executes homing with the homing method that the drive has (0x6098). After homing, the mode "homing" stays
            /// active.
            ///
            /// The method activates the mode 6 and sets bit 4 of the controlword ("homing operation start"). Then it
            /// waits for bit 12 ("homing attained") with bit 10 ("target reached") of the statusword, and clears bit 4
            /// (CiA 402-2 13). It also tries to clear bit 4 after each error, so that the drive aborts homing and
            /// doesn't start it again when it is enabled. A statusword that shows the result of an earlier homing
            /// procedure is ignored for 100 ms.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Homing`] if the drive reports a homing error (bit 13).
            /// - [`MotionError::Deadline`] if homing hasn't ended before the deadline.
            /// - [`MotionError::ModeNotConfirmed`] if the drive doesn't activate the mode.
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::Halted`], [`MotionError::OtherSource`], [`MotionError::Access`].
            pub $($async)? fn $home(&mut self, deadline: Duration) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$enabled()$(.$await)??;
                self.$unhalted()$(.$await)??;
                self.$run_homing(&mut remaining)$(.$await)?
            }

            /// Executes homing with a homing method. `method` is the raw value of 0x6098 (CiA 402-2 13.3.2), which the
            /// drive keeps.
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
            /// Sends a set-point in the mode "profile position", with the handshake of CiA 402-2 12.2. The method returns
            /// as soon as the drive has accepted the set-point; `wait_reached` waits for the end of the move.
            ///
            /// The method waits until the drive can accept a set-point, and writes the target position (0x607A). Then
            /// it sets bit 4 of the controlword ("new set-point") together with the bits 5 and 6. It waits for bit 12
            /// of the statusword ("set-point acknowledge"), and clears bit 4. It also tries to clear bit 4 after each
            /// error. Write the profile velocity and the ramps before.
            ///
            /// # Errors
            ///
            /// - [`MotionError::WrongMode`] if the mode 1 isn't active: use `set_mode`.
            /// - [`MotionError::Deadline`] if the drive hasn't acknowledged the set-point before the deadline. The drive
            ///   can still have accepted it.
            /// - [`MotionError::FollowingError`] if the drive reports a following error (bit 13).
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or
            ///   leaves this state.
            /// - [`MotionError::Halted`], [`MotionError::OtherSource`].
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

            /// Waits until the drive can accept a set-point. A set-point that replaces the active one can be accepted
            /// even if another one waits, and bit 12 then stays 1. Returns whether bit 12 is 1.
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

            /// Waits until the drive acknowledges a set-point. If bit 12 was 1 before the start, the method waits until the
            /// drive must have seen the edge of bit 4.
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
            /// Writes the target velocity (0x60FF) in the modes 3 (profile velocity) and 9 (cyclic synchronous velocity).
            /// `velocity` is the raw value. In the mode 3, `wait_reached` waits until the axis has this velocity. The
            /// axis keeps the velocity until another one is written: after an error of a later operation, the program
            /// must stop the axis.
            ///
            /// # Errors
            ///
            /// - [`MotionError::WrongMode`] if another mode is active: use `set_mode`.
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled".
            /// - [`MotionError::Halted`], [`MotionError::OtherSource`].
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

/// Returns whether a write of the same command cannot change the state. A drive that has left "Operation enabled" by
/// itself would execute "enable operation" again.
fn keeps_state(state: Option<State>, control: u16) -> bool {
    match state {
        Some(State::OperationEnabled | State::FaultReactionActive | State::Fault) => true,
        Some(State::QuickStopActive) | None => false,
        Some(_) => control & OF_STATE != ENABLE_OPERATION,
    }
}

/// Returns the controlword if it enables the operation.
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
