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

impl Network {
    pub(super) fn title(&self) -> String {
        format!("Network {}", self.name)
    }

    pub(super) fn summary(&self) -> String {
        sentence(&capital(&self.summary))
    }

    /// Returns the frames, sorted by CAN-ID.
    pub(super) fn sorted(&self) -> Vec<&Frame> {
        let mut frames: Vec<&Frame> = self.frames.iter().collect();
        frames.sort_by_key(|frame| frame.can_id);
        frames
    }

    /// Returns the name of a sender or receiver.
    pub(super) fn party(&self, party: &Party) -> &str {
        match party {
            Party::Master => "master",
            Party::Unknown => "unknown",
            Party::Node(at, _) => &self.nodes[*at].name,
        }
    }

    /// Returns whether the master writes values to at least one node.
    pub(super) fn has_parameters(&self) -> bool {
        self.nodes.iter().any(|node| !node.parameters.is_empty())
    }
}

impl Node {
    pub(super) fn number(&self) -> String {
        format!("{} ({})", self.id, hex8(self.id))
    }
}

impl Parameter {
    pub(super) fn number(&self) -> String {
        number::object(self.object.0, self.object.1)
    }
}

impl Frame {
    pub(super) fn number(&self) -> String {
        hex(self.can_id)
    }

    /// Returns the number of frames per second.
    pub(super) fn shown_rate(&self) -> String {
        self.rate.map_or_else(|| UNLIMITED.to_owned(), |rate| format!("{rate:.1}"))
    }

    /// Returns the bus load of the frame as a percentage of the bit rate.
    pub(super) fn load(&self, network: &Network) -> String {
        let percent =
            |rate: f64| format!("{:.1} %", 100.0 * (rate * f64::from(self.bits)) / f64::from(network.bit_rate));
        self.rate.map_or_else(|| UNLIMITED.to_owned(), percent)
    }
}

const UNLIMITED: &str = "unlimited";

impl Party {
    /// Returns the path and anchor of the PDO, or the path of the device's first page, if there is such a page.
    pub(super) fn target(&self, devices: &[Option<&Listed>]) -> Option<String> {
        let Party::Node(at, mapping_index) = self else { return None };
        let device = devices[*at]?;
        Some(match device.process_data().filter(|_| *mapping_index != 0) {
            Some(page) => format!("../{page}#{}", hex16(*mapping_index)),
            None => device.path_from(".."),
        })
    }
}
