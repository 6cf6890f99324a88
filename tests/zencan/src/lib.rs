//! A node of `zencan-node` as a CAN port, with a simulated clock.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort};
use zencan_node::common::{messages::CanId, CanMessage, NodeId};
use zencan_node::object_dict::ODEntry;
use zencan_node::{Callbacks, Node, NodeMbox, NodeState};

/// Time between two calls of the node's `process`.
const STEP: Duration = Duration::from_millis(1);

/// A node with the object dictionary that `zencan-build` generated, as the only node on a bus.
pub struct Zencan {
    node: Node<'static>,
    mailbox: &'static NodeMbox,
    now: Duration,
    sent: VecDeque<CanFrame>,
    /// Number of requests that the node has received, by command specifier of CiA 301 (bits 5 to 7).
    pub requests: [usize; 8],
}

impl Zencan {
    /// Creates a node with a node-ID, or without one if `id` is 255.
    pub fn new(
        id: u8,
        mailbox: &'static NodeMbox,
        state: &'static NodeState<'static>,
        objects: &'static [ODEntry<'static>],
    ) -> Self {
        let id = NodeId::new(id).expect("a node-ID");
        let node = Node::new(id, Callbacks::new(), mailbox, state, objects);
        let mut bus = Self { node, mailbox, now: Duration::ZERO, sent: VecDeque::new(), requests: [0; 8] };
        bus.process();
        bus
    }

    fn process(&mut self) {
        self.node.process(self.now.as_micros() as u64);
        while let Some(message) = self.mailbox.next_transmit_message() {
            let CanId::Std(id) = message.id() else { panic!("an identifier of 11 bits") };
            self.sent.extend(CanFrame::new(id.into(), message.data()).map(|frame| frame.at(Some(self.now))));
        }
    }
}

impl CanPort for Zencan {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        if frame.id() & !0x7F == 0x600 {
            self.requests[usize::from(frame.data()[0] >> 5)] += 1;
        }
        let id = CanId::Std(u16::try_from(frame.id()).expect("an identifier of 11 bits"));
        // `store_message` returns messages that the node doesn't use.
        let _ = self.mailbox.store_message(CanMessage::new(id, frame.data()));
        self.process();
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now + patience;
        loop {
            self.process();
            while let Some(frame) = self.sent.pop_front() {
                if wanted(&frame) {
                    return Ok(Some(frame));
                }
            }
            if self.now >= end {
                return Ok(None);
            }
            self.now = end.min(self.now + STEP);
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}
