//! Heartbeat consumer (CiA 301 7.2.8.3.2.2).

use core::error;
use core::fmt;
use core::time::Duration;

use super::nmt::NmtState;
use super::node::{state_of, Node};
use super::port::{AsyncCanPort, CanPort, MOST_WAITING};

/// Heartbeat consumer for one node. [`Node::watch`] checks whether the node still sends its heartbeat.
///
/// As CiA 301 requires, monitoring starts with the first heartbeat of the node.
///
/// ```
/// use std::time::Duration;
///
/// use lexibus::clients::canopen::{CanPort, HeartbeatConsumer, HeartbeatError, NmtState, Node};
///
/// /// One cycle of a control loop. `consumer` is `HeartbeatConsumer::new(Duration::from_millis(250))`.
/// fn cycle<P: CanPort>(
///     node: &mut Node<P>,
///     consumer: &mut HeartbeatConsumer,
/// ) -> Result<bool, HeartbeatError<P::Error>> {
///     Ok(node.watch(consumer)? == Some(NmtState::Operational))
/// }
/// ```
#[derive(Clone, Debug)]
pub struct HeartbeatConsumer {
    time: Duration,
    /// Time and state of the last heartbeat.
    last: Option<(Duration, NmtState)>,
}

impl HeartbeatConsumer {
    /// Creates a consumer. `time` is the consumer heartbeat time: the longest time between two heartbeats. The consumer
    /// heartbeat time must be longer than the producer heartbeat time of the node (0x1017).
    #[must_use]
    pub const fn new(time: Duration) -> Self {
        Self { time, last: None }
    }

    /// Returns the state of the node after the last heartbeat, or `None` before the first heartbeat.
    #[must_use]
    pub fn state(&self) -> Option<NmtState> {
        self.last.map(|(_, state)| state)
    }

    /// Returns the state of the node, `None` before its first heartbeat, or an error if its last heartbeat is too old.
    fn check<E>(&mut self, now: Duration) -> Result<Option<NmtState>, HeartbeatError<E>> {
        let Some((time, state)) = self.last else { return Ok(None) };
        if now.saturating_sub(time) > self.time {
            return Err(HeartbeatError::Missing { state });
        }
        if state == NmtState::BootUp {
            // The node enters Pre-operational on its own (CiA 301 7.3.2.2.1).
            self.last = Some((time, NmtState::PreOperational));
        }
        Ok(Some(state))
    }
}

/// Reason why a [`HeartbeatConsumer`] cannot report the state of its node. `E` is the error type of the CAN interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum HeartbeatError<E> {
    /// The CAN interface returned an error.
    Client(E),
    /// No heartbeat arrived within the consumer heartbeat time. The error lasts until the next heartbeat.
    Missing {
        /// State in the last heartbeat.
        state: NmtState,
    },
    /// The CAN interface has no clock: implement [`CanPort::now`].
    NoClock,
}

impl<E: fmt::Display> fmt::Display for HeartbeatError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::Missing { state } => write!(f, "the heartbeat of the node is missing; its last state was {state:?}"),
            Self::NoClock => f.write_str("the CAN interface has no clock"),
        }
    }
}

impl<E: error::Error> error::Error for HeartbeatError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Client(error) => error.source(),
            _ => None,
        }
    }
}

macro_rules! watch {
    ($Port:ident $watch:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Receives the heartbeats that have arrived, and returns the newest state of the node. Returns `None`
            /// before the first heartbeat. The method does not wait. Call it at intervals that are shorter than the
            /// consumer heartbeat time. The age of a heartbeat is measured from its [time](super::CanFrame::time), or
            /// from this call if the frame has no time.
            ///
            /// A boot-up message is never discarded: if the node has restarted since the last call, this method returns
            /// [`NmtState::BootUp`] once. Until the next heartbeat, the state is then Pre-operational, which a node enters
            /// after its start.
            ///
            /// # Errors
            ///
            /// - [`HeartbeatError::Missing`] if the last heartbeat is older than the consumer heartbeat time.
            /// - [`HeartbeatError::Client`] if the interface fails.
            /// - [`HeartbeatError::NoClock`] if the interface has no clock.
            pub $($async)? fn $watch(
                &mut self,
                consumer: &mut HeartbeatConsumer,
            ) -> Result<Option<NmtState>, HeartbeatError<P::Error>> {
                let id = self.id();
                for _ in 0..MOST_WAITING {
                    let is_heartbeat = &mut |frame: &super::CanFrame| state_of(frame, id).is_some();
                    let frame = self.port().receive(Duration::ZERO, is_heartbeat)$(.$await)?;
                    let Some(frame) = frame.map_err(HeartbeatError::Client)? else { break };
                    let time = frame.time().or_else(|| self.port().now()).ok_or(HeartbeatError::NoClock)?;
                    consumer.last = state_of(&frame, id).map(|state| (time, state));
                    if consumer.state() == Some(NmtState::BootUp) {
                        break;
                    }
                }
                consumer.check(self.port().now().ok_or(HeartbeatError::NoClock)?)
            }
        }
    };
}

watch! { CanPort watch }
watch! { AsyncCanPort watch_async async await }
