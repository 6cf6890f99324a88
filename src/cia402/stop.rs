//! Quick stop and halt of a drive, blocking and async.

use core::time::Duration;

use super::bits::{HALT, OF_STATE, QUICK_STOP, REACHED};
use super::drive::{enables, Drive};
use super::error::MotionError;
use super::homing::SETTLING;
use super::objects::Objects;
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
            /// option code (0x605A) selects the ramp, and whether the drive then stays in [`State::QuickStopActive`] or
            /// enters [`State::SwitchOnDisabled`]. Returns this state. To continue, use the generated method `walk`.
            ///
            /// The command is written in every state, because the drive can change its state at any time. In the states
            /// "ready to switch on" and "switched on", it leads to "switch on disabled". If the controlword cannot be read,
            /// its other bits are written as 0.
            ///
            /// In "quick stop active", the axis has stopped when bit 10 of the statusword is 1 (CiA 402-2 10.3.2).
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] if the drive has a fault. The axis then stops with the fault reaction.
            /// - [`MotionError::Deadline`] if the axis hasn't stopped before the deadline.
            /// - [`MotionError::Access`] if an access fails. The drive may have received the command.
            pub $($async)? fn $quick_stop(&mut self, deadline: Duration) -> Result<State, MotionError<C::Error>> {
                let mut remaining = Remaining::new(deadline);
                let control = self.$control()$(.$await)?.unwrap_or(0);
                self.$command(control & !OF_STATE | QUICK_STOP)$(.$await)??;
                loop {
                    // Reads the error code of a fault, and the state.
                    let status = match self.$enabled()$(.$await)? {
                        Ok(status) => status,
                        Err(MotionError::NotEnabled { state: Some(State::SwitchOnDisabled), .. }) => {
                            return Ok(State::SwitchOnDisabled);
                        }
                        Err(MotionError::NotEnabled { state: Some(State::QuickStopActive), status })
                            if status & REACHED != 0 =>
                        {
                            return Ok(State::QuickStopActive);
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
            /// The bit 10 has this meaning in the modes 1 (profile position), 3 (profile velocity), 4 (profile torque) and 6
            /// (homing, which the drive aborts). If bit 10 is 1 at the first poll, it must stay 1 for 100 ms, because it can
            /// still show the previous target. In other modes, the bit 8 also stops most drives, but the method can return
            /// [`MotionError::Deadline`].
            ///
            /// # Errors
            ///
            /// - [`MotionError::Fault`] or [`MotionError::NotEnabled`] if the drive isn't in "Operation enabled" or leaves
            ///   this state.
            /// - [`MotionError::Deadline`] if the axis hasn't stopped before the deadline. The bit 8 stays set.
            /// - [`MotionError::OtherSource`], [`MotionError::Access`].
            pub $($async)? fn $halt(&mut self, deadline: Duration) -> Result<(), MotionError<C::Error>> {
                let mut remaining = Remaining::new(deadline);
                self.$enabled()$(.$await)??;
                let control = enables(self.$control()$(.$await)??)?;
                self.$command(control | HALT)$(.$await)??;
                let (mut is_stale, mut settling) = (true, Remaining::new(SETTLING));
                loop {
                    let status = self.$enabled()$(.$await)??;
                    is_stale &= status & REACHED != 0 && settling.pause().is_some();
                    if status & REACHED != 0 && !is_stale {
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
