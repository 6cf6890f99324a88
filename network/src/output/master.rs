//! DCF of the master (CiA 302-2): the objects with which a CANopen manager boots and monitors the nodes and exchanges their PDOs. The
//! object dictionary has the layout of Lely's `dcfgen -r`, so that Lely CANopen and ros2_canopen can load the file.

use std::collections::HashMap;

use lexibus_codegen::facts::types;
use lexibus_codegen::ir::{
    Access, CanOpenSettings, Catalog, Commissioning, Device, Direction, Group, Identity, ObjectCode, Type, Value,
};
use lexibus_export::eds::{self, Flavor, Reals};

use super::identity::checked;
use super::master_objects::{array, item, mappable, record, var, with_default, with_file, with_value, U16, U32, U8};
use crate::declared::DeclaredMaster;
use crate::model::{MappedObject, Network, NetworkNode, NetworkPdo, DISABLED};

/// Number of node-IDs.
const NODES: u8 = 127;

/// First index of the objects that contain the data of received PDOs, and of sent PDOs.
const DATA: [u16; 2] = [0x2000, 0x2200];

/// Returns the DCF of the master. Returns `None` if the network has no master.
pub fn master_dcf(network: &Network) -> Option<String> {
    let master = network.master.as_ref()?;
    let mut groups = communication(network, master);
    groups.extend(manager(network, master));
    groups.extend(pdos(network));
    groups.sort_by_key(Group::index);
    let device = device(network, master, groups);
    let catalog = Catalog { devices: vec![device], ..Catalog::default() };
    let options = eds::Options { flavor: Flavor::Dcf, reals: Reals::Decimal };
    eds::export(&catalog, &catalog.devices[0], options).map(|exported| exported.text)
}

/// Returns the values other than 0 that the master writes to its own objects, each with index and sub-index. They are its
/// serial number, and the software identifications, revision numbers and serial numbers that it expects of the nodes.
pub fn master_writes(network: &Network) -> Vec<((u16, u8), u32)> {
    let Some(master) = &network.master else { return Vec::new() };
    let mut writes = vec![((0x1018, 4), master.identity[3])];
    for node in &network.nodes {
        let [_, _, revision, serial] = checked(node);
        writes.push(((0x1F55, node.id), node.software_version));
        writes.push(((0x1F87, node.id), revision));
        writes.push(((0x1F88, node.id), serial));
    }
    writes.retain(|(_, value)| *value != 0);
    writes
}

fn device(network: &Network, master: &DeclaredMaster, groups: Vec<Group>) -> Device {
    let [vendor_id, product_code, revision_number, serial_number] = master.identity;
    let count = |direction| network.exchanged(direction).len() as u16;
    let settings = CanOpenSettings {
        bit_rates: vec![10, 20, 50, 125, 250, 500, 800, 1000],
        boot_up_master: true,
        granularity: Some(1),
        rx_pdos: Some(count(Direction::Transmit)),
        tx_pdos: Some(count(Direction::Receive)),
        lss: true,
        dummies: vec![1, 2, 3, 4, 5, 6, 7, 0x10, 0x12, 0x13, 0x14, 0x15, 0x16, 0x18, 0x19, 0x1A, 0x1B],
        dummies_given: true,
        ..CanOpenSettings::default()
    };
    let commissioning = Commissioning {
        node_id: Some(network.master_id()),
        bit_rate: Some(network.bit_rate),
        net_number: Some(1),
        network_name: network.name.as_str().into(),
        manager: true,
        lss_serial_number: Some(serial_number),
        ..Commissioning::default()
    };
    let identity = Identity {
        vendor_id: Some(vendor_id),
        product_code: Some(product_code),
        revision_number: Some(revision_number),
        ..Identity::default()
    };
    Device {
        name: "master".into(),
        identity,
        canopen: Some(Box::new(settings)),
        commissioning: Some(Box::new(commissioning)),
        groups,
        ..Device::default()
    }
}

