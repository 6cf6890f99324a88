//! Node guarding (CiA 301 7.2.8.3.2.1).

use core::error;
use core::fmt;
use core::time::Duration;

use super::frame::CanFrame;
use super::nmt::{NmtState, ERROR_CONTROL};
use super::node::Node;
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::clock::elapsed;
use crate::node_id::NodeId;

/// Toggle bit of a guarding answer. The node inverts it in each answer.
const TOGGLE: u8 = 1 << 7;

/// Node guarding of one node by the NMT master. [`Node::guard`] runs one cycle.
///
/// The node answers a remote frame with its NMT state and a toggle bit. Use node guarding only for devices that have no
/// heartbeat producer.
#[derive(Clone, Debug)]
pub struct Guarding {
    guard_time: Duration,
    life_time_factor: u8,
    /// Toggle bit of the next answer, or `None` if it is unknown.
    toggle: Option<bool>,
    missed: u8,
    /// A request was sent, and its answer has not arrived.
    is_owed: bool,
    has_run: bool,
    /// Time of the last valid answer, or of the first cycle.
    answered: Option<Duration>,
}

impl Guarding {
    /// Creates the guarding of a node. Set objects 0x100C and 0x100D of the node to the same values, so that the node
    /// detects a failure of the master.
    ///
    /// The guard time is the time between two cycles, and the maximum duration of a cycle. The node is lost after
    /// `life_time_factor` consecutive cycles without a valid answer. The factor 0 has the same effect as 1.
    #[must_use]
    pub const fn new(guard_time: Duration, life_time_factor: u8) -> Self {
        Self { guard_time, life_time_factor, toggle: None, missed: 0, is_owed: false, has_run: false, answered: None }
    }

    /// Returns the guard time.
    #[must_use]
    pub const fn guard_time(&self) -> Duration {
        self.guard_time
    }

    /// Returns the node life time: the guard time multiplied by the life time factor. The factor 0 counts as 1.
    #[must_use]
    pub fn life_time(&self) -> Duration {
        self.guard_time.saturating_mul(self.life_time_factor.max(1).into())
    }

    /// Returns the number of consecutive cycles without a valid answer. Every failed cycle counts, and so does a
    /// dropped async cycle.
    #[must_use]
    pub const fn missed(&self) -> u8 {
        self.missed
    }

    /// Starts a cycle at the time `now`. The cycle counts as missed until a valid answer arrives.
    fn start(&mut self, now: Option<Duration>) {
        self.missed = self.missed.saturating_add(1);
        self.answered = self.answered.or(now);
    }

    /// Returns whether a byte is the expected answer, or a boot-up message.
    fn accepts(&self, raw: u8) -> bool {
        raw == NmtState::BootUp.raw() || self.toggle.map_or(true, |toggle| toggle == (raw & TOGGLE != 0))
    }

    /// Returns the state in this answer. Sets the toggle bit of the next answer: the inverse of this one, or 0 after a
    /// boot-up message.
    fn synchronize(&mut self, raw: u8) -> NmtState {
        let state = NmtState::from_raw(raw);
        self.toggle = Some(state != NmtState::BootUp && raw & TOGGLE == 0);
        state
    }

    /// Processes a valid answer.
    fn accept(&mut self, state: NmtState, now: Option<Duration>) -> NmtState {
        self.missed = 0;
        self.answered = now.or(self.answered);
        state
    }

    /// Returns the error of a cycle without a valid answer: `NodeLost` if the life time has passed or too many cycles
    /// were missed, and otherwise `error`.
    fn fail<E>(&self, error: GuardError<E>, now: Option<Duration>) -> GuardError<E> {
        let silence = elapsed(self.answered, now);
        let is_over = silence.is_some_and(|silence| silence >= self.life_time());
        if is_over || self.missed >= self.life_time_factor {
            GuardError::NodeLost
        } else {
            error
        }
    }
}

/// Reason why a cycle of node guarding failed. `E` is the error type of the CAN interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum GuardError<E> {
    /// The CAN interface returned an error. The node is not lost yet.
    Client(E),
    /// The request was not sent, because the bus was busy, or because the CAN interface cannot send remote frames. The
    /// node is not lost yet.
    NotSent,
    /// The node did not answer in this cycle. The node is not lost yet.
    NoAnswer,
    /// The toggle bit of the answer did not alternate. The node is not lost yet.
    ToggleBit,
    /// The node is lost: no valid answer arrived within the node life time, or the number of consecutive failed cycles
    /// has reached the life time factor. The last cycle can have failed for any reason: no answer, a wrong toggle bit,
    /// a request that was not sent, or an error of the CAN interface.
    NodeLost,
}

impl<E: fmt::Display> fmt::Display for GuardError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::NotSent => f.write_str("the guarding request was not sent"),
            Self::NoAnswer => f.write_str("the node did not answer the guarding request"),
            Self::ToggleBit => f.write_str("the toggle bit of the guarding answer did not alternate"),
            Self::NodeLost => f.write_str("no valid answer of the node within its life time"),
        }
    }
}

impl<E: error::Error> error::Error for GuardError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Client(error) => error.source(),
            _ => None,
        }
    }
}

