//! A simulated node that expects a sequence of SDO requests and answers each of them.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, Node};
use lexibus::NodeId;

/// The requests that the node still expects, with the responses to them.
pub struct Script {
    left: VecDeque<([u8; 8], [u8; 8])>,
    /// True if the next request has been sent but its response has not been read.
    is_asked: bool,
}

impl Script {
    /// Returns whether all expected requests have been sent and answered.
    #[allow(dead_code)]
    pub fn is_done(&self) -> bool {
        self.left.is_empty()
    }
}

impl CanPort for Script {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        let expected = self.left.front().map(|(request, _)| request.as_slice());
        assert_eq!((frame.id(), Some(frame.data())), (0x605, expected));
        self.is_asked = true;
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        if !std::mem::take(&mut self.is_asked) {
            assert!(self.left.is_empty() || patience.is_zero(), "no request was sent");
            return Ok(None);
        }
        let answer = self.left.pop_front().and_then(|(_, answer)| CanFrame::new(0x585, &answer));
        assert!(answer.as_ref().map_or(true, wanted));
        Ok(answer)
    }
}

/// Returns a client of a simulated node 5 that expects these requests.
pub fn node(script: &[([u8; 8], [u8; 8])]) -> Node<Script> {
    let script = Script { left: script.iter().copied().collect(), is_asked: false };
    Node::new(script, NodeId::new(5).expect("a node-ID"))
}
