//! Quick stop and halt of a drive, blocking and async.

use core::time::Duration;

use super::bits::{HALT, QUICK_STOP, REACHED};
use super::drive::{enables, Drive};
use super::error::MotionError;
use super::objects::Objects;
use super::settling::Settling;
use super::State;
use crate::client::{AsyncClient, Client};
use crate::remaining::Remaining;

/// Defines the operations, blocking and async.
macro_rules! stops {
    (
        $Client:ident $quick_stop:ident $halt:ident $resume:ident
        private $enabled:ident $control:ident $command:ident $is_late:ident
        $($async:ident $await:ident)?
    ) => {
        impl<C: $Client, O: Objects<C::Bus>> Drive<'_, C, O> {
            /// Stops the axis with the "quick stop" command (transition 11), and waits until the axis has stopped. The
            /// quick stop option code (0x605A) selects the ramp and the final state, which the method returns:
            /// [`State::SwitchOnDisabled`] (codes 0 to 4) or [`State::QuickStopActive`] (codes 5 to 8). To continue,
            /// use the generated method `walk`.
            ///
            /// The method writes the command at once and in every state, because the drive can change its state at any
            /// time. All other bits of the controlword are written as 0: "halt", the mode-specific bits, and the
            /// manufacturer-specific bits. If the drive is in "ready to switch on" or "switched on", it enters "switch
            /// on disabled".
            ///
            /// In "switch on disabled", the power stage is off. The axis can still coast if the option code is 0, or if
            /// the drive wasn't in "operation enabled" when it received the command.
            ///
            /// In "quick stop active", the axis has stopped when bit 10 of the statusword is 1 (CiA 402-2 10.3.2). If
            /// bit 10 is 1 at the first poll in this state, the bit can still refer to the previous target. The method
            /// then waits until 100 ms have passed since the command, or until the bit has changed to 0 and back to 1.
            /// A deadline of less than 100 ms can therefore pass even if the axis is at a standstill.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] if the drive has a fault. The axis then stops with the fault reaction.
            /// - [`MotionError::Deadline`] if the axis hasn't stopped before the deadline. The command stays active.
            /// - [`MotionError::Access`] if an access fails. The drive may have received the command.
            pub $($async)? fn $quick_stop(&mut self, deadline: Duration) -> Result<State, MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                // Without a read, whose reply could be lost. A bit 4 that stays 1 would start homing when the drive is enabled.
                self.$command(QUICK_STOP)$(.$await)??;
                let mut settling = Settling::new(self.client.now(), true);
                loop {
                    // Reads the error code of a fault, and the state.
                    let status = match self.$enabled()$(.$await)? {
                        Ok(status) => status,
                        Err(MotionError::NotEnabled { state: Some(State::SwitchOnDisabled), .. }) => {
                            return Ok(State::SwitchOnDisabled);
                        }
                        Err(MotionError::NotEnabled { state: Some(State::QuickStopActive), status }) => {
                            if settling.confirms(self.client.now(), status & REACHED != 0) {
                                return Ok(State::QuickStopActive);
                            }
                            status
                        }
                        Err(MotionError::NotEnabled { status, .. }) => status,
                        Err(error) => return Err(error),
                    };
                    if self.$is_late(&mut remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                }
            }

            /// Stops the axis with bit 8 of the controlword ("halt"), and waits until the axis has stopped, which bit
            /// 10 of the statusword reports. The operation stays enabled. The halt option code (0x605D) selects the
            /// ramp. The method `resume` clears bit 8.
            ///
            /// In modes 1 (profile position), 3 (profile velocity), 4 (profile torque), 6 (homing, which the drive
            /// aborts) and 7 (interpolated position), bit 10 reports that the axis has stopped. If bit 10 is 1 at the
            /// first poll, the bit can still refer to the previous target. The method then waits until 100 ms have
            /// passed, or until the bit has changed to 0 and back to 1. A deadline of less than 100 ms can therefore
            /// pass even if the axis is at a standstill. In other modes, bit 8 also stops most drives, but the method
            /// can return [`MotionError::Deadline`].
            ///
            /// If an error occurs after the write of bit 8, the bit stays set. `move_to`, `home`, `set_velocity` and
            /// `wait_reached` then return [`MotionError::Halted`] until `resume` clears the bit, even if a fault was
            /// reset and `walk` has enabled the drive again.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or leaves
            ///   this state.
            /// - [`MotionError::Deadline`] if the axis hasn't stopped before the deadline.
            /// - [`MotionError::OtherSource`] if another source controls the drive, or [`MotionError::Access`] if an
            ///   access fails.
            pub $($async)? fn $halt(&mut self, deadline: Duration) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(self.client.now(), deadline);
                self.$enabled()$(.$await)??;
                let control = enables(self.$control()$(.$await)??)?;
                self.$command(control | HALT)$(.$await)??;
                let mut settling = Settling::new(self.client.now(), true);
                loop {
                    let status = self.$enabled()$(.$await)??;
                    if settling.confirms(self.client.now(), status & REACHED != 0) {
                        return Ok(());
                    }
                    if self.$is_late(&mut remaining)$(.$await)?? {
                        return Err(MotionError::Deadline { status });
                    }
                }
            }

            /// Clears bit 8 of the controlword ("halt"). The axis continues its motion: to the set-point in profile
            /// position mode, or with the target velocity or torque in velocity and torque modes.
            ///
            /// In mode 6 (homing), the procedure doesn't continue: call `home` again. In the cyclic modes and in mode 7
            /// (interpolated position), the axis follows the present target at once. Set the target to the actual
            /// position, or the target velocity or torque to 0, before you call this method.
            ///
            /// # Errors
            ///
            /// Returns [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled".
            /// Returns [`MotionError::OtherSource`] if another source controls the drive, or [`MotionError::Access`] if
            /// an access fails.
            pub $($async)? fn $resume(&mut self) -> Result<(), MotionError<C::Error>> {
                self.$enabled()$(.$await)??;
                let control = enables(self.$control()$(.$await)??)?;
                self.$command(control & !HALT)$(.$await)?
            }
        }
    };
}

stops! {
    Client quick_stop halt resume
    private enabled control command is_late
}
stops! {
    AsyncClient quick_stop_async halt_async resume_async
    private enabled_async control_async command_async is_late_async
    async await
}
