//! Boots a simulated node for each node of the network. Prints a line for each SDO write that a node receives, with the name of the
//! node, index, sub-index and bytes. Then prints a line with the result of the boot.

#![allow(dead_code)]

mod network;

use std::sync::mpsc;

use lexibus::clients::canopen::Node;
use lexibus::sim::{CanNode, Device};
use lexibus::Entry;
use network::{Axis, Bare, Exact, NetworkNode, Newer, Older, Other};

fn boot<N: NetworkNode<CanNode>>(name: &str, entries: &'static [Entry]) {
    let mut device = Device::new(entries).with_node_id(N::NODE_ID);
    let (sender, receiver) = mpsc::channel();
    device.on_any_write(move |device, entry| {
        let object = entry.object.expect("an object");
        let bytes = device.bytes(object)?.to_vec();
        sender.send((object, bytes)).expect("the receiver exists");
        Ok(())
    });
    let booted = N::on(CanNode::new(device)).boot();
    for (object, bytes) in receiver.try_iter() {
        println!("{name} {} {} {bytes:?}", object.index, object.sub_index);
    }
    println!("{name} {booted:?}");
}

fn main() {
    boot::<Axis<Node<CanNode>>>("axis", network::axis::ENTRIES);
    boot::<Other<Node<CanNode>>>("other", network::other::ENTRIES);
    boot::<Exact<Node<CanNode>>>("exact", network::exact::ENTRIES);
    boot::<Newer<Node<CanNode>>>("newer", network::newer::ENTRIES);
    boot::<Older<Node<CanNode>>>("older", network::older::ENTRIES);
    boot::<Bare<Node<CanNode>>>("bare", network::bare::ENTRIES);
}
