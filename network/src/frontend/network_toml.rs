//! `network.toml`, the network file of Lexibus.

use lexibus_codegen::diagnostics::Diagnostics;

use super::common::{self, named_object, parameters, Names};
use super::reader::Reader;
use super::section::{keys, Form, Section};
use crate::declared::{DeclaredNetwork, DeclaredNode};
use crate::ethercat;
use crate::syntax::{Content, Entry, Node};

const U8: Form = Form::Integer(0, 0xFF);
const U16: Form = Form::Integer(0, 0xFFFF);
const U32: Form = Form::Integer(0, 0xFFFF_FFFF);
const NODE_ID: Form = Form::Integer(1, 127);
/// A version, with the maximum length in bytes that `lexibus::clients::canopen::Boot` compares.
const VERSION: Form = Form::ShortText(64);

/// The whole file.
pub(super) static FILE: Section = Section {
    name: "the top level of the file",
    keys: keys! {
        "network" Form::Table(&NETWORK), "Name, bit rate and bus of the network.";
        "master" Form::Table(&MASTER), "The NMT master.";
        "nodes" Form::Named(&NODE), "All nodes except the master, by name.";
        "segment" Form::Table(&ethercat::SECTION), "The EtherCAT segment.";
    },
};

static NETWORK: Section = Section {
    name: "the section `network`",
    keys: keys! {
        "name" Form::Text, "Name of the network.";
        "bit_rate" Form::Integer(10, 1000), "Bit rate in kbit/s.";
        "bus" Form::Text, "Bus of the commands that access devices, such as `can:can0` or `slcan:/dev/ttyACM0`. The option `--bus` takes precedence.";
    },
};

static MASTER: Section = Section {
    name: "the section `master`",
    keys: keys! {
        "id" NODE_ID, "Node-ID of the master.";
        "pdos" Form::Flag, "False if the master neither sends nor receives PDOs. By default, the master receives each TPDO and sends each RPDO of the nodes.";
        "vendor_id" U32, "Vendor-ID of the master (0x1018:1).";
        "product_code" U32, "Product code of the master (0x1018:2).";
        "revision_number" U32, "Revision number of the master (0x1018:3).";
        "serial_number" U32, "Serial number of the master (0x1018:4).";
        "sync_period" U32, "SYNC period in µs (0x1006); 0 = no SYNC.";
        "sync_window" U32, "Synchronous window length in µs (0x1007).";
        "sync_overflow" Form::Integer(0, 240), "Synchronous counter overflow value (0x1019).";
        "time_cob_id" U32, "COB-ID of TIME (0x1012).";
        "emcy_inhibit_time" U16, "Inhibit time of EMCY in units of 100 µs (0x1015).";
        "heartbeat" U16, "Heartbeat producer time of the master in ms (0x1017).";
        "heartbeat_multiplier" Form::Number, "Consumer time of the master's heartbeat in the nodes, as a multiple of the producer time.";
        "heartbeat_consumer" Form::Flag, "False if the master does not monitor the heartbeats of the nodes (0x1016).";
        "error_behavior" Form::Values, "Error behavior (0x1029): sub-index = value.";
        "nmt_inhibit_time" U16, "Inhibit time of NMT commands in units of 100 µs (0x102A).";
        "start" Form::Flag, "False if the application switches the master to Operational (0x1F80, bit 2).";
        "start_nodes" Form::Flag, "False if the application starts the nodes (0x1F80, bit 3).";
        "start_all_nodes" Form::Flag, "True if the master starts all nodes with one command (0x1F80, bit 1).";
        "reset_all_nodes" Form::Flag, "True if an error of a mandatory node resets all nodes (0x1F80, bit 4).";
        "stop_all_nodes" Form::Flag, "True if an error of a mandatory node stops all nodes (0x1F80, bit 6).";
        "boot_time" U32, "Maximum time in ms until all mandatory nodes are started (0x1F89).";
    },
};

