//! A node of a CANopen network.

use core::time::Duration;

use super::emergency::EMERGENCY;
use super::frame::CanFrame;
use super::nmt::{self, NmtCommand, NmtState};
use super::port::{AsyncCanPort, CanPort, MOST_WAITING};
use super::sdo::Owed;
use crate::emergency::Emergency;
use crate::error::Error;
use crate::node_id::NodeId;
use crate::pdo::{can_id, is_restricted, CobId};
use crate::sdo::{Channel, BLOCK_THRESHOLD};
use crate::time::TimeOfDay;
use crate::value_error::{LengthError, OutOfRange};

/// Default timeout for each reply.
pub const TIMEOUT: Duration = Duration::from_millis(500);

/// A node on a CAN interface. With a [`CanPort`], the node implements [`Client`](crate::Client). With an
/// [`AsyncCanPort`], it implements [`AsyncClient`](crate::AsyncClient), and the names of its methods end in `_async`.
///
/// Frames that arrive while another frame is expected are lost, unless the interface is [`Buffered`](super::Buffered)
/// or a handle of a [`Network`](super::Network).
///
/// # Late replies
///
/// If a reply doesn't arrive within the timeout, the client aborts the transfer. The reply to the aborted transfer may
/// still arrive. The next transfer therefore waits for the late reply, for at most one more timeout, and discards it.
/// After an async transfer that was dropped, the next transfer sends the abort first. Therefore, a transfer after a
/// timeout takes up to one timeout longer. Replies to other requests don't restart the timeout.
///
/// # Duration of a transfer
///
/// Each reply must arrive within the timeout. In addition, a transfer as a whole ends after one timeout, plus one tenth
/// of the timeout for each segment of 7 bytes. If the node doesn't announce the length of an upload, only the segments
/// received so far count. For example, a value of 70 bytes takes at most two timeouts, even if the node sends each
/// segment just before the timeout of a reply. If the limit is exceeded, the client aborts the transfer and returns
/// [`Error::Timeout`]. The client measures the duration of the transfer with [`CanPort::now`]. Without a clock, only
/// the timeout of each reply applies.
///
/// # Block transfers
///
/// Values of at least [`BLOCK_THRESHOLD`] bytes are transferred in blocks with CRC (CiA 301 7.2.4.3.9 to 7.2.4.3.16).
/// For a read, the length of the buffer is used instead, because the length of the value is not known before the
/// transfer. If the node refuses a block transfer with the abort code 0x05040001, or doesn't support the CRC, the
/// client continues with a segmented transfer and doesn't try block transfers again. A segment that is lost within a
/// sub-block is sent again. If the last segment of a sub-block is lost, the transfer ends with [`Error::Timeout`].
#[derive(Clone, Debug)]
pub struct Node<P> {
    port: P,
    id: NodeId,
    channel: Channel,
    emergency_id: u32,
    timeout: Duration,
    block_threshold: usize,
    pub(super) is_block_refused: bool,
    pub(super) owed: Option<Owed>,
}

impl<P> Node<P> {
    /// Creates a client for the node `id` on `port`, with the default timeout [`TIMEOUT`].
    pub const fn new(port: P, id: NodeId) -> Self {
        Self {
            port,
            id,
            channel: Channel::of_node(id),
            emergency_id: EMERGENCY + id.get() as u32,
            timeout: TIMEOUT,
            block_threshold: BLOCK_THRESHOLD,
            is_block_refused: false,
            owed: None,
        }
    }

    /// Sets the timeout for each reply, and for sending a frame on a busy bus.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Sets the SDO channel. The default is the [default channel](Channel::of_node) of the node.
    #[must_use]
    pub fn with_channel(self, channel: Channel) -> Self {
        Self { channel, ..self }
    }

    /// Sets the COB-ID of the emergency messages (object 0x1014). Bit 29 means that the CAN-ID has 29 bits; bits 30 and
    /// 31 are ignored. The default is 0x80 plus the node-ID.
    #[must_use]
    pub fn with_emergency_id(self, cob_id: u32) -> Self {
        Self { emergency_id: cob_id, ..self }
    }

    /// Sets the minimum length in bytes of values that are transferred in blocks. `usize::MAX` disables block
    /// transfers, for example for a node that doesn't reply to them. Values of at most 4 bytes are never transferred in
    /// blocks.
    #[must_use]
    pub fn with_block_threshold(self, bytes: usize) -> Self {
        Self { block_threshold: bytes, ..self }
    }

    /// Returns the SDO channel.
    pub const fn channel(&self) -> Channel {
        self.channel
    }

