//! A node that expects requests by SDO, one after the other, and has an answer to each.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, Node};
use lexibus::NodeId;

/// The requests that are still to come, with their answers.
pub struct Script(VecDeque<([u8; 8], [u8; 8])>);

impl CanPort for Script {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        let expected = self.0.front().map(|(request, _)| request.as_slice());
        assert_eq!((frame.id(), Some(frame.data())), (0x605, expected));
        Ok(true)
    }

    fn receive(
        &mut self,
        _: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let answer = self.0.pop_front().and_then(|(_, answer)| CanFrame::new(0x585, &answer));
        assert!(answer.as_ref().map_or(true, wanted));
        Ok(answer)
    }
}

/// Node 5, which expects these requests.
pub fn node(script: &[([u8; 8], [u8; 8])]) -> Node<Script> {
    Node::new(Script(script.iter().copied().collect()), NodeId::new(5).expect("a node-ID"))
}
