//! Devices that a command accesses, and nodes that it watches.

use std::path::Path;
use std::time::Duration;

use lexibus_device::{BusAddress, Connection, Description, Network};

use super::files;
use super::network::{NetworkFile, Values, DEFAULT};
use crate::args::{Target, WatchedNode, WatchedNodes};
use crate::Failure;

/// A device with its description and its bus.
pub(super) struct Device {
    pub bus: BusAddress,
    pub node: u8,
    pub description: Description,
    timeout: Duration,
}

impl Device {
    /// Returns the device of a target. If the target is a node of a network file, `values` selects the values in its
    /// description. Otherwise, the description has the values of the description file.
    pub(super) fn of(target: &Target, values: Values) -> Result<Self, Failure> {
        let timeout = Duration::from_millis(target.timeout.into());
        if let Some(node) = target.node {
            let bus = target.bus.clone().ok_or_else(no_bus)?;
            let description = files::description(&target.file_or_node, &target.options, bus.network())?;
            return Ok(Self { bus, node, description, timeout });
        }
        let network = network_file(target)?;
        let (node, description) = network.node(&target.file_or_node.to_string_lossy(), values)?;
        Ok(Self { bus: network.bus(target.bus.as_ref())?, node, description, timeout })
    }

    /// Connects to the device.
    pub(super) fn connect(&self) -> Result<Box<dyn Connection>, Failure> {
        Ok(self.bus.connect(&self.description, self.node, self.timeout)?)
    }
}

fn no_bus() -> Failure {
    Failure::Usage("add the bus, such as --bus can:can0".to_owned())
}

/// Opens the network file that contains the node of a target.
fn network_file(target: &Target) -> Result<NetworkFile, Failure> {
    let options = &target.options;
    if target.network.is_none() && (target.file_or_node.is_file() || !Path::new(DEFAULT).is_file()) {
        let name = target.file_or_node.display();
        let text = match target.file_or_node.is_file() {
            true => format!("add the node-ID or server address of the device with --node, because {name} is a file"),
            false => format!("there is no file {name} and no {DEFAULT}: add --network to use the name of a node"),
        };
        return Err(Failure::Usage(text));
    }
    if options.device.is_some() || !options.option.is_empty() || !options.overlay.is_empty() {
        let text =
            "--device, --option and --overlay need a description file and --node: a network file states them itself";
        return Err(Failure::Usage(text.to_owned()));
    }
    NetworkFile::open(target.network.as_deref())
}

/// Nodes that a command watches, with their bus.
pub(super) struct Watched {
    pub nodes: Vec<(u8, Description)>,
    bus: Option<BusAddress>,
    network: Option<NetworkFile>,
}

impl Watched {
    /// Reads the descriptions of the nodes in `watched`. If `watched` has no nodes, reads the descriptions of all nodes
    /// in the network file. `bus` is the bus that the user named.
    pub(super) fn new(watched: &WatchedNodes, bus: Option<&BusAddress>) -> Result<Self, Failure> {
        let is_named = |node: &WatchedNode| matches!(node, WatchedNode::Named(_));
        let needs_network = watched.network.is_some() || watched.nodes.is_empty() || watched.nodes.iter().any(is_named);
        let missing = || Failure::Usage("name the nodes as NODE=FILE, or a network file with --network".to_owned());
        if needs_network && watched.network.is_none() && !Path::new(DEFAULT).is_file() {
            return Err(missing());
        }
        let network = needs_network.then(|| NetworkFile::open(watched.network.as_deref())).transpose()?;
        let kind = bus.map_or(Network::CanOpen, BusAddress::network);
        let node = |node: &WatchedNode| match (node, &network) {
            (WatchedNode::File(node, path), _) => Ok((*node, files::plain(path, kind)?)),
            (WatchedNode::Named(name), Some(network)) => network.node(name, Values::Configured),
            (WatchedNode::Named(_), None) => Err(missing()),
        };
        let nodes = match &network {
            Some(network) if watched.nodes.is_empty() => {
                network.names().map(|name| network.node(name, Values::Configured)).collect::<Result<_, _>>()?
            }
            _ => watched.nodes.iter().map(node).collect::<Result<_, _>>()?,
        };
        Ok(Self { nodes, bus: bus.cloned(), network })
    }

    /// Returns the bus that the user or the network file names.
    pub(super) fn bus(&self) -> Result<BusAddress, Failure> {
        match (&self.network, &self.bus) {
            (Some(network), bus) => network.bus(bus.as_ref()),
            (None, Some(bus)) => Ok(bus.clone()),
            (None, None) => Err(no_bus()),
        }
    }
}

impl From<lexibus_device::Failure> for Failure {
    fn from(failure: lexibus_device::Failure) -> Self {
        Failure::Failed(failure.to_string())
    }
}
