//! Tests of the LSS master with calls that are dropped.

use core::future::Future;
use core::pin::pin;
use core::task::Context;

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
