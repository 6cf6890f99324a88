//! Moves a state machine to a target state: reads its status item and writes its control item.

use core::fmt;
use core::time::Duration;

use super::walker::{late, MachineState, Stopped, Walker};
use super::word::StateWord;
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::remaining::Remaining;
use crate::route::{ReadRoute, WriteRoute};
use crate::value::Fixed;

/// The items of a state machine: the status item of type `V` and the control item of type `W`, with their access rights
/// and locations.
pub struct Machine<V: Fixed, A, L, W: Fixed, B, M> {
    status: Item<V, A, L>,
    control: Item<W, B, M>,
}

/// Reason why a state machine did not reach the target state. `S` is the type of the states, and `E` is the error type of
/// the client.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WalkError<S, E> {
    /// An access to the status item or control item failed.
    Access(AccessError<E>),
    /// The client failed to wait between two accesses.
    Wait(Error<E>),
    /// A new fault occurred, or a fault that was active at the start could not be reset before the deadline.
    Fault {
        /// State of the device.
        state: S,
        /// Error code of the device: the value of 0x603F, or of 0x1003:01 without the additional information. `None` if
        /// the device has no error code, or if the code could not be read.
        code: Option<u16>,
    },
    /// No path that a [`Walker`] may use leads from this state to the target state. The conversion from
    /// [`Stopped::Left`] also returns this variant.
    Unreachable {
        /// State of the device.
        state: S,
    },
    /// The device was not in the target state at the deadline. The control word may still contain the last command,
    /// which the device can execute later.
    Deadline {
        /// State of the device, or `None` if its status word matches no state.
        state: Option<S>,
        /// Status word of the device.
        status: u32,
    },
}

impl<S, E> WalkError<S, E> {
    /// Returns whether the reason is a [`Fault`](Self::Fault).
    pub const fn is_fault(&self) -> bool {
        matches!(self, Self::Fault { .. })
    }

    /// Adds the error code of the device to a [`Fault`](Self::Fault), if the code could be read. The error code
    /// consists of the low 16 bits of `code`.
    #[must_use]
    pub fn with_code<W: StateWord>(self, code: Result<W, AccessError<E>>) -> Self {
        match self {
            Self::Fault { state, .. } => Self::Fault { state, code: code.ok().map(|code| code.bits() as u16) },
            other => other,
        }
    }
}

impl<S, E> From<AccessError<E>> for WalkError<S, E> {
    fn from(error: AccessError<E>) -> Self {
        Self::Access(error)
    }
}

impl<S, E> From<Stopped<S>> for WalkError<S, E> {
    fn from(stopped: Stopped<S>) -> Self {
        match stopped {
            Stopped::Fault { state, code } => Self::Fault { state, code },
            Stopped::Unreachable(state) | Stopped::Left(state) => Self::Unreachable { state },
            Stopped::Deadline { state, status } => Self::Deadline { state, status },
        }
    }
}

impl<S: MachineState, E: fmt::Display> fmt::Display for WalkError<S, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Access(error) => error.fmt(f),
            Self::Wait(error) => error.fmt(f),
            Self::Fault { state, code } => Stopped::Fault { state: *state, code: *code }.fmt(f),
            Self::Unreachable { state } => Stopped::Unreachable(*state).fmt(f),
            Self::Deadline { state, status } => Stopped::Deadline { state: *state, status: *status }.fmt(f),
        }
    }
}

impl<S: MachineState + fmt::Debug, E: core::error::Error> core::error::Error for WalkError<S, E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Access(error) => error.source(),
            Self::Wait(error) => error.source(),
            _ => None,
        }
    }
}

impl<V: Fixed, A, L, W: Fixed, B, M> Machine<V, A, L, W, B, M> {
    /// Creates a machine with this status item and control item.
    #[must_use]
    pub const fn new(status: Item<V, A, L>, control: Item<W, B, M>) -> Self {
        Self { status, control }
    }
}

impl<V: Fixed, A, L, W: Fixed, B, M> fmt::Debug for Machine<V, A, L, W, B, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (status, control) = (self.status.name(), self.control.name());
        f.debug_struct("Machine").field("status", &status).field("control", &control).finish_non_exhaustive()
    }
}

