//! One node of a network.

use core::time::Duration;

use super::frame::CanFrame;
use super::nmt::{self, NmtCommand, NmtState};
use super::port::{AsyncCanPort, CanPort};
use crate::emergency::Emergency;
use crate::error::Error;
use crate::node_id::NodeId;
use crate::pdo::{is_restricted, CobId};
use crate::value_error::{LengthError, OutOfRange};

/// How long an answer may take where nothing else is said.
pub const TIMEOUT: Duration = Duration::from_millis(500);

/// One node behind a CAN interface. It is a [`Client`](crate::Client) of a [`CanPort`], an
/// [`AsyncClient`](crate::AsyncClient) of an [`AsyncCanPort`], whose methods end in `_async`.
///
/// Frames that come while others are waited for are lost, unless the interface is [`Buffered`](super::Buffered).
#[derive(Clone, Debug)]
pub struct Node<P> {
    port: P,
    id: NodeId,
    timeout: Duration,
}

impl<P> Node<P> {
    /// The node `id` behind `port`. An answer may take [`TIMEOUT`].
    pub const fn new(port: P, id: NodeId) -> Self {
        Self { port, id, timeout: TIMEOUT }
    }

    /// The same with another time for each answer, and for the bus to become free.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// The node-ID.
    pub const fn id(&self) -> NodeId {
        self.id
    }

    /// How long an answer may take.
    pub const fn timeout(&self) -> Duration {
        self.timeout
    }

    /// The interface.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }

    /// Gives the interface back.
    pub fn into_port(self) -> P {
        self.port
    }
}

fn sent<E>(is_sent: bool) -> Result<(), Error<E>> {
    if is_sent {
        Ok(())
    } else {
        Err(Error::Timeout)
    }
}

/// The state that the frame tells where it is a heartbeat of `id`.
fn state_of(frame: &CanFrame, id: NodeId) -> Option<NmtState> {
    NmtState::of(frame).filter(|(node, _)| *node == id).map(|(_, state)| state)
}

/// The identifier of a PDO of `node`, of 11 bits. A PDO that has none by default says 0, which would be a command of NMT to all
/// nodes: such identifiers are never a PDO's.
fn identifier<E>(cob_id: CobId, node: NodeId) -> Result<u16, Error<E>> {
    // Bit 31 says that the PDO is off by default, which its configuration changes; bit 30 that no remote request is answered.
    let id = cob_id.resolve(node) & 0x3FFF_FFFF;
    u16::try_from(id).ok().filter(|_| !is_restricted(id)).ok_or(Error::OutOfRange(OutOfRange))
}

fn pdo<E>(cob_id: CobId, node: NodeId, data: &[u8]) -> Result<CanFrame, Error<E>> {
    let id = identifier(cob_id, node)?;
    CanFrame::new(id, data).ok_or(Error::Length(LengthError::new(8, data.len())))
}

