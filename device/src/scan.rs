//! Search for the nodes of a CANopen bus.

use std::collections::BTreeSet;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, NmtState, Node};
use lexibus::{Client, NodeId, Object};
use serde::Serialize;

use crate::description::Description;
use crate::failure::Failure;
use crate::monitor::state_name;

/// A node of the bus.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FoundNode {
    /// Node-ID.
    pub node_id: u8,
    /// NMT state in the last heartbeat or boot-up message that arrived before the identities were read, if there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// Device type (object 0x1000).
    pub device_type: Option<u32>,
    /// Vendor ID (object 0x1018, sub-index 1).
    pub vendor_id: Option<u32>,
    /// Product code (object 0x1018, sub-index 2).
    pub product_code: Option<u32>,
    /// Revision number (object 0x1018, sub-index 3).
    pub revision_number: Option<u32>,
    /// Serial number (object 0x1018, sub-index 4).
    pub serial_number: Option<u32>,
    /// Manufacturer device name (object 0x1008).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
}

/// The numbers of the identity in which a node and a description agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fit {
    /// Vendor ID and product code are equal. The revision number is different or unknown.
    Product,
    /// Vendor ID, product code and revision number are equal.
    Revision,
}

impl FoundNode {
    /// Returns how well a description fits the node, or `None` if the vendor ID or the product code is different or
    /// unknown.
    #[must_use]
    pub fn fit(&self, description: &Description) -> Option<Fit> {
        let identity = &description.device().identity;
        let is_product = self.vendor_id.is_some()
            && identity.vendor_id == self.vendor_id
            && identity.product_code.is_some()
            && identity.product_code == self.product_code;
        let is_revision = identity.revision_number.is_some() && identity.revision_number == self.revision_number;
        is_product.then_some(if is_revision { Fit::Revision } else { Fit::Product })
    }
}

/// Searches for the nodes of a bus, and reads their identity.
///
/// The search requests the device type (object 0x1000) from each node-ID with one SDO upload, and sends nothing else to
/// node-IDs that don't reply. `timeout` is the time to wait for replies after the last of these requests, and the
/// maximum time for each later reply.
///
/// # Errors
///
/// Fails if the bus fails during these requests, or if one of them cannot be sent within `timeout`. A failure while an
/// identity is read doesn't end the search.
pub fn scan<P>(port: &mut P, timeout: Duration) -> Result<Vec<FoundNode>, Failure>
where
    P: CanPort,
    P::Error: std::fmt::Display,
{
    let mut states = Vec::new();
    let nodes = replies(port, timeout, &mut states)?;
    let mut found = Vec::new();
    for node_id in nodes {
        let Some(id) = NodeId::new(node_id) else { continue };
        let mut node = Node::new(&mut *port, id).with_timeout(timeout);
        let state = states.iter().rev().find(|(of, _)| *of == id).map(|(_, state)| state_name(*state));
        found.push(FoundNode { node_id, state, ..identity(&mut node) });
    }
    Ok(found)
}

/// Requests the device type from all node-IDs. Returns the node-IDs that replied.
fn replies<P>(port: &mut P, timeout: Duration, states: &mut Vec<(NodeId, NmtState)>) -> Result<BTreeSet<u8>, Failure>
where
    P: CanPort,
    P::Error: std::fmt::Display,
{
    /// COB-IDs of SDO requests and SDO replies without the node-ID (CiA 301 7.3.3).
    const REQUESTS: u32 = 0x600;
    const REPLIES: u32 = 0x580;
    /// Upload request for object 0x1000.
    const DEVICE_TYPE: [u8; 8] = [0x40, 0, 0x10, 0, 0, 0, 0, 0];
    /// Time between two requests, so that the replies don't overflow small receive buffers.
    const PAUSE: Duration = Duration::from_millis(1);
    let mut nodes = BTreeSet::new();
    let mut note = |frame: &CanFrame| {
        states.extend(NmtState::of(frame));
        let node = frame.id().checked_sub(REPLIES).filter(|node| (1..=0x7F).contains(node));
        // A reply with the value and an SDO abort both contain the index and sub-index.
        let is_reply = matches!(frame.data(), [_, 0, 0x10, 0, ..]);
        nodes.extend(node.filter(|_| is_reply).map(|node| node as u8));
        // All frames are skipped, so `receive` waits for the whole time.
        false
    };
    for node in 1..=0x7F {
        let Some(request) = CanFrame::new(REQUESTS + node, &DEVICE_TYPE) else { continue };
        if !port.send(&request, timeout).map_err(bus)? {
            return Err(Failure::Bus(
                "cannot send a frame, because the bus is busy or no node acknowledges frames".to_owned(),
            ));
        }
        port.receive(PAUSE, &mut note).map_err(bus)?;
    }
    port.receive(timeout, &mut note).map_err(bus)?;
    Ok(nodes)
}

fn bus(error: impl std::fmt::Display) -> Failure {
    Failure::Bus(error.to_string())
}

/// Reads the identity of a node. A value is `None` if it cannot be read, if a number doesn't have 4 bytes, or if the name is
/// empty.
fn identity<P>(node: &mut Node<P>) -> FoundNode
where
    P: CanPort,
    P::Error: std::fmt::Display,
{
    let mut number = |index: u16, sub_index: u8| {
        let mut bytes = [0; 4];
        let length = node.read(Object::new(index, sub_index), &mut bytes).ok()?;
        (length == 4).then(|| u32::from_le_bytes(bytes))
    };
    let device_type = number(0x1000, 0);
    let [vendor_id, product_code, revision_number, serial_number] = [1, 2, 3, 4].map(|sub| number(0x1018, sub));
    let mut text = [0; 256];
    let length = node.read(Object::new(0x1008, 0), &mut text).ok();
    let name = length.and_then(|length| text.get(..length)).map(|text| String::from_utf8_lossy(text).into_owned());
    let name = name.map(|name| name.trim_end_matches('\0').to_owned()).filter(|name| !name.is_empty());
    FoundNode { device_type, vendor_id, product_code, revision_number, serial_number, name, ..FoundNode::default() }
}