    /// Returns the minimum length in bytes of values that are transferred in blocks. After the node has refused a block
    /// transfer, this length is `usize::MAX`.
    pub const fn block_threshold(&self) -> usize {
        if self.is_block_refused {
            usize::MAX
        } else {
            self.block_threshold
        }
    }

    /// Returns the node-ID.
    pub const fn id(&self) -> NodeId {
        self.id
    }

    /// Returns the timeout for each reply.
    pub const fn timeout(&self) -> Duration {
        self.timeout
    }

    /// Returns the CAN interface.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }

    /// Returns the CAN interface and drops the client.
    pub fn into_port(self) -> P {
        self.port
    }
}

pub(super) fn sent<E>(is_sent: bool) -> Result<(), Error<E>> {
    if is_sent {
        Ok(())
    } else {
        Err(Error::Timeout)
    }
}

/// Returns the state in the frame if the frame is a heartbeat of `id`.
pub(super) fn state_of(frame: &CanFrame, id: NodeId) -> Option<NmtState> {
    NmtState::of(frame).filter(|(node, _)| *node == id).map(|(_, state)| state)
}

/// Returns the CAN-ID of a PDO of `node`, or [`Error::OutOfRange`] if a PDO must not use it. Bit 29 is set if the
/// CAN-ID has 29 bits.
///
/// Some PDOs have the default COB-ID 0, which would be an NMT command to all nodes. Restricted COB-IDs are therefore
/// rejected.
fn identifier<E>(cob_id: CobId, node: NodeId) -> Result<u32, Error<E>> {
    // Bit 31 marks a PDO that is disabled by default; a configuration can enable it. Bit 30 means that RTR isn't
    // allowed.
    pdo_id(cob_id, node).ok_or(Error::OutOfRange(OutOfRange))
}

/// Returns the CAN-ID of a PDO of `node`, or `None` if a PDO must not use it.
pub(super) fn pdo_id(cob_id: CobId, node: NodeId) -> Option<u32> {
    can_id(cob_id.resolve(node)).filter(|id| !is_restricted(*id))
}

fn pdo<E>(cob_id: CobId, node: NodeId, data: &[u8]) -> Result<CanFrame, Error<E>> {
    let id = identifier(cob_id, node)?;
    CanFrame::new(id, data).ok_or(Error::Length(LengthError::new(8, data.len())))
}