/// Returns the objects of the communication profile (CiA 301).
fn communication(network: &Network, master: &DeclaredMaster) -> Vec<Group> {
    use Access::{ReadOnly, ReadWrite};
    let number = |index, name, ty, value: u32| var(with_value(item(index, 0, (name, ty, ReadWrite)), value));
    let identity = |sub_index: u8, name| {
        let entry = item(0x1018, sub_index, (name, U32, ReadOnly));
        let number = master.identity[usize::from(sub_index) - 1];
        // The serial number is written when the master starts.
        if sub_index < 4 {
            with_value(entry, number)
        } else {
            entry
        }
    };
    let names = ["Vendor-ID", "Product code", "Revision number", "Serial number"];
    let identity = (1..).zip(names).map(|(sub_index, name)| identity(sub_index, name)).collect();
    let behavior: Vec<(u8, u32)> = master.error_behavior.iter().map(|(sub, value)| (*sub, u32::from(*value))).collect();
    let emergencies: Vec<(u8, u32)> = network
        .nodes
        .iter()
        .filter(|node| node.emcy_cob_id & DISABLED == 0)
        .map(|node| (node.id, node.emcy_cob_id))
        .collect();
    let mut emcy = item(0x1014, 0, ("COB-ID EMCY", U32, ReadWrite));
    emcy.default = Some(Value::NodeId(0x80));
    let mut groups = vec![
        var(with_default(item(0x1000, 0, ("Device type", U32, ReadOnly)), 0)),
        var(item(0x1001, 0, ("Error register", U8, ReadOnly))),
        array(0x1003, ("Pre-defined error field", U32, ReadOnly), None, 254, &[]),
        number(0x1005, "COB-ID SYNC message", U32, 0x4000_0080),
        number(0x1006, "Communication cycle period", U32, master.sync_period.as_ref().map_or(0, |period| period.value)),
        number(0x1007, "Synchronous window length", U32, master.sync_window),
        number(0x1012, "COB-ID time stamp object", U32, master.time_cob_id.value),
        var(mappable(item(0x1013, 0, ("High resolution time stamp", U32, ReadWrite)))),
        var(emcy),
        number(0x1015, "Inhibit time EMCY", U16, master.emcy_inhibit_time.into()),
        number(0x1017, "Producer heartbeat time", U16, master.heartbeat.value.into()),
        record(0x1018, "Identity Object", ObjectCode::Record, identity),
        number(0x1019, "Synchronous counter overflow value", U8, master.sync_overflow.into()),
        array(0x1028, ("Emergency consumer object", U32, ReadWrite), Some(DISABLED), NODES, &emergencies),
        array(0x1029, ("Error behavior object", U8, ReadWrite), None, 254, &behavior),
        number(0x102A, "NMT inhibit time", U16, master.nmt_inhibit_time.into()),
    ];
    if master.consumes_heartbeats {
        let monitored = network.nodes.iter().filter(|node| node.heartbeat.value != 0);
        let value = |node: &NetworkNode| u32::from(node.id) << 16 | node.heartbeat_time() & 0xFFFF;
        let times: Vec<(u8, u32)> = (1..).zip(monitored.map(value)).collect();
        groups.push(array(0x1016, ("Consumer heartbeat time", U32, ReadWrite), None, NODES, &times));
    }
    groups
}