static NODE: Section = Section {
    name: "the section of a node",
    keys: keys! {
        "id" NODE_ID, "Node-ID of the node.";
        "device" Form::Text, "Path of the device description (EDS, DCF, XDD, XDC or register table), relative to the network file.";
        "model" Form::Text, "Name, order code or product code of the device, if the description contains several devices.";
        "overlays" Form::Texts, "Paths of overlays, relative to the network file.";
        "parameters" Form::Values, "Values of objects. The key is an index (`0x6081`), an index with a sub-index (`0x60C2:1`) or a name. The value is a raw value, a physical value with its unit (`\"15.5 rev/s\"`) or the name of a value.";
        "rpdo" Form::Named(&PDO), "RPDOs of the node, by number.";
        "tpdo" Form::Named(&PDO), "TPDOs of the node, by number.";
        "heartbeat" U16, "Heartbeat producer time in ms (0x1017).";
        "heartbeat_multiplier" Form::Number, "Consumer time of the heartbeat in the master, as a multiple of the producer time.";
        "heartbeat_consumer" Form::Flag, "True if the node monitors the heartbeat of the master (0x1016).";
        "guard_time" U16, "Guard time in ms (0x100C).";
        "life_time_factor" U8, "Life time factor (0x100D).";
        "time_cob_id" U32, "COB-ID of TIME (0x1012).";
        "error_behavior" Form::Values, "Error behavior (0x1029): sub-index = value.";
        "revision_number" U32, "Expected revision number, instead of that of the description.";
        "serial_number" U32, "Expected serial number.";
        "boot" Form::Flag, "False if the master does not boot the node (0x1F81, bit 2).";
        "mandatory" Form::Flag, "True if the network must not start without the node (0x1F81, bit 3).";
        "reset_communication" Form::Flag, "False if the master must not reset a node that is Operational (0x1F81, bit 4).";
        "software_file" Form::Text, "Program that the master downloads to the node (0x1F58).";
        "software_version" U32, "Expected software identification (0x1F55).";
        "manufacturer_hardware_version" VERSION, "Expected text of 0x1009, which `boot` compares.";
        "manufacturer_software_version" VERSION, "Expected text of 0x100A, which `boot` compares.";
        "restore_configuration" U8, "Sub-index of 0x1011 that the master writes before the configuration.";
        "retry_factor" U8, "Number of guarding requests without a response after which the master reports a node guarding event (0x1F81, bits 8 to 15).";
        "store" Form::Flag, "True if `boot` stores the configuration in the node (0x1010), and then writes its date to 0x1020.";
    },
};

static PDO: Section = Section {
    name: "the section of a PDO",
    keys: keys! {
        "enabled" Form::Flag, "False if the PDO is disabled.";
        "cob_id" Form::IntegerOrText, "COB-ID with flags, \"auto\", or the TPDO of another node that the RPDO receives, such as \"axis1.tpdo1\".";
        "transmission" U8, "Transmission type (sub-index 2).";
        "inhibit_time" U16, "Inhibit time of the sender in units of 100 µs (sub-index 3). For an RPDO, the sender is the master.";
        "event_timer" U16, "Event timer of the sender in ms (sub-index 5). For an RPDO, the sender is the master.";
        "event_deadline" U16, "Deadline of the receiver in ms (sub-index 5). For a TPDO, the receiver is the master.";
        "sync_start" Form::Integer(0, 240), "SYNC start value of the sender (sub-index 6). For an RPDO, the sender is the master.";
        "map" Form::Objects, "Mapped objects, by index (`0x6040`), index and sub-index (`0x60C1:1`) or name.";
    },
};

static SECTIONS: [&Section; 8] =
    [&FILE, &NETWORK, &MASTER, &NODE, &PDO, &ethercat::SECTION, &ethercat::SUBDEVICE, &ethercat::MODULE];

const NAMES: Names = Names { id: "id", heartbeat: "heartbeat", mapping: "map" };

/// Reads the tree of a file.
pub(super) fn read(root: &Node, diagnostics: &mut Diagnostics) -> DeclaredNetwork {
    let mut reader = Reader { diagnostics, sections: &SECTIONS };
    let file = reader.table(root, &FILE);
    let mut network = DeclaredNetwork::default();
    if let Some(section) = file.get("network") {
        let section = reader.table(section, &NETWORK);
        network.name = reader.text(section, "name");
        network.bit_rate = reader.integer(section, "bit_rate");
        network.bus = reader.text(section, "bus");
    }
    network.master = file.get("master").map(|section| {
        let section = reader.table(section, &MASTER);
        let mut master = common::master(&mut reader, section, &NAMES);
        master.exchanges_pdos = reader.flag(section, "pdos").unwrap_or(true);
        master
    });
    let nodes = file.get("nodes").map_or(&[][..], |nodes| reader.entries(nodes, "name of the node = table"));
    network.nodes = nodes.iter().filter_map(|entry| node(&mut reader, entry)).collect();
    network.segment = file.get("segment").map(|section| ethercat::read(&mut reader, section));
    network.is_master_optional = network.segment.is_some() && file.get("nodes").is_none();
    network
}

/// Reads a node. Returns `None` if it is not a table.
fn node(reader: &mut Reader<'_>, entry: &Entry) -> Option<DeclaredNode> {
    let table = reader.table(&entry.value, &NODE);
    if !matches!(entry.value.content, Content::Table(_)) {
        return None;
    }
    let mut node = DeclaredNode::new(entry.key.clone());
    common::node(reader, table, &NAMES, &mut node);
    node.device = reader.text(table, "device");
    node.model = reader.text(table, "model");
    node.overlays = reader.texts(table, "overlays");
    let versions = ["manufacturer_hardware_version", "manufacturer_software_version"];
    node.versions = versions.map(|key| reader.text(table, key));
    node.store = reader.flag(table, "store").unwrap_or(false);
    for key in ["rpdo", "tpdo"] {
        node.pdos.extend(common::pdos(reader, table, key, &PDO, &NAMES, named_object));
    }
    node.parameters = parameters(reader, table);
    Some(node)
}