/// Defines the methods of a node, blocking and async.
macro_rules! methods {
    (
        $Port:ident: $send:ident $nmt:ident $send_time:ident $time:ident $sync:ident $sync_with_counter:ident $heartbeat:ident $wait_for:ident $emergency:ident $send_pdo:ident
        $receive_pdo:ident $latest_pdo:ident $discard_states:ident $newest:ident $($async:ident $await:ident)?
    ) => {
        impl<P: $Port> Node<P> {
            /// Sends a frame on the bus.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Client`] if the interface fails, or [`Error::Timeout`] if the bus stays busy.
            pub $($async)? fn $send(&mut self, frame: &CanFrame) -> Result<(), Error<P::Error>> {
                sent(self.port.send(frame, self.timeout)$(.$await)?.map_err(Error::Client)?)
            }

            /// Sends an NMT command to the node (CiA 301 7.2.8.3.1). Nodes don't reply; the heartbeat shows the new
            /// state.
            ///
            /// Before a command that restarts the node, this method discards the heartbeats and boot-up messages of the
            /// node that have already arrived. The next boot-up message therefore shows that the node has restarted.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send).
            pub $($async)? fn $nmt(&mut self, command: NmtCommand) -> Result<(), Error<P::Error>> {
                if matches!(command, NmtCommand::ResetNode | NmtCommand::ResetCommunication) {
                    self.$discard_states()$(.$await)??;
                }
                let frame = command.frame(Some(self.id));
                self.$send(&frame)$(.$await)?
            }

            /// Discards the heartbeats and boot-up messages of the node that have already arrived.
            pub(super) $($async)? fn $discard_states(&mut self) -> Result<(), Error<P::Error>> {
                let id = self.id;
                self.$newest(Duration::ZERO, &mut |frame| state_of(frame, id).is_some())$(.$await)?.map(|_| ())
            }

            /// Receives all waiting frames for which `is_wanted` returns true, and returns the newest. If no frame is waiting,
            /// waits for `patience`.
            $($async)? fn $newest(
                &mut self,
                mut patience: Duration,
                is_wanted: &mut dyn FnMut(&CanFrame) -> bool,
            ) -> Result<Option<CanFrame>, Error<P::Error>> {
                let mut newest = None;
                for _ in 0..MOST_WAITING {
                    let frame = self.port.receive(patience, is_wanted)$(.$await)?.map_err(Error::Client)?;
                    let Some(frame) = frame else { break };
                    newest = Some(frame);
                    patience = Duration::ZERO;
                }
                Ok(newest)
            }

            /// Sends TIME with the default COB-ID 0x100 (CiA 301 7.2.6). All nodes that consume TIME set their clocks.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send), or [`Error::OutOfRange`] if the time of day isn't less than
            /// 24 hours.
            pub $($async)? fn $send_time(&mut self, time: TimeOfDay) -> Result<(), Error<P::Error>> {
                if !time.is_valid() {
                    return Err(Error::OutOfRange(OutOfRange));
                }
                self.$send(&time.frame())$(.$await)?
            }

            /// Returns the time in the newest TIME message with the default COB-ID 0x100, and the
            /// [time](CanFrame::time) at which the message was taken from the interface. Waits for `patience` if no
            /// message has arrived since the last call. Returns `None` if no message arrives.
            ///
            /// An interface that keeps frames can return an old message. To determine the age of the message, compare
            /// the second element of the result with [`CanPort::now`]. On a [`Network`](super::Network), call this
            /// method on the handle of the [services](super::Network::services).
            ///
            /// # Errors
            ///
            /// Returns [`Error::Client`] if the interface fails.
            pub $($async)? fn $time(
                &mut self,
                patience: Duration,
            ) -> Result<Option<(TimeOfDay, Option<Duration>)>, Error<P::Error>> {
                let newest = self.$newest(patience, &mut |frame| TimeOfDay::of(frame).is_some())$(.$await)??;
                Ok(newest.and_then(|frame| Some((TimeOfDay::of(&frame)?, frame.time()))))
            }

            /// Sends SYNC. The nodes of the network send and apply their synchronous PDOs when they receive SYNC.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send).
            pub $($async)? fn $sync(&mut self) -> Result<(), Error<P::Error>> {
                self.$send(&nmt::sync())$(.$await)?
            }

            /// Sends SYNC with a counter (CiA 301 7.2.5.3). Devices that use a SYNC start value
            /// ([`PdoParameters::sync_start`](crate::pdo::PdoParameters::sync_start)) need the counter. The counter
            /// starts at 1, increases by 1 with each SYNC, and returns to 1 after the synchronous counter overflow value
            /// (0x1019).
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send), or [`Error::OutOfRange`] if the counter is outside the range
            /// 1 to 240.
            pub $($async)? fn $sync_with_counter(&mut self, counter: u8) -> Result<(), Error<P::Error>> {
                let frame = nmt::sync_with_counter(counter).ok_or(Error::OutOfRange(OutOfRange))?;
                self.$send(&frame)$(.$await)?
            }

            /// Returns the newest state that the node has reported since the last call. Waits for `patience` if no heartbeat
            /// has arrived. Returns `None` if no heartbeat arrives.
            ///
            /// Discards older heartbeats, including those in the receive queue of the interface. A boot-up message is never
            /// discarded: if the node has restarted since the last call, this method returns [`NmtState::BootUp`], and the
            /// next call returns the state after the restart.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Client`] if the interface fails.
            pub $($async)? fn $heartbeat(&mut self, patience: Duration) -> Result<Option<NmtState>, Error<P::Error>> {
                let (id, mut newest, mut patience) = (self.id, None, patience);
                for _ in 0..MOST_WAITING {
                    let frame = self.port.receive(patience, &mut |frame| state_of(frame, id).is_some())$(.$await)?;
                    let Some(frame) = frame.map_err(Error::Client)? else { break };
                    newest = state_of(&frame, id);
                    if newest == Some(NmtState::BootUp) {
                        break;
                    }
                    patience = Duration::ZERO;
                }
                Ok(newest)
            }

            /// Waits for a heartbeat that reports this state. Pass [`NmtState::BootUp`] to wait for the boot-up
            /// message, which a node sends after its start.
            ///
            /// This method also accepts heartbeats that a [`Buffered`](super::Buffered) interface or a
            /// [`Network`](super::Network) has stored. To ignore them, call [`Buffered::clear`](super::Buffered::clear)
            /// or [`NetworkPort::clear`](super::NetworkPort::clear) first. [`nmt`](Self::nmt) discards the heartbeats
            /// of the node before a command that restarts the node.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Client`] if the interface fails, or [`Error::Timeout`] if no such heartbeat arrives
            /// within `patience`.
            pub $($async)? fn $wait_for(&mut self, state: NmtState, patience: Duration) -> Result<(), Error<P::Error>> {
                let id = self.id;
                let frame = self.port.receive(patience, &mut |frame| state_of(frame, id) == Some(state))$(.$await)?;
                sent(frame.map_err(Error::Client)?.is_some())
            }

            /// Waits for the node's next emergency message and returns it. Returns `None` if no message arrives within
            /// `patience`. If several messages are waiting, this method returns the oldest one. If the node doesn't use
            /// the default COB-ID, set the COB-ID with [`with_emergency_id`](Self::with_emergency_id).
            ///
            /// # Errors
            ///
            /// Returns [`Error::Client`] if the interface fails.
            pub $($async)? fn $emergency(&mut self, patience: Duration) -> Result<Option<Emergency>, Error<P::Error>> {
                let id = self.emergency_id;
                let frame = self.port.receive(patience, &mut |frame| Emergency::of_id(frame, id).is_some())$(.$await)?;
                Ok(frame.map_err(Error::Client)?.and_then(|frame| Emergency::of_id(&frame, id)))
            }

            /// Sends a PDO to the node. `data` is the output of a generated struct's `pack`, and `cob_id` is the
            /// struct's `COB_ID`.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`send`](Self::send). Returns [`Error::OutOfRange`] if `cob_id` isn't allowed for
            /// a PDO (CiA 301 7.3.5), or [`Error::Length`] if `data` has more than 8 bytes.
            pub $($async)? fn $send_pdo(&mut self, cob_id: CobId, data: &[u8]) -> Result<(), Error<P::Error>> {
                let frame = pdo(cob_id, self.id, data)?;
                self.$send(&frame)$(.$await)?
            }

            /// Waits for the next PDO with this COB-ID and returns it. Pass the data of the PDO to `unpack` of a
            /// generated struct.
            ///
            /// If several PDOs are waiting, this method returns the oldest one. For the newest PDO, use
            /// [`latest_pdo`](Self::latest_pdo), or call [`clear`](super::Buffered::clear) before SYNC.
            ///
            /// # Errors
            ///
            /// - [`Error::Client`] if the interface fails.
            /// - [`Error::Timeout`] if no PDO arrives within `patience`.
            /// - [`Error::OutOfRange`] if `cob_id` is invalid, as for [`send_pdo`](Self::send_pdo).
            pub $($async)? fn $receive_pdo(
                &mut self,
                cob_id: CobId,
                patience: Duration,
            ) -> Result<CanFrame, Error<P::Error>> {
                let id = identifier(cob_id, self.id)?;
                let frame = self.port.receive(patience, &mut |frame| frame.id() == id && !frame.is_remote())$(.$await)?;
                frame.map_err(Error::Client)?.ok_or(Error::Timeout)
            }

            /// Returns the newest PDO with this COB-ID that has arrived since the last call, without waiting. Discards
            /// older PDOs, including those in the receive queue of the interface. Returns `None` if no PDO has arrived.
            ///
            /// The [time](CanFrame::time) of the frame is the time of its arrival. If the interface has no timestamps, a
            /// PDO in the receive queue of the interface has the time of this call. A control loop that calls this
            /// method in each cycle then knows the age of its data with an error of at most one cycle:
            ///
            /// ```
            /// # use lexibus::clients::canopen::{CanFrame, CanPort, Node};
            /// # use lexibus::{CobId, Error};
            /// # use std::time::Duration;
            /// const STATUS: CobId = CobId::from_node(0x180);
            ///
            /// /// Returns the newest data, which are at most 20 ms old.
            /// fn status<P: CanPort>(node: &mut Node<P>, last: &mut CanFrame) -> Result<CanFrame, Error<P::Error>> {
            ///     *last = node.latest_pdo(STATUS)?.unwrap_or(*last);
            ///     let age = node.port().now().zip(last.time()).map(|(now, time)| now.saturating_sub(time));
            ///     if age.is_some_and(|age| age <= Duration::from_millis(20)) { Ok(*last) } else { Err(Error::Timeout) }
            /// }
            /// ```
            ///
            /// # Errors
            ///
            /// - [`Error::Client`] if the interface fails.
            /// - [`Error::OutOfRange`] if `cob_id` is invalid, as for [`send_pdo`](Self::send_pdo).
            pub $($async)? fn $latest_pdo(&mut self, cob_id: CobId) -> Result<Option<CanFrame>, Error<P::Error>> {
                let id = identifier(cob_id, self.id)?;
                self.$newest(Duration::ZERO, &mut |frame| frame.id() == id && !frame.is_remote())$(.$await)?
            }
        }
    };
}

methods! {
    CanPort: send nmt send_time time sync sync_with_counter heartbeat wait_for emergency send_pdo receive_pdo latest_pdo
    discard_states newest
}
methods! {
    AsyncCanPort: send_async nmt_async send_time_async time_async sync_async sync_with_counter_async heartbeat_async wait_for_async emergency_async send_pdo_async
    receive_pdo_async latest_pdo_async discard_states_async newest_async async await
}
