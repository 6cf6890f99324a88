//! Node guarding (CiA 301 7.2.8.3.2.1).

use core::error;
use core::fmt;
use core::time::Duration;

use super::frame::CanFrame;
use super::nmt::{NmtState, ERROR_CONTROL};
use super::node::Node;
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::node_id::NodeId;

/// Bit of an answer that alternates.
const TOGGLE: u8 = 1 << 7;

/// Node guarding of one node, as NMT master. [`Node::guard`] runs one cycle.
///
/// The node answers a remote frame with its NMT state and a bit that alternates. Use node guarding only for devices that
/// have no heartbeat producer.
#[derive(Clone, Debug)]
pub struct Guarding {
    guard_time: Duration,
    life_time_factor: u8,
    /// Toggle bit of the next answer, or `None` if it is unknown.
    toggle: Option<bool>,
    missed: u8,
}

impl Guarding {
    /// Creates the guarding of a node. Set the objects 0x100C and 0x100D of the node to the same values, so that the node
    /// notices if the master fails.
    ///
    /// The guard time is the time between two cycles, and the longest time of a cycle. The node is lost if it doesn't
    /// answer in `life_time_factor` consecutive cycles. The factor 0 has the same effect as 1.
    #[must_use]
    pub const fn new(guard_time: Duration, life_time_factor: u8) -> Self {
        Self { guard_time, life_time_factor, toggle: None, missed: 0 }
    }

    /// Returns the guard time.
    #[must_use]
    pub const fn guard_time(&self) -> Duration {
        self.guard_time
    }

    /// Returns the node life time: the guard time multiplied by the life time factor.
    #[must_use]
    pub fn life_time(&self) -> Duration {
        self.guard_time.saturating_mul(self.life_time_factor.into())
    }

    /// Returns the number of consecutive cycles in which the node did not answer.
    #[must_use]
    pub const fn missed(&self) -> u8 {
        self.missed
    }

    /// Returns whether a byte is the expected answer, or a boot-up message.
    fn accepts(&self, raw: u8) -> bool {
        raw == NmtState::BootUp.raw() || self.toggle.map_or(true, |toggle| toggle == (raw & TOGGLE != 0))
    }

    /// Sets the toggle bit of the next answer. After the boot-up message, it is 0.
    fn synchronize(&mut self, raw: u8) -> NmtState {
        let state = NmtState::from_raw(raw);
        self.toggle = Some(state != NmtState::BootUp && raw & TOGGLE == 0);
        state
    }

    /// Processes the answer of a cycle.
    fn accept(&mut self, raw: u8) -> NmtState {
        self.missed = 0;
        self.synchronize(raw)
    }

    /// Processes a cycle without a valid answer. If the answer was lost, the node has changed its toggle bit.
    fn miss<E>(&mut self, has_wrong_toggle: bool) -> GuardError<E> {
        self.missed = self.missed.saturating_add(1);
        self.toggle = None;
        match has_wrong_toggle {
            _ if self.missed >= self.life_time_factor => GuardError::NodeLost,
            true => GuardError::ToggleBit,
            false => GuardError::NoAnswer,
        }
    }
}

/// Reason why a cycle of node guarding failed. `E` is the error type of the CAN interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum GuardError<E> {
    /// The CAN interface returned an error.
    Client(E),
    /// The bus was busy, and the request was not sent.
    NotSent,
    /// The node did not answer in this cycle. The node life time has not passed.
    NoAnswer,
    /// The toggle bit of the answer did not alternate. The node life time has not passed.
    ToggleBit,
    /// The node did not answer within the node life time.
    NodeLost,
}

impl<E: fmt::Display> fmt::Display for GuardError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::NotSent => f.write_str("the bus is busy, the guarding request was not sent"),
            Self::NoAnswer => f.write_str("the node did not answer the guarding request"),
            Self::ToggleBit => f.write_str("the toggle bit of the guarding answer did not alternate"),
            Self::NodeLost => f.write_str("the node did not answer within its life time"),
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

/// Returns the byte of an answer or of a boot-up message.
fn answer(frame: &CanFrame, node: NodeId) -> Option<u8> {
    match frame.data() {
        [raw] if frame.id() == ERROR_CONTROL + u32::from(node.get()) => Some(*raw),
        _ => None,
    }
}

macro_rules! guard {
    ($Port:ident $guard:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Runs one cycle of node guarding and returns the state of the node: sends a remote frame and waits for the
            /// answer, at most for the guard time. Call this method once in each guard time. Discards the answers that
            /// have arrived before.
            ///
            /// Returns [`NmtState::BootUp`] if the node has restarted since the last cycle, or restarts during the cycle.
            ///
            /// After a cycle without an answer, the next cycle waits for the late answer before it sends a request, for at
            /// most the guard time. This cycle therefore takes up to twice the guard time.
            ///
            /// # Errors
            ///
            /// - [`GuardError::Client`] if the interface fails, or [`GuardError::NotSent`] if the bus stays busy.
            /// - [`GuardError::NoAnswer`] if the node doesn't answer in this cycle.
            /// - [`GuardError::ToggleBit`] if the only answers have the toggle bit of the previous answer.
            /// - [`GuardError::NodeLost`] if the node doesn't answer in as many cycles as the life time factor.
            pub $($async)? fn $guard(&mut self, guarding: &mut Guarding) -> Result<NmtState, GuardError<P::Error>> {
                let (id, guard_time) = (self.id(), guarding.guard_time);
                let is_answer = &mut |frame: &CanFrame| answer(frame, id).is_some();
                // A late answer to the previous request must not be taken for the next one.
                let mut is_restarted = false;
                let mut patience = if guarding.missed > 0 { guard_time } else { Duration::ZERO };
                for _ in 0..BACKLOG {
                    let old = self.port().receive(patience, is_answer)$(.$await)?.map_err(GuardError::Client)?;
                    let Some(raw) = old.and_then(|frame| answer(&frame, id)) else { break };
                    let has_answered = guarding.toggle.is_some();
                    is_restarted |= guarding.synchronize(raw) == NmtState::BootUp && has_answered;
                    patience = Duration::ZERO;
                }
                if is_restarted {
                    guarding.missed = 0;
                    return Ok(NmtState::BootUp);
                }
                let request = CanFrame::remote(ERROR_CONTROL + u32::from(id.get()), 1).ok_or(GuardError::NotSent)?;
                let start = self.port().now();
                let is_sent = self.port().send(&request, guard_time)$(.$await)?.map_err(GuardError::Client)?;
                if !is_sent {
                    return Err(GuardError::NotSent);
                }
                let (mut last, mut has_wrong_toggle) = (None, false);
                for _ in 0..BACKLOG {
                    let elapsed = start.zip(self.port().now()).map(|(start, now)| now.saturating_sub(start));
                    let left = guard_time.saturating_sub(elapsed.unwrap_or_default());
                    let frame = self.port().receive(left, is_answer)$(.$await)?.map_err(GuardError::Client)?;
                    let Some(raw) = frame.and_then(|frame| answer(&frame, id)) else { break };
                    if guarding.accepts(raw) {
                        last = Some(raw);
                        break;
                    }
                    has_wrong_toggle = true;
                }
                match last {
                    Some(raw) => Ok(guarding.accept(raw)),
                    None => Err(guarding.miss(has_wrong_toggle)),
                }
            }
        }
    };
}

guard! { CanPort guard }
guard! { AsyncCanPort guard_async async await }
