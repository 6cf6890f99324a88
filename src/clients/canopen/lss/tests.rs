//! Tests of the LSS master with dropped calls and with answers at fixed times.

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

/// CAN interface that delivers the answers of slaves at fixed times. All times are in milliseconds.
struct Scripted {
    now: u64,
    answers: Vec<(u64, Message)>,
    requests: Vec<(u64, u8)>,
    has_clock: bool,
}

impl Scripted {
    fn new(answers: Vec<(u64, Message)>) -> Self {
        Self { now: 0, answers, requests: Vec::new(), has_clock: true }
    }
}

/// Returns the answer of a slave with this vendor-ID.
const fn inquired(vendor_id: u8) -> Message {
    [0x5A, vendor_id, 0, 0, 0, 0, 0, 0]
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
        self.has_clock.then_some(Duration::from_millis(self.now))
    }
}

#[test]
fn late_answers_of_several_slaves_are_discarded() {
    // The first request ends at 500 ms without an answer. Two slaves answer later, and the answer to the second request
    // arrives at 1010 ms.
    let answers = std::vec![(520, inquired(1)), (990, inquired(2)), (1010, inquired(3))];
    let mut master = LssMaster::new(Scripted::new(answers));
    assert_eq!(master.inquire(IdentityPart::VendorId), Err(LssError::Timeout));
    assert_eq!(master.inquire(IdentityPart::VendorId), Ok(3));
    assert_eq!(master.port().requests, [(0, 0x5A), (1000, 0x5A)]);
}

#[test]
fn answers_after_several_answers_are_discarded() {
    let answers = [(1, 1), (2, 2), (30, 3), (60, 4), (510, 5)].map(|(at, vendor_id)| (at, inquired(vendor_id)));
    let mut master = LssMaster::new(Scripted::new(answers.to_vec()));
    assert_eq!(master.inquire(IdentityPart::VendorId), Err(LssError::SeveralAnswers));
    assert_eq!(master.inquire(IdentityPart::VendorId), Ok(5));
    assert_eq!(master.port().requests, [(0, 0x5A), (502, 0x5A)]);
}

#[test]
fn late_answers_of_a_scan_are_discarded() {
    // The slave answers the start, and each later answer is lost or late.
    let identified = [0x4F, 0, 0, 0, 0, 0, 0, 0];
    let mut master = LssMaster::new(Scripted::new(std::vec![(1, identified), (690, identified)]));
    assert_eq!(master.fast_scan(), Err(LssError::Inconclusive));
    // 34 steps: the start, 32 bits and the confirmation.
    assert_eq!(master.port().now, 34 * 20);
    assert_eq!(master.fast_scan(), Ok(None));
    // After a scan without a slave, no answer is expected.
    let begin = master.port().now;
    assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
    assert_eq!(master.port().now, begin);
}

#[test]
fn a_dropped_scan_leaves_late_answers() {
    let slow = Slow::default();
    let mut master = LssMaster::new(&slow);
    let waker = silent();
    let mut context = Context::from_waker(&waker);
    {
        let mut scan = pin!(master.fast_scan_async());
        for _ in 0..100 {
            assert!(scan.as_mut().poll(&mut context).is_pending());
            slow.now.set(slow.now.get() + Duration::from_millis(1));
        }
    }
    let (begin, sent) = (slow.now.get(), slow.sent.borrow().len());
    let mut next = pin!(master.switch_global_async(LssState::Waiting));
    while next.as_mut().poll(&mut context).is_pending() {
        slow.now.set(slow.now.get() + Duration::from_millis(10));
    }
    assert_eq!(slow.sent.borrow().len(), sent + 1);
    assert!(slow.now.get() - begin >= TIMEOUT);
}

#[test]
fn without_a_clock_answers_do_not_restart_the_timeout() {
    // The slaves answer for 80 s.
    let answers = (0..200).map(|number| (600 + 400 * number, inquired(1))).collect();
    let mut master = LssMaster::new(Scripted { has_clock: false, ..Scripted::new(answers) });
    assert_eq!(master.inquire(IdentityPart::VendorId), Err(LssError::Timeout));
    assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
    let [(0, 0x5A), (second, 0x04)] = master.port().requests[..] else { panic!("{:?}", master.port().requests) };
    assert!((1000..1300).contains(&second), "{second}");
}
