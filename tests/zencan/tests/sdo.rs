//! Tests SDO transfers between the client and the server of `zencan-node`.

use std::time::Duration;

use lexibus::clients::canopen::{NmtCommand, NmtState, Node};
use lexibus::{AbortCode, Client, Error, NodeId, Object};
use lexibus_zencan::Zencan;

mod blocks {
    zencan_node::include_modules!(BLOCKS);
}
mod refusals {
    zencan_node::include_modules!(REFUSALS);
}

const SPEED: Object = Object::new(0x2000, 0);
const FIRMWARE: Object = Object::new(0x2001, 0);
const TEMPERATURE: Object = Object::new(0x2002, 0);
const AXIS: Object = Object::new(0x2003, 0);

/// Command specifiers of block transfers (CiA 301 7.2.4.3): bits 5 to 7 of the request.
const BLOCK_UPLOAD: usize = 5;
const BLOCK_DOWNLOAD: usize = 6;

fn id() -> NodeId {
    NodeId::new(5).expect("a node-ID")
}

#[test]
fn values_of_all_lengths() {
    // The node has a buffer of 889 bytes for block transfers, which is less than the default threshold of the client.
    let mut node = Node::new(Zencan::new(5, &blocks::NODE_MBOX, &blocks::NODE_STATE, &blocks::OD_TABLE), id())
        .with_block_threshold(500);
    node.write(SPEED, &(-100_000_i32).to_le_bytes()).expect("an expedited transfer");
    let mut buffer = [0; 1000];
    assert_eq!(node.read(SPEED, &mut buffer), Ok(4));
    assert_eq!(buffer[..4], (-100_000_i32).to_le_bytes());
    assert_eq!(node.port().requests[BLOCK_DOWNLOAD], 0);

    let name = "the name of an axis, in segments";
    node.write(AXIS, name.as_bytes()).expect("a segmented transfer");
    let length = node.read(AXIS, &mut buffer).expect("a segmented transfer");
    assert_eq!(&buffer[..length], name.as_bytes());

    let firmware: [u8; 850] = std::array::from_fn(|at| (at * 7 + at / 256) as u8);
    node.write(FIRMWARE, &firmware).expect("a block transfer");
    assert!(blocks::OBJECT2001.get_value() == firmware, "the node has the value");
    assert!(node.port().requests[BLOCK_DOWNLOAD] >= 2, "the value is sent in blocks");
    let mut reversed = firmware;
    reversed.reverse();
    blocks::OBJECT2001.set_value(reversed);
    assert_eq!(node.read(FIRMWARE, &mut buffer), Ok(850));
    assert!(buffer[..850] == reversed, "the client has the value");
    assert!(node.port().requests[BLOCK_UPLOAD] >= 3, "the value is received in blocks");
}

#[test]
fn refusals_and_states() {
    let mut node = Node::new(Zencan::new(5, &refusals::NODE_MBOX, &refusals::NODE_STATE, &refusals::OD_TABLE), id());
    assert_eq!(node.write(TEMPERATURE, &[0; 2]), Err(Error::Abort(AbortCode::READ_ONLY)));
    assert_eq!(node.write(Object::new(0x5FFF, 0), &[0; 2]), Err(Error::Abort(AbortCode::NO_OBJECT)));
    assert_eq!(node.read(Object::new(0x2000, 3), &mut [0; 4]), Err(Error::Abort(AbortCode::NO_SUB_INDEX)));
    assert!(matches!(node.write(FIRMWARE, &[0; 900]), Err(Error::Abort(_))), "the value is too long");
    assert_eq!(node.write(SPEED, &[1, 0, 0, 0]), Ok(()), "the next transfer is clean");
    for (command, state) in
        [(NmtCommand::Start, NmtState::Operational), (NmtCommand::EnterPreOperational, NmtState::PreOperational)]
    {
        node.nmt(command).expect("a bus");
        node.wait_for(state, Duration::from_secs(1)).expect("the state");
    }
}