/// Returns the byte of an answer or of a boot-up message, or `None` for other frames.
fn answer(frame: &CanFrame, node: NodeId) -> Option<u8> {
    match frame.data() {
        [raw] if frame.id() == ERROR_CONTROL + u32::from(node.get()) => Some(*raw),
        _ => None,
    }
}

macro_rules! guard {
    ($Port:ident $guard:ident $cycle:ident $settle_guarding:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Runs one cycle of node guarding and returns the state of the node: sends a remote frame and waits for
            /// the answer. Call this method once in each guard time. A cycle takes at most one guard time. Discards
            /// answers that have arrived before this call.
            ///
            /// Returns [`NmtState::BootUp`] if the node has restarted since the last cycle, or restarts during the cycle.
            ///
            /// After a cycle without an answer, or a dropped async cycle, the next cycle first waits for the late
            /// answer, for at most half of the guard time. Then the cycle sends its request. If the node needs more
            /// than one guard time for an answer, the state can therefore be one cycle old.
            ///
            /// Each cycle without a valid answer counts as [missed](Guarding::missed). The node is lost if the number
            /// of consecutive missed cycles reaches the life time factor. The node is also lost if the node life time
            /// has passed since the last valid answer, measured with the clock of the port.
            ///
            /// # Errors
            ///
            /// - [`GuardError::NodeLost`] if the node is lost, as described above. The other errors mean that the node
            ///   is not lost yet.
            /// - [`GuardError::Client`] if the interface fails.
            /// - [`GuardError::NotSent`] if the bus stays busy, or if the interface cannot send remote frames.
            /// - [`GuardError::NoAnswer`] if the node doesn't answer in this cycle.
            /// - [`GuardError::ToggleBit`] if no answer has the expected toggle bit.
            pub $($async)? fn $guard(&mut self, guarding: &mut Guarding) -> Result<NmtState, GuardError<P::Error>> {
                guarding.start(self.port().now());
                let result = self.$cycle(guarding)$(.$await)?;
                let now = self.port().now();
                match result {
                    Ok(state) => Ok(guarding.accept(state, now)),
                    Err(error) => Err(guarding.fail(error, now)),
                }
            }

            $($async)? fn $cycle(&mut self, guarding: &mut Guarding) -> Result<NmtState, GuardError<P::Error>> {
                let (id, guard_time, start) = (self.id(), guarding.guard_time, self.port().now());
                // A late answer to the previous request must not be taken for the next one.
                let late = if guarding.is_owed { guard_time / 2 } else { Duration::ZERO };
                let is_restarted = self.$settle_guarding(guarding, late)$(.$await)?.map_err(GuardError::Client)?;
                if is_restarted {
                    return Ok(NmtState::BootUp);
                }
                let request = CanFrame::remote(ERROR_CONTROL + u32::from(id.get()), 1).ok_or(GuardError::NotSent)?;
                let left = |now: Option<Duration>| match start.zip(now) {
                    Some((start, now)) => guard_time.saturating_sub(now.saturating_sub(start)),
                    None => guard_time.saturating_sub(late),
                };
                let patience = left(self.port().now());
                guarding.is_owed = true;
                let is_sent = self.port().send(&request, patience)$(.$await)?.map_err(GuardError::Client)?;
                if !is_sent {
                    guarding.is_owed = false;
                    return Err(GuardError::NotSent);
                }
                let is_answer = &mut |frame: &CanFrame| answer(frame, id).is_some();
                let mut has_wrong_toggle = false;
                for _ in 0..BACKLOG {
                    let patience = left(self.port().now());
                    let frame = self.port().receive(patience, is_answer)$(.$await)?.map_err(GuardError::Client)?;
                    let Some(raw) = frame.and_then(|frame| answer(&frame, id)) else { break };
                    let is_accepted = guarding.accepts(raw);
                    let state = guarding.synchronize(raw);
                    if is_accepted {
                        guarding.is_owed = false;
                        return Ok(state);
                    }
                    has_wrong_toggle = true;
                }
                if has_wrong_toggle {
                    guarding.is_owed = false;
                    return Err(GuardError::ToggleBit);
                }
                Err(GuardError::NoAnswer)
            }

            /// Discards the answers that have arrived, and waits for a late one for `patience`. Returns whether the node
            /// has restarted since the last cycle.
            $($async)? fn $settle_guarding(&mut self, guarding: &mut Guarding, patience: Duration) -> Result<bool, P::Error> {
                let id = self.id();
                let is_answer = &mut |frame: &CanFrame| answer(frame, id).is_some();
                let (mut is_restarted, has_run) = (false, guarding.has_run);
                guarding.has_run = true;
                let mut patience = patience;
                for _ in 0..BACKLOG {
                    let frame = self.port().receive(patience, is_answer)$(.$await)??;
                    let Some(raw) = frame.and_then(|frame| answer(&frame, id)) else { break };
                    is_restarted |= guarding.synchronize(raw) == NmtState::BootUp && has_run;
                    guarding.is_owed = false;
                    patience = Duration::ZERO;
                }
                if guarding.is_owed {
                    // If the answer was lost, the node has changed its toggle bit. If the request was lost, it has not.
                    guarding.toggle = None;
                }
                Ok(is_restarted)
            }
        }
    };
}

guard! { CanPort guard cycle settle_guarding }
guard! { AsyncCanPort guard_async cycle_async settle_guarding_async async await }

#[cfg(all(test, feature = "std"))]
mod tests;
