//! Tests of async handles that use one interface in turn.

use core::time::Duration;

use super::tests::{frame, id, PDO};
use super::Network;
use crate::clients::canopen::slow::{beside, Slow};
use crate::clients::canopen::{NmtCommand, Node};

#[test]
fn a_handle_that_waits_doesnt_block_another_handle_of_its_node() {
    let hour = Duration::from_secs(3600);
    for other in [1, 2] {
        let slow = Slow::default();
        let network = Network::<_, 8>::new(&slow);
        let mut one = Node::new(network.node(id(1)), id(1));
        let network = &network;
        // The second handle is created while the first one already waits.
        let stop = async move { Node::new(network.node(id(other)), id(other)).nmt_async(NmtCommand::Stop).await };
        assert_eq!(beside(&slow, one.emergency_async(hour), stop), Some(Ok(())));
    }
}

#[test]
fn a_handle_that_sends_doesnt_block_another_handle() {
    let (slow, hour) = (Slow::default(), Duration::from_secs(3600));
    slow.is_busy.set(true);
    let network = Network::<_, 8>::new(&slow);
    let mut one = Node::new(network.node(id(1)), id(1)).with_timeout(hour);
    let mut two = Node::new(network.node(id(2)), id(2));
    assert_eq!(beside(&slow, one.sync_async(), two.nmt_async(NmtCommand::Stop)), Some(Ok(())));
}

#[test]
fn frames_are_received_without_patience_while_another_handle_waits() {
    let (slow, hour) = (Slow::default(), Duration::from_secs(3600));
    let network = Network::<_, 8>::new(&slow);
    let mut one = Node::new(network.node(id(1)), id(1));
    let mut two = Node::new(network.node(id(2)), id(2));
    let short = async {
        slow.received.borrow_mut().push_back(frame(0x182, &[7]));
        two.latest_pdo_async(PDO).await
    };
    assert_eq!(beside(&slow, one.emergency_async(hour), short), Some(Ok(Some(frame(0x182, &[7])))));
}
