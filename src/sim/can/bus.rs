//! A simulated CAN bus with several nodes.

use core::convert::Infallible;
use core::time::Duration;
use std::collections::VecDeque;
use std::vec::Vec;

use super::{CanNode, MOST_FRAMES};
use crate::clients::canopen::{AsyncCanPort, CanFrame, CanPort};

/// A simulated CAN bus with several nodes, which also receive each other's frames. CANopen clients use the bus as their
/// CAN port. The clock of the bus is simulated, like the clock of a [`CanNode`].
///
/// ```
/// use core::time::Duration;
///
/// use lexibus::clients::canopen::{NmtCommand, NmtState, Node};
/// use lexibus::sim::{CanBus, CanNode, Device};
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::ENTRIES;
///
/// let [left, right] = [5, 6].map(|id| NodeId::new(id).unwrap());
/// let mut bus = CanBus::new();
/// for id in [left, right] {
///     bus.add(CanNode::new(Device::new(ENTRIES).with_node_id(id)));
/// }
/// let mut node = Node::new(&mut bus, right);
/// node.nmt(NmtCommand::Start)?;
/// assert_eq!(bus.nodes().iter().map(|node| node.state()).collect::<Vec<_>>(), [NmtState::PreOperational, NmtState::Operational]);
/// # Ok::<(), lexibus::Error<core::convert::Infallible>>(())
/// ```
#[derive(Debug, Default)]
pub struct CanBus {
    nodes: Vec<CanNode>,
    /// Frames of the nodes that have not been received.
    frames: VecDeque<CanFrame>,
    now: Duration,
}

impl CanBus {
    /// Creates a bus without nodes.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a node. Other nodes receive the frames that the node has already sent, such as its boot-up message.
    pub fn add(&mut self, node: CanNode) {
        self.nodes.push(node);
        self.synchronize();
    }

    /// Returns the nodes, in the order in which they were added.
    pub fn nodes(&mut self) -> &mut [CanNode] {
        &mut self.nodes
    }

    /// Returns the simulated time.
    #[must_use]
    pub const fn now(&self) -> Duration {
        self.now
    }

    /// Moves the clock forward. The nodes send the frames that become due.
    pub fn advance(&mut self, time: Duration) {
        self.advance_to(self.now.saturating_add(time));
    }

    /// Moves the clock forward, from event to event, so that the nodes receive each other's frames in time.
    fn advance_to(&mut self, end: Duration) {
        self.exchange();
        while let Some(next) = self.next_event().filter(|next| *next <= end) {
            self.now = next;
            self.synchronize();
            self.exchange();
        }
        self.now = end;
        self.synchronize();
    }

    fn next_event(&self) -> Option<Duration> {
        self.nodes.iter().filter_map(CanNode::next_event).filter(|event| *event > self.now).min()
    }

    /// Sets the clocks of all nodes to the latest one. The clock of a node advances while the node accesses its device.
    fn synchronize(&mut self) {
        self.now = self.nodes.iter().map(CanNode::now).fold(self.now, Duration::max);
        for node in &mut self.nodes {
            node.advance(self.now.saturating_sub(node.now));
        }
    }

    /// Sends a frame to all nodes except its sender.
    fn deliver(&mut self, frame: &CanFrame, sender: Option<usize>) {
        for (at, node) in self.nodes.iter_mut().enumerate() {
            if Some(at) != sender {
                node.handle(frame);
            }
        }
        self.synchronize();
    }

    /// Delivers each frame of a node to all other nodes, and keeps the frame for the client. A limit ends an endless
    /// exchange between nodes that answer each other.
    fn exchange(&mut self) {
        for _ in 0..MOST_FRAMES {
            let frames = self.nodes.iter_mut().enumerate();
            let Some((sender, frame)) = frames.filter_map(|(at, node)| Some((at, node.next_frame()?))).next() else {
                break;
            };
            self.deliver(&frame, Some(sender));
            if self.frames.len() >= MOST_FRAMES {
                self.frames.pop_front();
            }
            self.frames.push_back(frame.at(Some(self.now)));
        }
    }
}

impl CanPort for CanBus {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        self.deliver(frame, None);
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now.saturating_add(patience);
        loop {
            self.exchange();
            while let Some(frame) = self.frames.pop_front() {
                if wanted(&frame) {
                    return Ok(Some(frame));
                }
            }
            if self.now >= end {
                return Ok(None);
            }
            // Without an event, the time passes at once.
            self.advance_to(self.next_event().map_or(end, |next| next.min(end)));
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

/// All futures are ready at the first poll.
impl AsyncCanPort for CanBus {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        CanPort::receive(self, patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}
