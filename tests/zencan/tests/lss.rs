//! Tests the LSS master with a slave of `zencan-node`.

use std::time::Duration;

use lexibus::clients::canopen::{LssMaster, Node};
use lexibus::lss::{LssAddress, LssState};
use lexibus::{Client, NodeId, Object};
use lexibus_zencan::Zencan;

mod node {
    zencan_node::include_modules!(LSS);
}

#[test]
fn a_node_without_node_id() {
    node::OBJECT1018.set_serial(0x8000_1234);
    let address = LssAddress::from_array([0xCAFE, 0x8000_0001, 0x1_0002, 0x8000_1234]);
    let id = NodeId::new(9).expect("a node-ID");
    let bus = Zencan::new(255, &node::NODE_MBOX, &node::NODE_STATE, &node::OD_TABLE);
    let mut master = LssMaster::new(bus);
    assert_eq!(master.fast_scan(), Ok(Some(address)));
    assert_eq!(master.inquire_address(), Ok(address));
    assert_eq!(master.inquire_node_id(), Ok(None));
    assert_eq!(master.configure_node_id(id), Ok(()));
    assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
    assert_eq!(master.fast_scan(), Ok(None), "the node has a node-ID");
    assert_eq!(master.switch_selective(address), Ok(()));
    assert_eq!(master.inquire_node_id(), Ok(Some(id)));
    assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
    let mut node = Node::new(master.into_port(), id).with_timeout(Duration::from_secs(1));
    let mut serial = [0; 4];
    assert_eq!(node.read(Object::new(0x1018, 4), &mut serial), Ok(4));
    assert_eq!(serial, 0x8000_1234_u32.to_le_bytes());
}