/// Returns the objects of a CANopen manager (CiA 302-2 and 302-3).
fn manager(network: &Network, master: &DeclaredMaster) -> Vec<Group> {
    use Access::{ReadWrite, WriteOnly};
    let of_nodes = |index, name: &str, ty, value: &dyn Fn(&NetworkNode) -> u32| {
        let values: Vec<(u8, u32)> = network.nodes.iter().map(|node| (node.id, value(node))).collect();
        let values: Vec<(u8, u32)> = values.into_iter().filter(|(_, value)| *value != 0).collect();
        array(index, (name, ty, ReadWrite), None, NODES, &values)
    };
    let number = |index, name, value: u32| var(with_value(item(index, 0, (name, U32, ReadWrite)), value));
    let mut groups = vec![
        array(0x1F25, ("Configuration request", U8, WriteOnly), None, NODES, &[]),
        of_nodes(0x1F55, "Expected software identification", U32, &|_| 0),
        number(0x1F80, "NMT startup", master.startup),
        of_nodes(0x1F81, "NMT slave assignment", U32, &|node| node.assignment),
        of_nodes(0x1F82, "Request NMT", U8, &|_| 0),
        of_nodes(0x1F84, "Device type identification", U32, &|node| node.device_type),
        of_nodes(0x1F85, "Vendor identification", U32, &|node| checked(node)[0]),
        of_nodes(0x1F86, "Product code", U32, &|node| checked(node)[1]),
        of_nodes(0x1F87, "Revision_number", U32, &|_| 0),
        of_nodes(0x1F88, "Serial number", U32, &|_| 0),
        number(0x1F89, "Boot time", master.boot_time),
        of_nodes(0x1F8A, "Restore configuration", U8, &|node| node.restore.into()),
    ];
    let configured = |node: &&NetworkNode| !node.writes.is_empty();
    if network.nodes.iter().any(|node| configured(&node)) {
        let file = |node: &NetworkNode| node.upload_file.clone();
        groups.push(domains(0x1F22, "Concise DCF", "Node-ID", network.nodes.iter().filter(configured), &file));
    }
    let has_program = |node: &&NetworkNode| !node.software_file.is_empty();
    if network.nodes.iter().any(|node| has_program(&node)) {
        let file = |node: &NetworkNode| node.software_file.clone();
        let nodes = network.nodes.iter().filter(has_program);
        groups.push(domains(0x1F58, "Program data", "Program data of node-ID", nodes, &file));
    }
    groups
}

/// Returns an array of domains for all node-IDs. The domains of `nodes` refer to the files that `file` returns.
fn domains<'n>(
    index: u16,
    name: &str,
    entry: &str,
    nodes: impl Iterator<Item = &'n NetworkNode>,
    file: &dyn Fn(&NetworkNode) -> String,
) -> Group {
    let files: HashMap<u8, String> = nodes.map(|node| (node.id, file(node))).collect();
    let domain = |id: u8| {
        let domain = item(index, id, (&format!("{entry} {id}"), Type::Domain, Access::ReadOnly));
        files.get(&id).into_iter().fold(domain, |domain, file| with_file(domain, file))
    };
    record(index, name, ObjectCode::Array, (1..=NODES).map(domain).collect())
}

/// Returns the objects for the PDOs of the master: communication parameters, mappings, mapped objects, and objects that
/// describe the matching PDOs of the nodes.
fn pdos(network: &Network) -> Vec<Group> {
    let mut groups = Vec::new();
    for (direction, first) in [Direction::Transmit, Direction::Receive].into_iter().zip(DATA) {
        let mut places = HashMap::new();
        let mut last = None;
        for ((node, pdo), number) in network.exchanged(direction).into_iter().zip(0..512) {
            if last.replace(node.id) != Some(node.id) {
                places.clear();
            }
            groups.push(communication_object(pdo, number));
            let mapped = place(node, pdo, first + number, &mut places);
            groups.push(mapping_object(pdo, number, &places));
            groups.extend(mapped);
            groups.extend(remote(node, pdo, number));
        }
    }
    groups
}

impl Network {
    /// Returns the PDOs that the master exchanges. With `Transmit`, they are the TPDOs of the nodes, which the master receives;
    /// with `Receive`, the RPDOs that the master sends.
    pub fn exchanged(&self, direction: Direction) -> Vec<(&NetworkNode, &NetworkPdo)> {
        match direction {
            Direction::Receive => self.sent_by_master(),
            Direction::Transmit if self.master.as_ref().is_some_and(|master| master.exchanges_pdos) => {
                self.pdos(direction).collect()
            }
            Direction::Transmit => Vec::new(),
        }
    }
}

