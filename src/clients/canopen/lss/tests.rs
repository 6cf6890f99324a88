//! Tests of the LSS master with calls that are dropped.

use core::future::Future;
use core::pin::pin;
use core::task::Context;
use std::vec::Vec;

use super::*;
use crate::clients::canopen::slow::{silent, Slow};

#[test]
fn a_node_id_of_a_dropped_call_is_removed() {
    let slow = Slow::default();
    let mut master = LssMaster::new(&slow);
    let waker = silent();
    let mut context = Context::from_waker(&waker);
    {
        let call = pin!(master.configure_node_id_async(NodeId::new(5).expect("a node-ID")));
        assert!(call.poll(&mut context).is_pending());
    }
    let mut next = pin!(master.switch_global_async(LssState::Waiting));
    let mut steps = 0..1000;
    while next.as_mut().poll(&mut context).is_pending() && steps.next().is_some() {
        slow.now.set(slow.now.get() + Duration::from_millis(10));
    }
    let sent = slow.sent.borrow();
    let messages: std::vec::Vec<_> = sent.iter().map(|(_, frame)| [frame.data()[0], frame.data()[1]]).collect();
    assert_eq!(messages, [[0x11, 5], [0x11, 0xFF], [4, 0]]);
}

/// An interface on which answers of slaves arrive at fixed times in milliseconds.
struct Scripted {
    now: u64,
    answers: Vec<(u64, Message)>,
    requests: Vec<(u64, u8)>,
}

impl CanPort for Scripted {
    type Error = ();

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, ()> {
        self.requests.push((self.now, frame.data()[0]));
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, ()> {
        let end = self.now + patience.as_millis() as u64;
        while self.answers.first().is_some_and(|(at, _)| *at <= end) {
            let (at, message) = self.answers.remove(0);
            self.now = self.now.max(at);
            let frame = CanFrame::of(ANSWERS, message);
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
        self.now = end;
        Ok(None)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(Duration::from_millis(self.now))
    }
}

#[test]
fn late_answers_of_several_slaves_are_discarded() {
    let inquired = |vendor_id: u8| [0x5A, vendor_id, 0, 0, 0, 0, 0, 0];
    // The first request ends at 500 ms without an answer. Two slaves answer later, and the answer to the second request
    // arrives at 1010 ms.
    let answers = std::vec![(520, inquired(1)), (990, inquired(2)), (1010, inquired(3))];
    let mut master = LssMaster::new(Scripted { now: 0, answers, requests: Vec::new() });
    assert_eq!(master.inquire(IdentityPart::VendorId), Err(LssError::Timeout));
    assert_eq!(master.inquire(IdentityPart::VendorId), Ok(3));
    assert_eq!(master.port().requests, [(0, 0x5A), (1000, 0x5A)]);
}
