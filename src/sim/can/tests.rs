use super::*;

use crate::bus::Object;
use crate::client::Client;
use crate::clients::canopen::{CanPort, Channel, Node};
use crate::data_type::DataType;
use crate::error::Error;
use crate::flags::Flags;
use crate::node_id::NodeId;
use crate::table::{AccessRights, Bound, Entry, RawInitial};

pub(super) const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};

const fn entry(index: u16, sub_index: u8, data_type: DataType, initial: &'static [u8]) -> Entry {
    Entry {
        object: Some(Object::new(index, sub_index)),
        register: None,
        name: "",
        data_type,
        access: AccessRights::ReadWrite,
        flags: Flags::PDO,
        initial: RawInitial::Bytes(initial),
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

const U8: DataType = DataType::Unsigned8;
const U16: DataType = DataType::Unsigned16;
const U32: DataType = DataType::Unsigned32;

/// Creates a node with an RPDO (COB-ID 0x205) and a TPDO (COB-ID 0x185), which both map object 0x2000.
pub(super) fn node() -> CanNode {
    let entries = [
        entry(0x1001, 0, U8, &[0]),
        entry(0x100C, 0, U16, &[0, 0]),
        entry(0x100D, 0, U8, &[0]),
        entry(0x1012, 0, U32, &[0, 1, 0, 0]),
        entry(0x1014, 0, U32, &[0x85, 0, 0, 0]),
        entry(0x1017, 0, U16, &[0]),
        entry(0x1201, 1, U32, &[0x80, 6, 0, 0]),
        entry(0x1201, 2, U32, &[0x81, 6, 0, 0]),
        entry(0x1400, 1, U32, &[5, 2, 0, 0]),
        entry(0x1400, 2, U8, &[255]),
        entry(0x1600, 0, U8, &[1]),
        entry(0x1600, 1, U32, &[16, 0, 0, 0x20]),
        entry(0x1800, 1, U32, &[0x85, 1, 0, 0]),
        entry(0x1800, 2, U8, &[255]),
        entry(0x1800, 3, U16, &[0]),
        entry(0x1800, 5, U16, &[0]),
        entry(0x1A00, 0, U8, &[1]),
        entry(0x1A00, 1, U32, &[16, 0, 0, 0x20]),
        entry(0x2000, 0, U16, &[]),
        entry(0x2001, 0, DataType::Domain, &[]),
    ];
    CanNode::new(Device::new(&entries).with_node_id(NODE))
}

pub(super) fn set(node: &mut CanNode, index: u16, sub_index: u8, bytes: &[u8]) {
    node.device().set_bytes(Object::new(index, sub_index), bytes).unwrap();
}

pub(super) fn send(node: &mut CanNode, id: u32, data: &[u8]) {
    node.handle(&CanFrame::new(id, data).unwrap());
}

fn receive(node: &mut CanNode, id: u32, patience: Duration) -> Option<CanFrame> {
    CanPort::receive(node, patience, &mut |frame| frame.id() == id).unwrap()
}

/// Returns all frames that the node has sent.
pub(super) fn frames(node: &mut CanNode) -> Vec<(u32, Vec<u8>)> {
    core::iter::from_fn(|| node.next_frame()).map(|frame| (frame.id(), frame.data().to_vec())).collect()
}

/// Creates a node in Operational that has sent its first PDO.
fn started() -> CanNode {
    let mut node = node();
    send(&mut node, 0, &[1, 0]);
    frames(&mut node);
    node
}

#[test]
fn network_management() {
    let mut node = node();
    assert_eq!(frames(&mut node), [(0x705, [0].to_vec())]);
    send(&mut node, 0, &[1, 6]);
    assert_eq!(node.state(), NmtState::PreOperational);
    send(&mut node, 0, &[1, 5]);
    assert_eq!(node.state(), NmtState::Operational);
    assert_eq!(frames(&mut node), [(0x185, [0, 0].to_vec())]);
    send(&mut node, 0, &[2, 0]);
    // A stopped node doesn't reply to SDO requests.
    send(&mut node, 0x605, &[0x40, 0, 0x20, 0, 0, 0, 0, 0]);
    send(&mut node, 0x205, &[1, 0]);
    assert_eq!((node.state(), frames(&mut node)), (NmtState::Stopped, std::vec![]));
    set(&mut node, 0x2000, 0, &[9, 9]);
    set(&mut node, 0x1017, 0, &[9, 9]);
    send(&mut node, 0, &[130, 5]);
    assert_eq!(frames(&mut node), [(0x705, [0].to_vec())]);
    assert_eq!(node.device().slots.number(0x1017, 0), Some(0));
    assert_eq!(node.device().slots.number(0x2000, 0), Some(0x909));
    send(&mut node, 0, &[129, 5]);
    assert_eq!(node.device().slots.number(0x2000, 0), Some(0));
    assert_eq!(node.state(), NmtState::PreOperational);
}

#[test]
fn heartbeat() {
    let mut node = started();
    set(&mut node, 0x1017, 0, &[100, 0]);
    node.advance(Duration::from_millis(250));
    assert_eq!(frames(&mut node), [(0x705, [5].to_vec()), (0x705, [5].to_vec())]);
    send(&mut node, 0, &[2, 5]);
    let next = receive(&mut node, 0x705, Duration::from_millis(60));
    assert_eq!((next.map(|frame| frame.data()[0]), node.now()), (Some(4), Duration::from_millis(300)));
    assert_eq!(receive(&mut node, 0x705, Duration::from_millis(60)), None);
    assert_eq!(node.now(), Duration::from_millis(360));
    set(&mut node, 0x1017, 0, &[0, 0]);
    node.advance(Duration::from_secs(9));
    assert_eq!(frames(&mut node), []);
}

#[test]
fn pdos_on_change_and_by_timer() {
    let mut node = started();
    send(&mut node, 0x205, &[1, 2]);
    assert_eq!(frames(&mut node), [(0x185, [1, 2].to_vec())]);
    send(&mut node, 0x205, &[1, 2]);
    assert_eq!(frames(&mut node), []);
    set(&mut node, 0x2000, 0, &[3, 0]);
    assert_eq!(frames(&mut node), [(0x185, [3, 0].to_vec())]);
    // The inhibit time is 10 ms, and the event timer is 50 ms.
    set(&mut node, 0x1800, 3, &[100, 0]);
    set(&mut node, 0x1800, 5, &[50, 0]);
    set(&mut node, 0x2000, 0, &[4, 0]);
    assert_eq!(frames(&mut node), []);
    let sent = receive(&mut node, 0x185, Duration::from_secs(1));
    assert_eq!((sent.map(|frame| frame.data()[0]), node.now()), (Some(4), Duration::from_millis(10)));
    node.advance(Duration::from_millis(120));
    assert_eq!(frames(&mut node).len(), 2);
    // PDOs are exchanged only in Operational.
    send(&mut node, 0, &[128, 0]);
    node.advance(Duration::from_millis(120));
    send(&mut node, 0x205, &[7, 7]);
    assert_eq!(frames(&mut node), []);
    assert_eq!(node.device().slots.number(0x2000, 0), Some(4));
}

#[test]
fn pdos_on_sync() {
    let mut node = started();
    set(&mut node, 0x1400, 2, &[1]);
    set(&mut node, 0x1800, 2, &[2]);
    send(&mut node, 0x205, &[1, 0]);
    assert_eq!(node.device().slots.number(0x2000, 0), Some(0));
    send(&mut node, 0x80, &[]);
    assert_eq!((node.device().slots.number(0x2000, 0), frames(&mut node)), (Some(1), std::vec![]));
    send(&mut node, 0x80, &[]);
    assert_eq!(frames(&mut node), [(0x185, [1, 0].to_vec())]);
    set(&mut node, 0x1800, 2, &[0]);
    send(&mut node, 0x80, &[]);
    assert_eq!(frames(&mut node), []);
    send(&mut node, 0x205, &[2, 0]);
    send(&mut node, 0x80, &[]);
    assert_eq!(frames(&mut node), [(0x185, [2, 0].to_vec())]);
}

#[test]
fn emergencies() {
    let mut node = started();
    send(&mut node, 0x205, &[1]);
    assert_eq!(frames(&mut node), [(0x85, [0x10, 0x82, 0x11, 0, 0, 0, 0, 0].to_vec())]);
    assert_eq!(node.take_refused(), [(0x1600, AbortCode::TOO_SHORT)]);
    send(&mut node, 0x205, &[1, 0, 0]);
    let expected = [(0x85, [0x20, 0x82, 0x11, 0, 0, 0, 0, 0].to_vec()), (0x185, [1, 0].to_vec())];
    assert_eq!((frames(&mut node), node.take_refused()), (expected.to_vec(), std::vec![]));
    send(&mut node, 0, &[2, 0]);
    node.device().emit_emergency(0x2310, 3, [1, 2, 3, 4, 5]);
    assert_eq!(frames(&mut node), []);
    send(&mut node, 0, &[128, 0]);
    assert_eq!(frames(&mut node), [(0x85, [0x10, 0x23, 3, 1, 2, 3, 4, 5].to_vec())]);
    set(&mut node, 0x1014, 0, &[0x85, 0, 0, 0x80]);
    node.device().emit_emergency(0, 0, [0; 5]);
    assert_eq!(frames(&mut node), []);
}

#[test]
fn transfers() {
    let mut client = Node::new(node(), NODE);
    let (number, domain) = (Object::new(0x2000, 0), Object::new(0x2001, 0));
    let long: Vec<u8> = (0..=255).cycle().take(5000).collect();
    assert_eq!(client.write(number, &[1, 2]), Ok(()));
    assert_eq!(client.write(domain, &long), Ok(()));
    let mut buffer = std::vec![0; 6000];
    assert_eq!(client.read(domain, &mut buffer), Ok(5000));
    assert_eq!(buffer[..5000], long);
    assert_eq!(client.write(number, &[1]), Err(Error::Abort(AbortCode::TOO_SHORT)));
    assert_eq!(client.read(Object::new(0x2005, 0), &mut buffer), Err(Error::Abort(AbortCode::NO_OBJECT)));
    // An expedited download that doesn't indicate its size.
    send(client.port(), 0x605, &[0x22, 0x00, 0x20, 0, 7, 0, 0xFF, 0xFF]);
    assert_eq!(frames(client.port()).last(), Some(&(0x585, [0x60, 0, 0x20, 0, 0, 0, 0, 0].to_vec())));
    assert_eq!(client.port().device().slots.number(0x2000, 0), Some(7));
}

#[test]
fn block_transfers() {
    let (domain, mut buffer) = (Object::new(0x2001, 0), std::vec![0; 6000]);
    let long: Vec<u8> = (0..=250).cycle().take(5000).collect();
    for (has_blocks, threshold) in [(true, 1024), (false, usize::MAX)] {
        let mut client = Node::new(node(), NODE);
        client.port().allow_blocks(has_blocks);
        assert_eq!(client.write(domain, &long), Ok(()));
        assert_eq!(client.read(domain, &mut buffer), Ok(5000));
        assert_eq!((client.block_threshold(), &buffer[..5000]), (threshold, &long[..]));
        // The first segment of a block download, and a block upload without an end.
        let node = client.port();
        frames(node);
        send(node, 0x605, &[0xC6, 1, 0x20, 0, 14, 0, 0, 0]);
        send(node, 0x605, &[1, 1, 2, 3, 4, 5, 6, 7]);
        node.advance(Duration::from_secs(2));
        let abort: &[u8] = if has_blocks { &[0x80, 1, 0x20, 0, 0, 0, 4, 5] } else { &[0x80, 0, 0, 0, 1, 0, 4, 5] };
        assert_eq!(frames(node).last(), Some(&(0x585, abort.to_vec())));
        send(node, 0x605, &[0xA4, 1, 0x20, 0, 100, 0, 0, 0]);
        send(node, 0x605, &[0xA3, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(frames(node).len(), if has_blocks { 101 } else { 2 });
    }
}

#[test]
fn further_channels() {
    let channel = Channel::new(0x680, 0x681).unwrap();
    let mut client = Node::new(node(), NODE).with_channel(channel);
    let (object, mut buffer) = (Object::new(0x2000, 0), [0; 2]);
    assert_eq!(client.write(object, &[1, 2]), Ok(()));
    assert_eq!((client.read(object, &mut buffer), buffer), (Ok(2), [1, 2]));
    // The channels have separate transfers.
    let node = client.port();
    frames(node);
    send(node, 0x605, &[0x21, 0x01, 0x20, 0, 9, 0, 0, 0]);
    send(node, 0x680, &[0x40, 0x00, 0x20, 0, 0, 0, 0, 0]);
    send(node, 0x605, &[0x00, 1, 2, 3, 4, 5, 6, 7]);
    let expected = [
        (0x585, [0x60, 1, 0x20, 0, 0, 0, 0, 0]),
        (0x681, [0x4B, 0, 0x20, 0, 1, 2, 0, 0]),
        (0x585, [0x20, 0, 0, 0, 0, 0, 0, 0]),
    ];
    assert_eq!(frames(node), expected.map(|(id, data)| (id, data.to_vec())));
    // Bit 31 disables the channel.
    set(node, 0x1201, 1, &[0x80, 6, 0, 0x80]);
    assert_eq!(client.read(object, &mut buffer), Err(Error::Timeout));
}

#[test]
fn lost_answers_and_given_up_transfers() {
    let mut client = Node::new(node(), NODE);
    let (object, mut buffer) = (Object::new(0x2000, 0), [0; 2]);
    client.port().device().fail_next(crate::sim::Fault::Bus);
    assert_eq!(client.read(object, &mut buffer), Err(Error::Timeout));
    client.port().device().fail_next(AbortCode::DEVICE_STATE);
    assert_eq!(client.read(object, &mut buffer), Err(Error::Abort(AbortCode::DEVICE_STATE)));
    client.port().set_connected(false);
    assert_eq!(client.read(object, &mut buffer), Err(Error::Timeout));
    client.port().set_connected(true);
    assert_eq!(client.read(object, &mut buffer), Ok(2));
    // A download that ends after its first message.
    let node = client.port();
    frames(node);
    send(node, 0x605, &[0x21, 0x01, 0x20, 0, 9, 0, 0, 0]);
    node.advance(Duration::from_secs(2));
    let expected = [(0x585, [0x60, 1, 0x20, 0, 0, 0, 0, 0]), (0x585, [0x80, 1, 0x20, 0, 0, 0, 4, 5])];
    assert_eq!(frames(node), expected.map(|(id, data)| (id, data.to_vec())));
}