/// The methods of a node, blocking and not.
macro_rules! methods {
    (
        $Port:ident: $send:ident $nmt:ident $sync:ident $heartbeat:ident $wait_for:ident $emergency:ident $send_pdo:ident
        $receive_pdo:ident $($async:ident $await:ident)?
    ) => {
        impl<P: $Port> Node<P> {
            /// Sends a frame, whoever it is for.
            ///
            /// # Errors
            ///
            /// [`Error::Client`] where the interface fails, [`Error::Timeout`] where the bus doesn't become free.
            pub $($async)? fn $send(&mut self, frame: &CanFrame) -> Result<(), Error<P::Error>> {
                sent(self.port.send(frame, self.timeout)$(.$await)?.map_err(Error::Client)?)
            }

            /// Tells the node what to do (CiA 301 7.2.8.3.1). No node answers to it; its heartbeat shows the state.
            ///
            /// # Errors
            ///
            /// Those of [`send`](Self::send).
            pub $($async)? fn $nmt(&mut self, command: NmtCommand) -> Result<(), Error<P::Error>> {
                let frame = command.frame(Some(self.id));
                self.$send(&frame)$(.$await)?
            }

            /// Sends SYNC, at which all nodes of the network send and take over their synchronous PDOs.
            ///
            /// # Errors
            ///
            /// Those of [`send`](Self::send).
            pub $($async)? fn $sync(&mut self) -> Result<(), Error<P::Error>> {
                self.$send(&nmt::sync())$(.$await)?
            }

            /// The state that the node's next heartbeat tells; `None` where none comes within `patience`. Of heartbeats
            /// that a [`Buffered`](super::Buffered) interface has kept, it is the oldest:
            /// [`clear`](super::Buffered::clear) forgets them.
            ///
            /// # Errors
            ///
            /// [`Error::Client`] where the interface fails.
            pub $($async)? fn $heartbeat(&mut self, patience: Duration) -> Result<Option<NmtState>, Error<P::Error>> {
                let id = self.id;
                let frame = self.port.receive(patience, &mut |frame| state_of(frame, id).is_some())$(.$await)?;
                Ok(frame.map_err(Error::Client)?.and_then(|frame| state_of(&frame, id)))
            }

            /// Waits for a heartbeat that tells `state`; [`NmtState::BootUp`] is the message of a node that has just
            /// started. One that a [`Buffered`](super::Buffered) interface has kept counts, too:
            /// [`clear`](super::Buffered::clear) forgets it.
            ///
            /// # Errors
            ///
            /// [`Error::Client`] where the interface fails, [`Error::Timeout`] where no such heartbeat comes within
            /// `patience`.
            pub $($async)? fn $wait_for(&mut self, state: NmtState, patience: Duration) -> Result<(), Error<P::Error>> {
                let id = self.id;
                let frame = self.port.receive(patience, &mut |frame| state_of(frame, id) == Some(state))$(.$await)?;
                sent(frame.map_err(Error::Client)?.is_some())
            }

            /// The node's next emergency message, the oldest that a [`Buffered`](super::Buffered) interface has kept;
            /// `None` where none comes within `patience`.
            ///
            /// # Errors
            ///
            /// [`Error::Client`] where the interface fails.
            pub $($async)? fn $emergency(&mut self, patience: Duration) -> Result<Option<Emergency>, Error<P::Error>> {
                let id = self.id;
                let frame = self.port.receive(patience, &mut |frame| Emergency::of(frame, id).is_some())$(.$await)?;
                Ok(frame.map_err(Error::Client)?.and_then(|frame| Emergency::of(&frame, id)))
            }

            /// Sends a PDO to the node: `data` is what `pack` of a generated struct gives, `cob_id` its `COB_ID`.
            ///
            /// # Errors
            ///
            /// Those of [`send`](Self::send); [`Error::OutOfRange`] where `cob_id` names no CAN-ID of 11 bits that a
            /// PDO may have (CiA 301 7.3.5), [`Error::Length`] where there are more than 8 bytes.
            pub $($async)? fn $send_pdo(&mut self, cob_id: CobId, data: &[u8]) -> Result<(), Error<P::Error>> {
                let frame = pdo(cob_id, self.id, data)?;
                self.$send(&frame)$(.$await)?
            }

            /// The next PDO that the node sends with this identifier, for `unpack` of a generated struct. Of those that
            /// a [`Buffered`](super::Buffered) interface has kept, it is the oldest: where only the newest counts,
            /// [`clear`](super::Buffered::clear) forgets them before SYNC.
            ///
            /// # Errors
            ///
            /// [`Error::Client`] where the interface fails, [`Error::Timeout`] where none comes within `patience`,
            /// [`Error::OutOfRange`] as of [`send_pdo`](Self::send_pdo).
            pub $($async)? fn $receive_pdo(
                &mut self,
                cob_id: CobId,
                patience: Duration,
            ) -> Result<CanFrame, Error<P::Error>> {
                let id = identifier(cob_id, self.id)?;
                let frame = self.port.receive(patience, &mut |frame| frame.id() == id)$(.$await)?;
                frame.map_err(Error::Client)?.ok_or(Error::Timeout)
            }
        }
    };
}

methods! { CanPort: send nmt sync heartbeat wait_for emergency send_pdo receive_pdo }
methods! {
    AsyncCanPort: send_async nmt_async sync_async heartbeat_async wait_for_async emergency_async send_pdo_async
    receive_pdo_async async await
}