/// Defines the methods that move a machine to a target state, blocking and async.
macro_rules! walks {
    ($Client:ident $walk:ident $read:ident $write:ident $(#[$doc:meta])* $($async:ident $await:ident)?) => {
        impl<V, A: Readable, L: Copy, W, B: Writable, M: Copy> Machine<V, A, L, W, B, M>
        where
            V: Fixed<Native: StateWord>,
            W: Fixed<Native: StateWord>,
        {
            $(#[$doc])*
            ///
            /// `control` is the current control word of the device. If the device receives the control word in process
            /// data, use a [`Walker`] in the cycle instead.
            ///
            /// # Errors
            ///
            /// Returns a [`WalkError`] if an access fails, the client cannot wait, a fault occurs, no allowed path
            /// leads to the state, or the device is not in the state at the deadline.
            pub $($async)? fn $walk<S: MachineState, C: $Client>(
                self,
                client: &mut C,
                control: W::Native,
                target: S,
                deadline: Duration,
            ) -> Result<(), WalkError<S, C::Error>>
            where
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
                M: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                let (mut walker, mut control) = (Walker::new(target), control);
                let (mut remaining, mut is_written) = (Remaining::new(client.now(), deadline), false);
                loop {
                    let status = self.status.at(client).$read()$(.$await)??;
                    let walked = walker.cycle(status, control)?;
                    if walked.is_reached {
                        return Ok(());
                    }
                    // The first command is always written, because the device can have another control word than `control`.
                    let is_first = walker.has_sent() && !is_written;
                    if is_first || walked.control.bits() != control.bits() {
                        self.control.at(client).$write(walked.control)$(.$await)??;
                        (control, is_written) = (walked.control, true);
                    }
                    match remaining.pause(client.now()) {
                        Some(pause) => client.wait(pause)$(.$await)?.map_err(WalkError::Wait)?,
                        None => return Err(late(status.bits()).into()),
                    }
                }
            }
        }
    };
}

walks! { Client walk read write
    /// Moves the machine to the state `target`: reads the status word, writes commands and waits, until the device is
    /// in this state.
}
walks! { AsyncClient walk_async read_async write_async
    /// Moves the machine to the state `target`, as [`walk`](Self::walk) does, without blocking.
    async await
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Transition;
    use crate::{CanOpen, Object, OnCanOpen, Ro, Wo};
    use std::vec::Vec;

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum State {
        Starting,
        On,
        Off,
    }

    impl MachineState for State {
        type Command = (u32, u32);
        const TRANSITIONS: &'static [Transition<(u32, u32)>] =
            &[Transition::new(0, 1, None), Transition::new(1, 2, Some((1, 0))), Transition::new(2, 1, Some((1, 1)))];
        const FAULTS: &'static [u8] = &[];

        fn of_status(bits: u32) -> Option<Self> {
            [Self::Starting, Self::On, Self::Off].get(bits as usize).copied()
        }

        fn number(self) -> u8 {
            self as u8
        }

        fn name(self) -> &'static str {
            "a state"
        }

        fn pattern(command: (u32, u32)) -> (u32, u32) {
            command
        }
    }

    /// A device whose control item is write-only. Bit 0 switches it on.
    struct Device {
        status: u8,
        writes: Vec<u8>,
    }

    impl Client for Device {
        type Bus = CanOpen;
        type Error = ();

        fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Error<()>> {
            buffer.fill(self.status);
            Ok(buffer.len())
        }

        fn write(&mut self, _: Object, data: &[u8]) -> Result<(), Error<()>> {
            self.writes.extend(data);
            self.status = if data == [0] { 2 } else { 1 };
            Ok(())
        }

        fn wait(&mut self, _: Duration) -> Result<(), Error<()>> {
            // The device starts while the client waits.
            self.status = self.status.max(1);
            Ok(())
        }
    }

    /// A device that never changes its state. Each access takes 400 ms.
    struct Stuck(Duration);

    impl Client for Stuck {
        type Bus = CanOpen;
        type Error = ();

        fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Error<()>> {
            self.0 += Duration::from_millis(400);
            buffer.fill(0);
            Ok(buffer.len())
        }

        fn write(&mut self, _: Object, _: &[u8]) -> Result<(), Error<()>> {
            Ok(())
        }

        fn wait(&mut self, time: Duration) -> Result<(), Error<()>> {
            self.0 += time;
            Ok(())
        }

        fn now(&mut self) -> Option<Duration> {
            Some(self.0)
        }
    }

    #[test]
    fn slow_accesses_count_for_the_deadline() {
        let status: Item<u8, Ro, OnCanOpen> = Item::object(0x2000, 0, "status");
        let control: Item<u8, Wo, OnCanOpen> = Item::object(0x2001, 0, "control");
        let mut stuck = Stuck(Duration::ZERO);
        let walked = Machine::new(status, control).walk(&mut stuck, 0, State::On, Duration::from_secs(1));
        assert_eq!(walked, Err(WalkError::Deadline { state: Some(State::Starting), status: 0 }));
        assert!(stuck.0 <= Duration::from_millis(1500), "{:?}", stuck.0);
    }

    #[test]
    fn the_first_command_is_written_and_waiting_writes_nothing() {
        let status: Item<u8, Ro, OnCanOpen> = Item::object(0x2000, 0, "status");
        let control: Item<u8, Wo, OnCanOpen> = Item::object(0x2001, 0, "control");
        let machine = || Machine::new(status, control);
        let mut device = Device { status: 0, writes: Vec::new() };
        let deadline = Duration::from_secs(1);
        assert_eq!(machine().walk(&mut device, 0, State::On, deadline), Ok(()));
        // Only the control word that holds the target is written: 0 would switch the device off.
        assert_eq!(device.writes, [1]);
        // The command "off" equals the control word that the program assumes, but not that of the device.
        assert_eq!(machine().walk(&mut device, 0, State::Off, deadline), Ok(()));
        assert_eq!(device.writes, [1, 0]);
    }
}
