//! Data of the page of a CANopen network: nodes, frames with senders and receivers, bus load, and configured values.

use super::listed::Listed;
use lexibus_codegen::facts::words::{capital, sentence};
use lexibus_codegen::number::{self, hex, hex16, hex8};

/// A CANopen network.
#[derive(Clone, Debug, Default)]
pub struct Network {
    /// Name of the network. Each network of a site must have a unique [page name](super::page_name).
    pub name: String,
    /// Bit rate in bit/s.
    pub bit_rate: u32,
    /// The bus load as text.
    pub summary: String,
    /// All nodes except the master.
    pub nodes: Vec<Node>,
    /// Frames of all senders.
    pub frames: Vec<Frame>,
}

/// A node of a network.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// Name of the node.
    pub name: String,
    /// Node-ID.
    pub id: u8,
    /// Name under which the catalog with the node's device was added to the site.
    pub catalog: String,
    /// Facts about the boot and the error control of the node, as sentences.
    pub facts: Vec<String>,
    /// Values that the master writes to the node, in the order of the writes.
    pub parameters: Vec<Parameter>,
}

/// A value that the master writes to a node.
#[derive(Clone, Debug, Default)]
pub struct Parameter {
    /// Index and sub-index.
    pub object: (u16, u8),
    /// Name of the object.
    pub name: String,
    /// The value as text, with its unit or name.
    pub value: String,
}

/// Frames with one CAN-ID.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Name of the frame, such as `TPDO 1` or `heartbeat`.
    pub name: String,
    /// CAN-ID of 11 or 29 bits, without flags.
    pub can_id: u32,
    /// The sender.
    pub sender: Party,
    /// The receivers. May be empty for frames other than PDOs.
    pub receivers: Vec<Party>,
    /// When the frame is sent, such as `every 10 ms`.
    pub timing: String,
    /// Number of data bytes.
    pub bytes: u32,
    /// Maximum length on the bus in bits, including stuff bits.
    pub bits: u32,
    /// Maximum number of frames per second, or `None` if the rate is unbounded.
    pub rate: Option<f64>,
    /// Names of the mapped objects, in the order of the mapping.
    pub objects: Vec<String>,
}

/// A sender or receiver of a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Party {
    /// The master.
    #[default]
    Master,
    /// A node: its position in [`Network::nodes`], and the index of the mapping object of its PDO, such as 0x1A00. The index is 0
    /// for frames other than PDOs.
    Node(usize, u16),
    /// A sender that is not part of the network.
    Unknown,
}

/// The network, as the templates show it.
#[derive(Debug)]
pub(super) struct Shown {
    pub title: String,
    pub summary: String,
    pub nodes: Vec<ShownNode>,
    pub frames: Vec<ShownFrame>,
}

#[derive(Debug)]
pub(super) struct ShownNode {
    pub anchor: String,
    pub name: String,
    pub id: String,
    pub device: String,
    /// Path of the first page of the device. Empty if the site does not contain the device.
    pub target: String,
    pub facts: String,
    /// Address, name and value of each parameter.
    pub parameters: Vec<(String, String, String)>,
}

#[derive(Debug)]
pub(super) struct ShownFrame {
    pub name: String,
    pub can_id: String,
    pub sender: ShownParty,
    pub receivers: Vec<ShownParty>,
    pub timing: String,
    pub bytes: u32,
    pub rate: String,
    pub load: String,
    pub objects: String,
}

#[derive(Debug)]
pub(super) struct ShownParty {
    pub name: String,
    /// Path and anchor of the PDO, or path of the device's first page. Empty if there is no page.
    pub target: String,
}

impl Shown {
    pub fn new(network: &Network, devices: &[Option<&Listed>]) -> Self {
        let mut frames: Vec<&Frame> = network.frames.iter().collect();
        frames.sort_by_key(|frame| frame.can_id);
        let node = |(node, device): (&Node, &Option<&Listed>)| ShownNode::new(node, *device);
        Shown {
            title: format!("Network {}", network.name),
            summary: sentence(&capital(&network.summary)),
            nodes: network.nodes.iter().zip(devices).map(node).collect(),
            frames: frames.into_iter().map(|frame| ShownFrame::new(frame, network, devices)).collect(),
        }
    }

    /// Returns whether the master writes values to at least one node.
    pub fn has_parameters(&self) -> bool {
        self.nodes.iter().any(|node| !node.parameters.is_empty())
    }
}

impl ShownNode {
    fn new(node: &Node, device: Option<&Listed>) -> Self {
        let parameter = |parameter: &Parameter| {
            let (index, sub_index) = parameter.object;
            (number::object(index, sub_index), parameter.name.clone(), parameter.value.clone())
        };
        ShownNode {
            anchor: format!("node-{}", node.id),
            name: node.name.clone(),
            id: format!("{} ({})", node.id, hex8(node.id)),
            device: device.map(|device| device.title.clone()).unwrap_or_default(),
            target: device.map(|device| device.path_from("..")).unwrap_or_default(),
            facts: node.facts.join(" "),
            parameters: node.parameters.iter().map(parameter).collect(),
        }
    }
}

impl Frame {
    /// Returns the bus load of the frame in bits per second, or `None` if the rate is unbounded.
    fn load(&self) -> Option<f64> {
        Some(self.rate? * f64::from(self.bits))
    }
}

impl ShownFrame {
    fn new(frame: &Frame, network: &Network, devices: &[Option<&Listed>]) -> Self {
        let party = |party: &Party| ShownParty::new(party, network, devices);
        let unlimited = || "unlimited".to_owned();
        ShownFrame {
            name: frame.name.clone(),
            can_id: hex(frame.can_id),
            sender: party(&frame.sender),
            receivers: frame.receivers.iter().map(party).collect(),
            timing: frame.timing.clone(),
            bytes: frame.bytes,
            rate: frame.rate.map_or_else(unlimited, |rate| format!("{rate:.1}")),
            load: frame.load().map_or_else(unlimited, |load| percent(load, network.bit_rate)),
            objects: frame.objects.join(", "),
        }
    }
}

impl ShownParty {
    fn new(party: &Party, network: &Network, devices: &[Option<&Listed>]) -> Self {
        let (at, mapping_index) = match party {
            Party::Master => return ShownParty { name: "master".to_owned(), target: String::new() },
            Party::Unknown => return ShownParty { name: "unknown".to_owned(), target: String::new() },
            Party::Node(at, mapping_index) => (*at, *mapping_index),
        };
        let target = devices[at].map(|device| match device.process_data().filter(|_| mapping_index != 0) {
            Some(page) => format!("../{page}#{}", hex16(mapping_index)),
            None => device.path_from(".."),
        });
        ShownParty { name: network.nodes[at].name.clone(), target: target.unwrap_or_default() }
    }
}

/// Returns a number of bits per second as a percentage of the bit rate.
fn percent(load: f64, bit_rate: u32) -> String {
    format!("{:.1} %", 100.0 * load / f64::from(bit_rate))
}