fn communication_object(pdo: &NetworkPdo, number: u16) -> Group {
    use Access::{Constant, ReadWrite};
    let is_received = pdo.direction == Direction::Transmit;
    let (index, kind) = if is_received { (0x1400 + number, "RPDO") } else { (0x1800 + number, "TPDO") };
    let entry = |sub_index, name: &str, ty| item(index, sub_index, (name, ty, ReadWrite));
    let inhibit_time = entry(3, "inhibit time", U16);
    let mut items = vec![
        with_value(entry(1, &format!("COB-ID used by {kind}"), U32), pdo.cob_id),
        with_value(entry(2, "transmission type", U8), pdo.transmission),
        if is_received { inhibit_time } else { with_value(inhibit_time, pdo.inhibit_time) },
        entry(4, if is_received { "compatibility entry" } else { "reserved" }, U8),
    ];
    if is_received {
        items.push(with_value(entry(5, "event-timer", U16), pdo.event_deadline));
    } else {
        items.push(with_value(entry(5, "event timer", U16), pdo.event_timer));
        items.push(with_value(entry(6, "SYNC start value", U8), pdo.sync_start));
    }
    let mut group = record(index, &format!("{kind} communication parameter"), ObjectCode::Record, items);
    group.items[0].access = Constant;
    group
}

/// For each mapped object of a node, the address of its data in the master's object dictionary.
type Places = HashMap<(u16, u8), (u16, u8)>;

/// Returns the object with the data of a PDO. It has no entries for objects of the node that are already in `places`. Returns `None` if
/// the object would have no entries.
fn place(node: &NetworkNode, pdo: &NetworkPdo, index: u16, places: &mut Places) -> Option<Group> {
    let is_received = pdo.direction == Direction::Transmit;
    let (access, kind) = if is_received { (Access::ReadWriteOutput, "RPDO") } else { (Access::ReadWriteInput, "TPDO") };
    let mut items = Vec::new();
    for entry in &pdo.entries {
        let place = (index, items.len() as u8 + 1);
        if places.contains_key(&(entry.index, entry.sub_index)) {
            continue;
        }
        places.insert((entry.index, entry.sub_index), place);
        let (name, ty) = data(node, entry);
        items.push(mappable(item(place.0, place.1, (&format!("{}: {name}", node.name.value), ty, access))));
    }
    let number = (index & 0x1FF) + 1;
    let name = format!("Mapped application objects for {kind} {number}");
    (!items.is_empty()).then(|| record(index, &name, ObjectCode::Record, items))
}

/// Returns name and type of a mapped object. A gap has the name of its data type.
fn data(node: &NetworkNode, entry: &MappedObject) -> (String, Type) {
    match node.mapped_item(entry) {
        Some(item) => (item.name.to_string(), types::basic(&node.device().types, item.object_type())),
        None => {
            let ty = Type::from_cia301(entry.index.into()).unwrap_or(Type::Unsigned(entry.bits));
            (ty.to_string(), ty)
        }
    }
}

fn mapping_object(pdo: &NetworkPdo, number: u16, places: &Places) -> Group {
    let is_received = pdo.direction == Direction::Transmit;
    let (index, kind) = if is_received { (0x1600 + number, "RPDO") } else { (0x1A00 + number, "TPDO") };
    let word = |entry: &MappedObject| {
        let (index, sub_index) = places.get(&(entry.index, entry.sub_index)).copied().unwrap_or_default();
        MappedObject { index, sub_index, bits: entry.bits }.word()
    };
    words(index, &format!("{kind} mapping parameter"), &pdo.entries.iter().map(word).collect::<Vec<_>>())
}

fn words(index: u16, name: &str, words: &[u32]) -> Group {
    let values: Vec<(u8, u32)> = (1..).zip(words.iter().copied()).collect();
    array(index, (name, U32, Access::ReadWrite), None, words.len() as u8, &values)
}

/// Returns the manufacturer-specific objects of Lely CANopen that describe a PDO of a node: its number and node-ID, and the objects
/// that it maps.
fn remote(node: &NetworkNode, pdo: &NetworkPdo, number: u16) -> [Group; 2] {
    let (first, kind) = match pdo.direction {
        Direction::Transmit => (0x5800, "TPDO"),
        Direction::Receive => (0x5C00, "RPDO"),
    };
    let name = format!("Remote {kind} number and node-ID");
    let number_item = item(first + number, 0, (&name, U32, Access::ReadWrite));
    let value = u32::from(pdo.number) << 8 | u32::from(node.id);
    let mapped: Vec<u32> = pdo.entries.iter().map(|entry| entry.word()).collect();
    let name = format!("Remote {kind} mapping parameter");
    [var(with_value(number_item, value)), words(first + 0x200 + number, &name, &mapped)]
}
