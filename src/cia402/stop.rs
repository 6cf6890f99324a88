//! Quick stop and halt of a drive, blocking and async.

use core::time::Duration;

use super::bits::{HALT, QUICK_STOP, REACHED};
use super::drive::{enables, Drive};
use super::error::MotionError;
use super::objects::Objects;
use super::settling::Settling;
use super::state::State;
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
            /// Stops the axis with the command "quick stop" (transition 11), and waits until it has stopped. The quick stop
            /// option code (0x605A) selects the ramp, and whether the drive then enters [`State::SwitchOnDisabled`] (1 to
            /// 4) or stays in [`State::QuickStopActive`] (5 to 8). Returns this state. To continue, use the generated
            /// method `walk`.
            ///
            /// The command is written at once and in every state, because the drive can change its state at any time. All
            /// other bits of the controlword are written as 0: "halt", the bits of the mode, and the bits of the
            /// manufacturer. In the states "ready to switch on" and "switched on", the command leads to "switch on
            /// disabled".
            ///
            /// In "switch on disabled", the power stage is off. The axis can still coast if the option code is 0, or if the
            /// drive has entered this state from another state than "operation enabled".
            ///
            /// In "quick stop active", the axis has stopped when bit 10 of the statusword is 1 (CiA 402-2 10.3.2). If bit 10
            /// is 1 at the first poll in this state, it must stay 1 for 100 ms, because it can still show the previous
            /// target. A deadline of less than 100 ms can therefore pass even if the axis stands still.
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

            /// Stops the axis with the bit 8 of the controlword ("halt"), and waits until it has stopped: bit 10 of the
            /// statusword. The operation stays enabled. The halt option code (0x605D) selects the ramp. The method `resume`
            /// clears the bit.
            ///
            /// The bit 10 has this meaning in the modes 1 (profile position), 3 (profile velocity), 4 (profile torque), 6
            /// (homing, which the drive aborts) and 7 (interpolated position). If bit 10 is 1 at the first poll, it must
            /// stay 1 for 100 ms, because it can still show the previous target. A deadline of less than 100 ms can
            /// therefore pass even if the axis stands still. In other modes, the bit 8 also stops most drives, but the
            /// method can return [`MotionError::Deadline`].
            ///
            /// The bit 8 stays set after each error that occurs after its write. After a fault and `walk`, `move_to` and the
            /// other operations therefore return [`MotionError::Halted`] until `resume` clears the bit.
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or leaves
            ///   this state.
            /// - [`MotionError::Deadline`] if the axis hasn't stopped before the deadline.
            /// - [`MotionError::OtherSource`], [`MotionError::Access`].
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

            /// Clears the bit 8 of the controlword ("halt"). The axis continues its motion: to the set-point in the mode
            /// "profile position", or with the target velocity or torque.
            ///
            /// In the mode 6 (homing), the procedure doesn't continue: call `home` again. In the cyclic modes and in the
            /// mode 7 (interpolated position), the axis follows the present target at once. Set the target to the actual
            /// position, or the target velocity or torque to 0, before you call this method.
            ///
            /// # Errors
            ///
            /// [`MotionError::Fault`], [`MotionError::NotEnabled`], [`MotionError::OtherSource`] or
            /// [`MotionError::Access`].
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
